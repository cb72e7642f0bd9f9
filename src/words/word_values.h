// word_values.h: the values of pairs key=value.
#ifndef WORD_VALUES_H
#define WORD_VALUES_H

#include <lambent/fields.h>
#include <lambent/scene.h>

// Bytes of a text with its end.
enum { WORDS_MAX = 1024 };

// Copies a text that will be split. Returns false if it is too long.
bool word_copy(const char *text, char copy[WORDS_MAX], lam_error *error);

// Returns the index of `name` in a list that ends with NULL; −1 with the nearest one, or all of them, in the error.
int word_key(const char *name, const char *const *names, lam_error *error);

// The same of the keys from 0 to `count` − 1, at most WORD_KEYS_MAX, without those whose name is NULL.
enum { WORD_KEYS_MAX = 256 };
int word_key_of(const char *name, int count, const char *(*name_of)(int key), lam_error *error);

// A finite decimal number, not "inf" or "nan". Returns the position after it, or NULL if there is no number.
const char *word_number(const char *text, double *number);

// Numbers with '/' between them, `min` to `max` of them. Where `radii` is not NULL, each may end in 'r', which sets
// radii[i].
bool word_numbers(const char *text, int min, int max, double *numbers, int *count, bool *radii);

// The numbers of a field, as lam_field_set takes them but angles in degrees, each within the field's range. Points and
// triples are read by functions of their own.
bool word_field(const lam_field *field, const char *value, lam_color_mode mode, double numbers[4], lam_error *error);

// Sets a field to numbers that word_field has read.
void word_set_field(const lam_field *field, void *object, const double numbers[4]);

// A number of the key `key` from `min` to `max`; from 1e29 on `max` is no bound.
bool word_number_of(const char *key, const char *value, double min, double max, double *number, lam_error *error);

#endif
