// scene_json.c: scene files: the JSON around it all, the picture's settings, and the row in the table of formats.
#include "scene_reader.h"

#include "environment_samples.h"
#include "fail.h"
#include "json_parse.h"
#include "linear.h"

#include <string.h>

// --- is it one?

// An object whose first kilobytes hold the key "lambent".
static int scene_probe(const uint8_t *bytes, size_t size)
{
    static const char key[] = "\"lambent\"";
    size_t at = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0, end = size < 65536 ? size : 65536;
    while (at < end && (bytes[at] == ' ' || bytes[at] == '\t' || bytes[at] == '\r' || bytes[at] == '\n'))
        at++;
    if (at >= end || bytes[at] != '{')
        return 0;
    return memmem(bytes + at, end - at, key, sizeof key - 1) ? 2 : 0;
}

// --- the picture

static bool read_image(struct scene_reader *r, const json_t *root)
{
    static const char *const keys[] = {"size",  "samples",  "background", "color_mode",
                                       "color", "exposure", "tone",       NULL};
    const json_t *image = json_object_get(root, "image");
    const struct place *place = KEY_OF(NULL, "image");
    lam_picture_settings *s = r->settings;
    int color = LAM_COLOR_SRGB;
    if (!image)
        return true;
    // The colour mode first: it says how the others are read. Its former key is `color`.
    bool mode = json_object_get(image, "color_mode"), former = json_object_get(image, "color");
    if (!check_keys(r, place, image, keys))
        return false;
    if (mode && former)
        return fail_place(r, place, "has both color_mode and color, expected one of them");
    if (!take_word(r, place, image, mode ? "color_mode" : "color", color_words, &color))
        return false;
    if (mode || former) {
        s->present |= LAM_SETTING_COLOR;
        s->draw.color = (lam_color_mode)color;
        if (!r->source->params->override_color)
            r->color = (lam_color_mode)color;
    }
    const json_t *size = json_object_get(image, "size");
    if (size) {
        double sides[2];
        const struct place *here = KEY_OF(place, "size");
        if (!numbers_of(r, here, size, 2, 2, sides, NULL))
            return false;
        for (size_t i = 0; i < 2; i++)
            if (!(sides[i] >= 1 && sides[i] <= 65535) || sides[i] != (double)(int)sides[i])
                return fail_place(r, ELEMENT_OF(here, i), "found %.10g, expected pixels from 1 to 65535", sides[i]);
        s->width = (int)sides[0];
        s->height = (int)sides[1];
        s->present |= LAM_SETTING_SIZE;
    }
    if (json_object_get(image, "samples")) {
        int n = 0;
        if (!take_whole(r, place, image, "samples", 1, 16, &n))
            return false;
        if (n & (n - 1))
            return fail_place(r, KEY_OF(place, "samples"), "found %d, expected 1, 2, 4, 8 or 16", n);
        s->draw.samples = n;
        s->present |= LAM_SETTING_SAMPLES;
    }
    s->draw.background.a = 0;
    if (!take_rgba(r, place, image, "background", &s->draw.background) ||
        !take_number(r, place, image, "exposure", -100, 100, &s->draw.exposure))
        return false;
    s->present |= json_object_get(image, "background") ? LAM_SETTING_BACKGROUND : 0;
    s->present |= json_object_get(image, "exposure") ? LAM_SETTING_EXPOSURE : 0;
    struct json_choice tones[LAM_TONE_COUNT + 1];
    int tone = LAM_TONE_AUTO;
    tone_words(tones);
    if (!take_word(r, place, image, "tone", tones, &tone))
        return false;
    s->draw.tone = (lam_tone)tone;
    s->present |= json_object_get(image, "tone") ? LAM_SETTING_TONE : 0;
    return true;
}

