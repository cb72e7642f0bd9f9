// scene_json.c: reads the top-level JSON and the picture settings of scene files, and defines their importer.
#include "scene_reader.h"

#include "fail.h"
#include "json_parse.h"
#include "linear.h"

#include <stdio.h>
#include <string.h>

// The maximum number of operations for all implicit surfaces of a file together. This many operations take a few
// seconds.
enum { FORMULA_OPERATIONS = 200000000 };

// --- recognising scene files

// Recognises a JSON object whose first FILE_HEAD bytes contain the key "lambent".
static int scene_probe(const uint8_t *bytes, size_t size, size_t file_size)
{
    (void)file_size;
    static const char key[] = "\"lambent\"";
    size_t at = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0, end = size < FILE_HEAD ? size : FILE_HEAD;
    while (at < end && (bytes[at] == ' ' || bytes[at] == '\t' || bytes[at] == '\r' || bytes[at] == '\n'))
        at++;
    if (at >= end || bytes[at] != '{')
        return 0;
    // A key: programs also write their name as a value, for example into a glTF file.
    for (const uint8_t *found; (found = memmem(bytes + at, end - at, key, sizeof key - 1));) {
        at = (size_t)(found - bytes) + sizeof key - 1;
        while (at < end && (bytes[at] == ' ' || bytes[at] == '\t' || bytes[at] == '\r' || bytes[at] == '\n'))
            at++;
        if (at < end && bytes[at] == ':')
            return 2;
    }
    return 0;
}

// --- the settings of the picture

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
    // The colour mode is read first, because it determines how colours are read. Older files use the key `color` for
    // the mode.
    bool mode = json_object_get(image, "color_mode"), former = json_object_get(image, "color");
    if (!check_keys(r, place, image, keys))
        return false;
    if (mode && former)
        return fail_place(r, place, "contains both color_mode and color, expected only one");
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
        return fail_place(r, place, "contains both fovy and ortho_half_height, expected only one");
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

// Reads a list of keywords and sets one bit for each keyword.
static bool read_words(struct scene_reader *r, const json_t *root, const lam_setting *setting, int *bits)
{
    const json_t *list = json_object_get(root, setting->key);
    char known[160] = "";
    int value;
    bool ok = json_is_array(list);
    *bits = 0;
    for (size_t i = 0; ok && i < json_array_size(list); i++) {
        const char *text = json_string_value(json_array_get(list, i)), *word;
        int at = 0;
        while ((word = setting->word(at, &value)) && (!text || strcmp(word, text) != 0))
            at++;
        ok = word != NULL;
        *bits |= ok ? value : 0;
    }
    const char *word;
    for (int at = 0; (word = setting->word(at, &value)); at++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s\"%s\"", at ? ", " : "", word);
    }
    return ok || fail_place(r, KEY_OF(NULL, setting->key), "expected a list of some of %s", known);
}

// Reads the setting of one row of the table.
static bool read_setting(struct scene_reader *r, const json_t *root, const lam_setting *setting)
{
    void *member = (char *)&r->settings->draw + setting->offset;
    switch (setting->type) {
    case LAM_SETTING_WORD: {
        struct json_choice words[WORDS_MAX];
        setting_words(setting, words);
        return take_word(r, NULL, root, setting->key, words, member);
    }
    case LAM_SETTING_FLAG:
        return take_bool(r, NULL, root, setting->key, member);
    case LAM_SETTING_RGB:
        return take_rgb(r, NULL, root, setting->key, member);
    case LAM_SETTING_RGBA:
        return take_rgba(r, NULL, root, setting->key, member);
    case LAM_SETTING_WORDS:
        return read_words(r, root, setting, member);
    case LAM_SETTING_ANGLE: {
        double angle = 0;
        if (!take_number(r, NULL, root, setting->key, setting->min, setting->max, &angle))
            return false;
        *(float *)member = (float)math_radians(angle);
        return true;
    }
    case LAM_SETTING_NOT_FLAG: {
        bool on = true;
        if (!take_bool(r, NULL, root, setting->key, &on))
            return false;
        *(bool *)member = !on;
        return true;
    }
    case LAM_SETTING_WHOLE:
    case LAM_SETTING_NUMBER:
        break;
    }
    double number = 0, min = setting->zero ? 0 : setting->min;
    int whole = 0;
    bool is_whole = setting->type == LAM_SETTING_WHOLE;
    if (!(is_whole ? take_whole(r, NULL, root, setting->key, (int)min, (int)setting->max, &whole)
                   : take_number(r, NULL, root, setting->key, min, setting->max, &number)))
        return false;
    number = is_whole ? whole : number;
    if (number != 0 && number < setting->min)
        return fail_place(r, KEY_OF(NULL, setting->key), "found %.10g, expected 0 or at least %.10g", number,
                          setting->min);
    if (is_whole)
        *(int *)member = whole;
    else
        *(float *)member = number == 0 && setting->zero_is_negative ? -1.0f : (float)number;
    return true;
}

