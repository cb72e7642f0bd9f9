// mesh_edges.h: the edges of a mesh's triangles, each once. They depend on the mesh alone, not on the view.
#ifndef MESH_EDGES_H
#define MESH_EDGES_H

#include "arena.h"

#include <lambent/mesh.h>

enum {
    EDGE_INNER = 1,  // every triangle at it says so (lam_mesh.inner_edges): no edge of a polygon of the file
    EDGE_OPEN = 2,   // one face is at it. Triangles with the same three vertices are one face
    EDGE_SHARED = 4, // more than two are
    EDGE_ALIKE = 8,  // both of its faces run along it in the same direction: they are wound differently
};

// An edge that leads from a corner of a triangle to the triangle's next corner, and where another triangle has it.
struct mesh_edge {
    uint32_t corner;
    uint32_t other; // a corner as well; of EDGE_OPEN `corner` itself
    uint32_t kind;  // of EDGE_…
};

static inline uint32_t edge_end(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

// Lists the edges of a mesh in `edges`, which has space for three of each triangle, and returns how many there are. Corners at the same
// position are the same, whatever their indices. Triangles with two equal corners have no edges. *failed: out of memory, or the call must end, and
// `error` is filled.
uint32_t mesh_edges(const lam_mesh *mesh, struct mesh_edge *edges, struct call_control *call, bool *failed,
                    lam_error *error);

#endif
