// light_option.c: the value of --light: reading it.
#include "light_option.h"

#include <stdio.h>
#include <string.h>

#include "options.h"
#include "console.h"
#include "key_values.h"
#include "suggest.h"

// Keys: the fields by their index in the table of lam_light_field (the first row of a key), then these.
enum { TARGET = LAM_FIELDS_MAX, COLOR, INTENSITY, FRAME, NAME, KEYS };

#define BIT(key) (1ull << (key))

static const struct {
    const char *name;
    unsigned light_types;
} other_keys[] = {
    [TARGET - LAM_FIELDS_MAX] = {"target", BIT(LAM_LIGHT_DIRECTIONAL) | BIT(LAM_LIGHT_SPOT)},
    [COLOR - LAM_FIELDS_MAX] = {"color", ~0u},
    [INTENSITY - LAM_FIELDS_MAX] = {"intensity", ~0u},
    [FRAME - LAM_FIELDS_MAX] = {"frame", ~(unsigned)BIT(LAM_LIGHT_AMBIENT)},
    [NAME - LAM_FIELDS_MAX] = {"name", ~0u},
};

// The keys read so far.
struct reading {
    struct light_option *option;
    lam_color_mode mode;
    uint64_t seen; // BIT(key)
    double numbers[KEYS][4];
    double w; // the position's fourth number
};

// The index of the first row of a key; −1: it is no field's.
static int field_index(const char *key)
{
    for (int i = 0; lam_light_field(i); i++)
        if (strcmp(lam_light_field(i)->key, key) == 0)
            return i;
    return -1;
}

// The name of a key; NULL: no such key.
static const char *key_name(int key)
{
    if (key >= LAM_FIELDS_MAX)
        return other_keys[key - LAM_FIELDS_MAX].name;
    const lam_field *field = lam_light_field(key);
    return field && field_index(field->key) == key ? field->key : NULL;
}

static bool is_of_type(int key, lam_light_type type)
{
    if (key >= LAM_FIELDS_MAX)
        return other_keys[key - LAM_FIELDS_MAX].light_types >> type & 1;
    bool is = strcmp(key_name(key), "position") == 0 && type == LAM_LIGHT_DIRECTIONAL; // the place that it comes from
    for (int i = key; lam_light_field(i); i++)
        is |= strcmp(lam_light_field(i)->key, key_name(key)) == 0 && lam_light_field(i)->light_types >> type & 1;
    return is;
}

static int find_key(const char *name, lam_error *error)
{
    const char *names[KEYS + 1];
    int keys[KEYS], count = 0;
    for (int key = 0; key < KEYS; key++)
        if (key_name(key)) {
            names[count] = key_name(key);
            keys[count++] = key;
        }
    names[count] = NULL;
    int found = key_find(name, names, error);
    return found < 0 ? -1 : keys[found];
}

static bool key_seen(const struct reading *reading, int key) { return reading->seen >> key & 1; }

static bool seen(const struct reading *reading, const char *name) { return key_seen(reading, field_index(name)); }

// --- single values

// A point: in the model's units, or in radii of its sphere (a 0 may go without its r). `w` NULL: three numbers only.
static bool point_for(const char *key, const char *value, lam_vec3 *out, bool *in_radii, double *w, lam_error *error)
{
    double numbers[4];
    bool radii[4];
    int count;
    if (!read_numbers(value, 3, w ? 4 : 3, numbers, &count, radii) || (count == 4 && radii[3]))
        return complain(error, LAM_BAD_ARGUMENT,
                        "found '%s=%.60s', expected three numbers x/y/z%s, each with r for radii", key, value,
                        w ? " (or four, x/y/z/w)" : "");
    *in_radii = radii[0] || radii[1] || radii[2];
    for (int i = 0; i < 3; i++)
        if (*in_radii && !radii[i] && numbers[i] != 0)
            return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected r after all of its numbers or after none",
                            key, value);
    double divisor = 1;
    if (count == 4) {
        *w = numbers[3];
        if (*w < 0)
            return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected w of at least 0", key, value);
        divisor = *w > 0 ? *w : 1;
    }
    *out = (lam_vec3){numbers[0] / divisor, numbers[1] / divisor, numbers[2] / divisor};
    return true;
}

static bool read_attenuation(const char *value, struct light_option *option, lam_error *error)
{
    double numbers[3];
    bool radii[3];
    int count;
    if (!read_numbers(value, 3, 3, numbers, &count, radii) || radii[0])
        return complain(
            error, LAM_BAD_ARGUMENT,
            "found 'attenuation=%.60s', expected three numbers a/b/c, b and c with r for distances in radii", value);
    if (numbers[0] < 0 || numbers[1] < 0 || numbers[2] < 0)
        return complain(error, LAM_BAD_ARGUMENT, "attenuation is %.60s, expected numbers of at least 0", value);
    if (numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0)
        return complain(error, LAM_BAD_ARGUMENT, "attenuation is %.60s, expected a + b d + c d2 above 0", value);
    option->light.attenuation = (lam_attenuation){(float)numbers[0], (float)numbers[1], (float)numbers[2]};
    option->linear_in_radii = radii[1];
    option->quadratic_in_radii = radii[2];
    return true;
}

