// denoised.h: prepares the filter against the noise of a path-traced picture (lam_draw_params.denoise).
#ifndef DENOISED_H
#define DENOISED_H

#include "device_type.h"
#include "paths.h"

enum { DENOISED_BELOW = 1024 }; // paths (LAM_DENOISE_AUTO)

// Returns whether the picture of these parameters is filtered, unless it gets too many paths for that.
bool is_denoised(const lam_draw_params *params);

// Draws the normals, distances and base colours of a picture, in the size of `target`. The device's frame is then another one. The caller frees
// the pictures, even on failure.
bool denoise_prepare(struct lam_device *device, const lam_scene *scene, const lam_camera *camera,
                     const lam_draw_params *params, const lam_image *target, struct path_pictures *pictures,
                     struct call_control *call, lam_error *error);

// Makes a picture of numbers (LAM_RGBA32F), and charges its memory to the call.
bool denoise_image_make(lam_image *image, int width, int height, struct call_control *call, lam_error *error);

void denoise_free(struct path_pictures *pictures, struct call_control *call);

#endif
