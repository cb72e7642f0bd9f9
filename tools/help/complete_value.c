// complete_value.c: prints candidates, and completes the values of options: words, files, colours, materials, lights,
// cameras.
#include "complete.h"

#include <stdio.h>
#include <string.h>

#include <lambent/fields.h>
#include <lambent/light.h>
#include <lambent/material.h>
#include <lambent/words.h>

#include "sheet.h"
#include "sweep_option.h"

void complete_offer(const struct typed_word *typed, const char *candidate, const char *ending, const char *summary)
{
    if (strncmp(candidate, typed->prefix, strlen(typed->prefix)) != 0)
        return;
    printf("%.*s%s%s\t", typed->before_length, typed->before, candidate, ending);
    for (const char *s = summary ? summary : ""; *s; s++)
        if (*s != '`')
            putchar(*s);
    putchar('\n');
}

void complete_files(void) { printf(":files\n"); }

// Moves the first `complete` bytes of `prefix` to the end of `before`, and returns the result.
static struct typed_word after(const struct typed_word *typed, size_t complete)
{
    return (struct typed_word){typed->before, typed->prefix + complete, typed->before_length + (int)complete};
}

// Moves the text of `prefix` up to the last comma to the end of `before`, and returns the result.
static struct typed_word after_comma(const struct typed_word *typed)
{
    const char *comma = strrchr(typed->prefix, ',');
    return after(typed, comma ? (size_t)(comma + 1 - typed->prefix) : 0);
}

static void complete_words(const struct choice *words, const struct typed_word *typed)
{
    for (const struct choice *w = words; w->name; w++) {
        // In "light:NAME", the user chooses NAME, so the candidate ends after the colon.
        char fixed[64];
        snprintf(fixed, sizeof fixed, "%s", w->name);
        char *colon = strchr(fixed, ':');
        if (colon && colon[1] >= 'A' && colon[1] <= 'Z')
            colon[1] = 0;
        complete_offer(typed, fixed, "", w->summary);
    }
}

static void complete_color(const struct typed_word *typed)
{
    for (int i = 0; lam_color_name(i); i++)
        complete_offer(typed, lam_color_name(i), "", NULL);
}

static void complete_field(const lam_field *field, const char *key, const struct typed_word *value)
{
    if (field ? field->type == LAM_FIELD_RGB || field->type == LAM_FIELD_RGBA : strstr(key, "color") != NULL)
        complete_color(value);
    if (field && field->type == LAM_FIELD_FLAG) {
        complete_offer(value, "yes", "", NULL);
        complete_offer(value, "no", "", NULL);
    }
}

static const lam_field *field_of(const lam_field *(*row)(int), const char *key, size_t length)
{
    for (int i = 0; row(i); i++)
        if (strlen(row(i)->key) == length && memcmp(row(i)->key, key, length) == 0)
            return row(i);
    return NULL;
}

static void offer_key(const struct typed_word *typed, const char *key, const lam_field *(*row)(int))
{
    const lam_field *field = field_of(row, key, strlen(key));
    complete_offer(typed, key, "=", field ? field->summary : NULL);
}

static void complete_material(const struct typed_word *typed)
{
    if (strchr(typed->prefix, '@')) // no model is on the command line, so the names of its objects are unknown
        return;
    struct typed_word pair = after_comma(typed);
    size_t equals = strcspn(pair.prefix, "=");
    if (pair.prefix[equals]) {
        struct typed_word value = after(&pair, equals + 1);
        char key[64];
        snprintf(key, sizeof key, "%.*s", (int)equals, pair.prefix);
        complete_field(field_of(lam_material_field, pair.prefix, equals), key, &value);
        return;
    }
    if (pair.prefix == typed->prefix) {
        for (int i = 0; i < LAM_MATERIAL_COUNT; i++)
            complete_offer(&pair, lam_material_name((lam_material_id)i), "", "a material");
        complete_offer(&pair, "glass", "", "a material");
        complete_color(&pair);
    }
    for (int i = 0; lam_material_key(i); i++)
        offer_key(&pair, lam_material_key(i), lam_material_field);
}

