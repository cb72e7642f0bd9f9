// gltf_json.c: reads the JSON text of a glTF file: its lists, indices into them, and values; counts what is wrong.
#include "gltf_json.h"

#include "fail.h"
#include "json_parse.h"
#include "spelling.h"
#include "srgb.h"
#include "texture_batch.h"

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
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        size_t size = json_array_size(gltf_take_list(gltf, NULL, gltf->root, lists[i]));
        if (size > INT32_MAX / 2)
            return fail(gltf->json.error, LAM_LIMIT, "%s: %s: %zu elements are too many", gltf->source->name, lists[i],
                        size);
    }
    return true;
}

// Checks what all objects have in common: extensions are objects, and names are strings. Removes other values.
static void check_members(struct gltf *gltf, const struct place *place, json_t *value)
{
    bool extensions = place && place->key && strcmp(place->key, "extensions") == 0;
    const char *key;
    json_t *member;
    void *next;
    json_object_foreach_safe(value, next, key, member)
    {
        const struct place *here = KEY_OF(place, key);
        bool object = extensions || strcmp(key, "extensions") == 0, name = strcmp(key, "name") == 0;
        bool right = object ? json_is_object(member) : !name || json_is_string(member);
        if (right && strcmp(key, "extras") != 0)
            check_members(gltf, here, member);
        if (right)
            continue;
        gltf_note_wrong(gltf, here, member, object ? "an object, { … }" : "a string");
        json_object_del(value, key);
    }
    for (size_t i = 0; i < json_array_size(value); i++)
        check_members(gltf, ELEMENT_OF(place, i), json_array_get(value, i));
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
    if (!gltf->root)
        return false;
    if (!json_is_object(gltf->root))
        return json_unexpected(&gltf->json, NULL, gltf->root, "an object, { … }");
    check_members(gltf, NULL, gltf->root);
    return check_lists(gltf);
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

// Returns the value of a key, or NULL. A value that is null is noted.
static const json_t *value_of(struct gltf *gltf, const struct place *place, const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    if (!json_is_null(value))
        return value;
    gltf_note(gltf, KEY_OF(place, key), "found null; drawn as if it were missing");
    return NULL;
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
    const json_t *value = value_of(gltf, place, object, key);
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
    const json_t *value = value_of(gltf, place, object, key);
    *index = -1;
    return !value || gltf_index_of(gltf, KEY_OF(place, key), value, list, index);
}

// --- problems

struct gltf_problem {
    struct gltf_problem *next;
    char kind[100];
    const char *end;       // the end of the warning
    lam_error first, last; // the first and the latest problem of this kind
    size_t count;
};

// Returns the text of an error without the model's name.
static const char *sentence_of(const struct gltf *gltf, const lam_error *error)
{
    size_t length = strlen(gltf->source->name);
    return strncmp(error->text, gltf->source->name, length) == 0 && error->text[length] == ':'
               ? error->text + length + 2
               : error->text;
}

// Writes the kind of an error: its position without indices and without text in parentheses.
static void kind_of(const struct gltf *gltf, const lam_error *error, char out[100])
{
    size_t used = 0, depth = 0;
    for (const char *at = sentence_of(gltf, error); *at && strncmp(at, ": ", 2) != 0 && used < 99; at++) {
        depth += *at == '[' || *at == '(';
        if (!depth)
            out[used++] = *at;
        depth -= depth && (*at == ']' || *at == ')');
    }
    out[used] = 0;
}

// Returns whether an error only follows from a problem that is already noted: it concerns a value inside the wrong value,
// or it names the wrong member of its object.
static bool follows(const struct gltf *gltf, const lam_error *error, const lam_error *noted)
{
    const char *here = sentence_of(gltf, error), *there = sentence_of(gltf, noted);
    const char *end = strstr(here, ": "), *other_end = strstr(there, ": ");
    if (!end || !other_end || end - here == other_end - there)
        return false;
    bool inside = end - here > other_end - there;
    size_t length = (size_t)(inside ? other_end - there : end - here);
    const char after = (inside ? here : there)[length];
    if (memcmp(here, there, length) != 0 || !(after == '.' || (inside && after == '[')))
        return false;
    char member[64]; // the key of the wrong member
    snprintf(member, sizeof member, "%.*s", inside ? 0 : (int)(other_end - there - (ptrdiff_t)length - 1),
             there + length + 1);
    return strstr(end, member) != NULL; // inside, the key is ""
}

// Counts the error that was just reported as a problem of a kind (NULL: the error's own), and clears the error.
static void note_error(struct gltf *gltf, const char *kind, const char *end)
{
    lam_error *error = gltf->json.error;
    struct gltf_problem **at = &gltf->problems;
    char own[100];
    kind_of(gltf, error, own);
    kind = kind ? kind : own;
    for (const struct gltf_problem *p = gltf->problems; p; p = p->next)
        if (follows(gltf, error, &p->first) || follows(gltf, error, &p->last)) {
            *error = (lam_error){0};
            return;
        }
    int kinds = 0;
    for (; *at && strcmp((*at)->kind, kind) != 0; kinds++)
        at = &(*at)->next;
    if (!*at && kinds < SCENE_WARNINGS_MAX && (*at = GLTF_ALLOC(gltf, 1, struct gltf_problem))) {
        snprintf((*at)->kind, sizeof own, "%s", kind);
        (*at)->end = end;
        (*at)->first = *error;
    }
    if (*at && strcmp((*at)->last.text, error->text) != 0) { // a value that is read twice counts once
        (*at)->last = *error;
        (*at)->count++;
    }
    *error = (lam_error){0};
}

void gltf_note(struct gltf *gltf, const struct place *place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    json_vfail(&gltf->json, place, format, arguments);
    va_end(arguments);
    note_error(gltf, NULL, "");
}

void gltf_note_wrong(struct gltf *gltf, const struct place *place, const json_t *found, const char *expected)
{
    json_unexpected(&gltf->json, place, found, expected);
    note_error(gltf, NULL, "; drawn without it");
}

bool gltf_forgive(struct gltf *gltf)
{
    if (!texture_is_optional(gltf->json.error))
        return false;
    note_error(gltf, NULL, "; drawn without it");
    return true;
}

bool gltf_warn_problems(struct gltf *gltf, const char *otherwise)
{
    const struct gltf_problem *first = gltf->problems;
    if (!gltf->scene->objects.count)
        return fail(gltf->json.error, first ? first->first.code : LAM_CANNOT_READ, "%s: %s%s%s", gltf->source->name,
                    otherwise, first ? "; " : "", first ? sentence_of(gltf, &first->first) : "");
    for (const struct gltf_problem *p = first; p; p = p->next)
        if (p->count > 1)
            scene_warn(gltf->scene, "%s%s (and %zu more of this kind)", p->first.text, p->end, p->count - 1);
        else
            scene_warn(gltf->scene, "%s%s", p->first.text, p->end);
    return true;
}

// --- optional values

int gltf_take_link(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                   const char *list)
{
    const json_t *all = json_object_get(gltf->root, list);
    int index = -1;
    if ((!all || json_is_array(all)) && !gltf_take_index(gltf, place, object, key, list, &index))
        gltf_forgive(gltf); // a list that is none was noted by check_lists
    return index;
}

void gltf_take_numbers(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double *out)
{
    double found[16];
    const json_t *value = json_object_get(object, key);
    if (!value)
        return;
    if (json_numbers_of(&gltf->json, KEY_OF(place, key), value, count, count, found, NULL))
        memcpy(out, found, count * sizeof *out);
    else
        gltf_forgive(gltf);
}

void gltf_take_factors(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double min, double max, double *out)
{
    const double rounding = 1e-3, standard = 1e6;
    const json_t *value = json_object_get(object, key);
    if (count > 1)
        gltf_take_numbers(gltf, place, object, key, count, out);
    else if (value && !json_number_of(&gltf->json, KEY_OF(place, key), value, -HUGE_VAL, HUGE_VAL, out))
        gltf_forgive(gltf);
    for (size_t i = 0; value && i < count; i++) {
        double found = out[i];
        out[i] = found < min ? min : found > max ? max : found;
        if (!(fabs(found - out[i]) > rounding))
            continue;
        json_fail(&gltf->json, KEY_OF(place, key), "found %g%s; %g is used", found,
                  fabs(out[i]) < standard ? ", which the standard does not allow" : "", out[i]);
        note_error(gltf, "factors", "");
    }
}

void gltf_take_field(struct gltf *gltf, const struct place *place, const json_t *object, const lam_field *field,
                     bool encoded, void *to)
{
    double numbers[4];
    int count = lam_field_get(field, to, numbers);
    if (!json_object_get(object, field->key) || field->type == LAM_FIELD_ANGLE)
        return;
    gltf_take_factors(gltf, place, object, field->key, (size_t)count, field->min < -1e30 ? -1e30 : field->min,
                      field->max > 1e30 ? 1e30 : field->max, numbers);
    for (int i = 0; i < 3 && count > 1 && encoded && gltf->source->params->color != LAM_COLOR_RAW; i++)
        numbers[i] = numbers[i] < 1 ? srgb_linear(numbers[i]) : numbers[i];
    lam_field_set(field, to, numbers);
}

void gltf_take_word(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                    const struct json_choice *words, int *out)
{
    if (!json_take_word(&gltf->json, place, object, key, words, out))
        gltf_forgive(gltf);
}

bool gltf_take_flag(struct gltf *gltf, const struct place *place, const json_t *object, const char *key, bool missing)
{
    bool flag = missing;
    return json_take_bool(&gltf->json, place, object, key, &flag) ? flag : (gltf_forgive(gltf), missing);
}

bool gltf_take_weights(struct gltf *gltf, const struct place *place, const json_t *object, double **out, size_t *count)
{
    const json_t *value = json_object_get(object, "weights");
    *out = NULL;
    *count = json_array_size(value);
    if (!value)
        return true;
    *out = GLTF_ALLOC(gltf, *count, double);
    if (!*out)
        return gltf_no_memory(gltf, *count * sizeof **out);
    if (json_numbers_of(&gltf->json, KEY_OF(place, "weights"), value, 0, SIZE_MAX, *out, count))
        return true;
    *out = NULL;
    *count = 0;
    return gltf_forgive(gltf);
}

const json_t *gltf_take_object(struct gltf *gltf, const struct place *place, const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    if (value && !json_is_object(value))
        gltf_note_wrong(gltf, KEY_OF(place, key), value, "an object, { … }");
    return json_is_object(value) ? value : NULL;
}

const json_t *gltf_take_list(struct gltf *gltf, const struct place *place, const json_t *object, const char *key)
{
    const json_t *list = json_object_get(object, key);
    const struct place *here = KEY_OF(place, key);
    if (list && !json_is_array(list))
        gltf_note_wrong(gltf, here, list, "a list of objects");
    for (size_t i = 0; i < json_array_size(list); i++)
        if (!json_is_object(json_array_get(list, i)))
            gltf_note_wrong(gltf, ELEMENT_OF(here, i), json_array_get(list, i), "an object, { … }");
    return list;
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
    char known[400] = "", shown[SHOWN_NAME_SIZE], near[SHOWN_NAME_SIZE];
    struct spelling spelling = spelling_of(wanted);
    for (size_t i = 0; i < count; i++)
        if (name_of(list, i) && strlen(wanted) <= 60 && strlen(name_of(list, i)) <= 60)
            spelling_try(&spelling, name_of(list, i));
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
    const char *nearest = spelling.nearest ? shown_name(spelling.nearest, near) : NULL;
    fail(gltf->json.error, LAM_BAD_ARGUMENT, "%s: there is no %s '%s'; %s%s%s%s%s", gltf->source->name, what,
         shown_name(wanted, shown), nearest ? "did you mean '" : "", nearest ? nearest : "", nearest ? "'? " : "",
         count ? "expected one of " : "the file contains none", known);
    return -1;
}
