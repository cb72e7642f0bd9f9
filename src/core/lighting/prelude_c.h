// prelude_c.h: defines the vocabulary of the equations in C, for LANES pixels at a time (1, 4, 8 or 16).
//
// The equations (lobes.h, lights.h, sum.h, point.h, layers.h) are one source for C and GLSL. They use only + − * / and
// comparisons on num, the functions below, and the functions of lanes.h and functions.h that prelude.glsl lists.
// prelude.glsl defines the same vocabulary in GLSL. A new function needs one line in this file, one line in
// prelude.glsl, and one row in tests/lighting/words.h.
#ifndef PRELUDE_C_H
#define PRELUDE_C_H

#include "functions.h"

#define FN LANE_FN // precedes every function
#define STRUCT(name)                                                                                                   \
    typedef struct name name;                                                                                          \
    struct name // starts every struct

STRUCT(vec3) { num x, y, z; };
STRUCT(vec4) { num x, y, z, w; };

FN vec3 vec3_of(num x, num y, num z) { return (vec3){x, y, z}; }
LANE_FN vec3 vec3_from(const float v[3]) { return vec3_of(num_of(v[0]), num_of(v[1]), num_of(v[2])); }
FN vec4 vec4_of(num x, num y, num z, num w) { return (vec4){x, y, z, w}; }
FN vec3 xyz(vec4 a) { return (vec3){a.x, a.y, a.z}; }

FN vec3 add3(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
FN vec3 sub3(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
FN vec3 mul3(vec3 a, vec3 b) { return (vec3){a.x * b.x, a.y * b.y, a.z * b.z}; } // ⊙, per component
FN vec3 scale3(vec3 a, num s) { return (vec3){a.x * s, a.y * s, a.z * s}; }
FN vec3 negate3(vec3 a) { return (vec3){-a.x, -a.y, -a.z}; }
FN num dot3(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
FN vec3 cross3(vec3 a, vec3 b) { return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
FN vec3 mix3(vec3 a, vec3 b, num t) { return add3(a, scale3(sub3(b, a), t)); } // a at 0, b at 1
FN vec3 pick3(mask m, vec3 a, vec3 b) { return (vec3){pick(m, a.x, b.x), pick(m, a.y, b.y), pick(m, a.z, b.z)}; }

// The tables for single_scattering, schlick_scattering and sheen_albedo (tables.c).
extern const float albedo_table[], bias_table[], sheen_table[];
FN num albedo_texel(num index) { return num_of_bits(igather((const int32_t *)albedo_table, int_of(index))); }
FN num bias_texel(num index) { return num_of_bits(igather((const int32_t *)bias_table, int_of(index))); }
FN num sheen_texel(num index) { return num_of_bits(igather((const int32_t *)sheen_table, int_of(index))); }

// Rounds down a number between 0 and 2^31.
FN num whole(num x) { return num_of_int(int_of(x)); }

// Normalises vectors whose lengths are from 1e-15 to 1e15; the zero vector stays zero.
FN vec3 unit3(vec3 a) { return scale3(a, rsqrt(dot3(a, a))); }

#endif
