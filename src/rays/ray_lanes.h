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
    dnum origin[3], direction[3]; // the direction's length is the unit of t
    dnum end;                     // may be infinite
    inum own; // the twin of the triangle that the ray starts on, which is not in its way; NO_TRIANGLE
};

// A ray seen along its direction d, of which component k is the largest: x = p_i − (d_i/d_k) p_k,
// y = p_j − (d_j/d_k) p_k and z = p_k/d_k with i, j after k. One of the three rows' factors is 1 and one 0, which are
// exact, so that lanes of different k go through the same operations.
struct ray_view {
    dnum x[3], y[3], z[3];
};

LANE_FN struct ray_view view_along(const dnum direction[3])
{
    struct ray_view v;
    dnum size[3] = {dabsolute(direction[0]), dabsolute(direction[1]), dabsolute(direction[2])};
    dnum zero = dnum_of(0), one = dnum_of(1);
    dmask on_x = (size[0] >= size[1]) & (size[0] >= size[2]), on_y = (size[1] >= size[2]) & (on_x == 0);
    dmask on[3] = {on_x, on_y, (on_x == 0) & (on_y == 0)};
    for (int k = 0; k < 3; k++) {
        v.x[k] = v.y[k] = zero;
        v.z[k] = dpick(on[k], one / direction[k], zero);
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        v.x[i] = dpick(on[k], one, v.x[i]);
        v.y[j] = dpick(on[k], one, v.y[j]);
        v.x[k] = dpick(on[k], -(direction[i] / direction[k]), v.x[k]);
        v.y[k] = dpick(on[k], -(direction[j] / direction[k]), v.y[k]);
    }
    return v;
}

LANE_FN dnum along(const dnum row[3], const dnum p[3]) { return (row[0] * p[0] + row[1] * p[1]) + row[2] * p[2]; }

// Where a ray crosses the plane of a triangle.
struct crossing {
    dmask hit;      // inside of the triangle, in front of the end
    dnum weight[3]; // of the corners, all times det
    dnum t, det;    // the ray's t, times det, which is positive where there is a hit
};

LANE_FN struct crossing crossing_of(const struct ray_triangle *triangle, const struct ray_lanes *ray,
                                    const struct ray_view *view)
{
    dnum x[3], y[3], z[3];
    for (int k = 0; k < 3; k++) {
        dnum p[3];
        for (int i = 0; i < 3; i++)
            p[i] = triangle->p[k][i] - ray->origin[i];
        x[k] = along(view->x, p);
        y[k] = along(view->y, p);
        z[k] = along(view->z, p);
    }
    struct crossing c;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        c.weight[k] = x[j] * y[i] - y[j] * x[i];
    }
    dnum zero = dnum_of(0);
    c.det = (c.weight[0] + c.weight[1]) + c.weight[2];
    c.t = (c.weight[0] * z[0] + c.weight[1] * z[1]) + c.weight[2] * z[2];
    dmask positive = (c.weight[0] >= zero) & (c.weight[1] >= zero) & (c.weight[2] >= zero) & (c.det > zero);
    dmask negative = (c.weight[0] <= zero) & (c.weight[1] <= zero) & (c.weight[2] <= zero) & (c.det < zero);
    c.t = dpick(negative, -c.t, c.t);
    c.det = dpick(negative, -c.det, c.det);
    c.hit = (positive | negative) & (c.t > zero) & (c.t < ray->end * c.det);
    return c;
}

// Whether a triangle is in the way of its rays.
LANE_FN mask crosses(const struct ray_triangle *triangle, const struct ray_lanes *ray, const struct ray_view *view)
{
    return both(mask_of_dmask(crossing_of(triangle, ray, view).hit), ray->own != (int32_t)triangle->twin);
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
};

LANE_FN struct box_rays box_rays_of(const struct ray_lanes *ray)
{
    struct box_rays b;
    dnum size = dabsolute(ray->direction[0]);
    for (int i = 1; i < 3; i++) {
        dnum other = dabsolute(ray->direction[i]);
        size = dpick(other > size, other, size);
    }
    num reach = num_of(1.0f);
    for (int i = 0; i < 3; i++)
        reach = max_of(reach, 1.0f + absolute(num_of_dnum(ray->origin[i])));
    reach = reach * 0x1p-21f;
    for (int i = 0; i < 3; i++) {
        num origin = num_of_dnum(ray->origin[i]), direction = num_of_dnum(ray->direction[i] / size);
        b.low[i] = origin + reach;
        b.high[i] = origin - reach;
        // A direction along the planes: the ray never reaches them, or so far away that it does not matter.
        mask none = absolute(direction) < 1e-30f;
        b.inverse[i] = 1.0f / pick(none, pick(direction < 0.0f, num_of(-1e-30f), num_of(1e-30f)), direction);
    }
    b.end = num_of_dnum(ray->end * size) * (1.0f + 0x1p-20f);
    return b;
}

LANE_FN mask meets_box(const struct box_rays *b, const float low[3], const float high[3], num *near_t)
{
    num near = num_of(0.0f), far = b->end;
    for (int i = 0; i < 3; i++) {
        num a = (low[i] - b->low[i]) * b->inverse[i], c = (high[i] - b->high[i]) * b->inverse[i];
        near = max_of(min_of(a, c), near);
        far = min_of(max_of(a, c), far);
    }
    *near_t = near;
    return near <= far;
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
    struct box_rays boxes = box_rays_of(ray);
    struct ray_view view = view_along(ray->direction);
    for (;;) {
        if (!count) {
            const struct ray_node *node = &h->nodes[child];
            num t[2];
            unsigned left = mask_bits(meets_box(&boxes, node->low[0], node->high[0], &t[0])) & lanes;
            unsigned right = mask_bits(meets_box(&boxes, node->low[1], node->high[1], &t[1])) & lanes;
            if (left && right) {
                // The nearer child first, by the first ray.
                int first = lane(t[1], __builtin_ctz(left)) < lane(t[0], __builtin_ctz(left));
                stack[waiting].child = node->child[!first];
                stack[waiting].count = node->count[!first];
                stack[waiting++].lanes = first ? left : right;
                child = node->child[first];
                count = node->count[first];
                lanes = first ? right : left;
                continue;
            }
            if (left || right) {
                child = node->child[!left];
                count = node->count[!left];
                lanes = left | right;
                continue;
            }
        } else {
            for (uint32_t i = 0; i < count && lanes; i++) {
                unsigned found = mask_bits(crosses(&h->triangles[child + i], ray, &view)) & lanes;
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
    struct box_rays boxes = box_rays_of(ray);
    struct ray_view view = view_along(ray->direction);
    *t = 0;
    for (int waiting = h->triangle_count ? 1 : 0; waiting;) {
        uint32_t child = stack[--waiting][0], count = stack[waiting][1];
        num entry;
        for (int i = 0; i < 2 && !count; i++)
            if (meets_box(&boxes, h->nodes[child].low[i], h->nodes[child].high[i], &entry)) {
                stack[waiting][0] = h->nodes[child].child[i];
                stack[waiting++][1] = h->nodes[child].count[i];
            }
        for (uint32_t i = child; i < child + count; i++) {
            const struct ray_triangle *triangle = &h->triangles[i];
            struct crossing c = crossing_of(triangle, ray, &view);
            if (!c.hit || ray->own == (int32_t)triangle->twin || !counts(user, triangle, ray, &view))
                continue;
            double at = c.t / c.det;
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
