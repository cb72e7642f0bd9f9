// word_values.c: parses the values of key=value pairs.
#include "word_values.h"

#include <stdio.h>
#include <string.h>

#include "fail.h"
#include "linear.h"
#include "number.h"
#include "spelling.h"

int word_key(const char *name, const char *const *names, lam_error *error)
{
    char known[300] = "";
    int count = 0;
    for (; names[count]; count++) {
        if (strcmp(names[count], name) == 0)
            return count;
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s",
                 count == 0         ? ""
                 : names[count + 1] ? ", "
                                    : " or ",
                 names[count]);
    }
    const char *nearest = meant_word(name, names, count);
    if (nearest)
        fail(error, LAM_BAD_ARGUMENT, "unknown key '%.60s'; did you mean '%s'?", name, nearest);
    else
        fail(error, LAM_BAD_ARGUMENT, "unknown key '%.60s'; expected %s", name, known);
    return -1;
}

int word_key_of(const char *name, int count, const char *(*name_of)(int key), lam_error *error)
{
    const char *names[WORD_KEYS_MAX + 1];
    int keys[WORD_KEYS_MAX] = {0}, named = 0;
    for (int key = 0; key < count; key++)
        if (name_of(key)) {
            names[named] = name_of(key);
            keys[named++] = key;
        }
    names[named] = NULL;
    int found = word_key(name, names, error);
    return found < 0 ? -1 : keys[found];
}

bool word_copy(const char *text, char copy[WORDS_MAX], lam_error *error)
{
    if (strlen(text) >= WORDS_MAX)
        return fail(error, LAM_BAD_ARGUMENT, "it is %zu letters long, expected less than %d", strlen(text), WORDS_MAX);
    strcpy(copy, text);
    return true;
}

// Parses a finite decimal number, but not "inf" or "nan". Returns the position after the number, or NULL if there is no
// number.
static const char *word_number(const char *text, double *number)
{
    const char *digits = text + (*text == '-' || *text == '+');
    if (!((*digits >= '0' && *digits <= '9') || *digits == '.'))
        return NULL; // "inf", "nan"
    text = (const char *)number_double((const uint8_t *)text, (const uint8_t *)text + strlen(text), number);
    return text && *number - *number == 0 ? text : NULL;
}

bool word_numbers(const char *text, int min, int max, double *numbers, int *count, bool *radii)
{
    for (*count = 0; *count < max;) {
        text = word_number(text, &numbers[*count]);
        if (!text)
            return false;
        if (radii) {
            radii[*count] = *text == 'r';
            text += *text == 'r';
        }
        ++*count;
        if (!*text)
            return *count >= min;
        if (*text++ != '/')
            return false;
    }
    return false;
}

static bool read_color(const char *key, const char *text, lam_color_mode mode, bool opaque, lam_rgba *color,
                       lam_error *error)
{
    double parts[4];
    int count;
    if (word_numbers(text, 1, 4, parts, &count, NULL))
        for (int i = 0; i < count; i++)
            if (parts[i] < 0)
                return fail(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected numbers of at least 0", key, text);
    if (!lam_color_parse(text, mode, color, NULL))
        return fail(error, LAM_BAD_ARGUMENT,
                    "found '%s=%.60s', expected a colour: #rrggbb, r/g/b, a name such as white, or one number", key,
                    text);
    if (opaque && color->a != 1)
        return fail(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected a colour without alpha", key, text);
    return true;
}

bool word_number_of(const char *key, const char *value, double min, double max, double *number, lam_error *error)
{
    const char *end = word_number(value, number);
    if (!end || *end)
        return fail(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected a number", key, value);
    if (*number >= min && *number <= (max < 1e30 ? max : 1e30))
        return true;
    char range[64];
    snprintf(range, sizeof range, max < 1e29 ? "from %g to %g" : "of at least %g", min, max);
    return fail(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected a number %s", key, value, range);
}

static bool read_flag(const char *key, const char *value, double *number, lam_error *error)
{
    static const char *const words[] = {"no", "yes", "off", "on", "0", "1"};
    for (int i = 0; i < 6; i++)
        if (strcmp(value, words[i]) == 0) {
            *number = i & 1;
            return true;
        }
    return fail(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected yes or no", key, value);
}

static bool read_direction(const char *key, const char *value, double numbers[4], lam_error *error)
{
    int count;
    if (!word_numbers(value, 3, 3, numbers, &count, NULL))
        return fail(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected three numbers x/y/z", key, value);
    return numbers[0] != 0 || numbers[1] != 0 || numbers[2] != 0 ||
           fail(error, LAM_BAD_ARGUMENT, "%s is 0/0/0, expected a direction", key);
}

bool word_field(const lam_field *field, const char *value, lam_color_mode mode, double numbers[4], lam_error *error)
{
    lam_rgba color;
    switch (field->type) {
    case LAM_FIELD_FLAG:
        return read_flag(field->key, value, numbers, error);
    case LAM_FIELD_RGB:
    case LAM_FIELD_RGBA:
        if (!read_color(field->key, value, mode, field->type == LAM_FIELD_RGB, &color, error))
            return false;
        numbers[0] = (double)color.r, numbers[1] = (double)color.g, numbers[2] = (double)color.b;
        numbers[3] = (double)color.a;
        return true;
    case LAM_FIELD_DIRECTION:
    case LAM_FIELD_POINT:
    case LAM_FIELD_TRIPLE:
        return read_direction(field->key, value, numbers, error);
    default:
        return word_number_of(field->key, value, field->min, field->max, numbers, error);
    }
}

void word_set_field(const lam_field *field, void *object, const double numbers[4])
{
    double in_radians[4] = {math_radians(numbers[0])};
    lam_field_set(field, object, field->type == LAM_FIELD_ANGLE ? in_radians : numbers);
}
