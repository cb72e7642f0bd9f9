// gltf_layers.c: reads material layers: KHR_materials_ior, specular, clearcoat, sheen, anisotropy, iridescence,
// transmission and volume. The tables in khr_layers.h list the members of these extensions.
#include "gltf_layers.h"

#include "gltf_json.h"
#include "gltf_textures.h"

#include "khr_layers.h"
#include "linear.h"

static void take_numbers(struct gltf *gltf, const struct place *place, const json_t *object, lam_material *material)
{
    for (size_t i = 0; i < KHR_NUMBERS; i++) {
        const json_t *extension = gltf_extension(object, khr_numbers[i].extension);
        const struct place *here = KEY_OF(KEY_OF(place, "extensions"), khr_numbers[i].extension);
        float *member = (float *)(void *)((char *)material + khr_numbers[i].offset);
        double values[3] = {(double)member[0]};
        for (int k = 1; k < khr_numbers[i].count; k++)
            values[k] = (double)member[k];
        if (!extension)
            continue;
        gltf_take_factors(gltf, here, extension, khr_numbers[i].key, (size_t)khr_numbers[i].count, khr_numbers[i].min,
                          khr_numbers[i].max, values);
        for (int k = 0; k < khr_numbers[i].count; k++)
            member[k] = (float)values[k];
    }
    // Removes full rotations, which do not change the direction.
    double turn = 2 * math_radians(180), angle = (double)material->anisotropy_rotation_rad;
    material->anisotropy_rotation_rad = (float)(angle - turn * (double)(int64_t)(angle / turn));
}

static bool take_maps(struct gltf *gltf, const struct place *place, const json_t *object, int index)
{
    for (size_t i = 0; i < KHR_MAPS; i++) {
        const json_t *extension = gltf_extension(object, khr_maps[i].extension);
        const struct place *here = KEY_OF(KEY_OF(place, "extensions"), khr_maps[i].extension);
        double scale = 1;
        const json_t *info = gltf_take_object(gltf, here, extension, khr_maps[i].key);
        if (khr_maps[i].slot == LAM_MAP_CLEARCOAT_NORMAL)
            gltf_take_factors(gltf, KEY_OF(here, khr_maps[i].key), info, "scale", 1, -1e6, 1e6, &scale);
        const struct gltf_map_request request = {
            index, khr_maps[i].slot, khr_maps[i].values, khr_maps[i].channel, (float)scale, 0};
        // A scale of 0 disables the map.
        if (scale != 0 && !gltf_take_map(gltf, here, extension, khr_maps[i].key, request))
            return false;
    }
    return true;
}

bool gltf_take_layers(struct gltf *gltf, const struct place *place, const json_t *object, int index,
                      lam_material *material)
{
    // Unlit materials and specular-glossiness materials have no layers.
    if (material->unlit || gltf_extension(object, "KHR_materials_pbrSpecularGlossiness"))
        return true;
    take_numbers(gltf, place, object, material);
    return take_maps(gltf, place, object, index);
}
