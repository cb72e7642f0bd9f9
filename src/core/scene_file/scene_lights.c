// scene_lights.c: reads the lights of a scene file.
#include "scene_reader.h"

#include "fail.h"
#include "linear.h"

#include <string.h>

// Keys that are not fields of a light, or that set several fields.
static const struct {
    const char *name;
    unsigned light_types;
} other_keys[] = {
    {"name", ~0u},
    {"type", ~0u},
    {"frame", ~0u},
    {"object", ~0u},
    {"color", ~(1u << LAM_LIGHT_HEMISPHERE)},
    {"intensity", ~(1u << LAM_LIGHT_HEMISPHERE)},
    {"position", 1u << LAM_LIGHT_DIRECTIONAL},
    {"target", 1u << LAM_LIGHT_SPOT},
};
enum { OTHER_KEYS = sizeof other_keys / sizeof *other_keys };

static bool check_light_keys(struct scene_reader *r, const struct place *place, const json_t *value,
                             lam_light_type type)
{
    const char *keys[OTHER_KEYS + LAM_FIELDS_MAX + 1];
    int count = 0;
    for (int i = 0; i < OTHER_KEYS; i++)
        if (other_keys[i].light_types >> type & 1)
            keys[count++] = other_keys[i].name;
    for (int i = 0; lam_light_field(i); i++)
        if (field_is_of(lam_light_field(i), type))
            keys[count++] = lam_light_field(i)->key;
    keys[count] = NULL;
    return check_keys(r, place, value, keys);
}

static lam_rgb scaled(lam_rgb c, double s)
{
    return (lam_rgb){(float)((double)c.r * s), (float)((double)c.g * s), (float)((double)c.b * s)};
}

// Multiplies `color` by `intensity`. The product is the ambient colour of an ambient light, and the diffuse and
// specular colours of other lights.
static bool read_color(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    bool ambient = light->type == LAM_LIGHT_AMBIENT;
    lam_rgb color = ambient ? light->ambient : light->diffuse;
    double intensity = 1;
    if (!take_rgb(r, place, value, "color", &color) || !take_number(r, place, value, "intensity", 0, 1e30, &intensity))
        return false;
    color = scaled(color, intensity);
    if (ambient)
        light->ambient = color;
    else
        light->diffuse = light->specular = color;
    return true;
}

// Reads the fields one by one. The position is read separately.
static bool read_fields(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    for (int i = 0; lam_light_field(i); i++) {
        const lam_field *field = lam_light_field(i);
        if (field_is_of(field, light->type) && field->offset != offsetof(lam_light, position) &&
            !take_field(r, place, value, field, light))
            return false;
    }
    return true;
}

// Reads a position of three numbers, or of four homogeneous coordinates. If the fourth coordinate w is 0, the other
// three are a direction towards the light.
static bool read_position(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    const json_t *position = json_object_get(value, "position");
    const struct place *here = KEY_OF(place, "position");
    double p[4] = {0, 0, 0, 1};
    size_t count;
    if (!position)
        return true;
    if (!numbers_of(r, here, position, 3, 4, p, &count))
        return false;
    if (p[3] != 0) {
        if (light->type == LAM_LIGHT_DIRECTIONAL)
            return fail_place(r, here, "a directional light has a direction, or a position whose fourth number is 0");
        light->position = v3(p[0] / p[3], p[1] / p[3], p[2] / p[3]);
        return true;
    }
    if (light->type == LAM_LIGHT_SPOT)
        return fail_place(r, here, "the fourth number is 0, but a spot light needs a position");
    if (p[0] == 0 && p[1] == 0 && p[2] == 0)
        return fail_place(r, here, "found 0, 0, 0, 0, expected a direction");
    if (json_object_get(value, "direction") || json_object_get(value, "target") ||
        json_object_get(value, "attenuation") || json_object_get(value, "range"))
        return fail_place(r, here,
                          "the fourth number is 0: an infinitely distant light has no target, attenuation, range or "
                          "second direction");
    light->type = LAM_LIGHT_DIRECTIONAL;
    light->direction = v3(-p[0], -p[1], -p[2]);
    return true;
}

static bool read_target(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    lam_vec3 target;
    if (!json_object_get(value, "target"))
        return true;
    if (json_object_get(value, "direction"))
        return fail_place(r, KEY_OF(place, "target"), "cannot be combined with direction");
    if (!take_vector(r, place, value, "target", &target))
        return false;
    light->direction = v3_sub(target, light->position);
    return v3_length(light->direction) > 0 ||
           fail_place(r, KEY_OF(place, "target"), "is the same point as the light's position");
}

static bool check_attenuation(struct scene_reader *r, const struct place *place, const lam_attenuation *a)
{
    return a->constant != 0 || a->linear != 0 || a->quadratic != 0 ||
           fail_place(r, KEY_OF(place, "attenuation"),
                      "all three numbers are 0, expected a + b d + c d^2 to be more than 0");
}

