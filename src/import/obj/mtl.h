// mtl.h: reads MTL, the material files of OBJ.
#ifndef MTL_H
#define MTL_H

#include "companion.h"
#include "name_table.h"

// The materials of one model.
struct mtl_set {
    struct name_table by_name; // of the model; the value is the index in the scene
    size_t other_maps;         // statements that name a texture which is not drawn
    size_t reflection_maps;    // statements refl, which give one material surroundings of its own
};

// Reads a file's materials into the scene and the set; of equal names the first is kept. Errors in the file become
// warnings: only lack of memory or a cancelled call makes it fail.
bool mtl_read(struct mtl_set *set, const struct import_source *source, struct lam_scene *scene,
              const struct companion *library, lam_error *error);

#endif
