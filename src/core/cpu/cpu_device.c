// cpu_device.c: implements the software device, and runs the steps of a frame in order.
#include "device_type.h"

#include "behind.h"
#include "cpu_frame.h"
#include "environment.h"
#include "fail.h"
#include "isa.h"
#include "output.h"
#include "recorder.h"
#include "srgb.h"
#include "visible_triangles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct cpu_device {
    struct lam_device base;
    const struct kernels *kernels;
    struct pool *pool;
    int thread_count;
    struct thread_state *threads;
    struct thread_bins *bins;
    struct frame_memory memory;
    struct visible_buffers visible;
    struct light_pattern light_pattern;
    float decode_srgb[256], decode_linear[256];
};

static uint64_t cpu_memory(const struct lam_device *base)
{
    const struct cpu_device *device = (const struct cpu_device *)base;
    const struct visible_buffers *visible = &device->visible;
    uint64_t bytes = frame_memory_bytes(&device->memory) + visible->sets.capacity + visible->normals.capacity +
                     visible->fragment_stores.capacity;
    for (int i = 0; i < device->thread_count; i++)
        bytes += thread_bytes(&device->threads[i], &device->bins[i], i == 0);
    return bytes;
}

static void cpu_release(struct lam_device *base)
{
    struct cpu_device *device = (struct cpu_device *)base;
    for (int i = 0; i < device->thread_count; i++)
        thread_free(&device->threads[i], &device->bins[i]);
    frame_memory_free(&device->memory);
    buffer_free(&device->visible.sets);
    buffer_free(&device->visible.normals);
    buffer_free(&device->visible.fragment_stores);
}

static void cpu_free(struct lam_device *base)
{
    struct cpu_device *device = (struct cpu_device *)base;
    cpu_release(base);
    pool_free(device->pool);
    free(device->threads);
    free(device->bins);
    free(device);
}

// --- the steps

static void vertex_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct cpu_frame *cpu = user;
    if (work_continues(&cpu->work))
        cpu->kernels->raster->vertex_transform(&cpu->raster, &cpu->vertex_chunks[index]);
}

static void triangle_task(void *user, size_t index, int thread)
{
    struct cpu_frame *cpu = user;
    if (work_continues(&cpu->work))
        cpu->kernels->raster->bin_triangles(&cpu->raster, &cpu->bins[thread], &cpu->triangle_chunks[index]);
    work_add(&cpu->work, cpu->bins[thread].work);
    cpu->bins[thread].work = 0;
}

_Static_assert((int)TILE == (int)FRAME_TILE, "frame.finished_tiles has an element for each tile");

// Returns the tile that contains a pixel, given by its column and row.
static size_t tile_of(const struct cpu_frame *cpu, const int *pixel)
{
    return (size_t)(pixel[1] >> TILE_SHIFT) * (size_t)cpu->raster.tiles_across + (size_t)(pixel[0] >> TILE_SHIFT);
}

static void tile_task(void *user, size_t index, int thread)
{
    struct cpu_frame *cpu = user;
    const bool *finished = cpu->shade.frame->finished_tiles;
    const int *pixel = cpu->shade.frame->only_pixel;
    if (!work_continues(&cpu->work) || (finished && finished[index]) || (pixel && tile_of(cpu, pixel) != index))
        return;
    draw_tile(cpu, index, thread);
    if (thread == 0)
        call_progress(cpu->call, (double)index / (double)tile_count(cpu), "frame");
}

static void behind_task(void *user, size_t index, int thread)
{
    struct cpu_frame *cpu = user;
    struct thread_state *state = &cpu->threads[thread];
    uint64_t covered = state->pixels_covered;
    state->layers.glass = false;
    if (work_continues(&cpu->work))
        draw_tile(cpu, index, thread);
    cpu->target.behind->glass[index] = state->layers.glass;
    if (state->layers.glass) // pixels with glass are counted when the glass is drawn
        state->pixels_covered = covered;
}

