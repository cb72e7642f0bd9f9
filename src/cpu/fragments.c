// fragments.c: from samples to fragments: each pixel with each triangle it shows, and how many samples show
// it.
#include "pipeline.h"

#include <string.h>

// The pixel's fragments: one for each different number among its samples, in the order of the nearest sample
// that shows it.
static int split_pixel(const struct sample_pattern *pattern, const uint32_t *ids, struct thread_state *thread,
                       int count, uint16_t pixel)
{
    int first = count;
    for (int i = 0; i < pattern->count; i++) {
        int sample = pattern->by_distance[i];
        uint32_t id = ids[sample];
        if (id == NOTHING)
            continue;
        int f = first;
        while (f < count && thread->fragment_id[f] != id)
            f++;
        if (f == count) {
            thread->fragment_id[f] = id;
            thread->fragment_pixel[f] = pixel;
            thread->fragment_weight[f] = 0;
            thread->fragment_sample[f] = (uint8_t)sample;
            count++;
        }
        thread->fragment_weight[f]++;
    }
    return count;
}

// As split_pixel, for few samples (a constant where this is inlined): every sample is written, and kept where
// it is the first to show its triangle. Which pixels are split nobody can foresee, so branches are dear.
static inline int split_few(const struct sample_pattern *pattern, const uint32_t *ids,
                            struct thread_state *thread, int count, uint16_t pixel, int samples)
{
    for (int i = 0; i < samples; i++) {
        uint32_t id = ids[pattern->by_distance[i]];
        int first = id != NOTHING, weight = 1;
        for (int j = 0; j < samples; j++) {
            int same = ids[pattern->by_distance[j]] == id;
            first &= j < i ? !same : 1;
            weight += j > i ? same : 0;
        }
        thread->fragment_id[count] = id;
        thread->fragment_pixel[count] = pixel;
        thread->fragment_weight[count] = (uint8_t)weight;
        thread->fragment_sample[count] = pattern->by_distance[i];
        count += first;
    }
    return count;
}

// Sorts the fragments' numbers by group: by 11 bits at a time from the lowest, keeping the order within a
// group.
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
            surface = frame_surface_of(frame, id);
            low = frame->surfaces[surface].first_id;
            count = frame->surfaces[surface].count;
        }
        uint32_t group = (uint32_t)surface * 2 + (thread->fragment_id[i] >> 31);
        thread->fragment_group[i] = group;
        largest = group > largest ? group : largest;
    }
    sort_by_group(thread, largest);
}

// A tile of one sample for each pixel: every covered one is a fragment.
static void collect_single(const struct cells *cells, struct thread_state *thread, int width, int height)
{
    int count = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x += 4) { // a row of a cell
            const uint32_t *ids = thread->ids + pixel_place(cells, x, y);
            int end = width - x < 4 ? width - x : 4;
            for (int i = 0; i < end; i++) {
                thread->fragment_id[count] = ids[i];
                thread->fragment_pixel[count] = (uint16_t)(y * TILE + x + i);
                count += ids[i] != NOTHING;
            }
        }
    memset(thread->fragment_weight, 1, (size_t)count);
    memset(thread->fragment_sample, 0, (size_t)count);
    thread->pixels_covered += (uint64_t)count;
    thread->fragment_count = count;
}

// Whether all samples of a pixel, 2 or more, show the same.
static bool all_same(const uint32_t *ids, int samples)
{
    uint64_t first, differ = 0;
    memcpy(&first, ids, sizeof first);
    for (int i = 2; i < samples; i += 2) {
        uint64_t pair;
        memcpy(&pair, ids + i, sizeof pair);
        differ |= pair ^ first;
    }
    return (differ | (first >> 32 ^ (first & 0xffffffff))) == 0;
}

// `samples` is a constant where this is inlined.
static inline void collect_several(const struct sample_pattern *pattern, const struct cells *cells,
                                   struct thread_state *thread, int width, int height, int samples)
{
    int count = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const uint32_t *ids = thread->ids + pixel_place(cells, x, y);
            if (!all_same(ids, samples)) {
                uint16_t pixel = (uint16_t)(y * TILE + x);
                count = samples <= 4 ? split_few(pattern, ids, thread, count, pixel, samples)
                                     : split_pixel(pattern, ids, thread, count, pixel);
                thread->pixels_covered++;
                continue;
            }
            thread->fragment_id[count] = ids[0];
            thread->fragment_pixel[count] = (uint16_t)(y * TILE + x);
            thread->fragment_weight[count] = (uint8_t)samples;
            thread->fragment_sample[count] = pattern->by_distance[0];
            count += ids[0] != NOTHING;
            thread->pixels_covered += ids[0] != NOTHING;
        }
    thread->fragment_count = count;
}

void collect_fragments(const struct cpu_frame *cpu, struct thread_state *thread, int width, int height)
{
    struct cells cells = cells_of(cpu->pattern->count);
    switch (cpu->pattern->count) {
    case 1:
        collect_single(&cells, thread, width, height);
        break;
    case 2:
        collect_several(cpu->pattern, &cells, thread, width, height, 2);
        break;
    case 4:
        collect_several(cpu->pattern, &cells, thread, width, height, 4);
        break;
    default:
        collect_several(cpu->pattern, &cells, thread, width, height, cpu->pattern->count);
    }
}
