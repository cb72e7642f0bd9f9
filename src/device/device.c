// device.c: the front of all devices: checks arguments, builds the frame, fills the report.
#include "device_type.h"

#include "fail.h"
#include "float_state.h"

#include <string.h>

static bool check_image(const lam_image *image, lam_error *error)
{
    if (!image || !image->pixels)
        return fail(error, LAM_BAD_ARGUMENT, "lam_draw: the image has no pixels; lam_image_make makes them");
    if (image->width < 1 || image->width > 65535 || image->height < 1 || image->height > 65535)
        return fail(error, LAM_BAD_ARGUMENT, "lam_draw: the image is %d×%d pixels, expected 1 to 65535 each way",
                    image->width, image->height);
    if (image->format != LAM_RGBA8 && image->format != LAM_RGBA32F)
        return fail(error, LAM_BAD_ARGUMENT, "lam_draw: the image's pixel format is %d, which does not exist",
                    image->format);
    return true;
}

bool lam_draw(lam_device *device, const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
              lam_image *image, const lam_control *control, lam_error *error)
{
    static const lam_draw_params plain = {0};
    if (!device || !scene || !camera)
        return fail(error, LAM_BAD_ARGUMENT, "lam_draw: %s is NULL", !device ? "device" : !scene ? "scene" : "camera");
    if (!check_image(image, error))
        return false;
    struct call_control call;
    call_start(&call, control);
    // Memory that the device holds already counts towards the budget.
    uint64_t held = device->type->memory(device) + device->frame.storage.room;
    memset(&device->report, 0, sizeof device->report);
    if (!call_charge(&call, held))
        return call_memory_error(&call, held, error);
    uint64_t state = float_state_enter();
    bool ok =
        frame_build(&device->frame, scene, camera, params ? params : &plain, image->width, image->height, &call, error);
    device->report.frame_ms = (double)(now_ns() - call.start_ns) * 1e-6;
    device->report.triangles = device->frame.triangle_count;
    if (ok && device->frame.makes_normals && !device->type->makes_normals)
        ok = fail(error, LAM_UNSUPPORTED,
                  "lam_draw: meshes of the scene have no normals (normals_when_drawn), which this device "
                  "does not make; "
                  "lam_scene_make_normals does");
    ok = ok && device->type->draw(device, &device->frame, image, &call, error);
    device->report.total_ms = (double)(now_ns() - call.start_ns) * 1e-6;
    device->report.memory_bytes = device->type->memory(device) + device->frame.storage.room;
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
