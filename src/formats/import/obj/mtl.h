// mtl.h: reads MTL, the material files of OBJ.
#ifndef MTL_H
#define MTL_H

#include "companion.h"
#include "name_table.h"

// The materials from an index on come from a file in `folder`, relative to the model's folder ("" or with its '/').
struct mtl_folder {
    int first;
    const char *folder;
};

// The materials of one model.
struct mtl_set {
    struct scene_list folders; // struct mtl_folder
    struct name_table by_name; // maps the model's material names to indices in the scene
    size_t other_maps;         // number of statements with a texture that is not drawn
    size_t reflection_maps;    // number of refl statements, which assign an environment to one material
};

// Reads a file's materials into the scene and the set; duplicate names are ignored. Errors in the file become warnings:
// the function fails only if memory runs out or the call is cancelled.
bool mtl_read(struct mtl_set *set, const struct import_source *source, struct lam_scene *scene,
              const struct companion *library, lam_error *error);

#endif
