// ray_lanes.h: intersects LANES rays at a time with a hierarchy. Define LANES as 1, 4, 8 or 16 before including this
// file.
//
// A ray is origin + t direction with 0 < t < end, in the hierarchy's space. Only crosses() decides whether a ray meets
// a triangle. crosses() uses double and a fixed order of operations; boxes, and the same test with the floats of a leaf
// (may_cross), merely save work. The result therefore does not depend on the hierarchy, on the number of lanes, or on
// which rays are traced together.
//
// The test is from Woop, Benthin and Wald, "Watertight ray/triangle intersection" (JCGT 2013). Seen along the ray, with
// the origin at (0, 0), the signs of cross products of a triangle's corners show the side on which the ray passes each
// edge. Rounding is monotonic, so such a sign can be 0 but is never wrong. A sign of 0 is treated as inside for both
// triangles at the edge, so that no ray passes between them. A corner at the origin gives t = 0, so triangles around a
// point do not block its rays. A triangle whose plane contains the start point of the ray (through_points) does not
// block the ray either, because t is then 0 except for rounding.
//
// Rays with nearly the same direction form a bundle and traverse the hierarchy together. At a node, the intervals of
// their origins and directions are tested against the boxes of all children of the node at once (Boulos, Wald and
// Shirley, "Geometric and arithmetic culling methods for entire ray packets", 2006). Only leaves test individual rays.
// A ray with a different direction is a bundle of one.
//
// The file is longer than 600 lines because all of it is inlined into each traversal.
#ifndef RAY_LANES_H
#define RAY_LANES_H

#include "double_lanes.h"
#include "eights.h"
#include "hierarchy.h"

// The maximum distance of a bundle's rays from the first ray, as a sum over the coordinates. This limit applies to the
// start points of the rays, and to the end points at full length (at most 1).
#define BUNDLE_SPREAD 0.2f

struct ray_lanes {
    _Alignas(64) double origin[3][LANES], direction[3][LANES]; // t is measured in lengths of the direction
    double end[LANES];                                         // may be infinite
    // The twin of the triangle on which the ray starts. The twin never blocks the ray. NO_TRIANGLE if there is no
    // twin.
    int32_t own[LANES];
    double point[3][LANES]; // the start point: the origin, unless the origin was moved off the surface
};

// Rays seen along their directions d, where k is the index of the largest component of d: x = p_i − (d_i/d_k) p_k, y =
// p_j − (d_j/d_k) p_k and z = p_k/d_k, with k, i, j in cyclic order. In the rows x and y, one of the three factors is
// exactly 1, and another is exactly 0. Rays with different k can therefore use the same operations. Rays with a common
// k need fewer operations, with the same results.
struct ray_view {
    _Alignas(64) double x[3][LANES], y[3][LANES], z[3][LANES];
    float to_x[LANES], to_y[LANES]; // −d_i/d_k and −d_j/d_k
    unsigned of_k[3];               // for each k, the rays with this k
    int k, i, j; // the common k of the requested rays (only row k is then used), or −1 if there is none
};

LANE_FN void view_along(struct ray_view *v, const struct ray_lanes *ray)
{
    dnum zero = dnum_of(0), one = dnum_of(1);
    v->of_k[0] = v->of_k[1] = v->of_k[2] = 0;
    v->k = -1;
    for (int at = 0; at < LANES; at += DLANES) {
        dnum d[3], size[3];
        for (int i = 0; i < 3; i++) {
            d[i] = dnum_load(ray->direction[i] + at);
            size[i] = dabsolute(d[i]);
        }
        dmask on_x = (size[0] >= size[1]) & (size[0] >= size[2]), on_y = (size[1] >= size[2]) & (on_x == 0);
        dmask on[3] = {on_x, on_y, (on_x == 0) & (on_y == 0)};
        dnum inverse = one / dpick(on_x, d[0], dpick(on_y, d[1], d[2]));
        dnum to_x = -(dpick(on_x, d[1], dpick(on_y, d[2], d[0])) * inverse);
        dnum to_y = -(dpick(on_x, d[2], dpick(on_y, d[0], d[1])) * inverse);
        dnum_store_float(v->to_x + at, to_x);
        dnum_store_float(v->to_y + at, to_y);
        for (int k = 0; k < 3; k++) {
            int before = (k + 2) % 3, after = (k + 1) % 3; // i is after k, and j is before k, in cyclic order
            v->of_k[k] |= dmask_bits(on[k]) << at;
            dnum_store(v->x[k] + at, dpick(on[k], to_x, dpick(on[before], one, zero)));
            dnum_store(v->y[k] + at, dpick(on[k], to_y, dpick(on[after], one, zero)));
            dnum_store(v->z[k] + at, dpick(on[k], inverse, zero));
        }
    }
}

