// gltf_materials.c: reads materials (section 3.9), and finds the material of a primitive.
#include "gltf_materials.h"
#include "gltf_json.h"
#include "khr_layers.h"
#include "linear.h"

// --- reads material layers: KHR_materials_ior, specular, clearcoat, sheen, anisotropy, iridescence, transmission and
// volume. The tables in khr_layers.h list the members of these extensions.

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

static bool take_layer_maps(struct gltf *gltf, const struct place *place, const json_t *object, int index)
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

// Reads the layers of a material into `material`, and requests the maps of these layers. `index` is the material's
// index in the file, and `object` is its JSON object.
static bool gltf_take_layers(struct gltf *gltf, const struct place *place, const json_t *object, int index,
                             lam_material *material)
{
    // Unlit materials and specular-glossiness materials have no layers.
    if (material->unlit || gltf_extension(object, "KHR_materials_pbrSpecularGlossiness"))
        return true;
    take_numbers(gltf, place, object, material);
    return take_layer_maps(gltf, place, object, index);
}

#define FACTOR_MAX 1e30 // the upper limit for factors that the standard does not limit

// The values of a material in the file, with the defaults of the specification.
struct factors {
    double base[4];             // colour and alpha
    double metallic, roughness; // 0…1
    double specular[3];         // for KHR_materials_pbrSpecularGlossiness
    double glossiness;          // for KHR_materials_pbrSpecularGlossiness, 0…1
    // The material uses the specular-glossiness model instead of the metallic-roughness model.
    bool has_specular;
    double emission[3], strength; // emissiveFactor; KHR_materials_emissive_strength
    double cutoff;
    int alpha; // lam_alpha_mode
    bool unlit;
};

static const struct json_choice alpha_words[] = {
    {"OPAQUE", LAM_ALPHA_OPAQUE}, {"MASK", LAM_ALPHA_MASK}, {"BLEND", LAM_ALPHA_BLEND}, {NULL, 0}};

static void take_share(struct gltf *gltf, const struct place *place, const json_t *object, const char *key, double *out)
{
    gltf_take_factors(gltf, place, object, key, 1, 0, 1, out);
}

static void take_metallic_roughness(struct gltf *gltf, const struct place *place, const json_t *object,
                                    struct factors *f)
{
    const json_t *pbr = gltf_take_object(gltf, place, object, "pbrMetallicRoughness");
    const struct place *here = KEY_OF(place, "pbrMetallicRoughness");
    gltf_take_factors(gltf, here, pbr, "baseColorFactor", 4, 0, 1, f->base);
    take_share(gltf, here, pbr, "metallicFactor", &f->metallic);
    take_share(gltf, here, pbr, "roughnessFactor", &f->roughness);
}

static void take_specular_glossiness(struct gltf *gltf, const struct place *place, const json_t *object,
                                     struct factors *f)
{
    const json_t *pbr = gltf_extension(object, "KHR_materials_pbrSpecularGlossiness");
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    if (!pbr)
        return;
    f->has_specular = true;
    for (int i = 0; i < 4; i++)
        f->base[i] = 1;
    gltf_take_factors(gltf, here, pbr, "diffuseFactor", 4, 0, 1, f->base);
    gltf_take_factors(gltf, here, pbr, "specularFactor", 3, 0, 1, f->specular);
    take_share(gltf, here, pbr, "glossinessFactor", &f->glossiness);
    f->metallic = 0;
    // With a map, the roughness is 1 − glossiness · alpha. The offset and scale of the map express this as offset +
    // scale · alpha.
    f->roughness = json_is_object(json_object_get(pbr, "specularGlossinessTexture")) ? 1 : 1 - f->glossiness;
}

