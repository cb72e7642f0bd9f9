// camera.c: the camera's defaults, its matrix, and the named sides of a scene.
#include <lambent/camera.h>

#include "float_state.h"
#include "linear.h"

#include <string.h>

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

// --- sides

static const struct {
    const char *name;
    double azimuth_deg, elevation_deg;
} sides[LAM_SIDE_COUNT] = {
    [LAM_SIDE_THREE_QUARTER] = {"three-quarter", 30, 20},
    [LAM_SIDE_FRONT] = {"front", 0, 0},
    [LAM_SIDE_BACK] = {"back", 180, 0},
    [LAM_SIDE_LEFT] = {"left", -90, 0},
    [LAM_SIDE_RIGHT] = {"right", 90, 0},
    [LAM_SIDE_TOP] = {"top", 0, 90},
    [LAM_SIDE_BOTTOM] = {"bottom", 0, -90},
    [LAM_SIDE_ISO] = {"iso", 45, 35.264389682754654}, // atan(1/√2)
};

const char *lam_side_name(lam_side side) { return (unsigned)side < LAM_SIDE_COUNT ? sides[side].name : NULL; }

lam_side lam_side_find(const char *name)
{
    int side = 0;
    while (side < LAM_SIDE_COUNT && (!name || strcmp(sides[side].name, name) != 0))
        side++;
    return (lam_side)side;
}

lam_view lam_view_of_side(lam_side side)
{
    if ((unsigned)side >= LAM_SIDE_COUNT)
        side = LAM_SIDE_THREE_QUARTER;
    return (lam_view){.from_angles = true,
                      .azimuth_rad = math_radians(sides[side].azimuth_deg),
                      .elevation_rad = math_radians(sides[side].elevation_deg)};
}
