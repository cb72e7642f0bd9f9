// threemf_write.c: writes triangles as 3MF: one object, with a base material for each used material. libzip, loaded on
// demand, packs the archive.
#include "export.h"

#include "fail.h"

#ifdef HAVE_LIBZIP

#include "dynamic_library.h"
#include "texture_levels.h"

#include <lambent/material.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zip.h>

#define LIBRARY "libzip.so.4"

#define FUNCTIONS(each)                                                                                                \
    each(zip_source_buffer_create) each(zip_source_buffer) each(zip_source_free) each(zip_source_keep)                 \
        each(zip_source_open) each(zip_source_read) each(zip_source_close) each(zip_open_from_source)                  \
            each(zip_file_add) each(zip_file_set_dostime) each(zip_close) each(zip_discard) each(zip_error_init)       \
                each(zip_error_fini) each(zip_register_cancel_callback_with_state)

struct library {
    void *handle;
    FUNCTIONS(LIBRARY_MEMBER)
};

static bool open_library(struct exporting *e, struct library *zip)
{
    const char *fault =
        library_open_functions(&zip->handle, LIBRARY, true, LIBRARY_NAMES(FUNCTIONS), "lacks functions of libzip 1.6");
    return !fault || fail(e->error, LAM_UNSUPPORTED,
                          "%s: writing 3MF needs " LIBRARY ", which %s (Debian's package libzip4)", e->name, fault);
}

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

static bool add_entry(const struct library *zip, zip_t *archive, const char *name, const void *bytes, size_t size)
{
    enum { FIRST_DAY = 0x21 }; // 1 January 1980; with a fixed date, the same model always yields the same file
    zip_source_t *source = zip->zip_source_buffer(archive, bytes, size, 0);
    zip_int64_t index = source ? zip->zip_file_add(archive, name, source, ZIP_FL_ENC_UTF_8) : -1;
    if (source && index < 0)
        zip->zip_source_free(source);
    return index >= 0 && zip->zip_file_set_dostime(archive, (zip_uint64_t)index, 0, FIRST_DAY, 0) == 0;
}

static bool read_back(const struct library *zip, zip_source_t *source, struct text *text)
{
    char chunk[16384];
    if (zip->zip_source_open(source) != 0)
        return false;
    zip_int64_t got;
    while ((got = zip->zip_source_read(source, chunk, sizeof chunk)) > 0)
        text_add_part(text, chunk, (size_t)got);
    zip->zip_source_close(source);
    return got == 0 && !text->failed;
}

static int must_end(zip_t *archive, void *user)
{
    (void)archive;
    return !export_asks(user);
}

static bool pack(struct exporting *e, const struct library *zip, const struct text *model)
{
    zip_error_t reason;
    zip->zip_error_init(&reason);
    zip_source_t *source = zip->zip_source_buffer_create(NULL, 0, 0, &reason);
    zip_t *archive = source ? zip->zip_open_from_source(source, ZIP_CREATE | ZIP_TRUNCATE, &reason) : NULL;
    if (source && !archive)
        zip->zip_source_free(source);
    bool ok = archive != NULL;
    if (ok)
        zip->zip_source_keep(source);
    ok = ok && zip->zip_register_cancel_callback_with_state(archive, must_end, NULL, e) == 0;
    ok = ok && add_entry(zip, archive, "[Content_Types].xml", types, sizeof types - 1) &&
         add_entry(zip, archive, "_rels/.rels", relations, sizeof relations - 1) &&
         add_entry(zip, archive, "3D/3dmodel.model", model->bytes, model->length);
    bool closed = ok && zip->zip_close(archive) == 0;
    if (archive && !closed)
        zip->zip_discard(archive);
    ok = closed && read_back(zip, source, &e->text);
    if (archive)
        zip->zip_source_free(source);
    zip->zip_error_fini(&reason);
    return ok || (export_is_whole(e) && export_text_is_whole(e, &e->text) &&
                  fail(e->error, LAM_MACHINE, "%s: libzip cannot pack the model: out of memory", e->name));
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

static bool write(struct exporting *e)
{
    struct library zip;
    struct text model = {.call = e->call};
    if (!e->flat[EXPORT_TRIANGLES].triangle_count)
        return fail(e->error, LAM_BAD_ARGUMENT, "%s: found no triangles, and 3MF supports nothing else", e->name);
    if (!open_library(e, &zip))
        return false;
    bool ok = make_model(e, &model) && pack(e, &zip, &model);
    library_close(zip.handle);
    free(model.bytes);
    if (ok)
        lose(e);
    return ok;
}

#else

static bool write(struct exporting *e)
{
    return fail(e->error, LAM_UNSUPPORTED, "%s: this build does not include libzip, which is needed to write 3MF",
                e->name);
}

#endif

const struct exporter exporter_3mf = {"3mf", LAM_UP_Z, true, write};
