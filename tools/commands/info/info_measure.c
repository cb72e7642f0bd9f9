// info_measure.c: computes the area of a model's surface and the enclosed volume, and tests whether the surface is
// closed.
#include "info.h"

#include <math.h>
#include <string.h>

#include "vectors.h"

lam_vec3 info_place(const lam_mesh *mesh, const lam_mat4 *transform, uint32_t vertex)
{
    const float *at = mesh->positions + 3 * (size_t)vertex;
    double p[3], out[3];
    for (int i = 0; i < 3; i++)
        p[i] = (double)at[i] + mesh->origin[i];
    for (int i = 0; i < 3; i++)
        out[i] = transform->m[i][0] * p[0] + transform->m[i][1] * p[1] + transform->m[i][2] * p[2] + transform->m[i][3];
    return (lam_vec3){out[0], out[1], out[2]};
}

static lam_vec3 corner_of(const lam_mesh *mesh, const lam_mat4 *transform, lam_vec3 center, uint32_t vertex)
{
    const lam_vec3 at = info_place(mesh, transform, vertex);
    return (lam_vec3){at.x - center.x, at.y - center.y, at.z - center.z};
}

static uint64_t mix(uint64_t x)
{
    x = (x ^ x >> 32) * 0x9e3779b97f4a7c15;
    x = (x ^ x >> 29) * 0xbf58476d1ce4e5b9;
    return x ^ x >> 32;
}

// Returns a hash of a vertex's position. Coincident vertices have equal hashes.
static uint64_t position_hash(const lam_mesh *mesh, uint32_t vertex)
{
    uint64_t hash = 1;
    for (int i = 0; i < 3; i++) {
        float number = mesh->positions[3 * (size_t)vertex + (size_t)i] + 0.0f; // converts −0 to 0
        uint32_t bits;
        memcpy(&bits, &number, sizeof bits);
        hash = mix(hash ^ bits) + (uint64_t)i;
    }
    return hash;
}

// Returns a hash of a directed edge. The edge in the opposite direction has the negated hash. The hashes of a closed
// surface add up to 0. The hashes of any other surface add up to 0 with a probability of 2⁻⁶⁴.
static uint64_t edge_hash(uint64_t from, uint64_t to)
{
    return from < to ? mix(from + mix(to)) : from > to ? 0 - mix(to + mix(from)) : 0;
}

void info_vertices(const lam_mesh *mesh, uint32_t triangle, uint32_t out[3])
{
    for (uint32_t i = 0; i < 3; i++)
        out[i] = mesh->indices ? mesh->indices[3 * (size_t)triangle + i] : 3 * triangle + i;
}

static bool is_closed(const lam_mesh *mesh)
{
    uint64_t sum = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t vertices[3];
        uint64_t hash[3];
        info_vertices(mesh, t, vertices);
        for (int i = 0; i < 3; i++)
            hash[i] = position_hash(mesh, vertices[i]);
        sum += edge_hash(hash[0], hash[1]) + edge_hash(hash[1], hash[2]) + edge_hash(hash[2], hash[0]);
    }
    return sum == 0;
}

// Returns the factor by which a transform changes all lengths, or 0 if it also changes angles.
static double scale_of(const lam_mat4 *m)
{
    const double(*r)[4] = m->m;
    const double scale = cbrt(fabs(r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                                   r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                                   r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0])));
    for (int i = 0; i < 3; i++) // the determinant is the product of three lengths only if the axes are orthogonal
        if (!(fabs(hypot(hypot(r[0][i], r[1][i]), r[2][i]) - scale) < 1e-6 * scale))
            return 0;
    return scale;
}

struct info_measure info_measure(const lam_scene *scene)
{
    struct info_measure all = {.closed = lam_scene_triangle_count(scene) > 0};
    all.exact = lam_scene_object_count(scene) > 0;
    lam_vec3 low, high;
    lam_scene_bounds(scene, &low, &high);
    lam_vec3 center = {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
    for (int i = 0; i < lam_scene_mesh_count(scene) && all.closed; i++)
        all.closed = is_closed(lam_scene_mesh(scene, i));
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        const lam_object *object = lam_scene_object(scene, i);
        const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
        double area = 0, volume = 0; // twice the area and six times the volume
        const double scale = scale_of(&object->transform);
        const bool exact = scale > 0 && mesh->exact_area > 0 && (!all.closed || mesh->exact_volume > 0);
        all.exact &= exact;
        if (exact) {
            area = 2 * mesh->exact_area * scale * scale;
            volume = 6 * mesh->exact_volume * scale * scale * scale;
        }
        for (uint32_t t = 0; !exact && t < mesh->triangle_count; t++) {
            uint32_t vertices[3];
            info_vertices(mesh, t, vertices);
            lam_vec3 a = corner_of(mesh, &object->transform, center, vertices[0]);
            lam_vec3 b = corner_of(mesh, &object->transform, center, vertices[1]);
            lam_vec3 c = corner_of(mesh, &object->transform, center, vertices[2]);
            lam_vec3 n =
                cross((lam_vec3){b.x - a.x, b.y - a.y, b.z - a.z}, (lam_vec3){c.x - a.x, c.y - a.y, c.z - a.z});
            area += sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
            volume += n.x * a.x + n.y * a.y + n.z * a.z;
        }
        all.area += area / 2;
        all.volume += fabs(volume) / 6;
    }
    return all;
}
