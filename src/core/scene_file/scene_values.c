// scene_values.c: gets values from a scene file, checks each value on access, and reports wrong values.
#include "scene_reader.h"

#include "fail.h"
#include "linear.h"

#include <stdio.h>
#include <string.h>

// --- values of any JSON file

static struct json_reader json_of(const struct scene_reader *r)
{
    return (struct json_reader){.file = r->source->name, .error = r->error};
}

bool fail_place(struct scene_reader *r, const struct place *place, const char *format, ...)
{
    struct json_reader json = json_of(r);
    va_list arguments;
    va_start(arguments, format);
    json_vfail(&json, place, format, arguments);
    va_end(arguments);
    return false;
}

static bool unexpected(struct scene_reader *r, const struct place *place, const json_t *found, const char *expected)
{
    struct json_reader json = json_of(r);
    return json_unexpected(&json, place, found, expected);
}

bool check_keys(struct scene_reader *r, const struct place *place, const json_t *object, const char *const *keys)
{
    struct json_reader json = json_of(r);
    return json_check_keys(&json, place, object, keys);
}

static bool number_of(struct scene_reader *r, const struct place *place, const json_t *value, double min, double max,
                      double *out)
{
    struct json_reader json = json_of(r);
    return json_number_of(&json, place, value, min, max, out);
}

bool numbers_of(struct scene_reader *r, const struct place *place, const json_t *list, size_t min, size_t max,
                double *out, size_t *count)
{
    struct json_reader json = json_of(r);
    return json_numbers_of(&json, place, list, min, max, out, count);
}

bool take_number(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, double min,
                 double max, double *out)
{
    struct json_reader json = json_of(r);
    return json_take_number(&json, place, object, key, min, max, out);
}

bool take_bool(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, bool *out)
{
    struct json_reader json = json_of(r);
    return json_take_bool(&json, place, object, key, out);
}

bool take_word(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
               const struct json_choice *words, int *out)
{
    struct json_reader json = json_of(r);
    return json_take_word(&json, place, object, key, words, out);
}

// --- numbers

bool take_whole(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, int min,
                int max, int *out)
{
    const json_t *value = json_object_get(object, key);
    double number = 0;
    if (!value)
        return true;
    if (!number_of(r, KEY_OF(place, key), value, min, max, &number))
        return false;
    *out = (int)number;
    return (double)*out == number || unexpected(r, KEY_OF(place, key), value, "a whole number");
}

bool take_vector(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
                 lam_vec3 *out)
{
    const json_t *value = json_object_get(object, key);
    double v[3];
    if (!value)
        return true;
    if (!numbers_of(r, KEY_OF(place, key), value, 3, 3, v, NULL))
        return false;
    *out = v3(v[0], v[1], v[2]);
    return true;
}

bool take_direction(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
                    lam_vec3 *out)
{
    if (!take_vector(r, place, object, key, out))
        return false;
    bool zero = json_object_get(object, key) && out->x == 0 && out->y == 0 && out->z == 0;
    return !zero || fail_place(r, KEY_OF(place, key), "found 0, 0, 0, expected a direction");
}

// --- strings and words

bool take_text(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
               const char **out)
{
    struct json_reader json = json_of(r);
    const char *text = NULL;
    if (!json_take_text(&json, place, object, key, &text))
        return false;
    if (text)
        *out = arena_string(&r->scene->arena, text);
    return !text || *out || call_memory_error(r->source->call, strlen(text), r->error);
}

const struct json_choice color_words[] = {{"srgb", LAM_COLOR_SRGB}, {"raw", LAM_COLOR_RAW}, {NULL, 0}};
const struct json_choice normals_words[] = {
    {"file", LAM_NORMALS_FILE}, {"smooth", LAM_NORMALS_SMOOTH}, {"facet", LAM_NORMALS_FACET}, {NULL, 0}};
const struct json_choice cull_words[] = {
    {"none", LAM_CULL_NONE}, {"back", LAM_CULL_BACK}, {"front", LAM_CULL_FRONT}, {NULL, 0}};
const struct json_choice up_words[] = {
    {"x", LAM_UP_X},           {"y", LAM_UP_Y},           {"z", LAM_UP_Z}, {"-x", LAM_UP_NEGATIVE_X},
    {"-y", LAM_UP_NEGATIVE_Y}, {"-z", LAM_UP_NEGATIVE_Z}, {NULL, 0}};
const struct json_choice frame_words[] = {{"world", LAM_FRAME_WORLD},
                                          {"camera", LAM_FRAME_CAMERA},
                                          {"object", LAM_FRAME_OBJECT},
                                          {"view", LAM_FRAME_VIEW},
                                          {NULL, 0}};
const struct json_choice tangent_words[] = {{"file", false}, {"field", true}, {NULL, 0}};

