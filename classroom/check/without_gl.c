// without_gl.c: replaces the OpenGL painter in builds without the headers of EGL and OpenGL. In such builds, the caller
// must provide a painter.
#include "draw_request.h"

#include <stddef.h>

#include "fail.h"

static void *open(void *user, lam_check_language language, int size, char renderer[128], lam_error *error)
{
    (void)user, (void)language, (void)size, (void)renderer;
    fail(error, LAM_UNSUPPORTED,
         "check: this build does not include OpenGL; to include it, install the headers (on Debian: apt install "
         "libegl-dev libgl-dev) and build again");
    return NULL;
}

lam_check_painter gl_painter(const char *device)
{
    (void)device;
    return (lam_check_painter){.open = open};
}
