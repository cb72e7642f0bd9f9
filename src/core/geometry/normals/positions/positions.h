// positions.h: positions that several vertices share, found by a hash table in which one vertex represents each position.
//
// The table and its filter are divided into sections by the hash. First, each thread distributes its vertices to the
// sections (normals_memory.h). Then each section is filled by a single thread. A section fits into the processor's cache.
#ifndef POSITIONS_H
#define POSITIONS_H

#include "normals_memory.h"
#include "pool.h"

#include <lambent/mesh.h>

#include <stdint.h>

// --- finds shared positions with long loops over vertices and corners, and computes the bits and the hash of a
// position. The loops are compiled once for each instruction set (meson.build).

enum { WORD = 64 }; // vertices or corners that are processed together: one for each bit in a word of a bit set

// A Bloom filter with two bits per position, both in the word selected by the hash's upper bits.
struct position_filter {
    uint32_t *words;
    unsigned shift; // < 32
};

static inline uint32_t position_filter_bits(uint32_t hash)
{
    return (uint32_t)1 << (hash & 31) | (uint32_t)1 << (hash >> 5 & 31);
}

// Gets the bits of a position. −0 is replaced with 0, so that equal positions have equal bits.
static inline void position_bits(const float *position, uint32_t bits[3])
{
    for (int a = 0; a < 3; a++) {
        uint32_t of;
        __builtin_memcpy(&of, position + a, 4);
        bits[a] = of == 0x80000000u ? 0 : of;
    }
}

static inline int same_position(const uint32_t a[3], const uint32_t b[3])
{
    return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
}

// Returns a hash of a position's bits. Round numbers have only upper bits set, so the upper bits are first combined
// with the lower bits.
static inline uint32_t hash_position(const uint32_t bits[3])
{
    uint32_t h = (bits[0] ^ bits[0] >> 16) * 0x9e3779b1u;
    h = (h ^ h >> 15 ^ bits[1] ^ bits[1] >> 16) * 0x85ebca77u;
    h = (h ^ h >> 15 ^ bits[2] ^ bits[2] >> 16) * 0xc2b2ae3du;
    return h ^ h >> 16;
}

struct position_simd {
    int lanes; // 32-bit numbers per register
    // Hashes at most WORD points of 3 floats. Bit i of the result is set if the filter may contain point i.
    uint64_t (*test)(const float *points, uint32_t count, const struct position_filter *filter, uint32_t hashes[WORD]);
    // Numbers the members in one word of a set, starting with `first`. All other items get UINT32_MAX.
    void (*number)(uint64_t members, uint32_t first, uint32_t numbers[WORD]);
    // Examines `count` corners, from number `first` on, and lists those whose vertices (`indices`) are at a listed
    // position. Each list needs capacity for `count` entries plus one register.
    uint32_t (*list)(const uint32_t *indices, const uint32_t *position_of, uint32_t first, uint32_t count,
                     uint32_t *corners, uint32_t *positions);
};

// Returns the widest version that the processor supports, with at most `lanes` lanes.
const struct position_simd *position_simd_for(int lanes);

// --- a hash table of positions

// Four slots, which fill a cache line and are compared together.
struct position_slots {
    int32_t bits[3][4];
    int32_t vertex[4]; // NONE if this slot and all slots after it are free
};

struct position_hash {
    struct position_slots *lines;
    struct position_filter filter;
    uint32_t part_bits; // bits of the hash that select one of 2^part_bits sections
    uint32_t part_lines, part_words;
};

// Chooses the number of sections for about this many vertices.
void position_hash_plan(struct position_hash *table, size_t vertices);

// Returns the size of the table in bytes, for this many vertices in all sections together. `strict` doubles the bits of
// the filter, so that fewer positions outside the table pass the filter.
size_t position_hash_size(struct position_hash *table, size_t vertices, bool strict);
void position_hash_place(struct position_hash *table, void *memory);

static inline uint32_t position_hash_parts(const struct position_hash *table)
{
    return (uint32_t)1 << table->part_bits;
}

static inline uint32_t position_hash_part(const struct position_hash *table, uint32_t hash)
{
    return (uint32_t)((uint64_t)hash << table->part_bits >> 32);
}

// Returns the cache line at which the search for a hash starts.
static inline size_t position_hash_start(const struct position_hash *table, uint32_t hash)
{
    return (size_t)(hash * ((uint64_t)table->part_lines << table->part_bits) >> 32);
}

// Copies the integers one by one, because a wide load would have to wait for the narrow stores before it.
static inline void copy_bits(uint32_t to[3], const uint32_t from[3])
{
    to[0] = from[0];
    to[1] = from[1];
    to[2] = from[2];
}

// Returns the vertex that represents a position, or NONE if the position is not in the table. Increases *probes by the
// number of cache lines searched after the first cache line.
uint32_t position_hash_find(const struct position_hash *table, const uint32_t bits[3], uint32_t hash, size_t *probes);

