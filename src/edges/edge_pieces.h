// edge_pieces.h: a piece of work of the edges: some edges of one draw, from the mesh to strokes.
#ifndef EDGE_PIECES_H
#define EDGE_PIECES_H

#include "edge_lines.h"

enum { EDGE_PIECE = 2048 }; // edges

struct edge_piece {
    const struct edge_view *view;
    const struct frame_draw *draw;
    const struct mesh_edge *edges;
    uint32_t count;
    edge_rays *rays_of;
    struct edge_strokes *strokes; // out, of the thread
    uint64_t drawn, rays;         // out, to be added to
};

// Bytes of scratch memory that a thread needs.
size_t edge_scratch_bytes(void);

// False: memory is out, or the call must end.
bool edge_piece_draw(struct edge_piece *piece, void *scratch);

#endif
