// gltf_triangles.h: converts triangles, strips and fans to triangles, and lines, loops and strips to lines (section
// 3.7.2.1).
#ifndef GLTF_TRIANGLES_H
#define GLTF_TRIANGLES_H

#include "gltf.h"

// The values of "mode" (section 5.24.4).
enum {
    GLTF_POINTS,
    GLTF_LINES,
    GLTF_LINE_LOOP,
    GLTF_LINE_STRIP,
    GLTF_TRIANGLES,
    GLTF_TRIANGLE_STRIP,
    GLTF_TRIANGLE_FAN
};

// Sets the indices and the triangle_count of the mesh from the indices of the primitive. `mode` must be one of the
// three modes for triangles. Checks that every index is below mesh->vertex_count. Drops the degenerate triangles of
// strips and fans, that is, triangles that use a vertex twice.
bool gltf_triangles(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t mode, lam_mesh *mesh);

// Works like gltf_triangles, but for lines and points, and sets line_count or point_count.
bool gltf_strokes(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t mode, lam_mesh *mesh);

#endif
