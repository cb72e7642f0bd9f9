// lights.c: reads a light of a description. The rules between its fields are only here.
#include "description.h"

#include "fail.h"
#include "linear.h"
#include "spelling.h"
#include "up_axis.h"

#include <lambent/words.h>

#include <string.h>

// --- keys

#define BIT(type) (1u << LAM_LIGHT_##type)
enum { ALL_TYPES = (1 << LAM_LIGHT_TYPE_COUNT) - 1, KEYS_MAX = LAM_FIELDS_MAX + 8 };

// Keys that are not fields of a light, or that set several fields. "type" is last, because options write it differently.
static const struct {
    const char *name;
    unsigned light_types;
} other_keys[] = {
    {"target", BIT(DIRECTIONAL) | BIT(SPOT)},
    {"color", ALL_TYPES},
    {"intensity", ALL_TYPES},
    {"frame", ALL_TYPES},
    {"object", ALL_TYPES},
    {"name", ALL_TYPES},
    {"position", BIT(DIRECTIONAL)},
    {"type", ALL_TYPES},
};

static bool is_listed(const char *const *keys, int count, const char *key)
{
    while (count > 0 && strcmp(keys[count - 1], key) != 0)
        count--;
    return count > 0;
}

// Lists the keys of a set of light types, ended by NULL. Returns their number.
static int keys_of(unsigned light_types, const char *keys[KEYS_MAX + 1])
{
    int count = 0;
    for (int i = 0; lam_light_field(i); i++)
        if (lam_light_field(i)->light_types & light_types && !is_listed(keys, count, lam_light_field(i)->key))
            keys[count++] = lam_light_field(i)->key;
    for (size_t i = 0; i < sizeof other_keys / sizeof *other_keys; i++)
        if (other_keys[i].light_types & light_types && !is_listed(keys, count, other_keys[i].name))
            keys[count++] = other_keys[i].name;
    keys[count] = NULL;
    return count;
}

const char *lam_light_key(lam_light_type type, int index)
{
    const char *keys[KEYS_MAX + 1];
    int count = (unsigned)type < LAM_LIGHT_TYPE_COUNT ? keys_of(1u << type, keys) - 1 : 0;
    return index >= 0 && index < count ? keys[index] : NULL;
}

static bool check_type(struct reader *r, const struct place *place, const json_t *value, lam_light_type type)
{
    const char *keys[KEYS_MAX + 1], *key;
    json_t *item;
    int count = keys_of(1u << type, keys);
    json_object_foreach((json_t *)(uintptr_t)value, key, item)
    {
        if (!is_listed(keys, count, key))
            return json_fail(&r->json, r->json.file ? KEY_OF(place, key) : place, "%s%s light has no '%s'",
                             type == LAM_LIGHT_AMBIENT ? "an " : "a ", lam_light_type_describe(type)->word, key);
    }
    return true;
}

static bool read_type(struct reader *r, const struct place *place, const json_t *value, lam_light_type *type)
{
    const char *keys[KEYS_MAX + 1];
    struct json_choice types[LAM_LIGHT_TYPE_COUNT + 1] = {0};
    int chosen = 0;
    for (int i = 0; i < LAM_LIGHT_TYPE_COUNT; i++)
        types[i] = (struct json_choice){lam_light_type_describe((lam_light_type)i)->word, i};
    keys_of(ALL_TYPES, keys);
    if (!json_is_object(value))
        return json_unexpected(&r->json, place, value, "a light, { … }");
    const json_t *word = json_object_get(value, "type");
    if (!word)
        return json_fail(&r->json, place,
                         "'type' is missing, expected ambient, hemisphere, point, directional or spot");
    if (!json_choice_of(&r->json, r->json.file ? KEY_OF(place, "type") : place, word, types, &chosen) ||
        !json_check_keys(&r->json, place, value, keys))
        return false;
    *type = (lam_light_type)chosen;
    return true;
}

// --- colours

// Multiplies a colour of the light by the intensity. If the description does not set this colour, it is `color`.
static bool set_color(struct reader *r, const struct place *place, const json_t *value, const char *key,
                      double intensity, lam_rgb *out)
{
    if (!json_object_get(value, key) && !take_rgb(r, place, value, "color", out))
        return false;
    *out = (lam_rgb){(float)((double)out->r * intensity), (float)((double)out->g * intensity),
                     (float)((double)out->b * intensity)};
    return true;
}

