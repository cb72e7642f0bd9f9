// glsl_combinations.h: the choices that the shader tests go through.
#ifndef GLSL_COMBINATIONS_H
#define GLSL_COMBINATIONS_H

#include "glsl.h"

// Calls `visit` for every version, storage, stage, shading, model, form of the uniforms and sidedness that go
// together, with lights of every kind; then for what is independent of those, one by one. Returns the number
// of calls.
int glsl_combinations(void (*visit)(void *user, const struct glsl_choices *choices), void *user);

#endif
