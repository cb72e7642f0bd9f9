// limit_options.c: converts the limits set by options to the library's limits.
#include "limit_options.h"
#include "console.h"

#include <lambent/gl.h>

#include <math.h>

enum { SHARE = 4, DEFAULT_SECONDS = 600 };

uint64_t limits_memory(const struct options *options)
{
    static uint64_t kept; // 0 before the first call; kept because the system's limits rarely change
    if (options->limits.memory_limit_bytes)
        return options->limits.memory_limit_bytes == UINT64_MAX ? 0 : options->limits.memory_limit_bytes;
    uint64_t available = __atomic_load_n(&kept, __ATOMIC_RELAXED);
    if (!available) {
        available = lam_memory_available();
        __atomic_store_n(&kept, available, __ATOMIC_RELAXED);
    }
    if (available == UINT64_MAX)
        return 0;
    uint64_t share = available / SHARE / (uint64_t)(options->limits.in_flight > 1 ? options->limits.in_flight : 1);
    return share ? share : 1;
}

double limits_time(const struct options *options)
{
    return options->limits.time_limit_s > 0 ? (isinf(options->limits.time_limit_s) ? 0 : options->limits.time_limit_s)
                                            : DEFAULT_SECONDS;
}

lam_control limits_control(const struct options *options)
{
    return (lam_control){.time_limit_s = limits_time(options),
                         .memory_limit_bytes = limits_memory(options),
                         .triangle_limit = options->limits.triangle_limit,
                         .pixel_limit = options->limits.pixel_limit,
                         .file_limit_bytes = options->limits.file_limit_bytes,
                         .json_depth_limit = (uint64_t)options->limits.json_depth_limit,
                         .expansion_limit = options->limits.expansion_limit,
                         .object_limit = options->limits.object_limit,
                         .layer_limit = options->limits.layer_limit};
}

// --- creates the device that the options select: `--device`, `--gl-device`, `--texture-filter`, `--isa` and
// `--threads`.

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
