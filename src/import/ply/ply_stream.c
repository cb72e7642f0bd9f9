// ply_stream.c: large PLY files of the usual layout, read part by part: binary, little-endian, vertices
// without lists, then faces that are one list of three corners each.
//
// A part is converted while it is in the second-level cache, and the file is never held as a whole: half the memory,
// and half the traffic, of reading it first. Whatever is not so, and whatever is wrong, is left to ply.c.
#include "loop_status.h"
#include "ply_load.h"

enum {
    FACE = 13, // bytes: a count, and three 32-bit corners
    PART_FACES = 8192,
    PART_VERTICES = 16384,
    TRIANGLES_MAX = 1431655765, // as ply_faces.c has it
};

struct parts {
    const struct import_source *source;
    const struct file_parts *file;
    struct loop_status loop;
    int wrong;         // touched atomically
    size_t begin;      // of the element in the file
    uint8_t *capacity; // PART_FACES · FACE bytes for each thread
    // Vertices
    uint8_t *rows;
    size_t count, stride;
    bool floats; // all of a row are, and are to be finite
    // Faces
    uint32_t *indices;
    uint32_t limit;
};

static bool still_right(struct parts *parts)
{
    return !__atomic_load_n(&parts->wrong, __ATOMIC_RELAXED) && should_continue(&parts->loop);
}

static void found_wrong(struct parts *parts) { __atomic_store_n(&parts->wrong, 1, __ATOMIC_RELAXED); }

static void read_vertices(void *user, size_t index, int thread)
{
    (void)thread;
    struct parts *parts = user;
    if (!still_right(parts))
        return;
    size_t first = index * PART_VERTICES, count = parts->count - first;
    count = count < PART_VERTICES ? count : PART_VERTICES;
    uint8_t *to = parts->rows + first * parts->stride;
    if (!file_read_part(parts->file, parts->begin + first * parts->stride, to, count * parts->stride))
        found_wrong(parts);
    uint32_t odd = 0; // its top bit: an exponent of all ones was met
    for (size_t i = 0; parts->floats && i < count * parts->stride; i += 4)
        odd |= (ply_load_32(to + i, false) & 0x7fffffff) + 0x00800000;
    if (odd & 0x80000000)
        found_wrong(parts);
}

static void read_faces(void *user, size_t index, int thread)
{
    struct parts *parts = user;
    if (!still_right(parts))
        return;
    size_t first = index * PART_FACES, count = parts->count - first;
    count = count < PART_FACES ? count : PART_FACES;
    uint8_t *at = parts->capacity + (size_t)thread * PART_FACES * FACE;
    if (!file_read_part(parts->file, parts->begin + first * FACE, at, count * FACE)) {
        found_wrong(parts);
        return;
    }
    uint32_t *out = parts->indices + 3 * first, limit = parts->limit, other = 0, beyond = 0;
    for (size_t i = 0; i < count; i++, at += FACE, out += 3) {
        uint32_t three[3];
        memcpy(three, at + 1, sizeof three);
        memcpy(out, three, sizeof three);
        other |= at[0] ^ 3u;
        beyond |= (three[0] >= limit) | (three[1] >= limit) | (three[2] >= limit);
    }
    if (other || beyond)
        found_wrong(parts);
}

// The header's two elements, where they have the layout and the file has their bytes.
static bool usual(const struct ply_header *header, size_t size)
{
    if (header->format != PLY_LITTLE || header->element_count != 2)
        return false;
    const struct ply_element *vertices = &header->elements[0], *faces = &header->elements[1];
    const struct ply_property *list = &faces->properties[0];
    if (strcmp(vertices->name, "vertex") != 0 || strcmp(faces->name, "face") != 0 || vertices->list_count ||
        faces->property_count != 1 || faces->list_count != 1 || !vertices->scalar_bytes)
        return false;
    bool corners = strcmp(list->name, "vertex_indices") == 0 || strcmp(list->name, "vertex_index") == 0;
    if (!corners || ply_type_size(list->count_type) != 1 || (list->type != PLY_I32 && list->type != PLY_U32))
        return false;
    size_t body = size - header->body;
    return vertices->count > 0 && faces->count > 0 && vertices->count < UINT32_MAX && faces->count <= TRIANGLES_MAX &&
           vertices->count <= body / vertices->scalar_bytes &&
           faces->count <= (body - vertices->count * vertices->scalar_bytes) / FACE;
}

