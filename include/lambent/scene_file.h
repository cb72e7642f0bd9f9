// lambent/scene_file.h: scene files: what they say about their picture, and writing them. docs/scene-file.md has the
// format.
#ifndef LAMBENT_SCENE_FILE_H
#define LAMBENT_SCENE_FILE_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// Which fields of lam_settings were given: bits of `given`.
enum {
    LAM_GIVEN_SIZE = 1 << 0,
    LAM_GIVEN_SAMPLES = 1 << 1,
    LAM_GIVEN_BACKGROUND = 1 << 2,
    LAM_GIVEN_COLOR = 1 << 3,
    LAM_GIVEN_EXPOSURE = 1 << 4,
    LAM_GIVEN_CAMERA = 1 << 5,
    LAM_GIVEN_SHADING = 1 << 6,
    LAM_GIVEN_REFLECTION = 1 << 7,
    LAM_GIVEN_STAGE = 1 << 8,
    LAM_GIVEN_VIEWER = 1 << 9,
    LAM_GIVEN_FLAT_NORMAL = 1 << 10,
    LAM_GIVEN_MATCH_HIGHLIGHTS = 1 << 11,
    LAM_GIVEN_GL1 = 1 << 12,
    LAM_GIVEN_LIGHTS = 1 << 13,
    LAM_GIVEN_ENVIRONMENT = 1 << 14,
    LAM_GIVEN_LIGHT_CUTOFF = 1 << 15,
};

// What a scene file says about its picture, beside what lam_scene holds. Fields that are not given are zero.
typedef struct lam_settings {
    unsigned given;
    int width, height; // pixels
    lam_camera camera;
    // samples, background, color, exposure, shading, reflection, stage, viewer, flat_normal,
    // match_highlights, gl1, light_cutoff; rig is LAM_RIG_NONE where lights are given, be it an empty list.
    lam_draw_params draw;
    // The environment: six faces (+x −x +y −y +z −z), or one picture (equirectangular or a cross), as paths
    // that can be opened from here (as in the file where that came from memory); or the name of a built-in
    // one. They live as long as the scene.
    const char *faces[6];
    const char *equirectangular;
    const char *built_in;
    double environment_rotation_rad; // about the up axis
} lam_settings;

// The settings of a scene that came from a scene file. False (and all zero) for any other scene.
LAM_API bool lam_scene_settings(const lam_scene *scene, lam_settings *settings);

// Writes a scene file from which lam_scene_load and `settings` make the same picture again: models by their names
// relative to the folder of `path`, shapes, materials, transforms, all lights (those of settings->draw.rig spelled
// out), and every given field of `settings` (NULL: none). Only objects that came from files or are built-in shapes can
// be written: a mesh that a program added is LAM_UNSUPPORTED. The file appears whole or not at all. Errors:
// LAM_CANNOT_WRITE, LAM_LIMIT.
LAM_API bool lam_scene_save(const lam_scene *scene, const lam_settings *settings, const char *path, lam_error *error);

// The lights of a scene and a rig (LAM_RIG_AUTO: the studio where the scene has none) as the keys "ambient" and
// "lights" of a scene file. The caller frees `out` with lam_bytes_free.
LAM_API bool lam_lights_encode(const lam_scene *scene, lam_rig rig, lam_bytes *out, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