LANE_FN void view_common(struct ray_view *v, unsigned lanes)
{
    v->k = -1;
    for (int k = 0; k < 3; k++)
        v->k = (v->of_k[k] & lanes) == lanes ? k : v->k;
    v->i = v->k == 2 ? 0 : v->k + 1;
    v->j = v->k == 0 ? 2 : v->k - 1;
}

LANE_FN dnum along(const double row[3][LANES], int at, const dnum p[3])
{
    return (dnum_load(row[0] + at) * p[0] + dnum_load(row[1] + at) * p[1]) + dnum_load(row[2] + at) * p[2];
}

// Returns the lanes of `active` whose rays are blocked by a triangle. `weights` (may be NULL) receives the weights of
// the triangle's corners, not yet divided by their sum. `t` receives the ray parameter t of each hit.
LANE_FN unsigned crosses(const struct ray_triangle *triangle, const struct ray_lanes *ray, const struct ray_view *view,
                         unsigned active, double weights[3][LANES], double t[LANES])
{
    unsigned hit = 0;
    for (int at = 0; at < LANES; at += DLANES) {
        if (!(active >> at & ((1u << DLANES) - 1)))
            continue;
        dnum x[3], y[3], z[3], w[3], zero = dnum_of(0);
        if (view->k < 0) {
            for (int c = 0; c < 3; c++) {
                dnum p[3];
                for (int i = 0; i < 3; i++)
                    p[i] = triangle->p[c][i] - dnum_load(ray->origin[i] + at);
                x[c] = along(view->x, at, p);
                y[c] = along(view->y, at, p);
                z[c] = along(view->z, at, p);
            }
        } else {
            int k = view->k, i = view->i, j = view->j;
            dnum of_i = dnum_load(ray->origin[i] + at), of_j = dnum_load(ray->origin[j] + at),
                 of_k = dnum_load(ray->origin[k] + at);
            dnum to_x = dnum_load(view->x[k] + at), to_y = dnum_load(view->y[k] + at);
            for (int c = 0; c < 3; c++) {
                dnum depth = triangle->p[c][k] - of_k;
                x[c] = (triangle->p[c][i] - of_i) + to_x * depth;
                y[c] = (triangle->p[c][j] - of_j) + to_y * depth;
                z[c] = depth; // scaled below, after most rays have been rejected
            }
        }
        w[0] = x[1] * y[2] - y[1] * x[2];
        w[1] = x[2] * y[0] - y[2] * x[0];
        w[2] = x[0] * y[1] - y[0] * x[1];
        dmask positive = (w[0] >= zero) & (w[1] >= zero) & (w[2] >= zero);
        dmask negative = (w[0] <= zero) & (w[1] <= zero) & (w[2] <= zero);
        if (!(dmask_bits(positive | negative) << at & active))
            continue;
        for (int c = 0; c < 3 && view->k >= 0; c++)
            z[c] = dnum_load(view->z[view->k] + at) * z[c];
        dnum det = (w[0] + w[1]) + w[2];
        dnum depth = (w[0] * z[0] + w[1] * z[1]) + w[2] * z[2];
        depth = dpick(positive, depth, -depth);
        dnum size = dpick(positive, det, -det);
        dmask inside =
            (positive | negative) & (size > zero) & (depth > zero) & (depth < dnum_load(ray->end + at) * size);
        hit |= dmask_bits(inside) << at;
        for (int k = 0; k < 3 && weights; k++)
            dnum_store(weights[k] + at, w[k]);
        if (t)
            dnum_store(t + at, depth / size);
    }
    hit &= active;
    return hit ? hit & mask_bits(inum_load(ray->own) != (int32_t)triangle->twin) : 0;
}