static bool read_range(const char *value, struct light_option *option, lam_error *error)
{
    double number;
    int count;
    if (!read_numbers(value, 1, 1, &number, &count, &option->range_in_radii))
        return complain(error, LAM_BAD_ARGUMENT, "found 'range=%.60s', expected a distance, with r for radii", value);
    if (!(number > 0))
        return complain(error, LAM_BAD_ARGUMENT, "range is %.60s, expected a distance above 0", value);
    option->light.range = (float)number;
    return true;
}

static bool read_frame(char *value, struct light_option *option, lam_error *error)
{
    char *name = strchr(value, ':');
    if (name)
        *name++ = 0;
    lam_light *light = &option->light;
    if (strcmp(value, "object") == 0) {
        light->frame = name ? LAM_FRAME_OBJECT : LAM_FRAME_MODEL;
        light->object = name;
        return !name || *name ||
               complain(error, LAM_BAD_ARGUMENT, "frame is 'object:', expected an object's name after it");
    }
    bool camera = strcmp(value, "camera") == 0;
    if (name || (!camera && strcmp(value, "world") != 0))
        return complain(error, LAM_BAD_ARGUMENT, "found 'frame=%.60s', expected world, camera, object or object:NAME",
                        value);
    light->frame = camera ? LAM_FRAME_CAMERA : LAM_FRAME_WORLD;
    return true;
}

static bool read_value(struct reading *reading, int key, char *value, lam_error *error)
{
    struct light_option *option = reading->option;
    const lam_field color = {.key = "color", .type = LAM_FIELD_RGB};
    switch (key) {
    case TARGET:
        return point_for("target", value, &option->target, &option->target_in_radii, NULL, error);
    case COLOR:
        return read_field(&color, value, reading->mode, reading->numbers[COLOR], error);
    case INTENSITY:
        return read_number_of("intensity", value, 0, 1e30, reading->numbers[INTENSITY], error);
    case FRAME:
        return read_frame(value, option, error);
    case NAME:
        option->light.name = value;
        return *value || complain(error, LAM_BAD_ARGUMENT, "name is empty");
    default:
        break;
    }
    const lam_field *field = lam_light_field(key);
    if (field->type == LAM_FIELD_POINT)
        return point_for(field->key, value, &option->light.position, &option->position_in_radii, &reading->w, error);
    if (field->type == LAM_FIELD_TRIPLE)
        return read_attenuation(value, option, error);
    if (strcmp(field->key, "range") == 0)
        return read_range(value, option, error);
    if (!read_field(field, value, reading->mode, reading->numbers[key], error))
        return false;
    set_field(field, &option->light, reading->numbers[key]);
    return true;
}

