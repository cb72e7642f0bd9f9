// ray_kernels.c: traces LANES rays at a time, to lights and for ambient occlusion. This file is compiled once for each
// instruction set, with LANES and ISA defined (meson.build).
#include "penumbra.h"

static void pass(struct light_rays *rays, const struct ray_starts *starts, int at, const struct frame_light *light,
                 unsigned active, float *to)
{
    float(*passed)[LANES] = (float(*)[LANES])to;
    struct ray_lanes ray;
    rays_to_light(&ray, rays, starts, at, light);
    if (light->radius > 0)
        trace_disc(rays, light, &ray, active, passed);
    else
        trace(rays, &ray, active, passed);
}

// --- ambient occlusion. The lanes contain rays of one point, because these have a common origin, and because
// neighbouring rays of the pattern have similar directions.

// Computes the triangle's unit normal on the side that faces the eye, in the coordinate space of the hierarchy. The
// normal is zero if the triangle has no area.
static void seen_face_normal(const struct light_rays *rays, const struct frame_draw *draw, uint32_t triangle,
                             double n[3])
{
    const double(*m)[4] = rays->frame->eye_to_world;
    double p[3][3], a[3], b[3], toward = 0, square = 0, eye[3];
    ray_corners(draw, triangle, p);
    for (int k = 0; k < 3; k++)
        ray_point(rays->hierarchy, p[k], p[k]);
    ray_point(rays->hierarchy, (const double[3]){m[0][3], m[1][3], m[2][3]}, eye);
    for (int i = 0; i < 3; i++) {
        a[i] = p[1][i] - p[0][i];
        b[i] = p[2][i] - p[0][i];
    }
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++) {
        n[i] = a[j] * b[k] - a[k] * b[j];
        toward += n[i] * (rays->frame->orthographic ? m[i][2] : eye[i] - p[0][i]);
        square += n[i] * n[i];
    }
    double scale = square > 0 ? (toward < 0 ? -1 : 1) / __builtin_sqrt(square) : 0;
    for (int i = 0; i < 3; i++)
        n[i] *= scale;
}

// Computes two unit vectors that are perpendicular to n and rotated about n.
static void turned_axes(const struct occlusion_pattern *pattern, uint32_t turn, const double n[3], double u[3],
                        double v[3])
{
    double first[3], second[3], c = pattern->cosine[turn], s = pattern->sine[turn];
    across(n, first, second);
    for (int i = 0; i < 3; i++) {
        u[i] = c * first[i] + s * second[i];
        v[i] = c * second[i] - s * first[i];
    }
}

// Returns the fraction of a point's rays that are not blocked. The rays start in the triangle's plane, like their
// hemisphere, not at the smooth surface above it (ray_starts.c), which would miss surfaces nearby. `longest` is the length of the longest ray, `turn` is
// the rotation of the pattern, and `shift` (0…1) shifts the lengths of the rays.
static float unoccluded_by_rays(struct light_rays *rays, const struct ray_starts *starts, int at, const double n[3],
                                double longest, uint32_t turn, double shift)
{
    const struct occlusion_pattern *pattern = rays->occlusion;
    double u[3], v[3];
    float sum = 0;
    struct ray_lanes ray;
    turned_axes(pattern, turn, n, u, v);
    for (int part = 0; part < LANES; part += DLANES)
        for (int i = 0; i < 3; i++) {
            dnum_store(ray.origin[i] + part, dnum_of(starts->point[i][at]));
            dnum_store(ray.point[i] + part, dnum_of(starts->point[i][at]));
        }
    inum_store(ray.own, inum_of(starts->own[at]));
    for (int first = 0; first < pattern->count; first += LANES) {
        int count = pattern->count - first < LANES ? pattern->count - first : LANES;
        _Alignas(64) float passed[3][LANES];
        for (int part = 0; part < LANES; part += DLANES) {
            dnum x = dnum_load(pattern->x + first + part), y = dnum_load(pattern->y + first + part);
            dnum z = dnum_load(pattern->z + first + part), length = dnum_load(pattern->length + first + part) + shift;
            for (int i = 0; i < 3; i++)
                dnum_store(ray.direction[i] + part, (x * u[i] + y * v[i]) + z * n[i]);
            length = dpick(length < 1, length, length - 1);
            dnum_store(ray.end + part, longest * (1 - (double)OCCLUSION_FADING * length));
        }
        trace(rays, &ray, (1u << count) - 1, passed);
        for (int i = 0; i < count; i++)
            sum += rays->frame->tints_rays ? (passed[0][i] + passed[1][i] + passed[2][i]) / 3 : passed[0][i];
    }
    return sum / (float)pattern->count;
}

static void occlude(struct light_rays *rays, const struct ray_surface *surface, const struct ray_starts *starts,
                    const struct ray_points *points, float *unoccluded)
{
    double n[3] = {0}, longest = (double)rays->frame->occlusion_radius * rays->hierarchy->scale;
    for (int i = 0; i < points->count; i++) {
        if (i == 0 || points->triangle[i] != points->triangle[i - 1])
            seen_face_normal(rays, surface->draw, points->triangle[i], n);
        uint32_t x = (uint32_t)points->x[i], y = (uint32_t)points->y[i];
        uint32_t turn = occlusion_turn(x, y), shift = occlusion_turn(y + 64, x); // two different patterns
        bool flat = n[0] == 0 && n[1] == 0 && n[2] == 0;
        unoccluded[i] =
            flat ? 1.0f : unoccluded_by_rays(rays, starts, i, n, longest, turn, shift * (1.0 / OCCLUSION_TURNS));
    }
}

#include "path_rays.inc"

#if LANES == 1
// Returns whether a triangle blocks any light.
static bool dims(void *user, const struct ray_triangle *triangle, const struct ray_lanes *ray,
                 const struct ray_view *view)
{
    struct light_rays *rays = user;
    rays->layers->count = 0;
    return filter_ray(user, triangle, ray, view, 1) || rays->layers->count;
}

static int64_t blocker(struct light_rays *rays, const struct ray_starts *starts, int at,
                       const struct frame_light *light, double *distance)
{
    struct ray_lanes ray;
    struct nearest_search search;
    double square = 0;
    rays_to_light(&ray, rays, starts, at, light);
    nearest_start(&search, rays->hierarchy, &ray);
    search.counts = dims;
    search.user = rays;
    nearest_hit(&search, 0, 0, (uint32_t)NO_TRIANGLE);
    for (int k = 0; k < 3; k++)
        square += ray.direction[k][0] * search.t * (ray.direction[k][0] * search.t);
    *distance = __builtin_sqrt(square) / rays->hierarchy->scale;
    return search.found.number == (uint32_t)NO_TRIANGLE ? NO_TRIANGLE : (int64_t)search.found.number;
}
#define NEAREST_BLOCKER .blocker = blocker
#else
#define NEAREST_BLOCKER .blocker = NULL
#endif

const struct ray_kernels FOR_ISA(ray_kernels) = {.pass = pass,
                                                 .pass_pixels = pass_pixels,
                                                 .occlude = occlude,
                                                 .nearest = nearest,
                                                 .pass_along = pass_along,
                                                 NEAREST_BLOCKER};
