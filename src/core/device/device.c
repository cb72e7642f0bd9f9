// device.c: the common entry points of all devices, which check arguments, build the frame and fill the report.
#include "device_type.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "pixels.h"
#include "pool.h"
#include "denoised.h"
#include "path_passes.h"
#include "sky.h"

#include <stdio.h>
#include <string.h>

// Returns the size of the memory in struct lam_device, without the memory that the device's type adds.
static uint64_t own_memory(const lam_device *device)
{
    return device->frame.storage.capacity + hierarchy_bytes(&device->hierarchy) + edges_bytes(&device->edges);
}

// Finds the edges that are drawn over the picture.
static bool find_edges(lam_device *device, struct call_control *call, lam_error *error)
{
    // The largest number of rays traced at a time, for each instruction set. The entry LAM_ISA_AUTO is for devices to
    // which instruction sets do not apply.
    static const int lanes[LAM_ISA_COUNT] = {
        [LAM_ISA_AUTO] = 16,   [LAM_ISA_SCALAR] = 1, [LAM_ISA_SSE4] = 4, [LAM_ISA_AVX2] = 8,
        [LAM_ISA_AVX512] = 16, [LAM_ISA_NEON] = 4,   [LAM_ISA_WASM] = 4};
    lam_frame_report *report = &device->report;
    uint64_t start = now_ns();
    bool built;
    bool needed = edges_need_rays(&device->frame);
    const struct hierarchy *hierarchy =
        needed ? hierarchy_of_frame(&device->hierarchy, &device->frame, device->pool, call, &built, error) : NULL;
    uint64_t found = now_ns();
    report->hierarchy_ms = needed && built ? (double)(found - start) * 1e-6 : 0;
    struct edge_counts counts = {0};
    if ((needed && !hierarchy) ||
        !edges_find(&device->edges, &device->frame, hierarchy, lanes[device->isa], device->pool, call, &counts, error))
        return false;
    report->edges_drawn = counts.drawn;
    report->edge_rays = counts.rays;
    report->edges_ms = (double)(now_ns() - found) * 1e-6;
    return true;
}

// Draws the frame, then the edges over it. If surfaces are off, they still hide edges, so the frame is built twice:
// first with the surfaces, then without them.
static bool draw_frame(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                       const lam_draw_params *params, struct path_pictures *denoised, lam_image *target,
                       struct call_control *call, lam_error *error)
{
    if (device->frame.draws_edges && !find_edges(device, call, error))
        return false;
    lam_draw_params lines = *params;
    lines.ground = LAM_GROUND_NONE;
    if (params->no_surfaces &&
        !frame_build(&device->frame, scene, camera, &lines, target->width, target->height, call, error))
        return false;
    if (!(path_passes_are_drawn(&device->frame) || sky_is_drawn(&device->frame)
              ? sky_draw(device, denoised, target, call, error)
              : device->type->draw(device, &device->frame, target, call, error)))
        return false;
    if (device->frame.draws_edges)
        edges_blend(&device->edges, &device->frame, target, device->pool);
    return true;
}

static bool draw_once(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                      const lam_draw_params *params, lam_image *target, struct call_control *call, lam_error *error)
{
    // Memory that the device already uses counts towards the budget.
    uint64_t held = device->type->memory(device) + own_memory(device);
    memset(&device->report, 0, sizeof device->report);
    if (!call_charge(call, held))
        return call_memory_error(call, held, error);
    lam_draw_params whole = *params;
    whole.no_surfaces = false;
    struct path_pictures surfaces, *denoised = is_denoised(&whole) && !device->recorder ? &surfaces : NULL;
    bool ok = (!denoised || denoise_prepare(device, scene, camera, &whole, target, denoised, call, error)) &&
              frame_build(&device->frame, scene, camera, &whole, target->width, target->height, call, error);
    device->report.frame_ms = (double)(now_ns() - call->start_ns) * 1e-6;
    device->report.triangles = device->frame.triangle_count;
    device->report.brightened = device->frame.brightened;
    device->report.glass_materials = (uint64_t)device->frame.panes;
    device->report.depth_near = (double)device->frame.depth_near;
    device->report.depth_far = (double)device->frame.depth_far;
    if (ok && device->frame.makes_normals && !device->type->makes_normals)
        ok = fail(error, LAM_UNSUPPORTED,
                  "lam_draw: meshes of the scene have no normals (normals_when_drawn), and this device cannot compute "
                  "them; call lam_scene_make_normals");
    const struct frame_ground *ground = &device->frame.ground;
    if (ok && ground->kind && !params->no_surfaces) {
        device->report.ground = true;
        device->report.ground_height = v3_dot(ground->middle, ground->up);
        device->report.ground_square = ground->kind == LAM_GROUND_CHECKER ? ground->square : 0;
    }
    ok = ok && draw_frame(device, scene, camera, params, denoised, target, call, error);
    if (denoised)
        denoise_free(denoised, call);
    return ok;
}

