// camera.c: the camera's defaults, its matrix, and the named sides of a scene.
#include <lambent/camera.h>

#include "camera_lens.h"
#include "fail.h"
#include "float_state.h"

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
    const struct camera_lens lens = camera_lens_of(camera, width, height);
    const double along = flat ? 1 : -p.z;
    *x = lens.middle[0] + p.x / (along * lens.pixel[0]);
    *y = lens.middle[1] - p.y / (along * lens.pixel[1]);
    float_state_leave(state);
    return true;
}

struct camera_lens camera_lens_of(const lam_camera *camera, int width, int height)
{
    if (camera_is_calibrated(camera)) {
        const double x = camera->width ? (double)width / camera->width : 1,
                     y = camera->height ? (double)height / camera->height : 1;
        return (struct camera_lens){{1 / (camera->fx * x), 1 / (camera->fy * y)}, {camera->cx * x, camera->cy * y}};
    }
    const double half = camera->ortho_half_height > 0 ? camera->ortho_half_height : math_tan(0.5 * camera->fovy_rad),
                 size = 2 * half / height;
    return (struct camera_lens){{size, size}, {0.5 * width, 0.5 * height}};
}

lam_mat4 camera_projection(const lam_camera *camera, int width, int height, double near_plane, double far_plane)
{
    const double aspect = (double)width / height;
    if (camera->ortho_half_height > 0)
        return mat4_orthographic(camera->ortho_half_height, aspect, near_plane, far_plane);
    if (!camera_is_calibrated(camera))
        return mat4_perspective(camera->fovy_rad, aspect, near_plane, far_plane);
    const double w = camera->width ? camera->width : width, h = camera->height ? camera->height : height;
    lam_mat4 m = mat4_perspective(PI / 2, 1, near_plane, far_plane);
    m.m[0][0] = 2 * camera->fx / w;
    m.m[1][1] = 2 * camera->fy / h;
    m.m[0][2] = 1 - 2 * camera->cx / w;
    m.m[1][2] = 2 * camera->cy / h - 1;
    return m;
}

// --- pose and intrinsics

bool lam_camera_intrinsics(const lam_camera *camera, int width, int height, lam_camera_convention convention,
                           double intrinsics[4])
{
    if (camera->ortho_half_height > 0)
        return false;
    uint64_t state = float_state_enter();
    const struct camera_lens lens = camera_lens_of(camera, width, height);
    const double corner = convention == LAM_CONVENTION_OPENCV ? 0.5 : 0; // from the first pixel's centre to its corner
    const bool given = camera_is_calibrated(camera) && !camera->width;   // not rounded
    intrinsics[0] = given ? camera->fx : 1 / lens.pixel[0];
    intrinsics[1] = given ? camera->fy : 1 / lens.pixel[1];
    intrinsics[2] = lens.middle[0] - corner;
    intrinsics[3] = lens.middle[1] - corner;
    float_state_leave(state);
    return true;
}

lam_mat4 lam_camera_pose(const lam_camera *camera, lam_camera_convention convention)
{
    uint64_t state = float_state_enter();
    const lam_mat4 view = mat4_look_at(camera->eye, camera->target, camera->up);
    const double eye[3] = {camera->eye.x, camera->eye.y, camera->eye.z},
                 sign = convention == LAM_CONVENTION_OPENCV ? -1 : 1;
    lam_mat4 pose = lam_mat4_identity();
    for (int i = 0; i < 3; i++) {
        pose.m[i][0] = view.m[0][i];
        pose.m[i][1] = sign * view.m[1][i];
        pose.m[i][2] = sign * view.m[2][i];
        pose.m[i][3] = eye[i];
    }
    float_state_leave(state);
    return pose;
}

static bool pose_check(const lam_mat4 *pose, lam_error *error)
{
    const double near = 1e-3; // six digits in a text file are enough
    static const char *const names[] = {"first", "second", "third"};
    const double *last = pose->m[3];
    if (last[0] != 0 || last[1] != 0 || last[2] != 0 || last[3] != 1)
        return fail(error, LAM_BAD_ARGUMENT, "pose: the last row is %g, %g, %g, %g, expected 0, 0, 0, 1", last[0],
                    last[1], last[2], last[3]);
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            double product = 0;
            for (int k = 0; k < 3; k++)
                product += pose->m[k][i] * pose->m[k][j];
            if (i == j && !(product > 1 - 2 * near && product < 1 + 2 * near))
                return fail(error, LAM_BAD_ARGUMENT, "pose: the %s column has the length %.6g, expected 1", names[i],
                            math_sqrt(product));
            if (i != j && !(product > -near && product < near))
                return fail(error, LAM_BAD_ARGUMENT,
                            "pose: the %s and the %s column are not orthogonal (their product is %.6g)", names[i],
                            names[j], product);
        }
    return mat4_determinant3(pose) > 0 ||
           fail(error, LAM_BAD_ARGUMENT, "pose: the matrix mirrors, expected a rotation (the determinant is -1)");
}

bool lam_camera_set_pose(lam_camera *camera, const lam_mat4 *pose, lam_camera_convention convention, lam_error *error)
{
    uint64_t state = float_state_enter();
    const bool ok = pose_check(pose, error);
    if (ok) {
        const double sign = convention == LAM_CONVENTION_OPENCV ? -1 : 1;
        const lam_vec3 eye = v3(pose->m[0][3], pose->m[1][3], pose->m[2][3]),
                       back = v3(sign * pose->m[0][2], sign * pose->m[1][2], sign * pose->m[2][2]);
        // as far away as the eye is from the origin, so that rounding does not change the direction
        camera->eye = eye;
        camera->target = v3_sub(eye, v3_scale(back, 1 + v3_length(eye)));
        camera->up = v3(sign * pose->m[0][1], sign * pose->m[1][1], sign * pose->m[2][1]);
    }
    float_state_leave(state);
    return ok;
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
