// mtl_write.c: writes materials as an MTL file, and the pictures of their maps as PNG files beside it.
#include "mtl_write.h"

#include "fail.h"

#include <lambent/material.h>

#include <stdio.h>
#include <string.h>

static void put_color(struct text *text, const char *word, lam_rgb color)
{
    export_line(text, word, (double[3]){export_encoded(color.r), export_encoded(color.g), export_encoded(color.b)}, 3);
}

// --- maps

static const struct {
    lam_map slot;
    const char *word;
    bool one_channel;
} maps[] = {
    {LAM_MAP_AMBIENT, "map_Ka", false},  {LAM_MAP_DIFFUSE, "map_Kd", false},  {LAM_MAP_SPECULAR, "map_Ks", false},
    {LAM_MAP_EMISSION, "map_Ke", false}, {LAM_MAP_SHININESS, "map_Ns", true}, {LAM_MAP_OPACITY, "map_d", true},
    {LAM_MAP_BUMP, "map_bump", true},    {LAM_MAP_NORMAL, "norm", false},     {LAM_MAP_METALLIC, "map_Pm", true},
    {LAM_MAP_ROUGHNESS, "map_Pr", true},
};
enum { MAPS = sizeof maps / sizeof *maps };

// The pictures written so far.
struct pictures {
    const lam_texture *textures[4096];
    const char *names[4096];
    int count;
};

static const char *picture_name(struct exporting *e, struct pictures *pictures, const lam_texture *texture, bool *ok)
{
    char ending[32];
    lam_bytes png;
    for (int i = 0; i < pictures->count; i++)
        if (pictures->textures[i] == texture)
            return pictures->names[i];
    if (pictures->count == (int)(sizeof pictures->names / sizeof *pictures->names)) {
        export_lose(e, "pictures beyond the first %d are omitted", pictures->count);
        return NULL;
    }
    if (!export_texture(e, texture, &png)) {
        *ok = !texture->bytes;
        return NULL;
    }
    snprintf(ending, sizeof ending, "-%d.png", pictures->count);
    const char *name = export_add_file(e, ending, true, png);
    *ok = name != NULL;
    pictures->textures[pictures->count] = texture;
    pictures->names[pictures->count] = name;
    pictures->count += name != NULL;
    return name;
}

static bool is_plain(const lam_texture_map *map)
{
    for (int i = 0; i < 6; i++)
        if (map->transform[i / 3][i % 3] != 0)
            return false;
    return true;
}

static void put_options(struct exporting *e, struct text *text, const lam_texture_map *map, int row, bool flips)
{
    static const char letters[] = "rgbm";
    float m[2][3] = {{1, 0, 0}, {0, 1, 0}};
    if (!is_plain(map))
        memcpy(m, map->transform, sizeof m);
    double sign = flips ? -1 : 1, scale[2] = {(double)m[0][0], -sign * (double)m[1][1]},
           offset[2] = {(double)m[0][2], 1 - ((double)m[1][2] + (flips ? (double)m[1][1] : 0))};
    if (m[0][1] != 0 || m[1][0] != 0)
        export_lose(e, "rotated texture coordinates of maps are omitted: MTL does not support them");
    if (map->texcoords)
        export_lose(
            e, "maps that use the second set of texture coordinates use the first set instead: OBJ supports only one");
    if (scale[0] != 1 || scale[1] != 1)
        export_list(text, " -s", scale, 2);
    if (offset[0] != 0 || offset[1] != 0)
        export_list(text, " -o", offset, 2);
    if (map->wrap_s == LAM_WRAP_CLAMP && map->wrap_t == LAM_WRAP_CLAMP)
        text_add(text, " -clamp on");
    else if (map->wrap_s || map->wrap_t)
        export_lose(e, "wrapping modes of textures are omitted, except -clamp: MTL supports no others");
    if (map->magnify || map->minify || map->mip)
        export_lose(e, "filters of pictures are omitted: MTL does not support them");
    if (maps[row].one_channel)
        text_print(text, " -imfchan %c", letters[map->channel & 3]);
    if (maps[row].slot == LAM_MAP_BUMP)
        export_list(text, " -bm", (double[1]){map->scale == 0 ? 1 : (double)map->scale}, 1);
    else if (maps[row].slot == LAM_MAP_NORMAL && map->scale != 0 && map->scale != 1)
        export_lose(e, "scales of normal maps are omitted: MTL does not support them");
    else if ((map->scale != 0 && map->scale != 1) || map->offset != 0)
        export_list(text, " -mm", (double[2]){(double)map->offset, map->scale == 0 ? 1 : (double)map->scale}, 2);
}

