// camera_lens.h: how a camera maps eye space to the pixels of a picture. All projections are made from this.
#ifndef CAMERA_LENS_H
#define CAMERA_LENS_H

#include "linear.h"

#include <lambent/camera.h>

struct camera_lens {
    double pixel[2];  // width and height of a pixel in eye space, at distance 1 (in an orthographic view, everywhere)
    double middle[2]; // where the camera's axis meets the picture, in pixels from the upper left corner
};

static inline bool camera_is_calibrated(const lam_camera *camera)
{
    return camera->fx > 0 && !(camera->ortho_half_height > 0);
}

struct camera_lens camera_lens_of(const lam_camera *camera, int width, int height);

// Returns the projection matrix of OpenGL: z is −1 at the near plane and 1 at the far plane.
lam_mat4 camera_projection(const lam_camera *camera, int width, int height, double near_plane, double far_plane);

#endif
