// options.c: parses a command line with the table of options. It is longer than 600 lines because each way of writing an option, and
// the sentence about each mistake in it, is one short function.
#include "options.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/animation.h>
#include <lambent/render.h>

#include "command_table.h"
#include "console.h"
#include "limit_options.h"

struct options option_defaults(void)
{
    return (struct options){.picture.width = LAM_RENDER_SIZE,
                            .picture.height = LAM_RENDER_SIZE,
                            .shading.crease_angle_deg = -1,
                            .lighting.light_scale = 1,
                            .work.repeat = 1,
                            .print.overhang_deg = 45,
                            .diff.gain = 16,
                            .check.stop_after_s = 10,
                            .check.search_limit = 10000};
}

// The offsets of the lists that struct options owns.
static const size_t lists[] = {offsetof(struct options, lighting.lights),
                               offsetof(struct options, material.materials),
                               offsetof(struct options, material.back_materials),
                               offsetof(struct options, material.hidden),
                               offsetof(struct options, material.only),
                               offsetof(struct options, model.sections),
                               offsetof(struct options, shading.rotations),
                               offsetof(struct options, shading.sheet_rotations),
                               offsetof(struct options, sheet.across),
                               offsetof(struct options, limits.allow_paths),
                               offsetof(struct options, batch.lists),
                               offsetof(struct options, animation.sweeps),
                               offsetof(struct options, captions.texts),
                               offsetof(struct options, check.roles)};

enum { LISTS = sizeof lists / sizeof *lists };

static struct texts *list_at(struct options *options, int index)
{
    return (struct texts *)(void *)((char *)options + lists[index]);
}

void options_free(struct options *options)
{
    for (int i = 0; i < LISTS; i++)
        free(list_at(options, i)->items);
    free(options->lighting.look_text);
    free(options->settings.values);
}

bool options_copy(struct options *to, const struct options *from)
{
    bool ok = true;
    *to = *from;
    to->lighting.look_text = to->settings.values = NULL; // free the copy before the original, which owns the texts
    for (int i = 0; i < LISTS; i++) {
        struct texts *list = list_at(to, i);
        const char **items = malloc(((size_t)list->count + 1) * sizeof *items);
        if (items && list->count)
            memcpy(items, list->items, (size_t)list->count * sizeof *items);
        list->items = items;
        ok = ok && items;
    }
    if (!ok)
        options_free(to);
    return ok;
}

bool option_is_taken(const struct option *option, uint64_t groups)
{
    return groups & (1ull << option->group | option->single) && !(option->of_file && groups & WRITES_NO_FILE);
}

bool option_is_in(const struct option *option, enum option_use use)
{
    uint64_t groups = PICTURE_GROUPS;
    if (use == IN_LOOK)
        groups &= ~(1ull << GROUP_MODEL);
    else if (use == IN_JOB)
        groups |= 1ull << GROUP_ANIMATION;
    else if (use == IN_PAGE)
        groups |= 1ull << GROUP_SHAPE;
    else if (use == IN_SHEET)
        groups ^= 1ull << GROUP_PICTURE | 1ull << GROUP_BATCH | 1ull << GROUP_ANIMATION;
    else if (use == KEEPS_MODEL)
        groups &= ~(1ull << GROUP_MODEL | 1ull << GROUP_SHADING);
    return option->also_in & use || (groups >> option->group & 1 && !(option->not_in & use));
}

static bool is_name(const char *argument, const char *name, size_t length)
{
    return strlen(argument) == length && memcmp(argument, name, length) == 0;
}

static const struct option *find_long(const char *name, size_t length)
{
    for (const struct option *o = option_table; o->name; o++)
        if (is_name(o->name, name, length) || (o->alias && is_name(o->alias, name, length)))
            return o;
    return NULL;
}

// Returns the option that a command with these groups takes. Some names mean different options of different commands.
static const struct option *find_taken(const char *name, size_t length, uint64_t groups)
{
    const struct option *first = find_long(name, length);
    for (const struct option *o = first; o && o->name; o++)
        if (is_name(o->name, name, length) && option_is_taken(o, groups))
            return o;
    return first;
}

static const struct option *find_letter(char letter)
{
    for (const struct option *o = option_table; o->name; o++)
        if (o->letter == letter)
            return o;
    return NULL;
}

