// stl_stream.c: reads large binary STL files without colours in parts.
//
// A part is converted while it is in the second-level cache, and the file is never in memory as a whole. stl_binary.c
// reads files with colours and files with errors.
#include "loop_status.h"
#include "stl.h"

#include <string.h>

enum { PART_FACETS = 4096 };

struct stream {
    const struct file_parts *file;
    struct loop_status loop;
    int unsupported;  // atomic; stl_binary.c must read the file
    uint8_t *buffers; // PART_FACETS · STL_FACET bytes per thread
    float *positions;
    size_t count;
};

static void read_facets(void *user, size_t index, int thread)
{
    struct stream *stream = user;
    if (__atomic_load_n(&stream->unsupported, __ATOMIC_RELAXED) || !should_continue(&stream->loop))
        return;
    size_t first = index * PART_FACETS, count = stream->count - first;
    count = count < PART_FACETS ? count : PART_FACETS;
    const uint8_t *facet = stream->buffers + (size_t)thread * PART_FACETS * STL_FACET;
    bool read =
        file_read_part(stream->file, STL_FACETS + first * STL_FACET, (uint8_t *)(uintptr_t)facet, count * STL_FACET);
    uint32_t nonfinite = 0; // bit 31: a number is NaN or infinite
    uint16_t words = 0;
    float *out = stream->positions + 9 * first;
    for (size_t i = 0; read && i < count; i++, facet += STL_FACET, out += 9) {
        uint32_t bits[9];
        uint16_t word;
        memcpy(bits, facet + STL_CORNERS, sizeof bits);
        memcpy(out, bits, sizeof bits);
        for (int c = 0; c < 9; c++)
            nonfinite |= (bits[c] & 0x7fffffff) + 0x00800000;
        memcpy(&word, facet + STL_ATTRIBUTE, sizeof word);
        words |= word;
    }
    if (!read || words || nonfinite & 0x80000000)
        __atomic_store_n(&stream->unsupported, 1, __ATOMIC_RELAXED);
}

// Returns whether the header contains "COLOR=": colours of Materialise Magics.
static bool has_color(const uint8_t *header)
{
    for (int at = 0; at + 6 <= STL_HEADER; at++)
        if (memcmp(header + at, "COLOR=", 6) == 0)
            return true;
    return false;
}

bool stl_load_stream(const struct import_source *source, const struct file_parts *file, struct lam_scene *scene)
{
    uint32_t count;
    memcpy(&count, source->bytes + STL_HEADER, sizeof count);
    if (file->size != STL_FACETS + (uint64_t)STL_FACET * count || !stl_check_count(source, count, NULL) ||
        has_color(source->bytes))
        return false;
    struct arena scratch;
    arena_start(&scratch, source->call);
    struct stream stream = {.file = file, .loop = {.call = source->call}, .count = count};
    stream.positions = arena_array(&scene->arena, count, 9 * sizeof(float));
    stream.buffers = arena_array(&scratch, (size_t)pool_threads(source->pool), PART_FACETS * STL_FACET);
    bool done = stream.positions && stream.buffers;
    if (done) {
        pool_run(source->pool, (stream.count + PART_FACETS - 1) / PART_FACETS, read_facets, &stream);
        done = !stream.unsupported && should_continue(&stream.loop);
    }
    arena_free(&scratch);
    if (!done)
        return false;
    lam_mesh mesh = {.positions = stream.positions, .vertex_count = 3 * count, .triangle_count = count};
    lam_object object = lam_object_default();
    object.mesh = scene_adopt_mesh(scene, &mesh, NULL);
    return object.mesh >= 0 && scene_adopt_object(scene, &object, NULL) >= 0;
}
