// gltf_json.c: reads the JSON text of a glTF file: its lists, and indices into them.
#include "gltf_json.h"

#include "fail.h"
#include "json_parse.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool gltf_no_memory(struct gltf *gltf, size_t bytes)
{
    return call_memory_error(gltf->source->call, bytes, gltf->json.error);
}

// Estimates the memory in bytes that Jansson needs for the text. Every value follows one of the counted characters, and
// the strings are at most as long as the text.
static size_t tree_bytes(const uint8_t *text, size_t size)
{
    enum { BYTES_OF_A_VALUE = 96 };
    size_t values = 0;
    for (size_t i = 0; i < size; i++)
        values += (text[i] == ',') + (text[i] == ':') + (text[i] == '[') + (text[i] == '{');
    return size + (values > (SIZE_MAX - size) / BYTES_OF_A_VALUE ? SIZE_MAX - size : values * BYTES_OF_A_VALUE);
}

static const char *const lists[] = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                    "images",    "materials",  "meshes",  "nodes",       "samplers",
                                    "scenes",    "skins",      "textures"};

static bool check_lists(struct gltf *gltf)
{
    if (!json_is_object(gltf->root))
        return json_unexpected(&gltf->json, NULL, gltf->root, "an object, { … }");
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        bool ok = true;
        const json_t *list = gltf_take_list(gltf, NULL, gltf->root, lists[i], &ok);
        if (!ok)
            return false;
        if (list && json_array_size(list) > INT32_MAX / 2)
            return fail(gltf->json.error, LAM_LIMIT, "%s: %s: %zu elements are too many", gltf->source->name, lists[i],
                        json_array_size(list));
    }
    return true;
}

bool gltf_json_parse(struct gltf *gltf, const uint8_t *text, size_t size)
{
    size_t bytes = tree_bytes(text, size);
    while (size && !text[size - 1]) // some programs pad the chunk with zeros instead of spaces
        size--;
    if (!call_charge(gltf->source->call, bytes))
        return gltf_no_memory(gltf, bytes);
    gltf->json_bytes = bytes;
    gltf->root = json_parse((const char *)text, size, gltf->source->name, gltf->source->call, gltf->json.error);
    return gltf->root && check_lists(gltf);
}

void gltf_json_free(struct gltf *gltf)
{
    json_decref(gltf->root);
    gltf->root = NULL;
    call_refund(gltf->source->call, gltf->json_bytes);
    gltf->json_bytes = 0;
}

size_t gltf_list_size(const struct gltf *gltf, const char *list)
{
    return json_array_size(json_object_get(gltf->root, list));
}

const json_t *gltf_list_item(const struct gltf *gltf, const char *list, int index)
{
    return json_array_get(json_object_get(gltf->root, list), (size_t)index);
}

const json_t *gltf_extension(const json_t *object, const char *name)
{
    const json_t *extension = json_object_get(json_object_get(object, "extensions"), name);
    return json_is_object(extension) ? extension : NULL;
}

static bool whole_of(struct gltf *gltf, const struct place *place, const json_t *value, double min, double max,
                     size_t *out)
{
    double number = json_is_number(value) ? json_number_value(value) : -1;
    if (number >= min && number <= max && number == (double)(size_t)number) {
        *out = (size_t)number;
        return true;
    }
    char expected[80];
    if (max < 1e9)
        snprintf(expected, sizeof expected, "a whole number from %.0f to %.0f", min, max);
    else
        snprintf(expected, sizeof expected, "a whole number of at least %.0f", min);
    return json_unexpected(&gltf->json, place, value, expected);
}

bool gltf_take_whole(struct gltf *gltf, const struct place *place, const json_t *object, const char *key, double min,
                     double max, size_t *out)
{
    const json_t *value = json_object_get(object, key);
    return !value || whole_of(gltf, KEY_OF(place, key), value, min, max, out);
}

bool gltf_index_of(struct gltf *gltf, const struct place *place, const json_t *value, const char *list, int *index)
{
    size_t count = gltf_list_size(gltf, list);
    double number = json_is_number(value) ? json_number_value(value) : -1;
    if (number >= 0 && number < (double)count && number == (double)(int)number) {
        *index = (int)number;
        return true;
    }
    char kind[JSON_KIND_SIZE];
    if (!count)
        return json_fail(&gltf->json, place, "found %s, but the file has no %s", json_kind(value, kind), list);
    return json_fail(&gltf->json, place, "found %s, expected a number from 0 to %zu (%s)", json_kind(value, kind),
                     count - 1, list);
}

