// bins.c: memory for bins and clipped triangles, and the binning of large triangles.
#include "bins.h"

#include "pages.h"

#include <stdlib.h>

enum {
    SLAB = 2 << 20,    // a huge page
    CHARGE = 64 << 10, // used bytes are counted in such steps
    FILLED = 1 << 20,  // number of triangles per thread that nearly fill the thread's first slab
};

// Allocates `bytes` from a list of slabs. New slabs come from the system and are kept for later frames.
static void *slab_take(const struct raster_frame *raster, struct slab_list *list, size_t bytes)
{
    if (list->count == 0 || list->used + bytes > SLAB) {
        int next = list->count == 0 ? 0 : list->current + 1;
        if (next == list->count) {
            if (list->count == list->capacity) {
                int capacity = list->capacity ? list->capacity * 2 : 16;
                void **slabs = realloc(list->slabs, (size_t)capacity * sizeof *slabs);
                if (!slabs)
                    goto out_of_memory;
                list->slabs = slabs;
                list->capacity = capacity;
            }
            size_t held;
            // Whether all pages of the slab will be used.
            bool filled = next > 0 || raster->frame->triangle_count / (size_t)raster->thread_count > FILLED;
            void *slab = filled ? pages_get(SLAB, &held) : pages_get_sparse(SLAB, &held);
            if (!slab)
                goto out_of_memory;
            list->slabs[list->count++] = slab;
        }
        list->current = next;
        list->used = 0;
    }
    void *memory = (char *)list->slabs[list->current] + list->used;
    list->used += bytes;
    if ((size_t)list->current * SLAB + list->used > list->charged) {
        if (!call_charge(raster->work->call, CHARGE))
            goto out_of_memory;
        list->charged += CHARGE;
    }
    return memory;

out_of_memory:
    work_fail(raster->work, FAILED_MEMORY);
    return NULL;
}

size_t slabs_free(struct slab_list *list)
{
    size_t bytes = list->charged;
    for (int i = 0; i < list->count; i++)
        pages_free(list->slabs[i], SLAB);
    free(list->slabs);
    *list = (struct slab_list){0};
    return bytes;
}

struct bin_block *new_bin_block(const struct raster_frame *raster, struct thread_bins *bins)
{
    return slab_take(raster, &bins->blocks, sizeof(struct bin_block));
}

// CLIPPED_PER_SLAB is a power of two, so that the slab of a clipped triangle is found by shifting its index.
enum { CLIPPED_PER_SLAB = SLAB / 64 };
_Static_assert(sizeof(struct clipped_triangle) <= 64, "a clipped triangle fits 64 bytes");

struct clipped_triangle *new_clipped_triangle(const struct raster_frame *raster, struct thread_bins *bins,
                                              uint32_t *number)
{
    struct clipped_triangle *triangle = slab_take(raster, &bins->clipped, 64);
    if (triangle)
        *number = bins->clipped_count++;
    return triangle;
}

const struct clipped_triangle *clipped_triangle(const struct thread_bins *bins, uint32_t number)
{
    const char *slab = bins->clipped.slabs[number / CLIPPED_PER_SLAB];
    return (const struct clipped_triangle *)(slab + (size_t)(number % CLIPPED_PER_SLAB) * 64);
}

void bin_large(const struct raster_frame *raster, struct thread_bins *bins, const struct snapped *c, uint32_t id)
{
    int64_t area = snapped_area(c);
    if (area == 0)
        return;
    int min_x = c->x[0], max_x = c->x[0], min_y = c->y[0], max_y = c->y[0];
    for (int k = 1; k < 3; k++) {
        min_x = c->x[k] < min_x ? c->x[k] : min_x;
        max_x = c->x[k] > max_x ? c->x[k] : max_x;
        min_y = c->y[k] < min_y ? c->y[k] : min_y;
        max_y = c->y[k] > max_y ? c->y[k] : max_y;
    }
    const int shift = SUBPIXEL_SHIFT + TILE_SHIFT;
    int x0 = min_x >> shift, x1 = max_x >> shift, y0 = min_y >> shift, y1 = max_y >> shift;
    x0 = x0 < 0 ? 0 : x0;
    y0 = y0 < 0 ? 0 : y0;
    x1 = x1 >= raster->tiles_across ? raster->tiles_across - 1 : x1;
    y1 = y1 >= raster->tiles_down ? raster->tiles_down - 1 : y1;
    if (x0 > x1) // the triangle is beside the window
        return;
    // The edge functions are positive inside the triangle. The triangle does not touch a tile if even the tile's
    // innermost corner is outside an edge.
    int64_t sign = area > 0 ? 1 : -1, size = (int64_t)1 << shift;
    int64_t a[3], b[3], max[3];
    for (int k = 0; k < 3; k++) {
        int n = (k + 1) % 3;
        a[k] = -sign * (c->y[n] - c->y[k]);
        b[k] = sign * (c->x[n] - c->x[k]);
        max[k] = (a[k] > 0 ? a[k] * size : 0) + (b[k] > 0 ? b[k] * size : 0);
    }
    for (int ty = y0; ty <= y1; ty++) {
        bins->work += (uint64_t)(x1 - x0 + 1) * WORK_SET_UP;
        if (!work_step(raster->work, &bins->work))
            return;
        for (int tx = x0; tx <= x1; tx++) {
            int64_t px = (int64_t)tx << shift, py = (int64_t)ty << shift;
            bool missed = false;
            for (int k = 0; k < 3; k++)
                missed |= a[k] * (px - c->x[k]) + b[k] * (py - c->y[k]) + max[k] < 0;
            if (!missed)
                bin_add(raster, bins, (ty * raster->tiles_across + tx) * TILE_BINS, (struct bin_entry){id, 1, 0, 0});
        }
    }
}
