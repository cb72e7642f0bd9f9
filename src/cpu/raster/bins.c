// bins.c: memory for bins and clipped pieces, and the binning of large triangles.
#include "pipeline.h"

#include "pages.h"

#include <stdlib.h>

enum {
    SLAB = 2 << 20,   // a huge page
    FILLED = 1 << 18, // triangles that fill the first one of each thread, or nearly
};

// The next `bytes` of a list of slabs; new slabs come from the system and stay for later frames.
static void *slab_take(struct cpu_frame *cpu, struct slab_list *list, size_t bytes)
{
    if (list->count == 0 || list->used + bytes > SLAB) {
        int next = list->count == 0 ? 0 : list->current + 1;
        if (next == list->count) {
            if (list->count == list->room) {
                int room = list->room ? list->room * 2 : 16;
                void **slabs = realloc(list->slabs, (size_t)room * sizeof *slabs);
                if (!slabs)
                    goto out_of_memory;
                list->slabs = slabs;
                list->room = room;
            }
            if (!call_charge(cpu->call, SLAB))
                goto out_of_memory;
            size_t held;
            bool filled = next > 0 || cpu->frame->triangle_count > FILLED; // rather than a part of it
            void *slab = filled ? pages_get(SLAB, &held) : pages_get_sparse(SLAB, &held);
            if (!slab) {
                call_refund(cpu->call, SLAB);
                goto out_of_memory;
            }
            list->slabs[list->count++] = slab;
        }
        list->current = next;
        list->used = 0;
    }
    void *memory = (char *)list->slabs[list->current] + list->used;
    list->used += bytes;
    return memory;

out_of_memory:
    __atomic_store_n(&cpu->failed, FAILED_MEMORY, __ATOMIC_RELAXED);
    return NULL;
}

size_t slabs_bytes(const struct slab_list *list) { return (size_t)list->count * SLAB; }

size_t slabs_free(struct slab_list *list)
{
    size_t bytes = slabs_bytes(list);
    for (int i = 0; i < list->count; i++)
        pages_free(list->slabs[i], SLAB);
    free(list->slabs);
    *list = (struct slab_list){0};
    return bytes;
}

struct bin_block *new_bin_block(struct cpu_frame *cpu, struct thread_state *thread)
{
    return slab_take(cpu, &thread->blocks, sizeof(struct bin_block));
}

// A power of two, so that a piece's number tells its slab.
enum { PIECES_PER_SLAB = SLAB / 64 };
_Static_assert(sizeof(struct clipped_piece) <= 64, "a clipped piece has a place of 64 bytes");

struct clipped_piece *new_clipped_piece(struct cpu_frame *cpu, struct thread_state *thread, uint32_t *number)
{
    struct clipped_piece *piece = slab_take(cpu, &thread->pieces, 64);
    if (piece)
        *number = thread->piece_count++;
    return piece;
}

const struct clipped_piece *clipped_piece(const struct thread_state *thread, uint32_t number)
{
    const char *slab = thread->pieces.slabs[number / PIECES_PER_SLAB];
    return (const struct clipped_piece *)(slab + (size_t)(number % PIECES_PER_SLAB) * 64);
}

void bin_large(struct cpu_frame *cpu, struct thread_state *thread, const struct snapped *c, uint32_t id)
{
    int64_t area =
        (int64_t)(c->x[1] - c->x[0]) * (c->y[2] - c->y[0]) - (int64_t)(c->x[2] - c->x[0]) * (c->y[1] - c->y[0]);
    if (area == 0)
        return;
    int low_x = c->x[0], high_x = c->x[0], low_y = c->y[0], high_y = c->y[0];
    for (int k = 1; k < 3; k++) {
        low_x = c->x[k] < low_x ? c->x[k] : low_x;
        high_x = c->x[k] > high_x ? c->x[k] : high_x;
        low_y = c->y[k] < low_y ? c->y[k] : low_y;
        high_y = c->y[k] > high_y ? c->y[k] : high_y;
    }
    const int shift = SUBPIXEL_SHIFT + TILE_SHIFT;
    int x0 = low_x >> shift, x1 = high_x >> shift, y0 = low_y >> shift, y1 = high_y >> shift;
    x0 = x0 < 0 ? 0 : x0;
    y0 = y0 < 0 ? 0 : y0;
    x1 = x1 >= cpu->tiles_across ? cpu->tiles_across - 1 : x1;
    y1 = y1 >= cpu->tiles_down ? cpu->tiles_down - 1 : y1;
    // Edge functions, positive inside; a tile is missed when its most inner corner is outside of an edge.
    int64_t sign = area > 0 ? 1 : -1, size = (int64_t)1 << shift;
    int64_t a[3], b[3], most[3];
    for (int k = 0; k < 3; k++) {
        int n = (k + 1) % 3;
        a[k] = -sign * (c->y[n] - c->y[k]);
        b[k] = sign * (c->x[n] - c->x[k]);
        most[k] = (a[k] > 0 ? a[k] * size : 0) + (b[k] > 0 ? b[k] * size : 0);
    }
    for (int ty = y0; ty <= y1; ty++)
        for (int tx = x0; tx <= x1; tx++) {
            int64_t px = (int64_t)tx << shift, py = (int64_t)ty << shift;
            bool missed = false;
            for (int k = 0; k < 3; k++)
                missed |= a[k] * (px - c->x[k]) + b[k] * (py - c->y[k]) + most[k] < 0;
            if (!missed)
                bin_put(cpu, thread, (ty * cpu->tiles_across + tx) * TILE_BINS, id, 0);
        }
}
