// vertex_colors.c: computes the lighting of a frame's vertices, and allocates only the memory that the frame needs.
#include "vertex_colors.h"

#include "isa.h"
#include "kernels.h"
#include "srgb.h"

#include <stdlib.h>

// The arrays, stored consecutively in one block.
struct arrays {
    struct shading_batch batch; // comes first, because it is aligned to cache lines
    struct ray_starts starts;
    uint32_t key[VERTEX_RUN_MAX][4];
    float color[VERTEX_RUN_MAX][4], rest[VERTEX_RUN_MAX][3];
};

bool vertex_colors_start(struct vertex_colors *colors, const struct frame *frame, const struct environment_light *light,
                         const struct hierarchy *hierarchy, struct call_control *call, lam_error *error)
{
    if (!colors->kernels) {
        colors->kernels = kernels_of(widest_isa());
        for (int i = 0; i < 256; i++) {
            colors->decode_srgb[i] = (float)srgb_linear(i / 255.0);
            colors->decode_linear[i] = (float)(i / 255.0);
        }
    }
    if (!buffer_reserve(&colors->storage, sizeof(struct arrays), call, error))
        return false;
    struct arrays *arrays = colors->storage.data;
    struct shading *shading = &colors->shading;
    shading->batch = &arrays->batch;
    shading->starts = &arrays->starts;
    shading->vertices.key = arrays->key;
    shading->vertices.color = arrays->color;
    shading->vertices.rest = arrays->rest;
    shading->ray_layers.failed = false;
    colors->failure = FAILED_NOT;
    colors->work = (struct work){.call = call, .failure = &colors->failure, .limit = UINT64_MAX};
    shading->work = &colors->work;
    shading->uncounted = 0;
    if (frame->settings.shadows && colors->pattern.all.count != frame->settings.shadow_samples)
        light_pattern_fill(&colors->pattern, frame->settings.shadow_samples);
    colors->shade = (struct shade_frame){.frame = frame,
                                         .materials = products_make(&colors->products, frame, call, error),
                                         .environment_light = light,
                                         .hierarchy = hierarchy,
                                         .light_pattern = &colors->pattern,
                                         .ray_kernels = ray_kernels_of(colors->kernels->lanes),
                                         .lookups = environment_lookups_of(colors->kernels->lanes),
                                         .decode_srgb = colors->decode_srgb,
                                         .decode_linear = colors->decode_linear};
    return colors->shade.materials != NULL;
}

void vertex_colors_light(struct vertex_colors *colors, const struct vertex_run *run)
{
    colors->kernels->shade->light_vertices(&colors->shade, &colors->shading, run);
}

uint64_t vertex_colors_bytes(const struct vertex_colors *colors)
{
    return colors->storage.capacity + colors->products.capacity +
           (uint64_t)colors->shading.ray_layers.capacity * sizeof *colors->shading.ray_layers.list;
}

void vertex_colors_free(struct vertex_colors *colors)
{
    buffer_free(&colors->storage);
    buffer_free(&colors->products);
    free(colors->shading.ray_layers.list);
}
