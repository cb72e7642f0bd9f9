// lambent/environment.h: surroundings that shiny surfaces mirror: cube maps, from files or built in.
#ifndef LAMBENT_ENVIRONMENT_H
#define LAMBENT_ENVIRONMENT_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

struct lam_image;

// Opaque: six square faces of linear light, looked up with a direction. It never changes once it is made, so any number
// of scenes and threads may share it.
typedef struct lam_environment lam_environment;

// The faces in OpenGL's order, named by the axis that goes through their middle.
typedef enum lam_cube_face {
    LAM_FACE_PX = 0,
    LAM_FACE_NX,
    LAM_FACE_PY,
    LAM_FACE_NY,
    LAM_FACE_PZ,
    LAM_FACE_NZ,
    LAM_FACE_COUNT
} lam_cube_face;

// From six pictures of the same size, square, up to 8192 pixels on a side. Each lies as OpenGL's table says, its first
// row being t = 0, nothing flipped: seen from inside with Y up, the four faces around stand upright and mirrored left
// to right, as OpenGL has them. Pictures are LAM_RGBA8 (decoded from sRGB, or taken as they are with LAM_COLOR_RAW) or
// LAM_RGBA32F (linear); they are copied, and lie over black where they are not opaque. Numbers below 0 or not finite
// are LAM_BAD_ARGUMENT.
LAM_API lam_environment *lam_environment_make(const struct lam_image *const faces[LAM_FACE_COUNT], lam_color_mode color,
                                              lam_error *error);

// From one picture, whose sides tell how it is laid out:
//   4:3  a cross lying down    . +Y  .  .      3:4  a cross standing   . +Y  .
//                             -X +Z +X -Z                              -X +Z +X
//                              . -Y  .  .                               . -Y  .
//                                                                       . -Z  .   (-Z turned by 180°)
//   2:1  equirectangular: its middle is in direction −Z, +X to the right of that, +Y at the top. It is sampled once, bilinearly,
//        into faces of width/π pixels on a side, rounded up: in the faces' middles a pixel for each of the picture's.
// Otherwise as lam_environment_make.
LAM_API lam_environment *lam_environment_from_image(const struct lam_image *image, lam_color_mode color,
                                                    lam_error *error);

// The same from files, in any format that lam_image_load_linear reads: six of them, or one. `control` may be
// NULL; its memory limit counts the pictures (16 bytes a pixel, while they are read) and the faces (12).
// Errors: as there, LAM_UNSUPPORTED where a picture's size does not fit (every message names the file),
// LAM_LIMIT, LAM_CANCELLED.
LAM_API lam_environment *lam_environment_load_faces(const char *const paths[LAM_FACE_COUNT], lam_color_mode color,
                                                    const lam_control *control, lam_error *error);
LAM_API lam_environment *lam_environment_load(const char *path, lam_color_mode color, const lam_control *control,
                                              lam_error *error);

// The built-in ones, computed: "sky" (a low sun over grey-brown ground) and "studio" (soft boxes of light in a dark
// room).
LAM_API lam_environment *lam_environment_built_in(const char *name, lam_error *error);
LAM_API const char *lam_environment_name(int index); // NULL out of range

LAM_API void lam_environment_free(lam_environment *environment); // NULL is fine

LAM_API int lam_environment_size(const lam_environment *environment); // pixels on a face's side

// The light from a direction of the environment's own axes, any length but 0 (that gives black): bilinear, without a
// seam where faces meet. It is what drawing adds, times the material's reflectivity.
LAM_API lam_rgb lam_environment_look(const lam_environment *environment, lam_vec3 direction);

#ifdef __cplusplus
}
#endif
#endif
