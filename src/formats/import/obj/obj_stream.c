// obj_stream.c: reads large OBJ files chunk by chunk.
//
// Each thread reads a chunk of the text and parses it into scratch arrays, all within the second-level cache. Once the
// previous chunks are counted, the thread knows the indices of its elements and copies the elements to the final
// arrays. The text is thus read once, and the file is never in memory as a whole. The final arrays reserve the address
// space that a file of this size could fill; untouched pages are released. obj.c reads the whole text of all other
// files: files with vertex colours, relative indices, a mix of corners with and without normals, text lines longer than
// TAIL, or errors.
#include "loop_status.h"
#include "obj.h"
#include "origin.h"
#include "pages.h"

#include <sched.h>
#include <stdlib.h>
#include <string.h>

enum {
    TAIL = THRESHOLD(16 << 10, 256),  // bytes read after a chunk, for its last line
    STATEMENTS = THRESHOLD(4096, 16), // the maximum number of statements per chunk
    COUNT_MAX = UINT32_MAX - 1,       // the maximum number of elements of a kind
    SMALL_FILE =
        THRESHOLD(16 << 20, 8 << 10), // smaller files use small pages, because their arrays fill few huge pages
};

enum array { POSITIONS, TEXCOORDS, NORMALS, CORNERS, CORNER_TEXCOORDS, CORNER_NORMALS, POLYGONS, ARRAYS };
static const struct {
    size_t line; // bytes of the shortest line of this kind
    size_t row;  // bytes per element in the array
} array_kinds[ARRAYS] = {
    [POSITIONS] = {8, 12}, // "v 0 0 0"
    [TEXCOORDS] = {5, 8},  // "vt 0"
    [NORMALS] = {9, 12},   // "vn 0 0 0"
    [CORNERS] = {8, 12},   // "f 1 1 1"; a larger polygon with such short indices fails the capacity check
    [CORNER_TEXCOORDS] = {8, 12}, [CORNER_NORMALS] = {8, 12}, [POLYGONS] = {10, sizeof(struct mesh_polygon)},
};

// A thread's scratch memory.
struct chunk_scratch {
    struct obj obj; // refers to the arrays below while a chunk is parsed
    uint8_t *text;
    size_t offset; // of the text in the file
    void *arrays[ARRAYS];
    struct obj_statement statements[STATEMENTS];
    bool texcoords, normals; // whether faces use texture coordinates, and whether they use normals
    uint32_t index_max[3];   // the largest indices in the faces: of positions, texture coordinates and normals
};

struct stream {
    struct obj *obj;
    size_t size; // of the file
    struct loop_status loop;
    int unsupported; // atomic; set if obj.c must read the file instead
    struct chunk_scratch *scratch;
    uint8_t *scratch_memory; // of all threads
    size_t scratch_bytes;    // counted towards the call's memory limit
    uint8_t *arrays[ARRAYS];
    size_t reserved[ARRAYS], reserved_marks;
    uint8_t *marks;    // mesh_mark_vertices
    size_t next_chunk; // atomic; the next chunk to count. Only the thread of that chunk accesses the members below.
    struct obj_counts total;
    size_t charged;
    int layout; // 0 before the first face; then 1, plus 1 if faces have texture coordinates, plus 2 for normals
    float low[3], high[3];
    struct obj_statement *statements; // `at` is set at the end
    uint8_t *texts;                   // the texts of the statements, concatenated
    size_t statements_capacity, texts_used, texts_capacity;
};

static bool stream_continues(struct stream *stream)
{
    return !__atomic_load_n(&stream->unsupported, __ATOMIC_RELAXED) && should_continue(&stream->loop);
}

static bool is_small(const struct stream *stream) { return stream->size < SMALL_FILE; }

static uint64_t count_of(const struct obj_counts *counts, enum array kind)
{
    return kind == POSITIONS   ? counts->positions
           : kind == TEXCOORDS ? counts->texcoords
           : kind == NORMALS   ? counts->normals
           : kind == POLYGONS  ? counts->polygons
                               : counts->triangles;
}

static size_t rows_max(enum array kind, size_t bytes) { return bytes / array_kinds[kind].line + 1; }

// --- one chunk