static void take_factors(struct gltf *gltf, const struct place *place, const json_t *object, struct factors *f)
{
    const json_t *strength = gltf_extension(object, "KHR_materials_emissive_strength");
    const struct place *in_strength = KEY_OF(KEY_OF(place, "extensions"), "KHR_materials_emissive_strength");
    f->unlit = gltf_extension(object, "KHR_materials_unlit") != NULL;
    take_metallic_roughness(gltf, place, object, f);
    take_specular_glossiness(gltf, place, object, f);
    gltf_take_factors(gltf, place, object, "emissiveFactor", 3, 0, 1, f->emission);
    gltf_take_factors(gltf, in_strength, strength, "emissiveStrength", 1, 0, FACTOR_MAX, &f->strength);
    gltf_take_factors(gltf, place, object, "alphaCutoff", 1, 0, FACTOR_MAX, &f->cutoff);
    gltf_take_word(gltf, place, object, "alphaMode", alpha_words, &f->alpha);
}

static lam_rgb rgb_of(const double c[3], double factor)
{
    return (lam_rgb){(float)(c[0] * factor), (float)(c[1] * factor), (float)(c[2] * factor)};
}

static lam_material material_of(const struct factors *f, const char *name)
{
    lam_material material = lam_material_default();
    lam_rgb base = rgb_of(f->base, 1);
    material.name = name;
    material.ambient = base;
    material.diffuse = (lam_rgba){base.r, base.g, base.b, f->alpha == LAM_ALPHA_OPAQUE ? 1 : (float)f->base[3]};
    material.alpha_mode = (lam_alpha_mode)f->alpha;
    material.alpha_cutoff = (float)f->cutoff;
    material.emission = rgb_of(f->emission, f->strength);
    material.unlit = f->unlit;
    if (f->has_specular) { // a dielectric whose reflectance f0 is the specular colour
        material.ior = 0;
        material.f0_color = rgb_of(f->specular, 1);
        material.specular_glossiness = 1;
    }
    material.physical = true;
    material.metallic = (float)f->metallic;
    material.roughness = (float)f->roughness;
    return material;
}

static const struct factors default_factors = {.base = {1, 1, 1, 1},
                                               .metallic = 1,
                                               .roughness = 1,
                                               .specular = {1, 1, 1},
                                               .glossiness = 1,
                                               .strength = 1,
                                               .cutoff = 0.5,
                                               .alpha = LAM_ALPHA_OPAQUE};

// Requests the maps of a specular-glossiness material. One picture contains the specular colour, and the glossiness in
// its alpha channel.
static bool take_glossy_maps(struct gltf *gltf, const struct place *place, const json_t *glossy, int index,
                             float glossiness)
{
    const struct gltf_map_request color = {index, LAM_MAP_DIFFUSE, LAM_TEXTURE_COLOR, 0, 1, 0},
                                  f0 = {index, LAM_MAP_F0_COLOR, LAM_TEXTURE_COLOR, 0, 1, 0},
                                  roughness = {index, LAM_MAP_ROUGHNESS, LAM_TEXTURE_COLOR, 3, -glossiness, 1};
    return gltf_take_map(gltf, place, glossy, "diffuseTexture", color) &&
           gltf_take_map(gltf, place, glossy, "specularGlossinessTexture", f0) &&
           (glossiness == 0 || gltf_take_map(gltf, place, glossy, "specularGlossinessTexture", roughness));
}

