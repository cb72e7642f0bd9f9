// key_values.c: what the values "key=value,key=value" of options are made of.
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

bool read_numbers(const char *text, int least, int most, double *numbers, int *count, bool *radii)
{
    for (*count = 0; *count < most;) {
        text = read_number(text, &numbers[*count]);
        if (!text)
            return false;
        if (radii) {
            radii[*count] = *text == 'r';
            text += *text == 'r';
        }
        ++*count;
        if (!*text)
            return *count >= least;
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