// Applies `color` times `intensity` to the colours that the description does not set, and `intensity` to both colours of
// a hemisphere.
static bool set_colors(struct reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    double n = 1;
    if (!json_take_number(&r->json, place, value, "intensity", 0, 1e30, &n))
        return false;
    if (light->type == LAM_LIGHT_HEMISPHERE)
        return set_color(r, place, value, "sky", n, &light->sky) &&
               set_color(r, place, NULL, "ground", n, &light->ground);
    if (light->type == LAM_LIGHT_AMBIENT)
        return json_object_get(value, "ambient") || set_color(r, place, value, "ambient", n, &light->ambient);
    return (json_object_get(value, "diffuse") || set_color(r, place, value, "diffuse", n, &light->diffuse)) &&
           (json_object_get(value, "specular") || set_color(r, place, value, "specular", n, &light->specular));
}

// --- cones

// A cone uses only one of two pairs of keys: cutoff and exponent, or inner and outer.
static bool check_cone(struct reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    const json_t *inner = json_object_get(value, "inner"), *outer = json_object_get(value, "outer"),
                 *cutoff = json_object_get(value, "cutoff"), *exponent = json_object_get(value, "exponent");
    bool soft = inner || outer;
    if (soft && (cutoff || exponent))
        return json_fail(&r->json, place, "inner and outer cannot be combined with cutoff or exponent");
    if (soft && !outer)
        return json_fail(&r->json, place, "inner is given without outer, expected both");
    if (soft && !(light->inner_rad < light->outer_rad))
        return json_fail(&r->json, KEY_OF(place, "inner"), "found %.10g, expected less than outer, which is %.10g",
                         json_number_value(inner), json_number_value(outer));
    double degrees = cutoff ? json_number_value(cutoff) : 45;
    if (degrees == 0 || (degrees > 90 && degrees < 180))
        return json_unexpected(&r->json, KEY_OF(place, "cutoff"), cutoff, "degrees above 0 and up to 90, or 180");
    // With an exponent and without a cutoff, the cone has no hard edge.
    if (soft || (exponent && !cutoff))
        light->cutoff_rad = 0;
    return true;
}

// --- frames

static bool read_frame(struct reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    const char *text = json_string_value(json_object_get(value, "frame"));
    int frame = LAM_FRAME_WORLD;
    if (!take_text(r, place, value, "object", &light->object))
        return false;
    if (text && strncmp(text, "object:", 7) == 0) { // short for "frame": "object", "object": …
        if (light->object || !text[7])
            return json_unexpected(&r->json, KEY_OF(place, "frame"), json_object_get(value, "frame"),
                                   "the name of one object after 'object:'");
        light->object = r->source ? arena_string(&r->scene->arena, text + 7) : text + 7;
        if (!light->object)
            return call_memory_error(r->source->call, strlen(text), r->json.error);
        frame = LAM_FRAME_OBJECT;
    } else if (!json_take_word(&r->json, place, value, "frame", frame_words, &frame)) {
        return false;
    }
    if (light->object && frame != LAM_FRAME_OBJECT)
        return json_fail(&r->json, KEY_OF(place, "object"), "is allowed only with \"frame\": \"object\"");
    // Without a name, the light moves with the whole model.
    light->frame = frame == LAM_FRAME_OBJECT && !light->object ? LAM_FRAME_MODEL : (lam_light_frame)frame;
    return true;
}

static int find_object(struct reader *r, const struct place *place, const char *name)
{
    int found = -1, named = 0;
    struct spelling spelling = spelling_of(name);
    char shown[2][SHOWN_NAME_SIZE];
    for (int i = 0; i < r->scene->objects.count; i++) {
        const char *own = scene_object(r->scene, i)->name;
        if (own && strcmp(own, name) == 0 && named++ == 0)
            found = i;
        else if (own)
            spelling_try(&spelling, own);
    }
    const char *nearest = spelling.nearest;
    if (named > 1)
        json_fail(&r->json, place, "%d objects are named '%s', expected one", named, shown_name(name, shown[0]));
    else if (!named)
        json_fail(&r->json, place, "no object is named '%s'%s%s%s", shown_name(name, shown[0]),
                  nearest ? "; did you mean '" : "", nearest ? shown_name(nearest, shown[1]) : "", nearest ? "'?" : "");
    return named == 1 ? found : -1;
}

