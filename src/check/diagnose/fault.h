// fault.h: the known mistakes. Each is a fault: a set of switches of the fault shader.
//
// The fault shader (fault_light.glsl) computes the lighting correctly or with faults switched on. It is independent of
// the library's own equations, which have no such switches.
#ifndef FAULT_H
#define FAULT_H

#include "shader_interface.h"

// The switches. The fault shader queries each with is(NAME).
// clang-format off
#define FAULT_BITS(X) \
    X(LONG_NORMAL) X(LONG_NORMAL_VERTEX) X(LONG_EYE) X(LONG_LIGHT) X(RAW_HALF) X(HALF_LONG) \
    X(HALF_MEAN) X(NORMAL_OBJECT) X(NORMAL_BY_MODEL) X(NORMAL_WITH_W) X(NORMAL_CLIP) X(INWARD) \
    X(LIGHT_AS_GIVEN) X(LIGHT_TWICE) X(LIGHT_CLIP) X(LIGHT_FROM_OBJECT) X(POINT_CLIP) \
    X(EYE_FROM_OBJECT) X(EYE_CLIP) X(FOUR) X(DIRECTION_AS_POINT) X(DIRECTION_MINUS_ORIGIN) \
    X(DIRECTION_REVERSED) X(LIGHT_BACKWARDS) X(EYE_BACKWARDS) X(VIEWER_INFINITE) X(EARLY_LIGHT) X(EARLY_EYE) \
    X(MEAN_DISTANCE) X(ATTENUATION_SWAPPED) X(ATTENUATION_INVERTED) X(BARE_DIFFUSE) X(BARE_SPECULAR) \
    X(AMBIENT_ATTENUATED) X(AMBIENT_EACH_LIGHT) X(NO_AMBIENT) X(NO_DIFFUSE) X(NO_SPECULAR) \
    X(NO_GATE) X(NO_CLAMP) X(ABSOLUTE) X(OTHER_LOBE) X(REFLECT_SIGN) X(SHININESS_4) \
    X(SHININESS_QUARTER) X(SPECULAR_TIMES_D) X(KD_KS_SWAPPED) X(KA_KD_SWAPPED) X(SPECULAR_TINTED) \
    X(SPECULAR_AS_DIFFUSE) X(ENCODED) X(ALPHA_ONE) X(ALPHA_SUM) X(FIRST_LIGHT_ONLY) \
    X(LAST_LIGHT_ONLY) X(NO_CONE) X(NO_CUTOFF) X(NO_EXPONENT) X(NO_FLIP) X(SMOOTH_FOR_FLAT) \
    X(VERTEX_CLAMPED) X(UPSIDE_DOWN)
// clang-format on

enum fault_bit {
#define FAULT_BIT(name) BIT_##name,
    FAULT_BITS(FAULT_BIT)
#undef FAULT_BIT
        FAULT_BIT_COUNT
};
typedef uint64_t fault_set; // bit i: switch i

// The conditions under which a fault can occur; 0: always.
enum fault_where {
    WHERE_FRAGMENT = 1,     // lighting in the fragment shader
    WHERE_VERTEX = 2,       // lighting in the vertex shader
    WHERE_OBJECT_LIGHT = 4, // lights in object space
    WHERE_EYE_LIGHT = 8,    // lights in eye space
    WHERE_PHONG = 16,       // Phong's highlight is expected
    WHERE_BLINN = 32,       // Blinn–Phong's is expected
};

struct fault {
    const char *id;
    fault_set set;
    unsigned where;          // bits of fault_where
    unsigned needs;          // reference_need: one of the scenes in use must have it
    const char *explanation; // a sentence
    const char *correction;  // one line; {place} is replaced by the shader's own name (fault_text)
};

extern const struct fault faults[];
extern const int fault_count;

// Whether the fault can occur in these shaders.
bool fault_applies(const struct fault *fault, const struct shader_interface *interface, lam_light_frame frame,
                   lam_reflection reflection, unsigned needs);

// Expands an explanation or a correction: each {place} becomes the name that the shaders use.
void fault_text(const char *template, const struct shader_interface *interface, lam_light_frame frame,
                lam_reflection reflection, char *out, size_t capacity);

#endif
