// gltf_materials.h: materials (section 3.9), and which one a primitive has.
#ifndef GLTF_MATERIALS_H
#define GLTF_MATERIALS_H

#include "gltf.h"

// Adds the file's materials to the scene, and finds the variant that the caller wants.
bool gltf_materials_read(struct gltf *gltf);

// The material of a primitive, in the requested variant if it has one (KHR_materials_variants): an index in the scene.
bool gltf_take_material(struct gltf *gltf, const struct place *place, const json_t *primitive, int32_t *material);

// By an index in the scene. Opaque: no alpha of the material, its textures or vertex colours counts.
bool gltf_material_is_opaque(const struct gltf *gltf, int32_t material);
bool gltf_material_is_double_sided(const struct gltf *gltf, int32_t material);

#endif