// Gets the bounding sphere for positions in the light's frame.
static bool sphere_in_frame(struct reader *r, const struct place *place, const lam_light *light, struct sphere *out)
{
    if (!find_sphere(r, place, false))
        return false;
    *out = r->sphere;
    if (light->frame == LAM_FRAME_CAMERA) {
        lam_camera camera = r->camera ? *r->camera : lam_camera_default();
        lam_mat4 view = lam_camera_view_matrix(&camera);
        out->centre = mat4_point(&view, out->centre);
    } else if (light->frame == LAM_FRAME_VIEW) {
        out->centre = v3(0, 0, 0);
    } else if (light->frame == LAM_FRAME_OBJECT && r->scene) {
        int object = find_object(r, r->json.file ? KEY_OF(place, "object") : place, light->object);
        if (object < 0)
            return false;
        lam_scene_sphere(r->scene, object, &out->centre, &out->radius);
        out->radius = out->radius > 0 ? out->radius : 1;
    }
    return true;
}

// --- position and direction

static lam_vec3 about(const struct sphere *sphere, lam_vec3 v)
{
    return v3_add(sphere->centre, v3_scale(v, sphere->radius));
}

// Rotates a default direction or position, which is defined for y up, to the axes of the scene. A light in the world
// frame is then in front of the model for every up axis.
static lam_vec3 turned(const struct reader *r, const lam_light *light, lam_vec3 v)
{
    bool in_scene = light->frame == LAM_FRAME_WORLD || light->frame == LAM_FRAME_MODEL;
    return in_scene && r->scene ? from_y_up(lam_scene_up(r->scene), v) : v;
}

// The frame of the model is the frame of the file's first model, whose transform is already applied to the scene.
static lam_vec3 in_model(const struct reader *r, const lam_light *light, lam_vec3 v, bool is_point)
{
    const lam_mat4 *m = light->frame == LAM_FRAME_MODEL && r->scene ? r->scene->first_transform : NULL;
    return !m ? v : is_point ? mat4_point(m, v) : mat4_vector(m, v);
}

// A position with w = 0 is the direction from which a directional light shines.
static bool set_distant(struct reader *r, const struct place *place, const json_t *value, lam_vec3 from,
                        lam_light *light)
{
    const struct place *here = KEY_OF(place, "position");
    if (light->type == LAM_LIGHT_SPOT)
        return json_fail(&r->json, here, "the fourth number is 0, but a spot light needs a position");
    if (from.x == 0 && from.y == 0 && from.z == 0)
        return json_fail(&r->json, here, "found 0, 0, 0, 0, expected a direction");
    if (json_object_get(value, "direction") || json_object_get(value, "target"))
        return json_fail(&r->json, here, "with w = 0 is already a direction; omit the other direction");
    light->type = LAM_LIGHT_DIRECTIONAL;
    light->direction = in_model(r, light, v3(-from.x, -from.y, -from.z), false);
    return true;
}

// A position and a direction as written, or in radii of the sphere.
struct where {
    lam_vec3 position, target;
    double w;
    bool position_in_radii, target_in_radii;
};

// Sets the direction by a target, or towards the middle of the scene.
static bool set_direction(struct reader *r, const struct place *place, const json_t *value, const struct where *where,
                          const struct sphere *here, lam_light *light)
{
    bool directed = json_object_get(value, "direction"), aimed = json_object_get(value, "target");
    if (directed && aimed)
        return json_fail(&r->json, place, "direction and target are given, expected only one");
    if (directed || (light->type != LAM_LIGHT_SPOT && light->type != LAM_LIGHT_DIRECTIONAL)) {
        light->direction = in_model(r, light, light->direction, false);
        return true;
    }
    if (!aimed && (light->type == LAM_LIGHT_DIRECTIONAL || light->frame == LAM_FRAME_CAMERA)) {
        light->direction = turned(r, light, light->direction);
        return true;
    }
    lam_vec3 target = !aimed                   ? here->centre
                      : where->target_in_radii ? about(here, where->target)
                                               : in_model(r, light, where->target, true);
    lam_vec3 way = v3_sub(target, light->position);
    if (way.x != 0 || way.y != 0 || way.z != 0)
        light->direction = way;
    else if (aimed)
        return json_fail(&r->json, KEY_OF(place, "target"), "is the same point as the light's position");
    return true;
}

