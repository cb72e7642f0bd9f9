// lambent/camera.h: the camera, and placing it so that a scene fills the picture.
#ifndef LAMBENT_CAMERA_H
#define LAMBENT_CAMERA_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// A camera, right-handed: unrotated it looks along −z with +y up.
typedef struct lam_camera {
    lam_vec3 eye;    // position, world space
    lam_vec3 target; // a point in the middle of the picture, other than `eye`
    // Direction of the picture's top, any length but 0. Along the line of sight, another axis takes its place.
    lam_vec3 up;
    // Full vertical field of view, radians, in (0, π). Used where `ortho_half_height` is 0.
    double fovy_rad;
    // > 0: an orthographic camera that shows this many model units from the middle of the picture to its top.
    double ortho_half_height;
    // Distances along the view of the nearest and farthest drawn points; near < far, and near > 0 for perspective. Both
    // 0: fitted to the scene.
    double near_plane, far_plane;
    LAM_RESERVED(16);
} lam_camera;

// A perspective camera at (0, 0, 4) that looks at the origin with a field of view of 30°.
LAM_API lam_camera lam_camera_default(void);

// The matrix from world to eye space: the eye at the origin, x to the right, y up, looking along −z.
LAM_API lam_mat4 lam_camera_view_matrix(const lam_camera *camera);

// Where a point of eye space lies in a picture of width × height pixels: *x and *y in pixels from its upper left corner, outside
// of it too. Both sides are above 0; the near and far planes do not count. False, with nothing changed: it lies beside or behind the eye of a perspective camera.
LAM_API bool lam_camera_project(const lam_camera *camera, int width, int height, lam_vec3 eye_position, double *x,
                                double *y);

// The side that lam_camera_fit looks from. All zero: the three-quarter view of a catalogue, 30° to the right of the
// front and 20° above, in perspective.
typedef struct lam_view {
    // true: `azimuth_rad` and `elevation_rad` count; false: the three-quarter view.
    bool from_angles;
    // Turn about the up axis, radians. 0: the front, which is +z (−y for scenes with z up); π/2: the right side.
    double azimuth_rad;
    // Height above the horizon, radians, −π/2..π/2. π/2: from above.
    double elevation_rad;
    double fovy_rad;   // full vertical field of view, radians, in (0, π); 0: 30°
    bool orthographic; // true: parallel projection, `fovy_rad` does not count
    double zoom;       // > 0; 2 shows the model twice as large; 0: 1
    // Fraction of the tighter side of the picture that the projected vertices take, in (0, 1]. 0: 0.92.
    double fill;
    LAM_RESERVED(8);
} lam_view;

// The named sides of a scene.
typedef enum lam_side {
    LAM_SIDE_THREE_QUARTER = 0, // 30° to the right of the front and 20° above
    LAM_SIDE_FRONT,             // level, from +z (−y with z up)
    LAM_SIDE_BACK,              // level, from behind
    LAM_SIDE_LEFT,              // level, from −x
    LAM_SIDE_RIGHT,             // level, from +x
    LAM_SIDE_TOP,               // straight down, the front below
    LAM_SIDE_BOTTOM,            // straight up
    // Isometric, with an orthographic camera: 45° to the right, atan(1/√2) above.
    LAM_SIDE_ISO,
    LAM_SIDE_COUNT
} lam_side;

// The name of a side: "three-quarter", "front", "iso". A static string; NULL out of range.
LAM_API const char *lam_side_name(lam_side side);

// The side of a name; LAM_SIDE_COUNT: there is none.
LAM_API lam_side lam_side_find(const char *name);

// The view of a side, in perspective. Out of range: the three-quarter view.
LAM_API lam_view lam_view_of_side(lam_side side);

