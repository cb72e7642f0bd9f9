// shared_positions.h: which vertices of a mesh lie where triangles lie that a picture shows, and which of them
// lie at the same position: the first part of visible_normals.h's work.
#ifndef SHARED_POSITIONS_H
#define SHARED_POSITIONS_H

#include "corner_fan_simd.h"
#include "corner_fan.h"
#include "position_hash.h"

enum {
    CHUNK = 1 << 16, // vertices or corners of one piece of work
};

// What the table said of a position lately; bits that no position has: nothing.
struct seen_answer {
    uint32_t bits[3];
    uint32_t position; // NONE: it is not in the table
};

struct seen_worker; // visible_normals.c

struct seeing {
    const lam_mesh *mesh;
    uint32_t first;       // number of the mesh's triangle 0
    uint32_t seen_before; // triangles of other meshes
    double least_cosine;
    const struct fan_lanes *lanes;
    const struct seen_lanes *search;
    struct seen_normals *seen;
    struct pool *pool;
    struct loop_status loop;
    struct arena scratch;
    struct spare spare;
    struct spare until_fans[2]; // where the mesh's elements and further normals will lie
    size_t vertices, corners;
    struct seen_table table;
    struct seen_lists *lists; // each thread's
    int crowded;              // touched atomically: a file was made so that positions fall into few slots

    // A position has the rank of the shown vertex that stands for it; without indices, of the shown corner.
    struct number_set shown;      // vertices of the triangles that are seen; of a mesh with indices
    uint32_t *position_of;        // of each vertex, NONE: none of a seen triangle; NULL: corners are looked up
    struct seen_answer **answers; // each thread's
    uint32_t answers_mask;
    size_t positions;

    unsigned range_shift;
    size_t ranges;
    struct seen_worker *workers;
};

static inline void *seeing_take(struct seeing *s, struct arena *arena, size_t count, size_t size)
{
    return spare_take(&s->spare, arena, count, size);
}
void *seeing_take_zeroed(struct seeing *s, size_t bytes); // from the scratch arena

static inline const float *point_of(const struct seeing *s, size_t vertex) { return s->mesh->positions + 3 * vertex; }

static inline size_t pieces_of(size_t total, size_t piece) { return (total + piece - 1) / piece; }

static inline size_t piece_end(size_t index, size_t total, size_t piece)
{
    return (index + 1) * piece < total ? (index + 1) * piece : total;
}

// Starts the lists and fills the table and, of a mesh with indices, `position_of`.
bool find_positions(struct seeing *s, lam_error *error);

void stop_lists(struct seeing *s);

// Where the table does not serve (`crowded`): all vertices are welded, in time that no file can stretch.
bool weld_all(struct seeing *s, lam_error *error);

// How many of the mesh's triangles before one, or in all, are seen.
static inline uint32_t seen_triangles_before(const struct seeing *s, size_t triangle)
{
    const struct number_set *set = &s->seen->triangles;
    size_t number = s->first + triangle;
    return (number < set->size ? number_set_place(set, number) : set->count) - s->seen_before;
}

// No more steps in the table than a well filled one takes; else `crowded` is set. A file can be made to take more.
bool few_steps(struct seeing *s, size_t steps, size_t total);

#endif