static bool read_pair(struct reading *reading, char *pair, lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value)
        return complain(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value, such as position=1/2/3", pair);
    *value++ = 0;
    int key = find_key(pair, error);
    if (key < 0)
        return false;
    if (key_seen(reading, key))
        return complain(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    reading->seen |= BIT(key);
    return read_value(reading, key, value, error);
}

// --- the light from its values

// A colour that was not given by its own key.
static void set_color(const struct reading *reading, const char *name, bool by_color, double factor)
{
    lam_light *light = &reading->option->light;
    int index = field_index(name);
    double numbers[4];
    while (!(lam_light_field(index)->light_types >> light->type & 1))
        index++;
    lam_field_get(lam_light_field(index), light, numbers);
    if (by_color && key_seen(reading, COLOR) && !seen(reading, name))
        memcpy(numbers, reading->numbers[COLOR], sizeof numbers);
    for (int i = 0; i < 3; i++)
        numbers[i] *= factor;
    lam_field_set(lam_light_field(index), light, numbers);
}

static void set_colors(const struct reading *reading)
{
    double intensity = key_seen(reading, INTENSITY) ? reading->numbers[INTENSITY][0] : 1;
    switch (reading->option->light.type) {
    case LAM_LIGHT_AMBIENT:
        if (!seen(reading, "ambient"))
            set_color(reading, "ambient", true, intensity);
        return;
    case LAM_LIGHT_HEMISPHERE: // whose own colours are multiplied too
        set_color(reading, "sky", true, intensity);
        set_color(reading, "ground", false, intensity);
        return;
    default:
        if (!seen(reading, "diffuse"))
            set_color(reading, "diffuse", true, intensity);
        if (!seen(reading, "specular"))
            set_color(reading, "specular", true, intensity);
    }
}

bool light_cone_check(const double *cutoff_deg, const double *inner_deg, const double *outer_deg, lam_error *error)
{
    if (outer_deg && !(*inner_deg < *outer_deg))
        return complain(error, LAM_BAD_ARGUMENT, "inner is %g and outer is %g degrees, expected inner < outer",
                        *inner_deg, *outer_deg);
    if (cutoff_deg && !((*cutoff_deg > 0 && *cutoff_deg <= 90) || *cutoff_deg == 180))
        return complain(error, LAM_BAD_ARGUMENT,
                        "cutoff is %g degrees, expected a half angle above 0 and up to 90, or 180", *cutoff_deg);
    return true;
}

static bool set_cone(struct reading *reading, lam_error *error)
{
    lam_light *light = &reading->option->light;
    bool inner = seen(reading, "inner"), outer = seen(reading, "outer"), cutoff = seen(reading, "cutoff");
    const double *degrees = reading->numbers[field_index("cutoff")];
    if ((inner || outer) && (cutoff || seen(reading, "exponent")))
        return complain(error, LAM_BAD_ARGUMENT,
                        "both kinds of cone are given, expected cutoff and exponent, or inner and outer");
    if (inner && !outer)
        return complain(error, LAM_BAD_ARGUMENT, "'inner' is given without 'outer', expected both");
    if (!light_cone_check(cutoff ? degrees : NULL, reading->numbers[field_index("inner")],
                          outer ? reading->numbers[field_index("outer")] : NULL, error))
        return false;
    if (!cutoff && !outer && seen(reading, "exponent"))
        light->cutoff_rad = 0; // no edge: the exponent alone shapes it
    return true;
}

// The place and the direction: w = 0 and directional lights have rules of their own.
static bool set_place(struct reading *reading, lam_error *error)
{
    struct light_option *option = reading->option;
    lam_light *light = &option->light;
    lam_vec3 *p = &light->position;
    option->has_position = seen(reading, "position");
    option->has_direction = seen(reading, "direction");
    option->has_target = key_seen(reading, TARGET);
    if (option->has_direction && option->has_target)
        return complain(error, LAM_BAD_ARGUMENT, "'direction' and 'target' are given, expected one of them");
    if (option->has_position && reading->w == 0) {
        if (light->type == LAM_LIGHT_SPOT)
            return complain(error, LAM_BAD_ARGUMENT, "a spot light has a place, expected w above 0");
        if (option->has_direction || option->has_target)
            return complain(error, LAM_BAD_ARGUMENT, "position with w = 0 is a direction already, found another");
        if (p->x == 0 && p->y == 0 && p->z == 0)
            return complain(error, LAM_BAD_ARGUMENT, "position is 0/0/0/0, expected a direction");
        light->type = LAM_LIGHT_DIRECTIONAL;
        light->direction = (lam_vec3){-p->x, -p->y, -p->z};
        option->has_position = false;
        option->has_direction = true;
    } else if (light->type == LAM_LIGHT_DIRECTIONAL && option->has_position != option->has_target) {
        return complain(error, LAM_BAD_ARGUMENT,
                        "a directional light takes direction=x/y/z, position=x/y/z/0, or both position and target");
    }
    return true;
}

static bool check_keys(const struct reading *reading, lam_error *error)
{
    lam_light_type type = reading->option->light.type;
    for (int key = 0; key < KEYS; key++)
        if (key_seen(reading, key) && !is_of_type(key, type))
            return complain(error, LAM_BAD_ARGUMENT, "%s%s light has no '%s'", type == LAM_LIGHT_AMBIENT ? "an " : "a ",
                            lam_light_type_describe(type)->word, key_name(key));
    return true;
}

static bool find_type(const char *name, lam_light_type *type, lam_error *error)
{
    struct suggestion nearest = suggest_start(name);
    for (int i = 0; i < LAM_LIGHT_TYPE_COUNT; i++) {
        const char *word = lam_light_type_describe((lam_light_type)i)->word;
        if (strcmp(word, name) == 0) {
            *type = (lam_light_type)i;
            return true;
        }
        suggest_try(&nearest, word);
    }
    return complain(error, LAM_BAD_ARGUMENT, "unknown light '%.60s'%s%s%s", name,
                    nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "",
                    nearest.best ? "'?" : "; expected ambient, hemisphere, point, directional, spot or none");
}

bool light_option_parse(const char *text, lam_color_mode mode, struct light_option *option, lam_error *error)
{
    *option = (struct light_option){.none = strcmp(text, "none") == 0, .adds = text[0] == '+'};
    text += option->adds;
    if (option->none)
        return true;
    if (strlen(text) >= sizeof option->text)
        return complain(error, LAM_BAD_ARGUMENT, "it is %zu letters long, expected less than %zu", strlen(text),
                        sizeof option->text);
    strcpy(option->text, text);
    char *rest = strchr(option->text, ':');
    if (rest)
        *rest++ = 0;
    lam_light_type type = LAM_LIGHT_POINT;
    if (!find_type(option->text, &type, error))
        return false;
    option->light = lam_light_default(type);
    struct reading reading = {.option = option, .mode = mode, .w = 1};
    for (char *pair; (pair = strsep(&rest, ",")) != NULL;)
        if (!read_pair(&reading, pair, error))
            return false;
    if (!set_place(&reading, error) || !check_keys(&reading, error))
        return false;
    set_colors(&reading);
    return set_cone(&reading, error);
}
