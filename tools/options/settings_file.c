// settings_file.c: reads lambent.json, which contains the user's own defaults. Its keys are the keys of scene files.
// The table of settings lists each key and its option in the same row.
#include "settings_file.h"

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console.h"
#include "environment_option.h"
#include "file_io.h"
#include "json.h"

enum { FILE_MAX = 1 << 16, NAME_SIZE = 40 };

// Scene-file keys that are members of a group, or whose option has a different name.
static const struct {
    const char *group, *key, *option;
} grouped[] = {{"image", "size", "size"},
               {"image", "samples", "samples"},
               {"image", "background", "background"},
               {"image", "color_mode", "color-mode"},
               {"image", "exposure", "exposure"},
               {"image", "tone", "tone"},
               {"environment", "builtin", "environment"},
               {"environment", "rotation", "environment-rotation"},
               {"reflection_map", "builtin", "reflection-map"},
               {"reflection_map", "rotation", "environment-rotation"}};

enum { GROUPED = sizeof grouped / sizeof *grouped };

struct settings_parser {
    struct options *options;
    const struct options *before; // the options of the command line and the look
    const char *path, *text;
    const json_t *ground_color; // the ground's colour, set together with "ground", or NULL
    char *values;               // the end of the stored values
    lam_error *error;
};

// --- the position of a key

// Returns the line of a key in valid JSON text; `group` is the object that contains the key, or NULL for the top level.
// Returns line 1 if the key contains escapes in the text.
static int line_of(const char *text, const char *group, const char *key)
{
    int line = 1, depth = 0;
    bool inside = false; // whether the position is inside the group
    for (const char *at = text; *at; at++) {
        line += *at == '\n';
        depth += (*at == '{' || *at == '[') - (*at == '}' || *at == ']');
        if (*at != '"')
            continue;
        const char *name = ++at;
        while (*at != '"')
            at += *at == '\\' ? 2 : 1;
        size_t length = (size_t)(at - name);
        if (at[1 + strspn(at + 1, " \t\r\n")] != ':')
            continue;
        if (depth == 1 && group)
            inside = strlen(group) == length && memcmp(group, name, length) == 0;
        if ((group ? depth == 2 && inside : depth == 1) && strlen(key) == length && memcmp(key, name, length) == 0)
            return line;
    }
    return 1;
}

static bool wrong(struct settings_parser *r, const char *group, const char *key, const char *reason)
{
    return complain(r->error, LAM_CANNOT_READ, "%.300s:%d: %s%s%.60s: %.300s", r->path, line_of(r->text, group, key),
                    group ? group : "", group ? "." : "", key, reason);
}

static bool unknown_key(struct settings_parser *r, const char *group, const char *key)
{
    const lam_setting *setting;
    char text[200], keys[100] = "image, environment or a setting of a scene file (docs/settings.md lists them)";
    const char *other = NULL; // the group that contains a key of this name
    struct suggestion nearest = suggest_start(key);
    *keys = group ? 0 : *keys;
    for (int i = 0; i < GROUPED; i++) {
        if (group && strcmp(grouped[i].group, group) == 0) {
            suggest_try(&nearest, grouped[i].key);
            snprintf(keys + strlen(keys), sizeof keys - strlen(keys), "%s%s", *keys ? ", " : "", grouped[i].key);
        } else if (strcmp(grouped[i].key, key) == 0) {
            other = grouped[i].group;
        }
    }
    for (int i = 0; !group && (setting = lam_draw_setting(i)); i++)
        suggest_try(&nearest, setting->key);
    if (other || (group && lam_draw_setting_find(key) >= 0))
        snprintf(text, sizeof text, "unknown key; did you mean '%s%s%.60s'?", other ? other : "", other ? "." : "",
                 key);
    else if (nearest.best)
        snprintf(text, sizeof text, "unknown key; did you mean '%s'?", nearest.best);
    else
        snprintf(text, sizeof text, "unknown key, expected %s%s", group ? "one of " : "", keys);
    return wrong(r, group, key, text);
}

// --- values as text for options

static const char *kind_of(const json_t *value)
{
    static const char *const kinds[] = {"an object", "a list", "a string", "a number",
                                        "a number",  "true",   "false",    "null"};
    return kinds[json_typeof(value)];
}

static void put_number(FILE *out, const json_t *value)
{
    char text[32];
    shortest_number(json_number_value(value), text);
    fputs(text, out);
}