// The rays of `lanes` cross a triangle. Returns the lanes whose start point is in the triangle's plane, within the
// rounding error:
//    |N·(p_0 − point)| ≤ 2 Σ_i |N_i| rounding_i + 2⁻⁵⁰ Σ_i (|a_j b_k| + |a_k b_j|) |p_0 − point|_i    N = a × b
// where a and b are the vectors from corner p_0 to the other corners. The triangle and the point are both rounded
// (hierarchy.rounding). The last term is the error of this determinant. (Shewchuk, "Adaptive precision floating-point
// arithmetic and fast robust geometric predicates", 1997, uses 7 · 2⁻⁵³ instead of 8 · 2⁻⁵³.)
LANE_FN unsigned through_points(const struct hierarchy *h, const struct ray_triangle *triangle,
                                const double point[3][LANES], unsigned lanes)
{
    const double(*p)[3] = triangle->p;
    unsigned through = 0;
    for (int at = 0; at < LANES; at += DLANES) {
        double rounding = 0;
        dnum away = dnum_of(0), error = dnum_of(0);
        if (!(lanes >> at & ((1u << DLANES) - 1)))
            continue;
        for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++) {
            double u = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]), v = (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
            dnum q = p[0][i] - dnum_load(point[i] + at);
            away += (u - v) * q;
            error += (__builtin_fabs(u) + __builtin_fabs(v)) * dabsolute(q);
            rounding += 2 * __builtin_fabs(u - v) * h->rounding[i];
        }
        through |= dmask_bits(dabsolute(away) <= rounding + 0x1p-50 * error) << at;
    }
    return lanes & through;
}

// --- boxes

// The floats of a ray for box tests.
//
// Coordinates of triangles are within −1…1. If the origin, the direction, its inverse and the box are rounded, the
// intersection with a plane of the box moves by less than 2⁻²¹ (1 + |origin|) in total. Each plane is therefore moved
// outwards by this distance.
struct box_rays {
    _Alignas(64) float low[3][LANES], high[3][LANES]; // the origin, to be subtracted from a box's low and high planes
    float origin[3][LANES], error[LANES];             // for may_cross
    float direction[3][LANES], inverse[3][LANES], end[LANES];
    unsigned down[3]; // the rays that meet the high plane of an axis first
    unsigned proper;  // rays with a direction; a ray from a light to the same point has no direction, and meets nothing
};

LANE_FN void box_rays_of(struct box_rays *b, const struct ray_lanes *ray)
{
    num reach = num_of(1.0f);
    for (int at = 0; at < LANES; at += DLANES) {
        dnum d[3], size;
        for (int i = 0; i < 3; i++) {
            d[i] = dnum_load(ray->direction[i] + at);
            dnum own = dabsolute(d[i]);
            size = i ? dpick(own > size, own, size) : own;
            dnum_store_float(b->origin[i] + at, dnum_load(ray->origin[i] + at));
        }
        dnum inverse = 1 / size;
        for (int i = 0; i < 3; i++)
            dnum_store_float(b->direction[i] + at, d[i] * inverse);
        dnum_store_float(b->end + at, dnum_load(ray->end + at) * size);
    }
    for (int i = 0; i < 3; i++)
        reach = max_of(reach, 1.0f + absolute(num_load(b->origin[i])));
    num_store(b->error, reach * 0x1p-20f);
    reach = reach * 0x1p-21f;
    num sum = num_of(0.0f);
    for (int i = 0; i < 3; i++) {
        num d = num_load(b->direction[i]);
        b->down[i] = mask_bits(d < 0.0f);
        sum += (d + num_load(b->origin[i])) * 0.0f;
        num_store(b->low[i], num_load(b->origin[i]) + reach);
        num_store(b->high[i], num_load(b->origin[i]) - reach);
        // The direction is parallel to the planes: the ray never reaches the planes, or reaches them too far away to
        // matter.
        num least = pick(d < 0.0f, num_of(-1e-30f), num_of(1e-30f));
        num_store(b->inverse[i], 1.0f / pick(absolute(d) < 1e-30f, least, d));
    }
    b->proper = mask_bits(sum == 0.0f);
    num_store(b->end, num_load(b->end) * (1.0f + 0x1p-20f));
}

// --- bundles

// Rays that are traced together, and the intervals that contain these rays. If one of the rays meets a box, the bundle
// meets the box. This is also true of the rounded numbers, because rounding is monotonic.
struct ray_bundle {
    unsigned lanes;
    int first[3], last[3];           // the planes that the rays meet first and last, as indices into a node's floats
    const float *start[3], *stop[3]; // for box_rays: the origin, to be subtracted from these planes
    eight near[3], far[3];           // the same for all rays
    eight least[3], most[3];         // the range of the inverse of their directions
    eight end;
};

