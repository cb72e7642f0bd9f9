// frame_ground.h: the ground under the scene, a mesh that is built for each frame.
#ifndef FRAME_GROUND_H
#define FRAME_GROUND_H

#include "frame.h"

// Places the ground of a frame. There is no ground if the camera would see it from below, or if the scene has no
// extent. Sets all members of frame->ground except its mesh and material.
void frame_ground_place(struct frame *frame, const lam_scene *scene, const lam_camera *camera, const lam_mat4 *view);

// Adjusts near and far planes that were fitted to the scene, so that the ground is between the planes.
void frame_ground_planes(const struct frame_ground *ground, const lam_mat4 *view, bool orthographic, double *near_plane,
                         double *far_plane);

// Makes the mesh. `pixel` is the matrix from eye space to pixels, as in struct frame_draw.
bool frame_ground_make(struct frame *frame, const lam_mat4 *view, const lam_mat4 *pixel, struct call_control *call,
                       lam_error *error);

#endif
