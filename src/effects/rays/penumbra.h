// penumbra.h: computes the light that reaches neighbouring pixels from a light with a size. Define LANES before
// including this header.
//
// The fragments of a cell of 8 × 8 pixels share rays. First, at least CELL_PROBES rays are traced from all fragments of
// the cell, each to another point of the light. If these rays agree, the cell is in full light or in full shadow.
// Otherwise the cell is in a penumbra. There, the light is computed with all rays of the pattern at 4 × 4 pixels, and
// interpolated between them by cubic polynomials, if the values and the positions of the fragments are smooth. If they
// are not (narrow penumbrae, silhouettes, thin objects), every fragment uses all rays of the pattern.
//
// Only the fragments of a batch matter, and a batch is the same for every instruction set and number of threads.
#ifndef PENUMBRA_H
#define PENUMBRA_H

#include "light_coverage.h"

enum { CELL = 8, CELL_SHIFT = 3, CELLS_ACROSS = 8, NODES = 4 };
// Cells with fewer fragments are not interpolated.
enum { SMOOTH_MIN = 24 };
// The largest difference between a value at a node and its extrapolation from the other three nodes of its row.
#define SMOOTH_VALUE 0.08f
// Surfaces whose weight is smaller use few rays.
enum { FEW_WEIGHT = 40 };
// The largest distance of a fragment from the interpolated surface, in distances of pixels.
#define SMOOTH_POSITION 0.5

static const int node_at[NODES] = {0, 2, 5, 7};

// Up to LANES fragments, with rays to the centre of the light.
struct ray_packet {
    struct ray_lanes centre;
    double u[3][LANES], v[3][LANES];
    const uint16_t *points; // indices of the fragments
    int count;
};

static void packet_fill(struct ray_packet *p, const struct pixel_rays *s, const uint16_t *points, int count)
{
    const struct ray_scratch *aims = s->pixels->scratch;
    p->points = points;
    p->count = count < LANES ? count : LANES;
    for (int i = 0; i < LANES; i++) {
        int from = points[i < p->count ? i : 0];
        for (int k = 0; k < 3; k++) {
            p->centre.origin[k][i] = s->starts->origin[k][from];
            p->centre.point[k][i] = s->starts->point[k][from];
            p->centre.direction[k][i] = aims->direction[k][from];
            p->u[k][i] = aims->u[k][from];
            p->v[k][i] = aims->v[k][from];
        }
        p->centre.own[i] = s->starts->own[from];
        p->centre.end[i] = s->directional ? (double)__builtin_inf() : 1.0;
    }
}

static unsigned packet_lanes(const struct ray_packet *p) { return (unsigned)((1ull << p->count) - 1); }

// Aims each fragment's ray at a point of its own.
LANE_FN void aim_apart(struct ray_lanes *ray, const struct ray_packet *p, const struct light_points *points,
                       const int number[LANES])
{
    _Alignas(64) double x[LANES], y[LANES];
    for (int i = 0; i < LANES; i++) {
        x[i] = points->x[number[i]];
        y[i] = points->y[number[i]];
    }
    *ray = p->centre;
    for (int k = 0; k < 3; k++)
        for (int part = 0; part < LANES; part += DLANES)
            dnum_store(ray->direction[k] + part,
                       dnum_load(p->centre.direction[k] + part) + (dnum_load(x + part) * dnum_load(p->u[k] + part) +
                                                                   dnum_load(y + part) * dnum_load(p->v[k] + part)));
}

// --- rays

// Returns the points of the light for a surface that faces it by the cosine weight/255. A surface at a grazing angle
// receives little light, so that fewer rays are as accurate.
static const struct light_points *points_for(const struct pixel_rays *s, int weight)
{
    const struct light_pattern *pattern = s->rays->pattern;
    return weight < FEW_WEIGHT ? &pattern->few : &pattern->all;
}

static int largest_weight(const struct pixel_rays *s, const uint16_t *points, int count)
{
    int weight = 0;
    for (int i = 0; i < count; i++)
        weight = s->pixels->weight[points[i]] > weight ? s->pixels->weight[points[i]] : weight;
    return weight;
}

// The rays of one fragment: the points number, number + step, number + 2 step … of the light.
struct ray_share {
    int number, step, used;
};

// Divides the rays of the pattern among the fragments of a pixel, which are listed one after the other.
static struct ray_share share_of(const struct pixel_rays *s, const uint16_t *points, int count, int at, int all)
{
    const float *x = s->pixels->x, *y = s->pixels->y;
    int low = at, high = at + 1;
    for (; low > 0 && x[points[low - 1]] == x[points[at]] && y[points[low - 1]] == y[points[at]]; low--)
        ;
    for (; high < count && x[points[high]] == x[points[at]] && y[points[high]] == y[points[at]]; high++)
        ;
    return (struct ray_share){(at - low) % all, high - low, 0};
}

