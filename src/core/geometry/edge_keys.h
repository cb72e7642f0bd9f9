// edge_keys.h: integer keys for the edges of one point, so that sorting groups equal edges. The other end of each edge
// has a higher number than the point.
#ifndef EDGE_KEYS_H
#define EDGE_KEYS_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// The upper half of a key is the number of the point at the other end. The lower half is a number that the caller
// chooses, such as the corner at which the edge starts.
static inline uint64_t edge_key(uint32_t other_end, uint32_t number) { return (uint64_t)other_end << 32 | number; }

static inline int compare_edge_keys(const void *a, const void *b)
{
    uint64_t x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return (x > y) - (x < y);
}

// Most points have about six edges, for which insertion sort is faster than qsort.
static inline void sort_edge_keys(uint64_t *keys, uint32_t count)
{
    if (count > 24) {
        qsort(keys, count, sizeof *keys, compare_edge_keys);
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        uint64_t key = keys[i];
        uint32_t at = i;
        for (; at > 0 && keys[at - 1] > key; at--)
            keys[at] = keys[at - 1];
        keys[at] = key;
    }
}

#endif
