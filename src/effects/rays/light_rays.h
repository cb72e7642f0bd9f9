// light_rays.h: computes the light that passes along LANES rays (docs/lighting/shadows.md). Define LANES before
// including this header.
#ifndef LIGHT_RAYS_H
#define LIGHT_RAYS_H

#include "ray_lanes.h"
#include "rays.h"

#include <stdlib.h>

// A ray through an edge intersects both triangles that share this edge. This does not matter for opaque surfaces. If
// both triangles are translucent, only one of them may dim the light. As in rasterization, the triangle on a fixed side
// of the edge, seen along the ray, dims the light.
static bool owns_edges(const struct ray_triangle *triangle, const double origin[3], const double d[3],
                       const double weights[3])
{
    double x[3], y[3], turn = (weights[0] + weights[1]) + weights[2];
    double size[3] = {__builtin_fabs(d[0]), __builtin_fabs(d[1]), __builtin_fabs(d[2])};
    int along = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    int i = (along + 1) % 3, j = (along + 2) % 3;
    for (int k = 0; k < 3; k++) {
        double z = (triangle->p[k][along] - origin[along]) / d[along];
        x[k] = (triangle->p[k][i] - origin[i]) - d[i] * z;
        y[k] = (triangle->p[k][j] - origin[j]) - d[j] * z;
    }
    for (int k = 0, a = 1, b = 2; k < 3; a = b, b = k++) {
        double dx = turn > 0 ? x[b] - x[a] : x[a] - x[b], dy = turn > 0 ? y[b] - y[a] : y[a] - y[b];
        if (weights[k] == 0 && !(dy > 0 || (dy == 0 && dx > 0)))
            return false;
    }
    return true;
}

// The light that passes through a triangle from one side, if this light is the same at all points.
struct side_share {
    bool known, constant;
    float passed[3];
};

// Gets the light that passes through a point of a triangle, with passed_channels() channels. If all points of the side
// transmit the same light, stores the light in `share`.
static void share_at(const struct frame *frame, uint32_t number, bool back, float b1, float b2,
                     struct side_share *share)
{
    if (share->known && share->constant)
        return;
    float *passed = share->passed;
    if (!share->known)
        share->constant = ray_share_is_constant(frame, number, back);
    share->known = true;
    if (frame->tints_rays)
        ray_transmittance(frame, number, back, b1, b2, passed);
    else
        passed[0] = passed[1] = passed[2] = 1 - ray_opacity(frame, number, back, b1, b2);
}

// Records the light that a translucent triangle lets through, and returns the rays that the triangle blocks. The
// function uses the side of the triangle that faces the light.
static unsigned filter_ray(void *user, const struct ray_triangle *triangle, const struct ray_lanes *ray,
                           const struct ray_view *view, unsigned lanes)
{
    const struct light_rays *r = user;
    struct ray_layers *layers = r->layers;
    const struct frame *frame = r->frame;
    const struct frame_draw_range *range = &frame->ranges[frame_range_of(frame, triangle->number)];
    if (!range->passes_rays)
        return lanes;
    _Alignas(64) double weights[3][LANES] = {{0}};
    crosses(triangle, ray, view, lanes, weights, NULL);
    const double(*p)[3] = triangle->p;
    double a[3], b[3], n[3];
    for (int i = 0; i < 3; i++) {
        a[i] = p[1][i] - p[0][i];
        b[i] = p[2][i] - p[0][i];
    }
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++)
        n[i] = a[j] * b[k] - a[k] * b[j];
    bool mirrored = frame->draws[range->draw].mirrored;
    struct side_share sides[2] = {{0}};
    unsigned ended = 0;
    for (unsigned rest = lanes; rest; rest &= rest - 1) {
        int i = __builtin_ctz(rest);
        const double o[3] = {ray->origin[0][i], ray->origin[1][i], ray->origin[2][i]};
        const double d[3] = {ray->direction[0][i], ray->direction[1][i], ray->direction[2][i]};
        const double w[3] = {weights[0][i], weights[1][i], weights[2][i]};
        if ((w[0] == 0 || w[1] == 0 || w[2] == 0) && !owns_edges(triangle, o, d, w))
            continue;
        double toward = (d[0] * n[0] + d[1] * n[1]) + d[2] * n[2], sum = (w[0] + w[1]) + w[2];
        float b1 = (float)(w[1] / sum), b2 = (float)(w[2] / sum);
        bool back = (toward < 0) != mirrored;
        share_at(frame, triangle->number, back, b1, b2, &sides[back]);
        const float *passed = sides[back].passed;
        struct ray_layer layer = {(uint32_t)i, triangle->number, {passed[0], passed[1], passed[2]}};
        if (passed[0] <= 0 && passed[1] <= 0 && passed[2] <= 0) {
            ended |= 1u << i;
            continue;
        }
        if (passed[0] >= 1 && passed[1] >= 1 && passed[2] >= 1)
            continue;
        if (layers->count == layers->capacity) {
            int capacity = layers->capacity ? 2 * layers->capacity : 64;
            struct ray_layer *grown = realloc(layers->list, (size_t)capacity * sizeof *grown);
            if (!grown) {
                layers->failed = true;
                return lanes;
            }
            layers->list = grown;
            layers->capacity = capacity;
        }
        layers->list[layers->count++] = layer;
    }
    return ended;
}

