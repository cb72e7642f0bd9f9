// lambent/environment.h: environments: cube maps of the surroundings that shiny surfaces reflect, from files or built
// in.
#ifndef LAMBENT_ENVIRONMENT_H
#define LAMBENT_ENVIRONMENT_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

struct lam_image;

// A cube map: six square faces of linear light, sampled with a direction. A cube map is immutable, so any number of
// scenes and threads may share it.
typedef struct lam_environment lam_environment;

// The faces in OpenGL's order, named by the axis through their middle.
typedef enum lam_cube_face {
    LAM_FACE_PX = 0, // +x
    LAM_FACE_NX,     // −x
    LAM_FACE_PY,     // +y, the top
    LAM_FACE_NY,     // −y, the ground
    LAM_FACE_PZ,     // +z
    LAM_FACE_NZ,     // −z
    LAM_FACE_COUNT
} lam_cube_face;

// Makes an environment of six square pictures of one size, up to 8192 pixels on a side, which are copied. Each face
// follows OpenGL's table of cube maps, with its first row at t = 0. Seen from inside with y up, the four side faces are
// upright and mirrored left to right.
//
// LAM_RGBA8 is decoded from sRGB, or used unchanged with LAM_COLOR_RAW; LAM_RGBA32F is linear. Transparent pixels are
// blended over black. Returns NULL on failure: LAM_BAD_ARGUMENT (sizes; numbers below 0 or not finite), LAM_LIMIT.
LAM_API lam_environment *lam_environment_make(const struct lam_image *const faces[LAM_FACE_COUNT], lam_color_mode color,
                                              lam_error *error);

// Makes an environment from one picture, whose aspect ratio determines its layout:
//   4:3  a cross lying down    . +Y  .  .      3:4  a cross standing   . +Y  .
//                             -X +Z +X -Z                              -X +Z +X
//                              . -Y  .  .                               . -Y  .
//                                                                       . -Z  .   (-Z turned by 180°)
//   2:1  equirectangular: direction −z in the middle, +x to the right of it, +y at the top
// An equirectangular picture is sampled once, bilinearly, into faces of width/π pixels on a side, rounded up, so that
// in the middle of a face one pixel corresponds to about one pixel of the picture.
LAM_API lam_environment *lam_environment_from_image(const struct lam_image *image, lam_color_mode color,
                                                    lam_error *error);

// Makes an environment from files of any format that lam_image_load_linear reads: six faces, or one picture. `control`
// may be NULL; its memory limit counts each file while it is read, the pictures (16 bytes per pixel) and the faces (12
// bytes per pixel). Errors: as above, the errors of lam_image_load, and LAM_UNSUPPORTED (a picture's size); every
// sentence names the file.
LAM_API lam_environment *lam_environment_load_faces(const char *const paths[LAM_FACE_COUNT], lam_color_mode color,
                                                    const lam_control *control, lam_error *error);
LAM_API lam_environment *lam_environment_load(const char *path, lam_color_mode color, const lam_control *control,
                                              lam_error *error);

// Computes a built-in environment: "sky" (a low, weak sun over grey-brown ground), "studio" (softboxes in a dark room),
// "soft" (a tent of white cloth), "outdoor" (a meadow at noon, with a bright sun), "night" (moon and street lamps) or
// "cyclorama" (a white wall that curves into the floor, under a panel).
// Fails with LAM_BAD_ARGUMENT (no such name), LAM_LIMIT.
LAM_API lam_environment *lam_environment_built_in(const char *name, lam_error *error);

// Returns the name of the built-in environment with this index (from 0). The strings are static. Returns NULL if the
// index is out of range.
LAM_API const char *lam_environment_built_in_name(int index);

// Releases an environment. Scenes that use the environment keep it. NULL is allowed.
LAM_API void lam_environment_free(lam_environment *environment);

// Returns the width and height of each face in pixels.
LAM_API int lam_environment_size(const lam_environment *environment);

// Returns the linear light from a direction, given in the environment's own axes. The length of the direction does not
// matter, but (0, 0, 0) gives black. The lookup is bilinear and seamless across faces. Drawing adds this light times
// the reflectivity of a classic material. Physical materials use prefiltered means of this light. The first frame that
// needs these means computes them, and the environment stores them (docs/lighting/environment.md).
LAM_API lam_rgb lam_environment_sample(const lam_environment *environment, lam_vec3 direction);

// Makes the texture `environment_light` of exported shaders (lambent/shader.h), which lights physical materials: a
// LAM_RGBA32F picture 1024 texels wide, which the caller frees with lam_image_free. The picture contains the
// prefiltered levels 1 to 11 and the irradiance divided by pi. Each level, and the irradiance, consists of six faces in
// the order of lam_cube_face with a border of one texel, stored row by row as one sequence of texels.
// docs/lighting/environment.md lists sizes and roughnesses. `control` may be NULL. Errors: LAM_BAD_ARGUMENT (NULL),
// LAM_LIMIT, LAM_CANCELLED.
LAM_API bool lam_environment_light_image(const lam_environment *environment, struct lam_image *image,
                                         const lam_control *control, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
