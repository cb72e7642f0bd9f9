// mesh_build.h: from polygons to a mesh of the scene, for all formats.
#ifndef MESH_BUILD_H
#define MESH_BUILD_H

#include "importer.h"

// A face with more than three corners. Its `count` corners are stored from corner 3 * first_triangle, in the range of
// its triangles, until mesh_triangulate splits it.
struct mesh_polygon {
    uint32_t first_triangle, count;
};

// Splits the polygons in place, in parallel. `corners` are the mesh's index arrays: positions, and other attributes or
// NULL. With load_params.polygon_edges, sets *inner_edges (lam_mesh.inner_edges, in the scene's arena) for `triangles`
// triangles, unless there are no polygons. `positions` must be finite, and the corners of positions in range.
bool mesh_triangulate(const struct import_source *source, struct lam_scene *scene, const float *positions,
                      const struct mesh_polygon *polygons, size_t count, uint64_t triangles, uint32_t *const corners[3],
                      const uint8_t **inner_edges, lam_error *error);

// Adds the mesh and one object with this name (may be NULL). A mesh without items is not added.
bool mesh_add_object(struct lam_scene *scene, const lam_mesh *mesh, const char *name, lam_error *error);

#endif
