// frame_lights.h: the lights of a frame.
#ifndef FRAME_LIGHTS_H
#define FRAME_LIGHTS_H

#include "frame.h"

// Adds all lights and the scene's ambient light or, if `only` >= 0, only the light with that index. Fails with
// LAM_BAD_ARGUMENT.
bool frame_lights_build(struct frame *frame, const lam_scene *scene, lam_rig rig, int only, const lam_mat4 *view,
                        lam_error *error);

// Returns whether shadows are enabled, explicitly or by a ground. This function can be called before frame_build.
static inline bool wants_shadows(const lam_draw_params *params) { return params->shadows || params->ground; }

// Makes the environment's brightest lamp a separate light, if the environment illuminates all lit surfaces and shadows
// are enabled. If the picture shows a single light, the function does nothing.
bool frame_lights_add_lamp(struct frame *frame, const lam_scene *scene, const lam_mat4 *view, struct call_control *call,
                           lam_error *error);

#endif