// Computes the light at each of `count` fragments. Returns the number of fragments for which rays were traced.
static int pass_each(const struct pixel_rays *s, const uint16_t *points, int count)
{
    uint16_t rest[RAY_STARTS_MAX];
    if (s->blocker_count >= 0) {
        count = pass_listed(s, points, count, BLOCKERS_COVER, rest);
        points = rest;
    }
    const struct light_points *all = points_for(s, largest_weight(s, points, count));
    for (int first = 0; first < count; first += LANES) {
        struct ray_packet p;
        struct ray_share share[LANES] = {{0}};
        _Alignas(64) float one[3][LANES], sum[3][LANES] = {{0}};
        packet_fill(&p, s, points + first, count - first);
        for (int i = 0; i < p.count; i++)
            share[i] = share_of(s, points, count, first + i, all->count);
        for (;;) {
            int number[LANES] = {0};
            struct ray_lanes ray;
            unsigned active = 0;
            for (int i = 0; i < p.count; i++)
                if (share[i].number < all->count) {
                    active |= 1u << i;
                    number[i] = share[i].number;
                    share[i].number += share[i].step;
                    share[i].used++;
                }
            if (!active)
                break;
            aim_apart(&ray, &p, all, number);
            trace(s->rays, &ray, active, one);
            for (unsigned bits = active; bits; bits &= bits - 1)
                for (int c = 0; c < s->channels; c++)
                    sum[c][__builtin_ctz(bits)] += one[c][__builtin_ctz(bits)];
        }
        for (int c = 0; c < s->channels; c++)
            for (int i = 0; i < p.count; i++)
                s->passed[c][p.points[i]] = sum[c][i] / (float)share[i].used;
    }
    return count;
}

// Traces the first rays of a cell. If all of them agree, stores their value at all fragments and returns true.
// Otherwise, counts the rays to points that represent equal areas of the light, and sums up their light (channel 0).
static bool pass_alike(const struct pixel_rays *s, const uint16_t *points, int count)
{
    struct ray_scratch *scratch = s->pixels->scratch;
    int turns = (CELL_PROBES + count - 1) / count;
    float value[3] = {0};
    bool alike = true;
    if (turns > LIGHT_PROBES)
        turns = LIGHT_PROBES;
    for (int first = 0; first < count; first += LANES) {
        struct ray_packet p;
        struct ray_lanes ray;
        packet_fill(&p, s, points + first, count - first);
        for (int i = 0; i < p.count; i++)
            scratch->probes[p.points[i]] = scratch->probed[p.points[i]] = 0;
        for (int turn = 0; turn < turns; turn++) {
            _Alignas(64) float one[3][LANES];
            int number[LANES];
            for (int i = 0; i < LANES; i++) // 79/128 is close to the golden ratio
                number[i] = (79 * (first + i) + 37 * turn) & (CELL_PROBES - 1);
            aim_apart(&ray, &p, &s->rays->pattern->cell, number);
            trace(s->rays, &ray, packet_lanes(&p), one);
            for (int c = 0; c < s->channels; c++) {
                value[c] = first || turn ? value[c] : one[c][0];
                alike &= !(mask_bits(num_load(one[c]) != value[c]) & packet_lanes(&p));
            }
            for (int i = 0; i < p.count; i++)
                if (!(number[i] & 1)) { // not at the rim
                    scratch->probes[p.points[i]] += 1;
                    scratch->probed[p.points[i]] += one[0][i];
                }
        }
    }
    for (int c = 0; c < s->channels && alike; c++)
        for (int i = 0; i < count; i++)
            s->passed[c][points[i]] = value[c];
    return alike;
}

// Computes the weights of the values at the four nodes for the cubic polynomial at x.
static void node_weights(int x, double w[NODES])
{
    for (int i = 0; i < NODES; i++) {
        w[i] = 1;
        for (int k = 0; k < NODES; k++)
            if (k != i)
                w[i] *= (double)(x - node_at[k]) / (node_at[i] - node_at[k]);
    }
}

// Returns whether the values of four nodes are smooth: the last one is close to the quadratic polynomial through the
// others.
static bool smooth_row(float a, float b, float c, float d, float tolerance)
{
    float expected = (a - (7.0f / 3.0f) * b) + (7.0f / 3.0f) * c;
    return __builtin_fabsf(d - expected) <= tolerance;
}

