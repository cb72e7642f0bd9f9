// sweep_option.c: parses --sweep. The keys come from the tables of options, materials and lights.
#include "sweep_option.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/fields.h>
#include <lambent/words.h>

#include "console.h"
#include "material_option.h"

// --- keys

bool sweep_takes_option(const struct option *o)
{
    bool number = o->store == store_number || o->store == store_float || o->store == store_cutoff ||
                  o->store == store_integer || o->store == store_exposure || o->store == store_segments ||
                  o->store == store_color || o->store == store_opaque_color || o->store == store_reflectivity;
    return number && option_is_in(o, IN_PAGE);
}

static bool is_material_key(const char *key)
{
    for (int i = 0; lam_material_key(i); i++)
        if (strcmp(lam_material_key(i), key) == 0)
            return true;
    return false;
}

// Parses "roughness@handle".
static bool take_material(const char *text, struct sweep *sweep)
{
    const char *at = strchr(text, '@');
    snprintf(sweep->key, sizeof sweep->key, "%.*s", at ? (int)(at - text) : (int)strlen(text), text);
    snprintf(sweep->which, sizeof sweep->which, "%s", at ? at + 1 : "");
    sweep->kind = SWEEP_MATERIAL;
    sweep->option = option_find("material");
    return is_material_key(sweep->key) && (!at || at[1]);
}

static const lam_field *light_field(const char *key)
{
    for (int i = 0; lam_light_field(i); i++)
        if (strcmp(lam_light_field(i)->key, key) == 0 && lam_light_field(i)->type != LAM_FIELD_FLAG)
            return lam_light_field(i);
    return NULL;
}

// Returns the index of the field's component that this letter names, or −1.
static int component_of(const lam_field *field, const char *letter)
{
    const char *letters = field->type == LAM_FIELD_RGB                                           ? "rgb"
                          : field->type == LAM_FIELD_TRIPLE                                      ? "abc"
                          : field->type == LAM_FIELD_POINT || field->type == LAM_FIELD_DIRECTION ? "xyz"
                                                                                                 : "";
    const char *found = *letter && !letter[1] ? strchr(letters, *letter) : NULL;
    return found ? (int)(found - letters) : -1;
}

// Parses "azimuth", "range" or "position.x".
static bool take_light_number(const char *text, struct sweep *sweep)
{
    static const char *const others[] = {[SWEEP_LIGHT_AZIMUTH] = "azimuth",
                                         [SWEEP_LIGHT_ELEVATION] = "elevation",
                                         [SWEEP_LIGHT_INTENSITY] = "intensity"};
    for (int i = SWEEP_LIGHT_AZIMUTH; i <= SWEEP_LIGHT_INTENSITY; i++)
        if (strcmp(text, others[i]) == 0) {
            sweep->light = (enum sweep_light)i;
            return true;
        }
    char key[SWEEP_NAME_MAX];
    const char *dot = strchr(text, '.');
    snprintf(key, sizeof key, "%.*s", dot ? (int)(dot - text) : (int)strlen(text), text);
    const lam_field *field = light_field(key);
    if (!field)
        return false;
    sweep->field = field->key;
    sweep->component = dot ? component_of(field, dot + 1) : -1;
    bool several =
        field->type == LAM_FIELD_POINT || field->type == LAM_FIELD_DIRECTION || field->type == LAM_FIELD_TRIPLE;
    return dot ? sweep->component >= 0 : !several;
}

// Parses "light.azimuth", "light.2.azimuth" or "light.key.diffuse.r".
static bool take_light(const char *text, struct sweep *sweep)
{
    sweep->kind = SWEEP_LIGHT;
    sweep->component = -1;
    if (take_light_number(text, sweep))
        return true;
    // A light's name may contain dots.
    for (const char *dot = strchr(text, '.'); dot; dot = strchr(dot + 1, '.'))
        if (dot > text && take_light_number(dot + 1, sweep)) {
            snprintf(sweep->which, sizeof sweep->which, "%.*s", (int)(dot - text), text);
            return true;
        }
    return false;
}

