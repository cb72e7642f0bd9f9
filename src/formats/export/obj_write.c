// obj_write.c: writes triangles, lines and points as OBJ; mtl_write.c writes the materials.
#include "export.h"

#include "fail.h"
#include "mtl_write.h"

#include <string.h>

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
