// edge_twins.h: finds the triangle across each edge.
#ifndef EDGE_TWINS_H
#define EDGE_TWINS_H

#include "corner_weld.h"

enum { NO_CORNER = UINT32_MAX };

static inline uint32_t next_corner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
static inline uint32_t prev_corner(uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

// Edge c is the edge from corner c to the next corner of its triangle. The twin of an edge connects the same welded
// corners in the opposite direction. If more than two triangles share an edge, the first edge of one direction is
// paired with the first of the other, the second with the second, and so on.
struct edge_twins {
    uint32_t *twin; // the twin of each edge, or NO_CORNER
    // The corners of each welded number v, in order: list[first[v]] … list[first[v + 1] − 1].
    uint32_t *first, *list;
};

// Omits triangles whose flags contain a bit of `left_out`: their edges get no twins, and their corners are not in the
// list. `memory` owns the result and the scratch memory.
bool edge_twins(struct edge_twins *edges, const struct corner_weld *weld, uint32_t triangle_count, const uint8_t *flags,
                unsigned left_out, struct arena *memory, struct call_control *call, lam_error *error);

#endif
