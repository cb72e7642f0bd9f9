// job_scene.h: what the options do to a model between reading and drawing: materials, turns, lights.
#ifndef JOB_SCENE_H
#define JOB_SCENE_H

#include "job.h"

// The sphere that the unit r counts by: of the model before --rotate.
struct model_sphere {
    lam_vec3 centre;
    double radius;
};

// Everything that the camera depends on, and what needs no camera. `sphere` is the model's as it was before it was
// turned.
bool job_dress(struct job *job, const lam_control *control, struct model_sphere *sphere, lam_error *error);

// The lights; the camera stands.
bool job_light(struct job *job, const struct model_sphere *sphere, lam_error *error);

// How to draw, but for the background.
lam_draw_params draw_params_of(const struct options *o, lam_rig rig);

#endif