// Returns the first ray of `rest`, and the rays after it with nearly the same direction.
LANE_FN unsigned bundle_lanes(const struct box_rays *b, unsigned rest)
{
    int first = __builtin_ctz(rest);
    unsigned same = rest;
    num spread = num_of(0.0f), away = num_of(0.0f);
    float length = b->end[first] < 1 ? b->end[first] : 1;
    for (int i = 0; i < 3; i++) {
        same &= b->down[i] >> first & 1 ? b->down[i] : ~b->down[i];
        spread += absolute(num_load(b->direction[i]) - b->direction[i][first]);
        away += absolute(num_load(b->low[i]) - b->low[i][first]);
    }
    return same & mask_bits(spread * length + away <= BUNDLE_SPREAD);
}

LANE_FN void bundle_of(struct ray_bundle *bundle, const struct box_rays *b, unsigned lanes)
{
    int one = __builtin_ctz(lanes);
    mask within = mask_of_bits(lanes);
    bundle->lanes = lanes;
    // Rays outside the bundle are replaced by the ray `one`.
    bundle->end = eight_of(-min_lane(-pick(within, num_load(b->end), num_of(b->end[one]))));
    for (int i = 0; i < 3; i++) {
        bool down = b->down[i] >> one & 1;
        bundle->first[i] = NODE_CHILDREN * (down ? 3 + i : i);
        bundle->last[i] = NODE_CHILDREN * (down ? i : 3 + i);
        bundle->start[i] = down ? b->high[i] : b->low[i];
        bundle->stop[i] = down ? b->low[i] : b->high[i];
        num inverse = pick(within, num_load(b->inverse[i]), num_of(b->inverse[i][one]));
        float low = -min_lane(-pick(within, num_load(b->low[i]), num_of(b->low[i][one])));
        float high = min_lane(pick(within, num_load(b->high[i]), num_of(b->high[i][one])));
        bundle->near[i] = eight_of(down ? high : low);
        bundle->far[i] = eight_of(down ? low : high);
        bundle->least[i] = eight_of(min_lane(inverse));
        bundle->most[i] = eight_of(-min_lane(-inverse));
    }
}

// Returns the children of a node that a bundle may meet, as bits.
LANE_FN unsigned meets_children(const struct ray_bundle *b, const struct ray_node *node)
{
    const float *planes = node->planes[0][0];
    eight near = eight_of(0), far = b->end;
    for (int i = 0; i < 3; i++) {
        eight a = eight_load(planes + b->first[i]) - b->near[i];
        eight c = eight_load(planes + b->last[i]) - b->far[i];
        near = eight_max(eight_min(a * b->least[i], a * b->most[i]), near);
        far = eight_min(eight_max(c * b->least[i], c * b->most[i]), far);
    }
    return eight_not_above(near, far);
}

// One ray, with the floats of box_rays.
struct lone_ray {
    int first[3], last[3]; // as in ray_bundle
    float near[3], far[3], inverse[3], end;
};

LANE_FN void lone_ray_of(struct lone_ray *r, const struct box_rays *b, int lane)
{
    for (int i = 0; i < 3; i++) {
        bool down = b->down[i] >> lane & 1;
        r->first[i] = NODE_CHILDREN * (down ? 3 + i : i);
        r->last[i] = NODE_CHILDREN * (down ? i : 3 + i);
        r->near[i] = down ? b->high[i][lane] : b->low[i][lane];
        r->far[i] = down ? b->low[i][lane] : b->high[i][lane];
        r->inverse[i] = b->inverse[i][lane];
    }
    r->end = b->end[lane];
}

// Returns the children of a node that a ray meets, as bits.
LANE_FN unsigned meets_alone(const struct lone_ray *r, const struct ray_node *node)
{
    const float *planes = node->planes[0][0];
    eight near = eight_of(0), far = eight_of(r->end);
    for (int i = 0; i < 3; i++) {
        eight inverse = eight_of(r->inverse[i]);
        near = eight_max((eight_load(planes + r->first[i]) - eight_of(r->near[i])) * inverse, near);
        far = eight_min((eight_load(planes + r->last[i]) - eight_of(r->far[i])) * inverse, far);
    }
    return eight_not_above(near, far);
}

