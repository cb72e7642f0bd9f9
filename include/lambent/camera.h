// lambent/camera.h: where the picture is seen from.
#ifndef LAMBENT_CAMERA_H
#define LAMBENT_CAMERA_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// A camera. Right-handed: unrotated it looks along −Z with +Y up.
typedef struct lam_camera {
    lam_vec3 eye, target, up;     // eye ≠ target; up not along the view (another axis is taken if it is)
    double fovy_rad;              // full vertical field of view, in (0, π); used where ortho_half_height is 0
    double ortho_half_height;     // > 0: orthographic, this many model units from the middle to the top
    double near_plane, far_plane; // distances along the view, near < far; both 0: fitted to the scene
} lam_camera;

// A perspective camera at (0, 0, 4) looking at the origin, 30° high.
LAM_API lam_camera lam_camera_default(void);

// World to eye space: the eye at the origin, x to the right, y up, looking along −z.
LAM_API lam_mat4 lam_camera_view(const lam_camera *camera);

// How lam_camera_fit places the camera. All zero: the three-quarter view of a catalogue.
typedef struct lam_view {
    bool from_angles;     // true: azimuth and elevation below; false: 30° to the right of front, 20° above
    double azimuth_rad;   // 0: from the front (+Z with Y up), positive: the camera goes to the right (towards +X)
    double elevation_rad; // 0: level, π/2: from above; −π/2..π/2
    double fovy_rad;      // 0: 30°
    bool orthographic;
    double zoom; // > 0; 2 shows the model twice as large; 0: 1
    double fill; // share of the tighter side that the projected vertices take, 0..1; 0: 0.92
} lam_view;

// Places a camera so that the scene's projected vertices fill a picture of width × height pixels and are centred in it:
// the vertices themselves, not their bounding box. A fit for one shape cuts off or shrinks the model in a picture of
// another. The scene's up axis turns the view. A side below 1 counts as 1. `view` NULL: the three-quarter view. A scene
// without triangles gives the default camera.
LAM_API lam_camera lam_camera_fit(const lam_scene *scene, int width, int height, const lam_view *view);

#ifdef __cplusplus
}
#endif
#endif
