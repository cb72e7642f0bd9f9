// job_camera.c: places the camera of a job, and the lights that depend on the camera.
#include "job_steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "animate_frame.h"
#include "console.h"
#include "scene_settings.h"

#include <lambent/light.h>

static lam_view view_of(const struct options *o)
{
    lam_view view = o->view.chosen ? *o->view.chosen : lam_view_of_side((lam_side)o->view.side);
    if (o->view.has_azimuth)
        view.azimuth_rad = radians(o->view.azimuth_deg);
    if (o->view.has_elevation)
        view.elevation_rad = radians(o->view.elevation_deg);
    view.orthographic = o->view.projection == 1;
    view.zoom = o->view.zoom;
    view.fovy_rad = radians(o->view.fov_deg);
    return view;
}

// Finds the file's camera that --camera names.
static bool find_camera(struct job *job, lam_error *error)
{
    int count = lam_scene_camera_count(job->scene),
        index = lam_scene_find_camera(job->scene, job->options->view.camera);
    char known[300] = "";
    if (lam_scene_camera(job->scene, index, &job->camera))
        return true;
    for (int i = 0; i < count && strlen(known) < sizeof known - 60; i++) {
        const char *name = lam_scene_camera_name(job->scene, i);
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%d%s%.40s%s", i ? ", " : "", i, name ? " ('" : "",
                 name ? name : "", name ? "')" : "");
    }
    return complain(
        error, LAM_BAD_ARGUMENT,
        "option '--camera': found '%.60s', expected keys such as eye=2/1/4, or a camera of the file, which has %s%s",
        job->options->view.camera, count ? known : "none",
        count > 1 && strlen(known) >= sizeof known - 60 ? ", ..." : "");
}

void job_choose_view(struct job *job, const struct job_view *view)
{
    job->own.picture.width = view->width;
    job->own.picture.height = view->height;
    if (*view->show)
        job->own.picture.show = view->show;
    job->own.view.chosen = view->given ? &view->view : NULL;
}

lam_camera job_fit_camera(const lam_scene *scene, lam_vec3 centre, const struct options *o, lam_rig rig)
{
    lam_view view = view_of(o);
    lam_vec3 axis;
    bool turns = job_turn_axis(o, &axis);
    lam_draw_params draw = draw_params_of(o, rig);
    return lam_camera_fit_ground(scene, &draw, o->picture.width, o->picture.height, &view, centre,
                                 turns ? &axis : NULL);
}

lam_scene *job_points_scene(const lam_vec3 *points, int count, lam_up up, lam_error *error)
{
    enum { MOST = 32 };
    uint32_t corners[3 * MOST];
    float positions[3 * MOST];
    for (int i = 0; i < count; i++) {
        const double p[3] = {points[i].x - points[0].x, points[i].y - points[0].y, points[i].z - points[0].z};
        for (int c = 0; c < 3; c++) {
            positions[3 * i + c] = (float)p[c];
            corners[3 * i + c] = (uint32_t)((i + c) % count);
        }
    }
    lam_mesh mesh = {.positions = positions,
                     .vertex_count = (uint32_t)count,
                     .indices = corners,
                     .triangle_count = (uint32_t)count,
                     .origin = {points[0].x, points[0].y, points[0].z}};
    lam_scene *scene = lam_scene_make(error);
    lam_object object = lam_object_default();
    if (scene && (lam_scene_add_mesh(scene, &mesh, error) < 0 || lam_scene_add_object(scene, &object, error) < 0)) {
        lam_scene_free(scene);
        return NULL;
    }
    if (scene)
        lam_scene_set_up(scene, up);
    return scene;
}

