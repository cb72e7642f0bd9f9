// light_place.h: converts lights from their coordinate frames to world coordinates, and sweeps values of lights in an
// animation.
#ifndef LIGHT_PLACE_H
#define LIGHT_PLACE_H

#include "job.h"
#include "sweep_option.h"

// Returns the matrix from a light's frame to the world.
lam_mat4 light_to_world(const struct job *job, const lam_light *light);

// Converts lights in the frames of the camera and the view to the world's frame, without moving the lights.
bool lights_fix_to_world(struct job *job, lam_error *error);

// Sets a swept value of a light. `centre` is the model's centre. Fails with LAM_BAD_ARGUMENT if there is no such light,
// or if the light does not have this value.
bool light_sweep(const struct job *job, const struct sweep *sweep, double value, lam_vec3 centre, lam_error *error);

// Multiplies all colours of a light by `factor`.
void light_brighten(lam_light *light, double factor);

// Gets unit vectors along the scene's up axis and towards the scene's front.
void scene_axes(const lam_scene *scene, lam_vec3 *up, lam_vec3 *front);

lam_vec3 matrix_apply(const lam_mat4 *m, lam_vec3 v, double w);

#endif
