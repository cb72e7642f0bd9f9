// camera_fit.h: fitting a camera to a scene, and to points beside it that its picture is to show.
#ifndef CAMERA_FIT_H
#define CAMERA_FIT_H

#include <lambent/camera.h>

struct camera_points {
    const lam_vec3 *points; // world space
    int count;
};

// lam_camera_fit, or with an axis lam_camera_fit_turning, of the scene and the points.
lam_camera camera_fit(const lam_scene *scene, int width, int height, const lam_view *view, lam_vec3 centre,
                      const lam_vec3 *axis, const struct camera_points *also);

#endif
