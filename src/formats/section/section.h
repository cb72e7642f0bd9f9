// section.h: the steps of cutting a scene by a plane: mesh_cut.c cuts meshes, outlines.c finds their closed outlines, and
// regions.c fills these with triangles.
#ifndef SECTION_H
#define SECTION_H

#include "scene_internal.h"

#include <lambent/section.h>

// A point of a cut mesh that is not a corner of the mesh before: on the edge between two corners, or a corner of a cut
// surface that comes from another mesh.
struct cut_point {
    uint32_t kept, removed; // corners of the mesh before, whose attributes are mixed
    double t;               // from `kept`
    float position[3];      // in mesh coordinates
};

// An edge of a cut: from one new point to another, counter-clockwise around the cut surface.
struct cut_edge {
    uint32_t points[2]; // of mesh_cut.points
    uint32_t part;
};

// A mesh before and after a cut. A corner of the new mesh is a corner of the mesh before, or (with NEW_CORNER) a point.
#define NEW_CORNER 0x80000000u
struct mesh_cut {
    const lam_mesh *mesh;
    double plane[4];   // in mesh coordinates without the origin; a position with plane · (x y z 1) >= 0 is removed
    uint32_t *corners; // of the new items
    uint8_t *inner;    // lam_mesh.inner_edges of the new items
    uint32_t *from;    // for each new item, the item of the mesh before
    uint32_t *parts;   // for each part of the mesh before (at least one), the number of its new items
    uint32_t items;    // number of new items, without cut surfaces
    uint32_t removed;  // number of items that were removed or cut
    struct cut_point *points;
    uint32_t point_count, point_capacity;
    struct cut_edge *edges;
    uint32_t edge_count;
    struct cap_triangles *caps; // one element for each part of the mesh before
};

// The triangles of a part's cut surface: indices into mesh_cut.points, and bits as in lam_mesh.inner_edges.
struct cap_triangles {
    uint32_t *points;
    uint8_t *inner;
    uint32_t count, capacity;
};

// Sorts the items of a mesh, and cuts the items that the plane meets. `cut` contains the mesh and the plane. Arrays are
// in `memory`. Returns false on failure.
bool mesh_cut_find(struct mesh_cut *cut, struct arena *memory, struct call_control *call, lam_error *error);

// Makes the new mesh, with the cut surfaces as its last parts. `materials` contains the material of the cut surface of
// each part. The arrays of the new mesh are in `memory`.
bool mesh_cut_make(const struct mesh_cut *cut, const int *materials, struct arena *memory, lam_mesh *out,
                   struct call_control *call, lam_error *error);

// An object of the scene that the plane cuts.
struct cut_object {
    int object;
    lam_mat4 to_world; // from mesh coordinates without the origin
    struct mesh_cut cut;
    const bool *closes; // for each part: whether its cut surface is wanted
};

// The closed outlines of all cut objects, in the plane.
struct outline_result {
    double area;
    int open; // number of outlines that are not closed
};

// Closes the outlines: fills the caps of each object. The plane is in world space. `memory` contains the results.
bool outlines_close(struct cut_object *objects, int count, const lam_section *plane, struct arena *memory,
                    struct outline_result *result, struct call_control *call, lam_error *error);

#endif
