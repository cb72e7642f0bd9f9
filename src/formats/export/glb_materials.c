// glb_materials.c: writes materials as metallic-roughness materials in glTF, with the extensions for material layers.
#include "glb.h"
#include "khr_layers.h"
#include "linear.h"
#include "texture_levels.h"

#include <string.h>

// --- writes material maps: images as PNG in the buffer, samplers, transforms.

// Pictures with equal bytes are written once. Such duplicates exist because the importer reads a picture twice if
// materials use it both as colours and as numbers.
static bool is_same(const lam_texture *a, const lam_texture *b)
{
    if (a == b)
        return true;
    const struct texture_level *x = &a->levels[0], *y = &b->levels[0];
    return a->bytes && b->bytes && x->width == y->width && x->height == y->height && a->channels == b->channels &&
           memcmp(a->bytes, b->bytes, (size_t)x->width * (size_t)x->height * (size_t)a->channels) == 0;
}

// Returns the index of a texture's image, or −1 if the image cannot be written.
static int image_of(struct glb *glb, const lam_texture *texture)
{
    for (int i = 0; i < glb->pictures.count; i++) {
        const struct glb_image *image = (const struct glb_image *)glb->pictures.items + i;
        if (is_same(image->texture, texture))
            return image->index;
    }
    struct glb_image image = {texture, -1};
    lam_bytes png;
    if (export_texture(glb->e, texture, &png)) {
        int view = glb_add_view(glb, png.data, png.size, 0);
        json_t *object = json_pack("{s:i, s:s}", "bufferView", view, "mimeType", "image/png");
        lam_bytes_free(&png);
        image.index = glb_add(glb, glb->images, object);
    } else if (texture->bytes) {
        glb->failed = true;
    }
    glb->failed |= !glb_append(glb, &glb->pictures, &image, sizeof image);
    return image.index;
}

static int wrap_code(lam_wrap wrap) { return wrap == LAM_WRAP_CLAMP ? 33071 : wrap == LAM_WRAP_MIRROR ? 33648 : 10497; }

// Returns the index of the sampler, or −1 for the default sampler, which repeats the texture and filters between mip
// levels.
static int sampler_of(struct glb *glb, const lam_texture_map *map)
{
    static const int minify[2][3] = {{9987, 9985, 9729}, {9986, 9984, 9728}}; // indexed by filter (linear, nearest) and
                                                                              // by lam_mip
    if (!map->wrap_s && !map->wrap_t && !map->magnify && !map->minify && !map->mip)
        return -1;
    json_t *object =
        json_pack("{s:i, s:i, s:i, s:i}", "magFilter", map->magnify ? 9728 : 9729, "minFilter",
                  minify[map->minify][map->mip], "wrapS", wrap_code(map->wrap_s), "wrapT", wrap_code(map->wrap_t));
    for (size_t i = 0; i < json_array_size(glb->samplers); i++)
        if (json_equal(json_array_get(glb->samplers, i), object)) {
            json_decref(object);
            return (int)i;
        }
    return glb_add(glb, glb->samplers, object);
}

static int texture_of(struct glb *glb, const lam_texture_map *map, int image)
{
    json_t *object = json_pack("{s:i}", "source", image);
    int sampler = sampler_of(glb, map);
    if (sampler >= 0)
        glb_set(glb, object, "sampler", json_integer(sampler));
    for (size_t i = 0; i < json_array_size(glb->textures); i++)
        if (json_equal(json_array_get(glb->textures, i), object)) {
            json_decref(object);
            return (int)i;
        }
    return glb_add(glb, glb->textures, object);
}

