// maps.c: the factors and texels of maps.
#include "maps.h"

#include "elementary.h"

// glTF uses only green and blue. If a shader reads red or alpha by mistake, the shader receives these numbers.
static const float unread_red = 0.9f, unread_alpha = 0.7f;

// The maps that can multiply each number.
static const enum uniform_semantic maps_of[][2] = {
    [NUMBER_BASE_COLOR] = {SEMANTIC_BASE_COLOR_MAP, SEMANTIC_BASE_COLOR_MAP},
    [NUMBER_METALLIC] = {SEMANTIC_METALLIC_ROUGHNESS_MAP, SEMANTIC_METALLIC_MAP},
    [NUMBER_ROUGHNESS] = {SEMANTIC_METALLIC_ROUGHNESS_MAP, SEMANTIC_ROUGHNESS_MAP},
    [NUMBER_OCCLUSION] = {SEMANTIC_OCCLUSION_MAP, SEMANTIC_OCCLUSION_MAP},
    [NUMBER_EMISSION] = {SEMANTIC_EMISSION_MAP, SEMANTIC_EMISSION_MAP},
};

static unsigned bits_of(enum map_number number) { return map_bit(maps_of[number][0]) | map_bit(maps_of[number][1]); }

float map_factor(const struct reference_scene *s, enum map_number number, float whole)
{
    unsigned bits = bits_of(number);
    if (!(s->maps & bits))
        return whole;
    return s->factors & bits ? 0.5f + 0.5f * whole : 1;
}

static float texel_of(const struct reference_scene *s, enum map_number number, float whole)
{
    return s->maps & bits_of(number) ? whole / map_factor(s, number, whole) : 1;
}

static float encoded(const struct reference_scene *s, float x)
{
    return s->encoded_maps && x > 0 ? (float)math_pow((double)x, 1 / 2.2) : x;
}

static struct uniform_value color(const struct reference_scene *s, enum map_number number, lam_rgb whole)
{
    return (struct uniform_value){{encoded(s, texel_of(s, number, whole.r)), encoded(s, texel_of(s, number, whole.g)),
                                   encoded(s, texel_of(s, number, whole.b)), 1}};
}

static struct uniform_value grey(float x) { return (struct uniform_value){{x, x, x, 1}}; }

struct uniform_value map_texel(enum uniform_semantic map, const struct reference_scene *s)
{
    const lam_vec3 n = s->bump;
    switch (map) {
    case SEMANTIC_BASE_COLOR_MAP: // in classic shaders, colours are separate inputs, so the map is white
        return s->physical ? color(s, NUMBER_BASE_COLOR, s->diffuse) : grey(1);
    case SEMANTIC_METALLIC_ROUGHNESS_MAP:
        return (struct uniform_value){{unread_red, texel_of(s, NUMBER_ROUGHNESS, s->roughness),
                                       texel_of(s, NUMBER_METALLIC, s->metallic), unread_alpha}};
    case SEMANTIC_METALLIC_MAP:
        return grey(texel_of(s, NUMBER_METALLIC, s->metallic));
    case SEMANTIC_ROUGHNESS_MAP:
        return grey(texel_of(s, NUMBER_ROUGHNESS, s->roughness));
    case SEMANTIC_NORMAL_MAP:
        if (n.x == 0 && n.y == 0 && n.z == 0)
            return (struct uniform_value){{0.5f, 0.5f, 1, 1}};
        return (struct uniform_value){
            {(float)(0.5 * n.x + 0.5), (float)(0.5 * n.y + 0.5), (float)(0.5 * n.z + 0.5), 1}};
    case SEMANTIC_OCCLUSION_MAP:
        return grey(texel_of(s, NUMBER_OCCLUSION, s->occlusion));
    case SEMANTIC_EMISSION_MAP:
        return color(s, NUMBER_EMISSION, s->emission);
    default:
        return (struct uniform_value){{0}};
    }
}
