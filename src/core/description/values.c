// values.c: gets values from a description, checks each value on access, and reports wrong values.
#include "description.h"

#include "fail.h"
#include "linear.h"
#include "number.h"

#include <stdio.h>
#include <string.h>

// --- numbers

bool take_whole(struct reader *r, const struct place *place, const json_t *object, const char *key, int min, int max,
                int *out)
{
    const json_t *value = json_object_get(object, key);
    double number = 0;
    if (!value)
        return true;
    if (!json_number_of(&r->json, KEY_OF(place, key), value, min, max, &number))
        return false;
    *out = (int)number;
    return (double)*out == number || json_unexpected(&r->json, KEY_OF(place, key), value, "a whole number");
}

bool take_vector(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_vec3 *out)
{
    bool in_radii;
    return take_point(r, place, object, key, out, NULL, &in_radii) &&
           (!in_radii ||
            json_unexpected(&r->json, KEY_OF(place, key), json_object_get(object, key), "numbers without r"));
}

bool take_direction(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_vec3 *out)
{
    if (!take_vector(r, place, object, key, out))
        return false;
    bool zero = json_object_get(object, key) && out->x == 0 && out->y == 0 && out->z == 0;
    return !zero || json_fail(&r->json, KEY_OF(place, key), "found 0, 0, 0, expected a direction");
}

// --- lengths in radii

bool find_sphere(struct reader *r, const struct place *place, bool needed)
{
    bool found = true;
    if (!(r->sphere.radius > 0) && r->scene) {
        found = lam_scene_sphere(r->scene, -1, &r->sphere.centre, &r->sphere.radius);
        if (!found && needed)
            return json_fail(&r->json, place, "expected numbers without r: there is no model to define the radius");
    }
    if (!(r->sphere.radius > 0) && (found || !needed))
        r->sphere.radius = 1;
    return true;
}

// Returns whether a value is a number with the unit r.
static bool is_in_radii(const json_t *value, double *number)
{
    const char *text = json_string_value(value);
    const uint8_t *end =
        text ? number_double((const uint8_t *)text, (const uint8_t *)text + strlen(text), number) : NULL;
    return end && strcmp((const char *)end, "r") == 0 && *number - *number == 0;
}

bool take_point(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_vec3 *out,
                double *w, bool *in_radii)
{
    const json_t *list = json_object_get(object, key), *item;
    const struct place *here = KEY_OF(place, key);
    double n[4] = {0};
    size_t i, count = json_array_size(list), radii = 0, plain = 0;
    *in_radii = false;
    if (!list)
        return true;
    if (count != 3 && !(w && count == 4))
        return json_unexpected(&r->json, here, list,
                               !r->json.file ? "three numbers x/y/z"
                               : w           ? "a list of 3 to 4 numbers"
                                             : "a list of 3 numbers");
    json_array_foreach(list, i, item)
    {
        bool unit = i < 3 && is_in_radii(item, &n[i]);
        if (!unit && i < 3 && json_is_string(item))
            return json_unexpected(&r->json, ELEMENT_OF(here, i), item,
                                   "a number, or a length in radii such as \"2r\"");
        if (!unit && !json_number_of(&r->json, ELEMENT_OF(here, i), item, -1e30, 1e30, &n[i]))
            return false;
        radii += unit;
        plain += !unit && i < 3 && n[i] != 0;
    }
    if (radii && plain)
        return json_unexpected(&r->json, here, list, "r after all of its numbers or after none");
    double divisor = 1;
    if (count == 4)
        divisor = (*w = n[3]) != 0 ? n[3] : 1;
    *in_radii = radii > 0;
    *out = v3(n[0] / divisor, n[1] / divisor, n[2] / divisor);
    return true;
}

// Gets a number, or with a `power` of 1 or −1 a length or its inverse, which may be in radii. The inverse of 0 is 0.
static bool take_length(struct reader *r, const struct place *place, const json_t *value, double min, double max,
                        int power, double *out)
{
    double number;
    if (!power || !is_in_radii(value, &number))
        return json_number_of(&r->json, place, value, min, max, out);
    json_t *plain = json_real(number);
    bool ok = plain ? json_number_of(&r->json, place, plain, min, max, out) : fail_memory(r->json.error, 16);
    json_decref(plain);
    if (!ok || !find_sphere(r, place, true))
        return false;
    double radius = r->sphere.radius;
    *out = (double)(float)*out;
    *out = power == 1 ? *out * radius : *out / (power == -1 ? radius : radius * radius);
    return true;
}

// --- strings and words

