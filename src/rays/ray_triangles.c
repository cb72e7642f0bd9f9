// ray_triangles.c: the triangles of a frame in the hierarchy's space, and their boxes.
#include "builder.h"

#include "fail.h"
#include "linear.h"

#include <stdlib.h>
#include <string.h>

#define LEFT_OUT 0xffffffffu // as a twin, until the corners are scaled

struct bounds {
    double low[3], high[3];
};

struct preparation {
    struct builder *builder;
    struct bounds *bounds; // of each piece, in world space
};

static bool finite_corners(const double p[3][3])
{
    double sum = 0; // 0 times anything finite
    for (int i = 0; i < 9; i++)
        sum += 0 * (&p[0][0])[i];
    return sum == 0;
}

// The draw with a triangle.
static int draw_of(const struct frame *frame, uint32_t number)
{
    int low = 0, high = frame->draw_count - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (frame->draws[middle].first_id <= number)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static void place_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct preparation *preparation = user;
    struct builder *b = preparation->builder;
    const struct frame *frame = b->frame;
    uint32_t first = (uint32_t)index * RAY_PIECE, end = frame->triangle_count;
    end = end - first < RAY_PIECE ? end : first + RAY_PIECE;
    struct bounds bounds = {{1e308, 1e308, 1e308}, {-1e308, -1e308, -1e308}};
    if (!should_continue(&b->loop))
        return;
    int draw = draw_of(frame, first);
    for (uint32_t i = first; i < end; i++) {
        while (draw + 1 < frame->draw_count && frame->draws[draw + 1].first_id <= i)
            draw++;
        struct ray_triangle *t = &b->prepared[i];
        ray_corners(&frame->draws[draw], i - frame->draws[draw].first_id, t->p);
        t->number = t->twin = i;
        // No ray meets it. Rectangles of lines and points face the eye: they are no things that could cast a shadow.
        if (!frame_draw_casts(&frame->draws[draw]) || !finite_corners(t->p)) {
            t->twin = LEFT_OUT;
            continue;
        }
        for (int k = 0; k < 9; k++) {
            double x = t->p[k / 3][k % 3];
            bounds.low[k % 3] = x < bounds.low[k % 3] ? x : bounds.low[k % 3];
            bounds.high[k % 3] = x > bounds.high[k % 3] ? x : bounds.high[k % 3];
        }
    }
    preparation->bounds[index] = bounds;
}

// The corners in the hierarchy's space, and the box, rounded to the nearest floats (ray_lanes.h takes care of that).
static void scale_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct preparation *preparation = user;
    struct builder *b = preparation->builder;
    const struct hierarchy *h = b->hierarchy;
    uint32_t first = (uint32_t)index * RAY_PIECE, end = b->frame->triangle_count;
    end = end - first < RAY_PIECE ? end : first + RAY_PIECE;
    if (!should_continue(&b->loop))
        return;
    for (uint32_t i = first; i < end; i++) {
        struct ray_triangle *t = &b->prepared[i];
        struct primitive *out = &b->primitives[0][i];
        for (int k = 0; k < 3; k++)
            ray_point(h, t->p[k], t->p[k]);
        if (t->twin == LEFT_OUT) {
            memset(t->p, 0, sizeof t->p);
            t->twin = i;
        }
        for (int axis = 0; axis < 3; axis++) {
            double x = t->p[0][axis], y = t->p[1][axis], z = t->p[2][axis];
            double low = x < y ? x : y, high = x < y ? y : x;
            out->low[axis] = (float)(low < z ? low : z);
            out->high[axis] = (float)(high > z ? high : z);
        }
        memcpy(&out->low[3], &i, sizeof i);
        out->high[3] = 0;
    }
}

// A space in which all coordinates lie within −1…1.
static void choose_space(struct hierarchy *h, const struct bounds *bounds)
{
    double half = 0;
    for (int i = 0; i < 3; i++) {
        bool any = bounds->low[i] <= bounds->high[i];
        double own = any ? 0.5 * bounds->high[i] - 0.5 * bounds->low[i] : 0;
        h->centre[i] = any ? 0.5 * bounds->low[i] + 0.5 * bounds->high[i] : 0;
        half = own > half ? own : half;
    }
    double size = 1; // the smallest power of two that is not below `half`
    for (; size < half && size < 0x1p1000; size *= 2)
        ;
    for (; size * 0.5 >= half && size > 0x1p-1000; size *= 0.5)
        ;
    h->scale = half > 0 ? 1 / size : 1;
}

bool ray_triangles_prepare(struct builder *builder, lam_error *error)
{
    size_t pieces = ((size_t)builder->frame->triangle_count + RAY_PIECE - 1) / RAY_PIECE;
    struct preparation preparation = {builder, calloc(pieces + 1, sizeof *preparation.bounds)};
    if (!preparation.bounds)
        return fail_memory(error, (pieces + 1) * sizeof *preparation.bounds);
    pool_run(builder->pool, pieces, place_task, &preparation);
    struct bounds all = {{1e308, 1e308, 1e308}, {-1e308, -1e308, -1e308}};
    for (size_t i = 0; i < pieces; i++)
        for (int axis = 0; axis < 3; axis++) {
            const struct bounds *own = &preparation.bounds[i];
            all.low[axis] = own->low[axis] < all.low[axis] ? own->low[axis] : all.low[axis];
            all.high[axis] = own->high[axis] > all.high[axis] ? own->high[axis] : all.high[axis];
        }
    choose_space(builder->hierarchy, &all);
    pool_run(builder->pool, pieces, scale_task, &preparation);
    free(preparation.bounds);
    return should_continue(&builder->loop) || loop_error(&builder->loop, 0, error);
}
