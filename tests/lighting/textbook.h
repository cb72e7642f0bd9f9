// textbook.h: the lighting equations in double precision, written from docs/lighting.md with libm and on its own, to
// judge src/lighting by. One point, one light.
#ifndef TEXTBOOK_H
#define TEXTBOOK_H

#include "widths.h"

// One result for each enum output, plus what the comparison wants to know about the point's conditioning.
struct textbook {
    double out[OUTPUTS];
    double cone_cosine;  // between axis and the way to the point
    double half_length;  // |l + v|
    double tangent_sine; // of the angle between normal and tangent as given
};

struct textbook textbook_light(const struct modes *modes, const float in[INPUTS]);

// The environment's light on a metallic-roughness material (enum environment_output); sets *n_dot_v.
void textbook_environment(int viewer, const float in[INPUTS], double out[ENVIRONMENT_OUTPUTS], double *n_dot_v);

// The hash that test_widths recorded for a lam_reflection; 0: it has no row here.
uint64_t textbook_hash(int model);

#endif
