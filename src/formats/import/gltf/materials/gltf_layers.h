// gltf_layers.h: the extensions that add layers to a material (KHR_materials_clearcoat and others).
#ifndef GLTF_LAYERS_H
#define GLTF_LAYERS_H

#include "gltf.h"

// Reads the layers of a material into `material`, and requests the maps of these layers. `index` is the material's
// index in the file, and `object` is its JSON object.
bool gltf_take_layers(struct gltf *gltf, const struct place *place, const json_t *object, int index,
                      lam_material *material);

#endif
