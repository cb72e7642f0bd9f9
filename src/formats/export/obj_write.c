// obj_write.c: writes triangles, lines and points as OBJ, and their materials as MTL.
#include "export.h"
#include "fail.h"

#include <lambent/material.h>

#include <stdio.h>
#include <string.h>

struct mtl_names {
    const char *file; // the name of the MTL file, or NULL
    // the names of the scene's materials, then of the default material; NULL for unused materials
    const char *const *names;
    int count;
    // the scene's texture coordinates follow glTF, in which t points down, so t is written as 1 − t
    bool flips;
};

// Returns the name of a material. Returns NULL if there is no MTL file.
static inline const char *mtl_name(const struct mtl_names *names, int material)
{
    return names->file ? names->names[material >= 0 && material < names->count ? material : names->count] : NULL;
}

// --- writes materials as an MTL file, and the pictures of their maps as PNG files beside it.

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
    if (m->alpha_mode == LAM_ALPHA_MASK &&
        (m->diffuse.a < 1 || m->alpha_cutoff > 1 || m->maps[LAM_MAP_OPACITY] || color))
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

// Writes the materials that e->flat uses to a file beside the model, with their pictures.
static bool mtl_write(struct exporting *e, struct mtl_names *out)
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

// The indices of the next vertex, texture coordinate and normal, starting at 1. Triangles, lines and points share one
// numbering.
struct firsts {
    unsigned long position, texcoord, normal;
};

static void put_vector(struct text *text, const char *word, lam_vec3 p)
{
    export_line(text, word, (double[3]){p.x, p.y, p.z}, 3);
}

// OBJ stores a colour with each position, so a vertex whose corners have different colours is written several times.
// *out has no vertices if the mesh has no colours.
static bool split_colors(struct exporting *e, const lam_mesh *m, struct export_vertices *out)
{
    lam_mesh colored = *m;
    bool opaque = true;
    *out = (struct export_vertices){0};
    if (!m->colors)
        return true;
    colored.normals = colored.texcoords = colored.second_texcoords = colored.tangents = NULL;
    if (!export_share_vertices(e, &colored, out))
        return false;
    for (uint32_t i = 0; i < out->count; i++)
        opaque &= ((const float *)m->colors)[4 * (size_t)export_color_element(m, out->corners[i]) + 3] >= 1;
    if (!opaque)
        export_lose(e, "the opacity of vertices is omitted: OBJ does not support it");
    return true;
}

static void put_arrays(struct exporting *e, const lam_mesh *m, const struct export_vertices *colored, bool flips)
{
    struct text *text = &e->text;
    for (uint32_t i = 0; !m->colors && i < m->vertex_count && !text->failed; i++)
        put_vector(text, "v", export_position(e, m, i));
    for (uint32_t i = 0; i < colored->count && !text->failed; i++) {
        uint32_t c = colored->corners[i];
        lam_vec3 p = export_position(e, m, mesh_element(NULL, m, c));
        const float *color = (const float *)m->colors + 4 * (size_t)export_color_element(m, c);
        double numbers[6] = {
            p.x, p.y, p.z, export_encoded(color[0]), export_encoded(color[1]), export_encoded(color[2])};
        export_line(text, "v", numbers, 6);
    }
    for (uint32_t i = 0; m->texcoords && i < m->texcoord_count && !text->failed; i++) {
        double s = (double)m->texcoords[2 * (size_t)i], t = (double)m->texcoords[2 * (size_t)i + 1];
        export_line(text, "vt", (double[2]){s, flips ? 1 - t : t}, 2);
    }
    for (uint32_t i = 0; m->normals && i < m->normal_count && !text->failed; i++)
        put_vector(text, "vn", export_normal(e, m, i));
}

static void put_corner(struct text *text, const lam_mesh *m, size_t c, unsigned long vertex, struct firsts first)
{
    text_print(text, " %lu", vertex);
    if (m->texcoords)
        text_print(text, "/%lu", mesh_element(m->texcoord_indices, m, c) + first.texcoord);
    if (m->normals)
        text_print(text, m->texcoords ? "/%lu" : "//%lu", mesh_element(m->normal_indices, m, c) + first.normal);
}

