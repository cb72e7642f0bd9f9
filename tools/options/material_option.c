// material_option.c: the values of --material and --back-material: reading them.
#include "material_option.h"

#include <stdio.h>
#include <string.h>

#include "console.h"
#include "key_values.h"
#include "suggest.h"

static const char *const keys[] = {"ambient", "diffuse",        "specular", "emission", "reflectivity",
                                   "color",   "specular_color", "ka",       "kd",       "ks",
                                   "kr",      "shininess",      "opacity",  "fibre",    NULL};
enum key {
    AMBIENT,
    DIFFUSE,
    SPECULAR,
    EMISSION,
    REFLECTIVITY,
    COLOR,
    SPECULAR_COLOR,
    KA, // from here on single numbers
    KD,
    KS,
    KR,
    SHININESS,
    OPACITY,
    FIBRE,
    KEY_COUNT
};

#define BIT(key) (1u << (key))

static bool given(const struct material_option *option, enum key key) { return (option->seen & BIT(key)) != 0; }

static double *number_of(struct material_option *option, enum key key) { return &option->numbers[key - KA]; }

static bool read_fibre(const char *value, struct material_option *option, lam_error *error)
{
    static const char *const words[] = {"no", "yes", "off", "on", "0", "1"};
    for (int i = 0; i < 6; i++)
        if (strcmp(value, words[i]) == 0) {
            *number_of(option, FIBRE) = i & 1;
            return true;
        }
    return complain(error, LAM_BAD_ARGUMENT, "found 'fibre=%.60s', expected yes or no", value);
}

