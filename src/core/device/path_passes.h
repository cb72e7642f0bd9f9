// path_passes.h: draws the light of a path-traced frame in passes of a few paths each, until it has enough of them.
#ifndef PATH_PASSES_H
#define PATH_PASSES_H

#include "device_type.h"
#include "paths.h"

// Returns whether the frame's picture is drawn in passes.
bool path_passes_are_drawn(const struct frame *frame);

// Draws the light of the device's frame over nothing: exposed, linear and premultiplied (LAM_RGBA32F, without padding).
// It ends after settings.paths paths, where all tiles have less noise than settings.noise, or before settings.stop_after_s
// is over. `surfaces`, if not NULL, are the pictures of denoise_prepare; the light then has no noise. Sets `paths` and
// `noise` of the report.
bool path_passes_draw(struct lam_device *device, struct path_pictures *surfaces, lam_image *light,
                      struct call_control *call, lam_error *error);

// Draws only the recorder's pixel, and records the light of its paths by the number of reflections. `target` is not changed.
bool path_bounces_record(struct lam_device *device, const lam_image *target, struct call_control *call,
                         lam_error *error);

#endif