static bool put_maps(struct exporting *e, struct text *text, const lam_material *m, struct pictures *pictures,
                     bool flips)
{
    bool ok = true, written[LAM_MAP_COUNT] = {false};
    for (int i = 0; ok && i < MAPS; i++) {
        const lam_texture_map *map = m->maps[maps[i].slot];
        const char *name = map ? picture_name(e, pictures, map->texture, &ok) : NULL;
        written[maps[i].slot] = true;
        if (!name)
            continue;
        text_add(text, maps[i].word);
        put_options(e, text, map, i, flips);
        text_add(text, " ");
        text_add(text, name);
        text_add(text, "\n");
    }
    for (int i = 0; i < LAM_MAP_COUNT; i++)
        if (m->maps[i] && !written[i])
            export_lose(e, "%s maps are omitted: MTL does not support them", lam_map_name((lam_map)i));
    return ok;
}

// --- materials

static void lose(struct exporting *e, const lam_material *m)
{
    lam_material d = lam_material_default();
    const lam_rgb kr = m->reflectivity;
    if (m->physical && (m->ior != d.ior || m->specular_weight != 1 || m->clearcoat > 0 || m->anisotropy > 0 ||
                        m->iridescence > 0 || m->transmission > 0 || m->thickness > 0 || m->specular_glossiness > 0 ||
                        m->sheen_color.r > 0 || m->sheen_color.g > 0 || m->sheen_color.b > 0))
        export_lose(e,
                    "layers of physical materials are omitted (coats, sheen, films, glass): MTL does not support them");
    const lam_texture_map *color = m->maps[LAM_MAP_DIFFUSE];
    if (m->alpha_mode == LAM_ALPHA_OPAQUE && color && !color->texture->opaque)
        export_lose(e, "the alpha channels of opaque materials' textures become opacity: MTL cannot ignore alpha");
    if (m->alpha_mode == LAM_ALPHA_MASK && (m->diffuse.a < 1 || m->maps[LAM_MAP_OPACITY] || color))
        export_lose(e, "masked materials become blended materials: MTL has no threshold");
    if (kr.r > 0 || kr.g > 0 || kr.b > 0 || m->roughness_angle_rad != d.roughness_angle_rad || m->fibre)
        export_lose(e, "the materials' reflectivity, Oren-Nayar roughness and fibre settings are omitted: MTL does not "
                       "support them");
    if (m->unlit)
        export_lose(e, "unlit materials become emission (illum 0)");
}

static bool put_material(struct exporting *e, struct text *text, const lam_material *m, const char *name,
                         struct pictures *pictures, bool flips)
{
    lam_rgb kd = {m->diffuse.r, m->diffuse.g, m->diffuse.b};
    bool shines = m->specular.r > 0 || m->specular.g > 0 || m->specular.b > 0;
    text_print(text, "newmtl %.150s\n", name);
    put_color(text, "Kd", kd);
    if (memcmp(&m->ambient, &kd, sizeof kd) != 0)
        put_color(text, "Ka", m->ambient);
    if (m->physical) {
        export_line(text, "Pm", (double[1]){(double)m->metallic}, 1);
        export_line(text, "Pr", (double[1]){(double)m->roughness}, 1);
    } else if (shines) {
        put_color(text, "Ks", m->specular);
    }
    if (!m->physical)
        export_line(text, "Ns", (double[1]){(double)m->shininess}, 1);
    if (m->emission.r > 0 || m->emission.g > 0 || m->emission.b > 0)
        put_color(text, "Ke", m->emission);
    if (m->diffuse.a < 1)
        export_line(text, "d", (double[1]){(double)m->diffuse.a}, 1);
    text_add(text, m->unlit ? "illum 0\n" : m->physical || shines ? "illum 2\n" : "illum 1\n");
    lose(e, m);
    return put_maps(e, text, m, pictures, flips);
}

