// settings_check.h: checks the draw parameters against the ranges in the table of settings, and applies the defaults.
#ifndef SETTINGS_CHECK_H
#define SETTINGS_CHECK_H

#include <lambent/settings.h>

// Checks every member that has a row in the table. Fails with LAM_BAD_ARGUMENT.
bool settings_check(const lam_draw_params *params, lam_error *error);

// Copies the parameters. WHOLE and NUMBER settings that are 0 get their default, and a number below 0 becomes 0.
void settings_resolve(const lam_draw_params *params, lam_draw_params *out);

// Returns the value or the default of a NUMBER or ANGLE (radians) as a double, which avoids rounding to float. `key`
// names its row.
double setting_number(const lam_draw_params *params, const char *key);

// Checks that colour channels are finite and at least 0; the fourth is an alpha and at most 1. `name` begins the error.
bool channels_check(const char *name, const float *channels, int count, lam_error *error);

#endif