// Reads the complete lines that begin in the chunk.
static bool read_text(const struct stream *stream, struct chunk_scratch *scratch, size_t index, struct obj_chunk *chunk)
{
    const struct import_source *source = stream->obj->source;
    size_t size = stream->size, nominal = index * OBJ_CHUNK, from = index ? nominal - 1 : 0;
    size_t to = size - nominal < OBJ_CHUNK + TAIL ? size : nominal + OBJ_CHUNK + TAIL;
    uint8_t *text = scratch->text, *end = text + (to - from);
    if (!file_read_part(&source->parts, source->name, from, text, to - from, NULL))
        return false;
    scratch->offset = from;
    memset(end, 0, FILE_PADDING);
    const uint8_t *first = text, *last = end;
    if (index) {
        first = memchr(text, '\n', (size_t)(end - text));
        first = first ? first + 1 : end;
    } else if (memcmp(text, "\xef\xbb\xbf", 3) == 0) { // a byte order mark
        first += 3;
    }
    if (size - nominal > OBJ_CHUNK) {
        const uint8_t *edge = text + (nominal + OBJ_CHUNK - 1 - from);
        last = memchr(edge, '\n', (size_t)(end - edge));
        if (!last && to < size)
            return false;
        last = last ? last + 1 : end;
    }
    if (first > last)
        return false;
    // The last line may continue in the next chunk.
    if (last - first >= 3 && (last[-2] == '\\' || last[-3] == '\\'))
        return false;
    *chunk = (struct obj_chunk){.begin = first, .end = last};
    return true;
}

static bool parse(struct chunk_scratch *scratch, struct obj_chunk *chunk)
{
    struct obj *obj = &scratch->obj;
    const struct obj_chunk unread = *chunk;
    obj->begin = chunk->begin;
    obj->end = chunk->end;
    for (;;) {
        *chunk = unread;
        chunk->counts = (struct obj_counts){
            .positions = rows_max(POSITIONS, OBJ_CHUNK),
            .texcoords = rows_max(TEXCOORDS, OBJ_CHUNK),
            .normals = rows_max(NORMALS, OBJ_CHUNK),
            .triangles = rows_max(CORNERS, OBJ_CHUNK),
            .polygons = rows_max(POLYGONS, OBJ_CHUNK),
            .others = STATEMENTS,
        };
        obj->texcoord_indices = scratch->texcoords ? scratch->arrays[CORNER_TEXCOORDS] : NULL;
        obj->normal_indices = scratch->normals ? scratch->arrays[CORNER_NORMALS] : NULL;
        if (!obj_parse_chunk(obj, chunk, NULL))
            return false;
        if (!chunk->texcoord_unknown && !chunk->normal_unknown)
            break;
        // these are the thread's first faces with texture coordinates or normals, so the chunk is parsed again with
        // these indices
        scratch->texcoords |= chunk->texcoord_unknown;
        scratch->normals |= chunk->normal_unknown;
    }
    return !chunk->colors && !chunk->short_faces && !chunk->nonfinite_numbers &&
           !(scratch->texcoords && chunk->texcoord_missing) && !(scratch->normals && chunk->normal_missing);
}

// --- copying a chunk to the final arrays

static bool grow(struct arena *arena, void *array, size_t *capacity, size_t used, size_t more, size_t item)
{
    if (used + more <= *capacity)
        return true;
    size_t wanted = 2 * (used + more) + 1024;
    void *old, *larger = arena_array(arena, wanted, item);
    if (!larger)
        return false;
    memcpy(&old, array, sizeof old);
    if (used)
        memcpy(larger, old, used * item);
    memcpy(array, &larger, sizeof larger);
    *capacity = wanted;
    return true;
}

static bool append_statements(struct stream *stream, const struct chunk_scratch *scratch, uint64_t count,
                              const struct obj_counts *before)
{
    struct arena *memory = &stream->obj->memory;
    size_t kept = (size_t)stream->total.others;
    if (!grow(memory, &stream->statements, &stream->statements_capacity, kept, (size_t)count,
              sizeof *stream->statements))
        return false;
    for (uint64_t i = 0; i < count; i++) {
        const uint8_t *at = scratch->statements[i].at;
        size_t length = (size_t)(obj_next_line(at, scratch->obj.end) - at);
        if (!grow(memory, &stream->texts, &stream->texts_capacity, stream->texts_used, length + 1 + FILE_PADDING, 1))
            return false;
        struct obj_statement *statement = &stream->statements[kept + i];
        *statement = scratch->statements[i];
        statement->offset = scratch->offset + (size_t)(at - scratch->text);
        statement->triangle += (uint32_t)before->triangles;
        statement->positions += (uint32_t)before->positions;
        statement->texcoords += (uint32_t)before->texcoords;
        memcpy(stream->texts + stream->texts_used, at, length);
        stream->texts_used += length;
    }
    return true;
}

