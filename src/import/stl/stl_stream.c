// stl_stream.c: large binary STL files without colours, read part by part.
//
// A part is converted while it is in the second-level cache, and the file is never held as a whole. Whatever
// is not so, and whatever is wrong, is left to stl_binary.c.
#include "loop_status.h"
#include "stl.h"

#include <string.h>

enum { PART_FACETS = 4096 };

struct parts {
    const struct file_parts *file;
    struct loop_status loop;
    int wrong;         // touched atomically
    uint8_t *capacity; // PART_FACETS · STL_FACET bytes for each thread
    float *positions;
    size_t count;
};

static void read_facets(void *user, size_t index, int thread)
{
    struct parts *parts = user;
    if (__atomic_load_n(&parts->wrong, __ATOMIC_RELAXED) || !should_continue(&parts->loop))
        return;
    size_t first = index * PART_FACETS, count = parts->count - first;
    count = count < PART_FACETS ? count : PART_FACETS;
    const uint8_t *facet = parts->capacity + (size_t)thread * PART_FACETS * STL_FACET;
    bool read =
        file_read_part(parts->file, STL_FACETS + first * STL_FACET, (uint8_t *)(uintptr_t)facet, count * STL_FACET);
    uint32_t odd = 0; // its top bit: an exponent of all ones was met
    uint16_t words = 0;
    float *out = parts->positions + 9 * first;
    for (size_t i = 0; read && i < count; i++, facet += STL_FACET, out += 9) {
        uint32_t bits[9];
        uint16_t word;
        memcpy(bits, facet + STL_CORNERS, sizeof bits);
        memcpy(out, bits, sizeof bits);
        for (int c = 0; c < 9; c++)
            odd |= (bits[c] & 0x7fffffff) + 0x00800000;
        memcpy(&word, facet + STL_ATTRIBUTE, sizeof word);
        words |= word;
    }
    if (!read || words || odd & 0x80000000)
        __atomic_store_n(&parts->wrong, 1, __ATOMIC_RELAXED);
}

// "COLOR=" in the header: Materialise Magics' colours.
static bool has_color(const uint8_t *header)
{
    for (int at = 0; at + 6 <= STL_HEADER; at++)
        if (memcmp(header + at, "COLOR=", 6) == 0)
            return true;
    return false;
}

bool stl_load_parts(const struct import_source *source, const struct file_parts *file, struct lam_scene *scene)
{
    uint32_t count;
    memcpy(&count, source->bytes + STL_HEADER, sizeof count);
    if (file->size != STL_FACETS + (uint64_t)STL_FACET * count || count > STL_FACETS_MAX || has_color(source->bytes))
        return false;
    struct arena scratch;
    arena_start(&scratch, source->call);
    struct parts parts = {.file = file, .loop = {.call = source->call}, .count = count};
    parts.positions = arena_array(&scene->arena, count, 9 * sizeof(float));
    parts.capacity = arena_array(&scratch, (size_t)pool_threads(source->pool), PART_FACETS * STL_FACET);
    bool done = parts.positions && parts.capacity;
    if (done) {
        pool_run(source->pool, (parts.count + PART_FACETS - 1) / PART_FACETS, read_facets, &parts);
        done = !parts.wrong && should_continue(&parts.loop);
    }
    arena_free(&scratch);
    if (!done)
        return false;
    lam_mesh mesh = {.positions = parts.positions, .vertex_count = 3 * count, .triangle_count = count};
    lam_object object = lam_object_default();
    object.mesh = scene_take_mesh(scene, &mesh, NULL);
    return object.mesh >= 0 && scene_take_object(scene, &object, NULL) >= 0;
}
