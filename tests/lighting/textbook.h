// textbook.h: the lighting equations in double precision, implemented from docs/lighting.md independently with libm, as
// a reference for src/core/lighting. It computes one point and one light.
#ifndef TEXTBOOK_H
#define TEXTBOOK_H

#include "widths.h"

// One result for each enum output, and the point's conditioning for the comparison.
struct textbook {
    double out[OUTPUTS];
    double cone_cosine;  // between the axis and the direction to the point
    double half_length;  // |l + v|
    double tangent_sine; // of the angle between the given normal and tangent
    double step;         // of toon shading: distance to the nearest edge of a step or of the highlight
};

struct textbook textbook_light(const struct modes *modes, const float in[INPUTS]);

// The environment's light on a metallic-roughness material (enum environment_output); sets *n_dot_v.
void textbook_environment(int viewer, const float in[INPUTS], double out[ENVIRONMENT_OUTPUTS], double *n_dot_v);

// The hash that test_widths recorded for a lam_reflection; 0 if it has no row here.
uint64_t textbook_hash(int model);

#endif
