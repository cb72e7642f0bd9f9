// pick.c: implements lam_pick: traces one ray through the triangles of a frame.
#include "frame.h"
#include "rays.h"

#include "camera_lens.h"
#include "fail.h"
#include "float_state.h"

#include <lambent/pick.h>

#include <string.h>

// A ray in the space of a mesh's positions: the point `from` + s `along` has the depth s.
struct pick_ray {
    lam_vec3 from, along;
};

struct pick_hit {
    int draw; // the index of the draw, or −1
    uint32_t triangle;
    bool back;
    double distance;
};

static struct pick_ray eye_ray(const lam_camera *camera, const lam_pick_pixel *pixel)
{
    const bool flat = camera->ortho_half_height > 0;
    const struct camera_lens lens = camera_lens_of(camera, pixel->width, pixel->height);
    const double x = (pixel->x + 0.5 - lens.middle[0]) * lens.pixel[0],
                 y = (lens.middle[1] - pixel->y - 0.5) * lens.pixel[1];
    return flat ? (struct pick_ray){v3(x, y, 0), v3(0, 0, -1)} : (struct pick_ray){v3(0, 0, 0), v3(x, y, -1)};
}

// Transforms the ray to the space of a draw's mesh. Returns false if the draw is so flat that it is invisible.
static bool mesh_ray(const struct frame_draw *draw, const struct pick_ray *eye, struct pick_ray *out)
{
    lam_mat4 to_eye = lam_mat4_identity(), to_mesh;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            to_eye.m[i][j] = (double)draw->eye[i][j];
    if (!mat4_inverse_affine(&to_eye, &to_mesh))
        return false;
    *out = (struct pick_ray){mat4_point(&to_mesh, eye->from), mat4_vector(&to_mesh, eye->along)};
    return true;
}

// Returns whether a ray meets the slightly enlarged box of a mesh.
static bool meets_box(const lam_mesh *mesh, const struct scene_extent *extent, const struct pick_ray *ray)
{
    const double from[3] = {ray->from.x, ray->from.y, ray->from.z},
                 along[3] = {ray->along.x, ray->along.y, ray->along.z};
    const double low[3] = {extent->minimum.x, extent->minimum.y, extent->minimum.z},
                 high[3] = {extent->maximum.x, extent->maximum.y, extent->maximum.z};
    double nearest = -1e308, farthest = 1e308;
    for (int i = 0; i < 3; i++) {
        double margin = 1e-6 * (high[i] - low[i]);
        double a = low[i] - mesh->origin[i] - margin - from[i], b = high[i] - mesh->origin[i] + margin - from[i];
        if (along[i] == 0) {
            if (a > 0 || b < 0)
                return false;
            continue;
        }
        a /= along[i];
        b /= along[i];
        nearest = a < b ? a > nearest ? a : nearest : b > nearest ? b : nearest;
        farthest = a < b ? b < farthest ? b : farthest : a < farthest ? a : farthest;
    }
    return nearest <= farthest;
}

static lam_vec3 corner(const lam_mesh *mesh, size_t corner)
{
    const float *p = mesh->positions + 3 * (mesh->indices ? mesh->indices[corner] : corner);
    return v3((double)p[0], (double)p[1], (double)p[2]);
}

// Intersects a ray with a triangle (Möller and Trumbore, 1997). Stores the depth and the weights of corners 1 and 2 in
// `at`. *facing is below 0 if the front of the triangle is visible. Returns false if there is no intersection.
static bool meet(const struct pick_ray *ray, const lam_mesh *mesh, uint32_t triangle, double *facing, double at[3])
{
    const size_t first = 3 * (size_t)triangle;
    const lam_vec3 a = corner(mesh, first), ab = v3_sub(corner(mesh, first + 1), a),
                   ac = v3_sub(corner(mesh, first + 2), a), p = v3_cross(ray->along, ac);
    const double determinant = v3_dot(ab, p); // −along · (ab × ac)
    *facing = -determinant;
    if (determinant == 0)
        return false;
    const lam_vec3 away = v3_sub(ray->from, a), q = v3_cross(away, ab);
    at[1] = v3_dot(away, p) / determinant;
    at[2] = v3_dot(ray->along, q) / determinant;
    at[0] = v3_dot(ac, q) / determinant;
    return at[1] >= 0 && at[2] >= 0 && at[1] + at[2] <= 1;
}

