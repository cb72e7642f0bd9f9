// gltf_materials.h: reads materials (section 3.9), and finds the material of a primitive.
#ifndef GLTF_MATERIALS_H
#define GLTF_MATERIALS_H

#include "gltf.h"

#include <lambent/material.h>

// Adds the file's materials to the scene, and finds the requested variant.
bool gltf_materials_read(struct gltf *gltf);

// Gets the material of a primitive as an index in the scene. If the primitive has a material for the requested variant
// (KHR_materials_variants), that material is used.
bool gltf_take_material(struct gltf *gltf, const struct place *place, const json_t *primitive, int32_t *material);

// Returns whether the material with this index in the scene is opaque. If so, the alpha values of the material, its
// textures and the vertex colours are ignored.
bool gltf_material_is_opaque(const struct gltf *gltf, int32_t material);
bool gltf_material_is_double_sided(struct gltf *gltf, int32_t material);

// --- the extensions that add layers to a material (KHR_materials_clearcoat and others).

// --- reads textures, samplers and images (sections 3.8 and 5.29).

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