// Draws the picture behind rough and thick glass before the tiles of the frame, because glass in any tile may show any
// region of this picture.
static bool draw_behind(struct cpu_frame *cpu, struct behind *behind, struct buffer *memory, lam_error *error)
{
    const lam_image *image = cpu->target.image;
    struct recorder *recorder = cpu->shade.recorder;
    if (!behind_make(behind, memory, image->width, image->height, tile_count(cpu), cpu->call, error))
        return false;
    cpu->shade.recorder = NULL;
    cpu->raster.without_glass = true;
    cpu->target.behind = behind;
    pool_run(cpu->pool, tile_count(cpu), behind_task, cpu);
    cpu->shade.recorder = recorder;
    cpu->raster.without_glass = false;
    cpu->target.behind = NULL;
    for (int i = 0; i < cpu->raster.thread_count; i++)
        cpu->threads[i].sums.behind = behind;
    behind_fill(behind);
    return true;
}

// Draws the tile with the explained pixel again, and records the pixel's values.
static void record_tile(struct cpu_frame *cpu, struct recorder *recorder)
{
    tile_task(cpu, tile_of(cpu, (int[2]){recorder->out->x, recorder->out->y}), 0);
    if (recorder->failed)
        cpu->failure = FAILED_MEMORY;
}

static bool step_done(const struct cpu_frame *cpu, lam_error *error)
{
    enum failure failure = __atomic_load_n(&cpu->failure, __ATOMIC_RELAXED);
    if (failure == FAILED_LAYERS)
        return fail(error, LAM_LIMIT,
                    "more than %d translucent triangles cover one pixel, the maximum that can be sorted", LAYERS_MAX);
    if (failure == FAILED_WORK)
        return fail(error, LAM_LIMIT,
                    "more than %llu layers cover a pixel on average, the most for files of %llu bytes "
                    "(lam_control.layer_limit)",
                    (unsigned long long)call_layer_limit(cpu->call), (unsigned long long)call_input_bytes(cpu->call));
    if (failure)
        return call_memory_error(cpu->call, 2 << 20, error);
    return call_should_continue(cpu->call) || call_error(cpu->call, error);
}

static double milliseconds_since(uint64_t *start)
{
    uint64_t now = now_ns();
    double ms = (double)(now - *start) * 1e-6;
    *start = now;
    return ms;
}

static void fill_report(lam_frame_report *report, const struct cpu_device *device)
{
    uint64_t coverage = 0, lighting = 0, resolved = 0;
    for (int i = 0; i < pool_threads(device->pool); i++) {
        const struct thread_state *thread = &device->threads[i];
        coverage += thread->coverage_ns;
        lighting += thread->lighting_ns;
        resolved += thread->resolve_ns;
        report->pixels_covered += thread->pixels_covered;
        report->points_lit += thread->shading.points_lit;
        report->lights_evaluated += thread->shading.lights_evaluated;
        report->rays += thread->shading.rays;
        report->triangles_binned += device->bins[i].triangles_binned;
    }
    double sum = (double)(coverage + lighting + resolved);
    if (sum > 0) {
        report->coverage_ms = report->tiles_ms * (double)coverage / sum;
        report->lighting_ms = report->tiles_ms * (double)lighting / sum;
        report->resolve_ms = report->tiles_ms * (double)resolved / sum;
    }
}

// Prepares the environment light for physical materials: either the prefiltered environment, or directions to sample.
static bool set_up_environment(struct cpu_frame *cpu, struct frame_memory *memory, lam_error *error)
{
    const struct frame *frame = cpu->shade.frame;
    if (!frame->settings.reference) {
        cpu->shade.environment_light = (frame->separate_lamp ? environment_light_without_lamp : environment_light)(
            frame->environment, environment_parts_of(&cpu->shade), cpu->pool, cpu->call, error);
        return cpu->shade.environment_light != NULL;
    }
    cpu->shade.reference = &memory->samples;
    return environment_samples_make(&memory->samples, frame->environment, frame->to_environment,
                                    frame->settings.reference / 2, &memory->reference, cpu->call, error);
}

// All pictures with fewer pixels than this have the same work limit, because a small picture takes little time with any
// number of layers.
enum { WORK_PIXELS = 256 * 256 };