static bool read_camera(struct scene_reader *r, const json_t *root)
{
    static const char *const keys[] = {"eye", "target", "up", "fovy", "ortho_half_height", "near", "far", NULL};
    const json_t *value = json_object_get(root, "camera");
    const struct place *place = KEY_OF(NULL, "camera");
    lam_camera camera = lam_camera_default();
    if (!value)
        return true;
    double fovy = math_degrees(camera.fovy_rad);
    bool has_fovy = json_object_get(value, "fovy"), ortho = json_object_get(value, "ortho_half_height");
    bool near = json_object_get(value, "near"), far = json_object_get(value, "far");
    if (!check_keys(r, place, value, keys) || !take_vector(r, place, value, "eye", &camera.eye) ||
        !take_vector(r, place, value, "target", &camera.target) || !take_direction(r, place, value, "up", &camera.up) ||
        !take_number(r, place, value, "fovy", 0, 180, &fovy) ||
        !take_number(r, place, value, "ortho_half_height", 0, 1e30, &camera.ortho_half_height) ||
        !take_number(r, place, value, "near", -1e30, 1e30, &camera.near_plane) ||
        !take_number(r, place, value, "far", -1e30, 1e30, &camera.far_plane))
        return false;
    if (has_fovy && ortho)
        return fail_place(r, place, "has both fovy and ortho_half_height, expected one of them");
    if (has_fovy && !(fovy > 0 && fovy < 180))
        return fail_place(r, KEY_OF(place, "fovy"), "found %.10g, expected degrees above 0 and below 180", fovy);
    if (ortho && camera.ortho_half_height == 0)
        return fail_place(r, KEY_OF(place, "ortho_half_height"), "found 0, expected a number above 0");
    if (near != far)
        return fail_place(r, place, "has only %s, expected both of near and far, or neither", near ? "near" : "far");
    if (near && !(camera.near_plane < camera.far_plane && (ortho || camera.near_plane > 0)))
        return fail_place(r, place, "near is %.10g and far is %.10g, expected %snear < far", camera.near_plane,
                          camera.far_plane, ortho ? "" : "0 < ");
    if (v3_length(v3_sub(camera.eye, camera.target)) == 0)
        return fail_place(r, place, "eye and target are the same point");
    if (has_fovy)
        camera.fovy_rad = math_radians(fovy);
    r->settings->camera = camera;
    r->settings->present |= LAM_SETTING_CAMERA;
    return true;
}

// Words and switches at the top of the file.
static bool read_methods(struct scene_reader *r, const json_t *root)
{
    lam_draw_params *draw = &r->settings->draw;
    int shading = 0, reflection = 0, stage = 0, viewer = 0, flat_normal = 0, up = LAM_UP_Y;
    lam_rgb ambient = {0, 0, 0};
    double cutoff = 0;
    bool terminator = true;
    struct json_choice reflections[LAM_REFLECTION_COUNT + 1];
    reflection_words(reflections);
    if (!take_word(r, NULL, root, "shading", shading_words, &shading) ||
        !take_word(r, NULL, root, "reflection", reflections, &reflection) ||
        !take_word(r, NULL, root, "stage", stage_words, &stage) ||
        !take_word(r, NULL, root, "viewer", viewer_words, &viewer) ||
        !take_word(r, NULL, root, "flat_normal", flat_normal_words, &flat_normal) ||
        !take_bool(r, NULL, root, "match_highlights", &draw->match_highlights) ||
        !take_bool(r, NULL, root, "single_scattering", &draw->single_scattering) ||
        !take_bool(r, NULL, root, "shadows", &draw->shadows) ||
        !take_bool(r, NULL, root, "shadow_terminator", &terminator) ||
        !take_whole(r, NULL, root, "shadow_samples", 1, 256, &draw->shadow_samples) ||
        !take_bool(r, NULL, root, "gl1", &draw->gl1) || !take_number(r, NULL, root, "light_cutoff", 0, 1, &cutoff) ||
        !take_word(r, NULL, root, "up", up_words, &up) || !take_rgb(r, NULL, root, "ambient", &ambient))
        return false;
    if (!take_whole(r, NULL, root, "anisotropy", 1, 16, &draw->anisotropy) ||
        !take_whole(r, NULL, root, "reference", 0, ENVIRONMENT_SAMPLES_MAX, &draw->reference))
        return false;
    if (draw->reference && draw->reference < ENVIRONMENT_SAMPLES_MIN)
        return fail_place(r, KEY_OF(NULL, "reference"), "found %d, expected 0 or at least %d", draw->reference,
                          ENVIRONMENT_SAMPLES_MIN);
    struct json_choice occlusions[LAM_OCCLUSION_COUNT + 1];
    int occlusion = LAM_OCCLUSION_AUTO;
    double radius = 0;
    occlusion_words(occlusions);
    if (!take_word(r, NULL, root, "ao", occlusions, &occlusion) ||
        !take_number(r, NULL, root, "ao_radius", 0.001, 10, &radius) ||
        !take_whole(r, NULL, root, "ao_samples", 1, 1024, &draw->occlusion_samples))
        return false;
    draw->occlusion = (lam_occlusion)occlusion;
    draw->occlusion_radius = (float)radius;
    if (json_object_get(root, "light_cutoff"))
        draw->light_cutoff = cutoff > 0 ? (float)cutoff : -1;
    draw->flat_terminator = !terminator;
    draw->shading = (lam_shading)shading;
    draw->reflection = (lam_reflection)reflection;
    draw->stage = (lam_stage)stage;
    draw->viewer = (lam_viewer)viewer;
    draw->flat_normal = (lam_flat_normal)flat_normal;
    r->scene->ambient = ambient;
    if (r->source->params->up == LAM_UP_AUTO)
        r->scene->up = (lam_up)up;
    static const struct {
        const char *key;
        unsigned bit;
    } bits[] = {{"shading", LAM_SETTING_SHADING},
                {"reflection", LAM_SETTING_REFLECTION},
                {"stage", LAM_SETTING_STAGE},
                {"viewer", LAM_SETTING_VIEWER},
                {"flat_normal", LAM_SETTING_FLAT_NORMAL},
                {"match_highlights", LAM_SETTING_MATCH_HIGHLIGHTS},
                {"gl1", LAM_SETTING_GL1},
                {"single_scattering", LAM_SETTING_SINGLE_SCATTERING},
                {"shadows", LAM_SETTING_SHADOWS},
                {"shadow_terminator", LAM_SETTING_SHADOWS},
                {"shadow_samples", LAM_SETTING_SHADOWS},
                {"anisotropy", LAM_SETTING_ANISOTROPY},
                {"reference", LAM_SETTING_REFERENCE},
                {"ao", LAM_SETTING_OCCLUSION},
                {"ao_radius", LAM_SETTING_OCCLUSION_RADIUS},
                {"ao_samples", LAM_SETTING_OCCLUSION_SAMPLES},
                {"light_cutoff", LAM_SETTING_LIGHT_CUTOFF}};
    for (size_t i = 0; i < sizeof bits / sizeof *bits; i++)
        r->settings->present |= json_object_get(root, bits[i].key) ? bits[i].bit : 0;
    bool by_vertex = draw->stage == LAM_STAGE_APPLICATION || draw->stage == LAM_STAGE_VERTEX;
    if (by_vertex && !json_object_get(root, "shading")) {
        draw->shading = LAM_SHADING_GOURAUD;
        r->settings->present |= LAM_SETTING_SHADING;
    }
    if (by_vertex && draw->shading == LAM_SHADING_PHONG)
        return fail_place(r, KEY_OF(NULL, "stage"),
                          "Phong shading has the stage fragment; application and vertex go with flat "
                          "and gouraud");
    if (draw->stage == LAM_STAGE_FRAGMENT && draw->shading == LAM_SHADING_GOURAUD)
        return fail_place(r, KEY_OF(NULL, "stage"),
                          "Gouraud shading has the stages application and vertex; fragment goes with "
                          "flat and phong");
    return true;
}