// Requests the maps of material `index`.
static bool take_maps(struct gltf *gltf, const struct place *place, const json_t *object, int index, float glossiness)
{
    const json_t *pbr = gltf_take_object(gltf, place, object, "pbrMetallicRoughness");
    const json_t *normal = gltf_take_object(gltf, place, object, "normalTexture");
    const json_t *occlusion = gltf_take_object(gltf, place, object, "occlusionTexture");
    const json_t *glossy = gltf_extension(object, "KHR_materials_pbrSpecularGlossiness");
    const struct place *in_pbr = KEY_OF(place, "pbrMetallicRoughness");
    const struct place *in_glossy = KEY_OF(KEY_OF(place, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    double scale = 1, strength = 1;
    gltf_take_factors(gltf, KEY_OF(place, "normalTexture"), normal, "scale", 1, -1e6, 1e6, &scale);
    take_share(gltf, KEY_OF(place, "occlusionTexture"), occlusion, "strength", &strength);
    const struct gltf_map_request color = {index, LAM_MAP_DIFFUSE, LAM_TEXTURE_COLOR, 0, 1, 0},
                                  metallic = {index, LAM_MAP_METALLIC, LAM_TEXTURE_NUMBERS, 2, 1, 0},
                                  roughness = {index, LAM_MAP_ROUGHNESS, LAM_TEXTURE_NUMBERS, 1, 1, 0},
                                  bent = {index, LAM_MAP_NORMAL, LAM_TEXTURE_NUMBERS, 0, (float)scale, 0},
                                  glow = {index, LAM_MAP_EMISSION, LAM_TEXTURE_COLOR, 0, 1, 0},
                                  hidden = {index, LAM_MAP_OCCLUSION, LAM_TEXTURE_NUMBERS,
                                            0,     (float)strength,   (float)(1 - strength)};
    // The most important maps come first, because a material has only two sets of texture coordinates. A scale or
    // strength of 0 disables the map.
    return (glossy ? take_glossy_maps(gltf, in_glossy, glossy, index, glossiness)
                   : gltf_take_map(gltf, in_pbr, pbr, "baseColorTexture", color) &&
                         gltf_take_map(gltf, in_pbr, pbr, "metallicRoughnessTexture", metallic) &&
                         gltf_take_map(gltf, in_pbr, pbr, "metallicRoughnessTexture", roughness)) &&
           (scale == 0 || gltf_take_map(gltf, place, object, "normalTexture", bent)) &&
           gltf_take_map(gltf, place, object, "emissiveTexture", glow) &&
           (strength == 0 || gltf_take_map(gltf, place, object, "occlusionTexture", hidden));
}

// Reads LAMBENT_material, in which the modules for other formats describe a material (docs/internals/import.md): any
// fields of lam_material by their keys, and any maps by their names. As in MTL, colours are encoded as sRGB, and a
// material without an ambient colour has its diffuse colour.
static bool take_own_material(struct gltf *gltf, const struct place *place, const json_t *object, int index,
                              lam_material *material)
{
    const json_t *own = gltf_extension(object, "LAMBENT_material"), *maps = json_object_get(own, "maps");
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), "LAMBENT_material");
    lam_material described = lam_material_default();
    if (!own)
        return true;
    described.name = material->name;
    for (int i = 0; lam_material_field(i); i++)
        gltf_take_field(gltf, here, own, lam_material_field(i), true, &described);
    if (!json_object_get(own, "ambient"))
        described.ambient = (lam_rgb){described.diffuse.r, described.diffuse.g, described.diffuse.b};
    *material = described;
    for (int slot = 0; slot < LAM_MAP_COUNT; slot++) {
        bool color =
            slot == LAM_MAP_DIFFUSE || slot == LAM_MAP_AMBIENT || slot == LAM_MAP_SPECULAR || slot == LAM_MAP_EMISSION;
        const struct gltf_map_request request = {
            index, (lam_map)slot, color ? LAM_TEXTURE_COLOR : LAM_TEXTURE_NUMBERS, 0, 1, 0};
        if (!gltf_take_map(gltf, KEY_OF(here, "maps"), maps, lam_map_name((lam_map)slot), request))
            return false;
    }
    return true;
}

// Finds the index of the requested variant; −1 if the caller requests no variant. Returns false if the file does not
// contain this variant.
static bool find_variant(struct gltf *gltf)
{
    const char *wanted = gltf->source->params->variant;
    gltf->variant = -1;
    if (!wanted)
        return true;
    const struct place *place = KEY_OF(KEY_OF(NULL, "extensions"), "KHR_materials_variants");
    const json_t *list = gltf_take_list(gltf, place, gltf_extension(gltf->root, "KHR_materials_variants"), "variants");
    gltf->variant = gltf_find_named(gltf, list, wanted, "variant");
    return gltf->variant >= 0;
}

