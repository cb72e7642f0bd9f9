// ray_triangles.c: chooses the space of a hierarchy.
//
// Corners are computed three times: here for the total extent, for the cells, and for the leaves. Storing the corners or
// their boxes would take longer, mostly because of memory access.
#include "ray_triangles.h"

#include "fail.h"

#include <stdlib.h>

struct bounds {
    double low[3], high[3];
};

struct preparation {
    struct builder *builder;
    struct bounds *bounds; // the bounds of each task in world space
};

static void place_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct preparation *preparation = user;
    struct builder *b = preparation->builder;
    uint32_t first = (uint32_t)index * RAY_CHUNK, end = b->frame->triangle_count;
    end = end - first < RAY_CHUNK ? end : first + RAY_CHUNK;
    struct point low = {dnum_of(1e308), dnum_of(1e308)}, high = {dnum_of(-1e308), dnum_of(-1e308)};
    struct placement place = {0};
    if (!should_continue(&b->loop))
        return;
    for (uint32_t i = first; i < end; i++) {
        struct point p[3];
        if (!world_corners(b->frame, i, &place, p))
            continue;
        for (int k = 0; k < 3; k++) {
            low = (struct point){dmin_of(p[k].xy, low.xy), dmin_of(p[k].z, low.z)};
            high = (struct point){dmax_of(p[k].xy, high.xy), dmax_of(p[k].z, high.z)};
        }
    }
    struct bounds *bounds = &preparation->bounds[index];
    store_point(low, bounds->low);
    store_point(high, bounds->high);
}

// Chooses a space in which all coordinates are within −1…1.
static void choose_space(struct hierarchy *h, const struct bounds *bounds)
{
    double half = 0;
    for (int i = 0; i < 3; i++) {
        bool any = bounds->low[i] <= bounds->high[i];
        double own = any ? 0.5 * bounds->high[i] - 0.5 * bounds->low[i] : 0;
        h->centre[i] = any ? 0.5 * bounds->low[i] + 0.5 * bounds->high[i] : 0;
        half = own > half ? own : half;
    }
    double size = 1; // the smallest power of two that is at least `half`
    for (; size < half && size < 0x1p1000; size *= 2)
        ;
    for (; size * 0.5 >= half && size > 0x1p-1000; size *= 0.5)
        ;
    h->scale = half > 0 ? 1 / size : 1;
}

bool ray_space_choose(struct builder *builder, lam_error *error)
{
    size_t chunks = ((size_t)builder->frame->triangle_count + RAY_CHUNK - 1) / RAY_CHUNK;
    struct call_control *call = builder->loop.call;
    size_t bytes = (chunks + 1) * sizeof(struct bounds);
    if (call && !call_charge(call, bytes))
        return call_memory_error(call, bytes, error);
    struct preparation preparation = {builder, calloc(1, bytes)};
    if (!preparation.bounds) {
        if (call)
            call_refund(call, bytes);
        return fail_memory(error, bytes);
    }
    pool_run(builder->pool, chunks, place_task, &preparation);
    struct bounds all = {{1e308, 1e308, 1e308}, {-1e308, -1e308, -1e308}};
    for (size_t i = 0; i < chunks; i++)
        for (int axis = 0; axis < 3; axis++) {
            const struct bounds *own = &preparation.bounds[i];
            all.low[axis] = own->low[axis] < all.low[axis] ? own->low[axis] : all.low[axis];
            all.high[axis] = own->high[axis] > all.high[axis] ? own->high[axis] : all.high[axis];
        }
    choose_space(builder->hierarchy, &all);
    for (int axis = 0; axis < 3; axis++) {
        const struct hierarchy *h = builder->hierarchy;
        builder->low[axis] = (float)((all.low[axis] - h->centre[axis]) * h->scale);
        builder->high[axis] = (float)((all.high[axis] - h->centre[axis]) * h->scale);
    }
    free(preparation.bounds);
    if (call)
        call_refund(call, bytes);
    return should_continue(&builder->loop) || loop_error(&builder->loop, 0, error);
}
