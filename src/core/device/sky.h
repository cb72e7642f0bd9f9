// sky.h: the environment as the background of a picture.
#ifndef SKY_H
#define SKY_H

#include "device_type.h"

// Returns whether the frame's background is its environment.
bool sky_is_drawn(const struct frame *frame);

// Draws the device's frame over its environment into the target. Fails like device_type.draw, and with LAM_BAD_ARGUMENT
// if the frame has no environment.
bool sky_draw(struct lam_device *device, lam_image *target, struct call_control *call, lam_error *error);

#endif
