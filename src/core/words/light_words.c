// light_words.c: parses descriptions of lights: lists of key=value pairs.
#include <lambent/words.h>

#include <string.h>

#include "fail.h"
#include "linear.h"
#include "spelling.h"
#include "up_axis.h"
#include "word_values.h"

// A number identifies each key. If a key is a field, its number is the index of the field's first row in the table of
// lam_light_field. The other keys have the numbers below.
enum { TARGET = LAM_FIELDS_MAX, COLOR, INTENSITY, FRAME, NAME, KEYS };
_Static_assert((int)KEYS <= (int)WORD_KEYS_MAX, "the lists of word_key_of");

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

// The values of the keys read so far.
struct parser {
    lam_light light;
    lam_vec3 target;
    bool has_position, has_direction, has_target;
    bool position_in_radii, target_in_radii, linear_in_radii, quadratic_in_radii, range_in_radii, size_in_radii;
    lam_color_mode mode;
    uint64_t seen; // bits BIT(key)
    double numbers[KEYS][4];
    double w; // the fourth number of the position
};

// Returns the index of the first row of a key, or −1 if the key is not a field.
static int field_index(const char *key)
{
    for (int i = 0; lam_light_field(i); i++)
        if (strcmp(lam_light_field(i)->key, key) == 0)
            return i;
    return -1;
}

// Returns the name of a key, or NULL if there is no such key.
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
    const char *name = lam_light_field(key)->key;
    if (strcmp(name, "position") == 0 && type == LAM_LIGHT_DIRECTIONAL) // the direction towards the light
        return true;
    const lam_field *field;
    for (int i = key; (field = lam_light_field(i)); i++)
        if (field->light_types >> type & 1 && strcmp(field->key, name) == 0)
            return true;
    return false;
}

const char *lam_light_key(lam_light_type type, int index)
{
    for (int key = 0; key < KEYS && (unsigned)type < LAM_LIGHT_TYPE_COUNT; key++)
        if (key_name(key) && is_of_type(key, type) && index-- == 0)
            return key_name(key);
    return NULL;
}

static int find_key(const char *name, lam_error *error)
{
    int field = field_index(name);
    return field >= 0 ? field : word_key_of(name, KEYS, key_name, error);
}

static bool key_seen(const struct parser *parser, int key) { return parser->seen >> key & 1; }

static bool seen(const struct parser *parser, const char *name) { return key_seen(parser, field_index(name)); }

// --- values of keys

// Parses a point in the model's units, or in radii of the model's bounding sphere (a coordinate of 0 needs no r). If
// `w` is NULL, the point must consist of exactly three numbers.
static bool point_for(const char *key, const char *value, lam_vec3 *out, bool *in_radii, double *w, lam_error *error)
{
    double numbers[4];
    bool radii[4];
    int count;
    if (!word_numbers(value, 3, w ? 4 : 3, numbers, &count, radii) || (count == 4 && radii[3]))
        return fail(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected three numbers x/y/z%s, each with r for radii",
                    key, value, w ? " (or four, x/y/z/w)" : "");
    *in_radii = radii[0] || radii[1] || radii[2];
    for (int i = 0; i < 3; i++)
        if (*in_radii && !radii[i] && numbers[i] != 0)
            return fail(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected r after all of its numbers or after none", key,
                        value);
    double divisor = 1;
    if (count == 4) {
        *w = numbers[3];
        if (*w < 0)
            return fail(error, LAM_BAD_ARGUMENT, "%s is %.60s, expected w of at least 0", key, value);
        divisor = *w > 0 ? *w : 1;
    }
    *out = (lam_vec3){numbers[0] / divisor, numbers[1] / divisor, numbers[2] / divisor};
    return true;
}

static bool read_attenuation(const char *value, struct parser *parser, lam_error *error)
{
    double numbers[3];
    bool radii[3];
    int count;
    if (!word_numbers(value, 3, 3, numbers, &count, radii) || radii[0])
        return fail(error, LAM_BAD_ARGUMENT,
                    "found 'attenuation=%.60s', expected three numbers a/b/c, b and c with r for distances in radii",
                    value);
    if (numbers[0] < 0 || numbers[1] < 0 || numbers[2] < 0)
        return fail(error, LAM_BAD_ARGUMENT, "attenuation is %.60s, expected numbers of at least 0", value);
    if (numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0)
        return fail(error, LAM_BAD_ARGUMENT, "attenuation is %.60s, expected a + b d + c d2 above 0", value);
    parser->light.attenuation = (lam_attenuation){(float)numbers[0], (float)numbers[1], (float)numbers[2]};
    parser->linear_in_radii = radii[1];
    parser->quadratic_in_radii = radii[2];
    return true;
}

