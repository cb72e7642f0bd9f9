// seen_positions.h: which vertices of a mesh lie where triangles lie that a picture shows: the first half of
// seen_normals.h's work.
#ifndef SEEN_POSITIONS_H
#define SEEN_POSITIONS_H

#include "fan_lanes.h"
#include "halt.h"
#include "normals_fan.h"
#include "seen_normals.h"

enum {
    CHUNK = 1 << 16, // vertices or corners of one piece of work
    BATCH = 64,      // vertices looked up at a time
};

#define NONE UINT32_MAX

struct seen_worker; // seen_normals.c

struct seeing {
    const lam_mesh *mesh;
    uint32_t first; // number of the mesh's triangle 0
    double least_cosine;
    const struct fan_lanes *lanes;
    struct seen_normals *seen;
    struct pool *pool;
    struct halt halt;
    struct arena scratch;
    struct spare spare;
    size_t vertices, corners;
    struct number_set shown; // vertices of the triangles that are seen

    uint32_t *slots; // by position: the lowest shown vertex there
    size_t slot_mask;
    uint32_t *filter_bits; // a bit for some bits of the hash
    struct fan_filter filter;
    int crowded; // touched atomically: a file was made so that positions fall into few slots

    uint32_t
        *position_of; // vertex → number of its position, NONE: none of a seen triangle; NULL: ask the table
    size_t positions;
    unsigned range_shift;
    size_t ranges;
    size_t slab;
    struct seen_worker *workers;
};

// Memory from the spare one while there is some, else from the arena; NULL: out of memory. Any thread.
void *seeing_take(struct seeing *s, struct arena *arena, size_t count, size_t size);
void *seeing_take_zeroed(struct seeing *s, size_t bytes); // from the scratch arena

static inline size_t pieces_of(size_t total, size_t piece) { return (total + piece - 1) / piece; }

static inline size_t piece_end(size_t index, size_t total, size_t piece)
{
    return (index + 1) * piece < total ? (index + 1) * piece : total;
}

// The table, and what it says of each vertex; of a mesh without indices its corners are asked for later, by
// look_up.
bool find_positions(struct seeing *s, lam_error *error);

// Where the table does not serve (`crowded`): all vertices are welded, in time that no file can stretch.
bool weld_all(struct seeing *s, lam_error *error);

// The position numbers of `count` vertices from `first` on, NONE: none of a seen triangle. Most are none, and
// few of those pass the filter. Returns the steps beyond first slots.
size_t look_up(const struct seeing *s, size_t first, size_t count, uint32_t out[BATCH]);

// No more steps in the table than a well filled one takes; else `crowded` is set. A file can be made to take
// more.
bool few_steps(struct seeing *s, size_t steps, size_t total);

#endif
