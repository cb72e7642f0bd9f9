// tangent_kernels.h: MikkTSpace's calculations for triangles and corners, LANES triangles at a time. The code is
// compiled once for each instruction set (meson.build). All versions give identical results.
#ifndef TANGENT_KERNELS_H
#define TANGENT_KERNELS_H

#include "corner_weld.h"

// The properties of a triangle that determine its group, as bits.
enum triangle_flags {
    TRIANGLE_PRESERVING = 1,  // the texture is not mirrored
    TRIANGLE_JOINS_ANY = 2,   // the triangle has no direction, and no orientation until a group reaches it
    TRIANGLE_DEGENERATE = 4,  // two of its positions are equal
    TRIANGLE_HAS_A_GROUP = 8, // a corner has a group
};
enum { TRIANGLES_AFTER = 15 }; // the kernels may overwrite this number of flags after the last triangle's flag

struct tangent_kernels {
    // Sets the flags of the triangles from `first` to `end`, except TRIANGLE_HAS_A_GROUP.
    void (*look)(const lam_mesh *mesh, uint32_t first, uint32_t end, uint8_t *flags);
    // Adds the corners of these triangles, in order, to the sums of their groups. For each summand, makes the
    // triangle's ∂p/∂s perpendicular to the normal, normalizes the result, and multiplies it by the angle at the
    // corner. The angle is measured in the plane perpendicular to the normal. The fourth float is the sum of these
    // angles. Corners of triangles with TRIANGLE_DEGENERATE or TRIANGLE_JOINS_ANY add nothing.
    void (*add)(const lam_mesh *mesh, uint32_t first, uint32_t end, const uint8_t *flags, const uint32_t *groups,
                float (*sums)[4]);
};

extern const struct tangent_kernels tangent_kernels_scalar, tangent_kernels_avx2, tangent_kernels_avx512;

#endif
