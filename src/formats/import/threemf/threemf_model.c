// threemf_model.c: reads model parts: objects with their meshes and components, and the build (3MF core 1.3, production
// extension 1.1). https://github.com/3MFConsortium/spec_core
#include "threemf_model.h"

#include "fail.h"
#include "shown_name.h"

#ifdef HAVE_3MF

#include "number.h"

#include <string.h>

// --- the part

static const struct unit {
    const char *name;
    double metres;
} units[] = {{"millimeter", 1e-3}, {"micron", 1e-6}, {"centimeter", 1e-2},
             {"inch", 0.0254},     {"foot", 0.3048}, {"meter", 1}};

static bool begin_model(struct threemf_xml *xml, const char *const *attributes)
{
    const char *unit = threemf_attribute(attributes, "unit");
    char shown[SHOWN_NAME_SIZE];
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (!unit || strcmp(unit, units[i].name) == 0) {
            reader_of(xml)->part->unit_m = units[i].metres;
            return extensions_check(xml, attributes);
        }
    return threemf_xml_fail(xml, "found unit=\"%s\", expected micron, millimeter, centimeter, inch, foot or meter",
                            shown_name(unit, shown));
}

static bool begin_metadata(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    const char *name = threemf_attribute(attributes, "name");
    lam_file_info *info = &reader->file->scene->file;
    reader->wanted_text = !name || !reader->is_root          ? NULL
                          : strcmp(name, "Application") == 0 ? &info->generator
                          : strcmp(name, "Copyright") == 0   ? &info->copyright
                                                             : NULL;
    reader->text.count = 0;
    xml->text = reader->wanted_text ? &reader->text : NULL;
    return true;
}

static bool end_metadata(struct threemf_xml *xml)
{
    struct model_reader *reader = reader_of(xml);
    xml->text = NULL;
    if (!reader->wanted_text || !reader->text.count)
        return true;
    *reader->wanted_text = arena_string_of(&reader->file->scene->arena, reader->text.items, reader->text.count);
    return *reader->wanted_text || threemf_no_memory(reader->file, reader->text.count);
}

// --- meshes

static bool begin_object(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_resource *resource = model_add_resource(xml, attributes, RESOURCE_OBJECT);
    const char *name = threemf_attribute(attributes, "name");
    if (!resource)
        return false;
    struct threemf_object *object = arena_alloc_zeroed(reader->file->scratch, sizeof *object);
    if (!object)
        return threemf_no_memory(reader->file, sizeof *object);
    resource->object = reader->object = object;
    const char *type = threemf_attribute(attributes, "type");
    object->role = type && strcmp(type, "other") == 0 ? OTHER : ROLE_PRINTS; // objects of this type never print
    object->line = threemf_xml_line(xml);
    object->name = name && *name ? arena_string(&reader->file->scene->arena, name) : NULL;
    if (name && *name && !object->name)
        return threemf_no_memory(reader->file, strlen(name));
    uint32_t id, group;
    bool has_group, has_index;
    if (!threemf_take_number(xml, attributes, "id", &id, NULL) ||
        !threemf_take_number(xml, attributes, "pid", &group, &has_group) ||
        !threemf_take_number(xml, attributes, "pindex", &object->index, &has_index))
        return false;
    object->id = (int32_t)id;
    reader->file->sliced += threemf_attribute_of(xml, attributes, NS_SLICES, "slicestackid") != NULL;
    object->group = has_group ? (int32_t)group : 0;
    reader->positions.count = reader->indices.count = reader->properties.count = reader->components.count = 0;
    reader->has_properties = false;
    reader->triangle = 0;
    reader->midpoint_slots = 0;
    threemf_rows_free(reader->file, &reader->midpoints);
    return true;
}

static bool begin_vertex(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    float *position = threemf_add(reader->file, &reader->positions, 3 * sizeof *position);
    if (position && reader->positions.count > INT32_MAX)
        return threemf_xml_fail(xml, "found more than %d vertices", INT32_MAX);
    return position && threemf_take_float(xml, attributes, "x", &position[0]) &&
           threemf_take_float(xml, attributes, "y", &position[1]) &&
           threemf_take_float(xml, attributes, "z", &position[2]);
}