lam_scene *job_box_scene(lam_vec3 low, lam_vec3 high, lam_up up, lam_error *error)
{
    lam_vec3 corners[8];
    for (int i = 0; i < 8; i++)
        corners[i] = (lam_vec3){i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    return job_points_scene(corners, 8, up, error);
}

// Stores the scene's own lights. After these, the options' lights are added, again for each view's camera.
static bool keep_lights(struct job *job, lam_error *error)
{
    if (job->view_count <= 1 || !job->options->lighting.lights.count)
        return true;
    job->light_count = lam_scene_light_count(job->scene);
    free(job->lights);
    job->lights = calloc((size_t)job->light_count + 1, sizeof *job->lights);
    for (int i = 0; job->lights && i < job->light_count; i++)
        job->lights[i] = *lam_scene_light(job->scene, i);
    return job->lights || complain(error, LAM_MACHINE, "out of memory");
}

bool job_light_again(struct job *job, lam_error *error)
{
    if (!job->lights)
        return true;
    lam_scene_clear_lights(job->scene);
    for (int i = 0; i < job->light_count; i++)
        if (lam_scene_add_light(job->scene, &job->lights[i], error) < 0)
            return false;
    return job_light(job, &job->sphere, error);
}

static bool shared_camera(const struct job *job, lam_camera *camera)
{
    if (!job->shared || !job->shared->has_camera)
        return false;
    *camera = job->shared->camera;
    return true;
}

lam_mat4 job_camera_pose(const lam_camera *camera)
{
    lam_mat4 pose = lam_camera_pose(camera, LAM_CONVENTION_OPENGL);
    for (int i = 0; i < 9; i++)
        pose.m[i / 3][i % 3] = rint(pose.m[i / 3][i % 3] * 0x1p30) * 0x1p-30;
    return pose;
}

// Makes a camera calibrated, so that its file describes it exactly.
static void calibrate(lam_camera *camera, int width, int height)
{
    const lam_mat4 pose = job_camera_pose(camera);
    double lens[4];
    if (lam_camera_intrinsics(camera, width, height, LAM_CONVENTION_OPENGL, lens)) {
        camera->fx = lens[0];
        camera->fy = lens[1];
        camera->cx = lens[2];
        camera->cy = lens[3];
    }
    lam_camera_set_pose(camera, &pose, LAM_CONVENTION_OPENGL, NULL);
}

// Fits the camera before the model is rotated, so that one fit is valid for every angle. A camera given as text is not
// fitted, and does not rotate with the model.
static void fit_camera(struct job *job, const struct model_sphere *sphere, bool side_is_given)
{
    const struct options *o = job->options;
    if (animation_camera(job, &job->camera) || shared_camera(job, &job->camera))
        return;
    if (scene_settings_has_camera(job) && !side_is_given)
        job->camera = job->settings.camera;
    else if (!o->view.camera)
        job->camera = job_fit_camera(job->scene, sphere->centre, o, job->rig);
}

bool job_place_camera(struct job *job, lam_error *error)
{
    const struct model_sphere *sphere = &job->sphere;
    const struct options *o = job->options;
    lam_camera same;
    if (!keep_lights(job, error))
        return false;
    double start = clock_ms();
    if (job->view_count && !(job->cameras = calloc((size_t)job->view_count, sizeof *job->cameras)))
        return complain(error, LAM_MACHINE, "out of memory");
    // in reverse order, so that the first view is the current view afterwards
    for (int i = job->view_count - 1; i >= 0; i--) {
        job_choose_view(job, &job->views[i]);
        fit_camera(job, sphere, job->views[i].given);
        if (job->views[i].numbered)
            calibrate(&job->camera, job->views[i].width, job->views[i].height);
        job->cameras[i] = job->camera;
    }
    if (!job->view_count)
        fit_camera(job, sphere, false);
    job->times.camera += clock_ms() - start;
    if (!job_turn(job, sphere, error))
        return false;
    if (animation_camera(job, &same) || shared_camera(job, &same))
        return true;
    if (o->view.camera && !strchr(o->view.camera, '=') && !find_camera(job, error))
        return false;
    if (o->view.camera && strchr(o->view.camera, '='))
        // The text is always valid, because store_camera has parsed it.
        lam_camera_parse(o->view.camera, job->scene, &job->camera, NULL);
    for (int i = job->view_count - 1; i >= 0; i--) {
        if (job->views[i].camera) // also checked before
            lam_camera_parse(job->views[i].camera, job->scene, &job->camera, NULL);
        if (job->views[i].camera || o->view.camera)
            job->cameras[i] = job->camera;
    }
    return true;
}
