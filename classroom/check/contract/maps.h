// maps.h: the maps of a shader in a reference scene. Each map has one texel, so that filters, wraps and levels of
// detail have no effect. The texel differs between scenes.
//
// If a shader reads a map instead of a number, the texel is the number. If a shader multiplies a factor by a map, the
// product of the factor and the texel is the number. The factor and the texel then differ from each other and from 1.
#ifndef MAPS_H
#define MAPS_H

#include "contract.h"

static inline bool is_map(enum uniform_semantic semantic)
{
    return semantic >= SEMANTIC_BASE_COLOR_MAP && semantic <= SEMANTIC_EMISSION_MAP;
}

// Returns the bit of a map in reference_scene.maps and .factors.
static inline unsigned map_bit(enum uniform_semantic map) { return 1u << (map - SEMANTIC_BASE_COLOR_MAP); }

// The values of a material that a map can multiply.
enum map_number { NUMBER_BASE_COLOR, NUMBER_METALLIC, NUMBER_ROUGHNESS, NUMBER_OCCLUSION, NUMBER_EMISSION };

// Returns the factor of a number; `whole` is the product of the factor and the texel. If the map replaces the number,
// the factor is 1. If there is no map, the factor is `whole`.
float map_factor(const struct reference_scene *scene, enum map_number number, float whole);

// Returns the texel of a map, as the sampler reads it.
struct uniform_value map_texel(enum uniform_semantic map, const struct reference_scene *scene);

#endif
