// lecture.h: makes shaders in the lecture style. The code of these shaders is simple, with at most about forty lines
// per stage, and uses names that are common in lectures (N, L, V, R, H, T, ka, kd, ks). Uniforms and pictures are the
// same as in the full style. The application stage is a C function. mistake_apply inserts known mistakes into these
// shaders.
#ifndef LECTURE_H
#define LECTURE_H

#include "glsl_constants.h"

// The style, for glsl_choices.style.
extern const struct glsl_style lecture_style;

// Returns whether the style supports these choices. Otherwise the error is LAM_UNSUPPORTED, and its message names the
// unsupported option.
bool lecture_check(const struct glsl_choices *choices, const struct glsl_stage *facts, lam_error *error);

// Makes the C source of the application stage: a function `light_vertex` that computes a vertex's colours for one of
// the draws in `ranges`. The shader's light i is light order[i] of the frame. The function contains the mistake
// choices->mistake. The caller frees the result. Returns NULL on failure. Errors: LAM_UNSUPPORTED (naming the option
// that the style does not support), LAM_LIMIT, and the errors of mistake_apply.
char *lecture_application(const struct glsl_choices *choices, const struct frame *frame, const int *order,
                          const struct frame_draw_range *const *ranges, int count, lam_error *error);

// --- parts of the source that GLSL and C share (lecture.c)

// Adds the flags that both sources use: the flags of every shader (constant_stage), and the conditions on lines of the
// lecture style.
void lecture_add_flags(struct constant_table *table, const struct glsl_stage *facts);
// Appends the vector from the point to light i: `against` for directional lights, `towards` for the others.
void lecture_add_way(struct text *text, const struct glsl_choices *choices, const char *against, const char *towards);
// Appends the lines that set `spot`, the factor of a spotlight's cone. `number` is the type of `spot`.
void lecture_add_spots(struct text *text, const struct glsl_choices *choices, const char *number);

// --- mistakes

// Introduces the mistake choices->mistake into one of the sources `texts`. On success, all sources are freed and
// replaced by copies. Fails with LAM_UNSUPPORTED if the mistake requires a feature that the sources lack, or with
// LAM_LIMIT.
bool mistake_apply(const struct glsl_choices *choices, char **texts, int count, lam_error *error);

// Returns the value of glsl_choices.mistake for an id or for two ("no-gate+no-ambient"), or 0 if there is no such mistake.
int mistake_find(const char *id);

#endif
