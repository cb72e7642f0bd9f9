// ray_lanes.h: LANES rays at a time against a hierarchy. Include with LANES defined as 1, 4, 8 or 16.
//
// A ray is origin + t direction with 0 < t < end, in the hierarchy's space. Whether a triangle is in its way is decided
// in double by crosses() alone, in a fixed order of operations; boxes only save work. Hence neither the hierarchy, nor
// the number of lanes, nor which rays travel together matters.
//
// The test is that of Woop, Benthin and Wald, "Watertight ray/triangle intersection" (JCGT 2013): seen along the ray,
// with the origin at (0, 0), a triangle's edges are decided by the signs of cross products of its corners. Rounding is
// monotonic, so that such a sign is never wrong, only 0, and 0 belongs to both triangles at an edge: no ray slips
// between them. A corner that is the origin itself gives t = 0: triangles around a point are not in the way of its rays.
#ifndef RAY_LANES_H
#define RAY_LANES_H

#include "double_lanes.h"
#include "hierarchy.h"

struct ray_lanes {
    _Alignas(64) double origin[3][LANES], direction[3][LANES]; // the direction's length is the unit of t
    double end[LANES];                                         // may be infinite
    // The twin of the triangle that the ray starts on, which is not in its way; NO_TRIANGLE: of none.
    int32_t own[LANES];
};

// Rays seen along their directions d, of which component k is the largest: x = p_i − (d_i/d_k) p_k, y = p_j − (d_j/d_k) p_k
// and z = p_k/d_k with i, j after k. One of the three factors of a row is 1 and one 0, which are exact: rays of different k
// can go through the same operations, and those that have k in common through fewer, with the same results.
struct ray_view {
    _Alignas(64) double x[3][LANES], y[3][LANES], z[3][LANES];
    int k; // of all active rays, which then have row k alone; −1: they differ
};

LANE_FN void view_along(struct ray_view *v, const struct ray_lanes *ray, unsigned active)
{
    unsigned of_k[3] = {0, 0, 0};
    dnum zero = dnum_of(0), one = dnum_of(1);
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
            int before = (k + 2) % 3, after = (k + 1) % 3; // i is after, j before k
            of_k[k] |= dmask_bits(on[k]) << at;
            dnum_store(v->x[k] + at, dpick(on[k], to_x, dpick(on[before], one, zero)));
            dnum_store(v->y[k] + at, dpick(on[k], to_y, dpick(on[after], one, zero)));
            dnum_store(v->z[k] + at, dpick(on[k], inverse, zero));
        }
    }
    v->k = -1;
    for (int k = 0; k < 3; k++)
        v->k = (of_k[k] & active) == active ? k : v->k;
}

LANE_FN dnum along(const double row[3][LANES], int at, const dnum p[3])
{
    return (dnum_load(row[0] + at) * p[0] + dnum_load(row[1] + at) * p[1]) + dnum_load(row[2] + at) * p[2];
}

