// mesh_build.h: splits polygons into triangles, and adds meshes to the scene, for all formats.
#ifndef MESH_BUILD_H
#define MESH_BUILD_H

#include "importer.h"

// A face with more than three corners. The index arrays reserve space for the face's triangles. Until mesh_triangulate
// splits the face, its `count` corners are stored in that space, from corner 3 * first_triangle on.
struct mesh_polygon {
    uint32_t first_triangle, count;
};

// The polygons of a mesh.
struct mesh_polygons {
    const struct mesh_polygon *items;
    size_t count;
    const float *positions;
    // the mesh's index arrays: of positions (all valid), and of two other attributes (may be NULL)
    uint32_t *corners[3];
    uint64_t triangles; // of the whole mesh, including the triangles of the polygons
};

// Marks the vertices that corners use: sets their bytes to 1. Several threads may mark the same vertex.
static inline void mesh_mark_vertices(const uint32_t *indices, size_t corners, uint8_t *marks)
{
    for (size_t i = 0; i < corners; i++)
        __atomic_store_n(&marks[indices[i]], 1, __ATOMIC_RELAXED);
}

// Splits the polygons in place, in parallel. All triangles of a polygon with a position that is not finite use this
// position, so that scene_repair leaves them out. Sets *inner_edges (lam_mesh.inner_edges, in the scene's arena) if
// load_params.polygon_edges is set and the mesh has polygons.
bool mesh_triangulate(const struct import_source *source, struct lam_scene *scene, const struct mesh_polygons *polygons,
                      const uint8_t **inner_edges, lam_error *error);

// The range of the numbers of colours in a file: at least `least`, and `usual` for their type. If `usual` is 0, the
// numbers are already from 0 to 1.
struct color_range {
    float least, usual;
};

// Converts vertex colours (RGBA) from the numbers of a file to linear light (unless params->color is LAM_COLOR_RAW). The
// largest number decides the range of red, green and blue, and that of alpha: ranges[0].least, 255, or a larger one.
// Warns if a range is not the usual one. A negative number means that the vertex has no colour and is white.
bool mesh_convert_colors(const struct import_source *source, struct lam_scene *scene, float *colors, size_t count,
                         const struct color_range ranges[2], lam_error *error);

// Adds the mesh and one object with this name (may be NULL). A mesh without triangles, lines or points is not added.
bool mesh_add_object(struct lam_scene *scene, const lam_mesh *mesh, const char *name, lam_error *error);

#endif
