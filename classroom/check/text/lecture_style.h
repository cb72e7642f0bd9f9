// lecture_style.h: parses the source of a shader printed by `lambent shader --style lecture` to find out which lighting
// the shader computes. The parser recognises the lines of src/gpu/glsl/lecture/lecture.glsl, even if they contain a known
// mistake.
#ifndef LECTURE_STYLE_H
#define LECTURE_STYLE_H

#include <lambent/material.h>

#include "declarations.h"

// Returns the restrictions on the kinds of lights (reference_rule), or 0 if the shader is not in the lecture style.
unsigned lecture_light_rules(const struct declarations *lit);

// Returns the reflection model of a shader in the lecture style; AUTO means the Lambert model.
lam_reflection lecture_model(const struct declarations *lit);

// Returns whether a shader in the lecture style uses an infinitely distant viewer: the vector to the eye is then a
// constant.
bool lecture_viewer_is_infinite(const struct declarations *lit);

#endif
