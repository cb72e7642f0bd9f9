// scene_terrain.c: recognizes terrains, which the studio lights from the side.
#include "scene_internal.h"

#include "linear.h"
#include "up_axis.h"

// A scene is a terrain if it is open and its area faces up: the vertical component of the sum of all area vectors must
// be more than FACING times the whole area. A closed surface faces all sides equally, so its sum is 0. A level plane is
// not a terrain, because light from the side would show nothing on it.
#define FACING 0.6
#define LEVEL  0.98

enum {
    TRIANGLES_MIN = 1024, // a model with fewer triangles is not a terrain
    SAMPLES = 256,        // sampled triangles
};

// Multiplies a vector by the upper left 3×3 matrix.
static lam_vec3 turned(const lam_mat4 *m, lam_vec3 v)
{
    return v3(m->m[0][0] * v.x + m->m[0][1] * v.y + m->m[0][2] * v.z,
              m->m[1][0] * v.x + m->m[1][1] * v.y + m->m[1][2] * v.z,
              m->m[2][0] * v.x + m->m[2][1] * v.y + m->m[2][2] * v.z);
}

void mesh_add_areas(const lam_mesh *mesh, size_t first, size_t step, const lam_mat4 *transform, lam_vec3 axis,
                    double *all, double *facing)
{
    for (size_t t = first; t < mesh->triangle_count; t += step) {
        lam_vec3 p[3];
        for (size_t k = 0; k < 3; k++) {
            const float *at = mesh->positions + 3 * (size_t)(mesh->indices ? mesh->indices[3 * t + k] : 3 * t + k);
            p[k] = v3((double)at[0], (double)at[1], (double)at[2]);
        }
        lam_vec3 a = v3_sub(p[1], p[0]), b = v3_sub(p[2], p[0]);
        if (transform) {
            a = turned(transform, a);
            b = turned(transform, b);
        }
        lam_vec3 area = v3_cross(a, b);
        *all += v3_length(area);
        *facing += v3_dot(area, axis);
    }
}

bool scene_is_terrain(const struct lam_scene *scene)
{
    uint64_t count = scene ? lam_scene_triangle_count(scene) : 0;
    if (count < TRIANGLES_MIN)
        return false;
    const size_t step = (size_t)(count / SAMPLES);
    const lam_vec3 up = from_y_up(lam_scene_up(scene), v3(0, 1, 0));
    double all = 0, facing = 0;
    size_t first = 0; // index of the first sampled triangle in the next mesh
    for (int i = 0; i < scene->objects.count; i++) {
        const lam_mesh *mesh = scene_mesh(scene, scene_object(scene, i)->mesh);
        if (mesh_is_strokes(mesh) || !scene_shows(scene, i))
            continue;
        mesh_add_areas(mesh, first, step, &scene_object(scene, i)->transform, up, &all, &facing);
        const size_t n = mesh->triangle_count;
        first = (first < n ? first + (n - first + step - 1) / step * step : first) - n;
    }
    return facing > FACING * all && facing < LEVEL * all;
}

// Places the studio's lights like the light of a shaded relief map. The key light grazes the surface from the left, and
// the fill light reaches slopes that face right. There is no light from behind, because it would light all slopes
// alike.
int rig_light_from_side(lam_light lights[LAM_RIG_LIGHTS_MAX])
{
    lights[0].position = v3(-2.7, 0.8, 1.2);
    lights[0].diffuse = (lam_rgb){0.9f, 0.9f, 0.9f};
    lights[1].diffuse = (lam_rgb){0.18f, 0.18f, 0.18f};
    lights[2] = lights[3];
    lights[2].sky = (lam_rgb){0.14f, 0.14f, 0.14f};
    return 3;
}
