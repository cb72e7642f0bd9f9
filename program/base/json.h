// json.h: writes JSON values one after the other, on one line.
//
// Writes numbers with the fewest digits that parse to the same double, in any locale. A camera copied from a report
// therefore reproduces the picture. (Jansson prints a fixed number of digits: 17 digits print 0.1 as
// 0.10000000000000001, and fewer digits can change the number.)
#ifndef JSON_H
#define JSON_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include <lambent/base.h>

struct json {
    FILE *file;
    bool comma; // a comma is needed before the next value
};

// `key` is NULL for the elements of an array and for the outermost value.
void json_open(struct json *json, const char *key, char bracket); // '{' or '['
void json_close(struct json *json, char bracket);                 // '}' or ']'
void json_text(struct json *json, const char *key,
               const char *text); // writes null for NULL, U+FFFD for invalid UTF-8
// Writes a message of the library, with field names replaced by options (option_names.h). NULL becomes null.
void json_message(struct json *json, const char *key, const char *text);
void json_number(struct json *json, const char *key, double value); // writes null if `value` is not finite
void json_count(struct json *json, const char *key, uint64_t value);
void json_none(struct json *json, const char *key);
void json_flag(struct json *json, const char *key, bool value);

// Write arrays of numbers.
void json_numbers(struct json *json, const char *key, const double *values, int count);
void json_vector(struct json *json, const char *key, lam_vec3 v);

// Formats a float with the fewest digits that parse to the same float.
void shortest_float(float value, char text[32]);

// Formats a double with the fewest digits that parse to the same double: at most 24 bytes, including the closing zero.
void shortest_number(double value, char text[32]);

#endif
