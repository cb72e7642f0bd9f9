// edge_tasks.h: a task that converts some edges of one draw to strokes.
#ifndef EDGE_TASKS_H
#define EDGE_TASKS_H

#include "edge_lines.h"

// An edge in the view, if dashes run along chains of edges (edge_chains.c).
struct edge_measure {
    double x[2], y[2], length; // in the window, clipped to the picture; pixels
    int style;                 // −1 if the edge is not drawn
    bool whole[2];             // false if the end is clipped
    // For each end of this edge, the edge end to which it is linked: twice the index of the other edge, plus 0 or 1.
    // NO_LINK if none.
    uint32_t link[2];
    bool placed;
    double start;  // length of the chain before this edge
    bool reversed; // the chain runs from end 1 of this edge to end 0
};
#define NO_LINK 0xffffffffu

enum { EDGES_PER_TASK = 2048 };

// The weight of a feature edge (edge_specks.c): the length of the edge in the picture, in units of 1/EDGE_WEIGHT_PIXEL
// pixels. A crease beside a face that is narrower than a pixel, or beside a sliver, has a smaller weight: the narrower
// the face, the smaller the weight. An edge that continues outside the picture has the largest weight.
enum {
    EDGE_WEIGHT_PIXEL = 1024, // the unit
    EDGE_WEIGHT_MAX = 0xfffd,
    EDGE_SPECK = 0xfffe,     // the edge's group is too small to be drawn
    EDGE_UNWEIGHED = 0xffff, // not a feature edge, or outside the picture
};

struct edge_task {
    const struct edge_view *view;
    const struct frame_draw *draw;
    const struct mesh_edge *edges;
    uint32_t count;
    struct edge_measure *measures; // one per edge; NULL if there are no chains
    uint16_t *weights;             // one per edge; NULL if there are no feature edges
    edge_rays *rays_of;
    struct edge_strokes *strokes; // output: the strokes of the thread
    uint64_t drawn, rays;         // output: the task adds its counts of drawn edges and of rays
};

// Returns the number of bytes of scratch memory that a thread needs.
size_t edge_scratch_bytes(void);

// Returns false if memory runs out or the call is stopped.
bool edge_task_draw(struct edge_task *task, void *scratch);

// Draws line segments, whose ends are in world space, in one style: the parts that no surface hides. Returns false as
// edge_task_draw does.
bool edge_task_segments(struct edge_task *task, const double (*segments)[2][3], int count, int style, void *scratch);

// Appends a stroke to `strokes`. Returns false if memory runs out.
bool edge_stroke_add(struct edge_strokes *strokes, struct edge_stroke stroke, struct call_control *call);

// Draws the annotations of a frame (annotations.c): adds their strokes to the task's. Returns false as edge_task_draw
// does. The task has no draw and no edges, and `view->hierarchy` is NULL if there is no grid.
bool annotations_draw(struct edge_task *task, void *scratch);

// Fills the array `measures` of a task, except the data about chains.
void edge_task_measure(struct edge_task *task);

// Fills the weights of a task.
void edge_task_weigh(struct edge_task *task);

// Gets the ends of an edge in the hierarchy's space.
void edge_task_ends(const struct edge_task *task, uint32_t edge, double ends[2][3]);

// Each task contains all edges of a draw. Marks the edges of a group as specks if the total weight of the group is less
// than eight pixels. Returns false if memory runs out or the call is stopped.
bool edge_specks_drop(const struct edge_task *draws, int draw_count, struct loop_status *loop);

// Links the measured edges of a draw into chains and computes their positions in the chains. If only two lines meet at
// a corner, and both have the same style, the function connects them. Otherwise the function connects the straightest
// pairs of one style that turn by less than 60 degrees. Returns false if memory runs out or the call is stopped.
bool edge_chains_link(const struct frame_draw *draw, const struct mesh_edge *edges, struct edge_measure *measures,
                      uint32_t count, struct loop_status *loop);

#endif