// Draws with all threads, if the memory limit leaves memory to spare. Otherwise the device releases what it keeps from
// earlier frames, and one thread draws. The number of threads and the earlier frames therefore never decide whether the
// limit is sufficient.
static bool draw_within_limit(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                              const lam_draw_params *params, lam_image *target, struct call_control *call,
                              lam_error *error)
{
    // Blocks of memory that are not full may make one thread need this much more than several threads.
    enum { SPARE = 8 << 20 };
    const uint64_t limit = call->control.memory_limit_bytes;
    if (limit && device->type->release)
        call->control.memory_limit_bytes = limit > SPARE ? limit - SPARE : 1;
    bool ok = draw_once(device, scene, camera, params, target, call, error);
    if (ok || call->control.memory_limit_bytes == limit || call->refused == NO_BUDGET)
        return ok;
    call->control.memory_limit_bytes = limit;
    call->memory_used = call->unpacked = 0;
    device->type->release(device);
    frame_free(&device->frame);
    hierarchy_free(&device->hierarchy);
    edges_free(&device->edges);
    pool_set_alone(device->pool, true);
    ok = draw_once(device, scene, camera, params, target, call, error);
    pool_set_alone(device->pool, false);
    return ok;
}

bool lam_draw(lam_device *device, const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
              lam_image *image, const lam_control *control, lam_error *error)
{
    static const lam_draw_params plain = {0};
    if (!device || !scene || !camera)
        return fail(error, LAM_BAD_ARGUMENT, "lam_draw: %s is NULL", !device ? "device" : !scene ? "scene" : "camera");
    params = params ? params : &plain;
    if (!image_check(image, "lam_draw", error))
        return false;
    lam_draw_params drawn = *params;
    if (!format_has_alpha(image->format)) { // the picture is composited over black
        lam_rgba *back = &drawn.background;
        *back = (lam_rgba){back->r * back->a, back->g * back->a, back->b * back->a, 1};
    }
    lam_image target = *image;
    target.stride = image_stride(image);
    struct call_control call;
    call_start(&call, control);
    call.input_bytes = scene->input_bytes;
    call.control.expansion_limit = UINT64_MAX; // only the file reader needs this limit
    uint64_t state = float_state_enter();
    drawn.no_surfaces &= drawn.output == LAM_OUTPUT_PICTURE;
    bool ok = draw_within_limit(device, scene, camera, &drawn, &target, &call, error);
    device->report.total_ms = (double)(now_ns() - call.start_ns) * 1e-6;
    device->report.memory_bytes = device->type->memory(device) + own_memory(device);
    float_state_leave(state);
    if (ok)
        call_progress(&call, 1, "frame");
    return ok;
}

void lam_device_report(const lam_device *device, lam_frame_report *report)
{
    if (device)
        *report = device->report;
    else
        memset(report, 0, sizeof *report);
}

void lam_device_comment(const lam_device *device, char comment[LAM_COMMENT_SIZE])
{
    const double paths = device ? device->report.paths : 0, noise = device ? device->report.noise * 100 : 0;
    const long long whole = (long long)(noise + 0.5); // whole numbers, whose text does not depend on the locale
    comment[0] = 0;
    if (paths > 0)
        snprintf(comment, LAM_COMMENT_SIZE, "%lld paths of light, estimated noise %lld.%02lld of 255",
                 (long long)(paths + 0.5), whole / 100, whole % 100);
}

const char *lam_device_name(const lam_device *device) { return device ? device->name : NULL; }
lam_isa lam_device_isa(const lam_device *device) { return device ? device->isa : LAM_ISA_AUTO; }
int lam_device_threads(const lam_device *device) { return device ? device->threads : 0; }

void lam_device_free(lam_device *device)
{
    if (!device)
        return;
    frame_free(&device->frame);
    hierarchy_free(&device->hierarchy);
    edges_free(&device->edges);
    device->type->free(device);
}
