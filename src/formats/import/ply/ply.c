// ply.c: the PLY importer: reads a file's elements in order and builds the mesh (ply.h has the overview).
#include "ply.h"
#include "fail.h"
#include "mesh_build.h"
#include "mtl_maps.h"
#include "text_cursor.h"

#include <lambent/material.h>

#include <stdio.h>
#include <string.h>

static int ply_probe(const uint8_t *bytes, size_t size, size_t file_size)
{
    (void)file_size;
    return size >= 4 && memcmp(bytes, "ply", 3) == 0 && text_white(bytes[3]) ? 2 : 0;
}

// The elements that Lambent uses.
enum { VERTICES, FACES, STRIPS, EDGES, WANTED };
static const char *const element_names[WANTED] = {"vertex", "face", "tristrips", "edge"};

struct ply_import {
    const struct import_source *source;
    struct lam_scene *scene;
    struct arena *scratch;
    struct ply_header header;
    const struct ply_element *elements[WANTED]; // NULL if missing or without rows
    int lists[WANTED];                          // the property with the corners
    size_t offsets[WANTED];                     // offsets of the elements in the file
    struct ply_table tables[WANTED];
    int textures; // the number of materials with textures
};

static bool fail_header(const struct ply_import *reader, const struct ply_element *element, const char *found,
                        const char *expected, lam_error *error)
{
    return fail_line(error, reader->source, element->line, "element %s %s, expected %s", element->name, found,
                     expected);
}

// Ignores the edges, with a warning, if they lack an integer property vertex1 or vertex2 for their end vertices.
static void check_edges(struct ply_import *reader)
{
    static const char *const ends[] = {"vertex1", "vertex2"};
    const struct ply_element *edges = reader->elements[EDGES];
    for (int i = 0; edges && i < 2; i++) {
        int property = ply_find(edges, false, ends[i]);
        if (property >= 0 && ply_type_is_integer(edges->properties[property].type))
            continue;
        scene_warn(reader->scene, "%s:%zu: element edge has no integer property %s; its edges are not drawn",
                   reader->source->name, edges->line, ends[i]);
        reader->elements[EDGES] = NULL;
        return;
    }
}

// Finds the elements and their lists of corners.
static bool choose_elements(struct ply_import *reader, lam_error *error)
{
    for (int i = 0; i < reader->header.element_count; i++) {
        const struct ply_element *element = &reader->header.elements[i];
        for (int kind = 0; kind < WANTED; kind++) {
            if (strcmp(element->name, element_names[kind]) != 0 || element->count == 0)
                continue;
            if (reader->elements[kind])
                return fail_header(reader, element, "appears twice", "one", error);
            reader->elements[kind] = element;
        }
    }
    if (reader->elements[FACES])
        reader->elements[STRIPS] = NULL; // strips describe the same surface as the faces
    for (int kind = 0; kind < WANTED; kind++) {
        const struct ply_element *element = reader->elements[kind];
        reader->lists[kind] = -1;
        if (!element || kind == VERTICES || kind == EDGES)
            continue;
        int list = ply_find(element, true, "vertex_indices");
        if (list < 0)
            list = ply_find(element, true, "vertex_index");
        if (list < 0)
            return fail_header(reader, element, "has no list of corners",
                               "a property such as \"list uchar int vertex_indices\"", error);
        if (!ply_type_is_integer(element->properties[list].type))
            return fail_header(reader, element, "has a list of corners with a floating-point type", "an integer type",
                               error);
        reader->lists[kind] = list;
        element->properties[list].used = true;
    }
    check_edges(reader);
    return true;
}

// Rejects faces and edges without vertices.
static bool check_vertices(const struct ply_import *reader, lam_error *error)
{
    bool surface = reader->elements[FACES] || reader->elements[STRIPS];
    if (!reader->elements[VERTICES] && (surface || reader->elements[EDGES]))
        return fail(error, LAM_CANNOT_READ, "%s: the file contains %s and no vertices, expected element vertex",
                    reader->source->name, surface ? "faces" : "edges");
    return true;
}

static struct ply_request request_for(const struct ply_import *reader, int kind, enum ply_positions_as positions)
{
    const struct ply_element *vertices = reader->elements[VERTICES], *element = reader->elements[kind];
    int wedges = kind == FACES ? ply_find(element, true, "texcoord") : -1;
    if (wedges >= 0)
        element->properties[wedges].used = true;
    return (struct ply_request){
        .wedges = wedges >= 0 ? &element->properties[wedges] : NULL,
        .scalars = element->list_count < element->property_count && kind != STRIPS,
        .list = reader->lists[kind],
        .item_limit = vertices->count > UINT32_MAX ? UINT32_MAX : (uint32_t)vertices->count,
        .restarts = kind == STRIPS,
        .positions = kind == VERTICES && reader->header.format == PLY_ASCII ? positions : PLY_AS_DECLARED,
    };
}

