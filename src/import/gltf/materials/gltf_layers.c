// gltf_layers.c: the layers of materials: KHR_materials_ior, specular, clearcoat, sheen, anisotropy, iridescence,
// transmission and volume. Their members are rows of two tables.
#include "gltf_layers.h"

#include "gltf_json.h"
#include "gltf_textures.h"

#include "linear.h"

#include <stddef.h>

#define KHR(name)      "KHR_materials_" name
#define MEMBER(member) offsetof(lam_material, member)

// A number or colour that becomes a field of lam_material, with the range that its standard allows.
static const struct {
    const char *extension, *key;
    size_t offset;
    int count; // of floats
    double min, max;
} numbers[] = {
    {KHR("ior"), "ior", MEMBER(ior), 1, 0, 1e30},
    {KHR("specular"), "specularFactor", MEMBER(specular_weight), 1, 0, 1},
    {KHR("specular"), "specularColorFactor", MEMBER(f0_color), 3, 0, 1e30},
    {KHR("clearcoat"), "clearcoatFactor", MEMBER(clearcoat), 1, 0, 1},
    {KHR("clearcoat"), "clearcoatRoughnessFactor", MEMBER(clearcoat_roughness), 1, 0, 1},
    {KHR("sheen"), "sheenColorFactor", MEMBER(sheen_color), 3, 0, 1},
    {KHR("sheen"), "sheenRoughnessFactor", MEMBER(sheen_roughness), 1, 0, 1},
    {KHR("anisotropy"), "anisotropyStrength", MEMBER(anisotropy), 1, 0, 1},
    {KHR("anisotropy"), "anisotropyRotation", MEMBER(anisotropy_rotation_rad), 1, -1e6, 1e6},
    {KHR("iridescence"), "iridescenceFactor", MEMBER(iridescence), 1, 0, 1},
    {KHR("iridescence"), "iridescenceIor", MEMBER(iridescence_ior), 1, 1, 1e30},
    {KHR("iridescence"), "iridescenceThicknessMinimum", MEMBER(iridescence_thickness_min), 1, 0, 1e6},
    {KHR("iridescence"), "iridescenceThicknessMaximum", MEMBER(iridescence_thickness_max), 1, 0, 1e6},
    {KHR("transmission"), "transmissionFactor", MEMBER(transmission), 1, 0, 1},
    {KHR("volume"), "thicknessFactor", MEMBER(thickness), 1, 0, 1e30},
    {KHR("volume"), "attenuationDistance", MEMBER(attenuation_distance), 1, 0, 1e30},
    {KHR("volume"), "attenuationColor", MEMBER(attenuation_color), 3, 0, 1},
};

static const struct {
    const char *extension, *key;
    lam_map slot;
    lam_texture_values values;
    int channel;
} maps[] = {
    {KHR("specular"), "specularTexture", LAM_MAP_SPECULAR_WEIGHT, LAM_TEXTURE_NUMBERS, 3},
    {KHR("specular"), "specularColorTexture", LAM_MAP_F0_COLOR, LAM_TEXTURE_COLOR, 0},
    {KHR("clearcoat"), "clearcoatTexture", LAM_MAP_CLEARCOAT, LAM_TEXTURE_NUMBERS, 0},
    {KHR("clearcoat"), "clearcoatRoughnessTexture", LAM_MAP_CLEARCOAT_ROUGHNESS, LAM_TEXTURE_NUMBERS, 1},
    {KHR("clearcoat"), "clearcoatNormalTexture", LAM_MAP_CLEARCOAT_NORMAL, LAM_TEXTURE_NUMBERS, 0},
    {KHR("sheen"), "sheenColorTexture", LAM_MAP_SHEEN_COLOR, LAM_TEXTURE_COLOR, 0},
    {KHR("sheen"), "sheenRoughnessTexture", LAM_MAP_SHEEN_ROUGHNESS, LAM_TEXTURE_NUMBERS, 3},
    {KHR("anisotropy"), "anisotropyTexture", LAM_MAP_ANISOTROPY, LAM_TEXTURE_NUMBERS, 0},
    {KHR("iridescence"), "iridescenceTexture", LAM_MAP_IRIDESCENCE, LAM_TEXTURE_NUMBERS, 0},
    {KHR("iridescence"), "iridescenceThicknessTexture", LAM_MAP_IRIDESCENCE_THICKNESS, LAM_TEXTURE_NUMBERS, 1},
    {KHR("transmission"), "transmissionTexture", LAM_MAP_TRANSMISSION, LAM_TEXTURE_NUMBERS, 0},
    {KHR("volume"), "thicknessTexture", LAM_MAP_THICKNESS, LAM_TEXTURE_NUMBERS, 1},
};

static bool take_numbers(struct gltf *gltf, const struct place *place, const json_t *object, lam_material *material)
{
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const json_t *extension = gltf_extension(object, numbers[i].extension);
        const struct place *here = KEY_OF(KEY_OF(place, "extensions"), numbers[i].extension);
        float *member = (float *)(void *)((char *)material + numbers[i].offset);
        double values[3] = {(double)member[0]};
        for (int k = 1; k < numbers[i].count; k++)
            values[k] = (double)member[k];
        if (!extension)
            continue;
        if (!gltf_take_factors(gltf, here, extension, numbers[i].key, (size_t)numbers[i].count, numbers[i].min,
                               numbers[i].max, values))
            return false;
        for (int k = 0; k < numbers[i].count; k++)
            member[k] = (float)values[k];
    }
    // Whole turns leave a direction as it is.
    double turn = 2 * math_radians(180), angle = (double)material->anisotropy_rotation_rad;
    material->anisotropy_rotation_rad = (float)(angle - turn * (double)(int64_t)(angle / turn));
    return true;
}

static bool take_maps(struct gltf *gltf, const struct place *place, const json_t *object, int index)
{
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++) {
        const json_t *extension = gltf_extension(object, maps[i].extension);
        const struct place *here = KEY_OF(KEY_OF(place, "extensions"), maps[i].extension);
        bool ok = true;
        double scale = 1;
        const json_t *info = gltf_take_object(gltf, here, extension, maps[i].key, &ok);
        if (maps[i].slot == LAM_MAP_CLEARCOAT_NORMAL)
            ok = ok && json_take_number(&gltf->json, KEY_OF(here, maps[i].key), info, "scale", -1e6, 1e6, &scale);
        const struct gltf_map_request request = {index, maps[i].slot, maps[i].values, maps[i].channel, (float)scale, 0};
        // A scale of 0 leaves nothing of the map.
        if (!ok || (scale != 0 && !gltf_take_map(gltf, here, extension, maps[i].key, request, NULL)))
            return false;
    }
    return true;
}

bool gltf_take_layers(struct gltf *gltf, const struct place *place, const json_t *object, int index,
                      lam_material *material)
{
    // The extensions exclude one another with these two.
    if (material->unlit || gltf_extension(object, "KHR_materials_pbrSpecularGlossiness"))
        return true;
    return take_numbers(gltf, place, object, material) && take_maps(gltf, place, object, index);
}
