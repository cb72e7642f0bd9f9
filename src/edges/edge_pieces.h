// edge_pieces.h: a task of the edges: some edges of one draw, from the mesh to strokes.
#ifndef EDGE_PIECES_H
#define EDGE_PIECES_H

#include "edge_lines.h"

// An edge as it is seen, where dashes run along chains of edges (edge_chains.c).
struct edge_measure {
    double x[2], y[2], length; // in the window, within the picture; pixels
    int style;                 // −1: it is not drawn
    bool whole[2];             // nothing is cut off at that end
    uint32_t link[2];          // the end that continues that end: twice the number of its edge, and 0 or 1; NO_LINK
    bool placed;
    double start;  // length of the chain before it
    bool reversed; // the chain runs from its end 1 to its end 0
};
#define NO_LINK 0xffffffffu

enum { EDGE_PIECE = 2048 }; // edges

struct edge_piece {
    const struct edge_view *view;
    const struct frame_draw *draw;
    const struct mesh_edge *edges;
    uint32_t count;
    struct edge_measure *measures; // of the edges; NULL: no chains
    edge_rays *rays_of;
    struct edge_strokes *strokes; // out, of the thread
    uint64_t drawn, rays;         // out, to be added to
};

// Bytes of scratch memory that a thread needs.
size_t edge_scratch_bytes(void);

// False: out of memory, or the call must end.
bool edge_piece_draw(struct edge_piece *piece, void *scratch);

// Fills the measures of a task, except for its chains.
void edge_piece_measure(struct edge_piece *piece);

// Links the measured edges of a draw to chains, and places them there: through each corner two lines of one style that meet
// alone, or else the straightest pairs that turn by less than 60 degrees. False: out of memory, or the call must end.
bool edge_chains_link(const struct frame_draw *draw, const struct mesh_edge *edges, struct edge_measure *measures,
                      uint32_t count, struct loop_status *loop);

#endif
