// scene_values.c: values of a scene file, each checked as it is taken, and the sentences where one does not fit.
#include "scene_reader.h"

#include "fail.h"
#include "linear.h"
#include "spelling.h"

#include <stdio.h>
#include <string.h>

// --- places and sentences

static size_t print_place(const struct place *place, char *out, size_t capacity)
{
    if (!place)
        return 0;
    size_t used = print_place(place->within, out, capacity);
    if (used >= capacity)
        return used;
    int length = place->key ? snprintf(out + used, capacity - used, "%s%s", used ? "." : "", place->key)
                            : snprintf(out + used, capacity - used, "[%zu]", place->index);
    return used + (length > 0 ? (size_t)length : 0);
}

bool fail_place(struct scene_reader *r, const struct place *place, const char *format, ...)
{
    char where[200] = "", sentence[sizeof r->error->text];
    print_place(place, where, sizeof where);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    return fail(r->error, LAM_CANNOT_READ, "%s: %s%s%s", r->source->name, where, *where ? ": " : "", sentence);
}

const char *json_kind(const json_t *value, char out[32])
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        snprintf(out, 32, "a list of %zu", json_array_size(value));
        return out;
    case JSON_STRING:
        snprintf(out, 32, "\"%.20s\"", json_string_value(value));
        return out;
    case JSON_TRUE:
        return "true";
    case JSON_FALSE:
        return "false";
    case JSON_NULL:
        return "null";
    default:
        snprintf(out, 32, "%.10g", json_number_value(value));
        return out;
    }
}

static bool unexpected(struct scene_reader *r, const struct place *place, const json_t *found, const char *expected)
{
    char kind[32];
    return fail_place(r, place, "found %s, expected %s", json_kind(found, kind), expected);
}

bool check_keys(struct scene_reader *r, const struct place *place, const json_t *object, const char *const *keys)
{
    if (!json_is_object(object))
        return unexpected(r, place, object, "an object, { … }");
    int count = 0;
    while (keys[count])
        count++;
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)(uintptr_t)object, key, value)
    {
        int i = 0;
        while (i < count && strcmp(keys[i], key) != 0)
            i++;
        if (i < count)
            continue;
        const char *nearest = strlen(key) <= 40 ? nearest_word(key, keys, count) : NULL;
        char known[300] = "";
        for (i = 0; !nearest && i < count; i++) {
            size_t used = strlen(known);
            snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", keys[i]);
        }
        return nearest ? fail_place(r, KEY_OF(place, key), "unknown key; did you mean '%s'?", nearest)
                       : fail_place(r, KEY_OF(place, key), "unknown key; expected %s", known);
    }
    return true;
}

// --- numbers

static bool number_of(struct scene_reader *r, const struct place *place, const json_t *value, double min, double max,
                      double *out)
{
    char expected[100];
    if (!json_is_number(value))
        return unexpected(r, place, value, "a number");
    double number = json_number_value(value);
    if (number >= min && number <= max) {
        *out = number;
        return true;
    }
    if (min > -1e30 && max < 1e30)
        snprintf(expected, sizeof expected, "a number from %.10g to %.10g", min, max);
    else if (min > -1e30)
        snprintf(expected, sizeof expected, "a number of at least %.10g", min);
    else
        snprintf(expected, sizeof expected, "a number of at most %.10g", max);
    return unexpected(r, place, value, expected);
}

bool take_number(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, double min,
                 double max, double *out)
{
    const json_t *value = json_object_get(object, key);
    return !value || number_of(r, KEY_OF(place, key), value, min, max, out);
}

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

bool take_bool(struct scene_reader *r, const struct place *place, const json_t *object, const char *key, bool *out)
{
    const json_t *value = json_object_get(object, key);
    if (!value)
        return true;
    *out = json_is_true(value);
    return json_is_boolean(value) || unexpected(r, KEY_OF(place, key), value, "true or false");
}

