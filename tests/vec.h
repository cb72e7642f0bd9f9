// vec.h: vectors in double, for the tests' own calculations.
#ifndef VEC_H
#define VEC_H

#include <math.h>

typedef struct vec {
    double x, y, z;
} vec;

static inline vec of(double x, double y, double z) { return (vec){x, y, z}; }
static inline vec add(vec a, vec b) { return of(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline vec sub(vec a, vec b) { return of(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline vec times(vec a, double s) { return of(a.x * s, a.y * s, a.z * s); }
static inline double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vec cross(vec a, vec b)
{
    return of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline vec unit(vec a) { return times(a, 1 / sqrt(dot(a, a))); }

#endif
