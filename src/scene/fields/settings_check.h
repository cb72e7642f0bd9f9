// settings_check.h: the ranges and defaults of the draw parameters, by the table of settings.
#ifndef SETTINGS_CHECK_H
#define SETTINGS_CHECK_H

#include <lambent/settings.h>

// Checks every member that has a row in the table. Fails with LAM_BAD_ARGUMENT.
bool settings_check(const lam_draw_params *params, lam_error *error);

// Copies the parameters. WHOLE and NUMBER settings that are 0 get their default, and a number below 0 becomes 0.
void settings_resolve(const lam_draw_params *params, lam_draw_params *out);

// Returns a NUMBER or ANGLE (radians) with its default in double, which a float would round. `key`: of a row.
double setting_number(const lam_draw_params *params, const char *key);

// Checks that colour channels are finite and at least 0; the fourth is an alpha, at most 1. `name` begins the error.
bool channels_check(const char *name, const float *channels, int count, lam_error *error);

#endif
