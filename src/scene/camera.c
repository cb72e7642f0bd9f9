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

enum { DIRECTIONS = 5 };

// A mesh in the axes of the view: x, y and z of a vertex are row · position + shift.
struct view_mesh {
    const lam_mesh *mesh;
    const struct scene_extent *extent;
    lam_vec3 row[3];
    double shift[3];
    double kx, ky;
    // The five values of a reach, each as axis · position + offset, and how far rounding may move them.
    lam_vec3 axis[DIRECTIONS], axis_size[DIRECTIONS];
    double offset[DIRECTIONS];
};

static double size_of(double a) { return a < 0 ? -a : a; }

static void set_directions(struct view_mesh *m)
{
    const double across[DIRECTIONS][3] = {
        {1, 0, m->kx}, {-1, 0, m->kx}, {0, 1, m->ky}, {0, -1, m->ky}, {0, 0, 1}};
    const double *o = m->mesh->origin;
    lam_vec3 low = m->extent->minimum, high = m->extent->maximum;
    // The farthest coordinates, origin taken out again: a little more than they are.
    double far[3] = {(size_of(low.x) + size_of(high.x) + 2 * size_of(o[0])),
                     (size_of(low.y) + size_of(high.y) + 2 * size_of(o[1])),
                     (size_of(low.z) + size_of(high.z) + 2 * size_of(o[2]))};
    for (int d = 0; d < DIRECTIONS; d++) {
        const double *f = across[d];
        double steps = 0; // the sum of the sizes of all terms
        m->offset[d] = f[0] * m->shift[0] + f[1] * m->shift[1] + f[2] * m->shift[2];
        double sum[3] = {0};
        for (int i = 0; i < 3; i++) {
            const double row[3] = {m->row[i].x, m->row[i].y, m->row[i].z};
            steps += size_of(f[i] * m->shift[i]);
            for (int a = 0; a < 3; a++) {
                sum[a] += f[i] * row[a];
                steps += size_of(f[i] * row[a]) * far[a];
            }
        }
        m->axis[d] = v3(sum[0], sum[1], sum[2]);
        m->axis_size[d] = v3(size_of(sum[0]), size_of(sum[1]), size_of(sum[2]));
        // Fewer than 64 operations, each wrong by less than 2⁻⁵² of that sum.
        m->offset[d] += steps * 0x1p-46;
    }
}

static void reach_of_block(double reach[DIRECTIONS], const struct view_mesh *m, size_t block)
{
    size_t end = (block + 1) * EXTENT_BLOCK < m->extent->used_count ? (block + 1) * EXTENT_BLOCK
                                                                    : m->extent->used_count;
    for (size_t v = block * EXTENT_BLOCK; v < end; v++) {
        const float *p = m->mesh->positions + 3 * (size_t)(m->extent->used ? m->extent->used[v] : v);
        lam_vec3 q = v3((double)p[0], (double)p[1], (double)p[2]);
        double x = v3_dot(m->row[0], q) + m->shift[0], y = v3_dot(m->row[1], q) + m->shift[1],
               z = v3_dot(m->row[2], q) + m->shift[2];
        const double value[DIRECTIONS] = {x + m->kx * z, -x + m->kx * z, y + m->ky * z, -y + m->ky * z, z};
        for (int d = 0; d < DIRECTIONS; d++)
            reach[d] = value[d] > reach[d] ? value[d] : reach[d];
    }
}

// What no vertex of a block reaches beyond: the box's middle, and its half sides along each direction.
static void reach_limit(const struct view_mesh *m, size_t block, double limit[DIRECTIONS])
{
    const float *box = m->extent->blocks[block];
    lam_vec3 low = v3((double)box[0], (double)box[1], (double)box[2]);
    lam_vec3 high = v3((double)box[3], (double)box[4], (double)box[5]);
    lam_vec3 middle = v3_scale(v3_add(low, high), 0.5), half = v3_scale(v3_sub(high, low), 0.5);
    for (int d = 0; d < DIRECTIONS; d++)
        limit[d] = v3_dot(m->axis[d], middle) + v3_dot(m->axis_size[d], half) + m->offset[d];
}

// Only blocks that can reach beyond what was found are looked into; the most promising ones first.
static void reach_of_mesh(const lam_scene *scene, const lam_object *object, const struct view_axes *axes,
                          double kx, double ky, double reach[DIRECTIONS])
{
    struct view_mesh m = {.mesh = scene_mesh(scene, object->mesh),
                          .extent = scene_extent(scene, object->mesh),
                          .kx = kx,
                          .ky = ky};
    // View axes times the transform, so that each vertex costs three dot products.
    const lam_mat4 *t = &object->transform;
    lam_vec3 rows[3] = {axes->right, axes->above, axes->back};
    lam_vec3 origin = mat4_point(t, v3(m.mesh->origin[0], m.mesh->origin[1], m.mesh->origin[2]));
    for (int i = 0; i < 3; i++) {
        m.row[i] = v3(t->m[0][0] * rows[i].x + t->m[1][0] * rows[i].y + t->m[2][0] * rows[i].z,
                      t->m[0][1] * rows[i].x + t->m[1][1] * rows[i].y + t->m[2][1] * rows[i].z,
                      t->m[0][2] * rows[i].x + t->m[1][2] * rows[i].y + t->m[2][2] * rows[i].z);
        m.shift[i] = v3_dot(rows[i], origin);
    }
    set_directions(&m);
    size_t blocks = extent_blocks(m.extent), promising[DIRECTIONS] = {0};
    double limit[DIRECTIONS], most[DIRECTIONS] = {-1e308, -1e308, -1e308, -1e308, -1e308};
    for (size_t b = 0; b < blocks; b++) {
        reach_limit(&m, b, limit);
        for (int d = 0; d < DIRECTIONS; d++)
            if (limit[d] > most[d]) {
                most[d] = limit[d];
                promising[d] = b;
            }
    }
    for (int d = 0; blocks && d < DIRECTIONS; d++)
        reach_of_block(reach, &m, promising[d]);
    for (size_t b = 0; b < blocks; b++) {
        reach_limit(&m, b, limit);
        bool beyond = false;
        for (int d = 0; d < DIRECTIONS; d++)
            beyond |= limit[d] > reach[d];
        if (beyond)
            reach_of_block(reach, &m, b);
    }
}

static struct reach reach_of(const lam_scene *scene, const struct view_axes *axes, double kx, double ky)
{
    double reach[DIRECTIONS] = {-1e308, -1e308, -1e308, -1e308, -1e308};
    for (int i = 0; i < scene->objects.count; i++)
        reach_of_mesh(scene, scene_object(scene, i), axes, kx, ky, reach);
    return (struct reach){reach[0], reach[1], reach[2], reach[3], reach[4]};
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
