// device_option.c: creates the device that the options select: `--device`, `--gl-device`, `--texture-filter`, `--isa`
// and `--threads`.
#include "device_option.h"

#include "console.h"

#include <lambent/gl.h>

lam_device *device_option_make(const struct options *o, lam_error *error)
{
    bool gl = o->shader.lecture_device || o->work.device == DEVICE_GL || o->work.device == DEVICE_GLES ||
              (o->work.device == DEVICE_AUTO && o->work.gl_device);
    if (o->work.gl_device && !gl) {
        complain(error, LAM_BAD_ARGUMENT, "options '--device cpu' and '--gl-device' cannot be used together");
        return NULL;
    }
    if (gl && o->work.isa)
        return complain(error, LAM_BAD_ARGUMENT, "option '--isa' applies to the CPU device, not to OpenGL"), NULL;
    bool hardware_filter = o->work.texture_filter == TEXTURE_FILTER_HARDWARE;
    if (hardware_filter && !gl) {
        complain(error, LAM_BAD_ARGUMENT,
                 "option '--texture-filter hardware' applies to OpenGL ('--device gl'), not to the CPU device");
        return NULL;
    }
    if (gl) {
        lam_gl_params params = {.api = o->work.device == DEVICE_GLES ? LAM_GL_ES : LAM_GL_CORE,
                                .device = o->work.gl_device,
                                .lecture = o->shader.lecture_device,
                                .mistake = o->shader.lecture_device ? o->shader.mistake : NULL,
                                .hardware_filter = hardware_filter};
        return lam_device_gl(&params, error);
    }
    lam_cpu_params params = {.threads = o->work.threads, .isa = (lam_isa)o->work.isa};
    return lam_device_cpu(&params, error);
}

bool device_option_is_gl(const struct options *o)
{
    return o->work.device == DEVICE_GL || o->work.device == DEVICE_GLES ||
           (o->work.device == DEVICE_AUTO && o->work.gl_device);
}
