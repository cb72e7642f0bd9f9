// lambent/export.h: exports scenes as model files.
#ifndef LAMBENT_EXPORT_H
#define LAMBENT_EXPORT_H

#include "camera.h"
#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

// An exported scene: its files, in memory, and a list of the features that the format does not support.
typedef struct lam_export lam_export;

// Parameters of an export. Zero is the default of each field.
typedef struct lam_export_params {
    // The name of the model's file, without a folder. Further files use it too: "part.obj" comes with "part.mtl" and
    // "part-0.png". NULL: "model" and the format's extension.
    const char *name;
    // A camera to store before the cameras of the scene, for formats with cameras. NULL: none.
    const lam_camera *camera;
    // A preview picture to store in the file (8 bits; only GLB: asset.thumbnail of the draft of glTF 2.1). NULL: none.
    const lam_image *thumbnail;
    // Limits of memory and time, and the flag that cancels the export; memory includes the files. Files that the scene
    // was read from limit the memory too (expansion_limit). NULL: no limits.
    const lam_control *control;
    LAM_RESERVED(4);
} lam_export_params;

// Makes the files of a model from a scene: its meshes, objects and materials with their textures, and its lights and
// cameras, as far as the format supports them. Coordinates are rotated to the up axis of the format. `format` is a name
// from lam_export_format. `params` may be NULL. The caller frees the result with lam_export_free. Returns NULL on
// failure: LAM_BAD_ARGUMENT (the scene contains nothing that the format supports; a thumbnail in a format without
// thumbnails), LAM_UNSUPPORTED (unknown format, or a required library is not installed), LAM_LIMIT,
// LAM_CANCELLED.
LAM_API lam_export *lam_scene_export(const lam_scene *scene, const char *format, const lam_export_params *params,
                                     lam_error *error);
LAM_API void lam_export_free(lam_export *result); // NULL is allowed

// These functions return the name and the contents of the file with this index (from 0): first the model, then further
// files. The name is NULL if the index is out of range. Both are valid until the result is freed.
LAM_API const char *lam_export_file_name(const lam_export *result, int index);
LAM_API lam_bytes lam_export_file(const lam_export *result, int index);

// Returns the sentence with this index (from 0) about data of the scene that the files omit; NULL past the last one.
LAM_API const char *lam_export_loss(const lam_export *result, int index);

// Returns the name of the format with this index (from 0), which is also the file extension ("glb"). Returns a static
// string, or NULL if the index is out of range.
LAM_API const char *lam_export_format(int index);

#ifdef __cplusplus
}
#endif
#endif
