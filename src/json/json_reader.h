// json_reader.h: values of a JSON file, checked on access: each error names the file, the position in it, the value
// found and the expected one. Scene files and contracts of shaders are read with it.
#ifndef JSON_READER_H
#define JSON_READER_H

#include "shown_name.h"

#include <lambent/base.h>

#include <jansson.h>
#include <stdarg.h>

struct json_reader {
    const char *file; // its name, for messages
    lam_error
        *error; // LAM_CANNOT_READ with "FILE: PLACE: sentence", or "FILE:LINE: PLACE: sentence" if there is a text
    const char *text; // the file's, of `size` bytes; NULL: errors name no line
    size_t size;
};

// A value's place in the file: objects[1].material.shininess, from its end to its beginning.
struct place {
    const struct place *within; // NULL: the file itself
    const char *key;            // NULL: an element of a list
    size_t index;
};
#define KEY_OF(parent, name)       (&(struct place){.within = (parent), .key = (name)})
#define ELEMENT_OF(parent, number) (&(struct place){.within = (parent), .index = (number)})

// Writes "objects[1].material.shininess"; a longer place is cut.
void json_place(const struct place *place, char *out, size_t capacity);

// Returns the line of a value, or of its key, from 1; of the innermost value around it that there is. 0: none of them,
// or `place` is NULL.
int json_line_of(const char *text, size_t size, const struct place *place);

// Returns false.
bool json_fail(const struct json_reader *r, const struct place *place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
bool json_vfail(const struct json_reader *r, const struct place *place, const char *format, va_list arguments);
// "found KIND, expected …". Returns false.
bool json_unexpected(const struct json_reader *r, const struct place *place, const json_t *found, const char *expected);

// "a number", "a text", "a list of 3", …, as found; for sentences.
enum { JSON_KIND_SIZE = SHOWN_NAME_SIZE + 2 };
const char *json_kind(const json_t *value, char out[JSON_KIND_SIZE]);

// Allowed keys of an object; another one is an error that names the nearest. The list ends with NULL.
bool json_check_keys(const struct json_reader *r, const struct place *place, const json_t *object,
                     const char *const *keys);

// A value itself, checked. Numbers lie in [min, max]; a list has from `min` to `max` of them. *count may be NULL.
bool json_number_of(const struct json_reader *r, const struct place *place, const json_t *value, double min, double max,
                    double *out);
bool json_numbers_of(const struct json_reader *r, const struct place *place, const json_t *list, size_t min, size_t max,
                     double *out, size_t *count);

// The value of a key of `object`, checked; *out stays as it is where the key is missing. Returns false if it is wrong.
bool json_take_number(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                      double min, double max, double *out);
bool json_take_bool(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    bool *out);
// A text that is not empty; it belongs to `object`.
bool json_take_text(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    const char **out);

struct json_choice {
    const char *name;
    int value;
};
// One of some words, at most 16; the list ends with a NULL name.
bool json_choice_of(const struct json_reader *r, const struct place *place, const json_t *value,
                    const struct json_choice *words, int *out);
bool json_take_word(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    const struct json_choice *words, int *out);

#endif