bool gltf_materials_read(struct gltf *gltf)
{
    size_t count = gltf_list_size(gltf, "materials");
    gltf->first_material = gltf->scene->materials.count;
    gltf->default_material = -1;
    for (size_t i = 0; i < count; i++) {
        const struct place *place = ELEMENT_OF(KEY_OF(NULL, "materials"), i);
        const json_t *object = gltf_list_item(gltf, "materials", (int)i);
        struct factors factors = default_factors;
        take_factors(gltf, place, object, &factors);
        bool ok = take_maps(gltf, place, object, (int)i, (float)factors.glossiness);
        lam_material material = material_of(&factors, ok ? gltf_name(gltf, object, &ok) : NULL);
        ok = ok && gltf_take_layers(gltf, place, object, (int)i, &material) &&
             take_own_material(gltf, place, object, (int)i, &material);
        if (!ok || scene_adopt_material(gltf->scene, &material, gltf->json.error) < 0)
            return false;
    }
    return find_variant(gltf);
}

// Returns the material of a primitive in the requested variant, or −1 if the variant assigns no material to this
// primitive.
static int take_variant(struct gltf *gltf, const struct place *place, const json_t *primitive)
{
    const struct place *extension = KEY_OF(KEY_OF(place, "extensions"), "KHR_materials_variants");
    const json_t *mappings =
        gltf_take_list(gltf, extension, gltf_extension(primitive, "KHR_materials_variants"), "mappings");
    int index = -1;
    for (size_t i = 0; index < 0 && i < json_array_size(mappings); i++) {
        const json_t *mapping = json_array_get(mappings, i), *variants = json_object_get(mapping, "variants");
        const struct place *place_of_mapping = ELEMENT_OF(KEY_OF(extension, "mappings"), i);
        for (size_t k = 0; index < 0 && k < json_array_size(variants); k++) {
            double number =
                json_is_number(json_array_get(variants, k)) ? json_number_value(json_array_get(variants, k)) : -1;
            if (number == gltf->variant)
                index = gltf_take_link(gltf, place_of_mapping, mapping, "material", "materials");
            else if (!(number >= 0 && number < gltf->scene->file.variant_count))
                gltf_note(gltf, ELEMENT_OF(KEY_OF(place_of_mapping, "variants"), k),
                          "names none of the file's %d variants", gltf->scene->file.variant_count);
        }
    }
    return index;
}

// Returns the material for primitives without a material, which has the defaults of the specification.
static int default_material(struct gltf *gltf)
{
    if (gltf->default_material < 0) {
        lam_material material = material_of(&default_factors, NULL);
        gltf->default_material = scene_adopt_material(gltf->scene, &material, gltf->json.error);
    }
    return gltf->default_material;
}

bool gltf_take_material(struct gltf *gltf, const struct place *place, const json_t *primitive, int32_t *material)
{
    int index = gltf->variant >= 0 ? take_variant(gltf, place, primitive) : -1;
    index = index >= 0 ? index : gltf_take_link(gltf, place, primitive, "material", "materials");
    *material = index >= 0 ? gltf->first_material + index : default_material(gltf);
    return *material >= 0;
}

bool gltf_material_is_opaque(const struct gltf *gltf, int32_t material)
{
    return ((const lam_material *)gltf->scene->materials.items + material)->alpha_mode == LAM_ALPHA_OPAQUE;
}

bool gltf_material_is_double_sided(struct gltf *gltf, int32_t material)
{
    const lam_material *m = (const lam_material *)gltf->scene->materials.items + material;
    int index = material - gltf->first_material;
    if (m->transmission > 0 && m->thickness > 0) // the surface is the boundary of a volume (KHR_materials_volume)
        return false;
    return material != gltf->default_material &&
           gltf_take_flag(gltf, ELEMENT_OF(KEY_OF(NULL, "materials"), (size_t)index),
                          gltf_list_item(gltf, "materials", index), "doubleSided", false);
}
