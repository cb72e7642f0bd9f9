// mesh_edges.h: lists the edges of a mesh's triangles, and lists each shared edge only once. The edges depend only on
// the mesh, not on the view.
#ifndef MESH_EDGES_H
#define MESH_EDGES_H

#include "arena.h"

#include <lambent/mesh.h>

enum {
    EDGE_INNER = 1,  // lies inside a polygon, according to all triangles at the edge (lam_mesh.inner_edges)
    EDGE_OPEN = 2,   // belongs to one face; triangles with the same three vertices are one face
    EDGE_SHARED = 4, // belongs to more than two faces
    EDGE_ALIKE = 8,  // both faces traverse the edge in the same direction, so their windings are inconsistent
    EDGE_CUT = 16,   // is on the outline of a cut surface
};

// An edge from a corner of a triangle to the triangle's next corner.
struct mesh_edge {
    uint32_t corner;
    uint32_t other; // a corner with the same edge in another triangle; for EDGE_OPEN, equal to `corner`
    uint32_t kind;  // EDGE_… bits
};

static inline uint32_t edge_end(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

// Lists the edges of a mesh in `edges`, which has space for three per triangle, and returns their number. Corners at
// the same position are treated as the same corner, regardless of their indices. Triangles with two equal corners have
// no edges. Sets *failed and fills `error` if memory runs out or the call is stopped.
uint32_t mesh_edges(const lam_mesh *mesh, struct mesh_edge *edges, struct call_control *call, bool *failed,
                    lam_error *error);

#endif
