// camera_fit.c: places the camera so that a scene fills the picture.
#include <lambent/device.h>

#include "annotation_letter.h"
#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "scene_internal.h"
#include "up_axis.h"
#include "view_extents.h"

// The fraction of the picture's width or height that the scene fills. If a ground plane is drawn, the wider margin
// leaves space for the shadow.
#define FILL           0.92
#define FILL_ON_GROUND 0.8

static struct view_axes axes_of(const lam_scene *scene, const lam_view *view, lam_vec3 centre)
{
    double azimuth = view->from_angles ? view->azimuth_rad : math_radians(30);
    double elevation = view->from_angles ? view->elevation_rad : math_radians(20);
    double sin_azimuth = math_sin(azimuth), cos_azimuth = math_cos(azimuth), sin_elevation = math_sin(elevation),
           cos_elevation = math_cos(elevation);
    lam_up up = lam_scene_up(scene);
    // If the camera looks straight down, `right` still follows the azimuth, so that the view does not roll.
    return (struct view_axes){
        .right = from_y_up(up, v3(cos_azimuth, 0, -sin_azimuth)),
        .above = from_y_up(up, v3(-sin_azimuth * sin_elevation, cos_elevation, -cos_azimuth * sin_elevation)),
        .back = from_y_up(up, v3(sin_azimuth * cos_elevation, sin_elevation, cos_azimuth * cos_elevation)),
        .centre = centre,
    };
}

// The parameters of a fit.
struct fitting {
    struct view_axes axes;
    double aspect, fill, fovy, zoom;
    bool orthographic;
};

// Returns empty extents of a perspective view. The slopes kx and ky limit the view to the central `fraction` of the
// picture.
static struct view_extents extents_of(const struct fitting *fitting, double fraction)
{
    double ky = math_tan(fitting->fovy / 2) * fraction;
    return (struct view_extents){.kx = ky * fitting->aspect, .ky = ky};
}

// Returns the world point at (x, y, z) in the axes of the view.
static lam_vec3 to_world(const struct view_axes *axes, double x, double y, double z)
{
    lam_vec3 across = v3_add(v3_scale(axes->right, x), v3_scale(axes->above, y));
    return v3_add(axes->centre, v3_add(across, v3_scale(axes->back, z)));
}

// An orthographic camera is centred on the box of the view extents. The camera's half height is half the size of the
// box, divided by the fill.
static lam_camera fit_orthographic(const struct fitting *fitting, const struct view_points *points, double fill)
{
    const struct view_axes *axes = points->axes;
    double aspect = fitting->aspect;
    struct view_extents box = {0};
    view_extents_find(points, &box);
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

// Centres the eye horizontally or vertically, at the depth ez. Finds the k at which the points touch both sides of the
// view, x = ex ± k·(ez − z). This k is the root of F(k) = R(k) + L(k) − 2k·ez. F is convex, and piecewise linear for
// vertices; the points with the maxima R and L determine the slope of F. A step of Newton's method is:
//
//  k = (x_R − x_L) / (2ez − z_R − z_L)
//
// The first step therefore ends at the root or to the left of the root, and further steps only increase k. When k no
// longer increases, the root is found.
static void centre_axis(const struct view_points *points, bool horizontal, double ez, struct view_extents *extents)
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
            view_extents_horizontal(points, k, extents);
        else
            view_extents_vertical(points, k, extents);
    }
}

// Fits one axis of the picture in perspective. A point is visible under this condition:
//
//  ±(x − ex) ≤ k·(ez − z),   that is   ±x + k·z ≤ ±ex + k·ez
//
// Let R be the maximum of x + k·z, and L the maximum of −x + k·z. Both sides touch the frame for this eye:
//
//  ex = (R − L)/2,   ez = (R + L)/(2k)
//
// The result is exact, and computing it needs one pass over the points. The axis with the larger ez determines the
// distance. Along the other axis, the eye is centred at this ez, so that the points touch both sides for a smaller k.
static lam_camera fit_perspective(const struct fitting *fitting, const struct view_points *points, double fill)
{
    const struct view_axes *axes = points->axes;
    struct view_extents extents = extents_of(fitting, fill);
    view_extents_find(points, &extents);
    const double *at = extents.value, front = at[EXTENT_FRONT];
    double ez_x = (at[EXTENT_RIGHT] + at[EXTENT_LEFT]) / (2 * extents.kx),
           ez_y = (at[EXTENT_TOP] + at[EXTENT_BOTTOM]) / (2 * extents.ky);
    double ez = ez_x > ez_y ? ez_x : ez_y;
    // A single point, a line along the view, or a nearest point beyond which everything is in view.
    if (!(ez > front + 1e-6 * (ez < 0 ? -ez : ez))) {
        double reach = scene_radius(points->scene, axes->centre);
        ez = front + (reach > 0 ? reach : 1);
    }
    centre_axis(points, !(ez_x > ez_y), ez, &extents);
    double x = (at[EXTENT_RIGHT] - at[EXTENT_LEFT]) / 2, y = (at[EXTENT_TOP] - at[EXTENT_BOTTOM]) / 2;
    return (lam_camera){.eye = to_world(axes, x, y, ez),
                        .target = to_world(axes, x, y, front),
                        .up = axes->above,
                        .fovy_rad = fitting->fovy};
}