const struct option *option_find(const char *name) { return find_long(name, strlen(name)); }

bool option_given(const struct options *options, const char *name)
{
    const struct option *option = option_find(name);
    return option && (options->given[option - option_table] || options->by_key[option - option_table]);
}

// Finds the option that a key in the value of `option` sets: for example, "width" in the value of `edges` sets
// --edge-width. Returns NULL if there is no such option.
static const struct option *find_key(const struct option *option, const char *key, size_t length)
{
    for (const struct option *o = option_table; option->keyed && o->name; o++)
        if (o->key && strcmp(o->now, option->name) == 0 && is_name(o->key, key, length))
            return o;
    return NULL;
}

// Returns whether a text begins with one of the option's keys and an equals sign, and does not name an existing file.
static bool begins_with_key(const struct option *option, const char *text)
{
    size_t length = strcspn(text, "=,");
    return text[length] == '=' && find_key(option, text, length) && access(text, F_OK) != 0;
}

static bool unknown_key(const struct option *option, const char *text, lam_error *error)
{
    char known[100] = "";
    for (const struct option *o = option_table; o->name; o++)
        if (o->key && strcmp(o->now, option->name) == 0)
            snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s=%s", *known ? ", " : "", o->key,
                     o->value);
    return complain(error, LAM_BAD_ARGUMENT, "found '%.100s', expected %s", text, known);
}

// Parses a key with its value, such as "width=2", in the first `length` bytes of a text, and stores the value.
static bool store_key(const struct option *option, const char *text, size_t length, struct options *options,
                      lam_error *error)
{
    char value[64];
    size_t start = strcspn(text, "=") + 1;
    const struct option *key = find_key(option, text, start - 1);
    if (!key || length - start >= sizeof value)
        return unknown_key(option, text, error);
    snprintf(value, sizeof value, "%.*s", (int)(length - start), text + start);
    lam_error reason = {0};
    if (!key->store(key, value, options, &reason))
        return complain(error, LAM_BAD_ARGUMENT, "%s: %.300s", key->key, reason.text);
    if (key->store == store_color)
        *(const char **)((char *)options + key->field) = text + start;
    options->by_key[key - option_table] = true;
    options->values[key - option_table] = text + start;
    return true;
}

// Stores the value of an option, or NULL for a switch. The value may contain keys for other options, as in
// "all,width=2".
static bool option_store(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    char own[256] = "";
    size_t used = 0;
    if (!option->keyed || !value)
        return option->store(option, value, options, error);
    for (const char *at = value; at; at = at[strcspn(at, ",")] ? at + strcspn(at, ",") + 1 : NULL) {
        size_t length = strcspn(at, ",");
        bool key = memchr(at, '=', length) != NULL || !option->value;
        if (key && !store_key(option, at, length, options, error))
            return false;
        if (!key && used < sizeof own)
            used += (size_t)snprintf(own + used, sizeof own - used, "%s%.*s", used ? "," : "", (int)length, at);
    }
    if (!used && option->store == store_words) // only keys
        return option->store(option, "all", options, error);
    return option->store(option, own, options, error);
}

static bool unknown_long(const char *name, size_t length, uint64_t groups, lam_error *error)
{
    char typed[64];
    snprintf(typed, sizeof typed, "%.*s", (int)(length < 60 ? length : 60), name);
    struct suggestion nearest = suggest_start(typed);
    for (const struct option *o = option_table; o->name; o++)
        if (option_is_taken(o, groups)) {
            if (!o->now)
                suggest_try(&nearest, o->name);
            suggest_also(&nearest, o->name, o->others);
            suggest_also(&nearest, o->name, o->also);
        }
    const struct option *meant = nearest.best ? option_find(nearest.best) : NULL;
    if (meant && meant->now && meant->key)
        return complain(error, LAM_BAD_ARGUMENT, "unknown option '--%s'; did you mean '--%s %s=%s'?", typed, meant->now,
                        meant->key, meant->value);
    if (meant)
        return complain(error, LAM_BAD_ARGUMENT, "unknown option '--%s'; did you mean '--%s'?", typed,
                        meant->now ? meant->now : meant->name);
    return complain(error, LAM_BAD_ARGUMENT, "unknown option '--%s'", typed);
}

