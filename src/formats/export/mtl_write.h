// mtl_write.h: the materials of an OBJ file.
#ifndef MTL_WRITE_H
#define MTL_WRITE_H

#include "export.h"

struct mtl_names {
    const char *file; // the name of the MTL file, or NULL
    // the names of the scene's materials, then of the default material; NULL for unused materials
    const char *const *names;
    int count;
    // the scene's texture coordinates follow glTF, in which t points down, so t is written as 1 − t
    bool flips;
};

// Writes the materials that e->flat uses to a file beside the model, with their pictures.
bool mtl_write(struct exporting *e, struct mtl_names *out);

// Returns the name of a material. Returns NULL if there is no MTL file.
static inline const char *mtl_name(const struct mtl_names *names, int material)
{
    return names->file ? names->names[material >= 0 && material < names->count ? material : names->count] : NULL;
}

#endif