// Writes a value of a scene file as it would appear on a command line, where the option's parser checks it. Returns false
// for values that an option cannot have.
static bool put_value(FILE *out, const struct option *option, const json_t *value)
{
    const lam_setting *setting = option->setting;
    bool words = setting && setting->type == LAM_SETTING_WORDS,
         on_off = setting && setting->type == LAM_SETTING_NOT_FLAG;
    size_t i;
    json_t *item;
    json_array_foreach(value, i, item)
    {
        fputs(!i ? "" : option->store == store_size ? "x" : words ? "," : "/", out);
        if (json_is_array(item) || !put_value(out, option, item))
            return false;
    }
    if (words && json_is_array(value) && !i)
        fputs("none", out);
    if (json_is_string(value))
        fputs(json_string_value(value), out);
    else if (json_is_number(value))
        put_number(out, value);
    else if (json_is_boolean(value))
        fputs(json_is_true(value) ? (on_off ? "on" : "true") : on_off ? "off" : "false", out);
    return !json_is_null(value) && !json_is_object(value);
}

// Returns the kind of value that an option needs, or NULL if `value` may be suitable.
static const char *expected_of(const struct option *option, const json_t *value)
{
    bool is_list = option->store == store_size || (option->setting && option->setting->type == LAM_SETTING_WORDS);
    if (!option->value)
        return json_is_boolean(value) ? NULL : "true or false";
    return is_list && !json_is_array(value) ? "a list" : NULL;
}

// --- one key

// Returns whether the command line or a look already sets `option`, or another option that must match `option`.
static bool is_decided(const struct settings_parser *r, const struct option *option)
{
    const char *name = option->name, *pair = strcmp(name, "shading") == 0 ? "stage"
                                             : strcmp(name, "stage") == 0 ? "shading"
                                             : option->replaces           ? option->replaces
                                                                          : name;
    static const char *const phong_only[] = {"ground", "cavity", "specular-aa"};
    lam_stage stage = r->before->draw.stage;
    bool by_vertex =
        r->before->draw.shading != LAM_SHADING_PHONG || stage == LAM_STAGE_VERTEX || stage == LAM_STAGE_APPLICATION;
    for (size_t i = 0; by_vertex && i < sizeof phong_only / sizeof *phong_only; i++)
        if (strcmp(name, phong_only[i]) == 0)
            return true; // the command line, or the look on the command line, excludes this setting
    return option_given(r->before, name) || option_given(r->before, pair) ||
           (strcmp(name, "size") == 0 && r->before->batch.size_count);
}

static bool take_value(struct settings_parser *r, const char *group, const char *key, const struct option *option,
                       const json_t *value)
{
    char reason[400], *text = r->values, *made = NULL;
    const char *expected = expected_of(option, value);
    size_t size = 0;
    FILE *out = open_memstream(&made, &size);
    bool ok = out && !expected && put_value(out, option, value);
    ok = out && fclose(out) == 0 && ok && size < FILE_MAX; // the space that remains in `values`
    strcpy(text, ok ? made : "");
    free(made);
    if (!ok) {
        snprintf(reason, sizeof reason, "found %s, expected %s", kind_of(value),
                 expected ? expected : "a string, a number or a list");
        return wrong(r, group, key, reason);
    }
    if (option->kind == VALUE_ENVIRONMENT && !environment_option_built_in(text))
        return wrong(r, group, key, "found a file, expected the name of a built-in environment, such as \"studio\"");
    const char *given = option->value ? text : NULL;
    bool decided = is_decided(r, option) || (!given && json_is_false(value));
    struct options scratch = *r->options; // an overridden value is checked too
    lam_error found = {0};
    if (given || !decided)
        if (!option->store(option, given, decided ? &scratch : r->options, &found))
            return wrong(r, group, key, found.text);
    if (decided)
        return true;
    size_t row = (size_t)(option - option_table);
    r->options->by_config[row] = line_of(r->text, group, key);
    r->options->values[row] = given;
    r->values += strlen(text) + 1;
    return true;
}

// Sets the ground plane. For the kind "color", the key "ground_color" contains the colour.
static bool take_ground(struct settings_parser *r, const json_t *value)
{
    const struct option *option = option_find("ground");
    bool color = json_is_string(value) && strcmp(json_string_value(value), "color") == 0;
    if (!color && r->ground_color)
        return wrong(r, NULL, "ground_color", "expected \"ground\": \"color\" as well");
    return take_value(r, NULL, "ground", option, color && r->ground_color ? r->ground_color : value);
}

static bool take_key(struct settings_parser *r, const char *group, const char *key, const json_t *value)
{
    char name[NAME_SIZE];
    for (int i = 0; group && i < GROUPED; i++)
        if (strcmp(grouped[i].group, group) == 0 && strcmp(grouped[i].key, key) == 0)
            return take_value(r, group, key, option_find(grouped[i].option), value);
    if (group || lam_draw_setting_find(key) < 0)
        return unknown_key(r, group, key);
    if (strcmp(key, "ground") == 0)
        return take_ground(r, value);
    if (strcmp(key, "ground_color") == 0) // already handled together with "ground"
        return r->ground_color != NULL;
    snprintf(name, sizeof name, "%s", key);
    for (char *c = name; *c; c++)
        *c = *c == '_' ? '-' : *c;
    return take_value(r, NULL, key, option_find(name), value);
}

