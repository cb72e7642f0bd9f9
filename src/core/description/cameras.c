// cameras.c: reads the camera of a description. The rules between its keys are only here.
#include "description.h"

#include "fail.h"
#include "linear.h"
#include "up_axis.h"

#include <string.h>

// After WORDS follow "ortho_half_height", the name of "ortho" in scene files, and keys of other programs that must be 0.
static const char *const keys[] = {"eye",
                                   "target",
                                   "up",
                                   "fovy",
                                   "ortho",
                                   "near",
                                   "far",
                                   "fx",
                                   "fy",
                                   "cx",
                                   "cy",
                                   "K",
                                   "pose",
                                   "convention",
                                   "width",
                                   "height",
                                   "ortho_half_height",
                                   "skew",
                                   "k1",
                                   "k2",
                                   "k3",
                                   "k4",
                                   "k5",
                                   "k6",
                                   "p1",
                                   "p2",
                                   NULL};
enum { WORDS = 16, ZEROS = WORDS + 1 };

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
    if (aimed && !json_object_get(value, "pose") && v3_length(v3_sub(camera->eye, camera->target)) == 0)
        return json_fail(&r->json, place, "eye and target are the same point");
    return true;
}

// --- calibrated cameras

// Gets a matrix of size × size numbers, row by row, in one list or in a list of rows.
static bool take_matrix(struct reader *r, const struct place *place, const json_t *object, const char *key, size_t size,
                        double *out)
{
    const struct place *here = KEY_OF(place, key);
    const json_t *value = json_object_get(object, key);
    if (!json_is_array(json_array_get(value, 0)))
        return json_numbers_of(&r->json, here, value, size * size, size * size, out, NULL);
    if (json_array_size(value) != size)
        return json_fail(&r->json, here, "found %zu rows, expected %zu", json_array_size(value), size);
    for (size_t i = 0; i < size; i++)
        if (!json_numbers_of(&r->json, ELEMENT_OF(here, i), json_array_get(value, i), size, size, out + size * i, NULL))
            return false;
    return true;
}

// Reads fx, fy, cx and cy, or K.
static bool read_intrinsics(struct reader *r, const struct place *place, const json_t *value, double corner,
                            lam_camera *camera)
{
    static const char *const names[] = {"fx", "fy", "cx", "cy"}, *const others[] = {"fovy", "ortho",
                                                                                    "ortho_half_height"};
    double *const out[] = {&camera->fx, &camera->fy, &camera->cx, &camera->cy}, K[9] = {0};
    const bool matrix = json_object_get(value, "K");
    int given = 0;
    for (int i = 0; i < 4; i++)
        given += json_object_get(value, names[i]) != NULL;
    for (int i = ZEROS; keys[i]; i++) {
        double zero = 0;
        if (!json_take_number(&r->json, place, value, keys[i], -1e30, 1e30, &zero))
            return false;
        if (zero != 0)
            return json_unexpected(&r->json, KEY_OF(place, keys[i]), json_object_get(value, keys[i]),
                                   "0: Lambent draws neither distortion nor skew; undistort the pictures");
    }
    if (!take_whole(r, place, value, "width", 1, 65535, &camera->width) ||
        !take_whole(r, place, value, "height", 1, 65535, &camera->height))
        return false;
    if (!camera->width != !camera->height)
        return json_fail(&r->json, place, "has only %s, expected both of width and height, or neither",
                         camera->width ? "width" : "height");
    if (!given && !matrix)
        return true;
    for (int i = 0; i < 3; i++)
        if (json_object_get(value, others[i]))
            return json_fail(&r->json, place, "contains both %s and %s, expected only one", matrix ? "K" : "fx",
                             others[i]);
    if (matrix && given)
        return json_fail(&r->json, place, "contains both K and fx, fy, cx or cy, expected only one");
    if (matrix && !take_matrix(r, place, value, "K", 3, K))
        return false;
    if (matrix && (K[1] != 0 || K[3] != 0 || K[6] != 0 || K[7] != 0 || K[8] != 1))
        return json_fail(&r->json, KEY_OF(place, "K"), "expected fx, 0, cx, 0, fy, cy, 0, 0, 1: Lambent draws no skew");
    for (int i = 0; i < 4; i++) {
        *out[i] = K[i < 2 ? 4 * i : 3 * i - 4];
        if (!matrix && !json_object_get(value, names[i]))
            return json_fail(&r->json, place, "%s is missing, expected all of fx, fy, cx and cy", names[i]);
        if (!json_take_number(&r->json, place, value, names[i], -1e9, 1e9, out[i]))
            return false;
        if (i < 2 && !(*out[i] > 0))
            return json_fail(&r->json, KEY_OF(place, matrix ? "K" : names[i]), "%s is %.10g, expected more than 0",
                             names[i], *out[i]);
    }
    camera->cx += corner;
    camera->cy += corner;
    return true;
}

static bool read_pose(struct reader *r, const struct place *place, const json_t *value,
                      lam_camera_convention convention, lam_camera *camera)
{
    static const char *const others[] = {"eye", "target", "up"};
    lam_mat4 pose;
    lam_error error = {0};
    if (!json_object_get(value, "pose"))
        return true;
    for (int i = 0; i < 3; i++)
        if (json_object_get(value, others[i]))
            return json_fail(&r->json, place, "contains both pose and %s, expected only one", others[i]);
    return take_matrix(r, place, value, "pose", 4, &pose.m[0][0]) &&
           (lam_camera_set_pose(camera, &pose, convention, &error) ||
            json_fail(&r->json, KEY_OF(place, "pose"), "%s", error.text + strlen("pose: ")));
}

bool read_camera(struct reader *r, const struct place *place, const json_t *value, lam_camera *out)
{
    static const struct json_choice conventions[] = {
        {"opencv", LAM_CONVENTION_OPENCV}, {"opengl", LAM_CONVENTION_OPENGL}, {NULL, 0}};
    int convention = LAM_CONVENTION_OPENCV;
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
        !check(r, place, value, &camera, fovy, ortho) ||
        !json_take_word(&r->json, place, value, "convention", conventions, &convention) ||
        !read_intrinsics(r, place, value, convention == LAM_CONVENTION_OPENCV ? 0.5 : 0, &camera) ||
        !read_pose(r, place, value, (lam_camera_convention)convention, &camera))
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
    json_t *value = *text == '{' ? json_loads(text, 0, NULL) : words_parse(text, NULL, 0, NULL, error);
    if (!value && *text == '{')
        fail(error, LAM_BAD_ARGUMENT, "found '%.60s', expected an object of JSON", text);
    // Without a position, the words describe no camera; a scene file has a default eye.
    const bool placed = json_object_get(value, "eye") || json_object_get(value, "pose");
    bool ok = value && (placed ? read_camera(&r, NULL, value, camera)
                               : json_check_keys(&r.json, NULL, value, keys) &&
                                     json_fail(&r.json, NULL, "'eye' is missing, expected eye=x/y/z or pose="));
    json_decref(value);
    return ok;
}