// Fills one section of the table with the entries of its bin in each thread's list, then empties these bins. With
// `duplicates`, each vertex whose position another vertex represents is added to the list of duplicates of `mine`.
// Returns false if the probe limit is reached or memory runs out.
bool position_hash_fill(struct position_hash *table, uint32_t part, struct block_lists *lists, int threads,
                        struct block_lists *mine, bool duplicates);

// Returns true if there are so many probes that the file was probably made to cause collisions.
static inline bool probe_limit_exceeded(size_t probes, size_t searches) { return probes > 16 * searches + 4096; }

// --- finds the vertices of a mesh that are at the positions of given triangles, and groups them by position. This is
// the first step of visible_normals.h.

enum {
    CHUNK = 1 << 16, // vertices or corners per task
};

// The result of a recent lookup in the table. An empty entry contains bits that no position has.
struct cached_position {
    uint32_t bits[3];
    uint32_t position; // NONE if the position is not in the table
};

struct position_search {
    // Input.
    const lam_mesh *mesh;
    const struct rank_bitset *triangles;
    uint32_t first;               // number of the mesh's triangle 0 in the set
    uint32_t triangles_of_others; // number of members of the set that belong to earlier meshes
    const struct position_simd *simd;
    struct pool *pool;
    struct loop_status loop;
    struct scratch_memory scratch, until_fans[2]; // until_fans: memory that may be used until fans are computed
    size_t vertices, corners;

    struct arena arena;
    // Memory of threads and their lists. It does not count towards the memory limit, because the number of threads must
    // not decide whether the call succeeds. `charged` bytes are counted for the lists instead.
    struct arena of_threads;
    size_t charged;
    struct position_hash table;
    struct block_lists *lists; // the lists of each thread
    int probe_limit_reached;   // set atomically if positions collide more often than in any ordinary file
    struct rank_bitset done;   // vertices whose normals are already computed; it has no bits if there are none

    // Output. The number of a position is the rank of its representative vertex among `wanted`. In meshes without
    // indices, this number is the rank of the representative corner among the corners of the set's triangles.
    struct rank_bitset wanted; // vertices of the set's triangles, for indexed meshes
    // For each vertex, the number of its position, or NONE. NULL if corners are looked up in the table instead.
    uint32_t *position_of;
    struct cached_position **caches; // the cache of each thread
    uint32_t caches_mask;
    size_t positions;
};

// Allocates from the scratch memory or an arena. Returns NULL if memory runs out.
static inline void *search_alloc(struct position_search *s, struct arena *arena, size_t count, size_t size)
{
    return scratch_take(&s->scratch, arena, count, size);
}
void *search_alloc_zeroed(struct position_search *s, size_t bytes); // from the search's own arena

static inline const float *point_of(const struct position_search *s, size_t vertex)
{
    return s->mesh->positions + 3 * vertex;
}

static inline size_t chunks_of(size_t total, size_t chunk) { return (total + chunk - 1) / chunk; }

static inline size_t chunk_end(size_t index, size_t total, size_t chunk)
{
    return (index + 1) * chunk < total ? (index + 1) * chunk : total;
}

// Finds the vertices of the set's triangles, for indexed meshes. Returns false if memory runs out.
bool find_wanted(struct position_search *s);

// Numbers the wanted vertices, and stores the numbers in `position_of`. Returns false if memory runs out.
bool number_wanted(struct position_search *s);

// Initialises the lists, and fills the table. Also fills `position_of` if the mesh is indexed.
bool find_positions(struct position_search *s, lam_error *error);
void position_search_free(struct position_search *s);

// Finds the positions by sorting all vertices. This function is used if the probe limit is reached, because its time is
// bounded for every file.
bool find_positions_by_sorting(struct position_search *s, lam_error *error);

// Returns how many of the mesh's triangles before `triangle` are in the set. If `triangle` is the mesh's number of
// triangles, the result counts all triangles of the mesh that are in the set.
static inline uint32_t triangles_before(const struct position_search *s, size_t triangle)
{
    size_t number = s->first + triangle;
    return (number < s->triangles->size ? rank_bitset_rank(s->triangles, number) : s->triangles->count) -
           s->triangles_of_others;
}

// Checks whether `searches` searches may need this number of probes. Returns false if this check or an earlier check
// failed.
bool within_probe_limit(struct position_search *s, size_t probes, size_t searches);

// --- collects the corners at shared positions and sorts them into bins, one for each range of positions.
// This is the second step of visible_normals.h.

// Bin r of each thread's lists contains the corners whose position p satisfies p >> shift = r.
struct position_bins {
    struct position_search *search;
    unsigned shift;
    size_t count;
};

// Puts the corners into bins. Returns false if the call was stopped (search->loop) or the probe limit was exceeded.
bool position_bins_fill(struct position_bins *bins, struct position_search *search);

// Returns the number of corners in a bin.
size_t position_bin_corners(const struct position_bins *bins, size_t bin);

// Sorts the corners of a bin by position; the corners of the bin's position i begin at sorted[starts[i]] and end before
// sorted[starts[i+1]].
void position_bin_sort(const struct position_bins *bins, size_t bin, uint32_t *restrict sorted,
                       uint32_t *restrict starts);

#endif