// Gets the properties of a triangle; p2 and p3 default to p1.
static bool take_property(struct threemf_xml *xml, const char *const *attributes, struct threemf_property *property)
{
    struct model_reader *reader = reader_of(xml);
    const struct threemf_object *object = reader->object;
    uint32_t group;
    bool has_group, has_first, has_second, has_third;
    if (!threemf_take_number(xml, attributes, "pid", &group, &has_group) ||
        !threemf_take_number(xml, attributes, "p1", &property->index[0], &has_first) ||
        !threemf_take_number(xml, attributes, "p2", &property->index[1], &has_second) ||
        !threemf_take_number(xml, attributes, "p3", &property->index[2], &has_third))
        return false;
    property->group = has_group ? (int32_t)group : object->group;
    if (property->group == FILAMENT)
        return true;
    if (!has_first)
        property->index[0] = object->index;
    if (!has_second)
        property->index[1] = property->index[0];
    if (!has_third)
        property->index[2] = property->index[0];
    return true;
}

// Returns the painting of a triangle with filaments, as PrusaSlicer or Bambu Studio and OrcaSlicer write it, or NULL.
static const char *painting_of(struct threemf_xml *xml, const char *const *attributes)
{
    const char *painting = threemf_attribute(attributes, "paint_color");
    if (!painting)
        painting = threemf_attribute_of(xml, attributes, NS_SLIC3R, "mmu_segmentation");
    painting = painting && *painting ? painting : NULL;
    xml->file->uncolored |= painting && !xml->file->filaments.count;
    return xml->file->filaments.count ? painting : NULL;
}

static bool begin_triangle(struct threemf_xml *xml, const char *const *attributes)
{
    static const char *const names[3] = {"v1", "v2", "v3"};
    struct model_reader *reader = reader_of(xml);
    uint32_t corners[3];
    struct threemf_property property = {0};
    const struct threemf_volume *volume =
        threemf_volume_at(reader->file, reader->part, reader->object->id, TRIANGLE_RANGE, reader->triangle++);
    for (int i = 0; i < 3; i++) {
        if (!threemf_take_number(xml, attributes, names[i], &corners[i], NULL))
            return false;
        if (corners[i] >= reader->positions.count)
            return threemf_xml_fail(xml, "found %s=\"%u\", expected a vertex below %zu", names[i], corners[i],
                                    reader->positions.count);
    }
    if (!take_property(xml, attributes, &property))
        return false;
    if (volume && volume->role != ROLE_PRINTS) {
        reader->file->left_out[volume->role] += volume->first == reader->triangle - 1;
        return true;
    }
    if (volume && property.group == FILAMENT)
        property.index[0] = volume->extruder;
    const char *painting = painting_of(xml, attributes);
    return painting ? paint_triangle(reader, painting, corners, &property)
                    : model_add_triangle(reader, corners, &property);
}

// Copies rows into an arena. Returns NULL if there are no rows, or if memory runs out (*ok becomes false).
static void *keep_rows(struct model_reader *reader, struct arena *arena, const struct threemf_rows *rows, size_t size,
                       bool *ok)
{
    if (!rows->count || !*ok)
        return NULL;
    void *copy = arena_array(arena, rows->count, size);
    *ok = copy || threemf_no_memory(reader->file, rows->count * size);
    if (copy)
        memcpy(copy, rows->items, rows->count * size);
    return copy;
}

static bool end_object(struct threemf_xml *xml)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_object *object = reader->object;
    struct arena *kept = &reader->file->scene->arena, *scratch = reader->file->scratch;
    bool ok = paint_finish(reader);
    object->vertex_count = (uint32_t)reader->positions.count;
    object->triangle_count = (uint32_t)reader->indices.count;
    object->component_count = reader->components.count;
    if (reader->indices.count) {
        object->positions = keep_rows(reader, kept, &reader->positions, 3 * sizeof(float), &ok);
        object->indices = keep_rows(reader, kept, &reader->indices, 3 * sizeof(uint32_t), &ok);
    }
    if (reader->has_properties)
        object->properties = keep_rows(reader, scratch, &reader->properties, sizeof *object->properties, &ok);
    object->components = keep_rows(reader, scratch, &reader->components, sizeof *object->components, &ok);
    return ok;
}

// --- components and the build