// Returns the rays that meet a child of a node.
LANE_FN unsigned meets_child(const struct box_rays *b, const struct ray_bundle *bundle, const struct ray_node *node,
                             int child)
{
    const float *planes = node->planes[0][0] + child;
    num near = num_of(0.0f), far = num_load(b->end);
    for (int i = 0; i < 3; i++) {
        num inverse = num_load(b->inverse[i]);
        near = max_of((planes[bundle->first[i]] - num_load(bundle->start[i])) * inverse, near);
        far = min_of((planes[bundle->last[i]] - num_load(bundle->stop[i])) * inverse, far);
    }
    return mask_bits(near <= far);
}

// --- leaves

// One ray, with the floats of box_rays and ray_view.
struct leaf_ray {
    int32_t own;
    uint32_t axes[3]; // i, j and k of ray_view
    float origin[3];  // along these axes
    float to_x, to_y, error;
};

LANE_FN void leaf_ray_of(struct leaf_ray *r, const struct ray_lanes *ray, const struct box_rays *b,
                         const struct ray_view *view, int lane)
{
    uint32_t k = view->of_k[0] >> lane & 1 ? 0 : view->of_k[1] >> lane & 1 ? 1 : 2;
    *r = (struct leaf_ray){.own = ray->own[lane],
                           .axes = {k == 2 ? 0 : k + 1, k == 0 ? 2 : k - 1, k},
                           .to_x = view->to_x[lane],
                           .to_y = view->to_y[lane],
                           .error = b->error[lane]};
    for (int n = 0; n < 3; n++)
        r->origin[n] = b->origin[r->axes[n]][lane];
}

// Tests eight triangles for may_cross.
LANE_FN unsigned may_cross_eight(const float *leaf, uint32_t count, const struct leaf_ray *r)
{
    const float *at[3] = {leaf + (size_t)r->axes[0] * count, leaf + (size_t)r->axes[1] * count,
                          leaf + (size_t)r->axes[2] * count};
    eight x[3], y[3], sum = eight_of(r->error), to_x = eight_of(r->to_x), to_y = eight_of(r->to_y);
    eight origin[3] = {eight_of(r->origin[0]), eight_of(r->origin[1]), eight_of(r->origin[2])};
    for (int c = 0; c < 3; c++) {
        size_t row = (size_t)3 * (size_t)c * count;
        eight depth = eight_load(at[2] + row) - origin[2];
        x[c] = (eight_load(at[0] + row) - origin[0]) + to_x * depth;
        y[c] = (eight_load(at[1] + row) - origin[1]) + to_y * depth;
        sum += eight_absolute(x[c]) + eight_absolute(y[c]);
    }
    eight w0 = x[1] * y[2] - y[1] * x[2], w1 = x[2] * y[0] - y[2] * x[0], w2 = x[0] * y[1] - y[0] * x[1];
    eight most = eight_max(eight_max(w0, w1), w2), least = eight_min(eight_min(w0, w1), w2);
    eight error = sum * eight_of(r->error);
    unsigned may = eight_not_above(most, error) | eight_not_above(-error, least);
    return may & ~eight_same(eight_load(leaf + (LEAF_FLOATS - 1) * (size_t)count), r->own);
}

// Returns the triangles of a leaf that a ray may cross, as bits, without the one that the ray starts on. This is the test
// of crosses() with floats. Let R be 1 plus the largest coordinate of the origin. Corners and the origin are rounded, so
// the coordinates x and y that crosses() computes differ by less than 8.1 · 2⁻²⁴ R, and a product of two of them and its
// rounding by less than 10.1 · 2⁻²⁴ R (|x| + |y|) + 65.7 · 2⁻⁴⁸ R². With c = 2⁻²⁰ R, each w therefore differs by less
// than c (Σ (|x| + |y|) + c). If the origin is far away (c ≥ 1, or not a number), the ray may cross every triangle.
LANE_FN unsigned may_cross(const float *leaf, uint32_t count, const struct leaf_ray *r)
{
    unsigned bits = r->error < 1 ? may_cross_eight(leaf, count, r) : ~0u;
    if (count > 8 && r->error < 1)
        bits |= may_cross_eight(leaf + 8, count, r) << 8;
    return bits & ((1u << count) - 1);
}

// --- traversal

// Decides which rays a triangle blocks. Returns the `lanes` whose rays are blocked.
typedef unsigned ray_filter(void *user, const struct ray_triangle *triangle, const struct ray_lanes *ray,
                            const struct ray_view *view, unsigned lanes);

// Rays that traverse a hierarchy.
struct traversal {
    const struct hierarchy *hierarchy;
    const struct ray_lanes *ray;
    ray_filter *filter;
    void *user;
    struct ray_view view;
    struct box_rays boxes;
};

