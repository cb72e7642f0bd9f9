// fault.h: the known mistakes. Each mistake is a fault: a set of switches of the fault shader.
//
// The fault shader (fault_light.glsl) computes the lighting correctly or with faults switched on. The fault shader does
// not use the library's own equations, which contain no such switches.
#ifndef FAULT_H
#define FAULT_H

#include "shader_interface.h"

// The switches. The fault shader tests each switch with is(NAME). Switches up to MEAN_DISTANCE concern normals, spaces
// and lengths. The next switches, up to USE_ACES, concern the written colour. The others concern the terms.
// fault_shader.c compiles no code for groups that are switched off.
// clang-format off
#define FAULT_BITS(X) \
    X(LONG_NORMAL) X(LONG_NORMAL_VERTEX) X(LONG_EYE) X(LONG_LIGHT) X(RAW_HALF) X(HALF_LONG) \
    X(HALF_MEAN) X(NORMAL_OBJECT) X(NORMAL_BY_MODEL) X(NORMAL_BY_INVERSE) X(NORMAL_BY_TRANSPOSE) \
    X(NORMAL_AS_POINT) X(NORMAL_WITH_W) X(NORMAL_CLIP) X(NORMAL_EYE) X(INWARD) X(UNIT_REFLECTION) X(FACE_FORWARD) \
    X(LIGHT_AS_GIVEN) X(LIGHT_TWICE) X(LIGHT_CLIP) X(LIGHT_FROM_OBJECT) X(POINT_CLIP) \
    X(EYE_FROM_OBJECT) X(EYE_CLIP) X(EYE_AT_ORIGIN) X(FOUR) X(DIRECTION_AS_POINT) X(DIRECTION_MINUS_ORIGIN) \
    X(DIRECTION_REVERSED) X(LIGHT_BACKWARDS) X(EYE_BACKWARDS) X(VIEWER_INFINITE) X(EARLY_LIGHT) X(EARLY_EYE) \
    X(EARLY_MIRROR) X(NORMAL_IS_POSITION) X(NORMAL_TWICE) X(NORMAL_FLAT) X(POINT_TWICE) X(POINT_AS_DIRECTION) X(LIGHT_PLUS_POINT) \
    X(DISTANCE_KEPT) X(MEAN_DISTANCE) \
    X(ENCODED) X(ALPHA_ONE) X(ALPHA_SUM) X(CHANNELS_REVERSED) X(RED_EVERYWHERE) X(USE_REINHARD) X(USE_EXPONENTIAL) X(USE_ACES) \
    X(ATTENUATION_SWAPPED) X(ATTENUATION_INVERTED) X(D_FOR_SQUARE) \
    X(SQUARE_FOR_D) X(DISTANCE_ONE) X(INVERSE_SQUARE) X(INVERSE_DISTANCE) X(BARE_DIFFUSE) X(BARE_SPECULAR) \
    X(ATTENUATION_TWICE) X(AMBIENT_TIMES_D) X(AMBIENT_TWICE) X(AMBIENT_HALVED) X(DIFFUSE_TWICE) X(DIFFUSE_HALVED) \
    X(SPECULAR_TWICE) X(SPECULAR_HALVED) X(LOBE_OF_OTHER) X(LIGHTS_AVERAGED) X(LIGHTS_MEAN) X(LIGHTS_MULTIPLIED) \
    X(AMBIENT_ATTENUATED) X(AMBIENT_EACH_LIGHT) X(NO_AMBIENT) X(NO_DIFFUSE) X(NO_SPECULAR) \
    X(NO_GATE) X(NO_CLAMP) X(ABSOLUTE) X(ABSOLUTE_DIFFUSE) X(HALF_LAMBERT) X(SQUARED_DIFFUSE) X(OTHER_LOBE) \
    X(REFLECT_SIGN) X(SPECULAR_TIMES_D) X(KD_KS_SWAPPED) X(KA_KD_SWAPPED) X(SPECULAR_TINTED) \
    X(SPECULAR_AS_DIFFUSE) X(BARE_KA) X(BARE_KD) X(BARE_KS) X(WHITE_LIGHT) X(SPECULAR_LIGHT_AS_DIFFUSE) \
    X(FIRST_LIGHT_ONLY) X(LAST_LIGHT_ONLY) X(LAST_LIGHT_MISSING) X(FIRST_LIGHT_MISSING) X(NO_CONE) X(NO_CUTOFF) \
    X(NO_EXPONENT) X(CONE_IN_DEGREES) X(CONE_BY_ACOS) X(CONE_INSIDE_OUT) X(CONE_REVERSED) X(EVERY_LIGHT_A_SPOT) X(CONE_OF_L) X(NO_FLIP) X(FLIP) \
    X(SMOOTH_FOR_FLAT) X(VERTEX_CLAMPED) X(UPSIDE_DOWN) \
    X(ALPHA_IS_ROUGHNESS) X(ALPHA_IS_ROUGHNESS_D) X(ALPHA_IS_ROUGHNESS_V) X(D_NOT_SQUARED) X(D_TIMES_PI) \
    X(USE_HEIGHT) X(USE_SEPARABLE) X(USE_SCHLICK) X(USE_SCHLICK_IBL) X(K_OF_ALPHA) X(NO_MASKING) X(MASKING_OF_V) \
    X(MASKING_OF_L) X(NOT_DIVIDED) X(DIVIDED_BY_4) X(DIVIDED_WITHOUT_4) X(DIVIDED_TWICE) X(FRESNEL_OF_NV) \
    X(FRESNEL_OF_NH) X(FRESNEL_OF_NL) X(FRESNEL_INVERTED) X(FRESNEL_LINEAR) X(NO_FRESNEL) X(FRESNEL_TWICE) \
    X(F0_CONSTANT) X(F0_IS_ALBEDO) X(SHARE_OF_DIELECTRIC) X(SHARE_OF_MIX) X(SHARE_WHOLE) X(METAL_KEEPS_DIFFUSE) \
    X(METAL_ROUGH_SWAPPED) X(ROUGHNESS_INVERTED) X(ALBEDO_DECODED) X(NO_N_DOT_L) X(LIT_SIDE_ALONE) X(SPECULAR_WITHOUT_N_DOT_L) \
    X(DIFFUSE_TIMES_PI) X(LIGHT_WITHOUT_PI) X(USE_NO_TONE) \
    X(USE_SRGB) X(USE_GAMMA) X(NOT_ENCODED) X(TONE_AFTER_ENCODING) X(RIM_CUT) X(RIM_CLAMPED) \
    X(MAPS_OF_SRGB) X(BASE_NOT_DECODED) X(BASE_DECODED_TWICE) X(BASE_MAP_ALONE) X(BASE_FACTOR_ALONE) \
    X(DATA_DECODED) X(DATA_MAP_ALONE) X(METAL_ROUGH_RED) X(METAL_FROM_RED) X(METAL_FROM_GREEN) X(METAL_FROM_ALPHA) \
    X(ROUGH_FROM_RED) X(ROUGH_FROM_BLUE) X(ROUGH_FROM_ALPHA) X(NO_EMISSION) X(EMISSION_NOT_DECODED) \
    X(EMISSION_DECODED_TWICE) X(EMISSION_MAP_ALONE) X(OCCLUSION_OF_ALL) X(BUMPS_MISSING) \
    X(NORMAL_MAP_RAW) X(NORMAL_MAP_DECODED) X(NORMAL_MAP_AS_WORLD) X(BENT_NORMAL_LONG) X(FRAME_TRANSPOSED) \
    X(FRAME_INTERPOLATED) X(FRAME_DERIVED) X(FRAME_DERIVED_SIGNED) X(FRAME_COTANGENT) X(TANGENT_LONG) X(TANGENT_BY_NORMAL_MATRIX) \
    X(TANGENT_OBJECT) X(TANGENT_REVERSED) X(BITANGENT_REVERSED) X(BITANGENT_BY_MODEL) X(AXES_SWAPPED) X(SIGN_LOST)
