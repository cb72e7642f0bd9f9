// camera.c: the camera's defaults, and fitting it to a scene.
#include <lambent/camera.h>

#include "float_state.h"
#include "linear.h"
#include "scene_store.h"

lam_camera lam_camera_default(void)
{
    return (lam_camera){.eye = {0, 0, 4}, .up = {0, 1, 0}, .fovy_rad = 30 * (PI / 180)};
}

lam_mat4 lam_camera_view(const lam_camera *camera)
{
    uint64_t state = float_state_enter();
    lam_mat4 view = mat4_look_at(camera->eye, camera->target, camera->up);
    float_state_leave(state);
    return view;
}

// The axes of the view: world directions of the picture's right and top, and from the model to the eye.
struct view_axes {
    lam_vec3 right, above, back;
};

// Turns a direction given with Y up, front +Z, into the scene's up axis. Z up has its front at −Y, as CAD
// has; X up at +Z.
static lam_vec3 turn_up(lam_up up, lam_vec3 d)
{
    switch (up) {
    case LAM_UP_Z:
        return v3(d.x, -d.z, d.y);
    case LAM_UP_X:
        return v3(d.y, -d.x, d.z);
    default:
        return d;
    }
}

static struct view_axes axes_of(const lam_scene *scene, const lam_view *view)
{
    double azimuth = view->from_angles ? view->azimuth_rad : math_radians(30);
    double elevation = view->from_angles ? view->elevation_rad : math_radians(20);
    double sa = math_sin(azimuth), ca = math_cos(azimuth), se = math_sin(elevation), ce = math_cos(elevation);
    lam_up up = lam_scene_up(scene);
    // From above, "right" still follows the azimuth, so the view never tumbles.
    return (struct view_axes){
        .right = turn_up(up, v3(ca, 0, -sa)),
        .above = turn_up(up, v3(-sa * se, ce, -ca * se)),
        .back = turn_up(up, v3(sa * ce, se, ca * ce)),
    };
}

// The largest values over all vertices of ±x + k·z and ±y + k·z, in the axes of the view; k = 0 gives the
// plain box.
struct reach {
    double right, left, top, bottom, front;
};

static void reach_of_mesh(const lam_scene *scene, const lam_object *object, const struct view_axes *axes,
                          double kx, double ky, struct reach *reach)
{
    const lam_mesh *mesh = scene_mesh(scene, object->mesh);
    const struct scene_extent *extent = scene_extent(scene, object->mesh);
    // View axes times the transform, so that each vertex costs three dot products.
    const lam_mat4 *m = &object->transform;
    lam_vec3 rows[3] = {axes->right, axes->above, axes->back};
    lam_vec3 row[3];
    double shift[3];
    lam_vec3 origin = mat4_point(m, v3(mesh->origin[0], mesh->origin[1], mesh->origin[2]));
    for (int i = 0; i < 3; i++) {
        row[i] = v3(m->m[0][0] * rows[i].x + m->m[1][0] * rows[i].y + m->m[2][0] * rows[i].z,
                    m->m[0][1] * rows[i].x + m->m[1][1] * rows[i].y + m->m[2][1] * rows[i].z,
                    m->m[0][2] * rows[i].x + m->m[1][2] * rows[i].y + m->m[2][2] * rows[i].z);
        shift[i] = v3_dot(rows[i], origin);
    }
    for (uint32_t v = 0; v < extent->used_count; v++) {
        const float *p = mesh->positions + 3 * (size_t)(extent->used ? extent->used[v] : v);
        lam_vec3 q = v3((double)p[0], (double)p[1], (double)p[2]);
        double x = v3_dot(row[0], q) + shift[0], y = v3_dot(row[1], q) + shift[1],
               z = v3_dot(row[2], q) + shift[2];
        double r = x + kx * z, l = -x + kx * z, t = y + ky * z, b = -y + ky * z;
        reach->right = r > reach->right ? r : reach->right;
        reach->left = l > reach->left ? l : reach->left;
        reach->top = t > reach->top ? t : reach->top;
        reach->bottom = b > reach->bottom ? b : reach->bottom;
        reach->front = z > reach->front ? z : reach->front;
    }
}

static struct reach reach_of(const lam_scene *scene, const struct view_axes *axes, double kx, double ky)
{
    struct reach reach = {-1e308, -1e308, -1e308, -1e308, -1e308};
    for (int i = 0; i < scene->objects.count; i++)
        reach_of_mesh(scene, scene_object(scene, i), axes, kx, ky, &reach);
    return reach;
}