bool take_text(struct reader *r, const struct place *place, const json_t *object, const char *key, const char **out)
{
    const char *text = NULL;
    if (!json_take_text(&r->json, place, object, key, &text))
        return false;
    if (text)
        *out = r->source ? arena_string(&r->scene->arena, text) : text;
    return !text || *out || call_memory_error(r->source->call, strlen(text), r->json.error);
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

// --- colours

// Reads linear numbers: one for all three channels, or a list of three, or of four with an alpha.
static bool linear_color(struct reader *r, const struct place *place, const json_t *value, size_t max, lam_rgba *out)
{
    double part[4] = {0, 0, 0, 1};
    if (json_is_number(value)) {
        if (!json_number_of(&r->json, place, value, 0, 3.4e38, &part[0]))
            return false;
        part[1] = part[2] = part[0];
    } else if (!json_numbers_of(&r->json, place, value, 3, max, part, NULL)) {
        return false;
    }
    for (size_t i = 0; i < 4; i++)
        if (part[i] < 0 || (i == 3 && part[i] > 1))
            return json_fail(&r->json, ELEMENT_OF(place, i), "found %.10g, expected a number %s", part[i],
                             i == 3 ? "from 0 to 1" : "of at least 0");
    *out = (lam_rgba){(float)part[0], (float)part[1], (float)part[2], (float)part[3]};
    return true;
}

static bool color_of(struct reader *r, const struct place *place, const json_t *value, size_t max, lam_rgba *out)
{
    lam_error reason;
    if (!json_is_string(value))
        return linear_color(r, place, value, max, out);
    if (!lam_color_parse(json_string_value(value), r->color, out, &reason))
        return json_unexpected(&r->json, place, value,
                               r->json.file
                                   ? "a colour: \"#rrggbb\", a name such as \"white\", or a list of linear numbers"
                                   : "a colour: #rrggbb, r/g/b, a name such as white, or one number");
    return max == 4 || out->a == 1 || json_fail(&r->json, place, "contains an alpha, expected a colour without alpha");
}

bool take_rgba(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_rgba *out)
{
    const json_t *value = json_object_get(object, key);
    return !value || color_of(r, KEY_OF(place, key), value, 4, out);
}

bool take_rgb(struct reader *r, const struct place *place, const json_t *object, const char *key, lam_rgb *out)
{
    lam_rgba color = {out->r, out->g, out->b, 1};
    const json_t *value = json_object_get(object, key);
    if (value && !color_of(r, KEY_OF(place, key), value, 3, &color))
        return false;
    *out = (lam_rgb){color.r, color.g, color.b};
    return true;
}

// --- fields of materials and lights

// Reads the three numbers of an attenuation. The second is for a distance, and the third for its square.
static bool take_triple(struct reader *r, const struct place *place, const json_t *list, const lam_field *field,
                        double numbers[4])
{
    if (json_array_size(list) != 3)
        return json_unexpected(&r->json, place, list, r->json.file ? "a list of 3 numbers" : "three numbers a/b/c");
    for (size_t i = 0; i < 3; i++)
        if (!take_length(r, ELEMENT_OF(place, i), json_array_get(list, i), field->min, 1e30, -(int)i, &numbers[i]))
            return false;
    return true;
}

bool take_field(struct reader *r, const struct place *place, const json_t *object, const lam_field *field, void *out)
{
    void *at = (char *)out + field->offset;
    double numbers[4], min = field->min > -1e30 ? field->min : -1e30, max = field->max < 1e30 ? field->max : 1e30;
    const json_t *value = json_object_get(object, field->key);
    const struct place *here = KEY_OF(place, field->key);
    struct field_fault fault;
    char expected[40];
    bool on, is_length = field->light_types && field->unit && strstr(field->unit, "units");
    if (!value)
        return true;
    switch (field->type) {
    case LAM_FIELD_FLAG:
        on = json_number_value(value) == 1;
        if (r->json.file || !json_is_number(value) || (!on && json_number_value(value) != 0)) // options accept 0 and 1
            if (!json_take_bool(&r->json, place, object, field->key, &on))
                return false;
        numbers[0] = on;
        break;
    case LAM_FIELD_RGB:
        if (!take_rgb(r, place, object, field->key, at))
            return false;
        snprintf(expected, sizeof expected, "channels of at most %g", field->max);
        return field->max > 1e30 || field_fits(field, out, &fault) || json_unexpected(&r->json, here, value, expected);
    case LAM_FIELD_RGBA:
        return take_rgba(r, place, object, field->key, at);
    case LAM_FIELD_POINT:
        return take_vector(r, place, object, field->key, at);
    case LAM_FIELD_DIRECTION:
        return take_direction(r, place, object, field->key, at);
    case LAM_FIELD_TRIPLE:
        if (!take_triple(r, here, value, field, numbers))
            return false;
        break;
    case LAM_FIELD_NUMBER:
    case LAM_FIELD_ANGLE:
        if (field->light_types && field->max == 1 && json_is_boolean(value))
            numbers[0] = json_is_true(value); // true means 1, and false means 0
        else if (!take_length(r, here, value, min, max, is_length, numbers))
            return false;
        break;
    }
    field_set_written(field, out, numbers);
    return true;
}