// Suggests an option only if its row lists the letter, because similarity is meaningless for single letters.
static bool unknown_letter(const char *argument, char letter, uint64_t groups, lam_error *error)
{
    const char typed[2] = {letter, 0};
    if (letter >= '0' && letter <= '9')
        return complain(error, LAM_BAD_ARGUMENT,
                        "unknown option '%s'; the size of the picture is --size WIDTHxHEIGHT, such as -s 640x480",
                        argument);
    if (strchr(argument, '.') && access(argument, F_OK) == 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "unknown option '-%c'; for the file '%s' write './%s', or '--' before it", letter, argument,
                        argument);
    struct suggestion nearest = suggest_start(typed);
    for (const struct option *o = option_table; o->name; o++)
        if (option_is_taken(o, groups))
            suggest_also(&nearest, o->now ? o->now : o->name, o->others);
    return complain(error, LAM_BAD_ARGUMENT, "unknown option '-%c'%s%s%s", letter,
                    nearest.best ? "; did you mean '--" : "", nearest.best ? nearest.best : "",
                    nearest.best ? "'?" : "");
}

static bool is_known_option(const char *argument)
{
    if (argument[0] == '-' && argument[1] && argument[1] != '-')
        return !argument[2] && find_letter(argument[1]);
    return argument[0] == '-' && argument[1] == '-' && argument[2] &&
           find_long(argument + 2, strcspn(argument + 2, "="));
}

// Returns the option that the user probably meant: option->several if the value contains a comma, or a number instead of
// a word; option->former if it accepts the value; or otherwise `option`.
static const struct option *meant_by(const struct option *option, const char *value)
{
    if (option->several && (strchr(value, ',') || (option->store == store_word && strpbrk(value, "0123456789:"))))
        return option_find(option->several);
    const struct option *former = option->former ? option_find(option->former) : NULL;
    for (const struct choice *w = former ? former->words : NULL; w && w->name; w++)
        if (strcmp(w->name, value) == 0)
            return former;
    return option;
}

static void option_mark(struct options *options, const struct option *option, const char *value, bool by_look)
{
    options->given[option - option_table] = true;
    options->values[option - option_table] = value;
    if (option->replaces)
        options->values[option_find(option->replaces) - option_table] = NULL;
    options->by_look[option - option_table] = by_look;
    options->by_config[option - option_table] = 0;
}

// --- the user's settings

static size_t field_size(const struct option *option)
{
    if (option->store == store_switch || option->store == store_word_flag)
        return sizeof(bool);
    if (option->store == store_number || option->store == store_exposure)
        return sizeof(double);
    if (option->store == store_text || option->store == store_color || option->store == store_environment)
        return sizeof(const char *);
    return option->store == store_size ? 2 * sizeof(int) : sizeof(int); // a float has the size of an int
}

void options_drop_settings(struct options *options)
{
    const struct options *from = options->settings.without;
    for (int i = 0; from && option_table[i].name; i++) {
        const struct option *o = &option_table[i];
        if (!options->by_config[i])
            continue;
        options->by_config[i] = 0;
        memcpy((char *)options + o->field, (const char *)from + o->field, field_size(o));
        if (o->has_field)
            *(bool *)((char *)options + o->has_field) = false;
        if (o->store == store_exposure)
            options->picture.exposure_kind = from->picture.exposure_kind;
        if (o->store == store_ground)
            options->shading.ground_color = NULL;
        if (o->store == store_environment)
            options->shading.reflection_map = from->shading.reflection_map;
    }
}

// --- looks

static bool is_light(const struct option *option)
{
    return strcmp(option->name, "light") == 0 || strcmp(option->name, "rig") == 0;
}

// Returns whether the command line sets a rig, or a light without "+". Such lights replace the look's lights.
static bool own_lights(const struct options *options)
{
    bool own = option_given(options, "rig");
    for (int i = 0; i < options->lighting.lights.count; i++)
        own |= options->lighting.lights.items[i][0] != '+';
    return own;
}

struct look_lines {
    struct options *options;
    const struct options *before; // the options of the command line
    bool lights;                  // the command line sets lights
};

