// camera.c: the camera's defaults and its matrix.
#include <lambent/camera.h>

#include "float_state.h"
#include "linear.h"

lam_camera lam_camera_default(void)
{
    return (lam_camera){.eye = {0, 0, 4}, .up = {0, 1, 0}, .fovy_rad = 30 * (PI / 180)};
}

lam_mat4 lam_camera_view_matrix(const lam_camera *camera)
{
    uint64_t state = float_state_enter();
    lam_mat4 view = mat4_look_at(camera->eye, camera->target, camera->up);
    float_state_leave(state);
    return view;
}

bool lam_camera_project(const lam_camera *camera, int width, int height, lam_vec3 p, double *x, double *y)
{
    bool flat = camera->ortho_half_height > 0;
    if (!flat && !(p.z < 0))
        return false;
    uint64_t state = float_state_enter();
    double half = flat ? camera->ortho_half_height : -p.z * math_tan(camera->fovy_rad / 2);
    double pixels = height / (2 * half); // pixels per model unit
    *x = width / 2.0 + p.x * pixels;
    *y = height / 2.0 - p.y * pixels;
    float_state_leave(state);
    return true;
}
