// denoised.h: draws the light of a path-traced frame without its noise (lam_draw_params.denoise).
#ifndef DENOISED_H
#define DENOISED_H

#include "device_type.h"
#include "paths.h"

// Returns whether the picture of these parameters is filtered.
bool is_denoised(const lam_draw_params *params);

// Draws the normals, distances and base colours of a picture, in the size of `target`. The device's frame is then another one. The caller frees
// the pictures, even on failure.
bool denoise_prepare(struct lam_device *device, const lam_scene *scene, const lam_camera *camera,
                     const lam_draw_params *params, const lam_image *target, struct path_pictures *pictures,
                     struct call_control *call, lam_error *error);

// Draws the light of the device's frame over nothing: exposed, linear and premultiplied (LAM_RGBA32F, without padding).
bool denoise_draw(struct lam_device *device, struct path_pictures *pictures, lam_image *light,
                  struct call_control *call, lam_error *error);

void denoise_free(struct path_pictures *pictures, struct call_control *call);

#endif
