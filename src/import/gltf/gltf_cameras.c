// gltf_cameras.c: reads the file's cameras (section 3.10).
#include "gltf_cameras.h"

#include "gltf_json.h"
#include "gltf_nodes.h"

#include "linear.h"

#include <string.h>

static bool read_perspective(struct gltf *gltf, const struct place *place, const json_t *object, lam_camera *camera)
{
    double yfov = 0, near_plane = 0, far_plane = 0;
    if (!json_take_number(&gltf->json, place, object, "yfov", 1e-6, PI - 1e-6, &yfov) ||
        !json_take_number(&gltf->json, place, object, "znear", 1e-30, 1e30, &near_plane) ||
        !json_take_number(&gltf->json, place, object, "zfar", 1e-30, 1e30, &far_plane))
        return false;
    if (yfov == 0 || near_plane == 0)
        return json_fail(&gltf->json, place, "%s is missing", yfov == 0 ? "yfov" : "znear");
    if (json_object_get(object, "zfar") && far_plane <= near_plane)
        return json_fail(&gltf->json, KEY_OF(place, "zfar"), "found %.10g, expected more than znear, %.10g", far_plane,
                         near_plane);
    camera->fovy_rad = yfov;
    camera->near_plane = near_plane;
    camera->far_plane = far_plane; // 0 if zfar is missing; lam_scene_camera then fits the far plane to the scene
    return true;
}

static bool read_orthographic(struct gltf *gltf, const struct place *place, const json_t *object, lam_camera *camera)
{
    double ymag = 0, near_plane = 0, far_plane = 0;
    if (!json_take_number(&gltf->json, place, object, "ymag", -1e30, 1e30, &ymag) ||
        !json_take_number(&gltf->json, place, object, "znear", 0, 1e30, &near_plane) ||
        !json_take_number(&gltf->json, place, object, "zfar", 0, 1e30, &far_plane))
        return false;
    if (ymag == 0)
        return json_fail(&gltf->json, place,
                         "ymag is missing or 0; expected half the picture's height in the scene's units");
    if (far_plane <= near_plane)
        return json_fail(&gltf->json, KEY_OF(place, "zfar"), "found %.10g, expected more than znear, %.10g", far_plane,
                         near_plane);
    camera->ortho_half_height = ymag < 0 ? -ymag : ymag;
    camera->near_plane = near_plane;
    camera->far_plane = far_plane;
    return true;
}

static bool read_camera(struct gltf *gltf, int index, lam_camera *camera)
{
    static const struct json_choice words[] = {{"perspective", 0}, {"orthographic", 1}, {NULL, 0}};
    const json_t *object = gltf_list_item(gltf, "cameras", index);
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "cameras"), (size_t)index);
    int parallel = -1;
    bool ok = true;
    if (!json_take_word(&gltf->json, place, object, "type", words, &parallel))
        return false;
    if (parallel < 0)
        return json_fail(&gltf->json, place, "type is missing");
    const char *key = words[parallel].name;
    const json_t *numbers = gltf_take_object(gltf, place, object, key, &ok);
    if (ok && !numbers)
        return json_fail(&gltf->json, place, "%s is missing", key);
    return ok && (parallel ? read_orthographic(gltf, KEY_OF(place, key), numbers, camera)
                           : read_perspective(gltf, KEY_OF(place, key), numbers, camera));
}

static bool add_camera(struct gltf *gltf, int node_index)
{
    const json_t *object = gltf_list_item(gltf, "nodes", node_index);
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)node_index);
    const lam_mat4 *world = &gltf->nodes[node_index].world;
    struct scene_camera camera = {.camera = lam_camera_default()};
    int index;
    bool ok = true;
    if (!gltf_take_index(gltf, place, object, "camera", "cameras", &index))
        return false;
    if (index < 0)
        return true;
    if (!read_camera(gltf, index, &camera.camera))
        return false;
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