static bool take_group(struct settings_parser *r, const char *group, json_t *object)
{
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value)
    {
        if (!take_key(r, group, key, value))
            return false;
    }
    return true;
}

static bool take_root(struct settings_parser *r, json_t *root)
{
    const char *key;
    json_t *value;
    r->ground_color = json_object_get(root, "ground_color");
    if (r->ground_color && !json_object_get(root, "ground"))
        return wrong(r, NULL, "ground_color", "expected \"ground\": \"color\" as well");
    json_object_foreach(root, key, value)
    {
        bool is_group = false;
        for (int i = 0; i < GROUPED; i++)
            is_group |= strcmp(key, grouped[i].group) == 0;
        if (is_group && !json_is_object(value))
            return wrong(r, NULL, key, "expected an object, as in scene files");
        if (strcmp(key, "lambent") == 0 && !(json_is_integer(value) && json_integer_value(value) == 1))
            return wrong(r, NULL, key, "expected 1, the version of the format");
        if (strcmp(key, "lambent") != 0 && !(is_group ? take_group(r, key, value) : take_key(r, NULL, key, value)))
            return false;
    }
    return true;
}

// --- the file

// Accepts only absolute paths, because a relative path could lead to a file beside a model.
static void default_path(char *path, size_t size)
{
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    int length = 0;
    if (config && *config == '/')
        length = snprintf(path, size, "%s/lambent/lambent.json", config);
    else if (home && *home == '/')
        length = snprintf(path, size, "%s/.config/lambent/lambent.json", home);
    if (length <= 0 || (size_t)length >= size)
        *path = 0;
}

// Returns the text of the file, allocated with malloc.
static char *read_text(const char *path, size_t *length, lam_error *error)
{
    uint64_t unused;
    int file = open_regular(path, &unused);
    if (file < 0 && errno == 0)
        return complain(error, LAM_CANNOT_READ, "%.300s: not a regular file, expected settings (JSON)", path), NULL;
    char *text = file >= 0 ? malloc(FILE_MAX + 2) : NULL;
    bool read = text && read_up_to(file, text, FILE_MAX + 1, length);
    if (!read)
        complain(error, LAM_CANNOT_READ, "%.300s: cannot read: %s", path, strerror(errno));
    else if (*length > FILE_MAX)
        complain(error, LAM_CANNOT_READ, "%.300s: longer than 64 KiB, expected settings", path);
    if (file >= 0)
        close(file);
    if (read && *length <= FILE_MAX) {
        text[*length] = 0;
        return text;
    }
    free(text);
    return NULL;
}

static bool apply_text(struct settings_parser *r, size_t length)
{
    json_error_t reason;
    size_t mark = length >= 3 && memcmp(r->text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0; // a byte order mark
    json_t *root = json_loadb(r->text + mark, length - mark, JSON_REJECT_DUPLICATES, &reason);
    bool ok = json_is_object(root);
    if (!root)
        complain(r->error, LAM_CANNOT_READ, "%.300s:%d: not valid JSON: %.150s", r->path, reason.line, reason.text);
    else if (!ok)
        complain(r->error, LAM_CANNOT_READ, "%.300s:1: found %s, expected an object: { ... }", r->path, kind_of(root));
    ok = ok && take_root(r, root);
    json_decref(root);
    return ok;
}

bool settings_apply(struct options *options, struct options *before, struct settings_source *source, lam_error *error)
{
    const char *ci = getenv("CI"), *named = options->settings.file;
    struct stat about;
    source->path[0] = 0;
    if (named)
        snprintf(source->path, sizeof source->path, "%s", named);
    else
        default_path(source->path, sizeof source->path);
    if (named && options->settings.none)
        return complain(error, LAM_BAD_ARGUMENT, "found --config and --no-config, expected one of them");
    source->state = options->settings.none            ? SETTINGS_OFF
                    : named                           ? SETTINGS_READ
                    : ci && *ci                       ? SETTINGS_CI
                    : stat(source->path, &about) != 0 ? SETTINGS_MISSING
                                                      : SETTINGS_READ;
    if (source->state != SETTINGS_READ)
        return true;
    size_t length;
    *before = *options;
    options->settings.without = before;
    char *text = read_text(source->path, &length, error);
    options->settings.values = text ? malloc(3 * FILE_MAX) : NULL;
    struct settings_parser reader = {options, before, source->path, text, NULL, options->settings.values, error};
    bool ok = text && (options->settings.values || complain(error, LAM_MACHINE, "out of memory")) &&
              apply_text(&reader, length);
    free(text);
    options->picture.has_size = before->picture.has_size; // sheets and scene files set their own sizes
    return ok;
}
