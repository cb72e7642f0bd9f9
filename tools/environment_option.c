// environment_option.c: --environment, --environment-rotation and --reflectivity.
#include "environment_option.h"

#include <stdlib.h>
#include <string.h>

#include "camera_option.h"
#include "console.h"

char *environment_option_faces(const char *text, const char *paths[LAM_FACE_COUNT], lam_error *error)
{
    char *copy = strdup(text), *rest = copy;
    if (!copy) {
        complain(error, LAM_LIMIT, "out of memory");
        return NULL;
    }
    int count = 0;
    bool empty = false;
    for (char *path; (path = strsep(&rest, ",")); count++) {
        if (count < LAM_FACE_COUNT)
            paths[count] = path;
        empty |= !*path;
    }
    if (count == LAM_FACE_COUNT && !empty)
        return copy;
    complain(
        error, LAM_BAD_ARGUMENT,
        "option '--environment': found %d names in '%.200s'%s, expected one file or six, px,nx,py,ny,pz,nz",
        count, text, empty ? ", one of them empty" : "");
    free(copy);
    return NULL;
}

static lam_environment *load_faces(const char *text, lam_color_mode color, lam_error *error)
{
    const char *paths[LAM_FACE_COUNT];
    char *copy = environment_option_faces(text, paths, error);
    lam_environment *environment = copy ? lam_environment_load_faces(paths, color, error) : NULL;
    free(copy);
    return environment;
}

bool environment_option_load(const struct options *options, lam_environment **environment, lam_error *error)
{
    const char *text = options->environment;
    lam_color_mode color = (lam_color_mode)options->color;
    *environment = NULL;
    if (!text)
        return true;
    for (int i = 0; lam_environment_name(i); i++)
        if (strcmp(text, lam_environment_name(i)) == 0)
            return (*environment = lam_environment_built_in(text, error)) != NULL;
    *environment =
        strchr(text, ',') ? load_faces(text, color, error) : lam_environment_load(text, color, error);
    return *environment != NULL;
}

static bool set_reflectivity(lam_scene *scene, lam_rgb reflectivity, lam_error *error)
{
    lam_material material = *lam_scene_default_material(scene);
    material.reflectivity = reflectivity;
    bool ok = lam_scene_set_default_material(scene, &material, error);
    for (int i = 0; ok && i < lam_scene_material_count(scene); i++) {
        material = *lam_scene_material(scene, i);
        material.reflectivity = reflectivity;
        ok = lam_scene_set_material(scene, i, &material, error);
    }
    return ok;
}

bool environment_option_apply(const struct options *options, const lam_environment *environment,
                              lam_scene *scene, lam_error *error)
{
    if (options->has_reflectivity && !set_reflectivity(scene, options->reflectivity, error))
        return false;
    return !environment ||
           lam_scene_set_environment(scene, environment, radians(options->environment_rotation_deg), error);
}
