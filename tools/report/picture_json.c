// picture_json.c: describes a drawn picture in JSON for web pages.
#include "light_place.h"
#include "report.h"
#include "vectors.h"

#include <lambent/material.h>

static void answer_camera(struct json *json, const struct job *job)
{
    const lam_camera *c = &job->camera;
    lam_vec3 centre, pole, front;
    double radius = 1;
    scene_axes(job->scene, &pole, &front);
    lam_scene_sphere(job->scene, -1, &centre, &radius);
    json_put(json,
             OBJECT("camera", VECTOR("eye", c->eye), VECTOR("target", c->target), VECTOR("up", c->up),
                    NUMBER("fovy_deg", in_degrees(c->fovy_rad)), NUMBER("ortho", c->ortho_half_height),
                    VECTOR("pole", pole)),
             OBJECT("sphere", VECTOR("centre", centre), NUMBER("radius", radius)));
}

// Returns the material of the first object, or of its first part.
static const lam_material *first_material(const lam_scene *scene)
{
    int index = -1;
    if (lam_scene_object_count(scene) > 0) {
        const lam_object *object = lam_scene_object(scene, 0);
        const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
        index = object->material < 0 && mesh->part_count ? mesh->parts[0].material : object->material;
    }
    return index < 0 ? lam_scene_default_material(scene) : lam_scene_material(scene, index);
}

void picture_json(struct json *json, const struct job *job, double read_ms)
{
    bool from_file = job->file_lights || (job->settings.present & LAM_SETTING_LIGHTS);
    json_put(json, COUNT("width", job->image.width), COUNT("height", job->image.height),
             COUNT("triangles", job->model_counts.triangles), NUMBER("read_ms", read_ms),
             NUMBER("frame_ms", job->times.frame.total_ms));
    answer_camera(json, job);
    json_put(
        json,
        FLAG("own_lights", from_file && lam_scene_light_count(job->scene) > 0 && !job->options->lighting.lights.count),
        COLOR("color", first_material(job->scene)->diffuse));
    json_warnings(json, job->scene);
}

// --- prints the values of the user's settings file as a section of a report.

bool settings_are_used(const struct options *options)
{
    for (int i = 0; option_table[i].name; i++)
        if (options->by_config[i])
            return true;
    return false;
}

void option_json(struct json *json, const char *name, const char *value)
{
    json_put(json, OBJECT(NULL, TEXT("name", name), TEXT("value", value)));
}

void settings_json(struct json *json, const struct options *options)
{
    if (!settings_are_used(options))
        return;
    json_open(json, "settings", '[');
    for (int i = 0; option_table[i].name; i++)
        if (options->by_config[i])
            option_json(json, option_table[i].name, options->values[i]);
    json_close(json, ']');
}