static bool unknown_light(const char *key, lam_error *error)
{
    char known[400] = "azimuth, elevation, intensity";
    for (int i = 0; lam_light_field(i); i++) {
        const lam_field *field = lam_light_field(i);
        bool before = false;
        for (int k = 0; k < i; k++)
            before |= strcmp(lam_light_field(k)->key, field->key) == 0;
        const char *component = field->type == LAM_FIELD_TRIPLE                                        ? ".a"
                                : field->type == LAM_FIELD_POINT || field->type == LAM_FIELD_DIRECTION ? ".x"
                                                                                                       : "";
        size_t used = strlen(known);
        if (!before && field->type != LAM_FIELD_FLAG)
            snprintf(known + used, sizeof known - used, ", %s%s", field->key, component);
    }
    return complain(
        error, LAM_BAD_ARGUMENT,
        "found '%.80s', expected light.NUMBER or light.WHICH.NUMBER: WHICH is a light's name or number from "
        "1, NUMBER one of %s",
        key, known);
}

static bool unknown_key(const char *key, lam_error *error)
{
    const struct option *option = option_find(key);
    if (option)
        return complain(error, LAM_BAD_ARGUMENT, "'%s' has no numbers that a sweep can change", key);
    struct suggestion nearest = suggest_start(key);
    for (const struct option *o = option_table; o->name; o++)
        if (sweep_takes_option(o)) {
            suggest_try(&nearest, o->name);
            suggest_also(&nearest, o->name, o->others);
        }
    for (int i = 0; lam_material_key(i); i++)
        suggest_try(&nearest, lam_material_key(i));
    return complain(error, LAM_BAD_ARGUMENT, "unknown key '%.60s'%s%s%s", key, nearest.best ? "; did you mean '" : "",
                    nearest.best ? nearest.best : "",
                    nearest.best
                        ? "'?"
                        : "; expected an option with a number (azimuth), a material's key (roughness), rotate.y "
                          "or light.azimuth");
}

static bool take_key(const char *key, struct sweep *sweep, lam_error *error)
{
    if (strcmp(key, "light") == 0 || strncmp(key, "light.", 6) == 0)
        return take_light(key[5] ? key + 6 : "", sweep) || unknown_light(key, error);
    if (strncmp(key, "rotate.", 7) == 0 && key[7] >= 'x' && key[7] <= 'z' && !key[8]) {
        sweep->kind = SWEEP_ROTATE;
        sweep->option = option_find("rotate");
        snprintf(sweep->key, sizeof sweep->key, "%s", key + 7);
        return true;
    }
    const struct option *option = option_find(key);
    if (option && sweep_takes_option(option)) {
        sweep->option = option;
        sweep->whole = option->store == store_integer || option->store == store_segments;
        return true;
    }
    const char *material = strncmp(key, "material.", 9) == 0 ? key + 9 : key;
    return (!option && take_material(material, sweep)) || unknown_key(key, error);
}

// --- values

static bool is_angle(const struct sweep *sweep)
{
    if (sweep->kind == SWEEP_OPTION)
        return sweep->option->value && strcmp(sweep->option->value, "DEGREES") == 0;
    return sweep->kind == SWEEP_ROTATE || (sweep->kind == SWEEP_LIGHT && sweep->light == SWEEP_LIGHT_AZIMUTH);
}