static lam_camera fit(const struct fitting *fitting, const struct view_points *points, double fill)
{
    return fitting->orthographic ? fit_orthographic(fitting, points, fill) : fit_perspective(fitting, points, fill);
}

// Prepares the fit of a view. Returns false if a field of the view is unknown, or if the scene has no triangles. In
// both cases, `camera` is already final.
static bool start(struct fitting *fitting, const lam_scene *scene, int width, int height, const lam_view *view,
                  double fill, lam_camera *camera)
{
    static const lam_view defaults = {0};
    if (!view)
        view = &defaults;
    *camera = lam_camera_default();
    if (!check_reserved("lam_view", view, NULL)) {
        camera->reserved[0] = 1;
        return false;
    }
    lam_vec3 centre;
    if (!view_extents_centre(scene, &centre))
        return false;
    *fitting = (struct fitting){
        .axes = axes_of(scene, view, centre),
        .aspect = (double)(width > 1 ? width : 1) / (height > 1 ? height : 1),
        .fill = view->fill > 0 ? view->fill : fill,
        .fovy = view->fovy_rad > 0 && view->fovy_rad < PI ? view->fovy_rad : math_radians(30),
        .zoom = view->zoom > 0 ? view->zoom : 1,
        .orthographic = view->orthographic,
    };
    struct view_points points = {.scene = scene, .axes = &fitting->axes, .axes_count = 1};
    *camera = fit(fitting, &points, fitting->fill);
    return true;
}

// Zooming narrows the field of view. Moving the eye instead could place the eye inside the model.
static void apply_zoom(const struct fitting *fitting, lam_camera *camera)
{
    if (camera->ortho_half_height > 0)
        camera->ortho_half_height /= fitting->zoom;
    else
        camera->fovy_rad = 2 * math_atan2(math_tan(fitting->fovy / 2), fitting->zoom);
}

// --- a rotating scene

// The number of angles that are tested for a rotating scene. Between two tested angles, a vertex moves outwards by at
// most 1 − cos(π/48) = 0.2 % of its distance from the axis.
enum { TURNS = 48 };

// Returns whether all points are within the central fraction `fraction` of the camera's picture.
static bool holds(const struct fitting *fitting, const lam_camera *camera, const struct view_points *points,
                  double fraction)
{
    const struct view_axes *axes = &fitting->axes;
    struct view_extents extents = {0};
    double half_width = 0, half_height = 0;
    if (fitting->orthographic) {
        half_height = camera->ortho_half_height * fraction;
        half_width = half_height * fitting->aspect;
    } else {
        extents = extents_of(fitting, fraction);
    }
    view_extents_find(points, &extents);
    lam_vec3 eye = v3_sub(camera->eye, points->axes[0].centre);
    double x = v3_dot(axes->right, eye), y = v3_dot(axes->above, eye), z = v3_dot(axes->back, eye);
    return extents.value[EXTENT_RIGHT] <= x + extents.kx * z + half_width &&
           extents.value[EXTENT_LEFT] <= -x + extents.kx * z + half_width &&
           extents.value[EXTENT_TOP] <= y + extents.ky * z + half_height &&
           extents.value[EXTENT_BOTTOM] <= -y + extents.ky * z + half_height;
}

// If the camera does not show the whole scene at every angle, fits the camera to the scene at all angles.
static void fit_turning(const struct fitting *fitting, const lam_scene *scene, lam_vec3 centre, lam_vec3 axis,
                        lam_camera *camera)
{
    struct view_axes axes[TURNS];
    bool any_axis = v3_length(axis) == 0;
    struct view_points points = {.scene = scene,
                                 .axes = axes,
                                 .axes_count = any_axis ? 1 : TURNS,
                                 .ball_radius = any_axis ? scene_radius(scene, centre) : 0};
    for (int i = 0; i < points.axes_count; i++) { // rotating the scene means rotating the view backwards
        lam_mat4 turn = mat4_rotate(any_axis ? 0 : 2 * PI * i / TURNS, any_axis ? v3(0, 0, 1) : axis);
        axes[i] = (struct view_axes){.right = mat4_vector(&turn, fitting->axes.right),
                                     .above = mat4_vector(&turn, fitting->axes.above),
                                     .back = mat4_vector(&turn, fitting->axes.back),
                                     .centre = centre};
    }
    // Between two tested angles, points move outwards by less than a quarter of the margin, so this quarter must be
    // empty.
    if (!holds(fitting, camera, &points, fitting->fill + 0.75 * (1 - fitting->fill)))
        *camera = fit(fitting, &points, fitting->fill);
}

