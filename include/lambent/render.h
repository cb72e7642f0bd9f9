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

enum { LAM_RENDER_SIZE = 1024 }; // default width and height of a picture in pixels

// Parameters of rendering. All zero: the picture that `lambent MODEL` draws.
typedef struct lam_render_params {
    // Parameters of loading. NULL: the defaults. Built-in shapes ignore it.
    const lam_load_params *load;
    // The direction of view. NULL: the scene file's camera; if there is none, the three-quarter view.
    const lam_view *view;
    // The settings of the picture. NULL: the scene file's settings; if there are none, the defaults.
    const lam_draw_params *draw;
    // The device that draws. NULL: a temporary CPU device.
    lam_device *device;
    // Threads of that device, and of loading if `load` is NULL. 0: one for each processor.
    int threads;
    // Limits and progress of each step: loading and drawing. NULL: none.
    const lam_control *control;
    LAM_RESERVED(16);
} lam_render_params;

// The results of a call.
typedef struct lam_render_report {
    double read_ms, prepare_ms;   // as lam_scene_times
    uint64_t triangles, vertices; // of the scene, over all objects
    lam_camera camera;            // the camera used
    lam_frame_report frame;       // as lam_device_report
    // The scene's warnings, one per line; "" if there are none. Warnings that do not fit are dropped.
    char warnings[1024];
    LAM_RESERVED(16);
} lam_render_report;

// Loads a model or a scene file, or makes the built-in shape with that name (lam_shape_name), fits the camera and
// draws. If the image has pixels, the call draws into them. Otherwise it makes the image in its `format`, with its
// width and height, or, if they are 0, with the size of a scene file or LAM_RENDER_SIZE; the caller frees it with
// lam_image_free. `params` and `report` may be NULL. On failure the call frees an image that it made. Errors: as
// lam_scene_load and lam_draw; LAM_CANNOT_READ for a model without triangles.
LAM_API bool lam_render(const char *model, const lam_render_params *params, lam_image *image, lam_render_report *report,
                        lam_error *error);

// The exposure, in stops, of a picture with the fill light of lam_studio_fill: the studio then has half of its usual
// brightness.
#define LAM_STUDIO_FILL_EXPOSURE (-1.0)

// Adds a dim studio if the scene's own lights leave more than a tenth of the model (or of the model and its ground)
// black although its surfaces are not black. `params` contains the exposure that suits the lights (lam_exposure_fit).
// The call then sets the environment "studio", sets params->exposure to LAM_STUDIO_FILL_EXPOSURE, scales the lights so
// that they stay as bright in the picture, or dimmer if more than a quarter of the lit pixels would be brighter than
// their surface, and adds a warning to the scene. *light_scale is the factor of the lights, or 0 if nothing was
// changed. The call changes nothing if the scene has an environment, if the reflection model ignores environments, and
// for outputs other than the picture. The call draws two pictures of at most 96×96 pixels. Errors as lam_draw.
LAM_API bool lam_studio_fill(lam_device *device, lam_scene *scene, const lam_camera *camera, lam_draw_params *params,
                             int width, int height, const lam_control *control, double *light_scale, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
