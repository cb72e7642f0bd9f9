// lambent/export.h: scenes as model files.
#ifndef LAMBENT_EXPORT_H
#define LAMBENT_EXPORT_H

#include "camera.h"
#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

// The files that a scene became, in memory, and what the format could not hold.
typedef struct lam_export lam_export;

// How a scene is exported. All zero is the default.
typedef struct lam_export_params {
    // The name of the model's file, without a folder. Files beside it are named after it: "part.obj" comes with "part.mtl" and
    // "part-0.png". NULL: "model" and the format's ending.
    const char *name;
    // A camera that comes before the scene's cameras, for formats with cameras. NULL: none.
    const lam_camera *camera;
    // A picture of the scene for programs that list files: GLB alone, asset.thumbnail of the draft of glTF 2.1
    // (8 bits). NULL: none.
    const lam_image *thumbnail;
    LAM_RESERVED(5);
} lam_export_params;

// Makes the files of a model from a scene: its meshes, objects and materials with their textures, and its lights and cameras, as far as
// the format holds them. The up axis becomes the format's: coordinates are turned. `format` is one of lam_export_format. `params` may be
// NULL. The caller frees the result with lam_export_free. NULL on failure: LAM_BAD_ARGUMENT (nothing that the format can hold; a
// thumbnail in a format without one),
// LAM_UNSUPPORTED (no such format, or a library that writes it is not installed), LAM_LIMIT.
LAM_API lam_export *lam_scene_export(const lam_scene *scene, const char *format, const lam_export_params *params,
                                     lam_error *error);
LAM_API void lam_export_free(lam_export *result); // NULL is fine

// The files, from 0: first the model, then those beside it. The name, valid until the result is freed (NULL out of range), and the
// contents, which stay the result's.
LAM_API const char *lam_export_file_name(const lam_export *result, int index);
LAM_API lam_bytes lam_export_file(const lam_export *result, int index);

// Sentences, from 0, about what the files do not say although the scene does; NULL: no more.
LAM_API const char *lam_export_loss(const lam_export *result, int index);

// The formats, from 0: the name, which is the ending of file names too ("glb"). A static string; NULL out of range.
LAM_API const char *lam_export_format(int index);

#ifdef __cplusplus
}
#endif
#endif