static bool smooth_values(const struct pixel_rays *s, const uint16_t nodes[NODES * NODES])
{
    float tolerance = SMOOTH_VALUE * 255 / (float)largest_weight(s, nodes, NODES * NODES);
    for (int c = 0; c < s->channels; c++)
        for (int i = 0; i < NODES; i++) {
            const float *v = s->passed[c];
            if (!smooth_row(v[nodes[NODES * i + 0]], v[nodes[NODES * i + 1]], v[nodes[NODES * i + 2]],
                            v[nodes[NODES * i + 3]], tolerance) ||
                !smooth_row(v[nodes[i]], v[nodes[NODES + i]], v[nodes[2 * NODES + i]], v[nodes[3 * NODES + i]],
                            tolerance))
                return false;
        }
    return true;
}

// The first rays of a group of pixels, and what the interpolated light lets expect.
struct trial {
    float rays, found, expected, variance;
};

static void trial_add(struct trial *t, float rays, float found, float light)
{
    t->found += found;
    t->expected += rays * light;
    t->variance += rays * light * (1 - light);
}

// Returns whether the rays are very unlikely. `doubt` is a variance that every light may have.
static bool trial_fails(const struct trial *t, float doubt)
{
    float off = t->found - t->expected;
    return off * off > 10 * (t->variance + doubt);
}

// Returns whether the first rays of a cell contradict its interpolated light, in a row, in a column, or in a square of
// 2 × 2 pixels. They do so where a shadow is narrower than the distance between nodes.
static bool contradicted(const struct pixel_rays *s, const uint16_t *points, int count)
{
    struct trial rows[CELL] = {{0}}, columns[CELL] = {{0}}, squares[CELL * CELL / 4] = {{0}};
    for (int n = 0; n < count; n++) {
        int x = (int)s->pixels->x[points[n]] % CELL, y = (int)s->pixels->y[points[n]] % CELL;
        float rays = s->pixels->scratch->probes[points[n]], found = s->pixels->scratch->probed[points[n]];
        float light = s->passed[0][points[n]];
        trial_add(&rows[y], rays, found, light);
        trial_add(&columns[x], rays, found, light);
        trial_add(&squares[y / 2 * (CELL / 2) + x / 2], rays, found, light);
    }
    bool fails = false;
    for (int i = 0; i < CELL; i++)
        fails |= trial_fails(&rows[i], 0.2f) || trial_fails(&columns[i], 0.2f);
    for (int i = 0; i < CELL * CELL / 4; i++)
        fails |= trial_fails(&squares[i], 0.2f);
    return fails;
}

// Interpolates the light of a cell. Fragments that are not on the surface between the nodes, or whose first rays
// contradict the interpolated light, use all rays. Returns false, and stores no values, if the cell is not smooth.
static bool pass_smooth(struct pixel_rays *s, const uint16_t *points, int count)
{
    uint16_t of_pixel[CELL][CELL], nodes[NODES * NODES], apart[RAY_STARTS_MAX];
    double weight[CELL][NODES], size = 0;
    int apart_count = 0;
    if (count < SMOOTH_MIN)
        return false;
    for (int i = 0; i < CELL * CELL; i++)
        of_pixel[i / CELL][i % CELL] = UINT16_MAX;
    for (int i = count - 1; i >= 0; i--)
        of_pixel[(int)s->pixels->y[points[i]] % CELL][(int)s->pixels->x[points[i]] % CELL] = points[i];
    for (int j = 0; j < NODES; j++)
        for (int i = 0; i < NODES; i++)
            if ((nodes[NODES * j + i] = of_pixel[node_at[j]][node_at[i]]) == UINT16_MAX)
                return false;
    if (pass_each(s, nodes, NODES * NODES) > NODES * NODES / 2)
        s->blocker_count = -1; // too many
    if (!smooth_values(s, nodes))
        return false;
    const double(*p)[RAY_STARTS_MAX] = s->starts->point;
    for (int k = 0; k < 3; k++) {
        double d = p[k][nodes[15]] - p[k][nodes[0]], e = p[k][nodes[3]] - p[k][nodes[12]];
        size += d * d + e * e;
    }
    size *= SMOOTH_POSITION * SMOOTH_POSITION / (4 * 49);
    for (int i = 0; i < CELL; i++)
        node_weights(i, weight[i]);
    for (int n = 0; n < count; n++) {
        const double *wx = weight[(int)s->pixels->x[points[n]] % CELL],
                     *wy = weight[(int)s->pixels->y[points[n]] % CELL];
        double at[3] = {-p[0][points[n]], -p[1][points[n]], -p[2][points[n]]}, value[3] = {0};
        for (int j = 0; j < NODES; j++)
            for (int i = 0; i < NODES; i++) {
                double w = wx[i] * wy[j];
                for (int k = 0; k < 3; k++)
                    at[k] += w * p[k][nodes[NODES * j + i]];
                for (int c = 0; c < s->channels; c++)
                    value[c] += w * (double)s->passed[c][nodes[NODES * j + i]];
            }
        if (!((at[0] * at[0] + at[1] * at[1]) + at[2] * at[2] <= size)) {
            apart[apart_count++] = points[n];
            continue;
        }
        for (int c = 0; c < s->channels; c++) // a node keeps its value
            s->passed[c][points[n]] = (float)(value[c] < 0 ? 0 : value[c] > 1 ? 1 : value[c]);
        struct trial own = {0};
        trial_add(&own, s->pixels->scratch->probes[points[n]], s->pixels->scratch->probed[points[n]],
                  s->passed[0][points[n]]);
        if (trial_fails(&own, 0.02f))
            apart[apart_count++] = points[n];
    }
    pass_each(s, apart, apart_count);
    return !contradicted(s, points, count);
}

