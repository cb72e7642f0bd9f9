// edge_twins.c: pairs the edges of adjacent triangles. Each edge is assigned to the lower of the two welded numbers at
// its ends. For each welded number, the edges to and from higher numbers are sorted by their other end.
#include "edge_twins.h"

#include "edge_keys.h"

#include <string.h>

enum { CHECK_INTERVAL = 1 << 13 }; // the number of welded numbers after which the call's limits are checked again

// Pairs each outgoing edge with an incoming edge that has the same other end. If several edges have the same ends, they
// are paired in their order.
static void join(uint32_t *twin, const uint64_t *out, uint32_t out_count, const uint64_t *in, uint32_t in_count)
{
    for (uint32_t i = 0, k = 0; i < out_count && k < in_count;) {
        uint32_t out_end = (uint32_t)(out[i] >> 32), in_end = (uint32_t)(in[k] >> 32);
        if (out_end == in_end) {
            twin[(uint32_t)out[i]] = (uint32_t)in[k];
            twin[(uint32_t)in[k]] = (uint32_t)out[i];
        }
        i += out_end <= in_end;
        k += in_end <= out_end;
    }
}

// Lists the corners by welded number. Returns the largest number of corners that share one welded number.
static uint32_t list_corners(struct edge_twins *edges, const struct corner_weld *weld, size_t corners,
                             const uint8_t *flags, unsigned left_out)
{
    uint32_t max = 0;
    for (size_t c = 0; c < corners; c++)
        edges->first[weld->of[c] + (size_t)1] += !(flags[c / 3] & left_out);
    for (size_t v = 0; v < weld->items; v++) {
        max = edges->first[v + 1] > max ? edges->first[v + 1] : max;
        edges->first[v + 1] += edges->first[v];
    }
    // Filling the list advances each start to the end of its section; the next loop restores the starts.
    for (size_t c = 0; c < corners; c++)
        if (!(flags[c / 3] & left_out))
            edges->list[edges->first[weld->of[c]]++] = (uint32_t)c;
    for (size_t v = weld->items; v > 0; v--)
        edges->first[v] = edges->first[v - 1];
    edges->first[0] = 0;
    return max;
}

bool edge_twins(struct edge_twins *edges, const struct corner_weld *weld, uint32_t triangle_count, const uint8_t *flags,
                unsigned left_out, struct arena *memory, struct call_control *call, lam_error *error)
{
    size_t corners = (size_t)triangle_count * 3, starts = (size_t)weld->items + 1;
    edges->twin = arena_array(memory, corners, sizeof *edges->twin);
    edges->first = arena_alloc_zeroed(memory, starts * sizeof *edges->first);
    edges->list = arena_array(memory, corners, sizeof *edges->list);
    if (!edges->twin || !edges->first || !edges->list)
        return call_memory_error(call, (2 * corners + starts) * sizeof *edges->list, error);
    memset(edges->twin, 0xff, corners * sizeof *edges->twin);
    uint32_t max = list_corners(edges, weld, corners, flags, left_out);
    uint64_t *out = arena_array(memory, max, sizeof *out), *in = arena_array(memory, max, sizeof *in);
    if (!out || !in)
        return call_memory_error(call, max * 2 * sizeof *out, error);
    for (uint32_t v = 0; v < weld->items; v++) {
        uint32_t out_count = 0, in_count = 0;
        if (v % CHECK_INTERVAL == 0 && !call_should_continue(call))
            return call_error(call, error);
        for (uint32_t i = edges->first[v]; i < edges->first[v + 1]; i++) {
            uint32_t corner = edges->list[i], prev = prev_corner(corner);
            uint32_t to = weld->of[next_corner(corner)], from = weld->of[prev];
            if (to > v)
                out[out_count++] = edge_key(to, corner);
            if (from > v)
                in[in_count++] = edge_key(from, prev);
        }
        sort_edge_keys(out, out_count);
        sort_edge_keys(in, in_count);
        join(edges->twin, out, out_count, in, in_count);
    }
    return true;
}
