// light_markers.h: --show-lights: where the lights of a picture are.
#ifndef LIGHT_MARKERS_H
#define LIGHT_MARKERS_H

#include "job.h"

// Adds a marker for each light that has a place or a direction: a ball where it is (a directional light's stands one
// and a half radii from the model's centre), with a cone that points the way a spot or directional light shines. They
// glow in the light's colour and are lit by nothing. The camera has been placed already, and does not move for them.
bool light_markers_add(struct job *job, lam_error *error);

#endif
