// gltf_triangles.h: triangles, strips and fans of a primitive as triangles, and lines, loops and strips as lines (section 3.7.2.1).
#ifndef GLTF_TRIANGLES_H
#define GLTF_TRIANGLES_H

#include "gltf.h"

// mode (section 5.24.4).
enum {
    GLTF_POINTS,
    GLTF_LINES,
    GLTF_LINE_LOOP,
    GLTF_LINE_STRIP,
    GLTF_TRIANGLES,
    GLTF_TRIANGLE_STRIP,
    GLTF_TRIANGLE_FAN
};

// Sets the mesh's indices and triangle_count from the primitive's `mode`, one of the three with triangles, and its
// indices, each of which is below mesh->vertex_count. Triangles of a strip or fan that name a vertex twice are dropped.
bool gltf_triangles(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t mode, lam_mesh *mesh);

// The same of lines and points: sets line_count or point_count.
bool gltf_strokes(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t mode, lam_mesh *mesh);

// The primitive's corners: its indices, or *indices NULL and all vertices.
bool gltf_corners(struct gltf *gltf, const struct place *place, const json_t *primitive, uint32_t vertex_count,
                  const uint32_t **indices, size_t *count);

#endif