// Sorts the wanted fragments by cell. A batch is within a tile of CELLS_ACROSS × CELLS_ACROSS cells.
static int sort_by_cell(const struct ray_pixels *pixels, uint16_t *points, int end[CELLS_ACROSS * CELLS_ACROSS])
{
    uint8_t cell[RAY_STARTS_MAX];
    int start[CELLS_ACROSS * CELLS_ACROSS + 1] = {0};
    for (int i = 0; i < pixels->count; i++) {
        cell[i] = (uint8_t)(((int)pixels->y[i] >> CELL_SHIFT) % CELLS_ACROSS * CELLS_ACROSS +
                            ((int)pixels->x[i] >> CELL_SHIFT) % CELLS_ACROSS);
        start[cell[i] + 1] += pixels->weight[i] != 0;
    }
    for (int c = 0; c < CELLS_ACROSS * CELLS_ACROSS; c++)
        end[c] = start[c + 1] += start[c];
    for (int i = 0; i < pixels->count; i++)
        if (pixels->weight[i])
            points[start[cell[i]]++] = (uint16_t)i;
    return end[CELLS_ACROSS * CELLS_ACROSS - 1];
}

static void find_aims(const struct pixel_rays *s, const struct frame_light *light, double radius)
{
    struct ray_scratch *aims = s->pixels->scratch;
    for (int at = 0; at < s->pixels->count; at += LANES) {
        struct ray_lanes ray;
        rays_to_light(&ray, s->rays, s->starts, at, light);
        for (int i = 0; i < LANES; i++) {
            double u[3], v[3];
            for (int k = 0; k < 3; k++)
                aims->direction[k][at + i] = ray.direction[k][i];
            if (!s->pixels->weight[at + i])
                continue;
            across((const double[3]){ray.direction[0][i], ray.direction[1][i], ray.direction[2][i]}, u, v);
            for (int k = 0; k < 3; k++) {
                aims->u[k][at + i] = radius * u[k];
                aims->v[k][at + i] = radius * v[k];
            }
        }
    }
}

// Computes the light of the fragments of a cell.
static void pass_cell(struct pixel_rays *s, const uint16_t *points, int count)
{
    uint16_t rest[RAY_STARTS_MAX];
    find_blockers(s, points, count);
    if (few_cover(s, points, count)) {
        pass_each(s, points, count);
    } else if (pass_alike(s, points, count)) {
        // In a lit cell, the rays may miss a shadow that reaches a few pixels.
        if (s->blocker_count > 0 && s->blocker_count <= BLOCKERS_LIT && s->passed[0][points[0]] > 0)
            pass_listed(s, points, count, BLOCKERS_COVER, rest);
    } else if (!pass_smooth(s, points, count)) {
        pass_each(s, points, count);
    }
}

static void pass_pixels(struct light_rays *rays, const struct ray_starts *starts, const struct ray_pixels *pixels,
                        const struct frame_light *light, float passed[3][RAY_STARTS_MAX])
{
    bool directional = light->kind == LIGHT_DIRECTIONAL;
    struct pixel_rays s = {.rays = rays,
                           .starts = starts,
                           .pixels = pixels,
                           .passed = passed,
                           .channels = passed_channels(rays->frame),
                           .directional = directional};
    ray_point(rays->hierarchy, light->world_position, s.light);
    s.radius = directional ? light->radius : light->radius * rays->hierarchy->scale;
    uint16_t points[RAY_STARTS_MAX];
    int end[CELLS_ACROSS * CELLS_ACROSS];
    if (!sort_by_cell(pixels, points, end))
        return;
    find_aims(&s, light, s.radius);
    for (int c = 0, first = 0; c < CELLS_ACROSS * CELLS_ACROSS; first = end[c++]) {
        int count = end[c] - first;
        if (!count)
            continue;
        pass_cell(&s, points + first, count);
    }
}

#endif
