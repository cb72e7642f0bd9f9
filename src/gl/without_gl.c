// without_gl.c: in place of this folder where the headers of EGL and OpenGL were not there to build it.
#include "fail.h"

#include <lambent/gl.h>

static bool left_out(lam_error *error)
{
    return fail(error, LAM_UNSUPPORTED,
                "OpenGL: this build of lambent has none; it is built in where the headers are "
                "installed (on Debian: apt install libegl-dev libgl-dev)");
}

int lam_gl_devices(const lam_gl_params *params, lam_gl_device *devices, int room, lam_error *error)
{
    (void)params, (void)devices, (void)room;
    left_out(error);
    return -1;
}

lam_device *lam_device_gl(const lam_gl_params *params, lam_error *error)
{
    (void)params;
    left_out(error);
    return NULL;
}