static bool search_draw(const struct frame *frame, int index, const struct pick_ray *ray, struct call_control *call,
                        struct pick_hit *hit)
{
    enum { CHECK = 1 << 16 }; // number of triangles between two checks of the call's limits
    const struct frame_draw *draw = &frame->draws[index];
    for (uint32_t t = 0; t < draw->mesh->triangle_count; t++) {
        double facing, at[3];
        if (t % CHECK == 0 && !call_should_continue(call))
            return false;
        if (!meet(ray, draw->mesh, t, &facing, at) || !(at[0] < hit->distance) || at[0] < (double)frame->near_plane ||
            at[0] > (double)frame->far_plane)
            continue;
        const bool back = facing > 0 && !draw->strokes;
        if (!draw->strokes && draw->cull == (back ? LAM_CULL_BACK : LAM_CULL_FRONT))
            continue;
        if (ray_opacity(frame, draw->first_id + t, back, (float)at[1], (float)at[2]) > 0)
            *hit = (struct pick_hit){index, t, back, at[0]};
    }
    return true;
}

static void report(const struct frame *frame, const lam_scene *scene, const lam_camera *camera,
                   const struct pick_ray *eye, const struct pick_hit *hit, lam_picked *picked)
{
    *picked = (lam_picked){.object = -1};
    if (hit->draw < 0)
        return;
    const struct frame_draw *draw = &frame->draws[hit->draw];
    const lam_object *object = scene_object(scene, draw->object);
    const lam_mesh *mesh = scene_mesh(scene, object->mesh);
    const lam_mat4 view = mat4_look_at(camera->eye, camera->target, camera->up);
    lam_mat4 to_world;
    const lam_vec3 at = v3_add(eye->from, v3_scale(eye->along, hit->distance));
    picked->object = draw->object;
    picked->mesh = object->mesh;
    picked->triangle = mesh->line_count    ? hit->triangle / 2
                       : mesh->point_count ? hit->triangle / (uint32_t)frame->point_triangles
                                           : hit->triangle;
    picked->back = hit->back;
    picked->distance = frame->orthographic ? hit->distance : v3_length(at);
    if (mat4_inverse_affine(&view, &to_world))
        picked->position = mat4_point(&to_world, at);
}

bool lam_pick(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
              const lam_pick_pixel *pixel, const lam_control *control, lam_picked *picked, lam_error *error)
{
    if (!scene || !camera || !pixel || !picked)
        return fail(error, LAM_BAD_ARGUMENT, "lam_pick: %s is NULL",
                    !scene    ? "scene"
                    : !camera ? "camera"
                    : !pixel  ? "pixel"
                              : "picked");
    if (!check_reserved("lam_pick_pixel", pixel, error))
        return false;
    if (pixel->width < 1 || pixel->height < 1 || pixel->width > 65535 || pixel->height > 65535)
        return fail(error, LAM_BAD_ARGUMENT, "lam_pick: the picture has %d×%d pixels, expected sides of 1 to 65535",
                    pixel->width, pixel->height);
    if (pixel->x < 0 || pixel->y < 0 || pixel->x >= pixel->width || pixel->y >= pixel->height)
        return fail(error, LAM_BAD_ARGUMENT, "lam_pick: the pixel (%d, %d) lies outside of the picture of %d×%d pixels",
                    pixel->x, pixel->y, pixel->width, pixel->height);
    lam_draw_params plain = params ? *params : (lam_draw_params){0};
    plain.rig = LAM_RIG_NONE; // lights, the ground and drawn edges cannot be picked
    plain.output = LAM_OUTPUT_COVERAGE;
    plain.ground = LAM_GROUND_NONE;
    plain.occlusion = LAM_OCCLUSION_OFF;
    plain.cavity = LAM_CAVITY_OFF;
    plain.shadows = plain.wireframe = false;
    plain.edges = 0;
    struct call_control call;
    call_start(&call, control);
    call.control.expansion_limit = UINT64_MAX;
    const uint64_t state = float_state_enter();
    struct frame frame = {0};
    bool ok = frame_build(&frame, scene, camera, &plain, pixel->width, pixel->height, &call, error);
    struct pick_hit hit = {.draw = -1, .distance = 1e308};
    const struct pick_ray eye = eye_ray(camera, pixel);
    for (int i = 0; ok && i < frame.draw_count; i++) {
        const struct frame_draw *draw = &frame.draws[i];
        struct pick_ray ray;
        if (!mesh_ray(draw, &eye, &ray) ||
            (!draw->strokes &&
             !meets_box(draw->mesh, scene_extent(scene, scene_object(scene, draw->object)->mesh), &ray)))
            continue;
        ok = search_draw(&frame, i, &ray, &call, &hit) || call_error(&call, error);
    }
    if (ok)
        report(&frame, scene, camera, &eye, &hit, picked);
    frame_free(&frame);
    float_state_leave(state);
    return ok;
}