// Returns the rays of `lanes` that a triangle blocks.
static __attribute__((noinline, unused)) unsigned blocked_by(const struct traversal *t, uint32_t number, unsigned lanes)
{
    struct ray_triangle triangle;
    lanes &= mask_bits(inum_load(t->ray->own) != (int32_t)hierarchy_twin(t->hierarchy, number));
    if (!lanes)
        return 0;
    hierarchy_triangle(t->hierarchy, number, &triangle);
    lanes = crosses(&triangle, t->ray, &t->view, lanes, NULL, NULL);
    lanes = lanes ? lanes & ~through_points(t->hierarchy, &triangle, t->ray->point, lanes) : 0;
    return t->filter && lanes ? t->filter(t->user, &triangle, t->ray, &t->view, lanes) : lanes;
}

// Returns the rays of `lanes` that the triangles of a leaf block.
LANE_FN unsigned blocked_in_leaf(const struct traversal *t, const struct leaf_ray rays[LANES], uint32_t first,
                                 uint32_t count, unsigned lanes)
{
    const float *leaf = t->hierarchy->leaves + LEAF_FLOATS * (size_t)first;
    unsigned found[LANES], any = 0, blocked = 0;
    for (unsigned rest = lanes; rest; rest &= rest - 1) {
        int n = __builtin_ctz(rest);
        any |= found[n] = may_cross(leaf, count, &rays[n]);
    }
    for (; any; any &= any - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(any), number = leaf_number(leaf, count, i);
        unsigned there = 0;
        for (unsigned rest = lanes & ~blocked; rest; rest &= rest - 1) {
            int n = __builtin_ctz(rest);
            there |= (found[n] >> i & 1) << n;
        }
        blocked |= there ? blocked_by(t, number, there) : 0;
    }
    return blocked;
}

// Returns whether the triangles of a leaf block the ray of a lane.
LANE_FN bool blocked_alone(const struct traversal *t, const struct leaf_ray *ray, uint32_t first, uint32_t count,
                           int lane)
{
    const float *leaf = t->hierarchy->leaves + LEAF_FLOATS * (size_t)first;
    for (unsigned any = may_cross(leaf, count, ray); any; any &= any - 1)
        if (blocked_by(t, leaf_number(leaf, count, (uint32_t)__builtin_ctz(any)), 1u << lane))
            return true;
    return false;
}

LANE_FN void prefetch_child(const struct hierarchy *h, uint32_t child, uint32_t count)
{
    const char *at = count ? (const char *)(h->leaves + LEAF_FLOATS * (size_t)child) : (const char *)&h->nodes[child];
    for (int line = 0; line < 4; line++)
        __builtin_prefetch(at + (size_t)64 * (size_t)line);
}

// Children of a node that remain to be visited, as bits.
struct remaining {
    uint32_t node;
    unsigned children;
};

// Returns the lanes of a bundle whose rays are blocked.
LANE_FN unsigned walk_bundle(const struct traversal *t, const struct ray_bundle *bundle)
{
    const struct hierarchy *h = t->hierarchy;
    struct remaining stack[HIERARCHY_DEPTH];
    struct leaf_ray rays[LANES];
    int waiting = 0;
    unsigned lanes = bundle->lanes;
    for (unsigned rest = lanes; rest; rest &= rest - 1)
        leaf_ray_of(&rays[__builtin_ctz(rest)], t->ray, &t->boxes, &t->view, __builtin_ctz(rest));
    const struct ray_node *node = h->nodes;
    unsigned children = meets_children(bundle, node);
    for (;;) {
        while (!children) {
            if (!waiting)
                return bundle->lanes & ~lanes;
            node = &h->nodes[stack[--waiting].node];
            children = stack[waiting].children;
        }
        int i = __builtin_ctz(children);
        uint32_t child = node->child[i], count = node->count[i];
        children &= children - 1;
        if (!count) {
            if (children)
                stack[waiting++] = (struct remaining){(uint32_t)(node - h->nodes), children};
            node = &h->nodes[child];
            children = meets_children(bundle, node);
            for (unsigned rest = children; rest; rest &= rest - 1)
                prefetch_child(h, node->child[__builtin_ctz(rest)], node->count[__builtin_ctz(rest)]);
            continue;
        }
        lanes &= ~blocked_in_leaf(t, rays, child, count, lanes & meets_child(&t->boxes, bundle, node, i));
        if (!lanes)
            return bundle->lanes;
    }
}

