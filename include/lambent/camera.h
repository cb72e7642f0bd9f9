// lambent/camera.h: cameras, and functions that fit a camera to a scene.
#ifndef LAMBENT_CAMERA_H
#define LAMBENT_CAMERA_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// A camera, right-handed: without a rotation, it looks along −z with +y up.
typedef struct lam_camera {
    lam_vec3 eye;    // position, world space
    lam_vec3 target; // a point in the middle of the picture, other than `eye`
    // The direction of the picture's top; its length does not matter, but must not be 0. If it is parallel to the line
    // of sight, another axis is used.
    lam_vec3 up;
    // Full vertical field of view, radians, in (0, π). Used if `ortho_half_height` is 0.
    double fovy_rad;
    // > 0: an orthographic camera; the model units from the middle of the picture to its top. 0: a perspective camera.
    double ortho_half_height;
    // Distances along the view of the nearest and farthest drawn points; near < far, and near > 0 for perspective. Both
    // 0: fitted to the scene.
    double near_plane, far_plane;
    // The intrinsics of a calibrated perspective camera, in pixels. fx > 0: a point at (X, Y, Z) of
    // eye space is drawn at x = cx + fx X/−Z, y = cy − fy Y/−Z, measured from the picture's upper left corner (the centre
    // of the first pixel is at 0.5, 0.5). `fovy_rad` is then ignored, and fy must be above 0. fx = 0: `fovy_rad` or
    // `ortho_half_height`, with the axis in the middle of the picture.
    double fx, fy, cx, cy;
    // The size of the pictures that the intrinsics are for; another size scales them. 0, 0: the size of the drawn picture.
    int width, height;
    LAM_RESERVED(11);
} lam_camera;

// Returns a perspective camera at (0, 0, 4) that looks at the origin with a field of view of 30°.
LAM_API lam_camera lam_camera_default(void);

// Returns the matrix from world to eye space: the eye at the origin, x to the right, y up, looking along −z.
LAM_API lam_mat4 lam_camera_view_matrix(const lam_camera *camera);

// The axes of a camera's pose, and the point from which its cx and cy are measured. In both, y of pixels points down.
typedef enum lam_camera_convention {
    // OpenCV, COLMAP, Open3D: x to the right, y down, z forward; the centre of the first pixel is at (0, 0)
    LAM_CONVENTION_OPENCV,
    // OpenGL, Blender, NeRF, pyrender: x to the right, y up, z backward; the corner of the first pixel is at (0, 0)
    LAM_CONVENTION_OPENGL,
} lam_camera_convention;

// Places a camera by its pose: the matrix from the camera's axes to world space. Its first three columns must be
// orthogonal unit vectors within 0.001 and right-handed, its last row 0, 0, 0, 1. On failure, with LAM_BAD_ARGUMENT, the
// camera is unchanged.
LAM_API bool lam_camera_set_pose(lam_camera *camera, const lam_mat4 *pose, lam_camera_convention convention,
                                 lam_error *error);

// Returns the pose of a camera.
LAM_API lam_mat4 lam_camera_pose(const lam_camera *camera, lam_camera_convention convention);

// Gets fx, fy, cx and cy of a camera in a picture of width × height pixels. Returns false and changes nothing if the
// camera is orthographic.
LAM_API bool lam_camera_intrinsics(const lam_camera *camera, int width, int height, lam_camera_convention convention,
                                   double intrinsics[4]);

// Projects a point of eye space into a picture of width × height pixels (both above 0). *x and *y are in pixels from
// the upper left corner, even for points outside the picture. The near and far planes are ignored. Returns false and
// changes nothing if the point is beside or behind the eye of a perspective camera.
LAM_API bool lam_camera_project(const lam_camera *camera, int width, int height, lam_vec3 eye_position, double *x,
                                double *y);

