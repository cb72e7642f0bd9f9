// obj.c: the OBJ importer: recognises the format and runs the passes over the file (obj.h has the overview).
#include "obj.h"

#include "fail.h"
#include "number.h"
#include "text_cursor.h"

#include <string.h>

// --- recognising the format

static bool first_word_known(const uint8_t *at, const uint8_t *end)
{
    static const char *const words[] = {"v", "vt", "vn", "vp", "f", "g", "o", "s", "l", "p", "mtllib", "usemtl"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (text_is_word(at, end, words[i]))
            return true;
    }
    return false;
}

// The format is certain if all of the first statements are known and one of them occurs in no other format, or if three
// of the first thousand statements are vertices.
static int obj_probe(const uint8_t *bytes, size_t size, size_t file_size)
{
    (void)file_size;
    enum { STATEMENTS = 32, STATEMENTS_SEARCHED = 1000, VERTICES = 3 };
    const uint8_t *at = bytes, *end = bytes + (size < FILE_HEAD ? size : FILE_HEAD);
    if (memchr(bytes, 0, (size_t)(end - bytes)))
        return 0;
    if (end - at >= 3 && memcmp(at, "\xef\xbb\xbf", 3) == 0) // a byte order mark
        at += 3;
    int known = 0, unknown = 0, vertices = 0;
    bool typical = false, comments = false;
    while (at < end && known + unknown < (unknown && vertices < VERTICES ? STATEMENTS_SEARCHED : STATEMENTS)) {
        const uint8_t *stop = text_line_end(at, end);
        at = text_skip_white(at, stop);
        if (at < stop && *at == '#') {
            comments = true;
        } else if (at < stop) {
            bool is_known = first_word_known(at, stop);
            known += is_known;
            unknown += !is_known;
            float number;
            const uint8_t *second = text_skip_white(text_skip_word(at, stop), stop);
            bool vertex = text_is_word(at, stop, "v") && number_float(second, stop, &number);
            vertices += vertex;
            typical |= vertex || text_is_word(at, stop, "mtllib") || text_is_word(at, stop, "usemtl");
        }
        at = stop < end ? stop + 1 : stop;
    }
    if (unknown == 0 || vertices >= VERTICES)
        return typical ? 2 : known > 0 || comments;
    return typical && known > unknown; // possibly OBJ: unknown statements among known statements
}

// --- reading

static bool alloc_array(struct obj *obj, struct arena *arena, void *out, uint64_t count, size_t size, lam_error *error)
{
    void *array = arena_array(arena, (size_t)count, size);
    if (!array)
        return call_memory_error(obj->source->call, (size_t)count * size, error);
    memcpy(out, &array, sizeof array);
    return true;
}

static bool alloc_arrays(struct obj *obj, lam_error *error)
{
    struct arena *kept = &obj->scene->arena, *scratch = &obj->memory;
    const struct obj_counts *total = &obj->total;
    uint64_t corners = 3 * total->triangles;
    return alloc_array(obj, kept, &obj->positions, 3 * total->positions, sizeof(float), error) &&
           alloc_array(obj, kept, &obj->indices, corners, sizeof(uint32_t), error) &&
           alloc_array(obj, scratch, &obj->polygons, total->polygons, sizeof *obj->polygons, error) &&
           alloc_array(obj, scratch, &obj->statements, total->others, sizeof *obj->statements, error) &&
           (!obj->colors_present || alloc_array(obj, kept, &obj->colors, 4 * total->positions, sizeof(float), error)) &&
           (!total->texcoords || (alloc_array(obj, kept, &obj->texcoords, 2 * total->texcoords, sizeof(float), error) &&
                                  alloc_array(obj, kept, &obj->texcoord_indices, corners, sizeof(uint32_t), error))) &&
           (!total->normals || (alloc_array(obj, kept, &obj->normals, 3 * total->normals, sizeof(float), error) &&
                                alloc_array(obj, kept, &obj->normal_indices, corners, sizeof(uint32_t), error)));
}

// Old Macintosh programs end lines with '\r' only: such a file is copied with '\n' instead of '\r'.
static bool convert_line_ends(struct obj *obj, lam_error *error)
{
    size_t size = (size_t)(obj->end - obj->begin);
    if (size == 0 || memchr(obj->begin, '\n', size) || !memchr(obj->begin, '\r', size))
        return true;
    uint8_t *copy = arena_alloc(&obj->memory, size + FILE_PADDING);
    if (!copy)
        return call_memory_error(obj->source->call, size, error);
    for (size_t i = 0; i < size; i++)
        copy[i] = obj->begin[i] == '\r' ? '\n' : obj->begin[i];
    memset(copy + size, 0, FILE_PADDING);
    obj->begin = copy;
    obj->end = copy + size;
    return true;
}

static bool load(struct obj *obj, size_t chunk_bytes, lam_error *error)
{
    struct call_control *call = obj->source->call;
    if (!convert_line_ends(obj, error) || !obj_split(obj, chunk_bytes, error) || !obj_scan(obj, error) ||
        !alloc_arrays(obj, error))
        return false;
    call_progress(call, 0.2, "read");
    const struct color_range ranges[2] = {{1, 1}, {0, 0}};
    return obj_parse(obj, error) && obj_find_origin(obj, error) &&
           (!obj->colors ||
            mesh_convert_colors(obj->source, obj->scene, obj->colors, (size_t)obj->total.positions, ranges, error)) &&
           obj_complete(obj, error);
}

static void start(struct obj *obj, const struct import_source *source, struct lam_scene *scene)
{
    *obj = (struct obj){.source = source, .scene = scene, .begin = source->bytes, .end = source->bytes + source->size};
    if (source->size >= 3 && memcmp(obj->begin, "\xef\xbb\xbf", 3) == 0) // a byte order mark
        obj->begin += 3;
    arena_start(&obj->memory, source->call);
    obj->materials.by_name.memory = obj->libraries.tried.memory = &obj->memory;
}

bool obj_load_chunked(const struct import_source *source, struct lam_scene *scene, size_t chunk_bytes, lam_error *error)
{
    struct obj obj;
    start(&obj, source, scene);
    bool ok = load(&obj, chunk_bytes, error);
    arena_free(&obj.memory);
    return ok;
}

static bool obj_load(struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    struct obj obj;
    start(&obj, source, scene);
    bool streamed = source->size < source->parts.size && obj_read_stream(&obj);
    bool ok = streamed && obj_complete(&obj, error);
    arena_free(&obj.memory);
    return streamed ? ok : import_whole(source, error) && obj_load_chunked(source, scene, OBJ_CHUNK, error);
}

const struct importer importer_obj = {
    .name = "obj",
    .extensions = "obj",
    .up = LAM_UP_Y,
    .up_is_habit = true,
    .probe = obj_probe,
    .load = obj_load,
};
