// scene_place.c: the bounding sphere and the transforms of a whole scene.
#include "scene_internal.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "up_axis.h"

#include <lambent/material.h>

// Returns a limit for squared distances. A point whose squared distance is below the limit is nearer than `distance`,
// regardless of rounding.
static double nearer_than(double distance)
{
    return distance > 1e-100 && distance < 1e100 ? distance * distance * (1 - 1e-9) : 0;
}

// Extends *radius so that the sphere contains the transformed vertices of a mesh.
static void extend_radius(const lam_scene *scene, int mesh_index, const lam_mat4 *transform, lam_vec3 centre,
                          double *radius)
{
    const lam_mesh *mesh = scene_mesh(scene, mesh_index);
    const struct scene_extent *extent = scene_extent(scene, mesh_index);
    lam_mat4 origin = mat4_translate(mesh->origin[0], mesh->origin[1], mesh->origin[2]);
    lam_mat4 whole = mat4_mul(transform, &origin);
    const double(*m)[4] = whole.m;
    double nearer = nearer_than(*radius);
    for (uint32_t i = 0; i < extent->used_count; i++) {
        const float *p = mesh->positions + 3 * (size_t)(extent->used ? extent->used[i] : i);
        const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
        // These are the operations of mat4_point, which the compiler does not inline.
        lam_vec3 at = v3((m[0][0] * x + m[0][1] * y) + m[0][2] * z + m[0][3] - centre.x,
                         (m[1][0] * x + m[1][1] * y) + m[1][2] * z + m[1][3] - centre.y,
                         (m[2][0] * x + m[2][1] * y) + m[2][2] * z + m[2][3] - centre.z);
        if (at.x * at.x + at.y * at.y + at.z * at.z < nearer)
            continue;
        double distance = v3_length(at);
        if (distance > *radius) {
            *radius = distance;
            nearer = nearer_than(distance);
        }
    }
}

double scene_radius(const struct lam_scene *scene, lam_vec3 centre)
{
    double radius = 0;
    for (int i = 0; i < scene->objects.count; i++)
        if (scene_shows(scene, i))
            extend_radius(scene, scene_object(scene, i)->mesh, &scene_object(scene, i)->transform, centre, &radius);
    return radius;
}

static lam_vec3 midpoint(lam_vec3 a, lam_vec3 b)
{
    return v3(a.x + (b.x - a.x) * 0.5, a.y + (b.y - a.y) * 0.5, a.z + (b.z - a.z) * 0.5);
}

bool lam_scene_sphere(const lam_scene *scene, int object, lam_vec3 *centre, double *radius)
{
    uint64_t state = float_state_enter();
    lam_vec3 low, high, at = v3(0, 0, 0);
    double distance_max = 0;
    bool found = false;
    const lam_object *one = object >= 0 ? lam_scene_object(scene, object) : NULL;
    if (one && scene_extent(scene, one->mesh)->used_count) {
        const struct scene_extent *extent = scene_extent(scene, one->mesh);
        lam_mat4 identity = lam_mat4_identity();
        at = midpoint(extent->minimum, extent->maximum);
        extend_radius(scene, one->mesh, &identity, at, &distance_max);
        found = true;
    } else if (object < 0 && scene && lam_scene_bounds(scene, &low, &high)) {
        at = midpoint(low, high);
        distance_max = scene_radius(scene, at);
        found = true;
    }
    float_state_leave(state);
    if (centre)
        *centre = at;
    if (radius)
        *radius = distance_max;
    return found;
}

static bool check_transform(const lam_mat4 *transform, lam_error *error)
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            if (!math_finite(transform->m[i][j]))
                return fail(error, LAM_BAD_ARGUMENT, "lam_scene_transform: transform[%d][%d] is not finite", i, j);
    const double *last = transform->m[3];
    if (last[0] != 0 || last[1] != 0 || last[2] != 0 || last[3] != 1)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_transform: the last row is %g %g %g %g, expected 0 0 0 1",
                    last[0], last[1], last[2], last[3]);
    double determinant = mat4_determinant3(transform);
    if (!(determinant != 0) || !math_finite(determinant))
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_transform: the transform cannot be inverted");
    return true;
}

static bool transform_objects(lam_scene *scene, const lam_mat4 *transform, lam_error *error)
{
    if (!check_transform(transform, error))
        return false;
    // Products may overflow, so all products are checked before any object changes.
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < scene->objects.count; i++) {
            lam_object *object = (lam_object *)scene->objects.items + i;
            lam_mat4 moved = mat4_mul(transform, &object->transform);
            double determinant = mat4_determinant3(&moved);
            if (!(determinant != 0) || !math_finite(determinant) || !v3_finite(mat4_point(&moved, v3(0, 0, 0))))
                return fail(error, LAM_BAD_ARGUMENT,
                            "lam_scene_transform: object %d would have a transform that cannot be inverted", i);
            if (pass == 1 && scene->cut)
                scene->cut->objects[i].transform = moved;
            if (pass == 1)
                object->transform = moved;
        }
    scene->placement = mat4_mul(transform, &scene->placement);
    return true;
}

bool lam_scene_transform(lam_scene *scene, const lam_mat4 *transform, lam_error *error)
{
    if (!scene || !transform)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_transform: the %s is NULL", scene ? "transform" : "scene");
    uint64_t state = float_state_enter();
    bool ok = transform_objects(scene, transform, error);
    float_state_leave(state);
    return ok;
}

bool lam_scene_rotate(lam_scene *scene, lam_vec3 centre, lam_vec3 axis, double angle_rad, lam_error *error)
{
    if (!scene)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_rotate: the scene is NULL");
    if (!v3_finite(centre) || !v3_finite(axis) || v3_length(axis) == 0 || !(angle_rad >= -1e6 && angle_rad <= 1e6))
        return fail(error, LAM_BAD_ARGUMENT,
                    "lam_scene_rotate: the axis is zero, or a number is not finite or over a million");
    uint64_t state = float_state_enter();
    lam_mat4 away = mat4_translate(-centre.x, -centre.y, -centre.z),
             back = mat4_translate(centre.x, centre.y, centre.z);
    lam_mat4 turn = mat4_rotate(angle_rad, axis), turned = mat4_mul(&turn, &away);
    lam_mat4 whole = mat4_mul(&back, &turned);
    bool ok = transform_objects(scene, &whole, error);
    float_state_leave(state);
    return ok;
}