static bool take_look_line(void *user, int line, char *name, char *value, lam_error *error)
{
    struct look_lines *lines = user;
    struct options *options = lines->options;
    const struct option *option = option_find(name);
    if (!option || !option_is_in(option, IN_LOOK))
        return complain(error, LAM_BAD_ARGUMENT,
                        "%.100s:%d: found '%.60s', expected an option of the picture, such as --ao",
                        options->lighting.look, line, name);
    const char *given = *value ? value : option->alone;
    if (!option->value != !given && !(given && option->keyed))
        return complain(error, LAM_BAD_ARGUMENT, "%.100s:%d: --%s %s", options->lighting.look, line, option->name,
                        option->value ? "needs a value" : "takes no value");
    if (is_light(option) ? lines->lights : option_given(lines->before, option->name))
        return true;
    lam_error reason = {0};
    int count = options->lighting.lights.count;
    if (!option_store(option, given, options, &reason))
        return complain(error, LAM_BAD_ARGUMENT, "%.100s:%d: --%s: %.300s", options->lighting.look, line, option->name,
                        reason.text);
    options->lighting.look_lights += options->lighting.lights.count - count;
    option_mark(options, option, given, true);
    return true;
}

static bool apply_look(const char *name, struct options *options, lam_error *error)
{
    struct options before = *options; // the copy shares the lists of `options`, but only the flags of the copy are read
    struct look_lines lines = {options, &before, own_lights(options)};
    options->lighting.look = name;
    options->lighting.look_first = options->lighting.lights.count;
    return look_read(name, &options->lighting.look_text, take_look_line, &lines, error);
}

static void look_drop_lights(struct options *options)
{
    struct texts *lights = &options->lighting.lights;
    int first = options->lighting.look_first, count = options->lighting.look_lights;
    for (int i = first; i + count < lights->count; i++)
        lights->items[i] = lights->items[i + count];
    lights->count -= count;
    options->lighting.look_lights = 0;
    const struct option *rig = option_find("rig");
    if (options->by_look[rig - option_table]) {
        options->lighting.has_rig = false;
        option_mark(options, rig, NULL, false);
        options->given[rig - option_table] = false;
    }
}

// Reports that the command, which accepts `groups`, does not accept the intended option. The message lists the commands
// that accept the option.
static bool does_not_apply(const struct option *option, const struct option *typed, uint64_t groups, lam_error *error)
{
    char takers[200] = "";
    for (const struct command *c = command_table; c->name; c++)
        if (c->groups == groups && c->operands && strstr(c->operands, "OUT") && strcmp(option->name, "output") == 0) {
            return complain(error, LAM_BAD_ARGUMENT, "option '--output' is not needed: write lambent %s %s", c->name,
                            c->operands);
        } else if (option_is_taken(option, c->groups)) {
            size_t used = strlen(takers);
            snprintf(takers + used, sizeof takers - used, "%s%s", used ? ", " : "", c->name);
        }
    if (typed->several && typed != option)
        return complain(error, LAM_BAD_ARGUMENT, "option '--%s': several values belong to %s; this command takes one",
                        typed->name, takers);
    return complain(error, LAM_BAD_ARGUMENT, "option '--%s' does not apply to this command; it belongs to %s",
                    option->name, takers);
}

static bool apply(const struct option *typed, const char *value, uint64_t groups, struct options *options,
                  lam_error *error)
{
    const struct option *option = option_is_taken(typed, groups) || !typed->several ? meant_by(typed, value) : typed;
    if (!option_is_taken(option, groups))
        return does_not_apply(option, typed, groups, error);
    if (option->kind == VALUE_FILE && strncmp(value, "~/", 2) == 0 && access("~", F_OK) != 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--%s': found '%.200s': a shell replaces ~ only at the start of a word: --%s %.200s",
                        option->name, value, option->name, value);
    lam_error reason = {0};
    bool replaces = option->store == store_light ? value[0] != '+' : strcmp(option->name, "rig") == 0;
    if (replaces && options->lighting.look)
        look_drop_lights(options);
    bool look = strcmp(option->name, "look") == 0;
    if (look && options->lighting.look)
        return complain(error, LAM_BAD_ARGUMENT, "option '--look': given twice: '%.60s' and '%.60s'",
                        options->lighting.look, value);
    if (look ? apply_look(value, options, &reason) : option_store(option, value, options, &reason)) {
        option_mark(options, option, value, false);
        return true;
    }
    return complain(error, reason.code == LAM_MACHINE ? LAM_MACHINE : LAM_BAD_ARGUMENT, "option '--%s': %.400s",
                    typed->several ? typed->name : option->name, reason.text);
}

