// corner_weld.c: finds equal items by their hashes. The items are sorted by hash. If different items have the same
// hash, they are sorted by their values.
#include "edge_keys.h"
#include "tangent_steps.h"

#include <stdlib.h>
#include <string.h>

enum {
    NUMBERS = 8, // floats per item: position, normal, texture coordinates
    DIGIT_BITS = 11,
    DIGITS = 3, // digits of 32 bits
    BUCKETS = 1 << DIGIT_BITS,
    CHECK_INTERVAL = 1 << 16, // the number of items after which the call's limits are checked again
};

struct hashed_item {
    uint32_t hash, item;
};

// The bit patterns of an item's floats.
struct item_bits {
    uint32_t numbers[NUMBERS], item;
};

static void copy_bits(uint32_t *to, const float *from, int count)
{
    float canonical[3] = {0};
    for (int i = 0; i < count; i++)
        canonical[i] = from ? from[i] + 0.0f : 0; // −0 becomes 0
    memcpy(to, canonical, (size_t)count * sizeof *to);
}

static void bits_of(const lam_mesh *mesh, bool by_vertex, uint32_t item, struct item_bits *out)
{
    uint32_t p = by_vertex ? item : mesh_element(NULL, mesh->indices, item);
    uint32_t n = by_vertex ? item : mesh_element(mesh->normal_indices, mesh->indices, item);
    uint32_t t = by_vertex ? item : mesh_element(mesh->texcoord_indices, mesh->indices, item);
    copy_bits(out->numbers, mesh->positions + 3 * (size_t)p, 3);
    copy_bits(out->numbers + 3, mesh->normals ? mesh->normals + 3 * (size_t)n : NULL, 3);
    copy_bits(out->numbers + 6, mesh->texcoords ? mesh->texcoords + 2 * (size_t)t : NULL, 2);
    out->item = item;
}

static uint32_t hash_of(const uint32_t numbers[NUMBERS])
{
    uint64_t hash = 0;
    for (int i = 0; i < NUMBERS; i++) {
        hash = (hash ^ numbers[i]) * 0x9e3779b97f4a7c15u; // 2⁶⁴ ÷ the golden ratio
        hash ^= hash >> 32;
    }
    return (uint32_t)hash;
}

// Sorts by hash with a radix sort; items with equal hashes keep their order. DIGITS is odd, so the result is in
// `other`.
static void sort_by_hash(struct hashed_item *items, struct hashed_item *other, uint32_t count)
{
    for (int digit = 0; digit < DIGITS; digit++) {
        uint32_t starts[BUCKETS] = {0}, total = 0;
        int shift = digit * DIGIT_BITS;
        for (uint32_t i = 0; i < count; i++)
            starts[items[i].hash >> shift & (BUCKETS - 1)]++;
        for (int b = 0; b < BUCKETS; b++) {
            uint32_t here = starts[b];
            starts[b] = total;
            total += here;
        }
        for (uint32_t i = 0; i < count; i++)
            other[starts[items[i].hash >> shift & (BUCKETS - 1)]++] = items[i];
        struct hashed_item *sorted = other;
        other = items;
        items = sorted;
    }
}

static int by_numbers(const void *a, const void *b)
{
    const struct item_bits *x = a, *y = b;
    int order = memcmp(x->numbers, y->numbers, sizeof x->numbers);
    return order ? order : (x->item > y->item) - (x->item < y->item);
}

// Welds the items that have the same hash. Usually all of these items are equal. If they differ, they are sorted in a
// separate array.
static bool weld_run(uint32_t *firsts, bool by_vertex, const lam_mesh *mesh, const struct hashed_item *run,
                     uint32_t count, struct call_control *call, lam_error *error)
{
    struct item_bits first, other;
    bool equal = true;
    bits_of(mesh, by_vertex, run[0].item, &first);
    for (uint32_t i = 0; i < count; i++) {
        firsts[run[i].item] = run[0].item;
        if (i && equal) {
            bits_of(mesh, by_vertex, run[i].item, &other);
            equal = memcmp(first.numbers, other.numbers, sizeof first.numbers) == 0;
        }
    }
    if (equal)
        return true;
    struct arena memory;
    arena_start(&memory, call);
    struct item_bits *all = arena_array(&memory, count, sizeof *all);
    if (!all) {
        arena_free(&memory);
        return call_memory_error(call, count * sizeof *all, error);
    }
    for (uint32_t i = 0; i < count; i++)
        bits_of(mesh, by_vertex, run[i].item, &all[i]);
    qsort(all, count, sizeof *all, by_numbers); // the order is total, so the sorting method does not affect the result
    for (uint32_t i = 0, from = 0; i < count; i++) {
        from = memcmp(all[i].numbers, all[from].numbers, sizeof all[i].numbers) == 0 ? from : i;
        firsts[all[i].item] = all[from].item;
    }
    arena_free(&memory);
    return true;
}

bool corner_weld(struct corner_weld *weld, const lam_mesh *mesh, struct arena *memory, struct call_control *call,
                 lam_error *error)
{
    bool by_vertex = mesh->indices && !mesh->normal_indices && !mesh->texcoord_indices;
    uint32_t corners = 3 * mesh->triangle_count;
    weld->items = by_vertex ? mesh->vertex_count : corners;
    uint32_t *firsts = arena_array(memory, weld->items, sizeof *firsts);
    uint32_t *of = by_vertex ? arena_array(memory, corners, sizeof *of) : firsts;
    struct hashed_item *items = arena_array(memory, weld->items, sizeof *items);
    struct hashed_item *sorted = arena_array(memory, weld->items, sizeof *sorted);
    if (!firsts || !of || !items || !sorted)
        return call_memory_error(call, weld->items * (sizeof *firsts + 2 * sizeof *items) + corners * sizeof *of,
                                 error);
    for (uint32_t i = 0; i < weld->items; i++) {
        if (i % CHECK_INTERVAL == 0 && !call_should_continue(call))
            return call_error(call, error);
        struct item_bits bits;
        bits_of(mesh, by_vertex, i, &bits);
        items[i] = (struct hashed_item){hash_of(bits.numbers), i};
    }
    sort_by_hash(items, sorted, weld->items);
    for (uint32_t from = 0, to; from < weld->items; from = to) {
        for (to = from + 1; to < weld->items && sorted[to].hash == sorted[from].hash; to++)
            ;
        if (from / CHECK_INTERVAL != to / CHECK_INTERVAL && !call_should_continue(call))
            return call_error(call, error);
        if (!weld_run(firsts, by_vertex, mesh, sorted + from, to - from, call, error))
            return false;
    }
    for (uint32_t c = 0; by_vertex && c < corners; c++)
        of[c] = firsts[mesh->indices[c]];
    weld->of = of;
    return true;
}

// --- pairs the edges of adjacent triangles. Each edge is assigned to the lower of the two welded numbers at its ends.
// For each welded number, the edges to and from higher numbers are sorted by their other end.

enum { NUMBERS_PER_CHECK = 1 << 13 }; // the call's limits are checked again after this many welded numbers

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
        if (v % NUMBERS_PER_CHECK == 0 && !call_should_continue(call))
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
