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
