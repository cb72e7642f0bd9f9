// scene_settings.h: applies the picture settings of a scene file unless the command line overrides them, and writes the
// scene file of --save-scene.
#ifndef SCENE_SETTINGS_H
#define SCENE_SETTINGS_H

#include "job.h"

// Copies the options to job->own, adds the settings of the scene file to the copy, and sets job->options to the copy.
void scene_settings_apply(struct job *job);

// Returns whether the scene file contains a camera and no option of the command line sets another camera.
bool scene_settings_has_camera(const struct job *job);

// Returns false if the scene file of --save-scene would refer to a model or a picture outside the scene file's folder.
bool scene_settings_are_beside(const struct job *job);

// Writes the scene file of --save-scene, after drawing the frame.
bool scene_settings_save(const struct job *job, lam_error *error);

#endif
