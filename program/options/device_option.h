// device_option.h: creates the device that the options select.
#ifndef DEVICE_OPTION_H
#define DEVICE_OPTION_H

#include "options.h"

// Returns NULL on failure. The caller frees the device.
lam_device *device_option_make(const struct options *options, lam_error *error);

// Returns whether the options name OpenGL or one of its devices.
bool device_option_is_gl(const struct options *options);

#endif