// Lighting per vertex implies Gouraud shading, unless the file sets another method.
static bool check_stage(struct scene_reader *r)
{
    lam_picture_settings *s = r->settings;
    uint64_t shading = UINT64_C(1) << lam_draw_setting_find("shading");
    bool by_vertex = s->draw.stage == LAM_STAGE_APPLICATION || s->draw.stage == LAM_STAGE_VERTEX;
    if (by_vertex && !(s->draw_present & shading)) {
        s->draw.shading = LAM_SHADING_GOURAUD;
        s->draw_present |= shading;
    }
    if (by_vertex && s->draw.shading == LAM_SHADING_PHONG)
        return fail_place(r, KEY_OF(NULL, "stage"),
                          "Phong shading needs the stage fragment; application and vertex work with flat and gouraud");
    if (s->draw.stage == LAM_STAGE_FRAGMENT && s->draw.shading == LAM_SHADING_GOURAUD)
        return fail_place(r, KEY_OF(NULL, "stage"),
                          "Gouraud shading needs the stage application or vertex; fragment works with flat and phong");
    return true;
}

// Reads top-level keys of the file, including those in the table of settings.
static bool read_settings(struct scene_reader *r, const json_t *root)
{
    int up = LAM_UP_Y;
    lam_rgb ambient = {0, 0, 0};
    for (int i = 0; lam_draw_setting(i); i++) {
        const lam_setting *setting = lam_draw_setting(i);
        if (!json_object_get(root, setting->key))
            continue;
        if (!read_setting(r, root, setting))
            return false;
        r->settings->draw_present |= UINT64_C(1) << i;
    }
    if (!take_word(r, NULL, root, "up", up_words, &up) || !take_rgb(r, NULL, root, "ambient", &ambient))
        return false;
    r->scene->ambient = ambient;
    if (r->source->params->up == LAM_UP_AUTO)
        r->scene->up = (lam_up)up;
    return check_stage(r);
}

// --- the whole file

static bool read_root(struct scene_reader *r, const json_t *root)
{
    static const char *const others[] = {"lambent", "image",     "camera",  "ambient", "environment",
                                         "up",      "materials", "objects", "lights"};
    enum { OTHERS = sizeof others / sizeof *others };
    const char *keys[OTHERS + LAM_SETTINGS_MAX + 1];
    int count = 0;
    for (; count < OTHERS; count++)
        keys[count] = others[count];
    for (int i = 0; lam_draw_setting(i); i++)
        keys[count++] = lam_draw_setting(i)->key;
    keys[count] = NULL;
    int version = 0;
    if (!check_keys(r, NULL, root, keys) || !take_whole(r, NULL, root, "lambent", -1000000, 1000000, &version))
        return false;
    if (!json_object_get(root, "lambent"))
        return fail_place(r, NULL, "'lambent' is missing, expected the format's version, 1");
    if (version != 1)
        return fail(r->error, LAM_UNSUPPORTED, "%s: lambent: the format's version is %d, this program reads version 1",
                    r->source->name, version);
    r->has_lights = json_object_get(root, "lights");
    // The order matters: the colour mode must be read before colours, and objects before the lights that are attached
    // to them.
    return read_image(r, root) && read_camera(r, root) && read_settings(r, root) && read_environment(r, root) &&
           read_materials(r, root) && read_objects(r, root) && read_lights(r, root);
}

// Returns the memory that Jansson needs for a file of this size in the worst case. In this case, every second byte of
// the file is a value ("1,1,1").
static size_t tree_bytes(size_t size) { return size > SIZE_MAX / 32 ? SIZE_MAX : size * 32; }

static bool scene_load(struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    lam_picture_settings *settings = arena_alloc_zeroed(&scene->arena, sizeof *settings);
    lam_error unwanted;
    if (!import_whole(source, error))
        return false;
    size_t charge = tree_bytes(source->size);
    if (!settings || !call_charge(source->call, charge))
        return call_memory_error(source->call, charge, error);
    struct scene_reader reader = {.source = source,
                                  .scene = scene,
                                  .settings = settings,
                                  .color = source->params->color,
                                  .error = error ? error : &unwanted};
    source->call->operation_limit = FORMULA_OPERATIONS;
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