static bool read_range(const char *value, struct parser *parser, lam_error *error)
{
    double number;
    int count;
    if (!word_numbers(value, 1, 1, &number, &count, &parser->range_in_radii))
        return fail(error, LAM_BAD_ARGUMENT, "found 'range=%.60s', expected a distance, with r for radii", value);
    if (!(number > 0))
        return fail(error, LAM_BAD_ARGUMENT, "range is %.60s, expected a distance above 0", value);
    parser->light.range = (float)number;
    return true;
}

// Parses the radius of a sphere, or the angular radius of a disc in degrees. When all keys are known, set_size decides
// whether the number is a radius or an angle.
static bool read_size(const char *value, struct parser *parser, lam_error *error)
{
    double *number = parser->numbers[field_index("radius")];
    int count;
    if (!word_numbers(value, 1, 1, number, &count, &parser->size_in_radii))
        return fail(error, LAM_BAD_ARGUMENT,
                    "found 'radius=%.60s', expected a distance, with r for radii; of a directional light, degrees",
                    value);
    if (!(*number >= 0))
        return fail(error, LAM_BAD_ARGUMENT, "radius is %.60s, expected a number of at least 0", value);
    return true;
}

static bool set_size(struct parser *parser, lam_error *error)
{
    double number = parser->numbers[field_index("radius")][0];
    if (parser->light.type != LAM_LIGHT_DIRECTIONAL) {
        parser->light.radius = (float)number;
        return true;
    }
    parser->light.angular_radius_rad = (float)math_radians(number);
    return (number <= 89 && !parser->size_in_radii) ||
           fail(error, LAM_BAD_ARGUMENT,
                "radius is %g%s, expected 0 to 89 degrees: a directional light has an angular radius", number,
                parser->size_in_radii ? "r" : "");
}

static bool read_frame(char *value, struct parser *parser, lam_error *error)
{
    char *name = strchr(value, ':');
    if (name)
        *name++ = 0;
    lam_light *light = &parser->light;
    if (strcmp(value, "object") == 0) {
        light->frame = name ? LAM_FRAME_OBJECT : LAM_FRAME_MODEL;
        light->object = name;
        return !name || *name ||
               fail(error, LAM_BAD_ARGUMENT, "frame is 'object:', expected an object's name after it");
    }
    bool camera = strcmp(value, "camera") == 0, view = strcmp(value, "view") == 0;
    if (name || (!camera && !view && strcmp(value, "world") != 0))
        return fail(error, LAM_BAD_ARGUMENT, "found 'frame=%.60s', expected world, camera, view, object or object:NAME",
                    value);
    light->frame = camera ? LAM_FRAME_CAMERA : view ? LAM_FRAME_VIEW : LAM_FRAME_WORLD;
    return true;
}

static bool read_value(struct parser *parser, int key, char *value, lam_error *error)
{
    const lam_field color = {.key = "color", .type = LAM_FIELD_RGB};
    switch (key) {
    case TARGET:
        return point_for("target", value, &parser->target, &parser->target_in_radii, NULL, error);
    case COLOR:
        return word_field(&color, value, parser->mode, parser->numbers[COLOR], error);
    case INTENSITY:
        return word_number_of("intensity", value, 0, 1e30, parser->numbers[INTENSITY], error);
    case FRAME:
        return read_frame(value, parser, error);
    case NAME:
        parser->light.name = value;
        return *value || fail(error, LAM_BAD_ARGUMENT, "name is empty");
    default:
        break;
    }
    const lam_field *field = lam_light_field(key);
    if (field->type == LAM_FIELD_POINT)
        return point_for(field->key, value, &parser->light.position, &parser->position_in_radii, &parser->w, error);
    if (field->type == LAM_FIELD_TRIPLE)
        return read_attenuation(value, parser, error);
    if (strcmp(field->key, "range") == 0)
        return read_range(value, parser, error);
    if (strcmp(field->key, "radius") == 0)
        return read_size(value, parser, error);
    if (!word_field(field, value, parser->mode, parser->numbers[key], error))
        return false;
    word_set_field(field, &parser->light, parser->numbers[key]);
    return true;
}

