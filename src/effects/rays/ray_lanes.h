// ray_lanes.h: intersects LANES rays at a time with a hierarchy. Define LANES as 1, 4, 8 or 16 before including this
// file.
//
// A ray is origin + t direction with 0 < t < end, in the hierarchy's space. Only crosses() decides whether a ray meets
// a triangle. crosses() uses double and a fixed order of operations; boxes merely save work. The result therefore does
// not depend on the hierarchy, on the number of lanes, or on which rays are traced together.
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
    unsigned of_k[3]; // for each k, the rays with this k
    int k, i, j;      // the common k of the requested rays (only row k is then used), or −1 if there is none
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
                                const struct ray_lanes *ray, unsigned lanes)
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
            dnum q = p[0][i] - dnum_load(ray->point[i] + at);
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
    float direction[3][LANES], inverse[3][LANES], end[LANES];
    unsigned down[3]; // the rays that meet the high plane of an axis first
    unsigned proper;  // rays with a direction; a ray from a light to the same point has no direction, and meets nothing
};

LANE_FN void box_rays_of(struct box_rays *b, const struct ray_lanes *ray)
{
    _Alignas(64) float origin[3][LANES];
    num reach = num_of(1.0f);
    for (int at = 0; at < LANES; at += DLANES) {
        dnum d[3], size;
        for (int i = 0; i < 3; i++) {
            d[i] = dnum_load(ray->direction[i] + at);
            dnum own = dabsolute(d[i]);
            size = i ? dpick(own > size, own, size) : own;
            dnum_store_float(origin[i] + at, dnum_load(ray->origin[i] + at));
        }
        dnum inverse = 1 / size;
        for (int i = 0; i < 3; i++)
            dnum_store_float(b->direction[i] + at, d[i] * inverse);
        dnum_store_float(b->end + at, dnum_load(ray->end + at) * size);
    }
    for (int i = 0; i < 3; i++)
        reach = max_of(reach, 1.0f + absolute(num_load(origin[i])));
    reach = reach * 0x1p-21f;
    num sum = num_of(0.0f);
    for (int i = 0; i < 3; i++) {
        num d = num_load(b->direction[i]);
        b->down[i] = mask_bits(d < 0.0f);
        sum += (d + num_load(origin[i])) * 0.0f;
        num_store(b->low[i], num_load(origin[i]) + reach);
        num_store(b->high[i], num_load(origin[i]) - reach);
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
    bool single = !(lanes & (lanes - 1));
    int one = __builtin_ctz(lanes);
    mask within = mask_of_bits(lanes);
    bundle->lanes = lanes;
    // Rays outside the bundle are replaced by the ray `one`.
    bundle->end = eight_of(single ? b->end[one] : -min_lane(-pick(within, num_load(b->end), num_of(b->end[one]))));
    for (int i = 0; i < 3; i++) {
        bool down = b->down[i] >> one & 1;
        bundle->first[i] = NODE_CHILDREN * (down ? 3 + i : i);
        bundle->last[i] = NODE_CHILDREN * (down ? i : 3 + i);
        bundle->start[i] = down ? b->high[i] : b->low[i];
        bundle->stop[i] = down ? b->low[i] : b->high[i];
        float low = b->low[i][one], high = b->high[i][one], least = b->inverse[i][one], most = least;
        if (!single) {
            num inverse = pick(within, num_load(b->inverse[i]), num_of(least));
            low = -min_lane(-pick(within, num_load(b->low[i]), num_of(low)));
            high = min_lane(pick(within, num_load(b->high[i]), num_of(high)));
            least = min_lane(inverse);
            most = -min_lane(-inverse);
        }
        bundle->near[i] = eight_of(down ? high : low);
        bundle->far[i] = eight_of(down ? low : high);
        bundle->least[i] = eight_of(least);
        bundle->most[i] = eight_of(most);
    }
}

// Returns the children of a node that a bundle may meet, as bits. `single` means that the bundle is one ray.
LANE_FN unsigned meets_children(const struct ray_bundle *b, const struct ray_node *node, bool single)
{
    const float *planes = node->planes[0][0];
    eight near = eight_of(0), far = b->end;
    for (int i = 0; i < 3; i++) {
        eight a = eight_load(planes + b->first[i]) - b->near[i];
        eight c = eight_load(planes + b->last[i]) - b->far[i];
        near = eight_max(single ? a * b->least[i] : eight_min(a * b->least[i], a * b->most[i]), near);
        far = eight_min(single ? c * b->least[i] : eight_max(c * b->least[i], c * b->most[i]), far);
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

// --- traversal

// Decides which rays a triangle blocks. Returns the `lanes` whose rays are blocked.
typedef unsigned ray_filter(void *user, const struct ray_triangle *triangle, const struct ray_lanes *ray,
                            const struct ray_view *view, unsigned lanes);

// Returns the lanes of a bundle whose rays are blocked.
LANE_FN unsigned walk_bundle(const struct hierarchy *h, const struct ray_lanes *ray, const struct ray_view *view,
                             const struct box_rays *boxes, const struct ray_bundle *bundle, ray_filter *filter,
                             void *user, bool single)
{
    struct {
        uint32_t node;
        unsigned children;
    } stack[HIERARCHY_DEPTH];
    int waiting = 0;
    unsigned lanes = bundle->lanes;
    const struct ray_node *node = h->nodes;
    unsigned children = meets_children(bundle, node, single);
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
        if (children) { // the next node
            int next = __builtin_ctz(children);
            __builtin_prefetch(node->count[next] ? (const void *)&h->triangles[node->child[next]]
                                                 : (const void *)&h->nodes[node->child[next]]);
        }
        if (!count) {
            if (children) {
                stack[waiting].node = (uint32_t)(node - h->nodes);
                stack[waiting++].children = children;
            }
            node = &h->nodes[child];
            children = meets_children(bundle, node, single);
            continue;
        }
        unsigned there = single ? lanes : lanes & meets_child(boxes, bundle, node, i);
        for (uint32_t n = child; n < child + count && there; n++) {
            unsigned found = crosses(&h->triangles[n], ray, view, there, NULL, NULL);
            found = found ? found & ~through_points(h, &h->triangles[n], ray, found) : 0;
            if (filter && found)
                found = filter(user, &h->triangles[n], ray, view, found);
            there &= ~found;
            lanes &= ~found;
        }
        if (!lanes)
            return bundle->lanes;
    }
}

// Returns the lanes of `active` whose rays are blocked. If `filter` is NULL, every triangle blocks a ray.
LANE_FN unsigned any_hit(const struct hierarchy *h, const struct ray_lanes *ray, unsigned active, ray_filter *filter,
                         void *user)
{
    struct box_rays boxes;
    struct ray_bundle bundle;
    struct ray_view view;
    unsigned hit = 0;
    if (!h->triangle_count || !active)
        return 0;
    box_rays_of(&boxes, ray);
    view_along(&view, ray);
    for (unsigned rest = active & boxes.proper; rest; rest &= ~bundle.lanes) {
        bundle_of(&bundle, &boxes, bundle_lanes(&boxes, rest));
        view_common(&view, bundle.lanes);
        if (bundle.lanes & (bundle.lanes - 1))
            hit |= walk_bundle(h, ray, &view, &boxes, &bundle, filter, user, false);
        else
            hit |= walk_bundle(h, ray, &view, &boxes, &bundle, filter, user, true);
    }
    return hit;
}

#if LANES == 1
// Returns the number of the nearest triangle on a ray, and sets *t to the distance of this triangle. If several
// triangles are at this distance, the function returns the lowest number. Returns NO_TRIANGLE if there is none.
// `counts` decides whether a triangle is considered.
LANE_FN uint32_t nearest_hit(const struct hierarchy *h, const struct ray_lanes *ray,
                             bool (*counts)(void *user, const struct ray_triangle *triangle,
                                            const struct ray_lanes *ray, const struct ray_view *view),
                             void *user, double *t)
{
    uint32_t found = (uint32_t)NO_TRIANGLE, stack[NODE_CHILDREN * HIERARCHY_DEPTH][2] = {{0, 0}};
    struct box_rays boxes;
    struct ray_bundle bundle;
    struct ray_view view;
    box_rays_of(&boxes, ray);
    bundle_of(&bundle, &boxes, 1);
    view_along(&view, ray);
    view_common(&view, 1);
    *t = 0;
    for (int waiting = h->triangle_count && boxes.proper ? 1 : 0; waiting;) {
        uint32_t child = stack[--waiting][0], count = stack[waiting][1];
        const struct ray_node *node = &h->nodes[child];
        for (unsigned rest = count ? 0 : meets_children(&bundle, node, true); rest; rest &= rest - 1) {
            stack[waiting][0] = node->child[__builtin_ctz(rest)];
            stack[waiting++][1] = node->count[__builtin_ctz(rest)];
        }
        for (uint32_t i = child; i < child + count; i++) {
            const struct ray_triangle *triangle = &h->triangles[i];
            double at;
            if (!crosses(triangle, ray, &view, 1, NULL, &at) || through_points(h, triangle, ray, 1) ||
                !counts(user, triangle, ray, &view))
                continue;
            if (found == (uint32_t)NO_TRIANGLE || at < *t || (at == *t && triangle->number < found)) {
                found = triangle->number;
                *t = at;
            }
        }
    }
    return found;
}
#endif

#endif