// A transform is 4 rows of 3 numbers for row vectors: "m00 m01 m02 m10 … m32". The last row is the translation.
static bool take_transform(struct threemf_xml *xml, const char *const *attributes, lam_mat4 *out)
{
    const char *text = threemf_attribute(attributes, "transform");
    char shown[SHOWN_NAME_SIZE];
    *out = lam_mat4_identity();
    if (!text)
        return true;
    const uint8_t *at = (const uint8_t *)text, *end = at + strlen(text);
    int count = 0;
    for (; at && count < 12; count++) {
        at += strspn((const char *)at, " \t\r\n");
        double *number = &out->m[count % 3][count / 3];
        at = number_double(at, end, number);
        if (at && !(*number - *number == 0))
            at = NULL;
    }
    return (at && !at[strspn((const char *)at, " \t\r\n")]) ||
           threemf_xml_fail(xml, "found transform=\"%s\", expected 12 finite numbers", shown_name(text, shown));
}

static bool add_component(struct threemf_xml *xml, const char *const *attributes, struct threemf_rows *rows)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_component *component = threemf_add(reader->file, rows, sizeof *component);
    const char *path = threemf_attribute_of(xml, attributes, NS_PRODUCTION, "path");
    uint32_t id;
    if (!component || !threemf_take_number(xml, attributes, "objectid", &id, NULL) ||
        !take_transform(xml, attributes, &component->transform))
        return false;
    component->id = (int32_t)id;
    const char *printable = threemf_attribute(attributes, "printable");
    component->off = printable && strcmp(printable, "0") == 0;
    component->line = threemf_xml_line(xml);
    component->path = path ? arena_string(reader->file->scratch, path) : NULL;
    return component->path || !path || threemf_no_memory(reader->file, strlen(path));
}

static bool begin_component(struct threemf_xml *xml, const char *const *attributes)
{
    return add_component(xml, attributes, &reader_of(xml)->components);
}

static bool begin_item(struct threemf_xml *xml, const char *const *attributes)
{
    return !reader_of(xml)->is_root || add_component(xml, attributes, &reader_of(xml)->part->items);
}

// Counts a beam; beams are not drawn.
static bool begin_beam(struct threemf_xml *xml, const char *const *attributes)
{
    (void)attributes;
    reader_of(xml)->file->beams++;
    return true;
}

static const struct threemf_element elements[IN_COUNT] = {
    [IN_MODEL] = {NS_CORE, "model", -1, begin_model, NULL},
    [IN_METADATA] = {NS_CORE, "metadata", IN_MODEL, begin_metadata, end_metadata},
    [IN_RESOURCES] = {NS_CORE, "resources", IN_MODEL, NULL, NULL},
    [IN_OBJECT] = {NS_CORE, "object", IN_RESOURCES, begin_object, end_object},
    [IN_MESH] = {NS_CORE, "mesh", IN_OBJECT, NULL, NULL},
    [IN_VERTICES] = {NS_CORE, "vertices", IN_MESH, NULL, NULL},
    [IN_VERTEX] = {NS_CORE, "vertex", IN_VERTICES, begin_vertex, NULL},
    [IN_TRIANGLES] = {NS_CORE, "triangles", IN_MESH, NULL, NULL},
    [IN_TRIANGLE] = {NS_CORE, "triangle", IN_TRIANGLES, begin_triangle, NULL},
    [IN_COMPONENTS] = {NS_CORE, "components", IN_OBJECT, NULL, NULL},
    [IN_COMPONENT] = {NS_CORE, "component", IN_COMPONENTS, begin_component, NULL},
    [IN_BASE_MATERIALS] = {NS_CORE, "basematerials", IN_RESOURCES, begin_base_materials, end_group},
    [IN_BASE] = {NS_CORE, "base", IN_BASE_MATERIALS, begin_base, NULL},
    [IN_COLOR_GROUP] = {NS_MATERIALS, "colorgroup", IN_RESOURCES, begin_color_group, end_group},
    [IN_COLOR] = {NS_MATERIALS, "color", IN_COLOR_GROUP, begin_color, NULL},
    [IN_TEXTURE] = {NS_MATERIALS, "texture2d", IN_RESOURCES, begin_texture, end_group},
    [IN_TEXCOORD_GROUP] = {NS_MATERIALS, "texture2dgroup", IN_RESOURCES, begin_texcoord_group, end_group},
    [IN_TEXCOORD] = {NS_MATERIALS, "tex2coord", IN_TEXCOORD_GROUP, begin_texcoord, NULL},
    [IN_COMPOSITES] = {NS_MATERIALS, "compositematerials", IN_RESOURCES, begin_composites, end_group},
    [IN_COMPOSITE] = {NS_MATERIALS, "composite", IN_COMPOSITES, begin_composite, NULL},
    [IN_MULTIS] = {NS_MATERIALS, "multiproperties", IN_RESOURCES, begin_multis, end_multis},
    [IN_MULTI] = {NS_MATERIALS, "multi", IN_MULTIS, begin_multi, NULL},
    // the namespace is wrong, but samples of the 3MF consortium use it
    [IN_CORE_MULTI] = {NS_CORE, "multi", IN_MULTIS, begin_multi, NULL},
    [IN_METALLIC_GROUP] = {NS_MATERIALS, "pbmetallicdisplayproperties", IN_RESOURCES, begin_display, end_group},
    [IN_METALLIC] = {NS_MATERIALS, "pbmetallic", IN_METALLIC_GROUP, begin_metallic, NULL},
    [IN_SPECULAR_GROUP] = {NS_MATERIALS, "pbspeculardisplayproperties", IN_RESOURCES, begin_display, end_group},
    [IN_SPECULAR] = {NS_MATERIALS, "pbspecular", IN_SPECULAR_GROUP, begin_specular, NULL},
    [IN_BEAM_LATTICE] = {NS_BEAMS, "beamlattice", IN_MESH, NULL, NULL},
    [IN_BEAMS] = {NS_BEAMS, "beams", IN_BEAM_LATTICE, NULL, NULL},
    [IN_BEAM] = {NS_BEAMS, "beam", IN_BEAMS, begin_beam, NULL},
    [IN_BUILD] = {NS_CORE, "build", IN_MODEL, NULL, NULL},
    [IN_ITEM] = {NS_CORE, "item", IN_BUILD, begin_item, NULL},
};