static uint64_t work_limit(const lam_image *image, const struct call_control *call)
{
    uint64_t pixels = (uint64_t)image->width * (uint64_t)image->height, units;
    bool none = __builtin_mul_overflow(call_layer_limit(call),
                                       WORK_LAYER * (pixels > WORK_PIXELS ? pixels : WORK_PIXELS), &units);
    return none ? UINT64_MAX : units;
}

// Builds the hierarchy if rays need a hierarchy, and fills the pattern of shadow rays.
static bool set_up_rays(struct cpu_device *device, struct cpu_frame *cpu, lam_error *error)
{
    struct lam_device *base = &device->base;
    const struct frame *frame = cpu->shade.frame;
    uint64_t clock = now_ns();
    bool built = false;
    if (frame_has_rays(frame) &&
        !(cpu->shade.hierarchy = hierarchy_of_frame(&base->hierarchy, frame, device->pool, cpu->call, &built, error)))
        return false;
    if (frame->settings.shadows && device->light_pattern.all.count != frame->settings.shadow_samples)
        light_pattern_fill(&device->light_pattern, frame->settings.shadow_samples);
    cpu->shade.light_pattern = &device->light_pattern;
    base->report.hierarchy_ms += built ? milliseconds_since(&clock) : 0;
    return true;
}

static bool set_up_paths(struct cpu_frame *cpu, struct path_frame *paths, lam_error *error)
{
    paths->frame = cpu->shade.frame;
    paths->hierarchy = cpu->shade.hierarchy;
    paths->ray_kernels = cpu->shade.ray_kernels;
    paths->kernels = path_kernels_of(cpu->kernels->lanes);
    paths->lookups = cpu->shade.lookups;
    cpu->shade.paths = paths;
    return path_frame_make(paths, cpu->call, error);
}

// Finds the visible triangles before lighting if the normals or the ambient occlusion depend on them. Then computes
// these normals and the occlusion.
static bool search_before_lighting(struct cpu_device *device, struct cpu_frame *cpu, uint64_t *clock, lam_error *error)
{
    lam_frame_report *report = &device->base.report;
    bool makes_normals = cpu->shade.frame->makes_normals, ok = true;
    if (makes_normals || cpu->shade.occlusion)
        ok = cover_in_advance(cpu, &device->visible, error) && step_done(cpu, error);
    double advance_ms = milliseconds_since(clock);
    if (makes_normals)
        report->normals_ms = advance_ms - device->visible.search_ms;
    if (!ok || !cpu->shade.occlusion)
        return ok;
    screen_occlusion_find(&cpu->occlusion, cpu->kernels->lanes, device->pool, cpu->call);
    report->occlusion_ms = milliseconds_since(clock);
    return step_done(cpu, error);
}