// Writes KHR_texture_transform: the matrix (c·sx, s·sy, x; −s·sx, c·sy, y) as offset, rotation and scale.
static void put_transform(struct glb *glb, json_t *info, const lam_texture_map *map)
{
    double m[2][3];
    bool zero = true, plain;
    for (int i = 0; i < 6; i++) {
        m[i / 3][i % 3] = (double)map->transform[i / 3][i % 3];
        zero &= m[i / 3][i % 3] == 0;
    }
    plain = zero || (m[0][0] == 1 && m[0][1] == 0 && m[0][2] == 0 && m[1][0] == 0 && m[1][1] == 1 && m[1][2] == 0);
    if (plain)
        return;
    bool turned = m[0][1] != 0 || m[1][0] != 0;
    double scale[2] = {m[0][0], m[1][1]}, angle = 0;
    if (turned) {
        angle = math_atan2(-m[1][0], m[0][0]);
        scale[0] = math_sqrt(m[0][0] * m[0][0] + m[1][0] * m[1][0]);
        scale[1] = math_sin(angle) * m[0][1] + math_cos(angle) * m[1][1];
        double skew = math_cos(angle) * m[0][1] - math_sin(angle) * m[1][1];
        if (skew > 1e-5 || skew < -1e-5)
            export_lose(glb->e,
                        "skewed texture coordinates of maps are omitted: glTF supports only scales and rotations");
    }
    json_t *object = glb_extension(glb, info, "KHR_texture_transform");
    glb_set(glb, object, "offset", json_pack("[ff]", m[0][2], m[1][2]));
    glb_set(glb, object, "scale", json_pack("[ff]", scale[0], scale[1]));
    if (turned)
        glb_set(glb, object, "rotation", json_real(angle));
}

// Returns the JSON object for a map's texture, with its texture coordinates and transform. Returns NULL if there is no
// map, or if the map's picture cannot be written.
static json_t *glb_texture(struct glb *glb, const lam_texture_map *map)
{
    int image = map ? image_of(glb, map->texture) : -1;
    if (image < 0)
        return NULL;
    json_t *info = json_pack("{s:i}", "index", texture_of(glb, map, image));
    if (map->texcoords)
        glb_set(glb, info, "texCoord", json_integer(map->texcoords));
    put_transform(glb, info, map);
    return info;
}

static float scale_of(const lam_texture_map *map) { return map->scale == 0 ? 1 : map->scale; }

// Returns the map if glTF can store it. For each kind of map, glTF prescribes the channel and allows no scale or
// offset. If glTF cannot store the map, records a loss and returns NULL.
static const lam_texture_map *usual(struct glb *glb, const lam_material *m, lam_map slot, int channel)
{
    const lam_texture_map *map = m->maps[slot];
    if (!map || (scale_of(map) == 1 && map->offset == 0 && (channel < 0 || map->channel == channel)))
        return map;
    export_lose(glb->e, "%s maps are omitted: they have another channel, scale or offset than in glTF",
                lam_map_name(slot));
    return NULL;
}

static void set_texture(struct glb *glb, json_t *object, const char *key, const lam_texture_map *map)
{
    json_t *info = glb_texture(glb, map);
    if (info)
        glb_set(glb, object, key, info);
}

static bool same_place(const lam_texture_map *a, const lam_texture_map *b)
{
    return a->texture == b->texture && a->texcoords == b->texcoords && a->wrap_s == b->wrap_s &&
           a->wrap_t == b->wrap_t && memcmp(a->transform, b->transform, sizeof a->transform) == 0;
}

// glTF stores roughness in the green channel and metalness in the blue channel of one texture.
static const lam_texture_map *metallic_roughness(struct glb *glb, const lam_material *m)
{
    const lam_texture_map *metallic = usual(glb, m, LAM_MAP_METALLIC, 2),
                          *roughness = usual(glb, m, LAM_MAP_ROUGHNESS, 1);
    if ((metallic && roughness && same_place(metallic, roughness)) || (roughness && !metallic && m->metallic == 0))
        return roughness;
    if (metallic || roughness)
        export_lose(glb->e, "separate metalness and roughness maps are omitted: glTF uses one texture for both");
    return NULL;
}

