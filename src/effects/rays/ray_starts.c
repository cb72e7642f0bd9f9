// ray_starts.c: computes the start points of rays. Rays start exactly at the points, which are computed in double
// precision in the coordinate space of the hierarchy. docs/lighting/shadows.md describes the rules.
#include "rays.h"

#include "cpu_features.h"

#include <string.h>

// A triangle that contains points of a batch.
struct start_triangle {
    double p[3][3], n[3][3]; // corners and, if `curved`, the unit normals at the corners, for the visible side
    bool curved;
    int32_t own;
};

static void world_normal(const struct ray_surface *surface, const float *from, double to[3])
{
    const double(*m)[3] = surface->draw->world_normal;
    double x = (double)from[0], y = (double)from[1], z = (double)from[2], square = 0;
    for (int i = 0; i < 3; i++) {
        to[i] = (m[i][0] * x + m[i][1] * y) + m[i][2] * z;
        square += to[i] * to[i];
    }
    double scale = square > 0 ? (surface->back ? -1 : 1) / __builtin_sqrt(square) : 0;
    for (int i = 0; i < 3; i++)
        to[i] *= scale;
}

static struct start_triangle start_triangle_of(const struct light_rays *rays, const struct ray_surface *surface,
                                               uint32_t triangle)
{
    const struct frame_draw *draw = surface->draw;
    struct start_triangle t = {.own = (int32_t)hierarchy_twin(rays->hierarchy, draw->first_id + triangle),
                               .curved = surface->normals && !rays->frame->settings.flat_terminator && !draw->strokes};
    ray_corners(draw, triangle, t.p);
    for (uint32_t k = 0; k < 3; k++) {
        ray_point(rays->hierarchy, t.p[k], t.p[k]);
        if (!t.curved)
            continue;
        uint32_t element = surface->visible ? visible_element(surface->visible, draw->first_id + triangle, k)
                                            : mesh_element(draw->mesh->normal_indices, draw->mesh, 3 * triangle + k);
        world_normal(surface, surface->normals + 3 * (size_t)element, t.n[k]);
    }
    return t;
}

// Computes the point with barycentric weights b1 and b2, clamped to the triangle. No weight is below 2⁻³⁰, because
// exactly on an edge, rounding would decide on which side of the neighbouring triangle the ray starts. On a smooth
// surface the ray then starts farther outward, towards the tangent planes at the corners, which are perpendicular to
// the corners' normals:
//    q = Σ b_k (p − min(0, (p − p_k)·n_k) n_k)
static void start_on_triangle(const struct start_triangle *t, double b1, double b2, double point[3], double origin[3])
{
    const double least = 0x1p-30, most = 1 - 0x1p-30;
    b1 = b1 > least ? b1 : least;
    b2 = b2 > least ? b2 : least;
    double sum = b1 + b2;
    if (sum > most) {
        b1 *= most / sum;
        b2 *= most / sum;
        sum = most;
    }
    for (int i = 0; i < 3; i++)
        point[i] = origin[i] = t->p[0][i] + ((t->p[1][i] - t->p[0][i]) * b1 + (t->p[2][i] - t->p[0][i]) * b2);
    if (!t->curved)
        return;
    const double b[3] = {1 - sum, b1, b2};
    double moved[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        const double *p = t->p[k], *n = t->n[k];
        double d = ((origin[0] - p[0]) * n[0] + (origin[1] - p[1]) * n[1]) + (origin[2] - p[2]) * n[2];
        for (int i = 0; i < 3 && d < 0; i++)
            moved[i] += b[k] * d * n[i];
    }
    for (int i = 0; i < 3; i++)
        origin[i] -= moved[i];
}

CPU_VERSIONS(const struct ray_kernels, ray_kernels);

const struct ray_kernels *ray_kernels_of(int lanes) { return CPU_WIDEST_OF_ALL(lanes, ray_kernels); }

void ray_starts_find(const struct light_rays *rays, const struct ray_surface *surface, const struct ray_points *points,
                     int lanes, struct ray_starts *starts)
{
    struct start_triangle t = {.own = NO_TRIANGLE};
    for (int i = 0, padded = (points->count + lanes - 1) / lanes * lanes; i < padded; i++) {
        double point[3], origin[3];
        int from = i < points->count ? i : points->count - 1;
        if (points->elements) {
            frame_to_world(surface->draw, surface->draw->mesh->positions + 3 * (size_t)points->elements[from], point);
            ray_point(rays->hierarchy, point, point);
            memcpy(origin, point, sizeof origin);
        } else {
            if (from == 0 || points->triangle[from] != points->triangle[from - 1])
                t = start_triangle_of(rays, surface, points->triangle[from]);
            start_on_triangle(&t, (double)points->b1[from], (double)points->b2[from], point, origin);
        }
        for (int k = 0; k < 3; k++) {
            starts->origin[k][i] = origin[k];
            starts->point[k][i] = point[k];
        }
        starts->own[i] = t.own;
    }
}
