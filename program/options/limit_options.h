// limit_options.h: converts the limits set by options to the library's limits.
#ifndef LIMIT_OPTIONS_H
#define LIMIT_OPTIONS_H

#include "options.h"

// Returns the memory limit in bytes. The limit applies separately to reading a model and to drawing the model. The
// limit is --memory-limit or, by default, a quarter of the memory available to this process, divided by the number of
// models in progress (`in_flight`). 0 means no limit. Any thread may call it.
uint64_t limits_memory(const struct options *options);

// Returns the time limit for a model in seconds. 0 means no limit.
double limits_time(const struct options *options);

// Returns a control with all limits. The time limit of the control applies to a whole model.
lam_control limits_control(const struct options *options);

#endif
