// camera_orbit.c: a camera that orbits a point, pans and zooms.
#include <lambent/camera.h>

#include "float_state.h"
#include "linear.h"
#include "up_axis.h"

struct orbit_axes {
    lam_vec3 right, above, back; // unit axes of the picture in world space
};

static struct orbit_axes axes_of(const lam_orbit *orbit)
{
    const double sin_a = math_sin(orbit->azimuth_rad), cos_a = math_cos(orbit->azimuth_rad),
                 sin_e = math_sin(orbit->elevation_rad), cos_e = math_cos(orbit->elevation_rad);
    return (struct orbit_axes){
        .right = from_y_up(orbit->up, v3(cos_a, 0, -sin_a)),
        .above = from_y_up(orbit->up, v3(-sin_a * sin_e, cos_e, -cos_a * sin_e)),
        .back = from_y_up(orbit->up, v3(sin_a * cos_e, sin_e, cos_a * cos_e)),
    };
}

lam_orbit lam_orbit_of(const lam_camera *camera, const lam_scene *scene)
{
    const uint64_t state = float_state_enter();
    lam_orbit orbit = {.target = camera->target,
                       .fovy_rad = camera->fovy_rad,
                       .ortho_half_height = camera->ortho_half_height,
                       .up = lam_scene_up(scene)};
    const lam_vec3 away = v3_sub(camera->eye, camera->target), back = v3_unit(away), at = to_y_up(orbit.up, back);
    orbit.distance = v3_length(away);
    lam_vec3 low, high;
    if (lam_scene_bounds(scene, &low, &high)) {
        const lam_vec3 middle = v3_scale(v3_add(low, high), 0.5);
        const double distance = v3_dot(v3_sub(camera->eye, middle), back);
        if (distance > 0) {
            orbit.target = v3_sub(camera->eye, v3_scale(back, distance));
            orbit.distance = distance;
        }
    }
    const double level = math_sqrt(at.x * at.x + at.z * at.z);
    orbit.elevation_rad = math_atan2(at.y, level);
    if (level > 1e-9) {
        orbit.azimuth_rad = math_atan2(at.x, at.z);
    } else { // straight up or down: use the picture's up direction
        const lam_vec3 above = v3_scale(to_y_up(orbit.up, camera->up), at.y > 0 ? -1 : 1);
        orbit.azimuth_rad = math_atan2(above.x, above.z);
    }
    float_state_leave(state);
    return orbit;
}

lam_camera lam_orbit_camera(const lam_orbit *orbit)
{
    const uint64_t state = float_state_enter();
    const struct orbit_axes axes = axes_of(orbit);
    lam_camera camera = {.eye = v3_add(orbit->target, v3_scale(axes.back, orbit->distance)),
                         .target = orbit->target,
                         .up = axes.above,
                         .fovy_rad = orbit->fovy_rad,
                         .ortho_half_height = orbit->ortho_half_height};
    for (int i = 0; i < 8; i++) // sets a field that this version does not know, so that every call rejects the camera
        camera.reserved[0] |= orbit->reserved[i];
    float_state_leave(state);
    return camera;
}

void lam_orbit_turn(lam_orbit *orbit, double right_rad, double up_rad)
{
    if (!math_finite(right_rad) || !math_finite(up_rad))
        return;
    const double elevation = orbit->elevation_rad + up_rad;
    orbit->azimuth_rad += right_rad;
    orbit->elevation_rad = elevation > PI / 2 ? PI / 2 : elevation < -PI / 2 ? -PI / 2 : elevation;
}

void lam_orbit_pan(lam_orbit *orbit, double right, double up)
{
    if (!math_finite(right) || !math_finite(up))
        return;
    const uint64_t state = float_state_enter();
    const struct orbit_axes axes = axes_of(orbit);
    const double height =
        2 * (orbit->ortho_half_height > 0 ? orbit->ortho_half_height : orbit->distance * math_tan(orbit->fovy_rad / 2));
    orbit->target =
        v3_add(orbit->target, v3_add(v3_scale(axes.right, right * height), v3_scale(axes.above, up * height)));
    float_state_leave(state);
}

void lam_orbit_zoom(lam_orbit *orbit, double factor)
{
    if (!math_finite(factor) || !(factor > 0))
        return;
    if (orbit->ortho_half_height > 0)
        orbit->ortho_half_height /= factor;
    else
        orbit->distance /= factor;
}
