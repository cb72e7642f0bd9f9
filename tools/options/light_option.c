// light_option.c: the value of --light: reading it.
#include "light_option.h"

#include <stdio.h>
#include <string.h>

#include "options.h"
#include "console.h"
#include "key_values.h"
#include "suggest.h"

static const char *const keys[] = {"position", "direction",   "target", "color",  "intensity", "ambient", "diffuse",
                                   "specular", "attenuation", "range",  "cutoff", "exponent",  "inner",   "outer",
                                   "sky",      "ground",      "up",     "frame",  "name",      NULL};
enum key {
    POSITION,
    DIRECTION,
    TARGET,
    COLOR,
    INTENSITY,
    AMBIENT,
    DIFFUSE,
    SPECULAR,
    ATTENUATION,
    RANGE,
    CUTOFF,
    EXPONENT,
    INNER,
    OUTER,
    SKY,
    GROUND,
    UP,
    FRAME,
    NAME,
    KEY_COUNT
};

#define BIT(key) (1u << (key))
#define COLORS   (BIT(COLOR) | BIT(INTENSITY) | BIT(AMBIENT) | BIT(DIFFUSE) | BIT(SPECULAR) | BIT(FRAME) | BIT(NAME))
#define PLACED   (COLORS | BIT(POSITION) | BIT(ATTENUATION) | BIT(RANGE))

static const unsigned keys_of_type[] = {
    [LAM_LIGHT_AMBIENT] = BIT(COLOR) | BIT(INTENSITY) | BIT(AMBIENT) | BIT(NAME),
    [LAM_LIGHT_HEMISPHERE] = BIT(COLOR) | BIT(INTENSITY) | BIT(SKY) | BIT(GROUND) | BIT(UP) | BIT(FRAME) | BIT(NAME),
    [LAM_LIGHT_POINT] = PLACED,
    [LAM_LIGHT_DIRECTIONAL] = COLORS | BIT(POSITION) | BIT(DIRECTION) | BIT(TARGET),
    [LAM_LIGHT_SPOT] = PLACED | BIT(DIRECTION) | BIT(TARGET) | BIT(CUTOFF) | BIT(EXPONENT) | BIT(INNER) | BIT(OUTER),
};

// What was read on the way.
struct reading {
    struct light_option *option;
    lam_color_mode mode;
    unsigned seen; // BIT(key)
    lam_rgb colors[KEY_COUNT];
    double intensity, w;         // w: the position's fourth number
    double cutoff, inner, outer; // degrees
};

static bool seen(const struct reading *reading, enum key key) { return (reading->seen & BIT(key)) != 0; }

// --- single values

