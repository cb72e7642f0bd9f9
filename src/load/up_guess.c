// up_guess.c: guesses the up axis of a model whose format defines none, if the shape is unambiguous.
#include "up_guess.h"

#include "linear.h"

#include <math.h>

// A model is a terrain if it is much thinner along z than along x and y, and its area faces +z almost everywhere.
#define THIN     0.3
#define NOT_FLAT 0.01 // a flat picture usually stands upright
#define FACING   0.6
#define EVEN     0.999 // stacked cards have no slopes

// Adds the areas of a mesh's triangles: the total, and the signed area that faces z.
static void add_areas(const lam_mesh *mesh, double *all, double *facing)
{
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const float *p[3];
        for (size_t k = 0; k < 3; k++)
            p[k] = mesh->positions + 3 * (size_t)(mesh->indices ? mesh->indices[3 * t + k] : 3 * t + k);
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = (double)p[1][k] - (double)p[0][k];
            b[k] = (double)p[2][k] - (double)p[0][k];
        }
        double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
        *all += sqrt(x * x + y * y + z * z);
        *facing += z;
    }
}

// With fewer triangles it may be an upright sheet.
enum { TRIANGLES_MIN = 1000 };

bool is_terrain_on_z(const struct lam_scene *scene)
{
    lam_vec3 low, high;
    double all = 0, facing = 0;
    if (!lam_scene_bounds(scene, &low, &high))
        return false;
    double x = high.x - low.x, y = high.y - low.y, z = high.z - low.z, smaller = x < y ? x : y;
    if (lam_scene_triangle_count(scene) < TRIANGLES_MIN || !(z > NOT_FLAT * smaller && z < THIN * smaller))
        return false;
    for (int i = 0; i < scene->meshes.count; i++)
        if (!mesh_is_strokes(scene_mesh(scene, i)))
            add_areas(scene_mesh(scene, i), &all, &facing);
    return facing > FACING * all && facing < EVEN * all;
}
