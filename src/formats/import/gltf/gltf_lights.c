// gltf_lights.c: reads the file's lights (KHR_lights_punctual).
#include "gltf.h"

#include "gltf_json.h"

#include "linear.h"

#include <lambent/light.h>

#include <math.h>

static const struct json_choice type_words[] = {
    {"directional", LAM_LIGHT_DIRECTIONAL}, {"point", LAM_LIGHT_POINT}, {"spot", LAM_LIGHT_SPOT}, {NULL, 0}};

// Gets the half angles of the cone, clamped to 0 ≤ inner < outer ≤ 90°.
static void take_cone(struct gltf *gltf, const struct place *place, const json_t *object, lam_light *light)
{
    double inner = 0, outer = PI / 4;
    const json_t *spot = gltf_take_object(gltf, place, object, "spot");
    const struct place *here = KEY_OF(place, "spot");
    gltf_take_factors(gltf, here, spot, "innerConeAngle", 1, -HUGE_VAL, HUGE_VAL, &inner);
    gltf_take_factors(gltf, here, spot, "outerConeAngle", 1, -HUGE_VAL, HUGE_VAL, &outer);
    light->outer_rad = (float)(outer > PI / 2 ? PI / 2 : outer < 1e-4 ? 1e-4 : outer);
    light->inner_rad = (float)(inner < 0 ? 0 : inner > PI / 2 ? PI / 2 : inner);
    if (light->inner_rad >= light->outer_rad)
        light->inner_rad = light->outer_rad * 0.999f;
    light->cutoff_rad = 0;
}

static float channel(double x) { return x > 0 ? x < 3e38 ? (float)x : 3e38f : 0; }

// Returns false, with a note, if the light is of an unknown type.
static bool read_light(struct gltf *gltf, const struct place *place, const json_t *object, lam_light *light)
{
    double color[3] = {1, 1, 1}, intensity = 1, range = 0;
    int type = -1;
    gltf_take_word(gltf, place, object, "type", type_words, &type);
    if (type < 0) {
        if (!json_object_get(object, "type"))
            gltf_note(gltf, place, "type is missing; drawn without this light");
        return false;
    }
    gltf_take_factors(gltf, place, object, "color", 3, 0, 1e30, color);
    gltf_take_factors(gltf, place, object, "intensity", 1, 0, 1e30, &intensity);
    gltf_take_factors(gltf, place, object, "range", 1, 0, HUGE_VAL, &range);
    *light = lam_light_default((lam_light_type)type);
    // The intensity in glTF (candela or lux) is π times Lambent's. In glTF, a white Lambertian surface reflects 1/π of
    // the light. In Lambent, such a surface reflects all of the light.
    light->diffuse = (lam_rgb){channel(color[0] * intensity / PI), channel(color[1] * intensity / PI),
                               channel(color[2] * intensity / PI)};
    light->specular = light->diffuse;
    if (type != LAM_LIGHT_DIRECTIONAL) {
        light->attenuation = (lam_attenuation){0, 0, 1};
        light->range = channel(range);
    }
    if (type == LAM_LIGHT_SPOT)
        take_cone(gltf, place, object, light);
    // The modules for other formats state what glTF lacks: ambient light, and attenuation.
    for (int i = 0; lam_light_field(i); i++)
        if (lam_light_field(i)->light_types & 1U << type)
            gltf_take_field(gltf, KEY_OF(KEY_OF(place, "extensions"), "LAMBENT_light"),
                            gltf_extension(object, "LAMBENT_light"), lam_light_field(i), false, light);
    return true;
}

static bool add_light(struct gltf *gltf, int node_index, const json_t *list)
{
    const json_t *object = gltf_list_item(gltf, "nodes", node_index);
    const json_t *extension = gltf_extension(object, "KHR_lights_punctual");
    const struct place *place = KEY_OF(ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)node_index), "extensions");
    const lam_mat4 *world = &gltf->nodes[node_index].world;
    size_t index = SIZE_MAX;
    if (!extension)
        return true;
    place = KEY_OF(place, "KHR_lights_punctual");
    if (!gltf_take_whole(gltf, place, extension, "light", 0, 1e9, &index))
        return gltf_forgive(gltf);
    const json_t *item = json_array_get(list, index);
    const struct place *lights = KEY_OF(KEY_OF(KEY_OF(NULL, "extensions"), "KHR_lights_punctual"), "lights");
    lam_light light;
    if (!item)
        gltf_note(gltf, KEY_OF(place, "light"), "names none of the file's %zu lights", json_array_size(list));
    if (!item || !read_light(gltf, ELEMENT_OF(lights, index), item, &light))
        return true;
    bool ok = true;
    if (!(light.name = gltf_name(gltf, object, &ok)) && ok)
        light.name = gltf_name(gltf, item, &ok);
    lam_vec3 forward = mat4_vector(world, v3(0, 0, -1));
    light.frame = LAM_FRAME_MODEL;
    light.position = v3(world->m[0][3], world->m[1][3], world->m[2][3]);
    if (v3_length(forward) > 0)
        light.direction = forward;
    if (ok && !lam_light_check(&light, gltf->json.error))
        return gltf_forgive(gltf);
    return ok && scene_adopt_light(gltf->scene, &light, gltf->json.error) >= 0;
}

bool gltf_lights_add(struct gltf *gltf)
{
    bool ok = true;
    const struct place *place = KEY_OF(KEY_OF(NULL, "extensions"), "KHR_lights_punctual");
    const json_t *list = gltf_take_list(gltf, place, gltf_extension(gltf->root, "KHR_lights_punctual"), "lights");
    for (int i = 0; ok && i < gltf->node_count; i++) {
        const struct gltf_node *node = &gltf->nodes[gltf->node_order[i]];
        ok = !node->in_scene || !node->visible || add_light(gltf, gltf->node_order[i], list);
    }
    return ok;
}
