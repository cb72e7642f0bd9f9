// edge_lines.h: edges on their way from the mesh to the picture.
#ifndef EDGE_LINES_H
#define EDGE_LINES_H

#include "edges.h"

#include "loop_status.h"

// The view that all edges of a frame share.
struct edge_view {
    const struct frame *frame;
    const struct hierarchy *hierarchy;
    double eye[3];    // in the hierarchy's space: the eye, or with an orthographic camera the direction to it
    double near_[4];  // a p + b with p in that space: > 0 behind the near plane
    bool every_hides; // no triangle is culled, and light goes through none
    double window[2]; // pixels
    struct loop_status *loop;
};

// The part of an edge that is inside of the picture, or close by.
struct edge_line {
    double over_w[2][3], inverse_w[2]; // its ends p: p/w and 1/w, p in the hierarchy's space, w the clip coordinate
    double x[2], y[2], length;         // in the window, pixels
    double half;                       // of its width, pixels
    double start;                      // pixels of its chain before it
    bool reversed;                     // the chain runs from its second end to its first
    int style;
    bool whole[2];         // the end is the edge's own
    uint32_t first, count; // its points
};

// A point of a line by its share of the line's length in the window.
struct edge_point {
    uint32_t line;
    double share;
};

// A part of a line that is drawn.
struct edge_stroke {
    double x[2], y[2];
    double half; // of its width
    int style;
    bool round[2]; // caps; else the end is cut off at a right angle
};

// Sets hidden[i] for each of `count` points: 1: a surface lies between it and the eye.
typedef void edge_rays(const struct edge_view *view, const struct edge_line *lines, const struct edge_point *points,
                       size_t count, uint8_t *hidden);

// Returns the widest of at most `lanes` lanes. Every one gives the same answers.
edge_rays *edge_rays_for(int lanes);

// A piece of a line's picture is drawn into `strokes`. Returns false if memory runs out.
bool edge_stroke_add(struct edge_strokes *strokes, struct edge_stroke stroke, struct call_control *call);

// Fills memory->coverage from the strokes of all threads.
bool edges_cover(struct edge_memory *memory, const struct frame *frame, struct pool *pool, struct call_control *call,
                 lam_error *error);

#endif
