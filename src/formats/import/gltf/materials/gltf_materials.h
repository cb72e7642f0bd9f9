// gltf_materials.h: reads materials (section 3.9), and finds the material of a primitive.
#ifndef GLTF_MATERIALS_H
#define GLTF_MATERIALS_H

#include "gltf.h"

// Adds the file's materials to the scene, and finds the requested variant.
bool gltf_materials_read(struct gltf *gltf);

// Gets the material of a primitive as an index in the scene. If the primitive has a material for the requested variant
// (KHR_materials_variants), that material is used.
bool gltf_take_material(struct gltf *gltf, const struct place *place, const json_t *primitive, int32_t *material);

// Returns whether the material with this index in the scene is opaque. If so, the alpha values of the material, its
// textures and the vertex colours are ignored.
bool gltf_material_is_opaque(const struct gltf *gltf, int32_t material);
bool gltf_material_is_double_sided(struct gltf *gltf, int32_t material);

#endif
