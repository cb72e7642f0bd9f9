// gltf_layers.h: the extensions that add layers to a material (KHR_materials_clearcoat and others).
#ifndef GLTF_LAYERS_H
#define GLTF_LAYERS_H

#include "gltf.h"

// Reads the layers of a material into `material`, and requests the maps of these layers. The material has the index
// `index` and the JSON object `object`.
bool gltf_take_layers(struct gltf *gltf, const struct place *place, const json_t *object, int index,
                      lam_material *material);

#endif