bool numbers_of(struct scene_reader *r, const struct place *place, const json_t *list, size_t min, size_t max,
                double *out, size_t *count)
{
    char expected[60];
    size_t size = json_is_array(list) ? json_array_size(list) : 0;
    if (min == max)
        snprintf(expected, sizeof expected, "a list of %zu numbers", min);
    else
        snprintf(expected, sizeof expected, "a list of %zu to %zu numbers", min, max);
    if (!json_is_array(list) || size < min || size > max)
        return unexpected(r, place, list, expected);
    for (size_t i = 0; i < size; i++)
        if (!number_of(r, ELEMENT_OF(place, i), json_array_get(list, i), -1e30, 1e30, &out[i]))
            return false;
    if (count)
        *count = size;
    return true;
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

// --- texts and words

bool take_text(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
               const char **out)
{
    const json_t *value = json_object_get(object, key);
    if (!value)
        return true;
    if (!json_is_string(value) || !json_string_length(value))
        return unexpected(r, KEY_OF(place, key), value, "a text that is not empty");
    *out = arena_string(&r->scene->arena, json_string_value(value));
    return *out || call_memory_error(r->source->call, json_string_length(value), r->error);
}

bool take_word(struct scene_reader *r, const struct place *place, const json_t *object, const char *key,
               const struct scene_word *words, int *out)
{
    const json_t *value = json_object_get(object, key);
    if (!value)
        return true;
    const char *names[16];
    int count = 0;
    char known[160] = "";
    for (; words[count].name; count++) {
        names[count] = words[count].name;
        if (json_is_string(value) && strcmp(json_string_value(value), words[count].name) == 0) {
            *out = words[count].value;
            return true;
        }
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s",
                 !count                  ? ""
                 : words[count + 1].name ? ", "
                                         : " or ",
                 names[count]);
    }
    bool text = json_is_string(value) && json_string_length(value) <= 40;
    const char *nearest = text ? nearest_word(json_string_value(value), names, count) : NULL;
    char expected[240];
    snprintf(expected, sizeof expected, "%s%s%s%s", known, nearest ? "; did you mean '" : "", nearest ? nearest : "",
             nearest ? "'?" : "");
    return unexpected(r, KEY_OF(place, key), value, expected);
}

const struct scene_word color_words[] = {{"srgb", LAM_COLOR_SRGB}, {"raw", LAM_COLOR_RAW}, {NULL, 0}};
const struct scene_word shading_words[] = {{"flat", LAM_SHADING_FLAT},    {"gouraud", LAM_SHADING_GOURAUD},
                                           {"phong", LAM_SHADING_PHONG},  {"smooth", LAM_SHADING_GOURAUD},
                                           {"normal", LAM_SHADING_PHONG}, {NULL, 0}};
const struct scene_word stage_words[] = {{"auto", LAM_STAGE_AUTO},
                                         {"application", LAM_STAGE_APPLICATION},
                                         {"vertex", LAM_STAGE_VERTEX},
                                         {"fragment", LAM_STAGE_FRAGMENT},
                                         {NULL, 0}};
const struct scene_word viewer_words[] = {{"local", LAM_VIEWER_LOCAL}, {"infinite", LAM_VIEWER_INFINITE}, {NULL, 0}};
const struct scene_word flat_normal_words[] = {
    {"face", LAM_FLAT_NORMAL_FACE}, {"vertex", LAM_FLAT_NORMAL_VERTEX}, {NULL, 0}};
const struct scene_word normals_words[] = {
    {"file", LAM_NORMALS_FILE}, {"smooth", LAM_NORMALS_SMOOTH}, {"facet", LAM_NORMALS_FACET}, {NULL, 0}};
const struct scene_word cull_words[] = {
    {"none", LAM_CULL_NONE}, {"back", LAM_CULL_BACK}, {"front", LAM_CULL_FRONT}, {NULL, 0}};
const struct scene_word up_words[] = {{"x", LAM_UP_X}, {"y", LAM_UP_Y}, {"z", LAM_UP_Z}, {NULL, 0}};
const struct scene_word frame_words[] = {
    {"world", LAM_FRAME_WORLD}, {"camera", LAM_FRAME_CAMERA}, {"object", LAM_FRAME_OBJECT}, {NULL, 0}};
const struct scene_word tangent_words[] = {{"file", false}, {"field", true}, {NULL, 0}};

void light_type_words(struct scene_word words[LAM_LIGHT_TYPE_COUNT + 1])
{
    for (int i = 0; i < LAM_LIGHT_TYPE_COUNT; i++)
        words[i] = (struct scene_word){lam_light_type_describe((lam_light_type)i)->word, i};
    words[LAM_LIGHT_TYPE_COUNT] = (struct scene_word){NULL, 0};
}

void reflection_words(struct scene_word words[LAM_REFLECTION_COUNT + 1])
{
    for (int i = 0; i < LAM_REFLECTION_COUNT; i++)
        words[i] = (struct scene_word){lam_reflection_describe((lam_reflection)i)->word, i};
    words[LAM_REFLECTION_COUNT] = (struct scene_word){NULL, 0};
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
        return max == 4 || out->a == 1 || fail_place(r, place, "has an alpha, expected a colour of three parts");
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
    case LAM_FIELD_FLAG:
        return take_bool(r, place, object, field->key, at);
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
        if (!take_number(r, place, object, field->key, min, max, numbers))
            return false;
        break;
    }
    field_set_written(field, out, numbers);
    return true;
}
