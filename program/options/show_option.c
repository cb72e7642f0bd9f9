// show_option.c: parses the value of --show: a word, optionally with a light, as in "diffuse", "light:key" and "n.l:2".
#include "show_option.h"

#include <lambent/light.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "options.h"

// Returns the output with this name, or LAM_OUTPUT_COUNT if there is none. Sets `light` to the text after the colon, or
// to NULL.
static lam_output split(const char *text, const char **light)
{
    *light = NULL;
    const char *colon = strchr(text, ':');
    size_t length = colon ? (size_t)(colon - text) : strlen(text);
    if (strcmp(text, "color") == 0)
        return LAM_OUTPUT_PICTURE;
    for (int i = LAM_OUTPUT_PICTURE; i < LAM_OUTPUT_COUNT; i++) {
        const char *name = lam_output_name((lam_output)i);
        if (strlen(name) != length || memcmp(name, text, length) != 0 ||
            (colon && !lam_output_is_one_light((lam_output)i)))
            continue;
        *light = colon ? colon + 1 : NULL;
        return (lam_output)i;
    }
    return LAM_OUTPUT_COUNT;
}

static bool check(const struct option *option, const char *value, lam_error *error)
{
    const char *light;
    lam_output show = split(value, &light);
    if (show == LAM_OUTPUT_LIGHT && !light)
        return complain(error, LAM_BAD_ARGUMENT, "found 'light', expected light:NAME, the light's name or its number");
    if (light && !*light)
        return complain(error, LAM_BAD_ARGUMENT,
                        "found '%.100s', expected a light's name or its number after the colon", value);
    if (show < LAM_OUTPUT_COUNT || strcmp(value, "all") == 0)
        return true;
    char known[400] = "";
    struct suggestion nearest = suggest_start(value);
    for (const struct choice *w = option->words; w->name; w++) {
        strncat(known, w == option->words ? "" : w[1].name ? ", " : " or ", sizeof known - strlen(known) - 1);
        strncat(known, w->name, sizeof known - strlen(known) - 1);
        suggest_try(&nearest, w->name);
    }
    return complain(error, LAM_BAD_ARGUMENT, "found '%.100s', expected %s%s%s%s", value, known,
                    nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "", nearest.best ? "'?" : "");
}

bool store_show(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    options->picture.show = value;
    return check(option, value, error);
}

// Parses "color,depth,normals".
bool store_shows(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    options->batch.shows = value;
    options->batch.show_count = 0;
    for (const char *at = value; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        char name[SHOW_SIZE];
        if (strcspn(at, ",") >= SHOW_SIZE)
            return complain(error, LAM_BAD_ARGUMENT, "'%.100s' has a name of more than %d letters", value,
                            SHOW_SIZE - 1);
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, ","), at);
        if (!check(option, name, error))
            return false;
        options->batch.show_count++;
    }
    return true;
}

lam_output show_option_what(const char *text)
{
    const char *light;
    return text && strcmp(text, "all") != 0 ? split(text, &light) : LAM_OUTPUT_PICTURE;
}

static bool has_direction(const lam_light *light)
{
    return light->type != LAM_LIGHT_AMBIENT && light->type != LAM_LIGHT_HEMISPHERE;
}

// Finds a light by its name or, if no light has this name, by its number (the first light is 1). If `wanted` is NULL,
// finds the first light that has a direction. Returns −1 if there is no such light.
static int find(const char *wanted, const lam_light *lights, int count)
{
    for (int i = 0; i < count; i++)
        if (wanted ? lights[i].name && strcmp(lights[i].name, wanted) == 0 : has_direction(&lights[i]))
            return i;
    char *end = NULL;
    long number = wanted ? strtol(wanted, &end, 10) : 0;
    return wanted && *wanted >= '0' && *wanted <= '9' && !*end && number >= 1 && number <= count ? (int)number - 1 : -1;
}

// Lists lights as in "'key', 'fill', 3", with numbers for unnamed lights. If the list does not fit, it ends with "…".
static void list(const lam_light *lights, int count, bool directed, char *out, size_t capacity)
{
    size_t used = 0;
    out[0] = 0;
    for (int i = 0; i < count; i++) {
        if (directed && !has_direction(&lights[i]))
            continue;
        char one[100];
        if (lights[i].name)
            snprintf(one, sizeof one, "%s'%.80s'", used ? ", " : "", lights[i].name);
        else
            snprintf(one, sizeof one, "%s%d", used ? ", " : "", i + 1);
        if (used + strlen(one) + sizeof ", …" > capacity) {
            memcpy(out + used, ", …", sizeof ", …");
            return;
        }
        memcpy(out + used, one, strlen(one) + 1);
        used += strlen(one);
    }
}

bool show_option_apply(const char *text, const lam_scene *scene, lam_draw_params *params, lam_error *error)
{
    const char *wanted = NULL;
    params->output = text && strcmp(text, "all") != 0 ? split(text, &wanted) : LAM_OUTPUT_PICTURE;
    if (!lam_output_is_one_light(params->output))
        return true;
    int count = lam_draw_lights(scene, params->rig, params->ground, NULL, 0);
    lam_light *lights = calloc((size_t)count + 1, sizeof *lights);
    if (!lights)
        return complain(error, LAM_MACHINE, "out of memory");
    lam_draw_lights(scene, params->rig, params->ground, lights, count);
    params->output_light = find(wanted, lights, count);
    bool directed = params->output != LAM_OUTPUT_LIGHT;
    bool ok = params->output_light >= 0 && (!directed || has_direction(&lights[params->output_light]));
    if (!ok) {
        char known[300];
        list(lights, count, directed, known, sizeof known);
        const char *kind = directed ? " with a direction" : "";
        if (!*known)
            complain(error, LAM_BAD_ARGUMENT, "option '--show': %.100s needs a light%s, and there is none", text, kind);
        else
            complain(error, LAM_BAD_ARGUMENT, "option '--show': no light%s is '%.100s'; there %s %s", kind, wanted,
                     strchr(known, ',') ? "are" : "is", known);
    }
    free(lights);
    return ok;
}

bool show_option_is_single(const char *text, const char *ending, double depth_scale)
{
    const lam_output output = show_option_what(text);
    const bool label = output == LAM_OUTPUT_OBJECT_ID || output == LAM_OUTPUT_PART_ID;
    if (!label && output != LAM_OUTPUT_DEPTH)
        return false;
    return strcmp(ending, "png") == 0 ? label || depth_scale > 0
                                      : strcmp(ending, "exr") == 0 || strcmp(ending, "pfm") == 0;
}
