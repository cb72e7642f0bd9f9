// glsl_known.h: conditions of the equations that a shader's choices decide.
#ifndef GLSL_KNOWN_H
#define GLSL_KNOWN_H

#include "glsl_rows.h"
#include "specialize.h"

enum { KNOWN_MAX = 18 };

// Fills the first rows of a table; the others, and the last one, must be NULL (struct known_condition).
void glsl_known_conditions(struct known_condition out[KNOWN_MAX], const struct glsl_facts *f);

#endif
