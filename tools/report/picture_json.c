// picture_json.c: describes a drawn picture in JSON for web pages.
#include "picture_json.h"

#include <lambent/material.h>

#include "light_place.h"
#include "vectors.h"

static void answer_camera(struct json *json, const struct job *job)
{
    const lam_camera *c = &job->camera;
    lam_vec3 centre, pole, front;
    double radius = 1;
    scene_axes(job->scene, &pole, &front);
    lam_scene_sphere(job->scene, -1, &centre, &radius);
    json_open(json, "camera", '{');
    json_vector(json, "eye", c->eye);
    json_vector(json, "target", c->target);
    json_vector(json, "up", c->up);
    json_number(json, "fovy_deg", in_degrees(c->fovy_rad));
    json_number(json, "ortho", c->ortho_half_height);
    json_vector(json, "pole", pole);
    json_close(json, '}');
    json_open(json, "sphere", '{');
    json_vector(json, "centre", centre);
    json_number(json, "radius", radius);
    json_close(json, '}');
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
    json_count(json, "width", (uint64_t)job->image.width);
    json_count(json, "height", (uint64_t)job->image.height);
    json_count(json, "triangles", job->model_counts.triangles);
    json_number(json, "read_ms", read_ms);
    json_number(json, "frame_ms", job->times.frame.total_ms);
    answer_camera(json, job);
    bool from_file = job->file_lights || (job->settings.present & LAM_SETTING_LIGHTS);
    json_flag(json, "own_lights",
              from_file && lam_scene_light_count(job->scene) > 0 && !job->options->lighting.lights.count);
    const lam_material *first = first_material(job->scene);
    json_numbers(json, "color",
                 (double[]){(double)first->diffuse.r, (double)first->diffuse.g, (double)first->diffuse.b}, 3);
    json_open(json, "warnings", '[');
    for (int i = 0; lam_scene_warning(job->scene, i); i++)
        json_message(json, NULL, lam_scene_warning(job->scene, i));
    json_close(json, ']');
}