bool gltf_take_index(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                     const char *list, int *index)
{
    const json_t *value = json_object_get(object, key);
    *index = -1;
    return !value || gltf_index_of(gltf, KEY_OF(place, key), value, list, index);
}

bool gltf_take_numbers(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double *out)
{
    const json_t *value = json_object_get(object, key);
    return !value || json_numbers_of(&gltf->json, KEY_OF(place, key), value, count, count, out, NULL);
}

bool gltf_take_factors(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double min, double max, double *out)
{
    const double rounding = 1e-3;
    const json_t *value = json_object_get(object, key);
    if (value && !(count == 1 ? json_number_of(&gltf->json, KEY_OF(place, key), value, -HUGE_VAL, HUGE_VAL, out)
                              : json_numbers_of(&gltf->json, KEY_OF(place, key), value, count, count, out, NULL)))
        return false;
    for (size_t i = 0; value && i < count; i++) {
        double found = out[i];
        out[i] = found < min ? min : found > max ? max : found;
        if (!(fabs(found - out[i]) > rounding) || gltf->cut_factors++)
            continue;
        json_place(KEY_OF(place, key), gltf->cut_factor, sizeof gltf->cut_factor);
        gltf->cut_from = found;
        gltf->cut_to = out[i];
    }
    return true;
}

bool gltf_take_weights(struct gltf *gltf, const struct place *place, const json_t *object, double **out, size_t *count)
{
    const json_t *value = json_object_get(object, "weights");
    *out = NULL;
    *count = json_array_size(value);
    if (!value || json_is_null(value))
        return true;
    *out = GLTF_ALLOC(gltf, *count, double);
    if (!*out)
        return gltf_no_memory(gltf, *count * sizeof **out);
    return json_numbers_of(&gltf->json, KEY_OF(place, "weights"), value, 0, SIZE_MAX, *out, count);
}

const json_t *gltf_take_object(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                               bool *ok)
{
    const json_t *value = json_object_get(object, key);
    if (!value || json_is_object(value))
        return value;
    *ok = json_unexpected(&gltf->json, KEY_OF(place, key), value, "an object, { … }");
    return NULL;
}

const json_t *gltf_take_list(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                             bool *ok)
{
    const json_t *list = json_object_get(object, key);
    const struct place *here = KEY_OF(place, key);
    if (!list)
        return NULL;
    *ok = json_is_array(list) || json_unexpected(&gltf->json, here, list, "a list of objects");
    for (size_t i = 0; *ok && i < json_array_size(list); i++)
        if (!json_is_object(json_array_get(list, i)))
            *ok = json_unexpected(&gltf->json, ELEMENT_OF(here, i), json_array_get(list, i), "an object, { … }");
    return *ok ? list : NULL;
}

const char *gltf_name(struct gltf *gltf, const json_t *object, bool *ok)
{
    const char *name = json_string_value(json_object_get(object, "name"));
    if (!name || !*name)
        return NULL;
    name = arena_string(&gltf->scene->arena, name);
    if (!name)
        *ok = gltf_no_memory(gltf, 0);
    return name;
}

static const char *name_of(const json_t *list, size_t i)
{
    return json_string_value(json_object_get(json_array_get(list, i), "name"));
}

int gltf_find_named(struct gltf *gltf, const json_t *list, const char *wanted, const char *what)
{
    size_t count = json_array_size(list);
    for (size_t i = 0; i < count; i++)
        if (name_of(list, i) && strcmp(name_of(list, i), wanted) == 0)
            return (int)i;
    char *end;
    unsigned long number = strtoul(wanted, &end, 10);
    if (*wanted >= '0' && *wanted <= '9' && !*end && number < count)
        return (int)number;
    char known[400] = "", shown[SHOWN_NAME_SIZE];
    for (size_t i = 0; i < count; i++) {
        const char *name = name_of(list, i);
        size_t used = strlen(known);
        if (used > sizeof known - SHOWN_NAME_SIZE - 30) {
            snprintf(known + used, sizeof known - used, ", …");
            break;
        }
        snprintf(known + used, sizeof known - used, "%s%zu%s%s%s", i ? ", " : "", i, name ? " ('" : "",
                 name ? shown_name(name, shown) : "", name ? "')" : "");
    }
    fail(gltf->json.error, LAM_BAD_ARGUMENT, "%s: there is no %s '%s'; %s%s", gltf->source->name, what,
         shown_name(wanted, shown), count ? "expected one of " : "the file contains none", known);
    return -1;
}
