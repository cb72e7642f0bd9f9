// draw_tile.c: runs all steps for one tile, from its bins to the picture.
#include "cpu_frame.h"

#include "behind.h"
#include "encode_values.h"
#include "output.h"

#include <string.h>

static void shade(struct cpu_frame *cpu, struct thread_state *thread, const struct tile *tile)
{
    cpu->kernels->shade->shade_fragments(&cpu->shade, &thread->fragments, &thread->shading, tile);
    work_add(&cpu->work, thread->shading.uncounted);
    thread->shading.uncounted = 0;
    if (thread->shading.ray_layers.failed)
        work_fail(&cpu->work, FAILED_MEMORY);
    if (cpu->shade.recorder)
        recording_kernels.record_fragments(cpu, thread, tile);
}

// Draws the layers over the pixels of `area`. A thread stores at most LAYERS_MAX fragments. An area with more fragments
// is divided into halves, if necessary down to single pixels. The fragments of a single pixel must not exceed this
// limit.
static void draw_layers(struct cpu_frame *cpu, struct thread_state *thread, const struct tile *tile,
                        const struct rectangle *area)
{
    if (!work_continues(&cpu->work))
        return;
    uint64_t start = now_ns();
    const struct sample_pattern *pattern = cpu->raster.pattern;
    if (!cpu->kernels->raster->translucent_fragments(&cpu->raster, &thread->samples, &thread->fragments,
                                                     &thread->layers, tile, area)) {
        thread->coverage_ns += now_ns() - start;
        int width = area->right - area->left + 1, height = area->bottom - area->top + 1;
        if (width == 1 && height == 1) {
            work_fail(&cpu->work, FAILED_LAYERS);
            return;
        }
        struct rectangle one = *area, other = *area;
        if (width > height)
            other.left = (one.right = area->left + width / 2 - 1) + 1;
        else
            other.top = (one.bottom = area->top + height / 2 - 1) + 1;
        draw_layers(cpu, thread, tile, &one); // at most 12 levels of recursion
        draw_layers(cpu, thread, tile, &other);
        return;
    }
    if (!work_continues(&cpu->work))
        return;
    thread->layers.masked = false;
    if (cpu->shade.frame->masked)
        cpu->kernels->shade->mask_fragments(&cpu->shade, &thread->fragments, &thread->layers, &thread->shading, tile);
    if (output_is_value(cpu->shade.frame->settings.output)) {
        show_layers(pattern, &thread->fragments, &thread->layers, &thread->samples);
        thread->coverage_ns += now_ns() - start;
        return;
    }
    sort_layers(pattern, &thread->fragments, &thread->layers, &thread->blend);
    // The order of the list depends on the threads. With shadows, it would decide which fragments share rays.
    group_fragments(cpu->raster.frame, &thread->fragments, thread->shading.shadows ? thread->blend.order : NULL);
    uint64_t covered = now_ns();
    shade(cpu, thread, tile);
    if (!work_continues(&cpu->work))
        return;
    uint64_t shaded = now_ns();
    struct tile_part part = {tile, area, thread->samples.ids};
    thread->pixels_covered += blend_layers(pattern, &thread->fragments, &thread->layers, &thread->blend, &part,
                                           &thread->sums, cpu->shade.recorder);
    thread->coverage_ns += covered - start;
    thread->lighting_ns += shaded - covered;
    thread->resolve_ns += now_ns() - shaded;
}

static void blend_tile(struct cpu_frame *cpu, struct thread_state *thread, const struct tile *tile)
{
    for (int c = 0; c < 4; c++)
        memset(thread->sums.sum[c], 0, TILE * TILE * sizeof(float));
    for (int i = 0; i < tile_samples_count(cpu->raster.frame->settings.samples); i++)
        thread->sums.transmittance[i] = 1;
    for (int c = 0; c < 3 && thread->sums.tint[c]; c++)
        for (int i = 0; i < tile_samples_count(cpu->raster.frame->settings.samples); i++)
            thread->sums.tint[c][i] = 1;
    draw_layers(cpu, thread, tile, &(struct rectangle){0, 0, tile->width - 1, tile->height - 1});
}

static void fill_empty_tile(const struct resolve_target *target, const struct tile *tile)
{
    const lam_image *image = target->converted ? target->converted : target->image;
    size_t size = pixel_bytes(image->format), left = (size_t)tile->x * TILE * size;
    char pixel[sizeof target->empty_pixel], row[TILE * sizeof pixel];
    pixels_from_working(image->format, values_are_raw(target->frame), target->empty_pixel, 1, pixel);
    for (int x = 0; x < tile->width; x++)
        memcpy(row + (size_t)x * size, pixel, size);
    for (int y = 0; y < tile->height; y++)
        memcpy((char *)image_row(image, tile->y * TILE + y) + left, row, (size_t)tile->width * size);
}