// Places a camera so that the scene's projected vertices (not their bounding box) fill a picture of width × height
// pixels and are centred in it. A fit for one shape cuts off the model, or shrinks it, in a picture of another. The
// scene's up axis turns the view. A side below 1 counts as 1. `view` NULL: the three-quarter view. A scene without
// triangles gives the default camera. A view with a field that this version does not know gives a camera that every
// call refuses (base.h, "Growth").
LAM_API lam_camera lam_camera_fit(const lam_scene *scene, int width, int height, const lam_view *view);

// The same for a scene that turns about an axis through `centre` (lam_scene_rotate): one camera for all angles, so that
// the scene does not jump in size or place. It is the camera of the scene as it is or, where that would cut the scene
// at some angle, one that the scene fills as it turns. Give it the scene before it turns. An axis of length 0 means
// rotations about any axis.
LAM_API lam_camera lam_camera_fit_turning(const lam_scene *scene, lam_vec3 centre, lam_vec3 axis, int width, int height,
                                          const lam_view *view);

// A camera of the scene's file (lam_scene_camera_count). One without a far plane gets it behind the scene's bounds. False,
// and the default camera: there is no such one.
LAM_API bool lam_scene_camera(const lam_scene *scene, int index, lam_camera *camera);

// A camera that turns about a point, for programs in which people turn a model with the mouse. Begin with lam_orbit_of().
typedef struct lam_orbit {
    lam_vec3 target;          // the point that it turns about and looks at, world space
    double azimuth_rad;       // as in lam_view
    double elevation_rad;     // as in lam_view, −π/2..π/2
    double distance;          // from the eye to the target, model units, > 0
    double fovy_rad;          // as in lam_camera
    double ortho_half_height; // as in lam_camera
    lam_up up;                // the axis that it turns about; AUTO: y
    LAM_RESERVED(8);
} lam_orbit;

// The orbit of a camera of this scene. Its target is the point of the line of sight that is nearest to the middle of the scene's
// box, or, if that lies behind the eye or the scene is NULL or empty, the camera's target. A camera that is tilted comes upright.
LAM_API lam_orbit lam_orbit_of(const lam_camera *camera, const lam_scene *scene);

// The camera of an orbit; the planes are fitted to the scene when it is drawn.
LAM_API lam_camera lam_orbit_camera(const lam_orbit *orbit);

// Turns the eye about the target, radians: to the right and up. The elevation stops at −π/2 and π/2. To turn the model with
// the mouse, a drag by dx, dy pixels (dy down) in a picture of `height` pixels is about −π dx / height to the right and
// π dy / height up. Numbers that are not finite change nothing, here and below.
LAM_API void lam_orbit_turn(lam_orbit *orbit, double right_rad, double up_rad);

// Moves eye and target in the plane of the picture, in heights of the picture at the target's distance: a drag by dx, dy pixels is
// −dx / height to the right and dy / height up.
LAM_API void lam_orbit_pan(lam_orbit *orbit, double right, double up);

// Shows the target `factor` times as large, > 0: the eye comes nearer, or an orthographic camera shows less. Others change
// nothing.
LAM_API void lam_orbit_zoom(lam_orbit *orbit, double factor);

// Reads a camera as people write it: pairs key=value, separated by commas, of
//   eye=x/y/z     required: its position
//   target=x/y/z  default: the middle of the scene's box
//   up=x/y/z      default: the scene's up axis
//   fovy=degrees  default: 30; or ortho=height, half the height of an orthographic view in model units
//   near=d,far=d  default: fitted to the scene
// such as "eye=2/1/4,fovy=40". `scene` NULL: target at the origin, y up. At most 1023 bytes. False: LAM_BAD_ARGUMENT,
// and the sentence says what was found and what was expected.
LAM_API bool lam_camera_parse(const char *text, const lam_scene *scene, lam_camera *camera, lam_error *error);

// The keys of lam_camera_parse, from 0; NULL out of range.
LAM_API const char *lam_camera_key(int index);

#ifdef __cplusplus
}
#endif
#endif
