// vertex_colors.h: lights vertices of a frame with the CPU device's shading, for a device that interpolates the colours
// itself (OpenGL's stage `application`).
#ifndef VERTEX_COLORS_H
#define VERTEX_COLORS_H

#include "light_pattern.h"
#include "shade_frame.h"
#include "shading_batch.h"

enum { VERTEX_RUN_MAX = 3072 }; // a multiple of 3

// Consecutive vertices of one side of a range: corners of its draw's triangles or, with `shared`, vertices of its mesh,
// if one index serves all attributes. With flat shading they are triangles.
struct vertex_run {
    uint32_t range, first, count;
    bool back, shared;
    // The light that a diffuse map does not multiply is stored separately, without the emission if an emission map
    // multiplies the emission.
    bool separate_texture_terms, has_emission_map;
};

// Set up for a frame; the buffers only grow.
struct vertex_colors {
    const struct kernels *kernels;
    struct shade_frame shade;
    struct shading shading; // includes its counters and the results in `vertices`
    struct light_pattern pattern;
    struct work work; // limited only by the call
    enum failure failure;
    struct buffer storage, products;
    float decode_srgb[256], decode_linear[256];
};

// `light` is the environment's light on physical materials (may be NULL). `hierarchy` is NULL if nothing casts shadows.
bool vertex_colors_start(struct vertex_colors *colors, const struct frame *frame, const struct environment_light *light,
                         const struct hierarchy *hierarchy, struct call_control *call, lam_error *error);
// Fills shading.vertices.color and .rest, a row for each vertex of the run, of at most VERTEX_RUN_MAX. If memory runs
// out, shading.ray_layers.failed is set.
void vertex_colors_light(struct vertex_colors *colors, const struct vertex_run *run);
uint64_t vertex_colors_bytes(const struct vertex_colors *colors);
void vertex_colors_free(struct vertex_colors *colors);

#endif
