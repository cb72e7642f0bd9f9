// gltf_accessors.h: accessors (section 3.6.2): typed arrays in the file's buffers.
#ifndef GLTF_ACCESSORS_H
#define GLTF_ACCESSORS_H

#include "gltf.h"

bool gltf_accessors_start(struct gltf *gltf);

// Gets the accessor that a key of `object` refers to. *out is NULL if the key is missing. Returns false on error.
bool gltf_take_accessor(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                        struct gltf_accessor **out);

// Returns the size in bytes of a number of this component type.
static inline size_t gltf_component_size(int component)
{
    return component <= GLTF_U8 ? 1 : component <= GLTF_U16 ? 2 : 4;
}

// Returns a description of the accessor's type: "VEC3 of FLOAT", "VEC4 of normalized UNSIGNED_BYTE".
const char *gltf_accessor_words(const struct gltf_accessor *accessor, char out[64]);

#endif
