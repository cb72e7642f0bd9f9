// lambent/render.h: renders a model file with one call.
//
//   lam_image image = {0};
//   if (lam_render("bunny.obj", NULL, &image, NULL, &error))
//       lam_image_save(&image, "bunny.png", NULL, &error);
//   lam_image_free(&image);
#ifndef LAMBENT_RENDER_H
#define LAMBENT_RENDER_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { LAM_RENDER_SIZE = 1024 }; // default width and height of a picture, pixels

// Parameters of rendering. All zero: the picture that `lambent MODEL` draws.
typedef struct lam_render_params {
    // How the model is loaded. NULL: the defaults. Not used for built-in shapes.
    const lam_load_params *load;
    // The side to look from. NULL: a scene file's camera, else the three-quarter view.
    const lam_view *view;
    // How the picture is drawn. NULL: a scene file's settings, else the defaults.
    const lam_draw_params *draw;
    // The device that draws. NULL: a temporary CPU device.
    lam_device *device;
    // Threads of that device, and of loading without `load`. 0: one for each processor.
    int threads;
    // Limits and progress of each step, loading and drawing. NULL: none.
    const lam_control *control;
    LAM_RESERVED(16);
} lam_render_params;

// The outcome of a call.
typedef struct lam_render_report {
    double read_ms, prepare_ms;   // as lam_scene_times
    uint64_t triangles, vertices; // of the scene, over all objects
    lam_camera camera;            // in use
    lam_frame_report frame;       // as lam_device_report
    // The scene's warnings, one per line; "" if there are none. Warnings that do not fit are dropped.
    char warnings[1024];
    LAM_RESERVED(16);
} lam_render_report;

// Loads a model or a scene file, or makes the built-in shape of that name (lam_shape_name), fits the camera and draws.
// An image with pixels is drawn into. One without (zeroed) is made by the call and freed by the caller with
// lam_image_free: in its `format`, with its width and height, or if they are 0 with a scene file's, otherwise
// LAM_RENDER_SIZE. `params` and `report` may be NULL. On failure an image that the call made is freed again. Errors: as
// lam_scene_load and lam_draw; LAM_CANNOT_READ for a model without triangles.
LAM_API bool lam_render(const char *model, const lam_render_params *params, lam_image *image, lam_render_report *report,
                        lam_error *error);

// The exposure, in stops, of a picture with the fill of lam_studio_fill: the studio then has half of its usual brightness.
#define LAM_STUDIO_FILL_EXPOSURE (-1.0)

// Adds a dim studio where the scene's own lights leave more than a tenth of the model, or of the model and its ground,
// black although the surfaces are not. `params` contains the exposure that suits the lights (lam_exposure_fit). The
// call then sets the environment "studio", sets params->exposure to LAM_STUDIO_FILL_EXPOSURE, scales the lights so that
// they stay as bright in the picture, and adds a warning to the scene. *light_scale: the factor of the lights, 0 if
// nothing was changed. Changes nothing for a scene that has an environment, for reflection models that no environment
// lights, and for outputs other than the picture. It draws two pictures of at most 96 pixels. Errors as lam_draw.
LAM_API bool lam_studio_fill(lam_device *device, lam_scene *scene, const lam_camera *camera, lam_draw_params *params,
                             int width, int height, const lam_control *control, double *light_scale, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
