// prelude.glsl: defines the vocabulary of the equations in GLSL (330, 300 es; nothing here needs more than 120). The
// same vocabulary in C: prelude_c.h, src/core/base/math/lanes.h and functions.h.
#ifdef GL_ES
precision highp float;
precision highp int;
#endif

#define FN
#define STRUCT(name) struct name
#define num float
#define mask bool
#define vec3_of vec3
#define vec4_of vec4

float num_of(float x) { return x; }
vec3 xyz(vec4 a) { return a.xyz; }

vec3 add3(vec3 a, vec3 b) { return a + b; }
vec3 sub3(vec3 a, vec3 b) { return a - b; }
vec3 mul3(vec3 a, vec3 b) { return a * b; }
vec3 scale3(vec3 a, float s) { return a * s; }
vec3 negate3(vec3 a) { return -a; }
float dot3(vec3 a, vec3 b) { return dot(a, b); }
vec3 cross3(vec3 a, vec3 b) { return cross(a, b); }
vec3 mix3(vec3 a, vec3 b, float t) { return a + (b - a) * t; }

float pick(bool m, float a, float b) { return m ? a : b; }
vec3 pick3(bool m, vec3 a, vec3 b) { return m ? a : b; }
bool both(bool a, bool b) { return a && b; }
bool either(bool a, bool b) { return a || b; }
bool negate(bool a) { return !a; }

float min_of(float a, float b) { return a < b ? a : b; }
float max_of(float a, float b) { return a > b ? a : b; }
float absolute(float x) { return abs(x); }
float positive(float x) { return x > 0.0 ? x : 0.0; }
float saturate(float x) { return min_of(positive(x), 1.0); }

float whole(float x) { return floor(x); }
const float albedo_table[1024] = float[1024](
#include "albedo.table"
);
float albedo_texel(float index) { return albedo_table[int(index)]; }
const float bias_table[1024] = float[1024](
#include "bias.table"
);
float bias_texel(float index) { return bias_table[int(index)]; }
const float sheen_table[1024] = float[1024](
#include "sheen.table"
);
float sheen_texel(float index) { return sheen_table[int(index)]; }

float square_root(float x) { return sqrt(x); }
float rsqrt(float x) { return inversesqrt(max_of(x, 1.0e-37)); }
float log2_of(float x) { return log2(max_of(x, 1.17549435e-38)); }
float exp2_of(float y) { return y >= -126.0 ? exp2(min_of(y, 127.5)) : 0.0; }
float power(float base, float exponent)
{
    return base >= 1.17549435e-38 ? exp2_of(exponent * log2(base)) : (exponent > 0.0 ? 0.0 : 1.0);
}
float unit_power(float base, float exponent) { return power(min_of(base, 1.0), exponent); }
vec3 unit3(vec3 a) { return a * rsqrt(dot(a, a)); }
