// show_option.h: the value of --show, and the light that it names.
#ifndef SHOW_OPTION_H
#define SHOW_OPTION_H

#include <lambent/lambent.h>

// What the option's text asks for, which was checked when the option was read; NULL: the picture.
lam_output show_option_what(const char *text);

// Fills params->output and params->output_light from the text; the rig is taken from `params`. LAM_BAD_ARGUMENT where the
// scene has no such light: the sentence names those that there are.
bool show_option_apply(const char *text, const lam_scene *scene, lam_draw_params *params, lam_error *error);

#endif