static bool read_value(enum key key, const char *value, lam_color_mode mode, struct material_option *option,
                       lam_error *error)
{
    if (key == FIBRE)
        return read_fibre(value, option, error);
    if (key < KA)
        return read_color(keys[key], value, mode, key != DIFFUSE, &option->colors[key], error);
    double *number = number_of(option, key);
    if (!read_one(value, number))
        return complain(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected a number", keys[key], value);
    if (!(*number >= 0 && *number <= 1e30))
        return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected a number of at least 0", keys[key], value);
    if (key == OPACITY && *number > 1)
        return complain(error, LAM_BAD_ARGUMENT, "opacity is %.60s, expected a number from 0 to 1", value);
    return true;
}

static bool read_pair(char *pair, lam_color_mode mode, struct material_option *option, lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value && strcmp(pair, "fibre") != 0)
        return complain(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value, such as shininess=50", pair);
    if (value)
        *value++ = 0;
    int key = key_find(pair, keys, error);
    if (key < 0)
        return false;
    if (given(option, (enum key)key))
        return complain(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    option->seen |= BIT(key);
    return read_value((enum key)key, value ? value : "yes", mode, option, error);
}

static bool unknown_material(const char *name, lam_error *error)
{
    struct suggestion nearest = suggest_start(name);
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++)
        suggest_try(&nearest, lam_material_name((lam_material_id)i));
    return complain(error, LAM_BAD_ARGUMENT, "unknown material '%.60s'%s%s%s", name,
                    nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "",
                    nearest.best ? "'?" : "; `lambent materials` lists them");
}

bool material_option_parse(const char *text, lam_color_mode mode, struct material_option *option, lam_error *error)
{
    *option = (struct material_option){.id = LAM_MATERIAL_COUNT};
    if (strlen(text) >= sizeof option->text)
        return complain(error, LAM_BAD_ARGUMENT, "it is %zu letters long, expected less than %zu", strlen(text),
                        sizeof option->text);
    strcpy(option->text, text);
    char *rest = option->text, *at = strchr(rest, '@');
    if (at) {
        *at++ = 0;
        option->target = at;
        if (!*at)
            return complain(error, LAM_BAD_ARGUMENT,
                            "nothing follows '@', expected the name of an object, part or material");
    }
    if (!*rest)
        return complain(error, LAM_BAD_ARGUMENT, "its value is empty, expected a material's name or key=value");
    size_t first = strcspn(rest, ",");
    if (!memchr(rest, '=', first) && !(first == 5 && memcmp(rest, "fibre", 5) == 0)) {
        char *name = strsep(&rest, ",");
        option->id = lam_material_find(name);
        if (option->id == LAM_MATERIAL_COUNT)
            return unknown_material(name, error);
    }
    for (char *pair; (pair = strsep(&rest, ",")) != NULL;)
        if (!read_pair(pair, mode, option, error))
            return false;
    return true;
}

void material_option_plain(struct material_option *option, bool has_shininess, double shininess, bool has_opacity,
                           double opacity)
{
    *option = (struct material_option){.id = LAM_MATERIAL_COUNT};
    option->seen = (has_shininess ? BIT(SHININESS) : 0) | (has_opacity ? BIT(OPACITY) : 0);
    *number_of(option, SHININESS) = shininess;
    *number_of(option, OPACITY) = opacity;
}

static lam_rgb rgb(lam_rgba color) { return (lam_rgb){color.r, color.g, color.b}; }

static void multiply(float *channels, double factor)
{
    for (int i = 0; i < 3; i++)
        channels[i] = (float)((double)channels[i] * factor);
}

lam_material material_option_apply(const struct material_option *option, lam_material m)
{
    const lam_rgba *colors = option->colors;
    const double *numbers = option->numbers;
    if (option->id != LAM_MATERIAL_COUNT) {
        m = lam_material_named(option->id);
    }
    if (given(option, COLOR)) {
        m.ambient = rgb(colors[COLOR]);
        m.diffuse = (lam_rgba){colors[COLOR].r, colors[COLOR].g, colors[COLOR].b, m.diffuse.a};
    }
    if (given(option, AMBIENT))
        m.ambient = rgb(colors[AMBIENT]);
    if (given(option, DIFFUSE))
        m.diffuse = colors[DIFFUSE];
    if (given(option, SPECULAR_COLOR))
        m.specular = rgb(colors[SPECULAR_COLOR]);
    if (given(option, SPECULAR))
        m.specular = rgb(colors[SPECULAR]);
    if (given(option, EMISSION))
        m.emission = rgb(colors[EMISSION]);
    if (given(option, REFLECTIVITY))
        m.reflectivity = rgb(colors[REFLECTIVITY]);
    else if (given(option, KR))
        m.reflectivity = given(option, SPECULAR_COLOR) ? rgb(colors[SPECULAR_COLOR]) : (lam_rgb){1, 1, 1};
    if (given(option, KA))
        multiply(&m.ambient.r, numbers[KA - KA]);
    if (given(option, KD))
        multiply(&m.diffuse.r, numbers[KD - KA]);
    if (given(option, KS))
        multiply(&m.specular.r, numbers[KS - KA]);
    if (given(option, KR))
        multiply(&m.reflectivity.r, numbers[KR - KA]);
    if (given(option, SHININESS))
        m.shininess = (float)numbers[SHININESS - KA];
    if (given(option, OPACITY))
        m.diffuse.a = (float)numbers[OPACITY - KA];
    if (given(option, FIBRE))
        m.fibre = numbers[FIBRE - KA] != 0;
    return m;
}

void material_option_warn(const struct material_option *option, const char *name, lam_scene *scene)
{
    for (int key = 0; key <= KR; key++) {
        if (!given(option, (enum key)key) || key == EMISSION)
            continue;
        const lam_rgba *c = &option->colors[key < KA ? key : 0];
        double most = key >= KA ? option->numbers[key - KA] : (double)c->r;
        if (key < KA && (double)c->g > most)
            most = (double)c->g;
        if (key < KA && (double)c->b > most)
            most = (double)c->b;
        if (!(most > 1))
            continue;
        char text[200];
        snprintf(text, sizeof text, "option '--%s': %s is %g: a surface that returns more light than arrives (over 1)",
                 name, keys[key], most);
        lam_scene_add_warning(scene, text);
    }
}

static double largest(lam_rgb c)
{
    float most = c.r > c.g ? c.r : c.g;
    return (double)(most > c.b ? most : c.b);
}

void materials_warn(lam_scene *scene)
{
    enum { TOLD = 3 };
    int over = 0;
    for (int i = 0; i < lam_scene_material_count(scene); i++) {
        const lam_material *m = lam_scene_material(scene, i);
        const struct {
            const char *key;
            lam_rgb color;
        } terms[] = {{"ambient", m->ambient},
                     {"diffuse", {m->diffuse.r, m->diffuse.g, m->diffuse.b}},
                     {"specular", m->specular},
                     {"reflectivity", m->reflectivity}};
        for (size_t k = 0; k < sizeof terms / sizeof *terms; k++) {
            if (!(largest(terms[k].color) > 1) || ++over > TOLD)
                continue;
            char text[200];
            snprintf(text, sizeof text,
                     "material '%.60s': %s is %g: a surface that returns more light than arrives (over 1)",
                     m->name ? m->name : "unnamed", terms[k].key, largest(terms[k].color));
            lam_scene_add_warning(scene, text);
        }
    }
    if (over > TOLD) {
        char text[100];
        snprintf(text, sizeof text, "%d more coefficients of materials are over 1", over - TOLD);
        lam_scene_add_warning(scene, text);
    }
}
