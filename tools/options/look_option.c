// look_option.c: --look: applies a file of options, where the command line does not have the same option.
#include "look_option.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "looks.inc"
#include "suggest.h"

static const struct {
    const char *name, *text;
} looks[] = {{"studio", text_studio_look}, {"classic", text_classic_look}, {"catalog", text_catalog_look}};

enum { LOOKS = sizeof looks / sizeof *looks, FILE_MAX = 1 << 16 };

const char *look_name(int look) { return look >= 0 && look < LOOKS ? looks[look].name : NULL; }
const char *look_text(int look) { return look >= 0 && look < LOOKS ? looks[look].text : NULL; }

const char *look_find(const char *name)
{
    for (int i = 0; i < LOOKS; i++)
        if (strcmp(looks[i].name, name) == 0)
            return looks[i].text;
    return NULL;
}

void look_summary(const char *text, char *out, size_t size)
{
    const char *from = text + strspn(text, "# ");
    snprintf(out, size, "%.*s", *text == '#' ? (int)strcspn(from, "\n") : 0, from);
}

// The text of a look, to be changed: the values of options point into it until the program ends.
static char *copy_of_look(const char *name, lam_error *error)
{
    static struct kept {
        struct kept *next;
        char text[];
    } *all;
    const char *built_in = look_find(name);
    struct kept *kept = malloc(sizeof *kept + FILE_MAX + 1);
    FILE *file = built_in ? NULL : fopen(name, "rb");
    if (!kept || (!built_in && !file)) {
        int reason = errno;
        struct suggestion nearest = suggest_start(name);
        for (int i = 0; i < LOOKS; i++)
            suggest_try(&nearest, looks[i].name);
        complain(error, LAM_BAD_ARGUMENT, "found '%.100s', expected studio, classic, catalog or a file (%s)%s%s%s",
                 name, strerror(reason), nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "",
                 nearest.best ? "'?" : "");
        free(kept);
        return NULL;
    }
    kept->next = all;
    all = kept;
    size_t length = 0;
    if (built_in)
        length = (size_t)snprintf(kept->text, FILE_MAX, "%s", built_in);
    else
        length = fread(kept->text, 1, FILE_MAX, file);
    bool whole = built_in || (!ferror(file) && fgetc(file) == EOF);
    if (file)
        fclose(file);
    kept->text[length] = 0;
    if (whole && strlen(kept->text) == length)
        return kept->text;
    complain(error, LAM_BAD_ARGUMENT, "%.200s: not a look: it cannot be read, is longer than 64 KiB, or is no text",
             name);
    return NULL;
}

static bool is_light(const struct option *option)
{
    return strcmp(option->name, "light") == 0 || strcmp(option->name, "rig") == 0;
}

// Whether the command line has lights of its own, which replace a look's: a rig, or a light without +.
static bool own_lights(const struct options *options)
{
    bool own = option_given(options, "rig");
    for (int i = 0; i < options->lights.count; i++)
        own |= options->lights.items[i][0] != '+';
    return own;
}

// Options of the picture alone: none that names a file to write, or another look.
static bool fits(const struct option *option)
{
    static const char *const others[] = {"look", "output", "save-scene", "size", "show", "light-cutoff"};
    bool group = option->group == GROUP_PICTURE || option->group == GROUP_VIEW || option->group == GROUP_LIGHTS ||
                 option->group == GROUP_MATERIALS || option->group == GROUP_SHADING;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        group &= strcmp(option->name, others[i]) != 0;
    return group;
}

static bool apply_line(const char *look, int number, char *line, const struct options *before, struct options *options,
                       bool lights, lam_error *error)
{
    char *name = line + strspn(line, " \t");
    size_t end = strlen(name);
    while (end && strchr(" \t\r", name[end - 1]))
        name[--end] = 0;
    if (!*name || *name == '#')
        return true;
    name += name[0] == '-' && name[1] == '-' ? 2 : 0;
    char *value = name + strcspn(name, " =");
    if (*value)
        *value++ = 0;
    value += strspn(value, " ");
    const struct option *option = option_find(name);
    if (!option || !fits(option))
        return complain(error, LAM_BAD_ARGUMENT,
                        "%.100s:%d: found '%.60s', expected an option of the picture, such as --ao", look, number,
                        name);
    if (!*value && option->alone)
        value = (char *)(uintptr_t)option->alone;
    if (!option->value != !*value)
        return complain(error, LAM_BAD_ARGUMENT, "%.100s:%d: --%s %s", look, number, option->name,
                        option->value ? "needs a value" : "takes no value");
    if (is_light(option) ? lights : option_given(before, option->name))
        return true;
    lam_error reason = {0};
    int count = options->lights.count;
    if (!option->store(option, *value ? value : NULL, options, &reason))
        return complain(error, LAM_BAD_ARGUMENT, "%.100s:%d: --%s: %.300s", look, number, option->name, reason.text);
    options->look_lights += options->lights.count - count;
    option_mark(options, option, *value ? value : NULL, true);
    return true;
}

bool store_look(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    (void)option;
    if (options->look)
        return complain(error, LAM_BAD_ARGUMENT, "given twice: '%.60s' and '%.60s'", options->look, value);
    char *text = copy_of_look(value, error);
    if (!text)
        return false;
    struct options before = *options; // shares its lists, of which only the flags are read
    bool lights = own_lights(options);
    options->look = value;
    options->look_first = options->lights.count;
    int number = 1;
    for (char *line = text, *next; line; line = next, number++) {
        next = strchr(line, '\n');
        if (next)
            *next++ = 0;
        if (!apply_line(value, number, line, &before, options, lights, error))
            return false;
    }
    return true;
}

void look_drop_lights(struct options *options)
{
    struct texts *lights = &options->lights;
    int first = options->look_first, count = options->look_lights;
    for (int i = first; i + count < lights->count; i++)
        lights->items[i] = lights->items[i + count];
    lights->count -= count;
    options->look_lights = 0;
    const struct option *rig = option_find("rig");
    if (options->by_look[rig - option_table]) {
        options->has_rig = false;
        option_mark(options, rig, NULL, false);
        options->given[rig - option_table] = false;
    }
}
