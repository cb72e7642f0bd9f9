// visible_normals.h: smooth normals for the triangles that a picture shows, and for no others.
//
// The same normals, to the last bit, as normals_smooth makes for a whole mesh. Of a large model a picture
// shows few triangles; only the corners at their positions are looked for and put in order.
#ifndef VISIBLE_NORMALS_H
#define VISIBLE_NORMALS_H

#include "arena.h"
#include "pool.h"
#include "call_control.h"

#include <lambent/mesh.h>

// Some of the numbers from 0 to below `size`.
struct number_set {
    uint64_t *bits;   // 64 numbers to a word
    uint32_t *before; // of each word: members in the words before it; filled by number_set_count
    size_t size;
    uint32_t count; // of members
};

static inline size_t number_set_words(size_t size) { return (size + 63) / 64; }

// Any thread.
static inline void number_set_add(struct number_set *set, size_t number)
{
    uint64_t bit = (uint64_t)1 << number % 64, *word = &set->bits[number / 64];
    if (!(__atomic_load_n(word, __ATOMIC_RELAXED) & bit))
        __atomic_fetch_or(word, bit, __ATOMIC_RELAXED);
}

static inline bool number_set_holds(const struct number_set *set, size_t number)
{
    return set->bits[number / 64] >> number % 64 & 1;
}

// The sum of the bits, in pairs, in fours, in bytes (the baseline processor has no instruction for it).
static inline uint32_t count_bits(uint64_t x)
{
    x -= x >> 1 & UINT64_C(0x5555555555555555);
    x = (x & UINT64_C(0x3333333333333333)) + (x >> 2 & UINT64_C(0x3333333333333333));
    x = (x + (x >> 4)) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    return (uint32_t)(x * UINT64_C(0x0101010101010101) >> 56);
}

// How many members are below a number: the place of a member among all of them.
static inline uint32_t number_set_place(const struct number_set *set, size_t number)
{
    return set->before[number / 64] + count_bits(set->bits[number / 64] & (((uint64_t)1 << number % 64) - 1));
}

// Fills `before` and `count`.
void number_set_count(struct number_set *set);

// The normals of the triangles in `triangles`: corner k of the member at place p has the normal
// normals[elements[3p + k]], and two corners that share one have the same element.
struct seen_normals {
    struct number_set triangles;
    uint32_t *elements;  // 3 · triangles.count
    float (*normals)[3]; // room for as many; the first `used` are there, which are far fewer where corners share
    uint32_t used;       // by all meshes so far; in no order that is kept
};

// The element of a corner of a triangle that is in the set.
static inline uint32_t seen_element(const struct seen_normals *seen, size_t triangle, uint32_t k)
{
    return seen->elements[3 * (size_t)number_set_place(&seen->triangles, triangle) + k];
}

// Memory, aligned to 64 bytes, that may be written over.
struct spare {
    void *memory;
    size_t room, used;
    size_t lent; // behind its room (rank_bitset.h)
};

// Makes the normals of one mesh, whose triangle t has the number first + t in the set. The set is counted.
// `spare` saves fresh memory, whose first touch costs more than its use; all zero: there is none. So does the
// memory of the mesh's elements and of the normals from `used` on, before they are there. Works on no more
// than `lanes` floats at a time. Errors: LAM_LIMIT, LAM_CANCELLED.
bool normals_seen(const lam_mesh *mesh, uint32_t first, double crease_angle_rad, struct seen_normals *seen,
                  struct spare spare, int lanes, struct pool *pool, struct call_control *call, lam_error *error);

#endif
