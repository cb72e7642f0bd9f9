// lecture.h: shaders in the lecture style: about thirty plain lines for each stage, with the names of the blackboard (N, L, V, R,
// H, ka, kd, ks), the same uniforms as the full style and the same picture; and the known mistakes, which are edits of them.
#ifndef LECTURE_H
#define LECTURE_H

#include "glsl_rows.h"

// Whether the style covers these choices. False: LAM_UNSUPPORTED, with the option that it does not cover.
bool lecture_check(const struct glsl_choices *choices, const struct glsl_facts *facts, lam_error *error);

// Appends a stage after its version and its uniforms.
void lecture_add(struct text *text, const struct glsl_facts *facts, bool fragment);

// Introduces the mistake choices->mistake into both texts. False: LAM_UNSUPPORTED, if the shader lacks what the mistake needs;
// LAM_LIMIT.
bool mistake_apply(const struct glsl_choices *choices, struct glsl_text *text, lam_error *error);

// The value of glsl_choices.mistake for an id. 0: there is no such mistake.
int mistake_find(const char *id);

#endif
