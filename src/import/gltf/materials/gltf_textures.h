// gltf_textures.h: textures, samplers and images (sections 3.8 and 5.29): how materials read them, and their pictures.
#ifndef GLTF_TEXTURES_H
#define GLTF_TEXTURES_H

#include "gltf.h"

bool gltf_textures_start(struct gltf *gltf);

// A map of a material, as its textureInfo under `key` says. `material` has its number in the file's list. Without the
// key `material->maps[slot]` stays as it is. *present (may be NULL): whether the key is present.
struct gltf_map_request {
    int material;
    lam_map slot;
    lam_texture_values values;
    int channel;
    float scale, offset;
};
bool gltf_take_map(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                   struct gltf_map_request request, bool *present);

// Decodes the pictures of all maps, in parallel, and gives the maps to the materials. A map whose picture cannot be read is
// left out, with a warning.
bool gltf_textures_finish(struct gltf *gltf);

// Returns which of the file's sets of texture coordinates is a material's first (0) or second (1) one, or −1 if there
// is none.
int gltf_texcoord_set(const struct gltf *gltf, int32_t material, int which);

#endif
