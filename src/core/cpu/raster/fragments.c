// fragments.c: sorts a tile's fragments by group (surface and side), because they are shaded group by group.
#include "fragments.h"

#include <string.h>

// Sorts the fragments by group with a stable radix sort, 11 bits at a time, starting with the lowest bits.
static void sort_by_group(struct fragments *fragments, uint32_t largest)
{
    uint32_t n = (uint32_t)fragments->count;
    uint32_t *from = fragments->order, *to = fragments->scratch;
    for (int shift = 0; shift < 32 && (largest >> shift) != 0; shift += 11) {
        uint32_t starts[2048] = {0}, sum = 0;
        for (uint32_t i = 0; i < n; i++)
            starts[fragments->group[i] >> shift & 2047]++;
        for (int d = 0; d < 2048; d++) {
            uint32_t c = starts[d];
            starts[d] = sum;
            sum += c;
        }
        for (uint32_t i = 0; i < n; i++)
            to[starts[fragments->group[from[i]] >> shift & 2047]++] = from[i];
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != fragments->order)
        memcpy(fragments->order, from, n * sizeof *from);
}

// Groups the fragments by side, for pictures with a single surface. Returns whether all fragments belong to the same
// side.
static bool group_sides(struct fragments *fragments)
{
    uint32_t backs = 0, n = (uint32_t)fragments->count;
    for (uint32_t i = 0; i < n; i++) {
        fragments->group[i] = fragments->id[i] >> 31;
        backs += fragments->group[i];
    }
    return backs == 0 || backs == n;
}

// Copies fragments that are sorted by pixel, and sorts the fragments of each pixel by triangle.
static void sort_within_pixels(struct fragments *fragments, const uint32_t *by_pixel)
{
    uint32_t n = (uint32_t)fragments->count, *order = fragments->order;
    memcpy(order, by_pixel, n * sizeof *order);
    for (uint32_t first = 0, end; first < n; first = end) {
        for (end = first + 1; end < n && fragments->pixel[order[end]] == fragments->pixel[order[first]]; end++)
            ;
        for (uint32_t gap = (end - first) / 2; gap; gap /= 2) // Shell's sort
            for (uint32_t i = first + gap; i < end; i++)
                for (uint32_t k = i; k >= first + gap && fragments->id[order[k]] < fragments->id[order[k - gap]];
                     k -= gap) {
                    uint32_t moved = order[k];
                    order[k] = order[k - gap];
                    order[k - gap] = moved;
                }
    }
}

void group_fragments(const struct frame *frame, struct fragments *fragments, const uint32_t *by_pixel)
{
    if (by_pixel)
        sort_within_pixels(fragments, by_pixel);
    else
        for (uint32_t i = 0, n = (uint32_t)fragments->count; i < n; i++)
            fragments->order[i] = i;
    if (frame->range_count == 1) {
        if (!group_sides(fragments))
            sort_by_group(fragments, 1);
        return;
    }
    uint32_t largest = 0;
    uint32_t low = 0, count = 0; // surface of the previous fragment
    int surface = 0;
    for (int i = 0; i < fragments->count; i++) {
        uint32_t id = fragments->id[i] & ~BACK_SIDE;
        if (id - low >= count) {
            surface = frame_range_of(frame, id);
            low = frame->ranges[surface].first_id;
            count = frame->ranges[surface].count;
        }
        uint32_t group = (uint32_t)surface * 2 + (fragments->id[i] >> 31);
        fragments->group[i] = group;
        largest = group > largest ? group : largest;
    }
    sort_by_group(fragments, largest);
}