static bool set_place(struct reader *r, const struct place *place, const json_t *value, const struct where *where,
                      lam_light *light)
{
    struct sphere here;
    bool positioned = json_object_get(value, "position");
    bool in_radii = where->position_in_radii || where->target_in_radii;
    if (in_radii && !find_sphere(r, place, true))
        return false;
    if (in_radii && light->frame == LAM_FRAME_CAMERA && r->source && !r->camera)
        return json_fail(&r->json, place, "numbers in radii in the camera's frame need a \"camera\" in the file");
    bool needs_sphere = in_radii || !positioned || light->frame == LAM_FRAME_OBJECT || light->type == LAM_LIGHT_SPOT;
    if (needs_sphere && !sphere_in_frame(r, place, light, &here))
        return false;
    if (positioned)
        light->position =
            where->position_in_radii ? about(&here, where->position) : in_model(r, light, where->position, true);
    else if ((light->type == LAM_LIGHT_POINT || light->type == LAM_LIGHT_SPOT) && light->frame != LAM_FRAME_CAMERA)
        light->position = about(&here, turned(r, light, v3(1, 2, 3))); // in the camera's frame it is at the eye
    return set_direction(r, place, value, where, &here, light);
}

// --- the whole light

bool read_light(struct reader *r, const struct place *place, const json_t *value, lam_light *light)
{
    struct where where = {.w = 1};
    lam_light_type type = LAM_LIGHT_POINT;
    if (!read_type(r, place, value, &type))
        return false;
    *light = lam_light_default(type);
    const json_t *position = json_object_get(value, "position");
    if (!take_text(r, place, value, "name", &light->name) || !read_frame(r, place, value, light) ||
        !take_point(r, place, value, "position", &where.position, &where.w, &where.position_in_radii) ||
        !take_point(r, place, value, "target", &where.target, NULL, &where.target_in_radii))
        return false;
    bool distant = position && where.w == 0;
    if (distant && !set_distant(r, place, value, where.position, light))
        return false;
    if (!check_type(r, place, value, light->type))
        return false;
    if (!distant && light->type == LAM_LIGHT_DIRECTIONAL && position && !json_object_get(value, "target"))
        return json_fail(
            &r->json, KEY_OF(place, "position"),
            "a directional light has a direction, a position whose fourth number is 0, or a position and a "
            "target");
    for (int i = 0; lam_light_field(i); i++)
        if (field_is_of(lam_light_field(i), light->type) && lam_light_field(i)->type != LAM_FIELD_POINT &&
            !take_field(r, place, value, lam_light_field(i), light))
            return false;
    const lam_attenuation *a = &light->attenuation;
    if (a->constant == 0 && a->linear == 0 && a->quadratic == 0)
        return json_fail(&r->json, KEY_OF(place, "attenuation"),
                         "all three numbers are 0, expected a + b d + c d^2 to be more than 0");
    lam_error reason;
    return set_colors(r, place, value, light) && (distant || set_place(r, place, value, &where, light)) &&
           (light->type != LAM_LIGHT_SPOT || check_cone(r, place, value, light)) &&
           // The check of the library covers overflows, for example of color times intensity.
           (lam_light_check(light, &reason) || json_fail(&r->json, place, "%s", reason.text));
}

// --- the public function

int lam_scene_add_light_text(lam_scene *scene, const char *text, const lam_light_text_params *params, lam_error *error)
{
    static const lam_light_text_params plain = {0};
    params = params ? params : &plain;
    struct reader r = {.json = {.error = error},
                       .scene = scene,
                       .color = params->color,
                       .camera = params->camera,
                       .sphere = {params->centre, params->radius}};
    lam_light light;
    if (!text)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_light_text: text is NULL"), -1;
    if (!check_reserved("lam_light_text_params", params, error) ||
        (params->camera && !check_reserved("lam_camera", params->camera, error)))
        return -1;
    json_t *value = words_parse(text, "type", ':', NULL, error);
    bool ok = value && read_light(&r, NULL, value, &light);
    int index = !ok ? -1 : scene ? lam_scene_add_light(scene, &light, error) : 0;
    json_decref(value);
    return index;
}
