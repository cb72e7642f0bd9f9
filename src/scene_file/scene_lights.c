// scene_lights.c: the lights of a scene file.
#include "scene_reader.h"

#include "fail.h"
#include "linear.h"

#include <string.h>

#define EVERY_LIGHT "name", "type", "frame", "object"
#define REACHING    EVERY_LIGHT, "color", "intensity", "ambient", "diffuse", "specular"
#define PLACED      REACHING, "position", "attenuation", "range"
static const char *const ambient_keys[] = {EVERY_LIGHT, "color", "intensity", "ambient", NULL};
static const char *const hemisphere_keys[] = {EVERY_LIGHT, "sky", "ground", "up", NULL};
static const char *const point_keys[] = {PLACED, NULL};
static const char *const directional_keys[] = {REACHING, "position", "direction", NULL};
static const char *const spot_keys[] = {PLACED, "direction", "target", "cutoff", "exponent", "inner", "outer", NULL};
static const char *const *const keys_of[] = {[LAM_LIGHT_AMBIENT] = ambient_keys,
                                             [LAM_LIGHT_HEMISPHERE] = hemisphere_keys,
                                             [LAM_LIGHT_POINT] = point_keys,
                                             [LAM_LIGHT_DIRECTIONAL] = directional_keys,
                                             [LAM_LIGHT_SPOT] = spot_keys};

static lam_rgb scaled(lam_rgb c, double s)
{
    return (lam_rgb){(float)((double)c.r * s), (float)((double)c.g * s), (float)((double)c.b * s)};
}

// `color` times `intensity` is the ambient light of an ambient light, else diffuse and specular; a given `ambient`,
// `diffuse` or `specular` wins.
static bool read_colors(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    if (light->type == LAM_LIGHT_HEMISPHERE)
        return take_rgb(r, place, value, "sky", &light->sky) && take_rgb(r, place, value, "ground", &light->ground) &&
               take_direction(r, place, value, "up", &light->up);
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
    return take_rgb(r, place, value, "ambient", &light->ambient) &&
           take_rgb(r, place, value, "diffuse", &light->diffuse) &&
           take_rgb(r, place, value, "specular", &light->specular);
}

// Three numbers, or four: a homogeneous point, with w = 0 a direction from there.
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
        return fail_place(r, here, "the fourth number is 0, but a spot light stands somewhere");
    if (p[0] == 0 && p[1] == 0 && p[2] == 0)
        return fail_place(r, here, "found 0, 0, 0, 0, expected a direction");
    if (json_object_get(value, "direction") || json_object_get(value, "target") ||
        json_object_get(value, "attenuation") || json_object_get(value, "range"))
        return fail_place(r, here,
                          "the fourth number is 0: a light from infinitely far has no target, attenuation, range or "
                          "second direction");
    light->type = LAM_LIGHT_DIRECTIONAL;
    light->direction = v3(-p[0], -p[1], -p[2]);
    return true;
}

static bool read_direction(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    lam_vec3 target;
    if (!json_object_get(value, "target"))
        return take_direction(r, place, value, "direction", &light->direction);
    if (json_object_get(value, "direction"))
        return fail_place(r, KEY_OF(place, "target"), "stands beside direction, expected one of them");
    if (!take_vector(r, place, value, "target", &target))
        return false;
    light->direction = v3_sub(target, light->position);
    return v3_length(light->direction) > 0 || fail_place(r, KEY_OF(place, "target"), "is the light's position");
}

static bool read_reach(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    const json_t *attenuation = json_object_get(value, "attenuation");
    const struct place *here = KEY_OF(place, "attenuation");
    double a[3] = {1, 0, 0}, range = 0;
    if (attenuation && !numbers_of(r, here, attenuation, 3, 3, a, NULL))
        return false;
    for (size_t i = 0; i < 3; i++)
        if (a[i] < 0)
            return fail_place(r, ELEMENT_OF(here, i), "found %.10g, expected a number of at least 0", a[i]);
    light->attenuation = (lam_attenuation){(float)a[0], (float)a[1], (float)a[2]};
    if (light->attenuation.constant == 0 && light->attenuation.linear == 0 && light->attenuation.quadratic == 0)
        return fail_place(r, here, "all three numbers are 0, expected a + b d + c d^2 to be more than 0");
    if (!take_number(r, place, value, "range", 0, 1e30, &range))
        return false;
    light->range = (float)range;
    return true;
}

