// settings_check.h: the ranges of the draw parameters, by the table of settings.
#ifndef SETTINGS_CHECK_H
#define SETTINGS_CHECK_H

#include <lambent/settings.h>

// Checks every member that has a row in the table. False: LAM_BAD_ARGUMENT.
bool settings_check(const lam_draw_params *params, lam_error *error);

// Checks that colour channels are finite and at least 0; the fourth is an alpha, at most 1. `name` begins the error.
bool channels_check(const char *name, const float *channels, int count, lam_error *error);

#endif
