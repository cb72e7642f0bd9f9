// scene_settings.h: the picture settings of a scene file, which the command line overrides; and --save-scene.
#ifndef SCENE_SETTINGS_H
#define SCENE_SETTINGS_H

#include "job.h"

// Copies the options to job->own, completes them by the settings of the scene file, and points job->options there.
void scene_settings_apply(struct job *job);

// Returns true if the scene file has the camera, and no option of the command line places another one.
bool scene_settings_has_camera(const struct job *job);

// Returns false if the scene file of --save-scene names the model or a picture of the command line that lies outside of
// its folder.
bool scene_settings_are_beside(const struct job *job);

// Writes the scene file of --save-scene, after the frame has been drawn.
bool scene_settings_save(const struct job *job, lam_error *error);

#endif