static bool read_element(struct ply_import *reader, const struct ply_element *element, int kind,
                         enum ply_positions_as positions, size_t *at, lam_error *error)
{
    struct ply_table *table = kind < WANTED ? &reader->tables[kind] : NULL;
    struct ply_request request = {.list = -1};
    if (table)
        request = request_for(reader, kind, positions);
    request.keep = &reader->scene->arena;
    request.scratch = reader->scratch;
    if (reader->header.format == PLY_ASCII)
        return ply_read_ascii(reader->source, element, &request, at, table, error);
    return ply_read_binary(reader->source, &reader->header, element, &request, at, table, error);
}

// Warns about text after the last row of the last element.
static void warn_rest(const struct ply_import *reader, size_t at)
{
    const struct import_source *source = reader->source;
    const uint8_t *end = source->bytes + source->size, *rest = text_skip_white(source->bytes + at, end);
    char found[TEXT_FOUND_SIZE];
    if (rest < end)
        scene_warn(reader->scene,
                   "%s:%zu: found %s after the last row, expected the end of the file; the rest is ignored",
                   source->name, text_line(source->bytes, rest), text_found(rest, end, found));
}

// Reads the elements in the order of the file, up to the last element that Lambent uses.
static bool read_elements(struct ply_import *reader, lam_error *error)
{
    int last = 0;
    for (int i = 0; i < reader->header.element_count; i++) {
        for (int kind = 0; kind < WANTED; kind++)
            last = reader->elements[kind] == &reader->header.elements[i] ? i : last;
    }
    size_t at = reader->header.body;
    for (int i = 0; i <= last; i++) {
        const struct ply_element *element = &reader->header.elements[i];
        int kind = 0;
        while (kind < WANTED && reader->elements[kind] != element)
            kind++;
        if (kind < WANTED)
            reader->offsets[kind] = at;
        if (!read_element(reader, element, kind, PLY_AS_FLOAT, &at, error))
            return false;
    }
    if (reader->header.format == PLY_ASCII && last == reader->header.element_count - 1)
        warn_rest(reader, at);
    return true;
}

static bool read_positions(struct ply_import *reader, lam_mesh *mesh, lam_error *error)
{
    struct arena *arena = &reader->scene->arena;
    bool needs_doubles;
    if (!ply_positions(reader->source, &reader->tables[VERTICES], arena, mesh, &needs_doubles, error))
        return false;
    if (!needs_doubles)
        return true;
    size_t at = reader->offsets[VERTICES];
    return read_element(reader, reader->elements[VERTICES], VERTICES, PLY_AS_DOUBLE, &at, error) &&
           ply_positions(reader->source, &reader->tables[VERTICES], arena, mesh, &needs_doubles, error);
}

static bool read_vertices(struct ply_import *reader, lam_mesh *mesh, lam_error *error)
{
    struct ply_attributes own;
    if (!read_positions(reader, mesh, error) ||
        !ply_read_attributes(reader->source, reader->scene, &reader->tables[VERTICES], PLY_ALL, &reader->scene->arena,
                             &own, error))
        return false;
    mesh->normals = own.normals;
    mesh->texcoords = own.texcoords;
    mesh->tangents = own.tangents;
    mesh->colors = own.colors;
    mesh->colors_format = own.colors_format;
    mesh->normal_count = mesh->normals ? mesh->vertex_count : 0;
    mesh->texcoord_count = mesh->texcoords ? mesh->vertex_count : 0;
    mesh->tangent_count = mesh->tangents ? mesh->vertex_count : 0;
    mesh->color_count = mesh->colors ? mesh->vertex_count : 0;
    return true;
}

// --- textures

// Adds a white material for each texture, if the mesh has texture coordinates.
static bool add_textures(struct ply_import *reader, const lam_mesh *mesh, lam_error *error)
{
    const struct ply_header *header = &reader->header;
    const struct mtl_set set = {0};
    if (!mesh->texcoords && !reader->tables[FACES].wedges)
        return true;
    for (int i = 0; i < header->texture_count; i++) {
        lam_material material = lam_material_default();
        material.ambient = (lam_rgb){1, 1, 1};
        material.diffuse = (lam_rgba){1, 1, 1, 1};
        material.name = material.map_names[LAM_MAP_DIFFUSE] = arena_string(&reader->scene->arena, header->textures[i]);
        if (!material.name)
            return call_memory_error(reader->source->call, strlen(header->textures[i]), error);
        if (scene_adopt_material(reader->scene, &material, error) < 0)
            return false;
    }
    reader->textures = header->texture_count;
    return mtl_maps_read(reader->source, reader->scene, &set, reader->scratch, error);
}

