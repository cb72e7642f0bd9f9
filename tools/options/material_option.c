// material_option.c: the values of --material and --back-material: reading them.
#include "material_option.h"

#include <stdio.h>
#include <string.h>

#include "console.h"
#include "key_values.h"
#include "suggest.h"

static bool given(const struct material_option *option, int key) { return option->given >> key & 1; }

static bool is_color(const lam_field *field) { return field->type == LAM_FIELD_RGB || field->type == LAM_FIELD_RGBA; }

// Shares of light have a symbol; the surface's own light has none.
static bool is_share(const lam_field *field) { return is_color(field) && field->symbol; }

static int factor_of(int field) { return LAM_FIELDS_MAX + field; }

// The name of a key; NULL: no such key.
static const char *key_name(int key)
{
    if (key >= MATERIAL_COLOR)
        return key == MATERIAL_COLOR ? "color" : "specular_color";
    const lam_field *field = lam_material_field(key % LAM_FIELDS_MAX);
    if (key < LAM_FIELDS_MAX || !field)
        return field ? field->key : NULL;
    return is_share(field) ? field->symbol : NULL;
}

static int find_key(const char *name, lam_error *error)
{
    const char *names[MATERIAL_KEYS + 1];
    int keys[MATERIAL_KEYS], count = 0;
    for (int key = 0; key < MATERIAL_KEYS; key++)
        if (key_name(key)) {
            names[count] = key_name(key);
            keys[count++] = key;
        }
    names[count] = NULL;
    int found = key_find(name, names, error);
    return found < 0 ? -1 : keys[found];
}

// A flag may go without its value.
static bool is_flag(const char *name, size_t length)
{
    for (int i = 0; lam_material_field(i); i++) {
        const lam_field *field = lam_material_field(i);
        if (field->type == LAM_FIELD_FLAG && strlen(field->key) == length && memcmp(field->key, name, length) == 0)
            return true;
    }
    return false;
}

static bool read_pair(char *pair, lam_color_mode mode, struct material_option *option, lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value && !is_flag(pair, strlen(pair)))
        return complain(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value, such as shininess=50", pair);
    if (value)
        *value++ = 0;
    int key = find_key(pair, error);
    if (key < 0)
        return false;
    if (given(option, key))
        return complain(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    option->given |= UINT64_C(1) << key;
    if (key < LAM_FIELDS_MAX)
        return read_field(lam_material_field(key), value ? value : "yes", mode, option->numbers[key], error);
    if (key < MATERIAL_COLOR)
        return read_number_of(pair, value, 0, 1e30, option->numbers[key], error);
    const lam_field color = {.key = pair, .type = LAM_FIELD_RGB};
    return read_field(&color, value, mode, option->numbers[key], error);
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
    material_option_start(option);
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
    if (!memchr(rest, '=', first) && !is_flag(rest, first)) {
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

void material_option_start(struct material_option *option)
{
    *option = (struct material_option){.id = LAM_MATERIAL_COUNT};
}

void material_option_set_number(struct material_option *option, const char *key, double number)
{
    int at = find_key(key, NULL);
    option->given |= UINT64_C(1) << at;
    option->numbers[at][0] = number;
}

// Sets the first three numbers of a colour: an alpha stays.
static void set_color(const lam_field *field, lam_material *m, const double color[4], double factor)
{
    double numbers[4];
    lam_field_get(field, m, numbers);
    for (int i = 0; i < 3; i++)
        numbers[i] = color[i] * factor;
    lam_field_set(field, m, numbers);
}

static void set_factor(const struct material_option *option, int index, lam_material *m)
{
    static const double white[4] = {1, 1, 1, 1};
    const lam_field *field = lam_material_field(index);
    double color[4];
    lam_field_get(field, m, color);
    const double *from = color;
    if (field->standard[0] == 0 && !given(option, index)) // of no light by default a share would be nothing
        from = given(option, MATERIAL_SPECULAR_COLOR) ? option->numbers[MATERIAL_SPECULAR_COLOR] : white;
    set_color(field, m, from, option->numbers[factor_of(index)][0]);
}

lam_material material_option_apply(const struct material_option *option, lam_material m)
{
    if (option->id != LAM_MATERIAL_COUNT)
        m = lam_material_named(option->id);
    const double *color = option->numbers[MATERIAL_COLOR], *specular = option->numbers[MATERIAL_SPECULAR_COLOR];
    if (given(option, MATERIAL_COLOR)) {
        m.ambient = (lam_rgb){(float)color[0], (float)color[1], (float)color[2]};
        m.diffuse = (lam_rgba){m.ambient.r, m.ambient.g, m.ambient.b, m.diffuse.a};
    }
    if (given(option, MATERIAL_SPECULAR_COLOR))
        m.specular = (lam_rgb){(float)specular[0], (float)specular[1], (float)specular[2]};
    for (int i = 0; lam_material_field(i); i++)
        if (given(option, i))
            set_field(lam_material_field(i), &m, option->numbers[i]);
    for (int i = 0; lam_material_field(i); i++)
        if (given(option, factor_of(i)))
            set_factor(option, i, &m);
    return m;
}

static double largest(const double color[4])
{
    double highest = color[0] > color[1] ? color[0] : color[1];
    return highest > color[2] ? highest : color[2];
}

void material_option_warn(const struct material_option *option, const char *name, lam_scene *scene)
{
    for (int key = 0; key < MATERIAL_KEYS; key++) {
        bool single = key >= LAM_FIELDS_MAX && key < MATERIAL_COLOR;
        if (!given(option, key) || (key < LAM_FIELDS_MAX && !is_share(lam_material_field(key))))
            continue;
        double highest = single ? option->numbers[key][0] : largest(option->numbers[key]);
        if (!(highest > 1))
            continue;
        char text[200];
        snprintf(text, sizeof text, "option '--%s': %s is %g: a surface that returns more light than arrives (over 1)",
                 name, key_name(key), highest);
        lam_scene_add_warning(scene, text);
    }
}

void materials_warn(lam_scene *scene)
{
    enum { REPORTED = 3 };
    int over = 0;
    for (int i = 0; i < lam_scene_material_count(scene); i++) {
        const lam_material *m = lam_scene_material(scene, i);
        for (int k = 0; lam_material_field(k); k++) {
            double color[4];
            lam_field_get(lam_material_field(k), m, color);
            if (!is_share(lam_material_field(k)) || !(largest(color) > 1) || ++over > REPORTED)
                continue;
            char text[200];
            snprintf(text, sizeof text,
                     "material '%.60s': %s is %g: a surface that returns more light than arrives (over 1)",
                     m->name ? m->name : "unnamed", lam_material_field(k)->key, largest(color));
            lam_scene_add_warning(scene, text);
        }
    }
    if (over > REPORTED) {
        char text[100];
        snprintf(text, sizeof text, "%d more coefficients of materials are over 1", over - REPORTED);
        lam_scene_add_warning(scene, text);
    }
}
