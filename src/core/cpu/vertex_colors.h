// vertex_colors.h: computes the lighting of vertices with the shading code of the CPU device. The module is for a
// device that interpolates the colours itself (the stage `application` of the OpenGL device).
#ifndef VERTEX_COLORS_H
#define VERTEX_COLORS_H

#include "shade_frame.h"
#include "shading_batch.h"

enum { VERTEX_RUN_MAX = 3072 }; // a multiple of 3

// Consecutive vertices for one side of a range. Usually the vertices are the corners of the triangles of the range's
// draw. If all attributes use the same index, `shared` is true and the vertices are the mesh's vertices. With flat
// shading, the run consists of triangles instead of vertices.
struct vertex_run {
    uint32_t range, first, count;
    bool back, shared;
    // With `separate_texture_terms`, the light that a diffuse map does not multiply is stored separately. With
    // `has_emission_map`, the emission, which an emission map multiplies, is not part of this light.
    bool separate_texture_terms, has_emission_map;
};

// The state of this module, set up for one frame at a time; the buffers only grow.
struct vertex_colors {
    const struct kernels *kernels;
    struct shade_frame shade;
    struct shading shading; // includes the counters, and the results in `vertices`
    struct light_pattern pattern;
    struct work work; // only the limits of the call can stop the work
    enum failure failure;
    struct buffer storage, products;
    float decode_srgb[256], decode_linear[256];
};

// `light` is the environment's light on physical materials (may be NULL). `hierarchy` is NULL if nothing casts shadows.
bool vertex_colors_start(struct vertex_colors *colors, const struct frame *frame, const struct environment_light *light,
                         const struct hierarchy *hierarchy, struct call_control *call, lam_error *error);
// Writes one row of shading.vertices.color and .rest for each vertex of the run. A run has at most VERTEX_RUN_MAX
// vertices. If memory runs out, shading.ray_layers.failed is set.
void vertex_colors_light(struct vertex_colors *colors, const struct vertex_run *run);
uint64_t vertex_colors_bytes(const struct vertex_colors *colors);
void vertex_colors_free(struct vertex_colors *colors);

#endif
