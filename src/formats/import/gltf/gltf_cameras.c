// gltf_cameras.c: reads the file's cameras (section 3.10).
#include "gltf_cameras.h"

#include "gltf_json.h"
#include "gltf_nodes.h"

#include "linear.h"

#include <math.h>

#define LIMIT 1e30 // greater numbers mean infinity (some exporters write FLT_MAX)

static bool read_camera(struct gltf *gltf, int index, lam_camera *camera)
{
    static const struct json_choice words[] = {{"perspective", 0}, {"orthographic", 1}, {NULL, 0}};
    const json_t *object = gltf_list_item(gltf, "cameras", index);
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "cameras"), (size_t)index);
    int parallel = -1;
    if (!json_take_word(&gltf->json, place, object, "type", words, &parallel))
        return false;
    if (parallel < 0)
        return json_fail(&gltf->json, place, "type is missing");
    const char *key = words[parallel].name, *size_key = parallel ? "ymag" : "yfov";
    const struct place *here = KEY_OF(place, key);
    const json_t *numbers = gltf_take_object(gltf, place, object, key);
    double size = 0, near_plane = parallel ? -1 : 0, far_plane = HUGE_VAL;
    gltf_take_factors(gltf, here, numbers, size_key, 1, -HUGE_VAL, HUGE_VAL, &size);
    gltf_take_factors(gltf, here, numbers, "znear", 1, -HUGE_VAL, HUGE_VAL, &near_plane);
    gltf_take_factors(gltf, here, numbers, "zfar", 1, -HUGE_VAL, HUGE_VAL, &far_plane);
    size = parallel && size < 0 ? -size : size;
    if (!(size > 1e-6 && (parallel ? size < LIMIT : size < PI - 1e-6)))
        return json_fail(&gltf->json, here, "%s is missing or wrong (%.10g)", size_key, size);
    if (!(near_plane < LIMIT && (parallel ? near_plane >= 0 : near_plane > 0)))
        return json_fail(&gltf->json, here, "znear is missing or wrong (%.10g)", near_plane);
    if (far_plane <= near_plane)
        gltf_note(gltf, KEY_OF(here, "zfar"), "found %.10g, expected more than znear, %.10g; drawn without it",
                  far_plane, near_plane);
    *(parallel ? &camera->ortho_half_height : &camera->fovy_rad) = size;
    camera->near_plane = near_plane;
    // 0 means that lam_scene_camera fits the far plane to the scene
    camera->far_plane = far_plane > near_plane && far_plane < LIMIT ? far_plane : 0;
    return true;
}

static bool add_camera(struct gltf *gltf, int node_index)
{
    const json_t *object = gltf_list_item(gltf, "nodes", node_index);
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)node_index);
    const lam_mat4 *world = &gltf->nodes[node_index].world;
    struct scene_camera camera = {.camera = lam_camera_default()};
    int index = gltf_take_link(gltf, place, object, "camera", "cameras");
    bool ok = true;
    if (index < 0)
        return true;
    if (!read_camera(gltf, index, &camera.camera))
        return gltf_forgive(gltf);
    if (!(camera.name = gltf_name(gltf, object, &ok)) && ok)
        camera.name = gltf_name(gltf, gltf_list_item(gltf, "cameras", index), &ok);
    // The scale of nodes is ignored (section 3.10.1).
    lam_vec3 forward = v3_unit(mat4_vector(world, v3(0, 0, -1))), up = v3_unit(mat4_vector(world, v3(0, 1, 0)));
    if (v3_length(forward) == 0 || v3_length(up) == 0)
        return ok;
    camera.camera.eye = v3(world->m[0][3], world->m[1][3], world->m[2][3]);
    camera.camera.target = v3_add(camera.camera.eye, forward);
    camera.camera.up = up;
    return ok && scene_append(gltf->scene, &gltf->scene->cameras, &camera, sizeof camera, gltf->json.error) >= 0;
}

bool gltf_cameras_add(struct gltf *gltf)
{
    for (int i = 0; i < gltf->node_count; i++)
        if (gltf->nodes[gltf->node_order[i]].in_scene && !add_camera(gltf, gltf->node_order[i]))
            return false;
    return true;
}