// clang-format on

enum fault_bit {
    BIT_NONE, // terminates the list of a fault's switches
#define FAULT_BIT(name) BIT_##name,
    FAULT_BITS(FAULT_BIT)
#undef FAULT_BIT
        FAULT_BIT_COUNT
};
enum { FAULT_WORDS = 4 };
_Static_assert(FAULT_BIT_COUNT <= 64 * FAULT_WORDS, "fault_set has a bit for each switch");

// A set of switches, and the change of the highlight's exponent.
typedef struct fault_set {
    uint64_t words[FAULT_WORDS]; // bit i represents switch i
    float factor;                // multiplies the exponent; 0 if not used
    float constant;              // replaces the material's exponent; 0 if not used
} fault_set;

bool fault_set_has(const fault_set *set, enum fault_bit bit);
bool fault_set_equal(const fault_set *a, const fault_set *b);

// Bits for the conditions under which a fault can occur. 0 means always.
enum fault_where {
    WHERE_FRAGMENT = 1,      // lighting in the fragment shader
    WHERE_VERTEX = 2,        // lighting in the vertex shader
    WHERE_OBJECT_LIGHT = 4,  // lights in object space
    WHERE_EYE_LIGHT = 8,     // lights in the space in which lighting is computed (eye or world space)
    WHERE_PHONG = 16,        // a Phong highlight is expected
    WHERE_BLINN = 32,        // a Blinn–Phong highlight is expected
    WHERE_REFLECT = 64,      // reflect() occurs in the shaders
    WHERE_WORLD = 128,       // lighting in world space
    WHERE_WORLD_LIGHT = 256, // lights in world space, lighting in eye space
    WHERE_STRENGTHS = 1024,  // colours and their strengths are separate
    WHERE_FOUR = 512,        // vectors may have four components: a varying is a vec4, or the vertices are lit
    WHERE_CLASSIC = 2048,    // highlights with an exponent
    WHERE_PHYSICAL = 4096,   // metalness and roughness
    WHERE_SCHLICK = 8192,    // the contract uses Schlick's masking
    WHERE_SMITH = 16384,     // the contract uses Smith's masking
    WHERE_SHARED = 32768,    // the contract's diffuse part is reduced by the Fresnel factor
    WHERE_TONED = 65536,     // the contract's shaders have a tone curve
    WHERE_UNTONED = 131072,  // the contract's shaders have no tone curve
    WHERE_ENCODED = 262144,  // the contract's shaders encode their colours
    WHERE_LINEAR = 524288,   // the contract's shaders do not encode their colours
    WHERE_OF_MIX = 1048576,  // the contract computes the diffuse part's Fresnel factor from the mixed F0
    WHERE_NOT_OF_MIX = 2097152,
    WHERE_FLAT = 4194304, // `flat` occurs in the fragment shader
};

