// glsl_combinations.h: enumerates the choices for the shader tests.
#ifndef GLSL_COMBINATIONS_H
#define GLSL_COMBINATIONS_H

#include "glsl.h"

// Calls `visit` for every valid combination of version, storage, stage, shading, reflection model, form of the uniforms and
// number of sides, with lights of every kind; then varies each of the other choices alone. Returns the number of calls.
int glsl_combinations(void (*visit)(void *user, const struct glsl_choices *choices), void *user);

#endif
