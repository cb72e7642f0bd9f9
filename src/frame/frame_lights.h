// frame_lights.h: the lights of a frame.
#ifndef FRAME_LIGHTS_H
#define FRAME_LIGHTS_H

#include "frame.h"

// Adds all lights or, with `only` >= 0, that light alone, without the scene's ambient light. Error: LAM_BAD_ARGUMENT.
bool frame_lights_build(struct frame *frame, const lam_scene *scene, lam_rig rig, int only, const lam_mat4 *view,
                        lam_error *error);

// Returns whether shadows are enabled: directly, or by the ground that catches them. Before frame_build has decided.
static inline bool wants_shadows(const lam_draw_params *params) { return params->shadows || params->ground; }

// Makes the environment's brightest lamp a light of its own, where the environment lights all surfaces that are lit and the picture
// has shadows. Does nothing for a picture of one light.
bool frame_lights_add_lamp(struct frame *frame, const lam_scene *scene, const lam_mat4 *view, struct call_control *call,
                           lam_error *error);

#endif
