// mtl.h: MTL, the material files that OBJ files name.
#ifndef MTL_H
#define MTL_H

#include "importer.h"

// The materials of one model, by name.
struct mtl_set {
    struct arena *memory; // for the table
    struct mtl_entry *entries;
    uint32_t capacity, count; // capacity: a power of two, or 0
    size_t maps;              // statements that name a texture
};

struct mtl_entry {
    const char *name; // NULL: free
    int32_t material; // index in the scene
};

// Reads a file's materials into the scene and the set; of equal names the first is kept. Errors in the file become
// warnings: only lack of memory or a cancelled call makes it fail. `name`: the file's, for messages.
bool mtl_read(struct mtl_set *set, const struct import_source *source, struct lam_scene *scene, const char *name,
              const struct file_bytes *file, lam_error *error);

// The material of a name; −1: none.
int32_t mtl_find(const struct mtl_set *set, const char *name);

#endif
