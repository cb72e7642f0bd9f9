// outlines.h: the closed outlines of a cut, shared by outlines.c, which finds them, and regions.c, which fills them.
#ifndef OUTLINES_H
#define OUTLINES_H

#include "section.h"

#include "triangulate.h"

enum { NONE = UINT32_MAX };

struct vertex {
    double x, y;    // in the plane
    uint32_t point; // of the object's mesh_cut.points
    int object;     // index in outlines.objects
    uint32_t first; // the first edge that starts here
    uint32_t next;  // in its slot of the hash table
    int balance;
};

struct edge {
    uint32_t a, b;  // vertices
    uint32_t next;  // the next edge that starts at `a`
    uint32_t after; // the next edge of the loop
    uint32_t part, group;
    int object;
    bool used;
};

struct loop {
    uint32_t first, count; // edges, linked by edge.after
    double area;           // signed; counter-clockwise is positive
    double low_x, low_y, high_x, high_y;
    double x, y;              // a point inside
    int parent;               // the smallest loop around it, or −1
    const struct edge *owner; // an edge of the part that the region in the loop belongs to; NULL for a cavity
};

struct outlines {
    struct cut_object *objects;
    lam_vec3 origin, across, upward; // of the plane: across × upward is the normal
    struct vertex *vertices;
    struct edge *edges;
    uint32_t vertex_count, edge_count, groups;
    struct loop *loops;
    uint32_t loop_count;
    double low[2], size;   // the lowest coordinates, and the larger extent
    uint32_t *table, mask; // hash table of the vertices
    struct arena *scratch, *memory;
    struct triangulator triangulator;
    struct outline_result *result;
    struct call_control *call;
    lam_error *error;
};

static inline bool no_memory(const struct outlines *o, size_t bytes)
{
    return call_memory_error(o->call, bytes, o->error);
}

// Returns the area that a loop encloses.
static inline double size_of(const struct loop *loop) { return loop->area < 0 ? -loop->area : loop->area; }

// Fills the regions between the loops with triangles, and adds them to the caps of the objects.
bool regions_fill(struct outlines *o);

#endif