static void put_metallic(struct glb *glb, json_t *object, const lam_material *m)
{
    json_t *pbr = json_object();
    const float base[4] = {m->diffuse.r, m->diffuse.g, m->diffuse.b, m->diffuse.a};
    glb_set(glb, pbr, "baseColorFactor", glb_floats(glb, base, 4));
    glb_set(glb, pbr, "metallicFactor", json_real((double)m->metallic));
    glb_set(glb, pbr, "roughnessFactor", json_real((double)m->roughness));
    set_texture(glb, pbr, "baseColorTexture", usual(glb, m, LAM_MAP_DIFFUSE, -1));
    set_texture(glb, pbr, "metallicRoughnessTexture", metallic_roughness(glb, m));
    glb_set(glb, object, "pbrMetallicRoughness", pbr);
}

// KHR_materials_pbrSpecularGlossiness: the importer converted the specular colour to f0, and the glossiness to a
// roughness of 1 − glossiness.
static void put_glossy(struct glb *glb, json_t *object, const lam_material *m)
{
    json_t *glossy = glb_extension(glb, object, "KHR_materials_pbrSpecularGlossiness");
    const float base[4] = {m->diffuse.r, m->diffuse.g, m->diffuse.b, m->diffuse.a};
    const lam_texture_map *roughness = m->maps[LAM_MAP_ROUGHNESS];
    double glossiness = roughness ? -(double)roughness->scale : 1 - (double)m->roughness;
    glb_set(glb, glossy, "diffuseFactor", glb_floats(glb, base, 4));
    glb_set(glb, glossy, "specularFactor", glb_floats(glb, &m->f0_color.r, 3));
    glb_set(glb, glossy, "glossinessFactor", json_real(glossiness));
    set_texture(glb, glossy, "diffuseTexture", usual(glb, m, LAM_MAP_DIFFUSE, -1));
    set_texture(glb, glossy, "specularGlossinessTexture", usual(glb, m, LAM_MAP_F0_COLOR, -1));
}

static void put_layers(struct glb *glb, json_t *object, const lam_material *m)
{
    const lam_material standard = lam_material_default();
    for (int i = 0; i < KHR_NUMBERS; i++) {
        const struct khr_number *row = &khr_numbers[i];
        const float *own = (const float *)(const void *)((const char *)m + row->offset),
                    *usual_value = (const float *)(const void *)((const char *)&standard + row->offset);
        if (memcmp(own, usual_value, (size_t)row->count * sizeof *own) == 0)
            continue;
        glb_set(glb, glb_extension(glb, object, row->extension), row->key,
                row->count == 1 ? json_real((double)*own) : glb_floats(glb, own, row->count));
    }
    for (int i = 0; i < KHR_MAPS; i++) {
        const struct khr_map *row = &khr_maps[i];
        bool normal = row->slot == LAM_MAP_CLEARCOAT_NORMAL;
        const lam_texture_map *map =
            normal ? m->maps[row->slot]
                   : usual(glb, m, row->slot, row->values == LAM_TEXTURE_NUMBERS ? row->channel : -1);
        json_t *info = glb_texture(glb, map);
        if (!info)
            continue;
        if (normal && scale_of(map) != 1)
            glb_set(glb, info, "scale", json_real((double)map->scale));
        glb_set(glb, glb_extension(glb, object, row->extension), row->key, info);
    }
}

static void put_other_maps(struct glb *glb, json_t *object, const lam_material *m)
{
    const lam_texture_map *normal = m->maps[LAM_MAP_NORMAL], *occlusion = m->maps[LAM_MAP_OCCLUSION];
    json_t *info = glb_texture(glb, normal);
    if (info && scale_of(normal) != 1)
        glb_set(glb, info, "scale", json_real((double)normal->scale));
    if (info)
        glb_set(glb, object, "normalTexture", info);
    if (occlusion && occlusion->channel != 0) {
        export_lose(glb->e, "occlusion maps are omitted unless they use the red channel: glTF supports only red");
    } else if ((info = glb_texture(glb, occlusion))) {
        if (scale_of(occlusion) != 1)
            glb_set(glb, info, "strength", json_real((double)occlusion->scale));
        glb_set(glb, object, "occlusionTexture", info);
    }
    set_texture(glb, object, "emissiveTexture", usual(glb, m, LAM_MAP_EMISSION, -1));
    static const lam_map others[] = {LAM_MAP_AMBIENT, LAM_MAP_SPECULAR, LAM_MAP_SHININESS, LAM_MAP_OPACITY,
                                     LAM_MAP_BUMP};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (m->maps[others[i]])
            export_lose(glb->e, "%s maps are omitted: glTF does not support them", lam_map_name(others[i]));
}