// Orthographic: half the box over the fill, centred.
static lam_camera fit_orthographic(const lam_scene *scene, const struct view_axes *axes, double aspect,
                                   double fill)
{
    struct reach box = reach_of(scene, axes, 0, 0);
    double half_width = (box.right + box.left) / 2, half_height = (box.top + box.bottom) / 2;
    double half = half_height > half_width / aspect ? half_height : half_width / aspect;
    double size = half > 0 ? half : 1;
    lam_vec3 centre = v3_add(v3_scale(axes->right, (box.right - box.left) / 2),
                             v3_scale(axes->above, (box.top - box.bottom) / 2));
    lam_vec3 target = v3_add(centre, v3_scale(axes->back, box.front));
    return (lam_camera){.eye = v3_add(target, v3_scale(axes->back, 2 * size)),
                        .target = target,
                        .up = axes->above,
                        .ortho_half_height = size / fill};
}

// Perspective, for one axis across the view: a vertex is inside when ±(x − ex) ≤ k·(ez − z), that is ±x + k·z
// ≤ ±ex + k·ez. With R and L the largest of x + k·z and −x + k·z, both sides touch at ex = (R − L)/2 and ez =
// (R + L)/(2k): exact, from one pass over the vertices. The axis that asks for the larger ez decides it; the
// other is centred by finding the smaller k at which it would touch at that ez (a few passes, each from the
// last one's answer).
static lam_camera fit_perspective(const lam_scene *scene, const struct view_axes *axes, double fovy,
                                  double aspect, double fill)
{
    double ky = math_tan(fovy / 2) * fill, kx = ky * aspect;
    struct reach reach = reach_of(scene, axes, kx, ky);
    double ez_x = (reach.right + reach.left) / (2 * kx), ez_y = (reach.top + reach.bottom) / (2 * ky);
    double ez = ez_x > ez_y ? ez_x : ez_y;
    if (!(ez > reach.front)) // a single point, or a line along the view
        ez = reach.front + 1;
    for (int pass = 0; pass < 4; pass++) {
        if (ez_x > ez_y)
            ky = (reach.top + reach.bottom) / (2 * ez);
        else
            kx = (reach.right + reach.left) / (2 * ez);
        struct reach next = reach_of(scene, axes, kx, ky);
        double moved = (next.right - next.left) - (reach.right - reach.left) + (next.top - next.bottom) -
                       (reach.top - reach.bottom);
        reach = next;
        if (moved < 1e-6 * (ez - reach.front) && moved > -1e-6 * (ez - reach.front))
            break;
    }
    lam_vec3 across = v3_add(v3_scale(axes->right, (reach.right - reach.left) / 2),
                             v3_scale(axes->above, (reach.top - reach.bottom) / 2));
    return (lam_camera){.eye = v3_add(across, v3_scale(axes->back, ez)),
                        .target = v3_add(across, v3_scale(axes->back, reach.front)),
                        .up = axes->above,
                        .fovy_rad = fovy};
}

lam_camera lam_camera_fit(const lam_scene *scene, const lam_view *view)
{
    static const lam_view plain = {0};
    if (!view)
        view = &plain;
    lam_vec3 low, high;
    if (!lam_scene_bounds(scene, &low, &high))
        return lam_camera_default();
    uint64_t state = float_state_enter();
    struct view_axes axes = axes_of(scene, view);
    double aspect = view->aspect > 0 ? view->aspect : 1;
    double fill = view->fill > 0 ? view->fill : 0.92;
    double fovy = view->fovy_rad > 0 && view->fovy_rad < PI ? view->fovy_rad : math_radians(30);
    double zoom = view->zoom > 0 ? view->zoom : 1;
    lam_camera camera = view->orthographic ? fit_orthographic(scene, &axes, aspect, fill)
                                           : fit_perspective(scene, &axes, fovy, aspect, fill);
    // Zoom narrows the view instead of moving the eye, so that it never walks into the model.
    if (camera.ortho_half_height > 0)
        camera.ortho_half_height /= zoom;
    else
        camera.fovy_rad = 2 * math_atan2(math_tan(fovy / 2), zoom);
    float_state_leave(state);
    return camera;
}
