// teapot_data.h: the teapot's control points, in bands of patches that follow each other.
#ifndef TEAPOT_DATA_H
#define TEAPOT_DATA_H

// A ring of control points around the vertical axis: distance from it, the length of the inner points'
// sideways step, and height.
struct teapot_ring {
    double radius, step, height;
};

// A flat ring of control points across handle or spout, between two points a and b in the plane of symmetry.
struct teapot_section {
    double ax, az, bx, bz, width;
};

extern const struct teapot_ring teapot_body[4][4], teapot_lid[2][4];
extern const struct teapot_section teapot_handle[2][4], teapot_spout[2][4];

#endif