// The lanes of `active` whose rays a triangle is in the way of. `weights` (may be NULL) gets the weights of its corners, each
// times their sum, and `t` the rays' t.
LANE_FN unsigned crosses(const struct ray_triangle *triangle, const struct ray_lanes *ray, const struct ray_view *view,
                         unsigned active, double weights[3][LANES], double t[LANES])
{
    unsigned hit = 0;
    for (int part = 0; part < DPARTS; part++) {
        int at = part * DLANES;
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
            int k = view->k, i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
            dnum of_i = dnum_load(ray->origin[i] + at), of_j = dnum_load(ray->origin[j] + at),
                 of_k = dnum_load(ray->origin[k] + at);
            dnum to_x = dnum_load(view->x[k] + at), to_y = dnum_load(view->y[k] + at),
                 to_z = dnum_load(view->z[k] + at);
            for (int c = 0; c < 3; c++) {
                dnum depth = triangle->p[c][k] - of_k;
                x[c] = (triangle->p[c][i] - of_i) + to_x * depth;
                y[c] = (triangle->p[c][j] - of_j) + to_y * depth;
                z[c] = to_z * depth;
            }
        }
        w[0] = x[1] * y[2] - y[1] * x[2];
        w[1] = x[2] * y[0] - y[2] * x[0];
        w[2] = x[0] * y[1] - y[0] * x[1];
        dmask positive = (w[0] >= zero) & (w[1] >= zero) & (w[2] >= zero);
        dmask negative = (w[0] <= zero) & (w[1] <= zero) & (w[2] <= zero);
        if (!(dmask_bits(positive | negative) << at & active))
            continue;
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

// --- boxes

// What the test of boxes takes of a ray, in floats.
//
// Coordinates of triangles lie within −1…1. Rounding origin, direction, its inverse and the box moves the crossing with a
// plane of a box by less than 2⁻²¹ (1 + |origin|) altogether; each plane is taken that much farther out.
struct box_rays {
    num low[3], high[3]; // the origin, to be taken from a box's low and high planes
    num inverse[3];
    num end;
    int first[3]; // of all active rays: 0: they meet the low plane of the axis first; 1: the high one
    bool apart;   // the rays differ in that
};

LANE_FN void box_rays_of(struct box_rays *b, const struct ray_lanes *ray, unsigned active)
{
    _Alignas(64) float origin[3][LANES], direction[3][LANES], end[LANES];
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
            dnum_store_float(direction[i] + at, d[i] * inverse);
        dnum_store_float(end + at, dnum_load(ray->end + at) * size);
    }
    b->apart = false;
    for (int i = 0; i < 3; i++) {
        reach = max_of(reach, 1.0f + absolute(num_load(origin[i])));
        unsigned down = mask_bits(num_load(direction[i]) < 0.0f) & active;
        b->first[i] = down != 0;
        b->apart |= down && down != active;
    }
    reach = reach * 0x1p-21f;
    for (int i = 0; i < 3; i++) {
        num d = num_load(direction[i]);
        b->low[i] = num_load(origin[i]) + reach;
        b->high[i] = num_load(origin[i]) - reach;
        // A direction along the planes: the ray never reaches them, or so far away that it does not matter.
        num least = pick(d < 0.0f, num_of(-1e-30f), num_of(1e-30f));
        b->inverse[i] = 1.0f / pick(absolute(d) < 1e-30f, least, d);
    }
    b->end = num_load(end) * (1.0f + 0x1p-20f);
}

// The rays that meet a child of a node, and where.
LANE_FN mask meets_box(const struct box_rays *b, const struct ray_node *node, int child, num *entry)
{
    num near = num_of(0.0f), far = b->end;
    for (int i = 0; i < 3; i++) {
        num a = (node->low[child][i] - b->low[i]) * b->inverse[i],
            c = (node->high[child][i] - b->high[i]) * b->inverse[i];
        near = max_of(min_of(a, c), near);
        far = min_of(max_of(a, c), far);
    }
    *entry = near;
    return near <= far;
}

// The same where all rays meet the same plane of each axis first. `near` and `far` name the planes of the left child among
// the floats of a node.
LANE_FN mask meets_planes(const float *planes, const int near[3], const int far[3], const num near_origin[3],
                          const num far_origin[3], const struct box_rays *b, num *entry)
{
    num x = (planes[near[0]] - near_origin[0]) * b->inverse[0], to_x = (planes[far[0]] - far_origin[0]) * b->inverse[0];
    num y = (planes[near[1]] - near_origin[1]) * b->inverse[1], to_y = (planes[far[1]] - far_origin[1]) * b->inverse[1];
    num z = (planes[near[2]] - near_origin[2]) * b->inverse[2], to_z = (planes[far[2]] - far_origin[2]) * b->inverse[2];
    *entry = max_of(max_of(x, y), max_of(z, num_of(0.0f)));
    return *entry <= min_of(min_of(to_x, to_y), min_of(to_z, b->end));
}

// --- the walk

// Decides about the rays that a triangle is in the way of: returns those of `lanes` that end there.
typedef unsigned ray_filter(void *user, const struct ray_triangle *triangle, const struct ray_lanes *ray,
                            const struct ray_view *view, unsigned lanes);

