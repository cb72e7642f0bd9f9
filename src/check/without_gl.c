// without_gl.c: in place of what draws, where the headers of EGL and OpenGL were not there to build it.
#include "fault_shader.h"

#include <stddef.h>

#include "fail.h"

static bool left_out(lam_error *error)
{
    return fail(error, LAM_UNSUPPORTED,
                "check: this build of lambent has no OpenGL; it is built in where the headers are installed "
                "(on Debian: "
                "apt install libegl-dev libgl-dev)");
}

bool lam_check_draw(const void *job, size_t size, const char *gl_device, lam_bytes *drawn, lam_error *error)
{
    (void)job, (void)size, (void)gl_device, (void)drawn;
    return left_out(error);
}

struct fault_shader *fault_shader_open(const char *gl_device, int size, lam_error *error)
{
    (void)gl_device, (void)size;
    left_out(error);
    return NULL;
}

void fault_shader_close(struct fault_shader *model) { (void)model; }

bool fault_shader_draw(struct fault_shader *model, const struct reference_scene *reference_scene,
                       const struct shader_interface *reading, int room, lam_light_frame frame,
                       lam_reflection reflection, fault_set set, float *pixels, lam_error *error)
{
    (void)model, (void)reference_scene, (void)reading, (void)room, (void)frame, (void)reflection, (void)set,
        (void)pixels;
    return left_out(error);
}