// Bits for the conditions on maps. 0 means no condition.
enum fault_maps {
    MAPS_BASE = 1,                // the shader reads a map of the base colour
    MAPS_METALLIC_ROUGHNESS = 2,  // a map of roughness and metalness
    MAPS_DATA = 4,                // one map of metalness and roughness, or a map of only one of them
    MAPS_NORMAL = 8,              // a normal map
    MAPS_OCCLUSION = 16,          // an occlusion map, which multiplies an ambient term
    MAPS_EMISSION = 32,           // an emission map
    MAPS_ENCODED = 64,            // colour maps are encoded
    MAPS_LINEAR = 128,            // colour maps are linear
    MAPS_BASE_FACTOR = 256,       // the base colour also has a factor
    MAPS_DATA_FACTOR = 512,       // metalness and roughness also have factors
    MAPS_EMISSION_FACTOR = 1024,  // the emission also has a factor
    MAPS_TANGENTS = 2048,         // tangents are an attribute
    MAPS_SIGN = 4096,             // the tangents include the sign of the bitangent
    MAPS_DERIVATIVES = 8192,      // dFdx occurs in the fragment shader
    MAPS_UP = 16384,              // v increases upwards if u increases to the right
    MAPS_DOWN = 32768,            // v increases downwards if u increases to the right
    MAPS_NO_BASE = 65536,         // the shader reads no map of the base colour
    MAPS_OCCLUSION_READ = 131072, // an occlusion map, with or without an ambient term
    MAPS_NO_OCCLUSION = 262144,   // no occlusion map
    MAPS_ABSENT = MAPS_NO_BASE | MAPS_NO_OCCLUSION,
};

// The unknown number that the search must find for a fault: the factor of the exponent, above or below 1, or the
// constant exponent.
enum fault_fit { FIT_NONE, FIT_LARGER, FIT_SMALLER, FIT_CONSTANT };

enum { MAX_FAULT_BITS = 8 };

struct fault {
    const char *id;
    uint8_t bits[MAX_FAULT_BITS]; // values of fault_bit; the list ends with BIT_NONE
    unsigned where;               // bits of fault_where
    unsigned needs; // a reference_need, or 0: the fault can occur only if a scene of the check uses this feature
    const char *explanation; // a clause for the report, expanded like the correction
    const char *correction;  // one line; {place} is replaced by the shader's own name (fault_text)
    unsigned maps;           // bits of fault_maps
    float factor;            // the factor of the exponent, or 0
    enum fault_fit fit;
    bool rare;       // a rare fault: the report omits this fault if a more common fault produces the same pictures
    bool style;      // not a mistake: a form that is as correct as the reference
    bool whole_term; // one or more terms are missing completely
    // bits of contract_demand: the fault is a mistake if the contract requires one of these forms, and a style if not
    unsigned demand;
};

extern const struct fault faults[];
extern const int fault_count;

// Returns the set after adding a fault of the table.
fault_set fault_set_add(const fault_set *set, const struct fault *fault);

// Returns whether the fault can occur in these shaders.
bool fault_applies(const struct fault *fault, const struct shader_interface *interface, lam_light_frame frame,
                   lam_reflection reflection, unsigned needs);

// Returns whether these shaders may use the fault's form without making a mistake. They may if the form is only a
// style, or if their contract requires none of the forms in `demand`.
bool fault_is_style(const struct fault *fault, const struct shader_interface *interface);

// Expands an explanation or a correction: replaces each {place} by the name that the shaders use.
void fault_text(const char *template, const struct shader_interface *interface, lam_light_frame frame,
                lam_reflection reflection, char *out, size_t capacity);

#endif
