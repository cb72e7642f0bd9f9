// shared_positions.h: finds the vertices of a mesh that are at the positions of given triangles, and groups them by
// position. This is the first step of visible_normals.h.
#ifndef SHARED_POSITIONS_H
#define SHARED_POSITIONS_H

#include "pool.h"
#include "position_hash.h"
#include "rank_bitset.h"

#include <lambent/mesh.h>

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

#endif
