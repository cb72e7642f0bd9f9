// fault.h: the mistakes that are known, each a set of switches of the model (fault_light.glsl).
//
// The model is lighting that can be wrong on purpose; it lives here, apart from the equations of the library,
// which cannot.
#ifndef FAULT_H
#define FAULT_H

#include "shader_interface.h"

// The switches. In the GLSL of the model each is is(NAME).
// clang-format off
#define MISTAKE_BITS(X) \
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
#define MISTAKE_BIT(name) BIT_##name,
    MISTAKE_BITS(MISTAKE_BIT)
#undef MISTAKE_BIT
        FAULT_BIT_COUNT
};
typedef uint64_t fault_set; // bit i: switch i

// Where a mistake can be made; 0: everywhere.
enum fault_where {
    WHERE_FRAGMENT = 1,     // lighting in the fragment shader
    WHERE_VERTEX = 2,       // in the vertex shader
    WHERE_OBJECT_LIGHT = 4, // contracts whose lights are in the model's space
    WHERE_EYE_LIGHT = 8,    // in eye space
    WHERE_PHONG = 16,       // where Phong's lobe is asked for
    WHERE_BLINN = 32,       // Blinn–Phong's
};

struct fault {
    const char *id;
    fault_set set;
    unsigned where;
    unsigned needs;    // study needs: only where one of the scenes in use has it
    const char *says;  // a sentence
    const char *write; // one line; {role} in braces is the shader's own name of it (fault_write)
};

extern const struct fault mistakes[];
extern const int fault_count;

// Whether the mistake can be made with these shaders.
bool fault_applies(const struct fault *mistake, const struct shader_interface *reading, lam_light_frame frame,
                   lam_reflection reflection, unsigned needs);

// A sentence or line of the table, {role} filled in with the names that the shaders use.
void fault_write(const char *template, const struct shader_interface *reading, lam_light_frame frame,
                 lam_reflection reflection, char *out, size_t room);

#endif
