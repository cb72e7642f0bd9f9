// environment.c: reads the environment of a scene file: pictures beside the scene file, or a built-in
// environment.
#include "companion.h"
#include "environment.h"
#include "fail.h"
#include "linear.h"
#include "description.h"

#include <string.h>

static bool read_faces(struct reader *r, const struct place *place, const json_t *faces, const char **names)
{
    char kind[JSON_KIND_SIZE];
    if (!json_is_array(faces) || json_array_size(faces) != LAM_FACE_COUNT)
        return json_fail(&r->json, place, "found %s, expected six names of pictures: +x, -x, +y, -y, +z, -z",
                         json_kind(faces, kind));
    for (size_t i = 0; i < LAM_FACE_COUNT; i++) {
        const json_t *face = json_array_get(faces, i);
        if (!json_is_string(face) || !json_string_length(face))
            return json_fail(&r->json, ELEMENT_OF(place, i), "found %s, expected a picture's name",
                             json_kind(face, kind));
        names[i] = json_string_value(face);
    }
    return true;
}

static bool read_built_in(struct reader *r, const struct place *place, const json_t *value, const char **name)
{
    struct json_choice known[8] = {0};
    int chosen = 0;
    for (int i = 0; i < 7 && (known[i].name = lam_environment_built_in_name(i)); i++)
        known[i].value = i;
    if (value && !json_choice_of(&r->json, KEY_OF(place, "builtin"), value, known, &chosen))
        return false;
    *name = value ? known[chosen].name : NULL;
    return true;
}

// The names of the pictures, and the members of the settings that receive their full paths.
struct pictures {
    struct reader *r;
    const char *const *names;
    const char **paths;
};

static bool open_picture(void *user, int index, struct call_control *call, struct file_bytes *file, const char **name,
                         lam_error *error)
{
    struct pictures *pictures = user;
    const struct import_source *source = pictures->r->source;
    struct companion companion;
    (void)call; // open_of_scene gets the call from the source
    if (!source->open_of_scene(source, pictures->names[index], &pictures->r->scene->arena, &companion, error))
        return false;
    *file = companion.file;
    *name = companion.shown;
    pictures->paths[index] =
        companion.path ? companion.path : arena_string(&pictures->r->scene->arena, pictures->names[index]);
    return pictures->paths[index] || call_memory_error(source->call, strlen(pictures->names[index]), error);
}

// Reads the pictures. Error messages name the key of the scene file.
static struct lam_environment *read_pictures(struct reader *r, const struct place *place, const char *const *names,
                                             int count, const char **paths)
{
    lam_error reason = {0};
    struct pictures pictures = {r, names, paths};
    struct picture_source source = {open_picture, &pictures};
    struct lam_environment *environment = environment_read(&source, count, r->color, r->source->call, &reason);
    if (!environment && reason.code == LAM_CANNOT_READ)
        json_fail(&r->json, place, "%s", reason.text);
    else if (!environment)
        *r->json.error = reason;
    return environment;
}

static struct lam_environment *load(struct reader *r, const struct place *place, const json_t *faces,
                                    const char *picture)
{
    lam_picture_settings *s = r->settings;
    const char *names[LAM_FACE_COUNT];
    const struct place *here = KEY_OF(place, faces ? "faces" : "equirectangular");
    if (s->environment_built_in)
        return lam_environment_built_in(s->environment_built_in, r->json.error);
    if (picture)
        return read_pictures(r, here, &picture, 1, &s->environment_picture);
    return read_faces(r, here, faces, names) ? read_pictures(r, here, names, LAM_FACE_COUNT, s->environment_faces)
                                             : NULL;
}

bool read_environment(struct reader *r, const json_t *root)
{
    static const char *const keys[] = {"faces", "equirectangular", "builtin", "rotation", NULL};
    const json_t *lights = json_object_get(root, "environment"), *map = json_object_get(root, "reflection_map");
    const json_t *value = map ? map : lights;
    const struct place *place = KEY_OF(NULL, map ? "reflection_map" : "environment");
    lam_picture_settings *s = r->settings;
    const char *picture = NULL;
    double rotation = 0;
    if (!value)
        return true;
    if (lights && map)
        return json_fail(&r->json, place, "found together with 'environment', expected one of the two");
    if (!json_check_keys(&r->json, place, value, keys) || !take_text(r, place, value, "equirectangular", &picture) ||
        !read_built_in(r, place, json_object_get(value, "builtin"), &s->environment_built_in) ||
        !json_take_number(&r->json, place, value, "rotation", -360000, 360000, &rotation))
        return false;
    const json_t *faces = json_object_get(value, "faces");
    if ((faces != NULL) + (picture != NULL) + (s->environment_built_in != NULL) != 1)
        return json_fail(&r->json, place, "expected one of faces, equirectangular and builtin");
    s->environment_rotation_rad = math_radians(rotation);
    s->reflection_map = map != NULL;
    s->present |= LAM_SETTING_ENVIRONMENT;
    lam_environment *environment = load(r, place, faces, picture);
    bool ok = environment && (map ? lam_scene_set_reflection_map : lam_scene_set_environment)(
                                 r->scene, environment, s->environment_rotation_rad, r->json.error);
    lam_environment_free(environment);
    return ok;
}