// Returns whether the next argument is the value of an option with an optional value.
static bool follows(const struct option *option, const char *argument, const struct options *options)
{
    struct options copy = *options;
    lam_error unused;
    char own[64]; // without the keys for other options
    snprintf(own, sizeof own, "%.*s", (int)strcspn(argument, ","), argument);
    return option->store(option, option->keyed ? own : argument, &copy, &unused);
}

// Returns whether the argument after an option with an optional value is probably a mistyped value: a plain word that
// names no file, shape or command, or a number.
static bool is_mistyped(const char *argument)
{
    if (*argument && !argument[strspn(argument, "-.0123456789")])
        return access(argument, F_OK) != 0;
    return isalpha((unsigned char)*argument) && !argument[strspn(argument, "abcdefghijklmnopqrstuvwxyz-")] &&
           access(argument, F_OK) != 0 && lam_shape_find(argument) < 0 && !find_command(argument);
}

// Returns the value after an option that requires a value, or NULL if the value is missing.
static const char *next_value(const struct option *option, int count, char **words, int *at, lam_error *error)
{
    if (*at + 1 < count && !is_known_option(words[*at + 1]))
        return words[++*at];
    bool color = option->store == store_color || option->store == store_opaque_color || option->store == store_material;
    char words_text[OPTION_WORDS_SIZE];
    complain(error, LAM_BAD_ARGUMENT, "option '--%s' needs a value: %s%s", option->name,
             option->words ? option_words_list(option, words_text) : option->value,
             color ? "; in a shell, # begins a comment unless it is quoted: '#ff8800'" : "");
    return NULL;
}

// Parses "--name", "--name=value" or "--name value".
static bool read_long(int count, char **words, int *at, uint64_t groups, struct options *options, lam_error *error)
{
    const char *name = words[*at] + 2;
    size_t length = strcspn(name, "=");
    const struct option *option = find_taken(name, length, groups);
    if (!option)
        return unknown_long(name, length, groups, error);
    const char *value = name[length] ? name + length + 1 : NULL;
    if (!option->value && value && !option->keyed)
        return complain(error, LAM_BAD_ARGUMENT, "option '--%s' takes no value; found '%s'", option->name, value);
    if (!option->value && !value && *at + 1 < count && begins_with_key(option, words[*at + 1]))
        value = words[++*at];
    bool alone = option->alone && (*at + 1 == count || !follows(option, words[*at + 1], options));
    if (!value && alone && *at + 1 < count && is_mistyped(words[*at + 1]))
        return apply(option, words[*at + 1], groups, options, error); // reports the expected values
    if (option->value && !value && alone)
        value = option->alone;
    if (option->value && !value && !(value = next_value(option, count, words, at, error)))
        return false;
    return apply(option, value, groups, options, error);
}

// Parses "-q", "-qv", "-ofile" or "-o file".
static bool read_letters(int count, char **words, int *at, uint64_t groups, struct options *options, lam_error *error)
{
    size_t length = strcspn(words[*at] + 1, "="); // "-fov" may be a mistyped "--fov"
    const struct option *whole = length > 1 ? find_long(words[*at] + 1, length) : NULL;
    if (whole)
        return complain(error, LAM_BAD_ARGUMENT, "unknown option '%s'; did you mean '--%s'?", words[*at], whole->name);
    for (const char *letter = words[*at] + 1; *letter; letter++) {
        const struct option *option = find_letter(*letter);
        if (!option)
            return unknown_letter(words[*at], *letter, groups, error);
        const char *value = NULL;
        if (option->value) {
            value = letter[1] ? letter + 1 : next_value(option, count, words, at, error);
            if (!value)
                return false;
        } else if (!letter[1] && *at + 1 < count && begins_with_key(option, words[*at + 1])) {
            value = words[++*at];
        }
        if (!apply(option, value, groups, options, error))
            return false;
        if (option->letter_field && *at + 1 < count && isdigit((unsigned char)words[*at + 1][0]))
            return complain(error, LAM_BAD_ARGUMENT,
                            "option '-%c' prints the help, found '%.20s' after it; the size of the picture is --size "
                            "WIDTHxHEIGHT, such as -s 640x480",
                            *letter, words[*at + 1]);
        if (option->letter_field)
            *(bool *)((char *)options + option->letter_field) = true;
        if (value)
            break;
    }
    return true;
}