// Warns about the properties and elements that are not drawn.
static void warn_unused(const struct ply_import *reader)
{
    enum { SHOWN = 8 };
    const struct ply_header *header = &reader->header;
    char list[SHOWN * (SHOWN_NAME_SIZE + 16)], name[SHOWN_NAME_SIZE];
    int count = 0, used = 0;
    for (int i = 0; i < header->element_count; i++) {
        const struct ply_element *element = &header->elements[i];
        int kind = 0;
        while (kind < WANTED && reader->elements[kind] != element)
            kind++;
        if (element->count == 0 || (kind == WANTED && strcmp(element->name, element_names[EDGES]) == 0))
            continue; // check_edges has warned
        for (int k = 0; k < (kind == WANTED ? 1 : element->property_count); k++)
            if ((kind == WANTED || !element->properties[k].used) && count++ < SHOWN)
                used += snprintf(list + used, sizeof list - (size_t)used, "%s%s%s", count > 1 ? ", " : "",
                                 kind == WANTED ? "element " : "",
                                 shown_name(kind == WANTED ? element->name : element->properties[k].name, name));
    }
    if (header->texture_count && !reader->textures)
        scene_warn(reader->scene, "%s: the texture '%s' is not drawn, because the file contains no texture coordinates",
                   reader->source->name, shown_name(header->textures[0], name));
    if (count > SHOWN)
        snprintf(list + used, sizeof list - (size_t)used, " and %d more", count - SHOWN);
    if (count)
        scene_warn(reader->scene, "%s: contains data that is not drawn: %s", reader->source->name, list);
}

static bool build(struct ply_import *reader, lam_error *error)
{
    const struct import_source *source = reader->source;
    struct lam_scene *scene = reader->scene;
    char found[TEXT_FOUND_SIZE];
    // the text lacks the first line of PLY, but the caller or the file's extension selected this importer
    if (ply_probe(source->bytes, source->size, source->parts.size) == 0)
        return fail_line(error, source, 1, "found %s, expected \"ply\"",
                         text_found(source->bytes, source->bytes + source->size, found));
    if (!ply_read_header(source, reader->scratch, &reader->header, error) || !choose_elements(reader, error) ||
        !check_vertices(reader, error))
        return false;
    ply_warn_header(source, scene, &reader->header);
    if (!reader->elements[VERTICES])
        return true; // the caller reports a file without contents
    if (!read_elements(reader, error))
        return false;

    lam_mesh mesh = {0};
    if (!read_vertices(reader, &mesh, error) || !add_textures(reader, &mesh, error))
        return false;
    lam_mesh lines = mesh;
    bool surface = reader->elements[FACES] || reader->elements[STRIPS];
    if (surface) {
        bool done = reader->elements[FACES]
                        ? ply_faces(source, &reader->tables[FACES], reader->textures, scene, &mesh, error)
                        : ply_strips(source, &reader->tables[STRIPS], scene, &mesh, error);
        scene->first_all_used = reader->tables[FACES].all_used;
        if (!done || !mesh_add_object(scene, &mesh, NULL, error))
            return false;
        if (reader->textures && !mesh.part_count && scene->objects.count)
            ((lam_object *)scene->objects.items)->material = 0; // the first texture
    }
    if (reader->elements[EDGES]) {
        scene->shared_arrays |= surface;
        return ply_edges(source, &reader->tables[EDGES], scene, &lines, error) &&
               mesh_add_object(scene, &lines, NULL, error);
    }
    if (surface)
        return true;
    mesh.point_count = mesh.vertex_count; // a point cloud
    return mesh_add_object(scene, &mesh, NULL, error);
}

// Only binary files can be read in parts, because rows of text differ in size. The whole header must be in memory. If
// the body begins at the end of these bytes, the line "end_header" may be truncated.
static bool in_parts(const struct import_source *source)
{
    struct arena scratch;
    struct ply_header header;
    if (source->size == source->parts.size)
        return true;
    arena_start(&scratch, source->call);
    bool binary =
        ply_read_header(source, &scratch, &header, NULL) && header.format != PLY_ASCII && header.body < source->size;
    arena_free(&scratch);
    return binary;
}

static bool ply_load(struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    struct arena scratch;
    arena_start(&scratch, source->call);
    struct ply_import reader = {.source = source, .scene = scene, .scratch = &scratch};
    bool done = (in_parts(source) || import_whole(source, error)) && build(&reader, error);
    if (done)
        warn_unused(&reader);
    arena_free(&scratch);
    return done;
}

const struct importer importer_ply = {
    .name = "ply",
    .extensions = "ply",
    .up = LAM_UP_Y,
    .up_is_habit = true,
    .may_lie = true,
    .probe = ply_probe,
    .load = ply_load,
};