// --- parts

// Copies the lists that meshes share into the scene's arena.
static bool keep_lists(struct model_reader *reader)
{
    struct threemf_part *part = reader->part;
    struct arena *arena = &reader->file->scene->arena;
    bool ok = true;
    part->scene_colors = keep_rows(reader, arena, &part->colors, 4 * sizeof(float), &ok);
    part->scene_texcoords = keep_rows(reader, arena, &part->texcoords, 2 * sizeof(float), &ok);
    return ok;
}

static bool read_part(struct threemf *file, struct threemf_part *part)
{
    struct model_reader reader = {.file = file, .part = part, .is_root = file->parts.count == 1, .group = -1};
    struct threemf_xml xml = {.file = file,
                              .part = part->path,
                              .elements = elements,
                              .element_count = IN_COUNT,
                              .user = &reader,
                              .declare = extensions_declare};
    bool ok = properties_start(file, part) && threemf_xml_parse(&xml) && keep_lists(&reader);
    if (ok)
        display_finish(&reader);
    threemf_rows_free(file, &reader.positions);
    threemf_rows_free(file, &reader.indices);
    threemf_rows_free(file, &reader.properties);
    threemf_rows_free(file, &reader.components);
    threemf_rows_free(file, &reader.midpoints);
    threemf_rows_free(file, &reader.text);
    threemf_rows_free(file, &reader.spaces);
    threemf_rows_free(file, &reader.wishes);
    threemf_rows_free(file, &reader.displays);
    return ok;
}

struct threemf_part *threemf_part_at(struct threemf *file, const char *path)
{
    path += *path == '/';
    struct threemf_part **parts = file->parts.items;
    int32_t index = name_table_find(&file->part_names, path);
    if (index >= 0)
        return parts[index];
    struct threemf_part *part = arena_alloc_zeroed(file->scratch, sizeof *part);
    if (part)
        part->path = arena_string(file->scratch, path);
    struct threemf_part **row = part && part->path ? threemf_add(file, &file->parts, sizeof part) : NULL;
    if (!row || !name_table_add(&file->part_names, part->path, (int32_t)file->parts.count - 1))
        return threemf_no_memory(file, sizeof *part), NULL;
    *row = part;
    part->ids.memory = file->scratch;
    return read_part(file, part) ? part : NULL;
}

#endif