// The lanes of `active` whose rays have a triangle in their way. `filter` NULL: every triangle ends a ray.
LANE_FN unsigned any_hit(const struct hierarchy *h, const struct ray_lanes *ray, unsigned active, ray_filter *filter,
                         void *user)
{
    struct {
        uint32_t child, count;
        unsigned lanes;
    } stack[HIERARCHY_DEPTH];
    int waiting = 0;
    uint32_t child = 0, count = 0;
    unsigned hit = 0, lanes = active;
    if (!h->triangle_count || !active)
        return 0;
    struct box_rays boxes;
    struct ray_view view;
    box_rays_of(&boxes, ray, active);
    view_along(&view, ray, active);
    num near_origin[3], far_origin[3];
    int near[3], far[3];
    for (int i = 0; i < 3; i++) {
        near[i] = i + (boxes.first[i] ? 6 : 0);
        far[i] = i + (boxes.first[i] ? 0 : 6);
        near_origin[i] = boxes.first[i] ? boxes.high[i] : boxes.low[i];
        far_origin[i] = boxes.first[i] ? boxes.low[i] : boxes.high[i];
    }
    for (;;) {
        if (!count) {
            const struct ray_node *node = &h->nodes[child];
            num t[2];
            unsigned sides[2];
            const float *planes = node->low[0];
            for (int i = 0; i < 2; i++) // while the boxes are tested
                __builtin_prefetch(node->count[i] ? (const void *)&h->triangles[node->child[i]]
                                                  : (const void *)&h->nodes[node->child[i]]);
            if (boxes.apart) {
                sides[0] = lanes & mask_bits(meets_box(&boxes, node, 0, &t[0]));
                sides[1] = lanes & mask_bits(meets_box(&boxes, node, 1, &t[1]));
            } else {
                sides[0] = lanes & mask_bits(meets_planes(planes, near, far, near_origin, far_origin, &boxes, &t[0]));
                sides[1] =
                    lanes & mask_bits(meets_planes(planes + 3, near, far, near_origin, far_origin, &boxes, &t[1]));
            }
            if (sides[0] && sides[1]) {
                // First the child that more of the rays meet first.
                unsigned common = sides[0] & sides[1], right = mask_bits(t[1] < t[0]) & common;
                int first = 2 * __builtin_popcount(right) > __builtin_popcount(common);
                stack[waiting].child = node->child[!first];
                stack[waiting].count = node->count[!first];
                stack[waiting++].lanes = sides[!first];
                child = node->child[first];
                count = node->count[first];
                lanes = sides[first];
                continue;
            }
            if (sides[0] || sides[1]) {
                child = node->child[!sides[0]];
                count = node->count[!sides[0]];
                lanes = sides[0] | sides[1];
                continue;
            }
        } else {
            for (uint32_t i = 0; i < count && lanes; i++) {
                unsigned found = crosses(&h->triangles[child + i], ray, &view, lanes, NULL, NULL);
                if (filter && found)
                    found = filter(user, &h->triangles[child + i], ray, &view, found);
                hit |= found;
                lanes &= ~found;
            }
            if (hit == active)
                return hit;
        }
        do {
            if (!waiting)
                return hit;
            waiting--;
            lanes = stack[waiting].lanes & ~hit;
        } while (!lanes);
        child = stack[waiting].child;
        count = stack[waiting].count;
    }
}

#if LANES == 1
// The nearest triangle in the way of a ray, by its number in the frame, of several at the same place the lowest; *t: where.
// NO_TRIANGLE: none is. `counts`: whether a triangle does.
LANE_FN uint32_t nearest_hit(const struct hierarchy *h, const struct ray_lanes *ray,
                             bool (*counts)(void *user, const struct ray_triangle *triangle,
                                            const struct ray_lanes *ray, const struct ray_view *view),
                             void *user, double *t)
{
    uint32_t found = (uint32_t)NO_TRIANGLE, stack[2 * HIERARCHY_DEPTH][2] = {{0, 0}};
    struct box_rays boxes;
    struct ray_view view;
    box_rays_of(&boxes, ray, 1);
    view_along(&view, ray, 1);
    *t = 0;
    for (int waiting = h->triangle_count ? 1 : 0; waiting;) {
        uint32_t child = stack[--waiting][0], count = stack[waiting][1];
        num entry;
        for (int i = 0; i < 2 && !count; i++)
            if (meets_box(&boxes, &h->nodes[child], i, &entry)) {
                stack[waiting][0] = h->nodes[child].child[i];
                stack[waiting++][1] = h->nodes[child].count[i];
            }
        for (uint32_t i = child; i < child + count; i++) {
            const struct ray_triangle *triangle = &h->triangles[i];
            double at;
            if (!crosses(triangle, ray, &view, 1, NULL, &at) || !counts(user, triangle, ray, &view))
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