void light_type_words(struct json_choice words[LAM_LIGHT_TYPE_COUNT + 1])
{
    for (int i = 0; i < LAM_LIGHT_TYPE_COUNT; i++)
        words[i] = (struct json_choice){lam_light_type_describe((lam_light_type)i)->word, i};
    words[LAM_LIGHT_TYPE_COUNT] = (struct json_choice){NULL, 0};
}

void tone_words(struct json_choice words[LAM_TONE_COUNT + 1])
{
    for (int i = 0; i < LAM_TONE_COUNT; i++)
        words[i] = (struct json_choice){lam_tone_name((lam_tone)i), i};
    words[LAM_TONE_COUNT] = (struct json_choice){NULL, 0};
}

void setting_words(const lam_setting *setting, struct json_choice words[WORDS_MAX])
{
    int count = 0, value;
    for (const char *word; count < WORDS_MAX - 1 && (word = setting->word(count, &value)); count++)
        words[count] = (struct json_choice){word, value};
    words[count] = (struct json_choice){NULL, 0};
}

// --- colours

static bool color_of(struct scene_reader *r, const struct place *place, const json_t *value, size_t max, lam_rgba *out)
{
    double part[4] = {0, 0, 0, 1};
    if (json_is_string(value)) {
        lam_error reason;
        if (json_string_length(value) > 40 || !lam_color_parse(json_string_value(value), r->color, out, &reason))
            return unexpected(r, place, value,
                              "a colour: \"#rrggbb\", a name such as \"white\", or a list of linear numbers");
        return max == 4 || out->a == 1 || fail_place(r, place, "contains an alpha, expected a colour without alpha");
    }
    if (!numbers_of(r, place, value, 3, max, part, NULL))
        return false;
    for (size_t i = 0; i < 4; i++)
        if (part[i] < 0 || (i == 3 && part[i] > 1))
            return fail_place(r, ELEMENT_OF(place, i), "found %.10g, expected a number %s", part[i],
                              i == 3 ? "from 0 to 1" : "of at least 0");
    *out = (lam_rgba){(float)part[0], (float)part[1], (float)part[2], (float)part[3]};
    return true;
}

bool take_rgba(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, lam_rgba *out)
{
    const json_t *value = json_object_get(object, key);
    return !value || color_of(r, KEY_OF(place, key), value, 4, out);
}

bool take_rgb(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, lam_rgb *out)
{
    const json_t *value = json_object_get(object, key);
    lam_rgba color;
    if (!value)
        return true;
    if (!color_of(r, KEY_OF(place, key), value, 3, &color))
        return false;
    *out = (lam_rgb){color.r, color.g, color.b};
    return true;
}

// --- fields of materials and lights

static bool take_triple(struct scene_reader *r, const struct place *place, const json_t *object, const lam_field *field,
                        double numbers[4])
{
    const json_t *list = json_object_get(object, field->key);
    const struct place *here = KEY_OF(place, field->key);
    if (!list)
        return true;
    if (!numbers_of(r, here, list, 3, 3, numbers, NULL))
        return false;
    for (size_t i = 0; i < 3; i++)
        if (!number_of(r, ELEMENT_OF(here, i), json_array_get(list, i), field->min, 1e30, &numbers[i]))
            return false;
    return true;
}

bool take_field(struct scene_reader *r, const struct place *place, const json_t *object, const lam_field *field,
                void *out)
{
    void *at = (char *)out + field->offset;
    double numbers[4], min = field->min > -1e30 ? field->min : -1e30, max = field->max < 1e30 ? field->max : 1e30;
    if (!json_object_get(object, field->key))
        return true;
    switch (field->type) {
    case LAM_FIELD_FLAG: {
        bool on = false;
        if (!take_bool(r, place, object, field->key, &on))
            return false;
        numbers[0] = on;
        break;
    }
    case LAM_FIELD_RGB:
        return take_rgb(r, place, object, field->key, at);
    case LAM_FIELD_RGBA:
        return take_rgba(r, place, object, field->key, at);
    case LAM_FIELD_POINT:
        return take_vector(r, place, object, field->key, at);
    case LAM_FIELD_DIRECTION:
        return take_direction(r, place, object, field->key, at);
    case LAM_FIELD_TRIPLE:
        if (!take_triple(r, place, object, field, numbers))
            return false;
        break;
    case LAM_FIELD_NUMBER:
    case LAM_FIELD_ANGLE:
        if (field->light_types && field->max == 1 && json_is_boolean(json_object_get(object, field->key)))
            numbers[0] = json_is_true(json_object_get(object, field->key)); // true means 1, and false means 0
        else if (!take_number(r, place, object, field->key, min, max, numbers))
            return false;
        break;
    }
    field_set_written(field, out, numbers);
    return true;
}