static int by_number(const void *a, const void *b)
{
    const struct ray_layer *x = a, *y = b;
    return (x->number > y->number) - (x->number < y->number);
}

// Returns the number of channels of the transmitted light: three if a material tints the light, otherwise one.
static int passed_channels(const struct frame *frame) { return frame->tints_rays ? 3 : 1; }

// Computes the share of the light that passes along LANES rays, with passed_channels() channels.
static __attribute__((noinline)) void trace(struct light_rays *r, const struct ray_lanes *ray, unsigned active,
                                            float passed[3][LANES])
{
    int channels = passed_channels(r->frame);
    struct ray_layers *layers = r->layers;
    r->sent += (unsigned)__builtin_popcount(active);
    if (!r->frame->passes_rays) {
        unsigned hit = any_hit(r->hierarchy, ray, active, NULL, NULL, r->scattered);
        num_store(passed[0], pick(mask_of_bits(hit), num_of(0.0f), num_of(1.0f)));
        return;
    }
    layers->count = 0;
    unsigned hit = any_hit(r->hierarchy, ray, active, filter_ray, r, r->scattered);
    for (int c = 0; c < channels; c++)
        num_store(passed[c], pick(mask_of_bits(hit), num_of(0.0f), num_of(1.0f)));
    if (layers->count > 1)
        qsort(layers->list, (size_t)layers->count, sizeof *layers->list, by_number);
    for (int i = 0; i < layers->count; i++)
        for (int c = 0; c < channels; c++)
            passed[c][layers->list[i].lane] *= layers->list[i].passed[c];
}

// Computes two unit vectors that are perpendicular to d and to each other.
static void across(const double d[3], double u[3], double v[3])
{
    double length = __builtin_sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]);
    double n[3] = {d[0] / length, d[1] / length, d[2] / length}, square = 0;
    int least = 0;
    for (int i = 1; i < 3; i++)
        least = __builtin_fabs(n[i]) < __builtin_fabs(n[least]) ? i : least;
    for (int i = 0; i < 3; i++) {
        u[i] = (i == least) - n[least] * n[i];
        square += u[i] * u[i];
    }
    length = __builtin_sqrt(square);
    for (int i = 0; i < 3; i++)
        u[i] /= length;
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++)
        v[i] = n[j] * u[k] - n[k] * u[j];
}

// Aims the rays at point n of a disc with the axes u and v.
LANE_FN void aim_at_point(struct ray_lanes *ray, const struct ray_lanes *centre, const struct light_points *points,
                          int n, double u[3][LANES], double v[3][LANES])
{
    *ray = *centre;
    for (int k = 0; k < 3; k++)
        for (int part = 0; part < LANES; part += DLANES)
            dnum_store(ray->direction[k] + part,
                       dnum_load(centre->direction[k] + part) +
                           (points->x[n] * dnum_load(u[k] + part) + points->y[n] * dnum_load(v[k] + part)));
}

