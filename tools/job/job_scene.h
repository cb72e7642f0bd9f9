// job_scene.h: applies the options for materials, rotations and lights to a loaded model.
#ifndef JOB_SCENE_H
#define JOB_SCENE_H

#include "job.h"

// Applies materials, sides and the rig: everything before the camera and the rotations. Fills `sphere`.
bool job_apply_options(struct job *job, const lam_control *control, struct model_sphere *sphere, lam_error *error);

// Gets the rotation axis of this picture and the others on its sheet; length 0 if there are several axes. Returns false
// if there is no rotation.
bool job_turn_axis(const struct options *o, lam_vec3 *axis);

// Rotates the model about the sphere's centre.
bool job_turn(struct job *job, const struct model_sphere *sphere, lam_error *error);

// Adds the lights, after the camera has been placed.
bool job_light(struct job *job, const struct model_sphere *sphere, lam_error *error);

// Returns the drawing parameters for the options, without the background.
lam_draw_params draw_params_of(const struct options *o, lam_rig rig);

#endif