static bool cpu_draw(struct lam_device *base, const struct frame *frame, lam_image *image, struct call_control *call,
                     lam_error *error)
{
    struct cpu_device *device = (struct cpu_device *)base;
    bool converted = image->format != working_format(image->format);
    lam_image working = {.width = image->width, .height = image->height, .format = working_format(image->format)};
    struct cpu_frame cpu = {
        .raster = {.frame = frame,
                   .pattern = sample_pattern(frame->settings.samples),
                   .work = &cpu.work,
                   .tiles_across = (image->width + TILE - 1) / TILE,
                   .tiles_down = (image->height + TILE - 1) / TILE,
                   // The guard band extends 65536 pixels on each side of the window's centre, so that snapped
                   // coordinates fit into 26 bits.
                   .guard = {65536.0f, 65536.0f},
                   .bins = device->bins,
                   .thread_count = pool_threads(device->pool)},
        .shade = {.frame = frame,
                  .decode_srgb = device->decode_srgb,
                  .decode_linear = device->decode_linear,
                  .ray_kernels = ray_kernels_of(device->kernels->lanes),
                  .lookups = environment_lookups_of(device->kernels->lanes),
                  .recorder = base->recorder},
        .target = {.frame = frame, .image = converted ? &working : image, .converted = converted ? image : NULL},
        .kernels = device->kernels,
        .call = call,
        .work = {.call = call, .failure = &cpu.failure, .limit = work_limit(image, call)},
        .pool = device->pool,
        .bins = device->bins,
        .threads = device->threads,
    };
    if (!cpu_frame_set_up(&cpu, &device->memory, error))
        return false;
    if (frame->environment_lights && !set_up_environment(&cpu, &device->memory, error))
        return false;
    if (!set_up_rays(device, &cpu, error))
        return false;
    if (frame->settings.bounces && !set_up_paths(&cpu, &device->memory.paths, error))
        return false;
    cpu.kernels->raster->resolve_empty(&cpu.target);
    if (!lam_output_is_light(frame->settings.output))
        output_empty(&cpu.target);

    uint64_t clock = now_ns();
    pool_run(device->pool, cpu.vertex_chunk_count, vertex_task, &cpu);
    base->report.vertices_ms = milliseconds_since(&clock);
    if (!step_done(&cpu, error))
        return false;
    pool_run(device->pool, cpu.triangle_chunk_count, triangle_task, &cpu);
    base->report.triangles_ms = milliseconds_since(&clock);
    if (!step_done(&cpu, error))
        return false;
    bool ok = search_before_lighting(device, &cpu, &clock, error);
    struct behind behind;
    if (ok && frame->refracts)
        ok = draw_behind(&cpu, &behind, &device->memory.behind, error) && step_done(&cpu, error);
    if (ok && base->recorder)
        record_tile(&cpu, base->recorder);
    else if (ok)
        pool_run(device->pool, tile_count(&cpu), tile_task, &cpu);
    visible_buffers_empty(&device->visible, pool_threads(device->pool));
    base->report.tiles_ms = milliseconds_since(&clock) + (cpu.fragment_stores ? device->visible.search_ms : 0);
    fill_report(&base->report, device);
    return ok && step_done(&cpu, error);
}

// --- making the device

lam_device *lam_device_cpu(const lam_cpu_params *params, lam_error *error)
{
    static const struct device_type type = {cpu_draw, cpu_memory, cpu_free, .release = cpu_release,
                                            .makes_normals = true};
    static const lam_cpu_params plain = {0};
    if (!params)
        params = &plain;
    if (!check_reserved("lam_cpu_params", params, error))
        return NULL;
    if (params->threads < 0 || params->threads > 1024) {
        fail(error, LAM_BAD_ARGUMENT, "cpu: threads is %d, expected 1 to 1024, or 0 for one per processor",
             params->threads);
        return NULL;
    }
    lam_isa isa = params->isa == LAM_ISA_AUTO ? widest_isa() : params->isa;
    const struct kernels *kernels = kernels_of(isa);
    if (!kernels) {
        const char *name = lam_isa_name(params->isa);
        fail(error, LAM_UNSUPPORTED, "cpu: %s has no instruction set '%s'; '%s' is the widest here",
             name ? "this processor or build" : "lambent", name ? name : "?", lam_isa_name(widest_isa()));
        return NULL;
    }
    struct cpu_device *device = calloc(1, sizeof *device);
    struct pool *pool = pool_make(params->threads);
    struct thread_state *threads = pool ? calloc((size_t)pool_threads(pool), sizeof *threads) : NULL;
    struct thread_bins *bins = pool ? calloc((size_t)pool_threads(pool), sizeof *bins) : NULL;
    if (!device || !pool || !threads || !bins) {
        fail_memory(error, sizeof *device);
        free(device);
        pool_free(pool);
        free(threads);
        free(bins);
        return NULL;
    }
    device->base.type = &type;
    device->base.isa = isa;
    device->base.threads = pool_threads(pool);
    device->kernels = kernels;
    device->pool = device->base.pool = pool;
    device->thread_count = pool_threads(pool);
    device->threads = threads;
    device->bins = bins;
    device->visible.vertices = &device->memory.vertices;
    for (int i = 0; i < 256; i++) {
        device->decode_srgb[i] = (float)srgb_linear(i / 255.0);
        device->decode_linear[i] = (float)(i / 255.0);
    }
    snprintf(device->base.name, sizeof device->base.name, "cpu %s, %d thread%s", kernels->name, device->thread_count,
             device->thread_count == 1 ? "" : "s");
    return &device->base;
}
