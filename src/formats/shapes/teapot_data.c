// teapot_data.c: Martin Newell's teapot (University of Utah, 1975), the control points of its 32 bicubic Bézier
// patches.
//
// The published list contains 306 points, most of which are rotated or mirrored copies. The body, the rim, the lid and
// the bottom consist of four quarters around the vertical axis. The handle and the spout consist of two mirrored
// halves. This file lists each point once, with the published numbers: z is up, the spout points along +x, the pot
// touches z = 0. The bottom's four patches were added later to Newell's 28 patches.
#include "teapot_data.h"

// A quarter around the axis from direction a to direction b has the control points ra, ra + kb, ka + rb, rb. The factor
// k is 0.56 r, close to a circle's 0.5523 r. For the lid's knob, with r = 0.8, Newell chose 0.45.
const struct teapot_ring teapot_body[4][4] = {
    // the bottom, starting at its centre
    {{0, 0, 0}, {1.425, 0.798, 0}, {1.5, 0.84, 0.075}, {1.5, 0.84, 0.15}},
    // lower body
    {{1.5, 0.84, 0.15}, {1.5, 0.84, 0.225}, {2, 1.12, 0.45}, {2, 1.12, 0.9}},
    // upper body
    {{2, 1.12, 0.9}, {2, 1.12, 1.35}, {1.75, 0.98, 1.875}, {1.5, 0.84, 2.4}},
    // the rim, up to its inside
    {{1.5, 0.84, 2.4}, {1.4375, 0.805, 2.53125}, {1.3375, 0.749, 2.53125}, {1.4, 0.784, 2.4}},
};

const struct teapot_ring teapot_lid[2][4] = {
    // the lid, starting at its edge
    {{1.3, 0.728, 2.4}, {1.3, 0.728, 2.55}, {0.4, 0.224, 2.55}, {0.2, 0.112, 2.7}},
    // the knob, up to its top
    {{0.2, 0.112, 2.7}, {0, 0, 2.85}, {0.8, 0.45, 3.15}, {0, 0, 3.15}},
};

// A half of a cross-section has the control points (ax, 0, az), (ax, ∓width, az), (bx, ∓width, bz), (bx, 0, bz).
const struct teapot_section teapot_handle[2][4] = {
    // upper half, from the body
    {{-1.6, 2.025, -1.5, 2.25, 0.3},
     {-2.3, 2.025, -2.5, 2.25, 0.3},
     {-2.7, 2.025, -3.0, 2.25, 0.3},
     {-2.7, 1.8, -3.0, 1.8, 0.3}},
    // lower half, back to the body
    {{-2.7, 1.8, -3.0, 1.8, 0.3},
     {-2.7, 1.575, -3.0, 1.35, 0.3},
     {-2.5, 1.125, -2.65, 0.9375, 0.3},
     {-2.0, 0.9, -1.9, 0.6, 0.3}},
};

const struct teapot_section teapot_spout[2][4] = {
    // from the body up
    {{1.7, 1.425, 1.7, 0.6, 0.66},
     {2.6, 1.425, 3.1, 0.825, 0.66},
     {2.3, 2.1, 2.4, 2.025, 0.25},
     {2.7, 2.4, 3.3, 2.4, 0.25}},
    // the tip and its inside
    {{2.7, 2.4, 3.3, 2.4, 0.25},
     {2.8, 2.475, 3.525, 2.49375, 0.25},
     {2.9, 2.475, 3.45, 2.5125, 0.15},
     {2.8, 2.4, 3.2, 2.4, 0.15}},
};