int options_first_operand(int count, char **words)
{
    struct options unused = option_defaults();
    for (int at = 0; at < count; at++) {
        const char *argument = words[at];
        if (argument[0] != '-' || !argument[1])
            return at;
        if (argument[1] == '-') {
            size_t length = strcspn(argument + 2, "=");
            const struct option *option = find_long(argument + 2, length);
            if (!option)
                return -1; // "--", or an error
            if (argument[2 + length] == '=' || at + 1 == count)
                continue;
            at += option->value ? !option->alone || follows(option, words[at + 1], &unused)
                                : begins_with_key(option, words[at + 1]);
            continue;
        }
        for (const char *letter = argument + 1; *letter; letter++) {
            const struct option *option = find_letter(*letter);
            if (!option)
                return -1;
            at += !letter[1] && (option->value || (at + 1 < count && begins_with_key(option, words[at + 1])));
            if (option->value)
                break;
        }
    }
    return -1;
}

// Detects the dash that word processors insert instead of "--".
static bool has_long_dash(const char *argument)
{
    return strncmp(argument, "–", 3) == 0 || strncmp(argument, "—", 3) == 0 || strncmp(argument, "−", 3) == 0;
}

static bool is_number(const char *argument) { return *argument && !argument[strspn(argument, "0123456789")]; }

// A picture moves if an animation of the file is given without a time and its format is for moving pictures.
static bool move(struct options *o, lam_error *error)
{
    o->picture.output = o->picture.output || !o->animation.stream ? o->picture.output : "-";
    const char *format = o->picture.output ? lam_animation_format(o->picture.output) : NULL;
    bool moves = (format && strcmp(format, "png") != 0) || o->animation.stream;
    bool otherwise = o->model.has_time || o->animation.turntable || o->animation.sweeps.count ||
                     o->picture.save_scene || o->batch.view_count > 1 || o->batch.size_count > 1 || o->work.repeat > 1;
    const struct option *sweep = option_find("sweep");
    return !moves || otherwise || !o->model.animation || sweep->store(sweep, "time", o, error);
}

int options_parse(int count, char **words, uint64_t groups, struct options *options, lam_error *error)
{
    int operands = 0;
    for (int at = 0; at < count; at++) {
        char *argument = words[at];
        if (strcmp(argument, "--") == 0) {
            while (++at < count)
                words[operands++] = words[at];
        } else if (has_long_dash(argument) && access(argument, F_OK) != 0) {
            complain(error, LAM_BAD_ARGUMENT,
                     "found '%.100s', which begins with a typographic dash; options begin with --", argument);
            return -1;
        } else if (argument[0] != '-' || argument[1] == 0) {
            if (at > 0 && options->picture.has_size && is_number(argument) && is_number(words[at - 1]) &&
                access(argument, F_OK) != 0) {
                complain(error, LAM_BAD_ARGUMENT, "option '--size': found '%s %s', expected one word: %sx%s",
                         words[at - 1], argument, words[at - 1], argument);
                return -1;
            }
            words[operands++] = argument;
        } else if (argument[1] == '-') {
            if (!read_long(count, words, &at, groups, options, error))
                return -1;
        } else if (!read_letters(count, words, &at, groups, options, error)) {
            return -1;
        }
    }
    if (options->picture.output && strstr(options->picture.output, "://")) {
        complain(error, LAM_BAD_ARGUMENT,
                 "option '--output': found the address '%.200s', expected a file; lambent-catalogue (package "
                 "python3-lambent) writes into object stores",
                 options->picture.output);
        return -1;
    }
    return groups & 1ull << GROUP_ANIMATION && !move(options, error) ? -1 : operands;
}
