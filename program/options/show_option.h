// show_option.h: parses the value of --show.
#ifndef SHOW_OPTION_H
#define SHOW_OPTION_H

#include <lambent/device.h>

// Returns the output that a checked value names. NULL means the picture.
lam_output show_option_what(const char *text);

// Sets params->output and params->output_light from the value, using the rig of `params`. Fails with LAM_BAD_ARGUMENT
// if the scene has no such light; the error lists the scene's lights.
bool show_option_apply(const char *text, const lam_scene *scene, lam_draw_params *params, lam_error *error);

// Returns whether a picture file of this quantity stores one number for each pixel (lam_save_params.single): a depth or
// a label. `ending` is the format, such as "png". A PNG stores depths as numbers only with a scale.
bool show_option_is_single(const char *text, const char *ending, double depth_scale);

#endif
