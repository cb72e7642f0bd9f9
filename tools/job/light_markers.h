// light_markers.h: implements --show-lights: adds markers at the lights.
#ifndef LIGHT_MARKERS_H
#define LIGHT_MARKERS_H

#include "job.h"

// Adds a marker for each light that has a position or a direction: a ball at the light. For a directional light, the
// ball is one and a half radii from the model's centre. A cone shows the direction of a spot or directional light.
// Markers emit the light's colour and are not lit. Call this function after placing the camera, so that the camera
// ignores the markers.
bool light_markers_add(struct job *job, lam_error *error);

#endif
