// mesh_build.h: splits polygons into triangles, and adds meshes to the scene, for all formats.
#ifndef MESH_BUILD_H
#define MESH_BUILD_H

#include "importer.h"

// A face with more than three corners. The index arrays reserve space for the face's triangles. Until mesh_triangulate
// splits the face, its `count` corners are stored in that space, from corner 3 * first_triangle on.
struct mesh_polygon {
    uint32_t first_triangle, count;
};

// Splits the polygons in place, in parallel. `corners` are the mesh's index arrays: positions, and other attributes or
// NULL. If load_params.polygon_edges is set, sets *inner_edges (lam_mesh.inner_edges, in the scene's arena) for
// `triangles` triangles, unless there are no polygons. `positions` must be finite, and the position indices must be in
// range.
bool mesh_triangulate(const struct import_source *source, struct lam_scene *scene, const float *positions,
                      const struct mesh_polygon *polygons, size_t count, uint64_t triangles, uint32_t *const corners[3],
                      const uint8_t **inner_edges, lam_error *error);

// Adds the mesh and one object with this name (may be NULL). A mesh without triangles, lines or points is not added.
bool mesh_add_object(struct lam_scene *scene, const lam_mesh *mesh, const char *name, lam_error *error);

#endif