// Waits until the previous chunks are counted, then adds the chunk's counts to the totals. *before receives the totals
// of the previous chunks.
static bool count_chunk(struct stream *stream, struct chunk_scratch *scratch, size_t index,
                        const struct obj_chunk *chunk, struct obj_counts *before)
{
    while (__atomic_load_n(&stream->next_chunk, __ATOMIC_ACQUIRE) != index) {
        if (!stream_continues(stream))
            return false;
        sched_yield();
    }
    const struct obj_counts *counts = &chunk->counts;
    struct obj_counts *total = &stream->total;
    *before = *total;
    int layout = 1 + scratch->texcoords + 2 * scratch->normals;
    if (counts->triangles) {
        if (stream->layout && stream->layout != layout)
            return false;
        stream->layout = layout;
    }
    if (counts->others && !append_statements(stream, scratch, counts->others, before))
        return false;
    total->positions += counts->positions;
    total->texcoords += counts->texcoords;
    total->normals += counts->normals;
    total->triangles += counts->triangles;
    total->polygons += counts->polygons;
    total->others += counts->others;
    size_t bytes = 0;
    for (enum array kind = 0; kind < ARRAYS; kind++) {
        if (count_of(total, kind) > rows_max(kind, stream->size))
            return false;
        bytes += (size_t)count_of(counts, kind) * array_kinds[kind].row;
    }
    if (!call_charge(stream->loop.call, bytes))
        return false;
    stream->charged += bytes;
    for (int i = 0; i < 3; i++) {
        stream->low[i] = chunk->low[i] < stream->low[i] ? chunk->low[i] : stream->low[i];
        stream->high[i] = chunk->high[i] > stream->high[i] ? chunk->high[i] : stream->high[i];
    }
    __atomic_store_n(&stream->next_chunk, index + 1, __ATOMIC_RELEASE);
    return true;
}

static void copy_corners(const struct stream *stream, struct chunk_scratch *scratch, enum array kind, uint64_t first,
                         const struct obj_counts *counts)
{
    uint32_t *from = scratch->arrays[kind];
    // A polygon of n corners leaves 2 n - 6 indices unset until it is divided into triangles.
    const struct mesh_polygon *polygons = scratch->arrays[POLYGONS];
    for (size_t i = 0; i < counts->polygons; i++)
        memset(from + 3 * (size_t)polygons[i].first_triangle + polygons[i].count, 0,
               (2 * (size_t)polygons[i].count - 6) * sizeof *from);
    uint32_t *to = (uint32_t *)(void *)stream->arrays[kind] + 3 * first;
    uint32_t index_max = scratch->index_max[kind - CORNERS];
    for (size_t i = 0; i < 3 * counts->triangles; i++) {
        index_max = from[i] > index_max ? from[i] : index_max;
        to[i] = from[i];
    }
    scratch->index_max[kind - CORNERS] = index_max;
}

static void copy_chunk(const struct stream *stream, struct chunk_scratch *scratch, const struct obj_counts *counts,
                       const struct obj_counts *before)
{
    for (enum array kind = 0; is_small(stream) && kind < ARRAYS; kind++)
        pages_prepare(stream->arrays[kind] + count_of(before, kind) * array_kinds[kind].row,
                      (size_t)count_of(counts, kind) * array_kinds[kind].row);
    for (enum array kind = POSITIONS; kind <= NORMALS; kind++)
        memcpy(stream->arrays[kind] + count_of(before, kind) * array_kinds[kind].row, scratch->arrays[kind],
               (size_t)count_of(counts, kind) * array_kinds[kind].row);
    copy_corners(stream, scratch, CORNERS, before->triangles, counts);
    if (scratch->index_max[0] < rows_max(POSITIONS, stream->size)) // a larger index is wrong
        mesh_mark_vertices(scratch->arrays[CORNERS], 3 * counts->triangles, stream->marks);
    if (scratch->texcoords)
        copy_corners(stream, scratch, CORNER_TEXCOORDS, before->triangles, counts);
    if (scratch->normals)
        copy_corners(stream, scratch, CORNER_NORMALS, before->triangles, counts);
    const struct mesh_polygon *from = scratch->arrays[POLYGONS];
    struct mesh_polygon *to = (struct mesh_polygon *)(void *)stream->arrays[POLYGONS] + before->polygons;
    for (size_t i = 0; i < counts->polygons; i++)
        to[i] = (struct mesh_polygon){(uint32_t)before->triangles + from[i].first_triangle, from[i].count};
}