// Checks that the cone uses only one of two pairs of keys: cutoff and exponent, or inner and outer.
static bool check_cone(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    const json_t *inner = json_object_get(value, "inner"), *outer = json_object_get(value, "outer"),
                 *cutoff = json_object_get(value, "cutoff"), *exponent = json_object_get(value, "exponent");
    bool soft = inner || outer;
    if (soft && (cutoff || exponent))
        return fail_place(r, place, "inner and outer cannot be combined with cutoff or exponent");
    if (soft && !outer)
        return fail_place(r, place, "inner is given without outer, expected both");
    if (soft && !(light->inner_rad < light->outer_rad))
        return fail_place(r, KEY_OF(place, "inner"), "found %.10g, expected less than outer, which is %.10g",
                          json_number_value(inner), json_number_value(outer));
    double degrees = cutoff ? json_number_value(cutoff) : 45;
    if (degrees == 0 || (degrees > 90 && degrees < 180))
        return fail_place(r, KEY_OF(place, "cutoff"), "found %.10g, expected degrees above 0 and up to 90, or 180",
                          degrees);
    // With an exponent and without a cutoff, the cone has no hard edge.
    if (soft || (exponent && !cutoff))
        light->cutoff_rad = 0;
    return true;
}

static int objects_named(const struct lam_scene *scene, const char *name)
{
    int count = 0;
    for (int i = 0; i < scene->objects.count; i++) {
        const char *own = scene_object(scene, i)->name;
        count += own && strcmp(own, name) == 0;
    }
    return count;
}

static bool read_frame(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    int frame = LAM_FRAME_WORLD;
    if (!take_word(r, place, value, "frame", frame_words, &frame) ||
        !take_text(r, place, value, "object", &light->object))
        return false;
    light->frame = (lam_light_frame)frame;
    if (light->object && light->frame != LAM_FRAME_OBJECT)
        return fail_place(r, KEY_OF(place, "object"), "is allowed only with \"frame\": \"object\"");
    char shown[SHOWN_NAME_SIZE];
    int named = light->object ? objects_named(r->scene, light->object) : 1;
    if (named == 0)
        return fail_place(r, KEY_OF(place, "object"), "no object is named '%s'", shown_name(light->object, shown));
    if (named > 1)
        return fail_place(r, KEY_OF(place, "object"), "%d objects are named '%s', expected one", named,
                          shown_name(light->object, shown));
    return true;
}

static bool read_light(struct scene_reader *r, const struct place *place, const json_t *value)
{
    if (!json_is_object(value)) {
        char kind[JSON_KIND_SIZE];
        return fail_place(r, place, "found %s, expected a light, { … }", json_kind(value, kind));
    }
    int type = LAM_LIGHT_POINT;
    struct json_choice types[LAM_LIGHT_TYPE_COUNT + 1];
    light_type_words(types);
    if (!json_object_get(value, "type"))
        return fail_place(r, place, "'type' is missing, expected ambient, hemisphere, point, directional or spot");
    if (!take_word(r, place, value, "type", types, &type) || !check_light_keys(r, place, value, (lam_light_type)type))
        return false;
    lam_light light = lam_light_default((lam_light_type)type);
    if (!take_text(r, place, value, "name", &light.name) || !read_frame(r, place, value, &light) ||
        !read_color(r, place, value, &light) || !read_fields(r, place, value, &light) ||
        !read_position(r, place, value, &light) || !read_target(r, place, value, &light) ||
        !check_attenuation(r, place, &light.attenuation))
        return false;
    if (type == LAM_LIGHT_SPOT && !check_cone(r, place, value, &light))
        return false;
    lam_error reason;
    if (!lam_light_check(&light, &reason)) // checks rules that involve several keys
        return fail_place(r, place, "%s", reason.text);
    return scene_adopt_light(r->scene, &light, r->error) >= 0;
}

// Names distinguish lights in reports and tables, so this function warns about the first two lights with the same name.
static bool warn_of_names(struct scene_reader *r, const json_t *list)
{
    json_t *met = json_object();
    bool ok = met != NULL;
    size_t i;
    const json_t *light;
    json_array_foreach(list, i, light)
    {
        const json_t *name = json_object_get(light, "name");
        const json_t *earlier = name && ok ? json_object_get(met, json_string_value(name)) : NULL;
        if (earlier) {
            char shown[SHOWN_NAME_SIZE];
            scene_warn(r->scene, "%s: lights[%zu] and lights[%zu] are both named '%s'", r->source->name,
                       (size_t)json_integer_value(earlier), i, shown_name(json_string_value(name), shown));
            break;
        }
        ok = ok && (!name || json_object_set_new(met, json_string_value(name), json_integer((json_int_t)i)) == 0);
    }
    json_decref(met);
    return ok || fail_memory(r->error, json_array_size(list) * 64);
}

bool read_lights(struct scene_reader *r, const json_t *root)
{
    const json_t *list = json_object_get(root, "lights");
    const struct place *place = KEY_OF(NULL, "lights");
    if (!list)
        return true;
    if (!json_is_array(list)) {
        char kind[JSON_KIND_SIZE];
        return fail_place(r, place, "found %s, expected a list of lights, [ … ]", json_kind(list, kind));
    }
    r->settings->present |= LAM_SETTING_LIGHTS;
    r->settings->draw.rig = LAM_RIG_NONE;
    for (size_t i = 0; i < json_array_size(list); i++)
        if (!read_light(r, ELEMENT_OF(place, i), json_array_get(list, i)))
            return false;
    return warn_of_names(r, list);
}
