// lambent/pick.h: finds the surface under a pixel, for programs in which users click on a picture.
#ifndef LAMBENT_PICK_H
#define LAMBENT_PICK_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// A pixel of a picture.
typedef struct lam_pick_pixel {
    int width, height; // the picture's size, pixels, 1..65535
    int x, y;          // the pixel, from the upper left corner
    LAM_RESERVED(4);
} lam_pick_pixel;

// The surface under a pixel's centre.
typedef struct lam_picked {
    // Index in the scene; −1: the background or the ground; the other members are then 0.
    int object;
    int mesh; // index of its mesh
    // Index in the mesh, of the triangle, the line or the point.
    uint32_t triangle;
    bool back; // whether the back of the triangle is visible
    // In world space. For a line or a point, the position is on the rectangle that is drawn for the line or point.
    lam_vec3 position;
    // From the eye to `position`, model units; with an orthographic camera, from the plane through the eye.
    double distance;
    LAM_RESERVED(8);
} lam_picked;

// Finds the nearest surface under a pixel's centre by tracing one ray. The ray skips hidden (lam_scene_hide_object),
// culled and fully transparent surfaces, surfaces outside the camera's planes, and the holes of masked surfaces. Glass
// counts as a surface. Textures are read at their finest level. The call needs no device. The time grows with the
// number of triangles of objects whose boxes the ray meets. Pass the picture's `camera` and `params`; params and
// `control` may be NULL. Returns false on failure: LAM_BAD_ARGUMENT (the pixel is outside the picture, or as lam_draw),
// LAM_LIMIT, LAM_CANCELLED.
LAM_API bool lam_pick(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
                      const lam_pick_pixel *pixel, const lam_control *control, lam_picked *picked, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
