// picture_json.c: a drawn picture for pages.
#include "picture_json.h"

#include "light_place.h"

static void vector(struct json *json, const char *key, lam_vec3 v)
{
    json_open(json, key, '[');
    json_number(json, NULL, v.x);
    json_number(json, NULL, v.y);
    json_number(json, NULL, v.z);
    json_close(json, ']');
}

static void answer_camera(struct json *json, const struct job *job)
{
    const lam_camera *c = &job->camera;
    lam_vec3 centre, pole, front;
    double radius = 1;
    scene_axes(job->scene, &pole, &front);
    lam_scene_sphere(job->scene, -1, &centre, &radius);
    json_open(json, "camera", '{');
    vector(json, "eye", c->eye);
    vector(json, "target", c->target);
    vector(json, "up", c->up);
    json_number(json, "fovy_deg", c->fovy_rad * (180 / 3.14159265358979323846));
    json_number(json, "ortho", c->ortho_half_height);
    vector(json, "pole", pole);
    json_close(json, '}');
    json_open(json, "sphere", '{');
    vector(json, "centre", centre);
    json_number(json, "radius", radius);
    json_close(json, '}');
}

void picture_json(struct json *json, const struct job *job, double read_ms)
{
    json_count(json, "width", (uint64_t)job->image.width);
    json_count(json, "height", (uint64_t)job->image.height);
    json_count(json, "triangles", job->model_counts.triangles);
    json_number(json, "read_ms", read_ms);
    json_number(json, "frame_ms", job->times.frame.total_ms);
    answer_camera(json, job);
    json_open(json, "warnings", '[');
    for (int i = 0; lam_scene_warning(job->scene, i); i++)
        json_text(json, NULL, lam_scene_warning(job->scene, i));
    json_close(json, ']');
}
