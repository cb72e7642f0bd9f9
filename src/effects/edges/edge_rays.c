// edge_rays.c: finds the hidden points of edges by tracing LANES rays to the eye at a time. This file is compiled for
// several instruction sets.
//
// An edge lies in the planes of its own triangles and of touching faces, so these faces must not hide the edge.
// Therefore a triangle hides a point only if its plane is farther from the point than the rounding error of positions
// in files. Lines along a surface then have no gaps, and no line is visible through a surface.
#include "edge_lines.h"

#include "layer_kinds.h"
#include "opacity.h"
#include "ray_lanes.h"

// A tolerance in the hierarchy's space, in which the model's larger half side is ½ to 1. Floats have a precision of
// 2⁻²⁴, coordinates may be up to 16 times the size of the model (lam_mesh.origin), and text files have six digits.
#define ROUNDING 0x1p-19

// Returns true if the triangle hides points: it is not culled, is not glass, and is opaque at the intersection with
// this lane's ray.
static bool is_solid(const struct edge_view *view, const struct ray_triangle *triangle, const struct ray_lanes *ray,
                     const struct ray_view *seen, int lane, double facing)
{
    const struct frame *frame = view->frame;
    const struct frame_draw_range *range = &frame->ranges[frame_range_of(frame, triangle->number)];
    const struct frame_draw *draw = &frame->draws[range->draw];
    bool back = (facing < 0) != draw->mirrored;
    if (draw->cull == (back ? LAM_CULL_BACK : LAM_CULL_FRONT))
        return false;
    if (!range->passes_rays)
        return true;
    if (frame_layers(frame, frame->materials[back ? range->back : range->front]) & LAYER_TRANSMISSION)
        return false;
    _Alignas(64) double weights[3][LANES] = {{0}};
    crosses(triangle, ray, seen, 1u << lane, weights, NULL);
    double sum = (weights[0][lane] + weights[1][lane]) + weights[2][lane];
    return ray_opacity(frame, triangle->number, back, (float)(weights[1][lane] / sum),
                       (float)(weights[2][lane] / sum)) >= 0.5f;
}

static unsigned hides(void *user, const struct ray_triangle *triangle, const struct ray_lanes *ray,
                      const struct ray_view *seen, unsigned lanes)
{
    const struct edge_view *view = user;
    const double(*p)[3] = triangle->p;
    double a[3], b[3], n[3], least = 0;
    for (int i = 0; i < 3; i++) {
        a[i] = p[1][i] - p[0][i];
        b[i] = p[2][i] - p[0][i];
    }
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++) {
        n[i] = a[j] * b[k] - a[k] * b[j];
        least += n[i] * n[i];
    }
    least *= ROUNDING * ROUNDING;
    unsigned hidden = 0;
    for (unsigned rest = lanes; rest; rest &= rest - 1) {
        int lane = __builtin_ctz(rest);
        double away = 0, facing = 0;
        for (int i = 0; i < 3; i++) {
            away += (ray->origin[i][lane] - p[0][i]) * n[i];
            facing += ray->direction[i][lane] * n[i];
        }
        if (away * away > least && (view->every_hides || is_solid(view, triangle, ray, seen, lane, facing)))
            hidden |= 1u << lane;
    }
    return hidden;
}

static void set_ray(struct ray_lanes *ray, int lane, const struct edge_view *view, const struct edge_line *line,
                    double share)
{
    double w = 1 / ((1 - share) * line->inverse_w[0] + share * line->inverse_w[1]);
    double depth = view->near_[3], toward = 0;
    for (int i = 0; i < 3; i++) {
        double p = ((1 - share) * line->over_w[0][i] + share * line->over_w[1][i]) * w;
        double d = view->frame->orthographic ? view->eye[i] : view->eye[i] - p;
        ray->origin[i][lane] = ray->point[i][lane] = p;
        ray->direction[i][lane] = d;
        depth += view->near_[i] * p;
        toward -= view->near_[i] * d;
    }
    ray->end[lane] = toward > 0 ? depth / toward : (double)__builtin_inf(); // at the near plane
    ray->own[lane] = NO_TRIANGLE;
}

edge_rays FOR_ISA(edge_rays);
void FOR_ISA(edge_rays)(const struct edge_view *view, const struct edge_line *lines, const struct edge_point *points,
                        size_t count, uint8_t *hidden)
{
    struct ray_lanes ray;
    for (size_t i = 0; i < count; i += LANES) {
        int active = count - i < LANES ? (int)(count - i) : LANES;
        if (i % 1024 == 0 && !should_continue(view->loop))
            return;
        for (int k = 0; k < LANES; k++) {
            const struct edge_point *point = &points[k < active ? i + (size_t)k : i];
            set_ray(&ray, k, view, &lines[point->line], point->share);
        }
        unsigned hit =
            any_hit(view->hierarchy, &ray, (unsigned)((1u << active) - 1), hides, (void *)(uintptr_t)view, false);
        for (int k = 0; k < active; k++)
            hidden[i + (size_t)k] = hit >> k & 1;
    }
}
