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

#include <lambent/scene.h>

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
void json_warnings(struct json *json, const lam_scene *scene);      // the key "warnings"; `scene` may be NULL
void json_number(struct json *json, const char *key, double value); // writes null if `value` is not finite
void json_numbers(struct json *json, const char *key, const double *values, int count);

// --- results as trees

// A value of a result. A function describes a part of a result as a tree of values, and json_put writes the tree.
// Values refer to the memory of the block that contains their macro.
struct result_value {
    const char *key; // NULL for the elements of a list
    enum result_kind {
        RESULT_END, // ends a list of values
        RESULT_NONE,
        RESULT_TEXT,
        RESULT_COUNT,
        RESULT_FLAG,
        RESULT_NUMBER,
        RESULT_NUMBERS, // a list of `count` numbers
        RESULT_OBJECT,
        RESULT_LIST,
    } kind;
    int count;
    union {
        const char *text;
        uint64_t whole; // a count or a flag
        double numbers[4];
        const struct result_value *values; // of an object or a list
    };
};

// NULL, a number that is not finite, and a negative index become null.
#define TEXT(name, t)  {.key = (name), .kind = RESULT_TEXT, .text = (t)}
#define COUNT(name, n) {.key = (name), .kind = RESULT_COUNT, .whole = (uint64_t)(n)}
#define INDEX(name, i) {.key = (name), .kind = (i) < 0 ? RESULT_NONE : RESULT_COUNT, .whole = (uint64_t)(i)}
#define FLAG(name, f)  {.key = (name), .kind = RESULT_FLAG, .whole = (f)}
#define NUMBER(name, x)                                                                                                \
    {                                                                                                                  \
        .key = (name), .kind = RESULT_NUMBER, .numbers = {(double)(x) }                                                \
    }
#define NUMBERS(name, n, ...)                                                                                          \
    {                                                                                                                  \
        .key = (name), .kind = RESULT_NUMBERS, .count = (n), .numbers = { __VA_ARGS__ }                                \
    }
#define VECTOR(name, v) NUMBERS(name, 3, (v).x, (v).y, (v).z)
#define COLOR(name, c)  NUMBERS(name, 3, (double)(c).r, (double)(c).g, (double)(c).b)
#define COLOR4(name, c) NUMBERS(name, 4, (double)(c).r, (double)(c).g, (double)(c).b, (double)(c).a)
// a time, rounded to microseconds
#define MILLISECONDS(name, ms) NUMBER(name, (double)(int64_t)((ms) * 1e3 + 0.5) / 1e3)
#define NONE(name)             {.key = (name), .kind = RESULT_NONE}
#define VALUES(...)            ((const struct result_value[]){__VA_ARGS__, {.kind = RESULT_END}})
#define OBJECT(name, ...)      {.key = (name), .kind = RESULT_OBJECT, .values = VALUES(__VA_ARGS__)}
#define LIST(name, ...)        {.key = (name), .kind = RESULT_LIST, .values = VALUES(__VA_ARGS__)}

void json_values(struct json *json, const struct result_value *values);
#define json_put(json, ...) json_values(json, VALUES(__VA_ARGS__))

// Formats a float with the fewest digits that parse to the same float.
void shortest_float(float value, char text[32]);

// Formats a double with the fewest digits that parse to the same double: at most 24 bytes, including the closing zero.
void shortest_number(double value, char text[32]);

#endif
