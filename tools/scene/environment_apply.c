// environment_apply.c: sets a scene's environment (--environment, --reflection-map) and its materials' reflectivity (--reflectivity).
#include "environment_apply.h"

#include "console.h"
#include "environment_option.h"

#include <lambent/material.h>

// Replaces the default material with the scene's material number `material`, because a scene file cannot store the
// default material.
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

// Returns whether a surface with this material shows the environment.
static bool mirrors(const lam_scene *scene, const lam_material *material, const struct options *options)
{
    lam_reflection model = (lam_reflection)options->draw.reflection;
    bool physical = material->physical || !lam_scene_has_reflection_map(scene);
    if (model != LAM_REFLECTION_AUTO)
        physical = lam_reflection_describe(model)->microfacet;
    bool reflects = material->reflectivity.r > 0 || material->reflectivity.g > 0 || material->reflectivity.b > 0;
    return !material->unlit && (physical || (!material->physical && reflects));
}

static bool material_mirrors(const lam_scene *scene, int index, const struct options *options)
{
    return mirrors(scene, index >= 0 ? lam_scene_material(scene, index) : lam_scene_default_material(scene), options);
}

static bool object_mirrors(const lam_scene *scene, const lam_object *object, const struct options *options)
{
    const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
    if (object->back_material >= 0 && material_mirrors(scene, object->back_material, options))
        return true;
    if (object->material >= 0 || !mesh->part_count)
        return material_mirrors(scene, object->material, options);
    for (uint32_t i = 0; i < mesh->part_count; i++)
        if (material_mirrors(scene, mesh->parts[i].material, options))
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
    if (options->shading.environment && !option_given(options, environment_option_name(options)))
        return; // the settings file applies to all models, so it causes no warning
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        if (object_mirrors(scene, lam_scene_object(scene, i), options))
            return;
    lam_scene_add_warning(scene, "the environment is invisible: no material is lit by it or has a reflectivity "
                                 "(--environment without a classic --reflection lights all; --material "
                                 "reflectivity=0.5)");
}

bool environment_set(const struct options *options, struct environment_cache *cache, lam_scene *scene,
                     const lam_control *control, lam_error *error)
{
    const char *text = options->shading.environment;
    double rotation_rad = radians(options->shading.environment_rotation_deg);
    bool map = text ? options->shading.reflection_map : lam_scene_has_reflection_map(scene), ok = true;
    if (environment_option_is_none(text))
        return lam_scene_set_environment(scene, NULL, 0, error);
    if (text)
        ok = environment_cache_set(cache, text, (lam_color_mode)options->picture.color_mode, scene, rotation_rad,
                                   control, error);
    if (!ok && error) { // the caller puts the model's name before the message, so the message must name the option
        lam_error reason = *error;
        complain(error, reason.code, "option '--%s': %.300s", environment_option_name(options), reason.text);
    }
    if (ok && lam_scene_environment(scene) && (text ? map : option_given(options, "environment-rotation")))
        ok = (map ? lam_scene_set_reflection_map : lam_scene_set_environment)(scene, lam_scene_environment(scene),
                                                                              rotation_rad, error);
    return ok;
}

bool environment_apply(const struct options *options, lam_scene *scene, lam_error *error)
{
    if (options->material.has_reflectivity &&
        (options->material.reflectivity.r > 1 || options->material.reflectivity.g > 1 ||
         options->material.reflectivity.b > 1))
        lam_scene_add_warning(scene, "option '--reflectivity': reflects more light than it receives (above 1)");
    if (options->material.has_reflectivity && !set_reflectivity(scene, options->material.reflectivity, error))
        return false;
    warn_unseen(options, scene);
    return true;
}
