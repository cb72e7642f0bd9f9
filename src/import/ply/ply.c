// ply.c: PLY, ASCII and binary: the order in which a file's elements become a mesh. ply.h says where the rest is.
#include "ply.h"
#include "fail.h"
#include "text_cursor.h"

#include <string.h>

static int ply_probe(const uint8_t *bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "ply", 3) == 0 && text_white(bytes[3]) ? 2 : 0;
}

// The elements of interest, by their usual names.
enum { VERTICES, FACES, STRIPS, WANTED };
static const char *const element_names[WANTED] = {"vertex", "face", "tristrips"};

struct reading {
    const struct import_source *source;
    struct lam_scene *scene;
    struct arena *scratch;
    struct ply_header header;
    const struct ply_element *elements[WANTED]; // NULL: there is none, or it has no rows
    int lists[WANTED];                          // the property with the corners
    size_t offsets[WANTED];                     // where the element begins in the file
    struct ply_table tables[WANTED];
};

static bool fail_header(const struct reading *reading, const struct ply_element *element, const char *found,
                        const char *expected, lam_error *error)
{
    return fail_line(error, reading->source, element->line, "element %s %s, expected %s", element->name, found,
                     expected);
}

// Finds the elements and the list of corners in each.
static bool choose(struct reading *reading, lam_error *error)
{
    for (int i = 0; i < reading->header.element_count; i++) {
        const struct ply_element *element = &reading->header.elements[i];
        for (int kind = 0; kind < WANTED; kind++) {
            if (strcmp(element->name, element_names[kind]) != 0 || element->count == 0)
                continue;
            if (reading->elements[kind])
                return fail_header(reading, element, "is there twice", "it once", error);
            reading->elements[kind] = element;
        }
    }
    if (reading->elements[FACES])
        reading->elements[STRIPS] = NULL; // the same surface a second time
    for (int kind = 0; kind < WANTED; kind++) {
        const struct ply_element *element = reading->elements[kind];
        reading->lists[kind] = -1;
        if (!element || kind == VERTICES)
            continue;
        int list = ply_find(element, true, "vertex_indices");
        if (list < 0)
            list = ply_find(element, true, "vertex_index");
        if (list < 0)
            return fail_header(reading, element, "has no list of corners",
                               "a property such as \"list uchar int vertex_indices\"", error);
        if (!ply_type_is_integer(element->properties[list].type))
            return fail_header(reading, element, "has corners that are not whole numbers", "an integer type", error);
        reading->lists[kind] = list;
    }
    return true;
}

// Whether there is a surface at all; a file of points is told plainly.
static bool check_surface(const struct reading *reading, lam_error *error)
{
    const struct ply_element *vertices = reading->elements[VERTICES];
    bool surface = reading->elements[FACES] || reading->elements[STRIPS];
    if (vertices && !surface)
        return fail(error, LAM_CANNOT_READ, "%s: the file holds %llu points and no faces, expected a surface",
                    reading->source->name, (unsigned long long)vertices->count);
    if (surface && !vertices)
        return fail(error, LAM_CANNOT_READ, "%s: the file holds faces and no vertices, expected element vertex",
                    reading->source->name);
    return true;
}

static struct ply_request request_for(const struct reading *reading, int kind, enum ply_positions_as positions)
{
    const struct ply_element *vertices = reading->elements[VERTICES], *element = reading->elements[kind];
    return (struct ply_request){
        .scalars = element->list_count < element->property_count && kind != STRIPS,
        .list = reading->lists[kind],
        .item_limit = vertices->count > UINT32_MAX ? UINT32_MAX : (uint32_t)vertices->count,
        .restarts = kind == STRIPS,
        .positions = kind == VERTICES && reading->header.format == PLY_ASCII ? positions : PLY_AS_DECLARED,
    };
}

static bool read_element(struct reading *reading, const struct ply_element *element, int kind,
                         enum ply_positions_as positions, size_t *at, lam_error *error)
{
    struct ply_table *table = kind < WANTED ? &reading->tables[kind] : NULL;
    struct ply_request request = {.list = -1};
    if (table)
        request = request_for(reading, kind, positions);
    if (reading->header.format == PLY_ASCII)
        return ply_read_ascii(reading->source, element, &request, &reading->scene->arena, reading->scratch, at, table,
                              error);
    return ply_read_binary(reading->source, &reading->header, element, &request, &reading->scene->arena,
                           reading->scratch, at, table, error);
}

