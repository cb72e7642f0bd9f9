// lambent/pick.h: the surface under a pixel, for programs in which users point at a picture.
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
    // Index in the scene; −1: the background or the ground, and the other members are 0.
    int object;
    int mesh; // index of its mesh
    // Index in the mesh: of a triangle, or of the line or the point.
    uint32_t triangle;
    bool back; // the triangle shows its back
    // World space; of a line or a point, on the rectangle that is drawn for it.
    lam_vec3 position;
    // From the eye to `position`, model units. Orthographic: from the plane through the eye.
    double distance;
    LAM_RESERVED(8);
} lam_picked;

// Finds the nearest surface under a pixel's centre by one ray, as it is drawn: surfaces outside of the camera's planes, hidden
// (lam_scene_hide_object), culled and fully transparent surfaces and the holes of masked ones are passed over; glass is found. Textures
// are read at their finest level. It needs no device. The time grows with the triangles of the objects whose boxes the ray
// meets. Give it the picture's `camera` and `params`; params and `control` may be NULL. False: LAM_BAD_ARGUMENT (the
// pixel lies outside of the picture, or as lam_draw), LAM_LIMIT, LAM_CANCELLED.
LAM_API bool lam_pick(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
                      const lam_pick_pixel *pixel, const lam_control *control, lam_picked *picked, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
