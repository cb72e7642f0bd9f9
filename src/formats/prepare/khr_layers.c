// khr_layers.c: the tables of the extensions KHR_materials_ior, specular, clearcoat, sheen, anisotropy, iridescence,
// transmission and volume.
#include "khr_layers.h"

#include <stddef.h>

#define KHR(name)      "KHR_materials_" name
#define MEMBER(member) offsetof(lam_material, member)

const struct khr_number khr_numbers[KHR_NUMBERS] = {
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

const struct khr_map khr_maps[KHR_MAPS] = {
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
