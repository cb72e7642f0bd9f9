// edge_lines.h: data for the steps that convert the edges of a mesh to strokes in the picture.
#ifndef EDGE_LINES_H
#define EDGE_LINES_H

#include "edges.h"

#include "loop_status.h"

// The view, which all edges of a frame share.
struct edge_view {
    const struct frame *frame;
    const struct hierarchy *hierarchy;
    double eye[3];    // in the hierarchy's space: the eye or, with an orthographic camera, the direction to the eye
    double near_[4];  // vector a and number b: a·p + b > 0 if a point p in the hierarchy's space is beyond the near
                      // plane
    bool every_hides; // every triangle hides edges: no triangle is culled or transparent
    double window[2]; // pixels
    struct loop_status *loop;
};

// The part of an edge that is inside the picture, or close to it.
struct edge_line {
    // p/w and 1/w of the line's ends p, where p is in the hierarchy's space and w is the clip coordinate
    double over_w[2][3], inverse_w[2];
    double x[2], y[2], length; // in the window, pixels
    double half;               // half of the line's width, pixels
    double start;              // length of the chain before the line, pixels
    bool reversed;             // the chain runs from the line's second end to its first end
    int style;
    bool whole[2];         // whether the end is an end of the edge itself
    uint32_t first, count; // the range of the line's points
};

// A point of a line, given as a fraction of the line's length in the window.
struct edge_point {
    uint32_t line;
    double share;
};

// A visible part of a line.
struct edge_stroke {
    double x[2], y[2];
    double half; // half of the stroke's width
    int style;
    bool round[2]; // round caps; otherwise the end is cut off at a right angle
};

// Sets hidden[i] to 1 for each of `count` points with a surface between the point and the eye.
typedef void edge_rays(const struct edge_view *view, const struct edge_line *lines, const struct edge_point *points,
                       size_t count, uint8_t *hidden);

// Fills memory->coverage from the strokes of all threads.
bool edges_cover(struct edge_memory *memory, const struct frame *frame, struct pool *pool, struct call_control *call,
                 lam_error *error);

#endif