// The direction from which lam_camera_fit views the scene. If all fields are zero, it is the three-quarter view of a
// catalogue, 30° to the right of the front and 20° above it, in perspective.
typedef struct lam_view {
    // true: use `azimuth_rad` and `elevation_rad`; false: the three-quarter view.
    bool from_angles;
    // Angle about the up axis, radians. 0: the front, which is +z (−y for scenes with z up); π/2: the right side.
    double azimuth_rad;
    // Angle above the horizon, radians, −π/2..π/2. π/2: from above.
    double elevation_rad;
    double fovy_rad;   // full vertical field of view, radians, in (0, π); 0: 30°
    bool orthographic; // true: parallel projection; `fovy_rad` is ignored
    double zoom;       // > 0; 2 shows the model twice as large; 0: 1
    // Fraction of the picture's width or height (whichever is tighter) that the projected vertices fill, in (0, 1]. 0:
    // 0.92.
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

// Returns the name of a side: "three-quarter", "front", "iso". Returns a static string, or NULL if the index is out of
// range.
LAM_API const char *lam_side_name(lam_side side);

// Returns the side with this name, or LAM_SIDE_COUNT if there is none.
LAM_API lam_side lam_side_find(const char *name);

// Returns the view of a side, in perspective, or the three-quarter view if `side` is out of range.
LAM_API lam_view lam_view_of_side(lam_side side);

// The size of a view's name, with its final zero.
enum { LAM_VIEW_NAME_SIZE = 32 };

// Parses a list of views, separated by commas: names of sides; N or sphere:N, N directions that are evenly distributed on
// a sphere, from the top to the bottom; ring:N@E, N directions at equal angles from the front to the right, E degrees
// above the horizon (default: 20). Returns the number of views, or −1 on failure, with LAM_BAD_ARGUMENT. If the list has
// a view with this index (from 0), stores it in *view, and its name in `name`: the side's name, or the index with leading
// zeros, "007". Both may be NULL.
LAM_API int lam_views_parse(const char *text, int index, lam_view *view, char name[LAM_VIEW_NAME_SIZE],
                            lam_error *error);

// Places a camera so that the scene's projected vertices (not their bounding box) fill a picture of width × height
// pixels and are centred in it. A camera fitted for one aspect ratio crops or shrinks the model at another aspect
// ratio. The view is relative to the scene's up axis. A width or height below 1 counts as 1. If `view` is NULL, the
// three-quarter view is used. For a scene without triangles, the result is the default camera. If a view sets a field
// that this version does not know, the result is a camera that every call rejects (base.h, "Growth").
LAM_API lam_camera lam_camera_fit(const lam_scene *scene, int width, int height, const lam_view *view);

// Fits one camera for all angles of a scene that rotates about an axis through `centre` (lam_scene_rotate), so that the
// scene keeps its size and position. The result is the camera of the scene before the rotation, or, if this would crop
// the scene at some angle, a camera that shows the scene at every angle. Pass the scene before the rotation. An axis of
// length 0 means rotations about any axis.
LAM_API lam_camera lam_camera_fit_turning(const lam_scene *scene, lam_vec3 centre, lam_vec3 axis, int width, int height,
                                          const lam_view *view);

// Gets a camera of the scene's file (lam_scene_camera_count). If the camera has no far plane, the call places the far
// plane behind the scene's bounds. If there is no such camera, the call returns false and writes the default camera.
LAM_API bool lam_scene_camera(const lam_scene *scene, int index, lam_camera *camera);

// A camera that orbits a point, for programs in which users rotate a model with the mouse. Begin with lam_orbit_of().
typedef struct lam_orbit {
    lam_vec3 target;          // the point that the eye orbits, world space
    double azimuth_rad;       // as in lam_view
    double elevation_rad;     // as in lam_view, −π/2..π/2
    double distance;          // from the eye to the target, model units, > 0
    double fovy_rad;          // as in lam_camera
    double ortho_half_height; // as in lam_camera
    lam_up up;                // the axis of the orbit; AUTO: y
    LAM_RESERVED(8);
} lam_orbit;

// Returns the orbit of a camera of this scene, with the camera's `fovy_rad` instead of its intrinsics. The orbit's target is the point on the line of sight that is nearest to
// the centre of the scene's box. If that point is behind the eye, or the scene is NULL or empty, the orbit's target is
// the camera's target. A tilted camera becomes upright.
LAM_API lam_orbit lam_orbit_of(const lam_camera *camera, const lam_scene *scene);

// Returns the camera of an orbit; the planes are fitted to the scene when it is drawn.
LAM_API lam_camera lam_orbit_camera(const lam_orbit *orbit);

// Rotates the eye about the target to the right and up, by angles in radians. The elevation stops at −π/2 and π/2. To
// turn the model with the mouse, convert a drag by dx, dy pixels (dy down) in a picture of `height` pixels to about −π
// dx / height to the right and π dy / height up. Numbers that are not finite are ignored, here and below.
LAM_API void lam_orbit_turn(lam_orbit *orbit, double right_rad, double up_rad);

// Moves eye and target in the plane of the picture, in heights of the picture at the target's distance: a drag by dx,
// dy pixels corresponds to −dx / height to the right and dy / height up.
LAM_API void lam_orbit_pan(lam_orbit *orbit, double right, double up);

// Shows the target `factor` times as large: moves the eye closer, or narrows the view of an orthographic camera.
// Factors of 0 or less are ignored.
LAM_API void lam_orbit_zoom(lam_orbit *orbit, double factor);

// Parses a camera from text: an object of JSON with the keys of scene files, or pairs key=value, separated by commas, of
//   eye=x/y/z     required: its position
//   target=x/y/z  default: the middle of the scene's box
//   up=x/y/z      default: the scene's up axis
//   fovy=degrees  default: 30; or ortho=height, half the height of an orthographic view in model units
//   near=d,far=d  default: fitted to the scene
// or of a calibrated camera:
//   fx=,fy=,cx=,cy=     all four, in pixels, instead of fovy; or K=fx/0/cx/0/fy/cy/0/0/1
//   width=,height=      the size that they are for; default: the drawn picture's
//   pose=               instead of eye, target and up: 16 numbers separated by /, row by row, from the camera to the world
//   convention=opencv   the meaning of cx, cy and pose (lam_camera_convention): opencv or opengl
// such as "eye=2/1/4,fovy=40". If `scene` is NULL, the target is the origin and y is up. Pairs have at most
// 1023 bytes. Fails with LAM_BAD_ARGUMENT; the error states what was found and what was expected.
LAM_API bool lam_camera_parse(const char *text, const lam_scene *scene, lam_camera *camera, lam_error *error);

// Returns the key of lam_camera_parse with this index (from 0), or NULL if the index is out of range.
LAM_API const char *lam_camera_key(int index);

#ifdef __cplusplus
}
#endif
#endif
