// key_values.h: what the values "key=value,key=value" of options are made of.
#ifndef KEY_VALUES_H
#define KEY_VALUES_H

#include <lambent/lambent.h>

// The number of `name` in a list that ends with NULL; −1 with the nearest one, or all of them, in the error.
int key_find(const char *name, const char *const *names, lam_error *error);

// Numbers with '/' between them, `least` to `most` of them. Where `radii` is not NULL, each may end in 'r'; then
// radii[i] tells.
bool read_numbers(const char *text, int least, int most, double *numbers, int *count, bool *radii);

// One number.
bool read_one(const char *text, double *number);

// A colour as lam_color_parse takes it, or one number for all three channels. `what` names it in the error. `opaque`:
// an alpha is refused.
bool read_color(const char *what, const char *text, lam_color_mode mode, bool opaque, lam_rgba *color,
                lam_error *error);

#endif
