// camera.c: the camera's defaults, and fitting it to a scene.
#include <lambent/camera.h>

#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "up_axis.h"
#include "view_extents.h"

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

static struct view_axes axes_of(const lam_scene *scene, const lam_view *view, lam_vec3 centre)
{
    double azimuth = view->from_angles ? view->azimuth_rad : math_radians(30);
    double elevation = view->from_angles ? view->elevation_rad : math_radians(20);
    double sin_azimuth = math_sin(azimuth), cos_azimuth = math_cos(azimuth), sin_elevation = math_sin(elevation),
           cos_elevation = math_cos(elevation);
    lam_up up = lam_scene_up(scene);
    // Seen from above, `right` still follows the azimuth: the view does not tumble.
    return (struct view_axes){
        .right = from_y_up(up, v3(cos_azimuth, 0, -sin_azimuth)),
        .above = from_y_up(up, v3(-sin_azimuth * sin_elevation, cos_elevation, -cos_azimuth * sin_elevation)),
        .back = from_y_up(up, v3(sin_azimuth * cos_elevation, sin_elevation, cos_azimuth * cos_elevation)),
        .centre = centre,
    };
}

// The world point at (x, y, z) in the axes of the view.
static lam_vec3 to_world(const struct view_axes *axes, double x, double y, double z)
{
    lam_vec3 across = v3_add(v3_scale(axes->right, x), v3_scale(axes->above, y));
    return v3_add(axes->centre, v3_add(across, v3_scale(axes->back, z)));
}

// Orthographic: centred on the box of the view extents, half its size divided by the fill.
static lam_camera fit_orthographic(const lam_scene *scene, const struct view_axes *axes, double aspect, double fill)
{
    struct view_extents box = {0};
    view_extents_find(scene, axes, &box);
    double right = box.value[EXTENT_RIGHT], left = box.value[EXTENT_LEFT], top = box.value[EXTENT_TOP],
           bottom = box.value[EXTENT_BOTTOM], front = box.value[EXTENT_FRONT];
    double half_width = (right + left) / 2, half_height = (top + bottom) / 2;
    double half = half_height > half_width / aspect ? half_height : half_width / aspect;
    double size = half > 0 ? half : 1, x = (right - left) / 2, y = (top - bottom) / 2;
    return (lam_camera){.eye = to_world(axes, x, y, front + 2 * size),
                        .target = to_world(axes, x, y, front),
                        .up = axes->above,
                        .ortho_half_height = size / fill};
}

// Centres the horizontal (vertical) axis for an eye at ez: finds the k at which the vertices touch x = ex ± k·(ez − z)
// on both sides. That k is the root of R(k) + L(k) − 2k·ez, which is convex and piecewise linear, its slope between two
// corners given by the vertices that have the maxima R and L. A step of Newton's method,
//
//   k = (x_R − x_L) / (2ez − z_R − z_L)
//
// therefore lands at the root or to its left, from where the steps only grow: when they stop growing, the root is found
// exactly. No number in it depends on where the scene lies.
static void centre_axis(const lam_scene *scene, const struct view_axes *axes, bool horizontal, double ez,
                        struct view_extents *extents)
{
    double k = horizontal ? extents->kx : extents->ky;
    for (int step = 0;; step++) {
        const lam_vec3 *plus = &extents->point[horizontal ? EXTENT_RIGHT : EXTENT_TOP], *minus = plus + 1;
        double width = horizontal ? plus->x - minus->x : plus->y - minus->y;
        double next = width / (2 * ez - plus->z - minus->z);
        if (next == k || (step > 0 && !(next > k)))
            return;
        k = next;
        if (horizontal)
            view_extents_horizontal(scene, axes, k, extents);
        else
            view_extents_vertical(scene, axes, k, extents);
    }
}

// Perspective, for one axis of the picture. A vertex is visible if
//
//   ±(x − ex) ≤ k·(ez − z),   that is   ±x + k·z ≤ ±ex + k·ez
//
// With R and L the maxima of x + k·z and −x + k·z, both sides touch the frame at
//
//   ex = (R − L)/2,   ez = (R + L)/(2k)
//
// which is exact and takes one pass over the vertices. The axis with the larger ez determines it. The other axis
// is centred with the smaller k at which it would touch the frame at this ez.
static lam_camera fit_perspective(const lam_scene *scene, const struct view_axes *axes, double fovy, double aspect,
                                  double fill)
{
    struct view_extents extents = {.ky = math_tan(fovy / 2) * fill};
    extents.kx = extents.ky * aspect;
    view_extents_find(scene, axes, &extents);
    const double *at = extents.value, front = at[EXTENT_FRONT];
    double ez_x = (at[EXTENT_RIGHT] + at[EXTENT_LEFT]) / (2 * extents.kx),
           ez_y = (at[EXTENT_TOP] + at[EXTENT_BOTTOM]) / (2 * extents.ky);
    double ez = ez_x > ez_y ? ez_x : ez_y;
    if (!(ez > front)) // a single point, or a line along the view
        ez = front + 1;
    centre_axis(scene, axes, !(ez_x > ez_y), ez, &extents);
    double x = (at[EXTENT_RIGHT] - at[EXTENT_LEFT]) / 2, y = (at[EXTENT_TOP] - at[EXTENT_BOTTOM]) / 2;
    return (lam_camera){
        .eye = to_world(axes, x, y, ez), .target = to_world(axes, x, y, front), .up = axes->above, .fovy_rad = fovy};
}

lam_camera lam_camera_fit(const lam_scene *scene, int width, int height, const lam_view *view)
{
    static const lam_view defaults = {0};
    if (!view)
        view = &defaults;
    if (!check_reserved("lam_view", view, NULL)) {
        lam_camera refused = lam_camera_default();
        refused.reserved[0] = 1;
        return refused;
    }
    uint64_t state = float_state_enter();
    lam_vec3 centre;
    if (!view_extents_centre(scene, &centre)) {
        float_state_leave(state);
        return lam_camera_default();
    }
    struct view_axes axes = axes_of(scene, view, centre);
    double aspect = (double)(width > 1 ? width : 1) / (height > 1 ? height : 1);
    double fill = view->fill > 0 ? view->fill : 0.92;
    double fovy = view->fovy_rad > 0 && view->fovy_rad < PI ? view->fovy_rad : math_radians(30);
    double zoom = view->zoom > 0 ? view->zoom : 1;
    lam_camera camera = view->orthographic ? fit_orthographic(scene, &axes, aspect, fill)
                                           : fit_perspective(scene, &axes, fovy, aspect, fill);
    // Zoom narrows the view instead of moving the eye, which could enter the model.
    if (camera.ortho_half_height > 0)
        camera.ortho_half_height /= zoom;
    else
        camera.fovy_rad = 2 * math_atan2(math_tan(fovy / 2), zoom);
    float_state_leave(state);
    return camera;
}