static void put_items(struct exporting *e, const lam_mesh *m, const uint32_t *numbers, const lam_part *part, int size,
                      struct firsts first)
{
    static const char *const words[] = {"p", "l", "f"};
    size_t begin = (size_t)part->first_triangle * (size_t)size,
           end = begin + (size_t)part->triangle_count * (size_t)size;
    for (size_t c = begin; c < end && !e->text.failed; c++) {
        unsigned long vertex = (numbers ? numbers[c] : mesh_element(NULL, m, c)) + first.position;
        if (c % (size_t)size == 0)
            text_add(&e->text, words[size - 1]);
        if (size == 3)
            put_corner(&e->text, m, c, vertex, first);
        else
            text_print(&e->text, " %lu", vertex);
        if (c % (size_t)size == (size_t)size - 1)
            text_add(&e->text, "\n");
    }
}

// Writes a line: `word`, a space and the name.
static void put_name(struct text *text, const char *word, const char *name)
{
    char clean[200];
    size_t length = 0;
    for (; *name && length + 1 < sizeof clean; name++)
        clean[length++] = (unsigned char)*name < 32 ? ' ' : *name;
    clean[length] = 0;
    text_print(text, "%s %s\n", word, clean);
}

// Returns the length of the object's name in "object/group", or 0 if there is no group.
static size_t object_length(const char *name)
{
    const char *slash = name ? strchr(name, '/') : NULL;
    return slash && slash[1] ? (size_t)(slash - name) : 0;
}

// Writes the name of a part. `before` is the name of the previous part, or NULL. From the statements `o` and `g`, a
// reader can restore the name "object/group".
static void put_part_name(struct text *text, const char *name, const char *before)
{
    size_t length = object_length(name);
    char object[200];
    if (length == 0 || length >= sizeof object) {
        put_name(text, "o", name);
        return;
    }
    memcpy(object, name, length);
    object[length] = 0;
    if (object_length(before) != length || memcmp(before, name, length) != 0)
        put_name(text, "o", object);
    put_name(text, "g", name + length + 1);
}

static bool put_kind(struct exporting *e, const struct mtl_names *materials, const lam_mesh *m, int size,
                     struct firsts *first)
{
    lam_part whole = {.triangle_count = mesh_items(m)};
    struct export_vertices colored;
    const char *name = NULL, *material = NULL;
    if (!split_colors(e, m, &colored))
        return false;
    if (size < 3 && (m->normals || m->texcoords))
        export_lose(e, "normals and texture coordinates of lines and points are omitted: OBJ does not support them");
    if (m->name)
        put_name(&e->text, "o", m->name);
    put_arrays(e, m, &colored, materials->flips);
    for (uint32_t i = 0; i < (m->parts ? m->part_count : 1); i++) {
        const lam_part *part = m->parts ? &m->parts[i] : &whole;
        const char *own = m->parts ? mtl_name(materials, part->material) : NULL;
        if (part->name && part->name != name)
            put_part_name(&e->text, part->name, name);
        if (own && own != material)
            put_name(&e->text, "usemtl", own);
        name = part->name;
        material = own;
        put_items(e, m, colored.numbers, part, size, *first);
    }
    first->position += m->colors ? colored.count : m->vertex_count;
    first->texcoord += m->texcoords ? m->texcoord_count : 0;
    first->normal += m->normals ? m->normal_count : 0;
    return true;
}

static bool write(struct exporting *e)
{
    static const int sizes[EXPORT_KINDS] = {3, 2, 1};
    struct mtl_names materials = {0};
    struct firsts first = {1, 1, 1};
    size_t items = 0;
    for (int i = 0; i < EXPORT_KINDS; i++)
        items += mesh_items(&e->flat[i]);
    if (!items)
        return fail(e->error, LAM_BAD_ARGUMENT, "%s: found no triangles, lines or points", e->name);
    if (e->scene && !mtl_write(e, &materials))
        return false;
    if (materials.file)
        put_name(&e->text, "mtllib", materials.file);
    for (int i = 0; i < EXPORT_KINDS; i++)
        if (mesh_items(&e->flat[i]) && !put_kind(e, &materials, &e->flat[i], sizes[i], &first))
            return false;
    export_lose_surroundings(e, false);
    return true;
}

const struct exporter exporter_obj = {"obj", LAM_UP_Y, true, write};
