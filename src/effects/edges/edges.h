// edges.h: draws edges of surfaces as lines over a finished picture: wireframes and feature edges.
//
// Both devices draw the same lines. Rays from points of an edge to the eye determine the visible parts (edge_rays.c),
// and the distance between a line and a pixel's centre determines how much of the pixel the line covers. docs/edges.md
// describes the rules.
#ifndef EDGES_H
#define EDGES_H

#include "mesh_edges.h"
#include "rays.h"

struct edge_stroke;

// A list that one thread fills.
struct edge_strokes {
    struct edge_stroke *list;
    size_t count, capacity;
};

// The memory kept from frame to frame.
struct edge_memory {
    // `edges` contains the mesh edges of all draws, in the order of the draws. `sources` describes the mesh of each
    // draw.
    struct buffer edges, sources;
    int source_count;
    struct scene_token *token; // the scene of the list; NULL if nothing is listed
    struct edge_strokes *strokes;
    struct buffer scratch;  // temporary memory of the threads
    struct buffer measures; // a struct edge_measure for each edge, if hidden lines are dashed
    struct buffer weights;  // weights of the edges, if there are feature edges
    int thread_count;
    struct buffer bands;                 // the strokes of each band of rows
    struct buffer coverage[EDGE_STYLES]; // one float per pixel
    bool styles[EDGE_STYLES];            // the styles in the last frame
};

struct edge_counts {
    uint64_t drawn, rays;
};

// Sets draws_edges and `edges`, of which the annotations use the scene's box. `pixel` is the matrix from eye space to pixels.
void frame_edges_build(struct frame *frame, const lam_scene *scene, const lam_mat4 *view, const lam_mat4 *pixel);

// Finds the lines of a frame, and computes the fraction of each pixel that the lines cover. draws_edges of the frame
// must be set. `hierarchy` belongs to the frame; it may be NULL if nothing hides lines (edges_need_rays). `lanes` is the maximum number of rays traced at a time.
bool edges_find(struct edge_memory *memory, const struct frame *frame, const struct hierarchy *hierarchy, int lanes,
                struct pool *pool, struct call_control *call, struct edge_counts *counts, lam_error *error);

// Returns whether edges_find needs the hierarchy.
static inline bool edges_need_rays(const struct frame *frame) { return frame->edges.of_model || frame->settings.grid; }

// Blends the lines over the picture of the same frame in linear light, the wireframe first. The picture may have any
// format.
void edges_blend(const struct edge_memory *memory, const struct frame *frame, lam_image *image, struct pool *pool);

void edges_free(struct edge_memory *memory);
uint64_t edges_bytes(const struct edge_memory *memory);

#endif
