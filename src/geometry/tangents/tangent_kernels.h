// tangent_kernels.h: MikkTSpace's calculations for each triangle and each corner, for LANES triangles at a time,
// compiled once for each instruction set (meson.build). All versions give the same bytes.
#ifndef TANGENT_KERNELS_H
#define TANGENT_KERNELS_H

#include "corner_weld.h"

// The properties of a triangle that determine its group, as bits.
enum triangle_flags {
    TRIANGLE_PRESERVING = 1,  // the texture is not mirrored
    TRIANGLE_JOINS_ANY = 2,   // has no direction and, until a group reaches it, no orientation
    TRIANGLE_DEGENERATE = 4,  // two of its positions are equal
    TRIANGLE_HAS_A_GROUP = 8, // a corner has a group
};
enum { TRIANGLES_AFTER = 15 }; // flags after the last triangle's that may be overwritten

struct tangent_kernels {
    // Sets the flags of the triangles from `first` to `end`, except TRIANGLE_HAS_A_GROUP.
    void (*look)(const lam_mesh *mesh, uint32_t first, uint32_t end, uint8_t *flags);
    // Adds the corners of these triangles, in order, to their groups' sums: the triangle's ∂p/∂s, made perpendicular to
    // the normal and unit, times the angle at the corner in the plane perpendicular to the normal; the fourth number is
    // the sum of these angles. Degenerate corners, and corners that join any group, add nothing.
    void (*add)(const lam_mesh *mesh, uint32_t first, uint32_t end, const uint8_t *flags, const uint32_t *groups,
                float (*sums)[4]);
};

extern const struct tangent_kernels tangent_kernels_scalar, tangent_kernels_avx2, tangent_kernels_avx512;

#endif