static bool read_pair(struct parser *parser, char *pair, lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value)
        return fail(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value, such as position=1/2/3", pair);
    *value++ = 0;
    int key = find_key(pair, error);
    if (key < 0)
        return false;
    if (key_seen(parser, key))
        return fail(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    parser->seen |= BIT(key);
    return read_value(parser, key, value, error);
}

// --- making the light from its values

// Multiplies the colour `name` of the light by a factor. If `by_color` is set and the text does not set this colour,
// multiplies the value of the key `color` instead.
static void set_color(struct parser *parser, const char *name, bool by_color, double factor)
{
    lam_light *light = &parser->light;
    int index = field_index(name);
    double numbers[4];
    while (!(lam_light_field(index)->light_types >> light->type & 1))
        index++;
    lam_field_get(lam_light_field(index), light, numbers);
    if (by_color && key_seen(parser, COLOR) && !seen(parser, name))
        memcpy(numbers, parser->numbers[COLOR], sizeof numbers);
    for (int i = 0; i < 3; i++)
        numbers[i] *= factor;
    lam_field_set(lam_light_field(index), light, numbers);
}

static void set_colors(struct parser *parser)
{
    double intensity = key_seen(parser, INTENSITY) ? parser->numbers[INTENSITY][0] : 1;
    switch (parser->light.type) {
    case LAM_LIGHT_AMBIENT:
        if (!seen(parser, "ambient"))
            set_color(parser, "ambient", true, intensity);
        return;
    case LAM_LIGHT_HEMISPHERE: // the light's own colours are also multiplied
        set_color(parser, "sky", true, intensity);
        set_color(parser, "ground", false, intensity);
        return;
    default:
        if (!seen(parser, "diffuse"))
            set_color(parser, "diffuse", true, intensity);
        if (!seen(parser, "specular"))
            set_color(parser, "specular", true, intensity);
    }
}

static bool check_cone(const double *cutoff_deg, const double *inner_deg, const double *outer_deg, lam_error *error)
{
    if (outer_deg && !(*inner_deg < *outer_deg))
        return fail(error, LAM_BAD_ARGUMENT, "inner is %g and outer is %g degrees, expected inner < outer", *inner_deg,
                    *outer_deg);
    if (cutoff_deg && !((*cutoff_deg > 0 && *cutoff_deg <= 90) || *cutoff_deg == 180))
        return fail(error, LAM_BAD_ARGUMENT, "cutoff is %g degrees, expected a half angle above 0 and up to 90, or 180",
                    *cutoff_deg);
    return true;
}

static bool set_cone(struct parser *parser, lam_error *error)
{
    lam_light *light = &parser->light;
    bool inner = seen(parser, "inner"), outer = seen(parser, "outer"), cutoff = seen(parser, "cutoff");
    const double *degrees = parser->numbers[field_index("cutoff")];
    if ((inner || outer) && (cutoff || seen(parser, "exponent")))
        return fail(error, LAM_BAD_ARGUMENT,
                    "both kinds of cone are given, expected cutoff and exponent, or inner and outer");
    if (inner && !outer)
        return fail(error, LAM_BAD_ARGUMENT, "'inner' is given without 'outer', expected both");
    if (!check_cone(cutoff ? degrees : NULL, parser->numbers[field_index("inner")],
                    outer ? parser->numbers[field_index("outer")] : NULL, error))
        return false;
    if (!cutoff && !outer && seen(parser, "exponent"))
        light->cutoff_rad = 0; // the cone has no edge, and only the exponent determines its shape
    return true;
}

// Sets the position and the direction. Special rules apply to directional lights and to positions with w = 0.
static bool set_place(struct parser *parser, lam_error *error)
{
    lam_light *light = &parser->light;
    lam_vec3 *p = &light->position;
    parser->has_position = seen(parser, "position");
    parser->has_direction = seen(parser, "direction");
    parser->has_target = key_seen(parser, TARGET);
    if (parser->has_direction && parser->has_target)
        return fail(error, LAM_BAD_ARGUMENT, "'direction' and 'target' are given, expected only one");
    if (parser->has_position && parser->w == 0) {
        if (light->type == LAM_LIGHT_SPOT)
            return fail(error, LAM_BAD_ARGUMENT, "a spot light needs a position, expected w above 0");
        if (parser->has_direction || parser->has_target)
            return fail(error, LAM_BAD_ARGUMENT,
                        "a position with w = 0 is already a direction; omit the other direction");
        if (p->x == 0 && p->y == 0 && p->z == 0)
            return fail(error, LAM_BAD_ARGUMENT, "position is 0/0/0/0, expected a direction");
        light->type = LAM_LIGHT_DIRECTIONAL;
        light->direction = (lam_vec3){-p->x, -p->y, -p->z};
        parser->has_position = false;
        parser->has_direction = true;
    } else if (light->type == LAM_LIGHT_DIRECTIONAL && parser->has_position != parser->has_target) {
        return fail(error, LAM_BAD_ARGUMENT,
                    "a directional light needs direction=x/y/z, position=x/y/z/0, or both position and target");
    }
    return true;
}

static bool check_keys(const struct parser *parser, lam_error *error)
{
    lam_light_type type = parser->light.type;
    for (int key = 0; key < KEYS; key++)
        if (key_seen(parser, key) && !is_of_type(key, type))
            return fail(error, LAM_BAD_ARGUMENT, "%s%s light has no '%s'", type == LAM_LIGHT_AMBIENT ? "an " : "a ",
                        lam_light_type_describe(type)->word, key_name(key));
    return true;
}

static bool find_type(const char *name, lam_light_type *type, lam_error *error)
{
    const char *words[LAM_LIGHT_TYPE_COUNT];
    for (int i = 0; i < LAM_LIGHT_TYPE_COUNT; i++) {
        words[i] = lam_light_type_describe((lam_light_type)i)->word;
        if (strcmp(words[i], name) == 0) {
            *type = (lam_light_type)i;
            return true;
        }
    }
    const char *nearest = meant_word(name, words, LAM_LIGHT_TYPE_COUNT);
    return fail(error, LAM_BAD_ARGUMENT, "unknown light '%.60s'%s%s%s", name, nearest ? "; did you mean '" : "",
                nearest ? nearest : "", nearest ? "'?" : "; expected ambient, hemisphere, point, directional or spot");
}

static bool read_light(char *text, struct parser *parser, lam_error *error)
{
    char *rest = strchr(text, ':');
    if (rest)
        *rest++ = 0;
    lam_light_type type = LAM_LIGHT_POINT;
    if (!find_type(text, &type, error))
        return false;
    parser->light = lam_light_default(type);
    for (char *pair; (pair = strsep(&rest, ",")) != NULL;)
        if (!read_pair(parser, pair, error))
            return false;
    if (!set_place(parser, error) || !check_keys(parser, error))
        return false;
    set_colors(parser);
    return (!seen(parser, "radius") || set_size(parser, error)) && set_cone(parser, error);
}

// --- converting radii and targets for the scene

struct sphere {
    lam_vec3 centre;
    double radius;
};

static lam_vec3 about(const struct sphere *sphere, lam_vec3 v)
{
    return v3_add(sphere->centre, v3_scale(v, sphere->radius));
}

static int find_object(const lam_scene *scene, const char *name, lam_error *error)
{
    const char *nearest = NULL;
    int found = -1, named = 0;
    for (int i = 0, best = (int)strlen(name) / 3 + 2; i < lam_scene_object_count(scene); i++) {
        const char *other = lam_scene_object(scene, i)->name;
        int distance = other ? lam_edit_distance(name, other) : best;
        if (distance == 0 && named++ == 0)
            found = i;
        if (distance < best) {
            best = distance;
            nearest = other;
        }
    }
    if (named == 1)
        return found;
    if (named > 1)
        fail(error, LAM_BAD_ARGUMENT, "%d objects are named '%.60s', expected one", named, name);
    else
        fail(error, LAM_BAD_ARGUMENT, "the model has no object '%.60s'%s%.60s%s", name,
             nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    return -1;
}

// Gets the model's bounding sphere in the light's frame.
static bool sphere_in_frame(const lam_light *light, const lam_light_text_params *params, const lam_scene *scene,
                            struct sphere *out, lam_error *error)
{
    if (light->frame == LAM_FRAME_CAMERA) {
        lam_camera camera = params->camera ? *params->camera : lam_camera_default();
        lam_mat4 view = lam_camera_view_matrix(&camera);
        out->centre = mat4_point(&view, out->centre);
    } else if (light->frame == LAM_FRAME_VIEW) {
        out->centre = v3(0, 0, 0);
    } else if (light->frame == LAM_FRAME_OBJECT) {
        int object = find_object(scene, light->object, error);
        if (object < 0)
            return false;
        lam_scene_sphere(scene, object, &out->centre, &out->radius);
        if (!(out->radius > 0))
            out->radius = 1;
    }
    return true;
}

// Rotates a default direction or position, which is defined for y up, to the axes of the scene. A light in the world
// frame is then in front of the model for every up axis.
static lam_vec3 turned(const lam_light *light, const lam_scene *scene, lam_vec3 v)
{
    return light->frame == LAM_FRAME_WORLD || light->frame == LAM_FRAME_MODEL ? from_y_up(lam_scene_up(scene), v) : v;
}

static bool place_light(struct parser *parser, const lam_light_text_params *params, struct sphere model,
                        const lam_scene *scene, lam_error *error)
{
    lam_light *light = &parser->light;
    struct sphere here = model;
    if (!sphere_in_frame(light, params, scene, &here, error))
        return false;
    bool stands = light->type == LAM_LIGHT_POINT || light->type == LAM_LIGHT_SPOT;
    if (parser->has_position && parser->position_in_radii)
        light->position = about(&here, light->position);
    else if (stands && !parser->has_position && light->frame != LAM_FRAME_CAMERA)
        // a light in the camera's frame is at the eye
        light->position = about(&here, turned(light, scene, v3(1, 2, 3)));
    else if (light->type == LAM_LIGHT_DIRECTIONAL && !parser->has_direction && !parser->has_target)
        light->direction = turned(light, scene, light->direction);
    lam_vec3 target = !parser->has_target       ? here.centre
                      : parser->target_in_radii ? about(&here, parser->target)
                                                : parser->target;
    if (parser->has_target || (light->type == LAM_LIGHT_SPOT && !parser->has_direction)) {
        lam_vec3 way = v3_sub(target, light->position);
        if (way.x != 0 || way.y != 0 || way.z != 0)
            light->direction = way;
        else if (parser->has_target)
            return fail(error, LAM_BAD_ARGUMENT, "position and target are the same point");
    }
    double r = model.radius;
    if (parser->linear_in_radii)
        light->attenuation.linear = (float)((double)light->attenuation.linear / r);
    if (parser->quadratic_in_radii)
        light->attenuation.quadratic = (float)((double)light->attenuation.quadratic / (r * r));
    if (parser->range_in_radii)
        light->range = (float)((double)light->range * r);
    if (parser->size_in_radii)
        light->radius = (float)((double)light->radius * r);
    return true;
}

static bool in_radii(const struct parser *parser)
{
    return parser->position_in_radii || parser->target_in_radii || parser->linear_in_radii ||
           parser->quadratic_in_radii || parser->range_in_radii || parser->size_in_radii;
}

static bool add_light(lam_scene *scene, const char *text, const lam_light_text_params *params, int *index,
                      lam_error *error)
{
    struct parser parser = {.mode = params->color, .w = 1};
    char copy[WORDS_MAX];
    if (!text)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_light_text: text is NULL");
    if (!check_reserved("lam_light_text_params", params, error) ||
        (params->camera && !check_reserved("lam_camera", params->camera, error)) || !word_copy(text, copy, error) ||
        !read_light(copy, &parser, error))
        return false;
    if (!scene)
        return true;
    struct sphere model = {params->centre, params->radius};
    if (!(model.radius > 0)) {
        bool found = lam_scene_sphere(scene, -1, &model.centre, &model.radius);
        if (!found && in_radii(&parser))
            return fail(error, LAM_BAD_ARGUMENT, "expected numbers without r: there is no model to define the radius");
        model.radius = model.radius > 0 ? model.radius : 1;
    }
    if (!place_light(&parser, params, model, scene, error))
        return false;
    *index = lam_scene_add_light(scene, &parser.light, error);
    return *index >= 0;
}

int lam_scene_add_light_text(lam_scene *scene, const char *text, const lam_light_text_params *params, lam_error *error)
{
    static const lam_light_text_params plain = {0};
    int index = 0;
    return add_light(scene, text, params ? params : &plain, &index, error) ? index : -1;
}