// Returns the rays of `lanes` that are blocked. Each ray is traced alone, but the rays take turns: while the next node of
// one ray is loaded from memory, the others continue.
LANE_FN unsigned walk_alone(const struct traversal *t, unsigned lanes)
{
    const struct hierarchy *h = t->hierarchy;
    struct remaining stack[LANES][HIERARCHY_DEPTH + 1]; // the first entry has no children
    struct walk {
        uint32_t child, count; // the next node or leaf
        int lane;
        struct remaining *top;
        struct lone_ray ray;
        struct leaf_ray leaf_ray;
    } walks[LANES];
    unsigned blocked = 0;
    int left = 0;
    for (unsigned rest = lanes; rest; rest &= rest - 1, left++) {
        int n = __builtin_ctz(rest);
        walks[left].child = walks[left].count = 0;
        walks[left].lane = n;
        walks[left].top = stack[left];
        *walks[left].top = (struct remaining){0};
        lone_ray_of(&walks[left].ray, &t->boxes, n);
        leaf_ray_of(&walks[left].leaf_ray, t->ray, &t->boxes, &t->view, n);
    }
    while (left)
        for (int n = left - 1; n >= 0; n--) {
            struct walk *w = &walks[n];
            uint32_t node = w->child;
            unsigned children = 0;
            if (!w->count) {
                children = meets_alone(&w->ray, &h->nodes[node]);
            } else if (blocked_alone(t, &w->leaf_ray, node, w->count, w->lane)) {
                blocked |= 1u << w->lane;
                *w = walks[--left];
                continue;
            }
            if (!children) {
                children = w->top->children;
                node = w->top->node;
                if (!children) {
                    *w = walks[--left];
                    continue;
                }
                w->top--;
            }
            int i = __builtin_ctz(children);
            w->child = h->nodes[node].child[i];
            w->count = h->nodes[node].count[i];
            prefetch_child(h, w->child, w->count);
            children &= children - 1;
            if (children)
                *++w->top = (struct remaining){node, children};
        }
    return blocked;
}

// Returns the lanes of `active` whose rays are blocked. If `filter` is NULL, every triangle blocks a ray. `scattered`
// means that few rays are neighbours, so that each is traced alone.
LANE_FN unsigned any_hit(const struct hierarchy *h, const struct ray_lanes *ray, unsigned active, ray_filter *filter,
                         void *user, bool scattered)
{
    struct traversal t;
    struct ray_bundle bundle;
    unsigned hit = 0, alone = 0;
    if (!h->triangle_count || !active)
        return 0;
    t.hierarchy = h;
    t.ray = ray;
    t.filter = filter;
    t.user = user;
    box_rays_of(&t.boxes, ray);
    view_along(&t.view, ray);
    if (scattered)
        alone = active & t.boxes.proper;
    for (unsigned rest = active & t.boxes.proper & ~alone, lanes; rest; rest &= ~lanes) {
        // If two rays have no neighbours, all others are probably scattered, too.
        lanes = alone & (alone - 1) ? rest & -rest : bundle_lanes(&t.boxes, rest);
        if (!(lanes & (lanes - 1))) {
            alone |= lanes;
            continue;
        }
        bundle_of(&bundle, &t.boxes, lanes);
        view_common(&t.view, lanes);
        hit |= walk_bundle(&t, &bundle);
    }
    view_common(&t.view, alone);
    return alone ? hit | walk_alone(&t, alone) : hit;
}

// Returns the children of a node that a ray meets, as bits, and the ray's distances from them.
LANE_FN unsigned meets_near(const struct lone_ray *r, const struct ray_node *node, float distance[NODE_CHILDREN])
{
    const float *planes = node->planes[0][0];
    eight near = eight_of(0), far = eight_of(r->end);
    for (int i = 0; i < 3; i++) {
        eight inverse = eight_of(r->inverse[i]);
        near = eight_max((eight_load(planes + r->first[i]) - eight_of(r->near[i])) * inverse, near);
        far = eight_min((eight_load(planes + r->last[i]) - eight_of(r->far[i])) * inverse, far);
    }
    memcpy(distance, &near, sizeof near);
    return eight_not_above(near, far);
}

// A node or leaf that remains to be visited, and the ray's distance from it.
struct waiting {
    uint32_t child, count;
    float distance;
};

