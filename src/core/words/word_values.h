// word_values.h: parses the values of key=value pairs.
#ifndef WORD_VALUES_H
#define WORD_VALUES_H

#include <lambent/fields.h>
#include <lambent/scene.h>

// The maximum size of a text in bytes, including the terminating zero.
enum { WORDS_MAX = 1024 };

// Copies a text that the caller will split in place. Returns false if the text is too long.
bool word_copy(const char *text, char copy[WORDS_MAX], lam_error *error);

// Returns the index of `name` in a list that ends with NULL. Returns −1 if the name is not in the list; the error then
// suggests the nearest name, or lists all names.
int word_key(const char *name, const char *const *names, lam_error *error);

// Like word_key, for the keys from 0 to `count` − 1; `count` must be at most WORD_KEYS_MAX. Keys without a name are
// skipped.
enum { WORD_KEYS_MAX = 256 };
int word_key_of(const char *name, int count, const char *(*name_of)(int key), lam_error *error);

// Parses `min` to `max` numbers with '/' between them. If `radii` is not NULL, each number may end in 'r', which sets
// radii[i].
bool word_numbers(const char *text, int min, int max, double *numbers, int *count, bool *radii);

// Parses the numbers of a field and checks the field's range. The numbers have the form that lam_field_set needs,
// except that angles are in degrees. Points and triples have separate functions.
bool word_field(const lam_field *field, const char *value, lam_color_mode mode, double numbers[4], lam_error *error);

// Sets a field to numbers from word_field.
void word_set_field(const lam_field *field, void *object, const double numbers[4]);

// Parses the value of the key `key` as a number from `min` to `max`. A `max` of 1e29 or more means that there is no
// upper limit.
bool word_number_of(const char *key, const char *value, double min, double max, double *number, lam_error *error);

#endif
