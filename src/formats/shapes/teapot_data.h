// teapot_data.h: the teapot's control points, in bands of adjacent patches.
#ifndef TEAPOT_DATA_H
#define TEAPOT_DATA_H

// A ring of control points around the vertical axis: the ring's radius, the tangential offset of the inner points, and
// the ring's height.
struct teapot_ring {
    double radius, step, height;
};

// A planar ring of control points across the handle or the spout, from a to b in the plane of symmetry.
struct teapot_section {
    double ax, az, bx, bz, width;
};

extern const struct teapot_ring teapot_body[4][4], teapot_lid[2][4];
extern const struct teapot_section teapot_handle[2][4], teapot_spout[2][4];

#endif
