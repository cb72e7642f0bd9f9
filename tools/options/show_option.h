// show_option.h: the value of --show, and its light.
#ifndef SHOW_OPTION_H
#define SHOW_OPTION_H

#include <lambent/lambent.h>

// The output named by the option's text, which the parser has checked; NULL: the picture.
lam_output show_option_what(const char *text);

// Sets params->output and params->output_light from the text, with the rig of `params`. LAM_BAD_ARGUMENT if the scene
// has no such light; the error lists the lights of the scene.
bool show_option_apply(const char *text, const lam_scene *scene, lam_draw_params *params, lam_error *error);

#endif
