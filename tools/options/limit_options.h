// limit_options.h: converts the limits set by options to the library's limits.
#ifndef LIMIT_OPTIONS_H
#define LIMIT_OPTIONS_H

#include "options.h"

// The bytes that reading a model, and drawing it, may each use: --memory-limit, or else a quarter of the memory
// available to this process, divided among the options' `in_flight` models. 0: no limit. Any thread.
uint64_t limits_memory(const struct options *options);

// Seconds for a model. 0: no limit.
double limits_time(const struct options *options);

// Returns a control with all limits, and a whole model's time.
lam_control limits_control(const struct options *options);

#endif