static void load_chunk(void *user, size_t index, int thread)
{
    struct stream *stream = user;
    struct chunk_scratch *scratch = &stream->scratch[thread];
    struct obj_chunk chunk;
    struct obj_counts before;
    if (!stream_continues(stream))
        return;
    if (read_text(stream, scratch, index, &chunk) && parse(scratch, &chunk) &&
        count_chunk(stream, scratch, index, &chunk, &before))
        copy_chunk(stream, scratch, &chunk.counts, &before);
    else
        __atomic_store_n(&stream->unsupported, 1, __ATOMIC_RELAXED);
}

// --- all chunks

static bool alloc_scratch(struct stream *stream)
{
    struct obj *obj = stream->obj;
    size_t threads = (size_t)pool_threads(obj->source->pool), heads = threads * sizeof *stream->scratch;
    size_t text = OBJ_CHUNK + TAIL + FILE_PADDING, bytes = text;
    for (enum array kind = 0; kind < ARRAYS; kind++)
        bytes += (rows_max(kind, OBJ_CHUNK) + 1) * array_kinds[kind].row / 64 * 64 + 64;
    // The memory of one thread is counted, so that the number of threads does not decide whether the call succeeds.
    if (!call_charge(stream->loop.call, bytes + sizeof *stream->scratch))
        return false;
    stream->scratch_bytes = bytes + sizeof *stream->scratch;
    uint8_t *memory = stream->scratch_memory = pages_malloc(threads * bytes + heads); // the picture may use it later
    if (!memory)
        return false;
    stream->scratch = memset(memory + threads * bytes, 0, heads);
    for (size_t t = 0; t < threads; t++) {
        struct chunk_scratch *scratch = &stream->scratch[t];
        scratch->text = memory;
        memory += text;
        for (enum array kind = 0; kind < ARRAYS; kind++) {
            scratch->arrays[kind] = memory;
            memory += (rows_max(kind, OBJ_CHUNK) + 1) * array_kinds[kind].row / 64 * 64 + 64;
        }
        scratch->obj = (struct obj){
            .source = obj->source,
            .streamed = true,
            .total = {.positions = COUNT_MAX, .texcoords = COUNT_MAX, .normals = COUNT_MAX},
            .positions = scratch->arrays[POSITIONS],
            .texcoords = scratch->arrays[TEXCOORDS],
            .normals = scratch->arrays[NORMALS],
            .indices = scratch->arrays[CORNERS],
            .polygons = scratch->arrays[POLYGONS],
            .statements = scratch->statements,
        };
    }
    return true;
}

static bool reserve_arrays(struct stream *stream)
{
    for (enum array kind = 0; kind < ARRAYS; kind++) {
        size_t bytes = rows_max(kind, stream->size) * array_kinds[kind].row;
        stream->arrays[kind] = (is_small(stream) ? pages_get_sparse : pages_get)(bytes, &stream->reserved[kind]);
        if (!stream->arrays[kind])
            return false;
    }
    stream->marks = pages_get_sparse(rows_max(POSITIONS, stream->size), &stream->reserved_marks);
    return stream->marks != NULL;
}

// Returns whether all indices in the faces refer to existing elements, and whether the counts are in range.
static bool indices_valid(const struct stream *stream)
{
    const struct obj_counts *total = &stream->total;
    const uint64_t limits[3] = {total->positions, total->texcoords, total->normals};
    const bool named[3] = {true, (stream->layout - 1) & 1, (stream->layout - 1) & 2};
    for (int t = 0; t < pool_threads(stream->obj->source->pool); t++) {
        for (int k = 0; k < 3; k++) {
            if (named[k] && stream->scratch[t].index_max[k] >= limits[k])
                return false;
        }
    }
    return total->triangles > 0 && total->positions < COUNT_MAX && total->triangles <= UINT32_MAX / 3 &&
           total->triangles <= call_triangle_limit(stream->obj->source->call);
}

