// without_gl.c: replaces the drawing functions in builds without the headers of EGL and OpenGL.
#include "fault_shader.h"

#include <stddef.h>

#include "fail.h"

static bool left_out(lam_error *error)
{
    return fail(error, LAM_UNSUPPORTED,
                "check: this build has no OpenGL; building it in needs the headers (on Debian: apt install libegl-dev "
                "libgl-dev)");
}

bool lam_check_draw(const void *request, size_t size, const char *gl_device, lam_bytes *drawn, lam_error *error)
{
    (void)request, (void)size, (void)gl_device, (void)drawn;
    return left_out(error);
}

struct fault_shader *fault_shader_open(const char *gl_device, int size, int stride, lam_error *error)
{
    (void)gl_device, (void)size, (void)stride;
    left_out(error);
    return NULL;
}

void fault_shader_close(struct fault_shader *shader) { (void)shader; }

bool fault_shader_draws(const struct fault_shader *shader, int size, int stride)
{
    (void)shader, (void)size, (void)stride;
    return false;
}

void fault_shader_rest(struct fault_shader *shader) { (void)shader; }

bool fault_shader_wake(struct fault_shader *shader, lam_error *error)
{
    (void)shader;
    return left_out(error);
}

bool fault_shader_draw(struct fault_shader *shader, const struct reference_scene *reference_scene,
                       const struct shader_interface *interface, int capacity, lam_light_frame frame,
                       lam_reflection reflection, const fault_set *set, float *pixels, lam_error *error)
{
    (void)shader, (void)reference_scene, (void)interface, (void)capacity, (void)frame, (void)reflection, (void)set,
        (void)pixels;
    return left_out(error);
}
