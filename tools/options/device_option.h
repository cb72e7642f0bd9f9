// device_option.h: the device that the options ask for.
#ifndef DEVICE_OPTION_H
#define DEVICE_OPTION_H

#include "options.h"

// NULL: the error tells. The caller frees the device.
lam_device *device_option_make(const struct options *options, lam_error *error);

#endif
