// scene_form.c: recognizes curved models and terrains, which the studio lights differently from models with flat faces.
#include "scene_internal.h"

#include "linear.h"
#include "up_axis.h"

#include <lambent/material.h>

// A scene is a terrain if it is open and its area faces up: the vertical component of the sum of all area vectors must
// be more than FACING times the whole area. A closed surface faces all sides equally, so the sum is 0. A level plane is
// not a terrain, because light from the side would reveal no detail on the plane.
#define FACING 0.6
#define LEVEL  0.98

// Other scenes are curved if their normals differ: each normal falls into a cell of a cube around all directions, and
// the six fullest cells contain less than FLAT times the whole area. A box fills six cells completely. For scans and
// figures, these six cells contain 0.05 to 0.3 of the area; for machine parts and low-poly models, 0.43 to 1.
#define FLAT 0.36

enum {
    TRIANGLES_MIN = 1024, // a model with fewer triangles is treated as flat
    SAMPLES = 256,        // sampled triangles
    SIDE = 7,             // cells along an edge of the cube; odd, so that no axis lies between cells
    CELLS = 6 * SIDE * SIDE,
    FULLEST = 6,
};

// Sums over the sampled triangles.
struct areas {
    double all, facing;  // area, and the component of the area vectors along the up axis
    double cells[CELLS]; // the area for each direction of the normal
};

// Multiplies a vector by the upper left 3×3 matrix.
static lam_vec3 turned(const lam_mat4 *m, lam_vec3 v)
{
    return v3(m->m[0][0] * v.x + m->m[0][1] * v.y + m->m[0][2] * v.z,
              m->m[1][0] * v.x + m->m[1][1] * v.y + m->m[1][2] * v.z,
              m->m[2][0] * v.x + m->m[2][1] * v.y + m->m[2][2] * v.z);
}

// Gets two edges of a triangle in mesh coordinates.
static void edges_of(const lam_mesh *mesh, size_t triangle, lam_vec3 edges[2])
{
    lam_vec3 p[3];
    for (size_t k = 0; k < 3; k++) {
        size_t corner = 3 * triangle + k;
        const float *at = mesh->positions + 3 * (size_t)(mesh->indices ? mesh->indices[corner] : corner);
        p[k] = v3((double)at[0], (double)at[1], (double)at[2]);
    }
    edges[0] = v3_sub(p[1], p[0]);
    edges[1] = v3_sub(p[2], p[0]);
}

void mesh_add_areas(const lam_mesh *mesh, lam_vec3 axis, double *all, double *facing)
{
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        lam_vec3 edges[2];
        edges_of(mesh, t, edges);
        lam_vec3 area = v3_cross(edges[0], edges[1]);
        *all += v3_length(area);
        *facing += v3_dot(area, axis);
    }
}

// Returns the index of the cell for a coordinate −1 ≤ x ≤ 1 along one edge of the cube.
static int cell_along(double x)
{
    int cell = (int)((x + 1) * (0.5 * SIDE));
    return cell < SIDE ? cell : SIDE - 1;
}

// Returns the cell of a finite direction other than 0: the face of its largest component, then the row and the column.
static int cell_of(lam_vec3 direction)
{
    const double c[3] = {direction.x, direction.y, direction.z};
    const double size[3] = {c[0] < 0 ? -c[0] : c[0], c[1] < 0 ? -c[1] : c[1], c[2] < 0 ? -c[2] : c[2]};
    int axis = size[1] > size[0];
    axis = size[2] > size[axis] ? 2 : axis;
    int column = cell_along(c[(axis + 1) % 3] / size[axis]), row = cell_along(c[(axis + 2) % 3] / size[axis]);
    return ((2 * axis + (c[axis] < 0)) * SIDE + row) * SIDE + column;
}

// Adds one triangle. Uses the triangle's normal in mesh coordinates, so that equal parts in different positions have
// the same normals, and a rotation of the model has no effect.
static void add_triangle(struct areas *sum, const lam_mesh *mesh, size_t triangle, const lam_mat4 *transform,
                         lam_vec3 up)
{
    lam_vec3 edges[2];
    edges_of(mesh, triangle, edges);
    lam_vec3 own = v3_cross(edges[0], edges[1]);
    lam_vec3 area = v3_cross(turned(transform, edges[0]), turned(transform, edges[1]));
    double size = v3_length(area);
    sum->all += size;
    sum->facing += v3_dot(area, up);
    if (v3_finite(own) && (own.x != 0 || own.y != 0 || own.z != 0))
        sum->cells[cell_of(own)] += size;
}

// Returns the area in the fullest cells, and empties these cells.
static double take_fullest(struct areas *sum)
{
    double taken = 0;
    for (int i = 0; i < FULLEST; i++) {
        int fullest = 0;
        for (int cell = 1; cell < CELLS; cell++)
            if (sum->cells[cell] > sum->cells[fullest])
                fullest = cell;
        taken += sum->cells[fullest];
        sum->cells[fullest] = 0;
    }
    return taken;
}

// Returns the triangle of a sample: one of every `step` triangles. The position of this triangle among the `step`
// triangles varies, because equal steps through a grid of triangles would find only some directions.
static uint64_t sampled(uint64_t index, uint64_t step)
{
    uint32_t varying = (uint32_t)index * 2654435769u; // multiples of the golden ratio, modulo 1
    return index * step + ((uint64_t)varying * step >> 32);
}

enum scene_form scene_form(const struct lam_scene *scene)
{
    uint64_t count = scene ? lam_scene_triangle_count(scene) : 0;
    if (count < TRIANGLES_MIN || scene->file.animation_count) // the form must not change between frames
        return FORM_FLAT;
    const uint64_t step = count / SAMPLES;
    const lam_vec3 up = from_y_up(lam_scene_up(scene), v3(0, 1, 0));
    struct areas sum = {.all = 0};
    uint64_t index = 0, base = 0; // the number of the sample; the number of triangles in the previous meshes
    for (int i = 0; i < scene->objects.count; i++) {
        const lam_mesh *mesh = scene_mesh(scene, scene_object(scene, i)->mesh);
        if (mesh_is_strokes(mesh) || !scene_shows(scene, i))
            continue;
        uint64_t end = base + mesh->triangle_count;
        for (uint64_t t; (t = sampled(index, step)) < end; index++)
            add_triangle(&sum, mesh, (size_t)(t - base), &scene_object(scene, i)->transform, up);
        base = end;
    }
    if (sum.facing > FACING * sum.all && sum.facing < LEVEL * sum.all)
        return FORM_TERRAIN;
    return take_fullest(&sum) < FLAT * sum.all ? FORM_CURVED : FORM_FLAT;
}
