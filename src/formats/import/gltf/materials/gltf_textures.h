// gltf_textures.h: reads textures, samplers and images (sections 3.8 and 5.29).
#ifndef GLTF_TEXTURES_H
#define GLTF_TEXTURES_H

#include "gltf.h"

#include <lambent/material.h>

bool gltf_textures_start(struct gltf *gltf);

// A request for a material's map, from the textureInfo under `key`. `material` is the material's index in the file. If
// the key is missing, `material->maps[slot]` is unchanged. Returns false if memory runs out.
struct gltf_map_request {
    int material;
    lam_map slot;
    lam_texture_values values;
    int channel;
    float scale, offset;
};
bool gltf_take_map(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                   struct gltf_map_request request);

// Decodes the pictures of all maps, in parallel, and sets the maps in the materials. A map whose picture cannot be read
// is omitted and noted.
bool gltf_textures_finish(struct gltf *gltf);

// Returns the file's number for a material's first (`which` is 0) or second (1) set of texture coordinates, or −1 if
// the material does not use that set.
int gltf_texcoord_set(const struct gltf *gltf, int32_t material, int which);

#endif
