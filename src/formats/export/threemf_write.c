// threemf_write.c: writes triangles as 3MF: one object, with a base material for each used material. zlib packs
// them.
#include "export.h"

#include "fail.h"

#include "texture_levels.h"

#include <lambent/material.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

// --- the model

static void add_xml(struct text *text, const char *name)
{
    for (; *name; name++) {
        const char *escape = *name == '&' ? "&amp;" : *name == '<' ? "&lt;" : *name == '"' ? "&quot;" : NULL;
        if (escape)
            text_add(text, escape);
        else if (strncmp(name, "\uFFFE", 3) == 0 || strncmp(name, "\uFFFF", 3) == 0)
            name += 2; // no characters of XML
        else if ((unsigned char)*name >= 32)
            text_add_part(text, name, 1);
    }
}

static const char *unit_of(const struct exporting *e)
{
    static const struct {
        const char *name;
        double meters;
    } units[] = {{"micron", 1e-6}, {"centimeter", 1e-2}, {"inch", 0.0254}, {"foot", 0.3048}, {"meter", 1}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (e->scene->file.unit_m == units[i].meters)
            return units[i].name;
    return "millimeter";
}

// Sets `color` to the diffuse colour times the mean colour of the diffuse texture. The last level of the texture
// stores the mean colour.
static void mean_color(const lam_material *material, float color[4])
{
    const lam_texture_map *map = material->maps[LAM_MAP_DIFFUSE];
    texel mean = {1, 1, 1, 1};
    if (map)
        mean = texel_at(map->texture, map->texture->level_count - 1, 0, 0);
    color[0] = material->diffuse.r * mean[0];
    color[1] = material->diffuse.g * mean[1];
    color[2] = material->diffuse.b * mean[2];
    color[3] = material->diffuse.a;
}

// Adds the materials of the parts in the order of their first use; `numbers` receives the index of each material.
static void add_materials(struct exporting *e, struct text *text, const lam_mesh *m, int *numbers)
{
    int count = 0, materials = e->scene->materials.count;
    for (int i = 0; i <= materials; i++)
        numbers[i] = -1;
    for (uint32_t i = 0; i < m->part_count; i++) {
        int index = m->parts[i].material;
        if (index < 0 || index >= materials || numbers[index] >= 0 ||
            (m->colors && export_is_white(export_material(e, index))))
            continue;
        if (!count)
            text_add(text, "<basematerials id=\"1\">\n");
        numbers[index] = count++;
        const lam_material *material = export_material(e, index);
        float color[4];
        mean_color(material, color);
        lam_mesh one = {.colors = color, .color_count = 1, .colors_format = LAM_COLORS_LINEAR_F32};
        uint8_t bytes[4];
        export_color_bytes(&one, 0, bytes);
        text_add(text, "<base name=\"");
        add_xml(text, material->name ? material->name : "material");
        text_print(text, "\" displaycolor=\"#%02X%02X%02X%02X\"/>\n", bytes[0], bytes[1], bytes[2], bytes[3]);
        for (int k = 0; k < LAM_MAP_COUNT; k++)
            if (material->maps[k])
                export_lose(e, "textures become their mean colour: lambent writes only colours to 3MF");
        export_lose(e, "only the diffuse colour of materials is kept: base materials of 3MF support nothing else");
    }
    if (count)
        text_add(text, "</basematerials>\n");
}

// Adds the colours of corners, for triangles without a material.
static void add_colors(struct text *text, const lam_mesh *m)
{
    text_add(text, "<m:colorgroup id=\"3\">\n");
    for (size_t i = 0; i < m->color_count && !text->failed; i++) {
        uint8_t bytes[4];
        export_color_bytes(m, i, bytes);
        text_print(text, "<m:color color=\"#%02X%02X%02X%02X\"/>\n", bytes[0], bytes[1], bytes[2], bytes[3]);
    }
    text_add(text, "</m:colorgroup>\n");
}

// Adds the property attributes of a triangle, whose base material is `number` (or −1).
static void add_properties(struct exporting *e, struct text *text, const lam_mesh *m, size_t triangle, int number)
{
    static const float white[3] = {1, 1, 1};
    if (number >= 0)
        text_print(text, " pid=\"1\" p1=\"%d\"", number);
    else if (m->colors)
        text_add(text, " pid=\"3\"");
    for (size_t k = 0; m->colors && k < 3; k++) {
        uint32_t element = export_color_element(m, 3 * triangle + k);
        if (number < 0)
            text_print(text, " p%u=\"%lu\"", (unsigned)k + 1, element + 0UL);
        else if (memcmp((const float *)m->colors + 4 * (size_t)element, white, sizeof white) != 0)
            export_lose(e, "colours of vertices with a material are omitted: lambent does not multiply them in 3MF");
    }
}

static void add_mesh(struct exporting *e, struct text *text, const lam_mesh *m, const int *numbers)
{
    static const char *const axes[] = {"<vertex x=\"", "\" y=\"", "\" z=\""};
    text_add(text, "<object id=\"2\" type=\"model\"><mesh><vertices>\n");
    for (uint32_t i = 0; i < m->vertex_count && !text->failed; i++) {
        lam_vec3 p = export_position(e, m, i);
        const double numbers_of[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; k++) {
            text_add(text, axes[k]);
            export_number(text, numbers_of[k]);
        }
        text_add(text, "\"/>\n");
    }
    text_add(text, "</vertices><triangles>\n");
    for (uint32_t i = 0; i < m->part_count; i++) {
        const lam_part *part = &m->parts[i];
        int number = part->material >= 0 && part->material < e->scene->materials.count ? numbers[part->material] : -1;
        for (size_t t = part->first_triangle; t < (size_t)part->first_triangle + part->triangle_count && !text->failed;
             t++) {
            text_print(text, "<triangle v1=\"%lu\" v2=\"%lu\" v3=\"%lu\"", mesh_element(NULL, m, 3 * t) + 0UL,
                       mesh_element(NULL, m, 3 * t + 1) + 0UL, mesh_element(NULL, m, 3 * t + 2) + 0UL);
            add_properties(e, text, m, t, number);
            text_add(text, "/>\n");
        }
    }
    text_add(text, "</triangles></mesh></object>\n");
}

static bool make_model(struct exporting *e, struct text *text)
{
    const lam_mesh *m = &e->flat[EXPORT_TRIANGLES];
    int *numbers = arena_array(e->arena, (size_t)e->scene->materials.count + 1, sizeof *numbers);
    if (!numbers)
        return export_no_memory(e, (size_t)e->scene->materials.count * sizeof *numbers);
    text_print(text,
               "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"%s\" "
               "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
               "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\">\n"
               "<metadata name=\"Application\">lambent %s</metadata>\n<resources>\n",
               unit_of(e), lam_version());
    add_materials(e, text, m, numbers);
    if (m->colors)
        add_colors(text, m);
    add_mesh(e, text, m, numbers);
    text_add(text, "</resources>\n<build><item objectid=\"2\"/></build>\n</model>\n");
    return export_text_is_whole(e, text);
}

// --- the archive

static const char types[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types "
    "xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
static const char relations[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships "
    "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

// --- the ZIP archive

// A part of the archive. It is stored in the order of `at`; the list at the end repeats its header.
struct entry {
    const char *name;
    size_t at, packed, size;
    uint32_t crc;
};

static void put(struct text *text, uint64_t value, size_t bytes)
{
    char little[8];
    for (size_t i = 0; i < bytes; i++)
        little[i] = (char)(value >> 8 * i);
    text_add_part(text, little, bytes);
}

// The fields that a part's header and its row in the list at the end share.
static void put_header(struct text *text, const struct entry *e)
{
    enum { VERSION = 20, DEFLATED = 8, UTF_8 = 1 << 11 };
    enum { FIRST_DAY = 0x21 }; // 1 January 1980; with a fixed date, the same model always yields the same file
    put(text, VERSION, 2);
    put(text, UTF_8, 2);
    put(text, DEFLATED, 2);
    put(text, 0, 2); // the time of day
    put(text, FIRST_DAY, 2);
    put(text, e->crc, 4);
    put(text, e->packed, 4);
    put(text, e->size, 4);
    put(text, strlen(e->name), 2);
    put(text, 0, 2); // no extra data
}

// Appends the compressed bytes.
static bool deflate_to(struct exporting *e, struct text *text, const void *bytes, size_t size)
{
    enum { STEP = 1 << 16 };
    uint8_t out[STEP / 4];
    z_stream z = {0};
    if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK)
        return fail(e->error, LAM_MACHINE, "%s: zlib cannot pack the model: out of memory", e->name);
    int state = Z_OK;
    bool goes_on = true;
    for (size_t at = 0; state != Z_STREAM_END && goes_on; goes_on = export_asks(e)) {
        size_t some = size - at < STEP ? size - at : STEP;
        z.next_in = (Bytef *)(uintptr_t)((const char *)bytes + at);
        z.avail_in = (uInt)some;
        at += some;
        do {
            z.next_out = out;
            z.avail_out = sizeof out;
            state = deflate(&z, at == size ? Z_FINISH : Z_NO_FLUSH);
            text_add_part(text, (char *)out, sizeof out - z.avail_out);
        } while (!z.avail_out);
    }
    deflateEnd(&z);
    return goes_on || export_is_whole(e);
}

static bool add_entry(struct exporting *e, struct entry *entry, const char *name, const void *bytes, size_t size)
{
    struct text packed = {.call = e->call};
    bool ok = deflate_to(e, &packed, bytes, size) && export_text_is_whole(e, &packed);
    *entry = (struct entry){name, e->text.length, packed.length, size, (uint32_t)crc32_z(0, bytes, size)};
    text_add_part(&e->text, "PK\3\4", 4);
    put_header(&e->text, entry);
    text_add(&e->text, name);
    text_add_part(&e->text, packed.bytes, packed.length);
    free(packed.bytes);
    return ok;
}

static bool pack(struct exporting *e, const struct text *model)
{
    enum { PARTS = 3 };
    struct entry entries[PARTS];
    if (model->length > UINT32_MAX)
        return fail(e->error, LAM_LIMIT, "%s: the model has %zu bytes of XML, and lambent writes at most 4 GB to 3MF",
                    e->name, model->length);
    if (!add_entry(e, &entries[0], "[Content_Types].xml", types, sizeof types - 1) ||
        !add_entry(e, &entries[1], "_rels/.rels", relations, sizeof relations - 1) ||
        !add_entry(e, &entries[2], "3D/3dmodel.model", model->bytes, model->length))
        return false;
    const size_t list = e->text.length;
    for (int i = 0; i < PARTS; i++) {
        text_add_part(&e->text, "PK\1\2\24\0", 6);
        put_header(&e->text, &entries[i]);
        put(&e->text, 0, 8); // no comment, the first disk, binary
        put(&e->text, 0, 2);
        put(&e->text, entries[i].at, 4);
        text_add(&e->text, entries[i].name);
    }
    const size_t end = e->text.length;
    text_add_part(&e->text, "PK\5\6\0\0\0\0", 8);
    put(&e->text, PARTS, 2);
    put(&e->text, PARTS, 2);
    put(&e->text, end - list, 4);
    put(&e->text, list, 4);
    put(&e->text, 0, 2);
    return export_text_is_whole(e, &e->text);
}

static void lose(struct exporting *e)
{
    const lam_mesh *m = &e->flat[EXPORT_TRIANGLES];
    if (m->normals && !export_has_usual_normals(e))
        export_lose(e, "normals are omitted: 3MF does not support them, and most readers compute smooth normals");
    export_lose_objects(e, "lambent writes one object to 3MF");
    export_lose_digits(e, m);
    if (m->texcoords)
        export_lose(e, "texture coordinates are omitted: lambent writes only colours to 3MF");
    if (e->flat[EXPORT_LINES].line_count || e->flat[EXPORT_POINTS].point_count)
        export_lose(e, "lines and points are omitted: 3MF does not support them");
    export_lose_surroundings(e, false);
}

static bool write_3mf(struct exporting *e)
{
    struct text model = {.call = e->call};
    if (!e->flat[EXPORT_TRIANGLES].triangle_count)
        return fail(e->error, LAM_BAD_ARGUMENT, "%s: found no triangles, and 3MF supports nothing else", e->name);
    bool ok = make_model(e, &model) && pack(e, &model);
    free(model.bytes);
    if (ok)
        lose(e);
    return ok;
}

const struct exporter exporter_3mf = {"3mf", LAM_UP_Z, true, write_3mf};
