// ply_stream.c: reads large PLY files of the usual layout in parts: binary, little-endian, vertices without lists, then
// faces with one list of three corners each.
//
// A part is converted while it is in the second-level cache, and the file is never in memory as a whole, which halves
// memory and memory traffic. ply.c reads files of other layouts and files with errors.
#include "loop_status.h"
#include "ply_load.h"

enum {
    FACE = 13, // bytes: a count, and three 32-bit corners
    PART_FACES = 8192,
    PART_VERTICES = 16384,
    TRIANGLES_MAX = 1431655765, // same as in ply_faces.c
};

struct stream {
    const struct import_source *source;
    const struct file_parts *file;
    struct loop_status loop;
    int unsupported;  // atomic; ply.c must read the file
    size_t begin;     // the start of the element in the file
    uint8_t *buffers; // PART_FACES · FACE bytes per thread
    // Vertices
    uint8_t *rows;
    size_t count, stride;
    bool floats; // rows are x y z as floats, which must be finite
    // Faces
    uint32_t *indices;
    uint32_t limit;
};

static bool stream_continues(struct stream *stream)
{
    return !__atomic_load_n(&stream->unsupported, __ATOMIC_RELAXED) && should_continue(&stream->loop);
}

static void set_unsupported(struct stream *stream) { __atomic_store_n(&stream->unsupported, 1, __ATOMIC_RELAXED); }

static void read_vertices(void *user, size_t index, int thread)
{
    (void)thread;
    struct stream *stream = user;
    if (!stream_continues(stream))
        return;
    size_t first = index * PART_VERTICES, count = stream->count - first;
    count = count < PART_VERTICES ? count : PART_VERTICES;
    uint8_t *to = stream->rows + first * stream->stride;
    if (!file_read_part(stream->file, "", stream->begin + first * stream->stride, to, count * stream->stride, NULL))
        set_unsupported(stream);
    uint32_t nonfinite = 0; // bit 31: a number is NaN or infinite
    for (size_t i = 0; stream->floats && i < count * stream->stride; i += 4)
        nonfinite |= (ply_load_32(to + i, false) & 0x7fffffff) + 0x00800000;
    if (nonfinite & 0x80000000)
        set_unsupported(stream);
}

static void read_faces(void *user, size_t index, int thread)
{
    struct stream *stream = user;
    if (!stream_continues(stream))
        return;
    size_t first = index * PART_FACES, count = stream->count - first;
    count = count < PART_FACES ? count : PART_FACES;
    uint8_t *at = stream->buffers + (size_t)thread * PART_FACES * FACE;
    if (!file_read_part(stream->file, "", stream->begin + first * FACE, at, count * FACE, NULL)) {
        set_unsupported(stream);
        return;
    }
    uint32_t *out = stream->indices + 3 * first, limit = stream->limit, other = 0, beyond = 0;
    for (size_t i = 0; i < count; i++, at += FACE, out += 3) {
        uint32_t three[3];
        memcpy(three, at + 1, sizeof three);
        memcpy(out, three, sizeof three);
        other |= at[0] ^ 3u;
        beyond |= (three[0] >= limit) | (three[1] >= limit) | (three[2] >= limit);
    }
    if (other || beyond)
        set_unsupported(stream);
}

// Returns whether the header declares the usual layout and the file has its bytes.
static bool has_usual_layout(const struct ply_header *header, size_t size, const struct call_control *call)
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
           faces->count <= call_triangle_limit(call) && vertices->count <= body / vertices->scalar_bytes &&
           faces->count <= (body - vertices->count * vertices->scalar_bytes) / FACE;
}

// Rows that contain only positions are read directly into the mesh; other rows are converted column by column.
static bool load_vertices(struct stream *stream, const struct ply_element *element, struct lam_scene *scene,
                          struct arena *scratch, lam_mesh *mesh)
{
    const struct import_source *source = stream->source;
    struct ply_table table = {.element = element, .count = (size_t)element->count};
    struct ply_request request = {.scalars = true, .list = -1};
    int xyz[3];
    static const char *const names[] = {"x", "y", "z"};
    if (!ply_plan_rows(source, &request, scratch, &table, NULL) || !ply_find_all(&table, names, 3, xyz))
        return false;
    stream->count = table.count;
    stream->stride = table.stride;
    stream->floats = table.stride == 12 && ply_contiguous(&table, xyz, 3);
    stream->rows = arena_array(stream->floats ? &scene->arena : scratch, table.count, table.stride);
    if (!stream->rows)
        return false;
    pool_run(source->pool, (table.count + PART_VERTICES - 1) / PART_VERTICES, read_vertices, stream);
    if (!stream_continues(stream))
        return false;
    table.rows = stream->rows;
    mesh->vertex_count = (uint32_t)table.count;
    if (stream->floats) {
        mesh->positions = (const float *)(const void *)stream->rows;
        return true;
    }
    bool needs_doubles;
    if (!ply_positions(source, &table, &scene->arena, mesh, &needs_doubles, NULL) ||
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

static bool load(struct stream *stream, struct lam_scene *scene, struct arena *scratch)
{
    const struct import_source *source = stream->source;
    struct ply_header header;
    lam_mesh mesh = {0};
    if (!ply_read_header(source, scratch, &header, NULL) ||
        !has_usual_layout(&header, stream->file->size, source->call))
        return false;
    ply_warn_header(source, scene, &header);
    const struct ply_element *vertices = &header.elements[0], *faces = &header.elements[1];
    stream->begin = header.body;
    if (!load_vertices(stream, vertices, scene, scratch, &mesh))
        return false;
    stream->begin += (size_t)vertices->count * vertices->scalar_bytes;
    stream->count = (size_t)faces->count;
    stream->limit = mesh.vertex_count;
    stream->indices = arena_array(&scene->arena, stream->count, 3 * sizeof *stream->indices);
    stream->buffers = arena_array(scratch, (size_t)pool_threads(source->pool), PART_FACES * FACE);
    if (!stream->indices || !stream->buffers)
        return false;
    pool_run(source->pool, (stream->count + PART_FACES - 1) / PART_FACES, read_faces, stream);
    if (!stream_continues(stream))
        return false;
    mesh.indices = stream->indices;
    mesh.triangle_count = (uint32_t)faces->count;
    lam_object object = lam_object_default();
    object.mesh = scene_adopt_mesh(scene, &mesh, NULL);
    return object.mesh >= 0 && scene_adopt_object(scene, &object, NULL) >= 0;
}

bool ply_load_stream(const struct import_source *whole, struct lam_scene *scene)
{
    struct import_source head = *whole, *source = &head;
    head.size = FILE_HEAD;
    struct arena scratch;
    arena_start(&scratch, source->call);
    struct stream stream = {.source = source, .file = source->parts, .loop = {.call = source->call}};
    bool done = load(&stream, scene, &scratch);
    arena_free(&scratch);
    return done;
}
