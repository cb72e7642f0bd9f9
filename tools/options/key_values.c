// key_values.c: the parts of option values such as "key=value,key=value".
#include "key_values.h"

#include <stdio.h>
#include <string.h>

#include "console.h"
#include "options.h"
#include "suggest.h"

int key_find(const char *name, const char *const *names, lam_error *error)
{
    struct suggestion nearest = suggest_start(name);
    char known[300] = "";
    for (int i = 0; names[i]; i++) {
        if (strcmp(names[i], name) == 0)
            return i;
        suggest_try(&nearest, names[i]);
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s", i == 0 ? "" : names[i + 1] ? ", " : " or ", names[i]);
    }
    if (nearest.best)
        complain(error, LAM_BAD_ARGUMENT, "unknown key '%.60s'; did you mean '%s'?", name, nearest.best);
    else
        complain(error, LAM_BAD_ARGUMENT, "unknown key '%.60s'; expected %s", name, known);
    return -1;
}

bool read_numbers(const char *text, int min, int max, double *numbers, int *count, bool *radii)
{
    for (*count = 0; *count < max;) {
        text = read_number(text, &numbers[*count]);
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

bool read_one(const char *text, double *number)
{
    text = read_number(text, number);
    return text && !*text;
}

bool read_color(const char *what, const char *text, lam_color_mode mode, bool opaque, lam_rgba *color, lam_error *error)
{
    double grey;
    lam_error unused;
    if (read_one(text, &grey)) {
        if (!(grey >= 0 && grey <= 1e30))
            return complain(error, LAM_BAD_ARGUMENT, "%s is %.40s, expected a number of at least 0", what, text);
        *color = (lam_rgba){(float)grey, (float)grey, (float)grey, 1};
        return true;
    }
    double parts[4];
    int count;
    if (read_numbers(text, 3, 4, parts, &count, NULL))
        for (int i = 0; i < count; i++)
            if (parts[i] < 0)
                return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected numbers of at least 0", what, text);
    if (!lam_color_parse(text, mode, color, &unused))
        return complain(error, LAM_BAD_ARGUMENT,
                        "found '%s=%.60s', expected a colour: #rrggbb, r/g/b, a name such as white, or one number",
                        what, text);
    if (opaque && color->a != 1)
        return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected a colour without alpha", what, text);
    return true;
}

bool read_number_of(const char *key, const char *value, double min, double max, double *number, lam_error *error)
{
    if (!read_one(value, number))
        return complain(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected a number", key, value);
    if (*number >= min && *number <= (max < 1e30 ? max : 1e30))
        return true;
    char range[64];
    snprintf(range, sizeof range, max < 1e29 ? "from %g to %g" : "of at least %g", min, max);
    return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected a number %s", key, value, range);
}

static bool read_flag(const char *key, const char *value, double *number, lam_error *error)
{
    static const char *const words[] = {"no", "yes", "off", "on", "0", "1"};
    for (int i = 0; i < 6; i++)
        if (strcmp(value, words[i]) == 0) {
            *number = i & 1;
            return true;
        }
    return complain(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected yes or no", key, value);
}

static bool read_direction(const char *key, const char *value, double numbers[4], lam_error *error)
{
    int count;
    if (!read_numbers(value, 3, 3, numbers, &count, NULL))
        return complain(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected three numbers x/y/z", key, value);
    return numbers[0] != 0 || numbers[1] != 0 || numbers[2] != 0 ||
           complain(error, LAM_BAD_ARGUMENT, "%s is 0/0/0, expected a direction", key);
}

bool read_field(const lam_field *field, const char *value, lam_color_mode mode, double numbers[4], lam_error *error)
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
        return read_number_of(field->key, value, field->min, field->max, numbers, error);
    }
}

void set_field(const lam_field *field, void *object, const double numbers[4])
{
    double in_radians[4] = {radians(numbers[0])};
    lam_field_set(field, object, field->type == LAM_FIELD_ANGLE ? in_radians : numbers);
}
