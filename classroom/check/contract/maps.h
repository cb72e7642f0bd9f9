// maps.h: the maps of a shader in a reference scene: one texel, a different one in each scene, so that filters, wraps
// and levels of detail have no effect.
//
// A shader that reads a map instead of a number gets the number as the texel. One that multiplies the two gets a factor
// and a texel whose product is that number, neither of them 1 or like the other.
#ifndef MAPS_H
#define MAPS_H

#include "contract.h"

static inline bool is_map(enum uniform_semantic semantic)
{
    return semantic >= SEMANTIC_BASE_COLOR_MAP && semantic <= SEMANTIC_EMISSION_MAP;
}

// In reference_scene.maps and .factors.
static inline unsigned map_bit(enum uniform_semantic map) { return 1u << (map - SEMANTIC_BASE_COLOR_MAP); }

// Which number of a material a map multiplies.
enum map_number { NUMBER_BASE_COLOR, NUMBER_METALLIC, NUMBER_ROUGHNESS, NUMBER_OCCLUSION, NUMBER_EMISSION };

// The factor of such a number if a map multiplies it: 1 if the map replaces the number, the number itself if there is
// no map. `whole`: their product.
float map_factor(const struct reference_scene *scene, enum map_number number, float whole);

// The texel of a map, as the sampler gives it.
struct uniform_value map_texel(enum uniform_semantic map, const struct reference_scene *scene);

#endif