// Writes an emission above 1 as a factor and a strength (KHR_materials_emissive_strength).
static void put_emission(struct glb *glb, json_t *object, const lam_material *m)
{
    const float *e = &m->emission.r;
    double strength = 1;
    json_t *list = json_array();
    for (int i = 0; i < 3; i++)
        strength = (double)e[i] > strength ? (double)e[i] : strength;
    for (int i = 0; i < 3; i++)
        glb_add(glb, list, json_real((double)e[i] / strength));
    if (e[0] > 0 || e[1] > 0 || e[2] > 0)
        glb_set(glb, object, "emissiveFactor", json_incref(list));
    json_decref(list);
    if (strength > 1)
        glb_set(glb, glb_extension(glb, object, "KHR_materials_emissive_strength"), "emissiveStrength",
                json_real(strength));
}

static bool is_opaque(const lam_material *m)
{
    const lam_texture_map *map = m->maps[LAM_MAP_DIFFUSE];
    return m->diffuse.a >= 1 && (!map || map->texture->opaque);
}

static void put_alpha(struct glb *glb, json_t *object, const lam_material *m, bool classic)
{
    // Any classic material may use alpha blending. glTF viewers sort blended surfaces by depth, so the file declares
    // blending only if a material needs it.
    bool blends = m->alpha_mode == LAM_ALPHA_BLEND && !(classic && is_opaque(m));
    if (blends || m->alpha_mode == LAM_ALPHA_MASK)
        glb_set(glb, object, "alphaMode", json_string(blends ? "BLEND" : "MASK"));
    if (m->alpha_mode == LAM_ALPHA_MASK)
        glb_set(glb, object, "alphaCutoff", json_real((double)m->alpha_cutoff));
}

static json_t *material(struct glb *glb, const lam_material *source, bool double_sided)
{
    json_t *object = json_object();
    lam_material m = lam_material_as_physical(source);
    if (!source->physical && !source->unlit && export_material_count(glb->e))
        export_lose(glb->e, "classic materials become metallic-roughness materials, which lambent shades and lights "
                            "differently: the whole model looks different");
    if (m.reflectivity.r > 0 || m.reflectivity.g > 0 || m.reflectivity.b > 0 || m.fibre ||
        m.roughness_angle_rad != lam_material_default().roughness_angle_rad)
        export_lose(glb->e, "the materials' reflectivity, Oren-Nayar roughness and fibre settings are omitted: glTF "
                            "does not support them");
    glb_set_name(glb, object, m.name);
    if (m.specular_glossiness > 0) {
        put_glossy(glb, object, &m);
    } else {
        put_metallic(glb, object, &m);
        put_layers(glb, object, &m);
    }
    put_other_maps(glb, object, &m);
    put_emission(glb, object, &m);
    put_alpha(glb, object, &m, !source->physical);
    if (m.unlit)
        glb_extension(glb, object, "KHR_materials_unlit");
    if (double_sided)
        glb_set(glb, object, "doubleSided", json_true());
    return object;
}

int glb_material(struct glb *glb, int index, bool double_sided)
{
    int count = glb->e->scene->materials.count,
        *number = &glb->material_index[double_sided][index >= 0 && index < count ? index : count];
    if (*number < 0)
        *number = glb_add(glb, glb->materials, material(glb, export_material(glb->e, index), double_sided));
    return *number;
}