// Plain positions are read to where they stay; rows with more in them are looked at by column.
static bool load_vertices(struct parts *parts, const struct ply_element *element, struct lam_scene *scene,
                          struct arena *scratch, lam_mesh *mesh)
{
    const struct import_source *source = parts->source;
    struct ply_table table = {.element = element, .count = (size_t)element->count};
    struct ply_request request = {.scalars = true, .list = -1};
    int xyz[3];
    static const char *const names[] = {"x", "y", "z"};
    if (!ply_plan_rows(source, &request, scratch, &table, NULL) || !ply_find_all(&table, names, 3, xyz))
        return false;
    parts->count = table.count;
    parts->stride = table.stride;
    parts->floats = table.stride == 12 && ply_side_by_side(&table, xyz, 3);
    parts->rows = arena_array(parts->floats ? &scene->arena : scratch, table.count, table.stride);
    if (!parts->rows)
        return false;
    pool_run(source->pool, (table.count + PART_VERTICES - 1) / PART_VERTICES, read_vertices, parts);
    if (!still_right(parts))
        return false;
    table.rows = parts->rows;
    mesh->vertex_count = (uint32_t)table.count;
    if (parts->floats) {
        mesh->positions = (const float *)(const void *)parts->rows;
        return true;
    }
    bool far_out;
    if (!ply_positions(source, &table, &scene->arena, mesh, &far_out, NULL) ||
        !ply_normals(source, &table, &scene->arena, &mesh->normals, NULL) ||
        !ply_texcoords(source, &table, &scene->arena, &mesh->texcoords, NULL) ||
        !ply_tangents(source, &table, &scene->arena, &mesh->tangents, NULL) ||
        !ply_colors(source, &table, &scene->arena, &mesh->colors, &mesh->colors_format, NULL))
        return false;
    mesh->normal_count = mesh->normals ? mesh->vertex_count : 0;
    mesh->texcoord_count = mesh->texcoords ? mesh->vertex_count : 0;
    mesh->tangent_count = mesh->tangents ? mesh->vertex_count : 0;
    mesh->color_count = mesh->colors ? mesh->vertex_count : 0;
    return true;
}

static bool load(struct parts *parts, struct lam_scene *scene, struct arena *scratch)
{
    const struct import_source *source = parts->source;
    struct ply_header header;
    lam_mesh mesh = {0};
    if (!ply_read_header(source, scratch, &header, NULL) || !usual(&header, parts->file->size))
        return false;
    const struct ply_element *vertices = &header.elements[0], *faces = &header.elements[1];
    parts->begin = header.body;
    if (!load_vertices(parts, vertices, scene, scratch, &mesh))
        return false;
    parts->begin += (size_t)vertices->count * vertices->scalar_bytes;
    parts->count = (size_t)faces->count;
    parts->limit = mesh.vertex_count;
    parts->indices = arena_array(&scene->arena, parts->count, 3 * sizeof *parts->indices);
    parts->capacity = arena_array(scratch, (size_t)pool_threads(source->pool), PART_FACES * FACE);
    if (!parts->indices || !parts->capacity)
        return false;
    pool_run(source->pool, (parts->count + PART_FACES - 1) / PART_FACES, read_faces, parts);
    if (!still_right(parts))
        return false;
    mesh.indices = parts->indices;
    mesh.triangle_count = (uint32_t)faces->count;
    lam_object object = lam_object_default();
    object.mesh = scene_take_mesh(scene, &mesh, NULL);
    return object.mesh >= 0 && scene_take_object(scene, &object, NULL) >= 0;
}

bool ply_load_parts(const struct import_source *source, const struct file_parts *file, struct lam_scene *scene)
{
    struct arena scratch;
    arena_start(&scratch, source->call);
    struct parts parts = {.source = source, .file = file, .loop = {.call = source->call}};
    bool done = load(&parts, scene, &scratch);
    arena_free(&scratch);
    return done;
}
