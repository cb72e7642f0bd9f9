// fragments.c: the order in which a tile's fragments are lit: by surface and side.
#include "pipeline.h"

#include <string.h>

// Sorts the fragments' numbers by group: by 11 bits at a time from the lowest, keeping the order within a group.
static void sort_by_group(struct thread_state *thread, uint32_t largest)
{
    uint32_t n = (uint32_t)thread->fragment_count;
    uint32_t *from = thread->order, *to = thread->fragment_point; // not in use yet, and larger
    for (uint32_t i = 0; i < n; i++)
        from[i] = i;
    for (int shift = 0; shift < 32 && (largest >> shift) != 0; shift += 11) {
        uint32_t starts[2048] = {0}, sum = 0;
        for (uint32_t i = 0; i < n; i++)
            starts[thread->fragment_group[i] >> shift & 2047]++;
        for (int d = 0; d < 2048; d++) {
            uint32_t c = starts[d];
            starts[d] = sum;
            sum += c;
        }
        for (uint32_t i = 0; i < n; i++)
            to[starts[thread->fragment_group[from[i]] >> shift & 2047]++] = from[i];
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != thread->order)
        memcpy(thread->order, from, n * sizeof *from);
}

// Where there is one surface its two sides are the only groups; mostly all fragments are of one.
static bool group_sides(struct thread_state *thread)
{
    uint32_t backs = 0, n = (uint32_t)thread->fragment_count;
    for (uint32_t i = 0; i < n; i++) {
        thread->fragment_group[i] = thread->fragment_id[i] >> 31;
        backs += thread->fragment_group[i];
        thread->order[i] = i;
    }
    return backs == 0 || backs == n;
}

void group_fragments(const struct frame *frame, struct thread_state *thread)
{
    if (frame->surface_count == 1) {
        if (!group_sides(thread))
            sort_by_group(thread, 1);
        return;
    }
    uint32_t largest = 0;
    uint32_t low = 0, count = 0; // the surface of the fragment before
    int surface = 0;
    for (int i = 0; i < thread->fragment_count; i++) {
        uint32_t id = thread->fragment_id[i] & ~BACK_SIDE;
        if (id - low >= count) {
            surface = frame_draw_range_of(frame, id);
            low = frame->surfaces[surface].first_id;
            count = frame->surfaces[surface].count;
        }
        uint32_t group = (uint32_t)surface * 2 + (thread->fragment_id[i] >> 31);
        thread->fragment_group[i] = group;
        largest = group > largest ? group : largest;
    }
    sort_by_group(thread, largest);
}