// Implements lam_camera_fit and, if `axis` is not NULL, lam_camera_fit_turning. `fill` is used if the view sets no
// fill.
static lam_camera fit_view(const lam_scene *scene, int width, int height, const lam_view *view, lam_vec3 centre,
                           const lam_vec3 *axis, double fill)
{
    uint64_t state = float_state_enter();
    struct fitting fitting;
    lam_camera camera;
    if (start(&fitting, scene, width, height, view, fill, &camera)) {
        if (axis && v3_finite(centre) && v3_finite(*axis))
            fit_turning(&fitting, scene, centre, *axis, &camera);
        apply_zoom(&fitting, &camera);
    }
    float_state_leave(state);
    return camera;
}

lam_camera lam_camera_fit(const lam_scene *scene, int width, int height, const lam_view *view)
{
    return fit_view(scene, width, height, view, v3(0, 0, 0), NULL, FILL);
}

lam_camera lam_camera_fit_turning(const lam_scene *scene, lam_vec3 centre, lam_vec3 axis, int width, int height,
                                  const lam_view *view)
{
    return fit_view(scene, width, height, view, centre, &axis, FILL);
}

// Moves a fitted camera so that there is space around the scene's box for its dimensions, which are below and on the
// right.
static void fit_box(const lam_scene *scene, const lam_draw_params *params, int width, int height, lam_camera *camera)
{
    enum { ROUNDS = 32, BEFORE = 2, BEHIND = 8, ABOVE = 1 }; // the space, in letters
    const int below = 5 + (params->axes ? 5 : params->scale_bar ? 2 : 0);
    double letter = annotation_letter(width, height), fill_x = 1 - (BEFORE + BEHIND) * letter / width,
           fill_y = 1 - (ABOVE + below) * letter / height, middle_x = -(BEHIND - BEFORE) * letter / height,
           middle_y = (below - ABOVE) * letter / height, worst = 2;
    lam_vec3 low, high;
    uint64_t state = float_state_enter();
    fill_x = (fill_x > 0.3 ? fill_x : 0.3) * width / height;
    fill_y = fill_y > 0.3 ? fill_y : 0.3;
    for (int round = 0; round < ROUNDS && worst > 1.001 && lam_scene_bounds(scene, &low, &high); round++) {
        lam_mat4 view = lam_camera_view_matrix(camera);
        lam_vec3 back = v3_sub(camera->eye, camera->target);
        bool flat = camera->ortho_half_height > 0;
        double slope = flat ? camera->ortho_half_height : math_tan(camera->fovy_rad / 2), distance = v3_length(back);
        double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
        for (int i = 0; i < 8; i++) {
            lam_vec3 p = mat4_point(&view, v3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z));
            double depth = flat ? 1 : -p.z > 0.05 * distance ? -p.z : 0.05 * distance;
            double x = p.x / (depth * slope), y = p.y / (depth * slope); // the picture's top is at 1
            left = x < left ? x : left;
            right = x > right ? x : right;
            bottom = y < bottom ? y : bottom;
            top = y > top ? y : top;
        }
        double x = (right - left) / (2 * fill_x), y = (top - bottom) / (2 * fill_y);
        worst = x > y ? x : y;
        double factor = worst > 2 ? 2 : worst, reach = slope * (flat ? 1 : distance);
        lam_vec3 move = v3_add(
            v3_scale(v3(view.m[0][0], view.m[0][1], view.m[0][2]), reach * ((left + right) / 2 - factor * middle_x)),
            v3_scale(v3(view.m[1][0], view.m[1][1], view.m[1][2]), reach * ((bottom + top) / 2 - factor * middle_y)));
        camera->target = v3_add(camera->target, move);
        camera->eye = v3_add(camera->target, v3_scale(back, flat || factor < 1 ? 1 : factor));
        camera->ortho_half_height *= flat && factor > 1 ? factor : 1;
    }
    float_state_leave(state);
}

lam_camera lam_camera_fit_ground(const lam_scene *scene, const lam_draw_params *params, int width, int height,
                                 const lam_view *view, lam_vec3 centre, const lam_vec3 *axis)
{
    // a picture of lines alone shows no ground
    bool lines_alone = params && params->no_surfaces && params->output == LAM_OUTPUT_PICTURE;
    bool ground = params && params->ground && !lines_alone;
    bool measures = params && params->dimensions && params->output == LAM_OUTPUT_PICTURE;
    lam_camera camera = fit_view(scene, width, height, view, centre, axis, ground || measures ? FILL_ON_GROUND : FILL);
    if (measures && !axis && !(view && view->zoom > 0))
        fit_box(scene, params, width, height, &camera);
    return camera;
}
