// scene_environment.c: reads the environment of a scene file: pictures beside the scene file, or a built-in
// environment.
#include "companion.h"
#include "environment.h"
#include "fail.h"
#include "linear.h"
#include "scene_reader.h"
#include "shown_name.h"
#include "spelling.h"

#include <string.h>

static bool read_faces(struct scene_reader *r, const struct place *place, const json_t *faces, const char **names)
{
    char kind[JSON_KIND_SIZE];
    if (!json_is_array(faces) || json_array_size(faces) != LAM_FACE_COUNT)
        return fail_place(r, place, "found %s, expected six names of pictures: +x, -x, +y, -y, +z, -z",
                          json_kind(faces, kind));
    for (size_t i = 0; i < LAM_FACE_COUNT; i++) {
        const json_t *face = json_array_get(faces, i);
        if (!json_is_string(face) || !json_string_length(face))
            return fail_place(r, ELEMENT_OF(place, i), "found %s, expected a picture's name", json_kind(face, kind));
        names[i] = json_string_value(face);
    }
    return true;
}

static bool read_built_in(struct scene_reader *r, const struct place *place, const char **name)
{
    const char *known[8];
    char shown[SHOWN_NAME_SIZE];
    int count = 0;
    while (count < 8 && (known[count] = lam_environment_built_in_name(count))) {
        if (strcmp(known[count], *name) == 0) {
            *name = known[count];
            return true;
        }
        count++;
    }
    const char *near_word = meant_word(*name, known, count);
    return fail_place(r, place, "found '%s', expected sky or studio%s%s%s", shown_name(*name, shown),
                      near_word ? "; did you mean '" : "", near_word ? near_word : "", near_word ? "'?" : "");
}

// The names of the pictures, and the members of the settings that receive their full paths.
struct pictures {
    struct scene_reader *r;
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
static struct lam_environment *read_pictures(struct scene_reader *r, const struct place *place,
                                             const char *const *names, int count, const char **paths)
{
    lam_error reason = {0};
    struct pictures pictures = {r, names, paths};
    struct picture_source source = {open_picture, &pictures};
    struct lam_environment *environment = environment_read(&source, count, r->color, r->source->call, &reason);
    if (!environment && reason.code == LAM_CANNOT_READ)
        fail_place(r, place, "%s", reason.text);
    else if (!environment)
        *r->error = reason;
    return environment;
}

static struct lam_environment *load(struct scene_reader *r, const struct place *place, const json_t *faces,
                                    const char *picture)
{
    lam_picture_settings *s = r->settings;
    const char *names[LAM_FACE_COUNT];
    const struct place *here = KEY_OF(place, faces ? "faces" : "equirectangular");
    if (s->environment_built_in)
        return read_built_in(r, KEY_OF(place, "builtin"), &s->environment_built_in)
                   ? lam_environment_built_in(s->environment_built_in, r->error)
                   : NULL;
    if (picture)
        return read_pictures(r, here, &picture, 1, &s->environment_picture);
    return read_faces(r, here, faces, names) ? read_pictures(r, here, names, LAM_FACE_COUNT, s->environment_faces)
                                             : NULL;
}

bool read_environment(struct scene_reader *r, const json_t *root)
{
    static const char *const keys[] = {"faces", "equirectangular", "builtin", "rotation", NULL};
    const json_t *value = json_object_get(root, "environment");
    const struct place *place = KEY_OF(NULL, "environment");
    lam_picture_settings *s = r->settings;
    const char *picture = NULL;
    double rotation = 0;
    if (!value)
        return true;
    if (!check_keys(r, place, value, keys) || !take_text(r, place, value, "equirectangular", &picture) ||
        !take_text(r, place, value, "builtin", &s->environment_built_in) ||
        !take_number(r, place, value, "rotation", -360000, 360000, &rotation))
        return false;
    const json_t *faces = json_object_get(value, "faces");
    if ((faces != NULL) + (picture != NULL) + (s->environment_built_in != NULL) != 1)
        return fail_place(r, place, "expected one of faces, equirectangular and builtin");
    s->environment_rotation_rad = math_radians(rotation);
    s->present |= LAM_SETTING_ENVIRONMENT;
    lam_environment *environment = load(r, place, faces, picture);
    bool ok = environment && lam_scene_set_environment(r->scene, environment, s->environment_rotation_rad, r->error);
    lam_environment_free(environment);
    return ok;
}