// Stores the light along the first probe ray. Returns the lanes in which another probe ray finds a different value;
// these lanes are in a penumbra.
static unsigned trace_probes(struct light_rays *r, const struct ray_lanes *centre, double u[3][LANES],
                             double v[3][LANES], unsigned active, float passed[3][LANES])
{
    const struct light_points *points = &r->pattern->probes;
    _Alignas(64) float one[3][LANES];
    struct ray_lanes ray;
    unsigned agree = active;
    for (int n = 0; n < points->count && agree; n++) {
        aim_at_point(&ray, centre, points, n, u, v);
        trace(r, &ray, agree, n ? one : passed);
        for (int c = 0; c < passed_channels(r->frame) && n > 0; c++)
            agree &= mask_bits(num_load(one[c]) == num_load(passed[c]));
    }
    return active & ~agree;
}

// Computes the mean share of light over the points of a light with a size.
static void trace_disc(struct light_rays *r, const struct frame_light *light, const struct ray_lanes *centre,
                       unsigned active, float passed[3][LANES])
{
    const struct light_pattern *pattern = r->pattern;
    double radius = light->kind == LIGHT_DIRECTIONAL ? light->radius : light->radius * r->hierarchy->scale;
    _Alignas(64) float one[3][LANES], sum[3][LANES] = {{0}};
    int channels = passed_channels(r->frame);
    double u[3][LANES], v[3][LANES];
    for (int i = 0; i < LANES; i++) {
        double own_u[3], own_v[3];
        across((const double[3]){centre->direction[0][i], centre->direction[1][i], centre->direction[2][i]}, own_u,
               own_v);
        for (int k = 0; k < 3; k++) {
            u[k][i] = radius * own_u[k];
            v[k][i] = radius * own_v[k];
        }
    }
    unsigned penumbra = pattern->probes.count ? trace_probes(r, centre, u, v, active, passed) : active;
    for (int n = 0; n < pattern->all.count && penumbra; n++) {
        struct ray_lanes ray;
        aim_at_point(&ray, centre, &pattern->all, n, u, v);
        trace(r, &ray, penumbra, one);
        for (int c = 0; c < channels; c++)
            num_store(sum[c], num_load(sum[c]) + num_load(one[c]));
    }
    for (int c = 0; c < channels && penumbra; c++)
        num_store(passed[c],
                  pick(mask_of_bits(penumbra), num_load(sum[c]) / (float)pattern->all.count, num_load(passed[c])));
}

// Gets the start points of the rays of LANES points.
LANE_FN void rays_from(struct ray_lanes *ray, const struct ray_starts *starts, int at)
{
    for (int part = 0; part < LANES; part += DLANES)
        for (int i = 0; i < 3; i++) {
            dnum_store(ray->origin[i] + part, dnum_load(starts->origin[i] + at + part));
            dnum_store(ray->point[i] + part, dnum_load(starts->point[i] + at + part));
        }
    inum_store(ray->own, inum_load(starts->own + at));
}

// Aims rays at the centre of a light.
LANE_FN void rays_to_light(struct ray_lanes *ray, const struct light_rays *r, const struct ray_starts *starts, int at,
                           const struct frame_light *light)
{
    bool directional = light->kind == LIGHT_DIRECTIONAL;
    double position[3], end = directional ? (double)__builtin_inf() : 1.0;
    ray_point(r->hierarchy, light->world_position, position);
    rays_from(ray, starts, at);
    for (int part = 0; part < LANES; part += DLANES) {
        for (int i = 0; i < 3; i++)
            dnum_store(ray->direction[i] + part,
                       directional ? dnum_of(-light->world_axis[i]) : position[i] - dnum_load(ray->origin[i] + part));
        dnum_store(ray->end + part, dnum_of(end));
    }
}

#endif
