// environment_option.c: --environment, --environment-rotation and --reflectivity.
#include "environment_option.h"

#include <stdlib.h>
#include <string.h>

#include "options.h"
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
    complain(error, LAM_BAD_ARGUMENT,
             "option '--environment': found %d names in '%.200s'%s, expected one file or six, px,nx,py,ny,pz,nz", count,
             text, empty ? ", one of them empty" : "");
    free(copy);
    return NULL;
}

const char *environment_option_built_in(const char *name)
{
    for (int i = 0; lam_environment_built_in_name(i); i++)
        if (strcmp(name, lam_environment_built_in_name(i)) == 0)
            return lam_environment_built_in_name(i);
    return NULL;
}

static lam_environment *load(const char *text, lam_color_mode color, const lam_control *control, lam_error *error)
{
    if (environment_option_built_in(text))
        return lam_environment_built_in(text, error);
    if (!strchr(text, ','))
        return lam_environment_load(text, color, control, error);
    const char *paths[LAM_FACE_COUNT];
    char *copy = environment_option_faces(text, paths, error);
    lam_environment *environment = copy ? lam_environment_load_faces(paths, color, control, error) : NULL;
    free(copy);
    return environment;
}

// Replaces the default material by a copy in the scene, which a scene file can store.
static bool replace_default(lam_scene *scene, int material, lam_error *error)
{
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        lam_object object = *lam_scene_object(scene, i);
        uint32_t parts = lam_scene_mesh(scene, object.mesh)->part_count;
        if (object.material >= 0)
            continue;
        object.material = material;
        if (!parts && !lam_scene_set_object(scene, i, &object, error))
            return false;
        for (uint32_t k = 0; k < parts; k++)
            if (lam_scene_mesh(scene, object.mesh)->parts[k].material < 0 &&
                !lam_scene_set_part_material(scene, object.mesh, k, material, error))
                return false;
    }
    return true;
}

static bool set_reflectivity(lam_scene *scene, lam_rgb reflectivity, lam_error *error)
{
    lam_material material;
    for (int i = 0; i < lam_scene_material_count(scene); i++) {
        material = *lam_scene_material(scene, i);
        material.reflectivity = reflectivity;
        if (!lam_scene_set_material(scene, i, &material, error))
            return false;
    }
    material = *lam_scene_default_material(scene);
    material.reflectivity = reflectivity;
    int copy = lam_scene_add_material(scene, &material, error);
    return copy >= 0 && replace_default(scene, copy, error);
}

static bool mirrors(const lam_material *material)
{
    return material->physical || material->reflectivity.r > 0 || material->reflectivity.g > 0 ||
           material->reflectivity.b > 0;
}

static bool material_mirrors(const lam_scene *scene, int index)
{
    return mirrors(index >= 0 ? lam_scene_material(scene, index) : lam_scene_default_material(scene));
}

static bool object_mirrors(const lam_scene *scene, const lam_object *object)
{
    const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
    if (object->back_material >= 0 && material_mirrors(scene, object->back_material))
        return true;
    if (object->material >= 0 || !mesh->part_count)
        return material_mirrors(scene, object->material);
    for (uint32_t i = 0; i < mesh->part_count; i++)
        if (material_mirrors(scene, mesh->parts[i].material))
            return true;
    return false;
}

static void warn_unseen(const struct options *options, lam_scene *scene)
{
    if (!lam_scene_environment(scene)) {
        if (option_given(options, "environment-rotation"))
            lam_scene_add_warning(scene, "option '--environment-rotation' has no effect: there is no environment");
        return;
    }
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        if (object_mirrors(scene, lam_scene_object(scene, i)))
            return;
    lam_scene_add_warning(scene,
                          "the environment is invisible: no material has a reflectivity (--reflectivity 0.5 sets one)");
}

bool environment_option_apply(const struct options *options, lam_scene *scene, const lam_control *control,
                              lam_error *error)
{
    if (options->has_reflectivity &&
        (options->reflectivity.r > 1 || options->reflectivity.g > 1 || options->reflectivity.b > 1))
        lam_scene_add_warning(scene,
                              "option '--reflectivity': a surface that returns more light than arrives (over 1)");
    if (options->has_reflectivity && !set_reflectivity(scene, options->reflectivity, error))
        return false;
    double rotation_rad = radians(options->environment_rotation_deg);
    bool ok = true;
    if (options->environment) {
        lam_environment *environment = load(options->environment, (lam_color_mode)options->color_mode, control, error);
        ok = environment && lam_scene_set_environment(scene, environment, rotation_rad, error);
        lam_environment_free(environment); // the scene holds a reference
    } else if (option_given(options, "environment-rotation") && lam_scene_environment(scene)) {
        ok = lam_scene_set_environment(scene, lam_scene_environment(scene), rotation_rad, error);
    }
    if (ok)
        warn_unseen(options, scene);
    return ok;
}
