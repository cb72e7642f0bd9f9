// gl_enumerate.c: implements lam_gl_devices: lists the OpenGL devices, and tries to make a context on each device.
#include "context.h"

#include "fail.h"

#include <stdio.h>
#include <string.h>

static void try_platform(const struct egl *egl, const struct gl_platform *platform, int number, lam_gl_device *out)
{
    static const struct {
        enum gl_profile profile;
        const char *name;
    } tries[] = {{GL_PROFILE_CORE, "OpenGL 3.3"}, {GL_PROFILE_ES, "OpenGL ES 3.0"}};
    *out = (lam_gl_device){.number = number, .software = platform->software};
    snprintf(out->path, sizeof out->path, "%s", platform->name);
    for (int i = 0; i < 2; i++) {
        struct gl_context context;
        lam_error why;
        if (!gl_context_open(&context, egl, platform, tries[i].profile, false, &why)) {
            if (!*out->reason)
                snprintf(out->reason, sizeof out->reason, "%.190s", why.text);
            continue;
        }
        size_t length = strlen(out->versions);
        snprintf(out->versions + length, sizeof out->versions - length, "%s%s", length ? ", " : "", tries[i].name);
        if (!out->usable) {
            snprintf(out->name, sizeof out->name, "%s", context.renderer);
            snprintf(out->driver, sizeof out->driver, "%s", context.driver);
            out->software |= context.software;
        }
        out->usable = true;
        gl_context_free(&context);
    }
    if (out->usable)
        *out->reason = 0;
}

int lam_gl_devices(const lam_gl_params *params, lam_gl_device *devices, int capacity, lam_error *error)
{
    struct egl egl;
    struct gl_platform platforms[GL_PLATFORMS_MAX];
    if (params && !check_reserved("lam_gl_params", params, error))
        return -1;
    if (!egl_open(&egl, params ? params->library : NULL, error))
        return -1;
    int count = gl_platforms(&egl, platforms);
    for (int i = 0; i < count && i < capacity; i++)
        try_platform(&egl, &platforms[i], i, &devices[i]);
    return count;
}