// Reads the elements in the order of the file, up to the last one of interest.
static bool read_elements(struct reading *reading, lam_error *error)
{
    int last = 0;
    for (int i = 0; i < reading->header.element_count; i++) {
        for (int kind = 0; kind < WANTED; kind++)
            last = reading->elements[kind] == &reading->header.elements[i] ? i : last;
    }
    size_t at = reading->header.body;
    for (int i = 0; i <= last; i++) {
        const struct ply_element *element = &reading->header.elements[i];
        int kind = 0;
        while (kind < WANTED && reading->elements[kind] != element)
            kind++;
        if (kind < WANTED)
            reading->offsets[kind] = at;
        if (!read_element(reading, element, kind, PLY_AS_FLOAT, &at, error))
            return false;
    }
    return true;
}

static bool read_positions(struct reading *reading, lam_mesh *mesh, lam_error *error)
{
    struct arena *arena = &reading->scene->arena;
    bool far_out;
    if (!ply_positions(reading->source, &reading->tables[VERTICES], arena, mesh, &far_out, error))
        return false;
    if (!far_out)
        return true;
    size_t at = reading->offsets[VERTICES];
    return read_element(reading, reading->elements[VERTICES], VERTICES, PLY_AS_DOUBLE, &at, error) &&
           ply_positions(reading->source, &reading->tables[VERTICES], arena, mesh, &far_out, error);
}

static bool build(struct reading *reading, lam_error *error)
{
    const struct import_source *source = reading->source;
    struct lam_scene *scene = reading->scene;
    char found[TEXT_FOUND_SIZE];
    if (ply_probe(source->bytes, source->size) == 0) // the file's name or the caller said that it is one
        return fail_line(error, source, 1, "found %s, expected \"ply\"",
                         text_found(source->bytes, source->bytes + source->size, found));
    if (!ply_read_header(source, reading->scratch, &reading->header, error) || !choose(reading, error) ||
        !check_surface(reading, error))
        return false;
    if (!reading->elements[VERTICES])
        return true; // nothing at all: the caller says that there are no triangles
    if (!read_elements(reading, error))
        return false;

    lam_mesh mesh = {0};
    const struct ply_table *vertices = &reading->tables[VERTICES];
    if (!read_positions(reading, &mesh, error) || !ply_normals(source, vertices, &scene->arena, &mesh.normals, error) ||
        !ply_texcoords(source, vertices, &scene->arena, &mesh.texcoords, error) ||
        !ply_tangents(source, vertices, &scene->arena, &mesh.tangents, error) ||
        !ply_colors(source, vertices, &scene->arena, &mesh.colors, &mesh.colors_format, error))
        return false;
    mesh.normal_count = mesh.normals ? mesh.vertex_count : 0;
    mesh.texcoord_count = mesh.texcoords ? mesh.vertex_count : 0;
    mesh.tangent_count = mesh.tangents ? mesh.vertex_count : 0;
    mesh.color_count = mesh.colors ? mesh.vertex_count : 0;

    bool done = reading->elements[FACES] ? ply_faces(source, &reading->tables[FACES], scene, &mesh, error)
                                         : ply_strips(source, &reading->tables[STRIPS], scene, &mesh, error);
    if (!done || mesh.triangle_count == 0)
        return done;
    lam_object object = lam_object_default();
    object.mesh = scene_take_mesh(scene, &mesh, error);
    return object.mesh >= 0 && scene_take_object(scene, &object, error) >= 0;
}

static bool ply_load(const struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    struct arena scratch;
    arena_start(&scratch, source->call);
    struct reading reading = {.source = source, .scene = scene, .scratch = &scratch};
    bool done = build(&reading, error);
    arena_free(&scratch);
    return done;
}

const struct importer importer_ply = {
    .name = "ply",
    .extensions = "ply",
    .up = LAM_UP_Y,
    .probe = ply_probe,
    .load = ply_load,
    .load_parts = ply_load_parts,
};