static bool number_for(enum key key, const char *value, double least, double most, double *out, lam_error *error)
{
    if (!read_one(value, out))
        return complain(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected a number", keys[key], value);
    if (!(*out >= least && *out <= most)) {
        char range[64] = "of at least 0";
        if (most < 1e29)
            snprintf(range, sizeof range, "from %g to %g", least, most);
        return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected a number %s", keys[key], value, range);
    }
    return true;
}

static bool vector_for(enum key key, const char *value, lam_vec3 *out, lam_error *error)
{
    double numbers[3];
    int count;
    if (!read_numbers(value, 3, 3, numbers, &count, NULL))
        return complain(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected three numbers x/y/z", keys[key], value);
    *out = (lam_vec3){numbers[0], numbers[1], numbers[2]};
    if (out->x == 0 && out->y == 0 && out->z == 0)
        return complain(error, LAM_BAD_ARGUMENT, "%s is 0/0/0, expected a direction", keys[key]);
    return true;
}

// A point: in the model's units, or in radii of its sphere (a 0 may go without its r). `w` NULL: three numbers only.
static bool point_for(enum key key, const char *value, lam_vec3 *out, bool *in_radii, double *w, lam_error *error)
{
    double numbers[4];
    bool radii[4];
    int count;
    if (!read_numbers(value, 3, w ? 4 : 3, numbers, &count, radii) || (count == 4 && radii[3]))
        return complain(error, LAM_BAD_ARGUMENT,
                        "found '%s=%.60s', expected three numbers x/y/z%s, each with r for radii", keys[key], value,
                        w ? " (or four, x/y/z/w)" : "");
    *in_radii = radii[0] || radii[1] || radii[2];
    for (int i = 0; i < 3; i++)
        if (*in_radii && !radii[i] && numbers[i] != 0)
            return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected r behind all of its numbers or behind none",
                            keys[key], value);
    double divisor = 1;
    if (count == 4) {
        *w = numbers[3];
        if (*w < 0)
            return complain(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected w of at least 0", keys[key], value);
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
               complain(error, LAM_BAD_ARGUMENT, "frame is 'object:', expected an object's name behind it");
    }
    bool camera = strcmp(value, "camera") == 0;
    if (name || (!camera && strcmp(value, "world") != 0))
        return complain(error, LAM_BAD_ARGUMENT, "found 'frame=%.60s', expected world, camera, object or object:NAME",
                        value);
    light->frame = camera ? LAM_FRAME_CAMERA : LAM_FRAME_WORLD;
    return true;
}

static bool read_value(struct reading *reading, enum key key, char *value, lam_error *error)
{
    struct light_option *option = reading->option;
    double exponent;
    lam_rgba color;
    switch (key) {
    case POSITION:
        return point_for(key, value, &option->light.position, &option->position_in_radii, &reading->w, error);
    case TARGET:
        return point_for(key, value, &option->target, &option->target_in_radii, NULL, error);
    case DIRECTION:
        return vector_for(key, value, &option->light.direction, error);
    case UP:
        return vector_for(key, value, &option->light.up, error);
    case INTENSITY:
        return number_for(key, value, 0, 1e30, &reading->intensity, error);
    case ATTENUATION:
        return read_attenuation(value, option, error);
    case RANGE:
        return read_range(value, option, error);
    case CUTOFF:
        return number_for(key, value, 0, 180, &reading->cutoff, error);
    case EXPONENT:
        if (!number_for(key, value, 0, 1e30, &exponent, error))
            return false;
        option->light.exponent = (float)exponent;
        return true;
    case INNER:
        return number_for(key, value, 0, 90, &reading->inner, error);
    case OUTER:
        return number_for(key, value, 0, 90, &reading->outer, error);
    case FRAME:
        return read_frame(value, option, error);
    case NAME:
        option->light.name = value;
        return *value || complain(error, LAM_BAD_ARGUMENT, "name is empty");
    default:
        if (!read_color(keys[key], value, reading->mode, true, &color, error))
            return false;
        reading->colors[key] = (lam_rgb){color.r, color.g, color.b};
        return true;
    }
}

static bool read_pair(struct reading *reading, char *pair, lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value)
        return complain(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value, such as position=1/2/3", pair);
    *value++ = 0;
    int key = key_find(pair, keys, error);
    if (key < 0)
        return false;
    if (seen(reading, (enum key)key))
        return complain(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    reading->seen |= BIT(key);
    return read_value(reading, (enum key)key, value, error);
}

// --- what the values amount to

static lam_rgb scaled(lam_rgb color, double factor)
{
    return (lam_rgb){(float)((double)color.r * factor), (float)((double)color.g * factor),
                     (float)((double)color.b * factor)};
}

static void set_colors(struct reading *reading)
{
    lam_light *light = &reading->option->light;
    double intensity = reading->intensity;
    const lam_rgb *given = reading->colors;
    switch (light->type) {
    case LAM_LIGHT_AMBIENT:
        light->ambient = seen(reading, AMBIENT)
                             ? given[AMBIENT]
                             : scaled(seen(reading, COLOR) ? given[COLOR] : light->ambient, intensity);
        return;
    case LAM_LIGHT_HEMISPHERE:
        light->sky = scaled(seen(reading, SKY)     ? given[SKY]
                            : seen(reading, COLOR) ? given[COLOR]
                                                   : light->sky,
                            intensity);
        light->ground = scaled(seen(reading, GROUND) ? given[GROUND] : light->ground, intensity);
        return;
    default:
        break;
    }
    lam_rgb color = scaled(seen(reading, COLOR) ? given[COLOR] : (lam_rgb){1, 1, 1}, intensity);
    light->diffuse = seen(reading, DIFFUSE) ? given[DIFFUSE] : color;
    light->specular = seen(reading, SPECULAR) ? given[SPECULAR] : color;
    if (seen(reading, AMBIENT))
        light->ambient = given[AMBIENT];
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
    bool soft = seen(reading, INNER) || seen(reading, OUTER);
    if (soft && (seen(reading, CUTOFF) || seen(reading, EXPONENT)))
        return complain(error, LAM_BAD_ARGUMENT,
                        "both kinds of cone are given, expected cutoff and exponent, or inner and outer");
    if (soft && !seen(reading, OUTER))
        return complain(error, LAM_BAD_ARGUMENT, "'inner' is given without 'outer', expected both");
    if (!light_cone_check(seen(reading, CUTOFF) ? &reading->cutoff : NULL, &reading->inner,
                          soft ? &reading->outer : NULL, error))
        return false;
    if (soft) {
        light->inner_rad = (float)radians(reading->inner);
        light->outer_rad = (float)radians(reading->outer);
    } else if (seen(reading, CUTOFF)) {
        light->cutoff_rad = (float)radians(reading->cutoff);
    } else if (seen(reading, EXPONENT)) {
        light->cutoff_rad = 0; // no edge: the exponent alone shapes it
    }
    return true;
}

// w = 0, and what a directional light's place means.
static bool set_place(struct reading *reading, lam_error *error)
{
    struct light_option *option = reading->option;
    lam_light *light = &option->light;
    lam_vec3 *p = &light->position;
    option->has_position = seen(reading, POSITION);
    option->has_direction = seen(reading, DIRECTION);
    option->has_target = seen(reading, TARGET);
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
    for (int key = 0; key < KEY_COUNT; key++)
        if (reading->seen & ~keys_of_type[type] & BIT(key))
            return complain(error, LAM_BAD_ARGUMENT, "%s%s light has no '%s'", type == LAM_LIGHT_AMBIENT ? "an " : "a ",
                            lam_light_type_describe(type)->word, keys[key]);
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
    struct reading reading = {.option = option, .mode = mode, .intensity = 1, .w = 1};
    for (char *pair; (pair = strsep(&rest, ",")) != NULL;)
        if (!read_pair(&reading, pair, error))
            return false;
    if (!set_place(&reading, error) || !check_keys(&reading, error))
        return false;
    set_colors(&reading);
    return set_cone(&reading, error);
}
