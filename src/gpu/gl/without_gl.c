// without_gl.c: replaces this folder in builds without the headers of EGL and OpenGL.
#include "fail.h"

#include <lambent/gl.h>

static bool left_out(lam_error *error)
{
    return fail(error, LAM_UNSUPPORTED,
                "OpenGL: this build of lambent does not support it; install the headers and build again "
                "(on Debian: apt install libegl-dev libgl-dev)");
}

int lam_gl_devices(const lam_gl_params *params, lam_gl_device *devices, int capacity, lam_error *error)
{
    (void)params, (void)devices, (void)capacity;
    left_out(error);
    return -1;
}

lam_device *lam_device_gl(const lam_gl_params *params, lam_error *error)
{
    (void)params;
    left_out(error);
    return NULL;
}