static void complete_light_key(lam_light_type type, const struct typed_word *typed)
{
    struct typed_word pair = after_comma(typed);
    size_t equals = strcspn(pair.prefix, "=");
    if (!pair.prefix[equals]) {
        for (int i = 0; lam_light_key(type, i); i++)
            offer_key(&pair, lam_light_key(type, i), lam_light_field);
        return;
    }
    struct typed_word value = after(&pair, equals + 1);
    char key[64];
    snprintf(key, sizeof key, "%.*s", (int)equals, pair.prefix);
    if (strcmp(key, "frame") == 0) {
        complete_offer(&value, "world", "", "the frame of the scene");
        complete_offer(&value, "camera", "", "the frame of the eye");
        complete_offer(&value, "view", "", "the axes of the camera, from the middle of the scene");
        complete_offer(&value, "object", "", "the frame of the model");
    }
    complete_field(field_of(lam_light_field, pair.prefix, equals), key, &value);
}

static void complete_light(const struct typed_word *typed)
{
    struct typed_word type = after(typed, *typed->prefix == '+');
    size_t length = strcspn(type.prefix, ":");
    if (type.prefix == typed->prefix)
        complete_offer(&type, "none", "", "only ambient light");
    for (int i = 0; i < LAM_LIGHT_TYPE_COUNT; i++) {
        const char *candidate = lam_light_type_describe((lam_light_type)i)->word;
        if (!type.prefix[length]) {
            complete_offer(&type, candidate, "", NULL);
            complete_offer(&type, candidate, ":", NULL);
        } else if (strlen(candidate) == length && memcmp(candidate, type.prefix, length) == 0) {
            struct typed_word keys = after(&type, length + 1);
            complete_light_key((lam_light_type)i, &keys);
        }
    }
}

static void complete_camera(const struct typed_word *typed)
{
    struct typed_word pair = after_comma(typed);
    for (int i = 0; lam_camera_key(i); i++)
        complete_offer(&pair, lam_camera_key(i), "=", NULL);
}

static void complete_environment(const struct typed_word *typed)
{
    for (int i = 0; lam_environment_built_in_name(i); i++)
        complete_offer(typed, lam_environment_built_in_name(i), "", "built in");
    complete_offer(typed, "none", "", "no environment");
    complete_files();
}

// Completes "OPTION", or "OPTION=value,value".
static void complete_varied(const struct typed_word *typed)
{
    size_t length = strcspn(typed->prefix, "=");
    for (const struct option *o = option_table; o->name; o++) {
        if (!sheet_varies(o))
            continue;
        if (!typed->prefix[length]) {
            if (o->words || !o->value)
                complete_offer(typed, o->name, "", o->summary);
            if (o->value)
                complete_offer(typed, o->name, "=", o->summary);
        } else if (strlen(o->name) == length && memcmp(o->name, typed->prefix, length) == 0) {
            struct typed_word values = after(typed, length + 1);
            if (o->words || o->kind == VALUE_COLOR)
                values = after_comma(&values);
            complete_value(o, &values);
        }
    }
    for (int i = 0; !typed->prefix[length] && lam_material_field(i); i++)
        complete_offer(typed, lam_material_field(i)->key, "=", lam_material_field(i)->summary);
}

// Completes "KEY=" of --sweep.
static void complete_swept(const struct typed_word *typed)
{
    static const char *const others[] = {"rotate.x",      "rotate.y",        "rotate.z",
                                         "light.azimuth", "light.elevation", "light.intensity"};
    for (const struct option *o = option_table; o->name; o++)
        if (sweep_takes_option(o))
            complete_offer(typed, o->name, "=", o->summary);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        complete_offer(typed, others[i], "=", NULL);
    for (int i = 0; lam_material_key(i); i++)
        if (!option_find(lam_material_key(i)))
            complete_offer(typed, lam_material_key(i), "=", NULL);
}

void complete_value(const struct option *option, const struct typed_word *typed)
{
    if (option->words)
        complete_words(option->words, typed);
    switch (option->kind) {
    case VALUE_ANY:
        return;
    case VALUE_FILE:
        complete_files();
        return;
    case VALUE_COLOR:
        complete_color(typed);
        if (option->store == store_color)
            complete_offer(typed, "transparent", "", NULL);
        return;
    case VALUE_MATERIAL:
        complete_material(typed);
        return;
    case VALUE_LIGHT:
        complete_light(typed);
        return;
    case VALUE_CAMERA:
        complete_camera(typed);
        return;
    case VALUE_ENVIRONMENT:
        complete_environment(typed);
        return;
    case VALUE_VARIED:
        complete_varied(typed);
        return;
    case VALUE_SWEPT:
        complete_swept(typed);
        return;
    }
}