// Half angles in degrees. By one of two laws: cutoff and exponent, or inner and outer.
static bool read_cone(struct scene_reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    double cutoff = -1, exponent = 0, inner = 0, outer = 0;
    bool soft = json_object_get(value, "inner") || json_object_get(value, "outer");
    if (!take_number(r, place, value, "cutoff", 0, 180, &cutoff) ||
        !take_number(r, place, value, "exponent", 0, 1e30, &exponent) ||
        !take_number(r, place, value, "inner", 0, 90, &inner) || !take_number(r, place, value, "outer", 0, 90, &outer))
        return false;
    if (soft && (json_object_get(value, "cutoff") || json_object_get(value, "exponent")))
        return fail_place(r, place, "inner and outer stand beside cutoff or exponent, expected one pair of them");
    if (soft && !json_object_get(value, "outer"))
        return fail_place(r, place, "inner is given without outer, expected both");
    if (soft && !((float)math_radians(inner) < (float)math_radians(outer)))
        return fail_place(r, KEY_OF(place, "inner"), "found %.10g, expected less than outer, which is %.10g", inner,
                          outer);
    if (cutoff == 0 || (cutoff > 90 && cutoff < 180))
        return fail_place(r, KEY_OF(place, "cutoff"), "found %.10g, expected degrees above 0 and up to 90, or 180",
                          cutoff);
    light->inner_rad = (float)math_radians(inner);
    light->outer_rad = (float)math_radians(outer);
    light->exponent = (float)exponent;
    // With an exponent and no cutoff the cone has no edge.
    if (soft || (cutoff < 0 && json_object_get(value, "exponent")))
        light->cutoff_rad = 0;
    else if (cutoff > 0)
        light->cutoff_rad = (float)math_radians(cutoff);
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
        return fail_place(r, KEY_OF(place, "object"), "goes only with \"frame\": \"object\"");
    int named = light->object ? objects_named(r->scene, light->object) : 1;
    if (named == 0)
        return fail_place(r, KEY_OF(place, "object"), "no object is named '%.60s'", light->object);
    if (named > 1)
        return fail_place(r, KEY_OF(place, "object"), "%d objects are named '%.60s', expected one", named,
                          light->object);
    return true;
}

static bool read_light(struct scene_reader *r, const struct place *place, const json_t *value)
{
    if (!json_is_object(value)) {
        char kind[32];
        return fail_place(r, place, "found %s, expected a light, { … }", json_kind(value, kind));
    }
    int type = LAM_LIGHT_POINT;
    if (!json_object_get(value, "type"))
        return fail_place(r, place, "'type' is missing, expected ambient, hemisphere, point, directional or spot");
    if (!take_word(r, place, value, "type", light_type_words, &type) || !check_keys(r, place, value, keys_of[type]))
        return false;
    lam_light light = lam_light_default((lam_light_type)type);
    if (!take_text(r, place, value, "name", &light.name) || !read_frame(r, place, value, &light) ||
        !read_colors(r, place, value, &light) || !read_position(r, place, value, &light))
        return false;
    bool aimed = type == LAM_LIGHT_SPOT || (type == LAM_LIGHT_DIRECTIONAL && !json_object_get(value, "position"));
    if (aimed && !read_direction(r, place, value, &light))
        return false;
    if ((light.type == LAM_LIGHT_POINT || type == LAM_LIGHT_SPOT) && !read_reach(r, place, value, &light))
        return false;
    if (type == LAM_LIGHT_SPOT && !read_cone(r, place, value, &light))
        return false;
    lam_error reason;
    if (!lam_light_check(&light, &reason)) // what the keys could not say by themselves
        return fail_place(r, place, "%s", reason.text);
    return scene_take_light(r->scene, &light, r->error) >= 0;
}

// The names are to tell lights apart in reports and tables. The first two of one name are told.
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
            scene_warn(r->scene, "%s: lights[%zu] and lights[%zu] are both named '%.60s'", r->source->name,
                       (size_t)json_integer_value(earlier), i, json_string_value(name));
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
        char kind[32];
        return fail_place(r, place, "found %s, expected a list of lights, [ … ]", json_kind(list, kind));
    }
    r->settings->given |= LAM_GIVEN_LIGHTS;
    r->settings->draw.rig = LAM_RIG_NONE;
    for (size_t i = 0; i < json_array_size(list); i++)
        if (!read_light(r, ELEMENT_OF(place, i), json_array_get(list, i)))
            return false;
    return warn_of_names(r, list);
}