// Makes a unique name for a material.
static const char *name_of(struct exporting *e, const char *const *names, int index)
{
    const lam_material *m = export_material(e, index);
    char name[160], clean[120];
    size_t length = 0;
    for (const char *c = m->name ? m->name : ""; *c && length + 1 < sizeof clean; c++)
        clean[length++] = (unsigned char)*c <= 32 ? '_' : *c;
    clean[length] = 0;
    snprintf(name, sizeof name, "%s", clean);
    if (!length)
        snprintf(name, sizeof name, "material-%d", index);
    for (int i = 0; i < index; i++)
        if (names[i] && strcmp(names[i], name) == 0)
            snprintf(name, sizeof name, "%s-%d", clean, index);
    return arena_string(e->arena, name);
}

// Finds the materials that the parts use, and whether the texture coordinates must be flipped in t. Returns the number
// of these materials.
static int find_used(struct exporting *e, bool *used, bool *flips)
{
    int count = 0, materials = e->scene->materials.count;
    bool grey = false; // whether lines or points have no material, or the default material of glTF
    for (int k = 0; k < EXPORT_KINDS; k++)
        for (uint32_t i = 0; i < e->flat[k].part_count && mesh_items(&e->flat[k]); i++) {
            int material = e->flat[k].parts[i].material;
            material = material >= 0 && material < materials ? material : materials;
            count += !used[material];
            used[material] = true;
            const lam_material *m = export_material(e, material);
            grey |= k != EXPORT_TRIANGLES && !e->flat[k].colors &&
                    (material == materials || (!m->name && m->physical && m->metallic == 1 && m->roughness == 1));
        }
    if (grey && count > used[materials])
        export_lose(e, "lines and points without a material are no longer grey: MTL cannot remove a material");
    for (int i = 0; i <= materials; i++)
        for (int k = 0; used[i] && k < LAM_MAP_COUNT; k++) {
            const lam_texture_map *map = export_material(e, i)->maps[k];
            *flips |= map && (is_plain(map) || map->transform[1][1] > 0);
        }
    return count;
}

bool mtl_write(struct exporting *e, struct mtl_names *out)
{
    int materials = e->scene->materials.count;
    bool *used = arena_alloc_zeroed(e->arena, (size_t)materials + 1);
    const char **names = arena_alloc_zeroed(e->arena, ((size_t)materials + 1) * sizeof *names);
    struct pictures *pictures = arena_alloc_zeroed(e->arena, sizeof *pictures);
    if (!used || !names || !pictures)
        return export_no_memory(e, sizeof *pictures);
    *out = (struct mtl_names){.names = names, .count = materials};
    int count = find_used(e, used, &out->flips);
    if (count == used[materials]) // only the default material is used
        return true;
    struct text text = {.call = e->call};
    bool ok = true;
    for (int i = 0; ok && i <= materials; i++)
        if (used[i])
            ok = export_is_whole(e) &&
                 ((names[i] = i < materials ? name_of(e, names, i) : "lambent-default") || export_no_memory(e, 160)) &&
                 put_material(e, &text, export_material(e, i), names[i], pictures, out->flips);
    ok = ok && export_text_is_whole(e, &text);
    lam_bytes bytes = {text.bytes, text.length};
    if (!ok) {
        lam_bytes_free(&bytes);
        return false;
    }
    return (out->file = export_add_file(e, ".mtl", true, bytes)) != NULL;
}
