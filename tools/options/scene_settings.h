// scene_settings.h: what a scene file says about its picture, below what the command line says; and --save-scene.
#ifndef SCENE_SETTINGS_H
#define SCENE_SETTINGS_H

#include "job.h"

// Takes over what the job's scene says where the command line says nothing: into job->own, which job->options then is.
void scene_settings_apply(struct job *job);

// True where the scene file's camera counts: nothing on the command line places another one.
bool scene_settings_has_camera(const struct job *job);

// Writes the scene file of --save-scene, once the frame is drawn.
bool scene_settings_save(const struct job *job, lam_error *error);

#endif