// Parses "0..360" or "10..60..10".
static bool take_stops(const char *text, struct sweep *sweep, lam_error *error)
{
    static const char *const form = "expected two numbers with two dots between them, such as 0..360";
    for (const char *at = text;;) {
        const char *dots = strstr(at, "..");
        char number[64];
        snprintf(number, sizeof number, "%.*s", dots ? (int)(dots - at) : (int)strlen(at), at);
        if (sweep->stop_count == SWEEP_STOPS_MAX)
            return complain(error, LAM_BAD_ARGUMENT, "more than %d values", SWEEP_STOPS_MAX);
        const char *end = read_number(number, &sweep->stops[sweep->stop_count++]);
        if (!end || *end)
            return complain(error, LAM_BAD_ARGUMENT, "found '%.80s', %s", text, form);
        if (!dots)
            break;
        at = dots + 2;
    }
    if (sweep->stop_count < 2)
        return complain(error, LAM_BAD_ARGUMENT, "found '%.80s', %s", text, form);
    double way = sweep->stops[sweep->stop_count - 1] - sweep->stops[0], turns = way / 360;
    sweep->closed = way == 0 || (is_angle(sweep) && turns >= -1e6 && turns <= 1e6 && turns == (double)(long)turns);
    return true;
}

// Checks each stop with the option's own parser. Values between two valid stops are also valid.
static bool check_stops(const struct sweep *sweep, lam_error *error)
{
    for (int i = 0; i < sweep->stop_count && sweep->option; i++) {
        struct sweep one = {.kind = sweep->kind, .option = sweep->option, .stops = {sweep->stops[i]}, .stop_count = 1};
        struct sweep_words words;
        struct options unused = option_defaults();
        memcpy(one.key, sweep->key, sizeof one.key);
        memcpy(one.which, sweep->which, sizeof one.which);
        sweep_words(&one, 0, 1, &words);
        bool ok = sweep->option->store(sweep->option, words.value, &unused, error);
        options_free(&unused);
        if (!ok)
            return false;
    }
    return true;
}

bool sweep_parse(const char *text, struct sweep *sweep, lam_error *error)
{
    char key[SWEEP_NAME_MAX];
    const char *equals = strchr(text, '=');
    size_t length = equals ? (size_t)(equals - text) : strlen(text);
    *sweep = (struct sweep){.kind = SWEEP_OPTION};
    if (length >= sizeof key)
        return complain(error, LAM_BAD_ARGUMENT, "its key is %zu letters long, expected less than %zu", length,
                        sizeof key);
    snprintf(key, sizeof key, "%.*s", (int)length, text);
    if (!take_key(key, sweep, error))
        return false;
    if (!equals && strcmp(key, "time") == 0)
        return true;
    if (!equals)
        return complain(error, LAM_BAD_ARGUMENT, "found '%s', expected %s=FROM..TO", key, key);
    return take_stops(equals + 1, sweep, error) && check_stops(sweep, error);
}

bool sweep_is_option(const struct sweep *sweep, const char *name)
{
    return sweep->kind == SWEEP_OPTION && strcmp(sweep->option->name, name) == 0;
}

double sweep_value(const struct sweep *sweep, int frame, int count)
{
    int parts = sweep->stop_count - 1;
    if (parts < 1)
        return sweep->stops[0];
    int steps = sweep->closed || count < 2 ? count : count - 1; // the number of steps from the first stop to the last
    int64_t at = (int64_t)frame * parts, part = at / steps, rest = at % steps;
    if (part >= parts)
        return sweep->stops[parts];
    double value = sweep->stops[part] + (sweep->stops[part + 1] - sweep->stops[part]) * (double)rest / steps;
    return sweep->whole ? (double)(int64_t)(value + (value < 0 ? -0.5 : 0.5)) : value;
}

bool sweep_words(const struct sweep *sweep, int frame, int count, struct sweep_words *words)
{
    if (!sweep->option)
        return false;
    double value = sweep_value(sweep, frame, count);
    snprintf(words->option, sizeof words->option, "--%s", sweep->option->name);
    switch (sweep->kind) {
    case SWEEP_ROTATE:
        snprintf(words->value, sizeof words->value, "%s:%.17g", sweep->key, value);
        break;
    case SWEEP_MATERIAL:
        snprintf(words->value, sizeof words->value, "%s=%.17g%s%s", sweep->key, value, *sweep->which ? "@" : "",
                 sweep->which);
        break;
    default:
        snprintf(words->value, sizeof words->value, "%.17g", value);
    }
    return true;
}
