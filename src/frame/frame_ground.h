// frame_ground.h: the ground under the scene: a mesh built for each frame.
#ifndef FRAME_GROUND_H
#define FRAME_GROUND_H

#include "frame.h"

// Finds the ground of a frame, or none where the camera sees its under side or the scene has no extent. Sets all of
// frame->ground but its mesh and the material.
void frame_ground_place(struct frame *frame, const lam_scene *scene, const lam_camera *camera, const lam_mat4 *view);

// Moves near and far planes that were fitted to the scene, so that the ground lies between them.
void frame_ground_planes(const struct frame_ground *ground, const lam_mat4 *view, bool orthographic, double *near_plane,
                         double *far_plane);

// Makes the mesh. `pixel`: from the camera's space to pixels, as in struct frame_draw.
bool frame_ground_make(struct frame *frame, const lam_mat4 *view, const lam_mat4 *pixel, struct call_control *call,
                       lam_error *error);

#endif