// Releases the unused end of the array and transfers its ownership to the arena. Returns NULL if memory runs out.
static void *pass_to_arena(struct stream *stream, enum array kind, struct arena *arena)
{
    size_t bytes = (size_t)count_of(&stream->total, kind) * array_kinds[kind].row;
    pages_trim(stream->arrays[kind], &stream->reserved[kind], bytes);
    if (!call_charge(stream->loop.call, bytes))
        return NULL;
    if (!arena_adopt(arena, stream->arrays[kind], stream->reserved[kind],
                     stream->loop.call == arena->call ? bytes : 0)) {
        call_refund(stream->loop.call, bytes);
        return NULL;
    }
    stream->reserved[kind] = 0;
    return stream->arrays[kind];
}

static bool pass_arrays(struct stream *stream)
{
    struct obj *obj = stream->obj;
    struct arena *kept = &obj->scene->arena;
    bool texcoords = (stream->layout - 1) & 1, normals = (stream->layout - 1) & 2;
    call_refund(stream->loop.call, stream->charged);
    stream->charged = 0;
    obj->total = stream->total;
    obj->positions = pass_to_arena(stream, POSITIONS, kept);
    obj->indices = pass_to_arena(stream, CORNERS, kept);
    obj->polygons = pass_to_arena(stream, POLYGONS, &obj->memory);
    bool done = obj->positions && obj->indices && obj->polygons;
    if (texcoords) {
        obj->texcoord_indices = pass_to_arena(stream, CORNER_TEXCOORDS, kept);
        done = done && obj->texcoord_indices;
    }
    if (texcoords || (stream->total.texcoords && stream->total.others)) { // lines may use them
        obj->texcoords = pass_to_arena(stream, TEXCOORDS, kept);
        done = done && obj->texcoords;
    }
    if (normals) {
        obj->normals = pass_to_arena(stream, NORMALS, kept);
        obj->normal_indices = pass_to_arena(stream, CORNER_NORMALS, kept);
        done = done && obj->normals && obj->normal_indices;
    }
    size_t count = (size_t)stream->total.others;
    obj->statements = stream->statements;
    if (!done || count == 0)
        return done;
    const uint8_t *at = stream->texts;
    for (size_t i = 0; i < count; at = obj_next_line(at, stream->texts + stream->texts_used), i++)
        obj->statements[i].at = at;
    memset(stream->texts + stream->texts_used, 0, FILE_PADDING);
    obj->begin = stream->texts;
    obj->end = stream->texts + stream->texts_used;
    return true;
}

static bool fits_floats(const struct stream *stream)
{
    double low[3], high[3], origin[3];
    for (int i = 0; i < 3; i++) {
        low[i] = (double)stream->low[i];
        high[i] = (double)stream->high[i];
    }
    return !origin_choose(low, high, origin);
}

static bool load(struct stream *stream)
{
    struct obj *obj = stream->obj;
    if (!PAGES_WHEN_TOUCHED || !alloc_scratch(stream) || !reserve_arrays(stream))
        return false;
    for (int i = 0; i < 3; i++) {
        stream->low[i] = __FLT_MAX__;
        stream->high[i] = -__FLT_MAX__;
    }
    pool_run(obj->source->pool, (stream->size + OBJ_CHUNK - 1) / OBJ_CHUNK, load_chunk, stream);
    obj->chunks = arena_alloc_zeroed(&obj->memory, sizeof *obj->chunks);
    if (!stream_continues(stream) || !indices_valid(stream) || !fits_floats(stream) || !obj->chunks ||
        !pass_arrays(stream))
        return false;
    // The memory for the triangles of a polygon also contains numbers that are not corners of the polygon.
    obj->scene->first_all_used = !stream->total.polygons && !memchr(stream->marks, 0, stream->total.positions);
    obj->chunks->texcoord_used = obj->texcoord_indices != NULL;
    obj->chunks->normal_used = obj->normals != NULL;
    obj->chunk_count = 1;
    return true;
}

bool obj_read_stream(struct obj *obj)
{
    struct call_control *call = obj->source->call;
    struct stream stream = {.obj = obj, .size = obj->source->parts.size, .loop = {.call = call}};
    obj->streamed = true;
    bool done = load(&stream);
    for (enum array kind = 0; kind < ARRAYS; kind++) {
        if (stream.reserved[kind])
            pages_free(stream.arrays[kind], stream.reserved[kind]);
    }
    if (stream.reserved_marks)
        pages_free(stream.marks, stream.reserved_marks);
    free(stream.scratch_memory);
    call_refund(call, stream.charged + stream.scratch_bytes);
    return done;
}
