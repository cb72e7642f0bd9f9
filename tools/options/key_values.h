// key_values.h: the parts of option values such as "key=value,key=value".
#ifndef KEY_VALUES_H
#define KEY_VALUES_H

#include <lambent/lambent.h>

// The index of `name` in a list that ends with NULL; −1 with the nearest one, or all of them, in the error.
int key_find(const char *name, const char *const *names, lam_error *error);

// Numbers with '/' between them, `min` to `max` of them. Where `radii` is not NULL, each may end in 'r', which
// sets radii[i].
bool read_numbers(const char *text, int min, int max, double *numbers, int *count, bool *radii);

// One number.
bool read_one(const char *text, double *number);

// The numbers of a field, as lam_field_set takes them but angles in degrees, each within the field's range. Points and
// triples are read by their own functions.
bool read_field(const lam_field *field, const char *value, lam_color_mode mode, double numbers[4], lam_error *error);

// Sets a field to numbers that read_field has read.
void set_field(const lam_field *field, void *object, const double numbers[4]);

// A number of the key `key` from `min` to `max`; from 1e29 on `max` is no bound.
bool read_number_of(const char *key, const char *value, double min, double max, double *number, lam_error *error);

// A colour as lam_color_parse takes it, or one number for all three channels. `what` names it in the error. `opaque`:
// an alpha is refused.
bool read_color(const char *what, const char *text, lam_color_mode mode, bool opaque, lam_rgba *color,
                lam_error *error);

#endif
