// settings_check.h: checks the draw parameters against the ranges in the table of settings, and applies the defaults.
#ifndef SETTINGS_CHECK_H
#define SETTINGS_CHECK_H

#include <lambent/settings.h>

// Checks every member that has a row in the table. Fails with LAM_BAD_ARGUMENT.
bool settings_check(const lam_draw_params *params, lam_error *error);

// Copies the parameters. Replaces a WHOLE or NUMBER setting of 0 with the default, and a negative NUMBER with 0.
void settings_resolve(const lam_draw_params *params, lam_draw_params *out);

// Returns the value or the default of a NUMBER or ANGLE (radians) as a double, which avoids rounding to float. `key`
// selects the row of the table.
double setting_number(const lam_draw_params *params, const char *key);

// Checks that colour channels are finite and at least 0. The fourth channel is an alpha, which must be at most 1. The
// error message begins with `name`.
bool channels_check(const char *name, const float *channels, int count, lam_error *error);

#endif
