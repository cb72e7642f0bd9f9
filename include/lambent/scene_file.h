// lambent/scene_file.h: the picture settings of scene files, and functions that write scene files (docs/scene-file.md).
#ifndef LAMBENT_SCENE_FILE_H
#define LAMBENT_SCENE_FILE_H

#include "section.h"
#include "settings.h"

#ifdef __cplusplus
extern "C" {
#endif

// The settings of a scene file that lam_draw_setting does not list: bits of lam_picture_settings.present.
enum {
    LAM_SETTING_SIZE = 1 << 0,        // width, height
    LAM_SETTING_SAMPLES = 1 << 1,     // draw.samples
    LAM_SETTING_BACKGROUND = 1 << 2,  // draw.background
    LAM_SETTING_COLOR = 1 << 3,       // draw.color
    LAM_SETTING_EXPOSURE = 1 << 4,    // draw.exposure
    LAM_SETTING_TONE = 1 << 5,        // draw.tone
    LAM_SETTING_CAMERA = 1 << 6,      // camera
    LAM_SETTING_LIGHTS = 1 << 7,      // the scene's lights, even if the list is empty
    LAM_SETTING_ENVIRONMENT = 1 << 8, // environment_…
    LAM_SETTING_SECTIONS = 1 << 9,    // sections
};

// The picture that a scene file describes: its size, camera and drawing settings. lam_scene contains the rest. Settings
// that the file does not contain are zero.
typedef struct lam_picture_settings {
    unsigned present; // LAM_SETTING_…: the settings that the file contains
    // Bit i: the file contains lam_draw_setting(i), whose value is in `draw`.
    uint64_t draw_present;
    int width, height; // pixels
    lam_camera camera; // as for lam_draw
    // The settings above that begin with "draw.", and the settings of draw_present. `rig` is LAM_RIG_NONE if
    // LAM_SETTING_LIGHTS is present.
    lam_draw_params draw;
    // The environment in one of three forms; the members of the other forms are NULL. Paths can be opened from the
    // current folder, but the paths of a scene file in memory are unchanged. The strings live as long as the scene.
    const char *environment_faces[6]; // six pictures: +x −x +y −y +z −z
    const char *environment_picture;  // one picture: equirectangular or a cross
    const char *environment_built_in; // the name of a built-in environment
    double environment_rotation_rad;  // about the up axis
    // The planes that cut the scene, which loading has applied (section.h). They live as long as the scene.
    // lam_scene_save ignores them, and writes the scene's own.
    const lam_section *sections;
    int section_count; // elements of `sections`
    // Whether the environment is set by lam_scene_set_reflection_map (the key "reflection_map").
    bool reflection_map;
    LAM_RESERVED(14);
} lam_picture_settings;

// Gets the settings of a scene that was loaded from a scene file. Returns false and sets all fields to zero for any
// other scene.
LAM_API bool lam_scene_picture_settings(const lam_scene *scene, lam_picture_settings *settings);

// Writes a scene file from which lam_scene_load (with models_anywhere if a file is outside the folder of `path`) and
// lam_scene_picture_settings reproduce the picture. The file contains the names of models relative to that folder,
// shapes, materials, transforms, all lights (including the lights of settings->draw.rig), and the settings present in
// `settings` (NULL: none). The file appears completely or not at all. Errors: LAM_UNSUPPORTED (a mesh that is neither
// from a file nor a built-in shape), LAM_CANNOT_WRITE, LAM_LIMIT.
LAM_API bool lam_scene_save(const lam_scene *scene, const lam_picture_settings *settings, const char *path,
                            lam_error *error);

// Makes the bytes of the scene file that lam_scene_save would write to `path`. The caller frees `out` with
// lam_bytes_free. Errors as above; LAM_CANNOT_WRITE if the folder of `path` cannot be found.
LAM_API bool lam_scene_encode(const lam_scene *scene, const lam_picture_settings *settings, const char *path,
                              lam_bytes *out, lam_error *error);

// Writes the lights of a scene and a rig (LAM_RIG_AUTO: the studio if the scene has no lights) as the keys "ambient"
// and "lights" of a scene file. `ground`: as in lam_scene_rig_lights. The caller frees `out` with lam_bytes_free.
// Errors: LAM_LIMIT.
LAM_API bool lam_lights_encode(const lam_scene *scene, lam_rig rig, bool ground, lam_bytes *out, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
