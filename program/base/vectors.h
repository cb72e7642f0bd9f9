// vectors.h: computes vector products and differences, tests vectors and colours, and converts radians to degrees.
#ifndef VECTORS_H
#define VECTORS_H

#include <lambent/base.h>

static inline double dot(lam_vec3 a, lam_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline lam_vec3 minus(lam_vec3 a, lam_vec3 b) { return (lam_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline lam_vec3 cross(lam_vec3 a, lam_vec3 b)
{
    return (lam_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline bool is_zero(lam_vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }
static inline bool is_black(lam_rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }
static inline double in_degrees(double radians) { return radians * (180 / 3.14159265358979323846); }

#endif
