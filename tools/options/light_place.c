// light_place.c: the value of --light: from radii and targets to a light of the scene.
#include "light_option.h"

#include <string.h>

#include "console.h"
#include "suggest.h"

static lam_vec3 about(const struct model_sphere *sphere, lam_vec3 v)
{
    return (lam_vec3){sphere->centre.x + sphere->radius * v.x, sphere->centre.y + sphere->radius * v.y,
                      sphere->centre.z + sphere->radius * v.z};
}

static int find_object(const lam_scene *scene, const char *name, lam_error *error)
{
    struct suggestion nearest = suggest_start(name);
    int found = -1, named = 0;
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        const char *other = lam_scene_object(scene, i)->name;
        if (other && strcmp(other, name) == 0 && named++ == 0)
            found = i;
        if (other)
            suggest_try(&nearest, other);
    }
    if (named == 1)
        return found;
    if (named > 1) {
        complain(error, LAM_BAD_ARGUMENT, "option '--light': %d objects are named '%.60s', expected one", named, name);
        return -1;
    }
    complain(error, LAM_BAD_ARGUMENT, "option '--light': the model has no object '%.60s'%s%.60s%s", name,
             nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "", nearest.best ? "'?" : "");
    return -1;
}

// The sphere as the light's frame sees it.
static bool sphere_in_frame(const lam_light *light, const struct model_sphere *sphere, const lam_camera *camera,
                            const lam_scene *scene, struct model_sphere *out, lam_error *error)
{
    *out = *sphere;
    if (light->frame == LAM_FRAME_CAMERA) {
        lam_mat4 view = lam_camera_view_matrix(camera);
        double c[3] = {sphere->centre.x, sphere->centre.y, sphere->centre.z}, e[3];
        for (int i = 0; i < 3; i++)
            e[i] = view.m[i][0] * c[0] + view.m[i][1] * c[1] + view.m[i][2] * c[2] + view.m[i][3];
        out->centre = (lam_vec3){e[0], e[1], e[2]};
    } else if (light->frame == LAM_FRAME_OBJECT) {
        int object = find_object(scene, light->object, error);
        if (object < 0)
            return false;
        lam_scene_sphere(scene, object, &out->centre, &out->radius);
        if (!(out->radius > 0))
            out->radius = 1;
    }
    return true;
}

bool light_option_add(const struct light_option *option, const struct model_sphere *sphere, const lam_camera *camera,
                      lam_scene *scene, lam_error *error)
{
    lam_light light = option->light;
    struct model_sphere here;
    if (!sphere_in_frame(&light, sphere, camera, scene, &here, error))
        return false;
    bool stands = light.type == LAM_LIGHT_POINT || light.type == LAM_LIGHT_SPOT;
    if (option->has_position && option->position_in_radii)
        light.position = about(&here, light.position);
    else if (stands && !option->has_position && light.frame != LAM_FRAME_CAMERA)
        light.position = about(&here, (lam_vec3){1, 2, 3}); // a light of the camera stands at the eye
    lam_vec3 target = option->target_in_radii ? about(&here, option->target) : option->target;
    if (!option->has_target)
        target = here.centre;
    if (option->has_target || (light.type == LAM_LIGHT_SPOT && !option->has_direction)) {
        lam_vec3 way = {target.x - light.position.x, target.y - light.position.y, target.z - light.position.z};
        if (way.x != 0 || way.y != 0 || way.z != 0)
            light.direction = way;
        else if (option->has_target)
            return complain(error, LAM_BAD_ARGUMENT, "option '--light': position and target are the same point");
    }
    double r = sphere->radius;
    if (option->linear_in_radii)
        light.attenuation.linear = (float)((double)light.attenuation.linear / r);
    if (option->quadratic_in_radii)
        light.attenuation.quadratic = (float)((double)light.attenuation.quadratic / (r * r));
    if (option->range_in_radii)
        light.range = (float)((double)light.range * r);
    return lam_scene_add_light(scene, &light, error) >= 0;
}
