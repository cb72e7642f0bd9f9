// device.c: the front of all devices: checks arguments, builds the frame, fills the report.
#include "device_type.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "pixels.h"

#include <string.h>

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
    if (!format_has_alpha(image->format)) { // the background over black
        lam_rgba *back = &drawn.background;
        *back = (lam_rgba){back->r * back->a, back->g * back->a, back->b * back->a, 1};
    }
    lam_image target = *image;
    target.stride = image_stride(image);
    struct call_control call;
    call_start(&call, control);
    // Memory that the device holds already counts towards the budget.
    uint64_t held = device->type->memory(device) + device->frame.storage.capacity;
    memset(&device->report, 0, sizeof device->report);
    if (!call_charge(&call, held))
        return call_memory_error(&call, held, error);
    uint64_t state = float_state_enter();
    bool ok = frame_build(&device->frame, scene, camera, &drawn, image->width, image->height, &call, error);
    device->report.frame_ms = (double)(now_ns() - call.start_ns) * 1e-6;
    device->report.triangles = device->frame.triangle_count;
    device->report.depth_near = (double)device->frame.depth_near;
    device->report.depth_far = (double)device->frame.depth_far;
    if (ok && device->frame.makes_normals && !device->type->makes_normals)
        ok = fail(error, LAM_UNSUPPORTED,
                  "lam_draw: meshes of the scene have no normals (normals_when_drawn), which this device "
                  "does not make; "
                  "lam_scene_make_normals does");
    if (ok && device->frame.shadows && !device->type->casts_shadows)
        ok = fail(error, LAM_UNSUPPORTED, "the device '%s' draws no shadows, the CPU device does", device->name);
    const struct frame_ground *ground = &device->frame.ground;
    if (ok && params->ground && !device->type->draws_ground)
        ok = fail(error, LAM_UNSUPPORTED, "the device '%s' draws no ground, the CPU device does", device->name);
    if (ok && ground->kind) {
        device->report.ground = true;
        device->report.ground_height = v3_dot(ground->middle, ground->up);
        device->report.ground_square = ground->kind == LAM_GROUND_CHECKER ? ground->square : 0;
    }
    ok = ok && device->type->draw(device, &device->frame, &target, &call, error);
    device->report.total_ms = (double)(now_ns() - call.start_ns) * 1e-6;
    device->report.memory_bytes = device->type->memory(device) + device->frame.storage.capacity;
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

const char *lam_device_name(const lam_device *device) { return device ? device->name : NULL; }
lam_isa lam_device_isa(const lam_device *device) { return device ? device->isa : LAM_ISA_AUTO; }
int lam_device_threads(const lam_device *device) { return device ? device->threads : 0; }

void lam_device_free(lam_device *device)
{
    if (!device)
        return;
    frame_free(&device->frame);
    device->type->free(device);
}
