// scene_file.c: reads scene files, and defines their importer.
#include "description.h"

#include "fail.h"
#include "json_parse.h"

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

// --- the sections of the file

static bool read_scene(struct reader *r, const json_t *root)
{
    int up = LAM_UP_Y;
    if (!json_take_word(&r->json, NULL, root, "up", up_words, &up) ||
        !take_rgb(r, NULL, root, "ambient", &r->scene->ambient))
        return false;
    if (r->source->params->up == LAM_UP_AUTO || r->source->params->up == LAM_UP_FILE)
        r->scene->up = (lam_up)up;
    return true;
}

// Reads the camera after the objects, because the middle of the scene is its default target.
static bool read_own_camera(struct reader *r, const json_t *root)
{
    const json_t *value = json_object_get(root, "camera");
    if (!value)
        return true;
    r->camera = &r->settings->camera;
    r->settings->present |= LAM_SETTING_CAMERA;
    return read_camera(r, KEY_OF(NULL, "camera"), value, &r->settings->camera);
}

// Names distinguish lights in reports and tables, so this function warns about the first two lights with the same name.
static bool warn_of_names(struct reader *r)
{
    struct arena scratch;
    arena_start(&scratch, r->source->call);
    struct name_table met = {.memory = &scratch};
    bool ok = true;
    for (int i = 0; ok && i < r->scene->lights.count; i++) {
        const char *name = lam_scene_light(r->scene, i)->name;
        int earlier = name ? name_table_find(&met, name) : -1;
        char shown[SHOWN_NAME_SIZE];
        if (earlier >= 0) {
            scene_warn(r->scene, "%s: lights[%d] and lights[%d] are both named '%s'", r->source->name, earlier, i,
                       shown_name(name, shown));
            break;
        }
        ok = !name || name_table_add(&met, name, i) || call_memory_error(r->source->call, strlen(name), r->json.error);
    }
    arena_free(&scratch);
    return ok;
}

static bool read_lights(struct reader *r, const json_t *root)
{
    const json_t *list = json_object_get(root, "lights");
    const struct place *place = KEY_OF(NULL, "lights");
    if (!list)
        return true;
    if (!json_is_array(list))
        return json_unexpected(&r->json, place, list, "a list of lights, [ … ]");
    r->settings->present |= LAM_SETTING_LIGHTS;
    r->settings->draw.rig = LAM_RIG_NONE;
    for (size_t i = 0; i < json_array_size(list); i++) {
        lam_light light;
        if (!read_light(r, ELEMENT_OF(place, i), json_array_get(list, i), &light) ||
            scene_adopt_light(r->scene, &light, r->json.error) < 0)
            return false;
    }
    return warn_of_names(r);
}

// Reads the planes that cut the scene, after it is loaded: one text of --section, or a list of them.
static bool read_sections(struct reader *r, const json_t *root)
{
    const json_t *list = json_object_get(root, "sections");
    const struct place *place = KEY_OF(NULL, "sections");
    const size_t count = json_is_array(list) ? json_array_size(list) : list != NULL;
    if (!count)
        return true;
    if (count > LAM_SECTIONS_MAX)
        return json_fail(&r->json, place, "found %zu sections, expected at most %d", count, LAM_SECTIONS_MAX);
    lam_section *sections = arena_array(&r->scene->arena, count, sizeof *sections);
    if (!sections)
        return call_memory_error(r->source->call, count * sizeof *sections, r->json.error);
    for (size_t i = 0; i < count; i++) {
        const json_t *one = json_is_array(list) ? json_array_get(list, i) : list;
        const struct place *here = json_is_array(list) ? ELEMENT_OF(place, i) : place;
        lam_error reason;
        if (!json_is_string(one))
            return json_unexpected(&r->json, here, one, "a section, such as \"x=0\" or \"z=40%\"");
        if (!lam_section_parse(json_string_value(one), r->color, &sections[i], &reason))
            return json_fail(&r->json, here, "%s", reason.text);
    }
    r->settings->sections = sections;
    r->settings->section_count = (int)count;
    r->settings->present |= LAM_SETTING_SECTIONS;
    return true;
}

// --- the whole file

static bool read_root(struct reader *r, const json_t *root)
{
    static const char *const others[] = {"lambent",   "image",   "camera", "ambient",  "environment",   "up",
                                         "materials", "objects", "lights", "sections", "reflection_map"};
    enum { OTHERS = sizeof others / sizeof *others };
    const char *keys[OTHERS + LAM_SETTINGS_MAX + 1];
    int count = 0;
    for (; count < OTHERS; count++)
        keys[count] = others[count];
    for (int i = 0; lam_draw_setting(i); i++)
        keys[count++] = lam_draw_setting(i)->key;
    keys[count] = NULL;
    int version = 0;
    if (!json_check_keys(&r->json, NULL, root, keys) ||
        !take_whole(r, NULL, root, "lambent", -1000000, 1000000, &version))
        return false;
    if (!json_object_get(root, "lambent"))
        return json_fail(&r->json, NULL, "'lambent' is missing, expected the format's version, 1");
    if (version != 1)
        return fail(r->json.error, LAM_UNSUPPORTED,
                    "%s: lambent: the format's version is %d, this program reads version 1", r->source->name, version);
    r->has_lights = json_object_get(root, "lights");
    // The order matters: the colour mode must be read before colours, and objects before what refers to them.
    return read_settings(r, root) && read_scene(r, root) && read_environment(r, root) && read_materials(r, root) &&
           read_objects(r, root) && read_own_camera(r, root) && read_lights(r, root) && read_sections(r, root);
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
    struct reader reader = {.json = {.file = source->name, .error = error ? error : &unwanted},
                            .source = source,
                            .scene = scene,
                            .settings = settings,
                            .color = source->params->color};
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
