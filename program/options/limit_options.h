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

// --- creates the device that the options select.

// Returns NULL on failure. The caller frees the device.
lam_device *device_option_make(const struct options *options, lam_error *error);

// Returns whether the options name OpenGL or one of its devices.
bool device_option_is_gl(const struct options *options);

// --- reads built-in and user-defined looks for --look.

// Return the name and the text of the built-in look with this index, counted from 0, or NULL if the index is out of
// range.
const char *look_name(int look);
const char *look_text(int look);

// Returns the text of the built-in look with this name, or NULL if there is no such look.
const char *look_find(const char *name);

// Writes a look's summary (the first line of the file) to `out`.
void look_summary(const char *text, char *out, size_t size);

// Calls `take` for each option of a built-in look or a look file until `take` returns false. Passes the line number,
// the option's name without dashes and its value ("" for an option without a value). These strings are valid until the
// caller frees *kept. The caller must free *kept even after a failure. Fails with LAM_BAD_ARGUMENT.
bool look_read(const char *name, char **kept,
               bool (*take)(void *user, int line, char *option, char *value, lam_error *error), void *user,
               lam_error *error);

#endif
