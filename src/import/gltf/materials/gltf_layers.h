// gltf_layers.h: the extensions that add layers to a material (KHR_materials_clearcoat and others).
#ifndef GLTF_LAYERS_H
#define GLTF_LAYERS_H

#include "gltf.h"

// Reads the layers of material `index`, the JSON object `object`, into `material`, and requests their maps.
bool gltf_take_layers(struct gltf *gltf, const struct place *place, const json_t *object, int index,
                      lam_material *material);

#endif
