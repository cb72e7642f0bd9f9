// sky.h: draws a frame in two steps: its light, and the light over its background or its environment.
#ifndef SKY_H
#define SKY_H

#include "device_type.h"
#include "paths.h"

// Returns whether the frame's background is its environment.
bool sky_is_drawn(const struct frame *frame);

// Draws the device's frame over its background into the target. `denoised`, if not NULL, are the pictures of
// denoise_prepare: the light is drawn without its noise. Fails like device_type.draw, and with LAM_BAD_ARGUMENT if the
// frame's background is an environment, but no environment lights the frame.
bool sky_draw(struct lam_device *device, struct path_pictures *denoised, lam_image *target, struct call_control *call,
              lam_error *error);

#endif