// Adds the children of a node to the stack, the nearest last.
LANE_FN int push_children(struct waiting *stack, int waiting, const struct lone_ray *ray, const struct ray_node *node)
{
    float distance[NODE_CHILDREN];
    int first = waiting;
    for (unsigned rest = meets_near(ray, node, distance); rest; rest &= rest - 1) {
        int i = __builtin_ctz(rest), at = waiting++;
        for (; at > first && stack[at - 1].distance < distance[i]; at--)
            stack[at] = stack[at - 1];
        stack[at] = (struct waiting){node->child[i], node->count[i], distance[i]};
    }
    return waiting;
}

// The search for the nearest triangle on one of LANES rays. A triangle at the distance `after` must have a higher number than
// `after_number`, so that a search can continue behind a triangle. `counts` decides whether a triangle is considered; NULL: all.
struct nearest_search {
    const struct hierarchy *hierarchy;
    const struct ray_lanes *ray;
    struct ray_view view;
    struct box_rays boxes;
    int lane;
    double after;
    uint32_t after_number;
    bool (*counts)(void *user, const struct ray_triangle *triangle, const struct ray_lanes *ray,
                   const struct ray_view *view);
    void *user;
    // The result: NO_TRIANGLE if there is none. If several triangles are at this distance, it is the lowest number.
    struct ray_triangle found;
    double t, weights[3]; // of the corners, not yet divided by their sum
};

LANE_FN void nearest_start(struct nearest_search *s, const struct hierarchy *h, const struct ray_lanes *ray)
{
    s->hierarchy = h;
    s->ray = ray;
    s->counts = NULL;
    box_rays_of(&s->boxes, ray);
    view_along(&s->view, ray);
}

// Stores the triangle if the ray meets it before the one that was found last. Returns whether it is stored.
static __attribute__((noinline, unused)) bool found_nearer(struct nearest_search *s, uint32_t number)
{
    struct ray_triangle triangle;
    _Alignas(64) double weights[3][LANES], t[LANES];
    const unsigned lane = 1u << s->lane;
    hierarchy_triangle(s->hierarchy, number, &triangle);
    if (!crosses(&triangle, s->ray, &s->view, lane, weights, t))
        return false;
    const double at = t[s->lane];
    if (at < s->after || (at == s->after && (int64_t)number <= (int64_t)(int32_t)s->after_number) ||
        (s->found.number != (uint32_t)NO_TRIANGLE && (at > s->t || (at == s->t && number > s->found.number))))
        return false;
    if (through_points(s->hierarchy, &triangle, s->ray->point, lane) ||
        (s->counts && !s->counts(s->user, &triangle, s->ray, &s->view)))
        return false;
    s->found = triangle;
    s->t = at;
    for (int k = 0; k < 3; k++)
        s->weights[k] = weights[k][s->lane];
    return true;
}

static __attribute__((unused)) void nearest_hit(struct nearest_search *s, int lane, double after, uint32_t after_number)
{
    const struct hierarchy *h = s->hierarchy;
    struct waiting stack[NODE_CHILDREN * HIERARCHY_DEPTH]; // not cleared, which would take as long as a ray
    struct lone_ray lone;
    struct leaf_ray leaf_ray;
    double size = 0;
    stack[0] = (struct waiting){0, 0, 0};
    lone_ray_of(&lone, &s->boxes, lane);
    leaf_ray_of(&leaf_ray, s->ray, &s->boxes, &s->view, lane);
    view_common(&s->view, 1u << lane);
    for (int i = 0; i < 3; i++) {
        double own = __builtin_fabs(s->ray->direction[i][lane]);
        size = own > size ? own : size;
    }
    s->lane = lane;
    s->after = after;
    s->after_number = after_number;
    s->found.number = (uint32_t)NO_TRIANGLE;
    s->t = 0;
    for (int waiting = h->triangle_count && s->boxes.proper >> lane & 1 ? 1 : 0; waiting;) {
        struct waiting next = stack[--waiting];
        if (next.distance > lone.end)
            continue;
        if (!next.count) {
            waiting = push_children(stack, waiting, &lone, &h->nodes[next.child]);
            continue;
        }
        const float *leaf = h->leaves + LEAF_FLOATS * (size_t)next.child;
        for (unsigned rest = may_cross(leaf, next.count, &leaf_ray); rest; rest &= rest - 1)
            if (found_nearer(s, leaf_number(leaf, next.count, (uint32_t)__builtin_ctz(rest))))
                lone.end = (float)(s->t * size) * (1.0f + 0x1p-20f); // as in box_rays_of
    }
}

#endif
