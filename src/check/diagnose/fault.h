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
    X(HALF_MEAN) X(NORMAL_OBJECT) X(NORMAL_BY_MODEL) X(NORMAL_BY_INVERSE) X(NORMAL_BY_TRANSPOSE) \
    X(NORMAL_AS_POINT) X(NORMAL_WITH_W) X(NORMAL_CLIP) X(NORMAL_EYE) X(INWARD) X(UNIT_REFLECTION) X(FACE_FORWARD) \
    X(LIGHT_AS_GIVEN) X(LIGHT_TWICE) X(LIGHT_CLIP) X(LIGHT_FROM_OBJECT) X(POINT_CLIP) \
    X(EYE_FROM_OBJECT) X(EYE_CLIP) X(EYE_AT_ORIGIN) X(FOUR) X(DIRECTION_AS_POINT) X(DIRECTION_MINUS_ORIGIN) \
    X(DIRECTION_REVERSED) X(LIGHT_BACKWARDS) X(EYE_BACKWARDS) X(VIEWER_INFINITE) X(EARLY_LIGHT) X(EARLY_EYE) \
    X(EARLY_MIRROR) X(MEAN_DISTANCE) X(ATTENUATION_SWAPPED) X(ATTENUATION_INVERTED) X(D_FOR_SQUARE) \
    X(SQUARE_FOR_D) X(DISTANCE_ONE) X(INVERSE_SQUARE) X(INVERSE_DISTANCE) X(BARE_DIFFUSE) X(BARE_SPECULAR) \
    X(AMBIENT_ATTENUATED) X(AMBIENT_EACH_LIGHT) X(NO_AMBIENT) X(NO_DIFFUSE) X(NO_SPECULAR) \
    X(NO_GATE) X(NO_CLAMP) X(ABSOLUTE) X(ABSOLUTE_DIFFUSE) X(HALF_LAMBERT) X(SQUARED_DIFFUSE) X(OTHER_LOBE) \
    X(REFLECT_SIGN) X(SPECULAR_TIMES_D) X(KD_KS_SWAPPED) X(KA_KD_SWAPPED) X(SPECULAR_TINTED) \
    X(SPECULAR_AS_DIFFUSE) X(BARE_KA) X(BARE_KD) X(BARE_KS) X(WHITE_LIGHT) X(SPECULAR_LIGHT_AS_DIFFUSE) X(ENCODED) X(ALPHA_ONE) X(ALPHA_SUM) \
    X(FIRST_LIGHT_ONLY) X(LAST_LIGHT_ONLY) X(LAST_LIGHT_MISSING) X(FIRST_LIGHT_MISSING) X(NO_CONE) X(NO_CUTOFF) \
    X(NO_EXPONENT) X(CONE_IN_DEGREES) X(CONE_BY_ACOS) X(CONE_INSIDE_OUT) X(CONE_REVERSED) X(EVERY_LIGHT_A_SPOT) X(CONE_OF_L) X(NO_FLIP) X(FLIP) \
    X(SMOOTH_FOR_FLAT) X(VERTEX_CLAMPED) X(UPSIDE_DOWN)
// clang-format on

enum fault_bit {
    BIT_NONE, // ends the list of a fault's switches
#define FAULT_BIT(name) BIT_##name,
    FAULT_BITS(FAULT_BIT)
#undef FAULT_BIT
        FAULT_BIT_COUNT
};
_Static_assert(FAULT_BIT_COUNT <= 128, "fault_set has two words");

// Switches, and what is done with the exponent of the highlight.
typedef struct fault_set {
    uint64_t words[2]; // bit i: switch i
    float factor;      // the exponent is multiplied by it; 0: it is not
    float constant;    // the exponent, whatever the material's is; 0: the material's
} fault_set;

bool fault_set_has(const fault_set *set, enum fault_bit bit);
bool fault_set_equal(const fault_set *a, const fault_set *b);

// The conditions under which a fault can occur; 0: always.
enum fault_where {
    WHERE_FRAGMENT = 1,      // lighting in the fragment shader
    WHERE_VERTEX = 2,        // lighting in the vertex shader
    WHERE_OBJECT_LIGHT = 4,  // lights in object space
    WHERE_EYE_LIGHT = 8,     // lights in the space of the lighting, eye or world space
    WHERE_PHONG = 16,        // Phong's highlight is expected
    WHERE_BLINN = 32,        // Blinn–Phong's is expected
    WHERE_REFLECT = 64,      // reflect() occurs in the shaders
    WHERE_WORLD = 128,       // lighting in world space
    WHERE_WORLD_LIGHT = 256, // lights in world space, lighting in eye space
    WHERE_STRENGTHS = 1024,  // colours and their strengths are apart
    WHERE_FOUR = 512,        // vectors of four components may be lit: some varying is a vec4, or the vertices are lit
};

// What the search has to find out about a fault: the factor of the exponent, above or below 1, or the constant.
enum fault_fit { FIT_NONE, FIT_LARGER, FIT_SMALLER, FIT_CONSTANT };

enum { MAX_FAULT_BITS = 8 };

struct fault {
    const char *id;
    uint8_t bits[MAX_FAULT_BITS]; // of fault_bit; ends with BIT_NONE
    unsigned where;               // bits of fault_where
    unsigned needs;               // reference_need: one of the scenes in use must have it
    const char *explanation;      // a sentence
    const char *correction;       // one line; {place} is replaced by the shader's own name (fault_text)
    float factor;                 // of the exponent; 0: none
    enum fault_fit fit;
    bool rare;       // not mentioned beside another with the same pictures
    bool style;      // not a mistake: a form that is as right as the reference
    bool whole_term; // a term, or several, are missing altogether
};

extern const struct fault faults[];
extern const int fault_count;

// The set with a fault of the table as well.
fault_set fault_set_add(const fault_set *set, const struct fault *fault);

// Whether the fault can occur in these shaders.
bool fault_applies(const struct fault *fault, const struct shader_interface *interface, lam_light_frame frame,
                   lam_reflection reflection, unsigned needs);

// Expands an explanation or a correction: each {place} becomes the name that the shaders use.
void fault_text(const char *template, const struct shader_interface *interface, lam_light_frame frame,
                lam_reflection reflection, char *out, size_t capacity);

#endif
