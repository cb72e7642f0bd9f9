// json_reader.h: gets values from a JSON file and checks each value on access. Each error names the file, the position
// in the file, the value found and the value expected. The readers of scene files and shader contracts use these
// functions.
#ifndef JSON_READER_H
#define JSON_READER_H

#include "shown_name.h"

#include <lambent/base.h>

#include <jansson.h>
#include <stdarg.h>

struct json_reader {
    // The file's name for messages. NULL: the values are the words of an option (src/core/description/words.c).
    const char *file;
    // Receives LAM_CANNOT_READ with "FILE: PLACE: sentence", or with "FILE:LINE: PLACE: sentence" if `text` is set. For
    // words, receives LAM_BAD_ARGUMENT with "KEY: sentence".
    lam_error *error;
    const char *text; // the file's text, of `size` bytes; if NULL, errors name no line
    size_t size;
};

// A value's position in the file, such as objects[1].material.shininess, stored from the innermost member outwards.
struct place {
    const struct place *within; // NULL means the file itself
    const char *key;            // NULL means an element of a list
    size_t index;
};
#define KEY_OF(parent, name)       (&(struct place){.within = (parent), .key = (name)})
#define ELEMENT_OF(parent, number) (&(struct place){.within = (parent), .index = (number)})

// Returns the line (counted from 1) of a member's key or of a list's element. If the value does not exist, returns the
// line of the innermost enclosing value that exists. Returns 0 if no value exists, or if `place` is NULL.
int json_line_of(const char *text, size_t size, const struct place *place);

// Reports an error. Returns false.
bool json_fail(const struct json_reader *r, const struct place *place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
bool json_vfail(const struct json_reader *r, const struct place *place, const char *format, va_list arguments);
// Reports "found KIND, expected …", or for words "found 'KEY=VALUE', expected …". Returns false.
bool json_unexpected(const struct json_reader *r, const struct place *place, const json_t *found, const char *expected);

// Describes a value for error messages: a number or a string (in quotes) by its value, others as "a list of 3", "an
// object", "true", "false" or "null".
enum { JSON_KIND_SIZE = SHOWN_NAME_SIZE + 2 };
const char *json_kind(const json_t *value, char out[JSON_KIND_SIZE]);

// Checks the keys of an object. An unknown key is an error; the message suggests the nearest allowed key. The list
// `keys` ends with NULL.
bool json_check_keys(const struct json_reader *r, const struct place *place, const json_t *object,
                     const char *const *keys);

// These functions check a value and store it. A number must be in [min, max]; a list must contain `min` to `max`
// numbers. `count` may be NULL.
bool json_number_of(const struct json_reader *r, const struct place *place, const json_t *value, double min, double max,
                    double *out);
bool json_numbers_of(const struct json_reader *r, const struct place *place, const json_t *list, size_t min, size_t max,
                     double *out, size_t *count);

// These functions check the value of a key of `object` and store the value. If the key is missing, *out is unchanged.
// The functions return false if the value is wrong.
bool json_take_number(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                      double min, double max, double *out);
bool json_take_bool(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    bool *out);
// Gets a string, which must not be empty. The string belongs to `object`.
bool json_take_text(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    const char **out);

struct json_choice {
    const char *name;
    int value;
};
// Checks that a value is one of at most 16 names. The list `words` ends with a NULL name.
bool json_choice_of(const struct json_reader *r, const struct place *place, const json_t *value,
                    const struct json_choice *words, int *out);
bool json_take_word(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    const struct json_choice *words, int *out);

#endif
