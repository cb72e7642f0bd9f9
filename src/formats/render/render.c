// render.c: implements lam_render: loads a model, fits the camera and draws with the defaults of the `lambent` program.
#include "fail.h"

#include <lambent/render.h>
#include <lambent/scene_file.h>
#include <lambent/words.h>

#include <stdio.h>
#include <string.h>

static lam_scene *make_shape(const char *name, const lam_control *control, lam_error *error)
{
    lam_scene *scene = lam_scene_make(error);
    if (!scene)
        return NULL;
    lam_object object = lam_object_default();
    object.name = name;
    object.mesh = lam_scene_add_shape(scene, name, &(lam_shape_params){.control = control}, error);
    if (object.mesh >= 0 && lam_scene_add_object(scene, &object, error) >= 0)
        return scene;
    lam_scene_free(scene);
    return NULL;
}

static bool reads_tangents(const lam_draw_params *draw)
{
    // if `info` is NULL, drawing reports the error
    const lam_reflection_info *info = lam_reflection_describe(draw->reflection);
    return info && info->tangents;
}

static lam_scene *load(const char *model, const lam_render_params *params, lam_error *error)
{
    if (lam_shape_find(model) >= 0)
        return make_shape(model, params->control, error);
    // If this call makes the device, the device draws only one frame. The CPU device then computes only the normals of
    // the visible triangles. The Kajiya–Kay model is an exception: it needs tangents, which depend on all normals.
    bool draws_once = !params->device && !(params->draw && reads_tangents(params->draw));
    lam_load_params plain = {.threads = params->threads, .normals_when_drawn = draws_once};
    lam_scene *scene = lam_scene_load(model, params->load ? params->load : &plain, params->control, error);
    if (!scene || lam_scene_triangle_count(scene) + lam_scene_line_count(scene) + lam_scene_point_count(scene) > 0)
        return scene;
    fail(error, LAM_CANNOT_READ, "%s: found no triangles, lines or points, expected at least one to draw", model);
    lam_scene_free(scene);
    return NULL;
}

static void fill_report(const lam_scene *scene, const lam_camera *camera, const lam_device *device,
                        lam_render_report *report)
{
    *report = (lam_render_report){
        .triangles = lam_scene_triangle_count(scene), .vertices = lam_scene_vertex_count(scene), .camera = *camera};
    lam_scene_times(scene, &report->read_ms, &report->prepare_ms);
    lam_device_report(device, &report->frame);
    size_t used = 0;
    for (int i = 0; lam_scene_warning(scene, i); i++) {
        size_t length = strlen(lam_scene_warning(scene, i));
        if (used + length + 2 > sizeof report->warnings)
            continue;
        used += (size_t)snprintf(report->warnings + used, sizeof report->warnings - used, "%s%s", used ? "\n" : "",
                                 lam_scene_warning(scene, i));
    }
}

// Returns whether the scene is lit by the lights of a glTF file, whose units are candela and lux.
static bool has_file_lights(const lam_scene *scene, const lam_picture_settings *settings)
{
    const char *format = lam_scene_format(scene);
    return lam_scene_light_count(scene) > 0 &&
           (strcmp(format, "gltf") == 0 || (strcmp(format, "scene") == 0 && !(settings->present & LAM_SETTING_LIGHTS)));
}

// Draws the loaded scene. If the caller passes no settings, the settings of the scene are used.
static bool draw(lam_scene *scene, const lam_render_params *params, lam_image *image, lam_render_report *report,
                 lam_error *error)
{
    lam_picture_settings settings;
    lam_scene_picture_settings(scene, &settings);
    lam_draw_params drawn = params->draw ? *params->draw : settings.draw;
    bool made = !image->pixels;
    if (!lam_scene_mirror_metals(scene, &drawn, error))
        return false;
    if (made) {
        bool given = settings.present & LAM_SETTING_SIZE;
        int width = image->width ? image->width : given ? settings.width : LAM_RENDER_SIZE;
        int height = image->height ? image->height : given ? settings.height : LAM_RENDER_SIZE;
        if (!lam_image_make(image, width, height, image->format, error))
            return false;
    }
    if (!params->draw && settings.present & LAM_SETTING_EXPOSURE)
        drawn.brighten = LAM_BRIGHTEN_OFF;
    lam_camera camera = settings.camera;
    if (params->view || !(settings.present & LAM_SETTING_CAMERA))
        camera =
            lam_camera_fit_ground(scene, &drawn, image->width, image->height, params->view, (lam_vec3){0, 0, 0}, NULL);
    lam_device *device =
        params->device ? params->device : lam_device_cpu(&(lam_cpu_params){.threads = params->threads}, error);
    bool fitted = !params->draw && !(settings.present & LAM_SETTING_EXPOSURE) && has_file_lights(scene, &settings);
    if (fitted)
        drawn.light_cutoff = -1;
    bool ok = device && (!fitted || lam_exposure_fit(device, scene, &camera, &drawn, image->width, image->height,
                                                     params->control, &drawn.exposure, error));
    double scale;
    ok = ok && (!fitted || lam_studio_fill(device, scene, &camera, &drawn, image->width, image->height, params->control,
                                           &scale, error));
    ok = ok && (!reads_tangents(&drawn) || lam_scene_make_tangents(scene, params->control, error)) &&
         lam_draw(device, scene, &camera, &drawn, image, params->control, error);
    if (ok && report)
        fill_report(scene, &camera, device, report);
    if (!params->device)
        lam_device_free(device);
    if (!ok && made)
        lam_image_free(image);
    return ok;
}

bool lam_render(const char *model, const lam_render_params *params, lam_image *image, lam_render_report *report,
                lam_error *error)
{
    static const lam_render_params plain = {0};
    params = params ? params : &plain;
    if (!model || !image)
        return fail(error, LAM_BAD_ARGUMENT, "lam_render: %s is NULL", model ? "image" : "model");
    if (!check_reserved("lam_render_params", params, error))
        return false;
    lam_scene *scene = load(model, params, error);
    bool ok = scene && draw(scene, params, image, report, error);
    lam_scene_free(scene);
    return ok;
}
