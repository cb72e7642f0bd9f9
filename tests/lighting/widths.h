// widths.h: the numeric functions and the equations, compiled once for each width, with one table each.
#ifndef WIDTHS_H
#define WIDTHS_H

#include <stdint.h>

// Functions of one or two numbers.
enum function {
    FUNCTION_EXP2,
    FUNCTION_LOG2,
    FUNCTION_POWER,
    FUNCTION_UNIT_POWER,
    FUNCTION_INVERSE_ROOT,
    FUNCTION_ROOT,
    FUNCTION_SRGB_ENCODE,
    FUNCTION_SRGB_DECODE,
    FUNCTION_BYTE,
    FUNCTION_SATURATE,
    FUNCTION_LESSER,
    FUNCTION_GREATER,
    FUNCTION_COUNT
};

// One lit point: the inputs, and every output term. Vectors take three elements.
enum input {
    IN_POINT,
    IN_NORMAL = 3, // any length
    IN_TANGENT = 6,
    IN_POSITION = 9,
    IN_DIRECTION = 12,
    IN_DIFFUSE = 15, // product kd ⊙ Ld
    IN_SPECULAR = 18,
    IN_CONSTANT = 21,
    IN_LINEAR,
    IN_QUADRATIC,
    IN_INVERSE_RANGE,
    IN_COS_CUTOFF,
    IN_EXPONENT,
    IN_COS_OUTER,
    IN_INVERSE_WIDTH,
    IN_UP,
    IN_SKY = IN_UP + 3,
    IN_GROUND = IN_SKY + 3,
    IN_AMBIENT = IN_GROUND + 3, // product ka ⊙ La
    IN_EMISSION = IN_AMBIENT + 3,
    IN_TINT = IN_EMISSION + 3,
    IN_MIRROR = IN_TINT + 3, // kr
    IN_ENVIRONMENT = IN_MIRROR + 3,
    IN_PARAMETERS = IN_ENVIRONMENT + 3, // parameters of the lobe, in the order of LOBE_PARAMETERS
    IN_SHININESS = IN_PARAMETERS,
    INPUTS = IN_PARAMETERS + 8
};

enum output {
    OUT_L,
    OUT_DISTANCE = 3,
    OUT_ATTENUATION,
    OUT_SPOT,
    OUT_D,
    OUT_S,
    OUT_N_DOT_L,
    OUT_BASE,
    OUT_AMBIENT,
    OUT_DIFFUSE = OUT_AMBIENT + 3,
    OUT_SPECULAR = OUT_DIFFUSE + 3,
    OUT_REFLECTION = OUT_SPECULAR + 3,
    OUT_SUM = OUT_REFLECTION + 3,
    OUTPUTS = OUT_SUM + 3
};

// The environment's light on a metallic-roughness material: IN_TINT is the base colour, IN_SKY the irradiance ÷ π,
// IN_GROUND the prefiltered light, and a light at IN_POSITION gives the Fresnel factor.
enum environment_output {
    OUT_FRESNEL,         // with the light between microfacets
    OUT_SPLIT_SUM = 3,   // likewise
    OUT_SPLIT_ALONE = 6, // without
    ENVIRONMENT_OUTPUTS = 9
};

struct modes {
    int kind, falloff, model, fibre, viewer;
};

// Counts are multiples of 16. If an array contains one number for each point, in[i] and out[i] are such arrays.
struct width {
    const char *name;
    int features; // features in cpu_features.h that it needs
    void (*apply)(enum function function, const float *a, const float *b, float *out, int count);
    void (*light)(const struct modes *modes, const float *const in[INPUTS], float *const out[OUTPUTS], int count);
    void (*environment)(int viewer, const float *const in[INPUTS], float *const out[ENVIRONMENT_OUTPUTS], int count);
    // Copies three neighbours from each of `count` positions, `stride` numbers apart, into three arrays.
    void (*gather)(const float *from, const uint32_t *at, int stride, float *const out[3], int count);
};

// The widths compiled into this program that this processor can run. The first has one lane, plain C.
int widths_usable(const struct width *usable[], int room);

#endif
