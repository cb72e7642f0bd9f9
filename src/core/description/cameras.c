// cameras.c: reads the camera of a description. The rules between its keys are only here.
#include "description.h"

#include "fail.h"
#include "linear.h"
#include "up_axis.h"

static const char *const keys[] = {"eye", "target", "up", "fovy", "ortho", "near", "far", "ortho_half_height", NULL};
enum { WORDS = 7 }; // "ortho_half_height" is the name of "ortho" in scene files

const char *lam_camera_key(int index) { return index >= 0 && index < WORDS ? keys[index] : NULL; }

static bool check(struct reader *r, const struct place *place, const json_t *value, const lam_camera *camera,
                  double fovy, const char *ortho_key)
{
    bool near = json_object_get(value, "near"), far = json_object_get(value, "far");
    bool has_fovy = json_object_get(value, "fovy"), ortho = json_object_get(value, ortho_key);
    if (json_object_get(value, "ortho") && json_object_get(value, "ortho_half_height"))
        return json_fail(&r->json, place, "contains both ortho and ortho_half_height, expected only one");
    if (has_fovy && ortho)
        return json_fail(&r->json, place, "contains both fovy and %s, expected only one", ortho_key);
    if (has_fovy && !(fovy > 0 && fovy < 180))
        return json_unexpected(&r->json, KEY_OF(place, "fovy"), json_object_get(value, "fovy"),
                               "degrees above 0 and below 180");
    if (ortho && camera->ortho_half_height == 0)
        return json_unexpected(&r->json, KEY_OF(place, ortho_key), json_object_get(value, ortho_key),
                               "a number above 0");
    if (near != far)
        return json_fail(&r->json, place, "has only %s, expected both of near and far, or neither",
                         near ? "near" : "far");
    if (near && !(camera->near_plane < camera->far_plane && (ortho || camera->near_plane > 0)))
        return json_fail(&r->json, place, "near is %.10g and far is %.10g, expected %snear < far", camera->near_plane,
                         camera->far_plane, ortho ? "" : "0 < ");
    // If words are checked before the scene is read, the default target is not known.
    bool aimed = json_object_get(value, "target") || r->source;
    if (aimed && v3_length(v3_sub(camera->eye, camera->target)) == 0)
        return json_fail(&r->json, place, "eye and target are the same point");
    return true;
}

bool read_camera(struct reader *r, const struct place *place, const json_t *value, lam_camera *out)
{
    lam_camera camera = lam_camera_default();
    lam_vec3 low, high;
    double fovy = math_degrees(camera.fovy_rad);
    const char *ortho = json_object_get(value, "ortho") ? "ortho" : "ortho_half_height";
    if (r->scene && !json_object_get(value, "target") && lam_scene_bounds(r->scene, &low, &high))
        camera.target = v3((low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2);
    if (r->scene)
        camera.up = from_y_up(lam_scene_up(r->scene), v3(0, 1, 0));
    if (!json_check_keys(&r->json, place, value, keys) || !take_vector(r, place, value, "eye", &camera.eye) ||
        !take_vector(r, place, value, "target", &camera.target) || !take_direction(r, place, value, "up", &camera.up) ||
        !json_take_number(&r->json, place, value, "fovy", 0, 180, &fovy) ||
        !json_take_number(&r->json, place, value, ortho, 0, 1e30, &camera.ortho_half_height) ||
        !json_take_number(&r->json, place, value, "near", -1e30, 1e30, &camera.near_plane) ||
        !json_take_number(&r->json, place, value, "far", -1e30, 1e30, &camera.far_plane) ||
        !check(r, place, value, &camera, fovy, ortho))
        return false;
    if (json_object_get(value, "fovy"))
        camera.fovy_rad = math_radians(fovy);
    *out = camera;
    return true;
}

bool lam_camera_parse(const char *text, const lam_scene *scene, lam_camera *camera, lam_error *error)
{
    struct reader r = {.json = {.error = error}, .scene = (lam_scene *)(uintptr_t)scene};
    if (!text || !camera)
        return fail(error, LAM_BAD_ARGUMENT, "lam_camera_parse: %s is NULL", text ? "camera" : "text");
    json_t *value = words_parse(text, NULL, 0, NULL, error);
    // Without an eye, the words describe no camera; a scene file has a default eye.
    bool ok =
        value && (json_object_get(value, "eye") ? read_camera(&r, NULL, value, camera)
                                                : json_check_keys(&r.json, NULL, value, keys) &&
                                                      json_fail(&r.json, NULL, "'eye' is missing, expected eye=x/y/z"));
    json_decref(value);
    return ok;
}
