// outputs.h: the table of outputs (lam_output). A row states all that the drawing needs to know of an output; only the
// computation of its value stands elsewhere (output_values.inc and lighting.glsl, or shade.c and fragment.glsl).
#ifndef OUTPUTS_H
#define OUTPUTS_H

#include <lambent/device.h>

#include <stdint.h>

enum output_kind {
    OUTPUT_LIGHT,    // the picture, or a part of its light
    OUTPUT_CLIPPED,  // made from the complete picture
    OUTPUT_VECTOR,   // a vector or cosine: evaluated where light is, and interpolated according to the shading method
    OUTPUT_MATERIAL, // a property of the material at a point, without light, for every shading method
    OUTPUT_GEOMETRY, // a property of the surface at each fragment, for every shading method
    OUTPUT_COUNT,    // a number of samples or of triangles of a pixel
};

// The 8-bit code of an output that is not light.
enum output_code {
    CODE_PLAIN,
    CODE_SIGNED,
    CODE_COLOR,
    CODE_DEPTH,
    CODE_SIDES,
    CODE_IDS,
    CODE_LABEL,
    CODE_LEVEL,
    CODE_OVERDRAW
};

// The terms of the reflected light.
enum { TERM_EMISSION = 1, TERM_AMBIENT = 2, TERM_DIFFUSE = 4, TERM_SPECULAR = 8, TERM_REFLECTION = 16, TERMS_ALL = 31 };

struct output_row {
    const char *name, *summary;
    enum output_kind kind;
    enum output_code code;
    uint8_t terms;  // TERM_…: their sum is shown
    bool one_light; // shows a single light; the frame then contains only that light
    bool lit;       // surfaces without lighting are black
    // The output that devices draw instead; encode_values converts its values. LAM_OUTPUT_PICTURE: this one.
    lam_output drawn;
    const char *flag; // the condition in the text of shaders, if they ask for just this output
};

extern const struct output_row output_rows[LAM_OUTPUT_COUNT];

static inline enum output_kind output_kind(lam_output output) { return output_rows[output].kind; }

// Returns whether each pixel of an output shows a property of the nearest surface, regardless of the surface's opacity.
// Masked surfaces keep their holes.
static inline bool output_is_value(lam_output output) { return output_kind(output) > OUTPUT_CLIPPED; }

// Returns whether an output is made from the complete picture.
static inline bool output_is_picture(lam_output output)
{
    return output == LAM_OUTPUT_PICTURE || output == LAM_OUTPUT_CLIPPED;
}

#endif
