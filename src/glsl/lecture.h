// lecture.h: shaders in the lecture style: plain lines, at most about forty for a stage, with the names of the blackboard (N, L,
// V, R, H, T, ka, kd, ks), the same uniforms as the full style and the same picture; the application stage as a C function; and
// the known mistakes, which are edits of them.
#ifndef LECTURE_H
#define LECTURE_H

#include "glsl_rows.h"

// Whether the style covers these choices. False: LAM_UNSUPPORTED, with the option that it does not cover.
bool lecture_check(const struct glsl_choices *choices, const struct glsl_facts *facts, lam_error *error);

// Appends a stage after its version and its uniforms.
void lecture_add(struct text *text, const struct glsl_facts *facts, bool fragment);

// Makes the C source of the application stage: a function `light_vertex` that computes the colours of a vertex of one of the
// draws `ranges`. order[i] is the index in the frame of the shader's light i; choices->mistake is in it. The caller frees the
// result. NULL: LAM_UNSUPPORTED, with the option that the style does not cover, or as mistake_apply; LAM_LIMIT.
char *lecture_application(const struct glsl_choices *choices, const struct frame *frame, const int *order,
                          const struct frame_draw_range *const *ranges, int count, lam_error *error);

// --- parts of the text that GLSL and C share (lecture.c)

bool lecture_has_kind(const struct glsl_choices *choices, int kind); // LIGHT_…
bool lecture_has_range(const struct glsl_choices *choices);
// The conditions of both texts that follow from the choices `c` and the facts `f`: rows of preprocess_flag.
// clang-format off
#define LECTURE_FLAGS(c, f) \
    {"two_sided", (c)->two_sided}, \
    {"highlights", (f)->highlights}, \
    {"distant_viewer", (c)->distant_viewer}, \
    {"has_hemispheres", (f)->hemispheres}, \
    {"has_lights", (f)->lights}, \
    {"has_falloff", (f)->attenuated}, \
    {"has_range", lecture_has_range(c)}, \
    {"has_cone", (f)->cones}, \
    {"has_cutoff", lecture_has_kind(c, LIGHT_SPOT_CUTOFF)}, \
    {"threads", (f)->tangent}, \
    {"passes_tangent", (f)->tangent && (c)->tangents}, \
    {"gated_threads", (c)->reflection == LAM_REFLECTION_KAJIYA_KAY}, \
    {"phong", (f)->highlights && (c)->reflection == LAM_REFLECTION_PHONG}, \
    {"blinn_phong", (f)->highlights && (c)->reflection == LAM_REFLECTION_BLINN_PHONG}
// clang-format on
// Appends the vector from the point to light i: `against` of directional lights, `towards` of the others.
void lecture_add_way(struct text *text, const struct glsl_choices *choices, const char *against, const char *towards);
// Appends the lines that set `spot`, the factor of a spotlight's cone, of the type `number`.
void lecture_add_spots(struct text *text, const struct glsl_choices *choices, const char *number);

// --- mistakes

// Introduces the mistake choices->mistake into one of the texts, which are freed and replaced. False: LAM_UNSUPPORTED, if they
// lack what the mistake needs; LAM_LIMIT.
bool mistake_apply(const struct glsl_choices *choices, char **texts, int count, lam_error *error);

// The value of glsl_choices.mistake for an id. 0: there is no such mistake.
int mistake_find(const char *id);

#endif
