// light_kinds.h: the numbers of the kinds of light, shared by the frame, the CPU and GLSL.
//
// The same source is compiled as C and as GLSL; include it before lights.h. frame.c determines a light's kind and
// falloff (struct frame_light).

// Kinds of light that have a direction. Functions receive the kind as an integer that is the same for all lanes.
// Ambient and hemisphere light have no direction and are in sum.h.
#define LIGHT_POINT         0 // from a point, in all directions
#define LIGHT_DIRECTIONAL   1 // from infinitely far
#define LIGHT_SPOT_CUTOFF   2 // a cone with a sharp edge and a power of the cosine inside
#define LIGHT_SPOT_EXPONENT 3 // a power of the cosine, no edge
#define LIGHT_SPOT_CONES    4 // full inside an inner cone, zero outside an outer one, smooth between

// Falloff with distance, also an integer that is the same for all lanes. Directional lights have FALLOFF_NONE.
#define FALLOFF_NONE     0 // no falloff: attenuation 1/0/0 and no range
#define FALLOFF_DISTANCE 1 // 1 / (constant + linear d + quadratic d^2)
#define FALLOFF_RANGE    2 // the same, times the window of the range
