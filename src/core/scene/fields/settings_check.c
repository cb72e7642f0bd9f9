// settings_check.c: checks the draw parameters against the ranges in the table of settings, and applies the defaults.
#include "settings_check.h"

#include <string.h>

#include "fail.h"
#include "linear.h"

static bool whole_check(const lam_setting *s, int value, lam_error *error)
{
    if (value == 0 || (value >= s->min && value <= s->max))
        return true;
    return fail(error, LAM_BAD_ARGUMENT, "%s is %d, expected %s", s->member, value, s->expected);
}

// Ignores the minimum that applies to scene files, because programs that call the library may draw thinner lines.
static bool number_check(const lam_setting *s, float value, lam_error *error)
{
    double least = s->zero_is_negative ? -3e38 : 0;
    if ((double)value >= least && (double)value <= s->max)
        return true;
    return fail(error, LAM_BAD_ARGUMENT, "%s is %g, expected %s", s->member, (double)value, s->expected);
}

static bool angle_check(const lam_setting *s, float radians, lam_error *error)
{
    double value = (double)radians;
    if (value >= 0 && value <= s->max * (PI / 180) + 1e-6)
        return true;
    return fail(error, LAM_BAD_ARGUMENT, "%s is %g°, expected %s", s->key, math_degrees(value), s->expected);
}

static bool word_check(const lam_setting *s, int value, lam_error *error)
{
    int one, bits = 0;
    for (int i = 0; s->word(i, &one); i++) {
        if (s->type == LAM_SETTING_WORD && one == value)
            return true;
        bits |= one;
    }
    if (s->type == LAM_SETTING_WORDS && (value & ~bits) == 0)
        return true;
    if (strncmp(s->expected, "lam_", 4) == 0)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: %s %d is not one of %s", s->member, value, s->expected);
    return fail(error, LAM_BAD_ARGUMENT, "draw parameters: %s is out of range", s->expected);
}

bool channels_check(const char *name, const float *channels, int count, lam_error *error)
{
    for (int i = 0; i < count; i++) {
        bool alpha = i == 3;
        if (!(channels[i] >= 0 && channels[i] <= (alpha ? 1 : 3e38f)))
            return fail(error, LAM_BAD_ARGUMENT, "%s: a channel is %g, expected a number of at least 0%s", name,
                        (double)channels[i], alpha ? " and at most 1" : "");
    }
    return true;
}

static bool setting_check(const lam_setting *s, const void *member, lam_error *error)
{
    switch (s->type) {
    case LAM_SETTING_WHOLE:
        return whole_check(s, *(const int *)member, error);
    case LAM_SETTING_NUMBER:
        return number_check(s, *(const float *)member, error);
    case LAM_SETTING_ANGLE:
        return angle_check(s, *(const float *)member, error);
    case LAM_SETTING_WORD:
    case LAM_SETTING_WORDS:
        return word_check(s, *(const int *)member, error);
    case LAM_SETTING_RGB:
        return channels_check(s->member, member, 3, error);
    case LAM_SETTING_RGBA:
        return channels_check(s->member, member, 4, error);
    case LAM_SETTING_FLAG:
    case LAM_SETTING_NOT_FLAG:
        break; // both values of a bool are valid
    }
    return true;
}

bool settings_check(const lam_draw_params *params, lam_error *error)
{
    const lam_setting *setting;
    for (int i = 0; (setting = lam_draw_setting(i)); i++)
        if (!setting_check(setting, (const char *)params + setting->offset, error))
            return false;
    return true;
}

void settings_resolve(const lam_draw_params *params, lam_draw_params *out)
{
    const lam_setting *setting;
    *out = *params;
    for (int i = 0; (setting = lam_draw_setting(i)); i++) {
        void *member = (char *)out + setting->offset;
        if (setting->type == LAM_SETTING_WHOLE && !*(int *)member)
            *(int *)member = (int)setting->standard;
        if (setting->type == LAM_SETTING_NUMBER && !(*(float *)member > 0))
            *(float *)member = *(float *)member < 0 ? 0 : (float)setting->standard;
    }
}

double setting_number(const lam_draw_params *params, const char *key)
{
    const lam_setting *setting = lam_draw_setting(lam_draw_setting_find(key));
    double value = (double)*(const float *)((const char *)params + setting->offset);
    double standard = setting->type == LAM_SETTING_ANGLE ? math_radians(setting->standard) : setting->standard;
    return value > 0 ? value : standard;
}