// --- the whole

static bool read_root(struct scene_reader *r, const json_t *root)
{
    static const char *const keys[] = {
        "lambent",    "image",      "camera",    "ambient",           "environment",      "shading",
        "reflection", "viewer",     "stage",     "flat_normal",       "match_highlights", "single_scattering",
        "gl1",        "up",         "materials", "objects",           "lights",           "light_cutoff",
        "anisotropy", "reference",  "shadows",   "shadow_terminator", "shadow_samples",   "ao",
        "ao_radius",  "ao_samples", NULL};
    int version = 0;
    if (!check_keys(r, NULL, root, keys) || !take_whole(r, NULL, root, "lambent", -1000000, 1000000, &version))
        return false;
    if (!json_object_get(root, "lambent"))
        return fail_place(r, NULL, "'lambent' is missing, expected the format's version, 1");
    if (version != 1)
        return fail(r->error, LAM_UNSUPPORTED, "%s: lambent: the format's version is %d, this program reads version 1",
                    r->source->name, version);
    r->has_lights = json_object_get(root, "lights");
    // The order matters: the colour mode before colours, objects before the lights that stand on them.
    return read_image(r, root) && read_camera(r, root) && read_methods(r, root) && read_environment(r, root) &&
           read_materials(r, root) && read_objects(r, root) && read_lights(r, root);
}

// The memory that Jansson needs for a file of this size at worst: one small value for each two bytes ("1,1,1").
static size_t tree_bytes(size_t size) { return size > SIZE_MAX / 32 ? SIZE_MAX : size * 32; }

static bool scene_load(const struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    lam_picture_settings *settings = arena_alloc_zeroed(&scene->arena, sizeof *settings);
    lam_error unwanted;
    size_t charge = tree_bytes(source->size);
    if (!settings || !call_charge(source->call, charge))
        return call_memory_error(source->call, charge, error);
    struct scene_reader reader = {.source = source,
                                  .scene = scene,
                                  .settings = settings,
                                  .color = source->params->color,
                                  .error = error ? error : &unwanted};
    json_t *root = json_parse((const char *)source->bytes, source->size, source->name, source->call, error);
    bool ok = root && read_root(&reader, root);
    json_decref(root);
    call_refund(source->call, charge);
    scene->settings = settings;
    scene->color = reader.color;
    return ok;
}

const struct importer importer_scene = {
    .is_scene_file = true,
    .name = "scene",
    .extensions = "json",
    .up = LAM_UP_Y,
    .probe = scene_probe,
    .load = scene_load,
};