static void resolve_into(const struct resolve_target *target, const struct cpu_frame *cpu, struct thread_state *thread,
                         const struct tile *tile)
{
    const struct kernels *kernels = cpu->kernels;
    lam_output output = target->frame->settings.output;
    if (lam_output_is_light(output)) {
        kernels->raster->resolve(target, &thread->fragments, &thread->samples, &thread->sums, tile);
        if (cpu->shade.recorder)
            recording_kernels.record_pixel(cpu, thread, tile);
        return;
    }
    if (output == LAM_OUTPUT_CLIPPED) { // the tile is resolved to floats first
        lam_image image = {
            .width = tile->width, .height = tile->height, .format = LAM_RGBA32F, .pixels = thread->sums.unclipped};
        struct resolve_target tile_target = {.frame = target->frame, .image = &image};
        kernels->raster->resolve_empty(&tile_target);
        kernels->raster->resolve(&tile_target, &thread->fragments, &thread->samples, &thread->sums,
                                 &(struct tile){0, 0, tile->width, tile->height});
    }
    output_tile(target, &thread->fragments, &thread->samples, &thread->sums, tile);
}

static void resolve_tile(const struct cpu_frame *cpu, struct thread_state *thread, const struct tile *tile)
{
    const struct resolve_target *target = &cpu->target;
    const lam_image *converted = target->converted;
    if (target->behind) {
        cpu->kernels->raster->resolve(target, &thread->fragments, &thread->samples, &thread->sums, tile);
        return;
    }
    if (!converted) {
        resolve_into(target, cpu, thread, tile);
        return;
    }
    lam_image pixels = {
        .width = tile->width, .height = tile->height, .format = target->image->format, .pixels = thread->sums.pixels};
    struct resolve_target tile_target = *target;
    tile_target.image = &pixels;
    resolve_into(&tile_target, cpu, thread, &(struct tile){0, 0, tile->width, tile->height});
    size_t left = (size_t)tile->x * TILE * pixel_bytes(converted->format);
    for (int y = 0; y < tile->height; y++)
        pixels_from_working(converted->format, values_are_raw(target->frame), image_row(&pixels, y), tile->width,
                            (char *)image_row(converted, tile->y * TILE + y) + left);
}

// For a tile without glass, copies the sums from the picture behind glass, because the tile is the same there.
static void take_behind(const struct behind *behind, struct thread_state *thread, const struct tile *tile)
{
    for (int y = 0; y < tile->height; y++) {
        const float *from =
            behind->texels[0] + 4 * ((size_t)(tile->y * TILE + y) * (size_t)behind->width[0] + (size_t)tile->x * TILE);
        for (int x = 0; x < tile->width; x++)
            for (int c = 0; c < 4; c++)
                thread->sums.sum[c][y * TILE + x] = from[4 * x + c];
    }
    thread->fragments.count = 0;
    thread->samples.translucent_triangles = 1; // the sums already contain values
}

void draw_tile(struct cpu_frame *cpu, size_t index, int number)
{
    const struct kernels *kernels = cpu->kernels;
    struct thread_state *thread = &cpu->threads[number];
    struct tile tile = tile_number(cpu, index);
    const struct fragment_store *store = cpu->fragment_stores ? &cpu->fragment_stores[index] : NULL;
    if (!cpu->shade.recorder && !(store ? store->count > 0 : tile_has_triangles(&cpu->raster, index))) {
        if (!cpu->target.behind)
            fill_empty_tile(&cpu->target, &tile);
        return;
    }
    uint64_t start = now_ns();
    if (thread->sums.behind && !cpu->shade.recorder && !thread->sums.behind->glass[index]) {
        take_behind(thread->sums.behind, thread, &tile);
        resolve_tile(cpu, thread, &tile);
        thread->resolve_ns += now_ns() - start;
        return;
    }
    if (store) {
        kernels->raster->load_fragments(store, &thread->fragments, cpu->raster.frame->settings.samples);
        thread->samples.translucent_triangles = 0;
    } else {
        kernels->raster->cover_tile(&cpu->raster, &thread->samples, &tile);
        if (!work_continues(&cpu->work))
            return;
        if (thread->samples.translucent_triangles) {
            thread->coverage_ns += now_ns() - start;
            blend_tile(cpu, thread, &tile);
            if (output_is_value(cpu->raster.frame->settings.output)) // the visibility buffer now contains the surfaces
                thread->samples.translucent_triangles = 0;
            start = now_ns();
        }
        thread->pixels_covered +=
            kernels->raster->visibility_resolve(cpu->raster.pattern, &thread->samples, &thread->fragments, &tile);
    }
    group_fragments(cpu->raster.frame, &thread->fragments, NULL);
    uint64_t covered = now_ns();
    lam_output output = cpu->raster.frame->settings.output;
    if (output_kind(output) != OUTPUT_COUNT)
        shade(cpu, thread, &tile);
    if (!work_continues(&cpu->work))
        return;
    uint64_t shaded = now_ns();
    resolve_tile(cpu, thread, &tile);
    thread->coverage_ns += covered - start;
    thread->lighting_ns += shaded - covered;
    thread->resolve_ns += now_ns() - shaded;
}
