// obj_stream.c: large OBJ files, read piece by piece.
//
// A thread reads a piece of the text into a room of its own and makes numbers of it there, all within the
// second-level cache; when the pieces before it are counted, it knows their places and copies them there. So
// the text is looked at once, and the file is never held as a whole. The arrays get as much address space as
// a file of this size could fill; what was not touched goes back.
// Files that say one thing in several ways (colours, corners with and without normals, counting back, lines
// longer than TAIL), and whatever is wrong or is to be warned of with its line, are left to obj.c.
#include "loop_status.h"
#include "obj.h"
#include "origin.h"
#include "pages.h"

#include <sched.h>
#include <string.h>

enum {
    PIECE = 256 << 10,
    TAIL = 16 << 10,       // bytes that are read behind a piece, for its last line
    STATEMENTS = 4096,     // at most in a piece
    MOST = UINT32_MAX - 1, // of a kind, while it is not known how many there are
};

enum array { POSITIONS, TEXCOORDS, NORMALS, CORNERS, CORNER_TEXCOORDS, CORNER_NORMALS, POLYGONS, ARRAYS };
static const struct {
    size_t line; // bytes of the shortest line that makes a row
    size_t row;  // bytes
} kinds[ARRAYS] = {
    [POSITIONS] = {8, 12}, // "v 0 0 0"
    [TEXCOORDS] = {5, 8},  // "vt 0"
    [NORMALS] = {9, 12},   // "vn 0 0 0"
    [CORNERS] = {8, 12},   // "f 1 1 1"; polygons make more, but not of usual lines
    [CORNER_TEXCOORDS] = {8, 12}, [CORNER_NORMALS] = {8, 12}, [POLYGONS] = {10, sizeof(struct obj_polygon)},
};

// What a thread has.
struct scratch {
    struct obj obj; // its arrays lie here
    uint8_t *text;
    void *arrays[ARRAYS];
    struct obj_statement statements[STATEMENTS];
    bool texcoords, normals; // the faces name them
    uint32_t highest[3];     // position, texture coordinate, normal named by a face
};

struct large_statement {
    size_t offset; // in the texts
    uint32_t triangle;
};

struct large {
    struct obj *obj;
    const struct file_parts *file;
    struct loop_status loop;
    int wrong; // touched atomically
    struct scratch *scratches;
    uint8_t *arrays[ARRAYS];
    size_t held[ARRAYS];
    size_t turn; // the piece that is counted next; touched atomically. What follows belongs to its thread.
    struct obj_counts total;
    size_t charged;
    int layout; // of the faces; 0: none so far
    float low[3], high[3];
    struct large_statement *statements;
    uint8_t *texts; // of the statements, one after another
    size_t statements_capacity, texts_used, texts_capacity;
};

static bool still_right(struct large *large)
{
    return !__atomic_load_n(&large->wrong, __ATOMIC_RELAXED) && should_continue(&large->loop);
}

static uint64_t count_of(const struct obj_counts *counts, enum array kind)
{
    return kind == POSITIONS   ? counts->positions
           : kind == TEXCOORDS ? counts->texcoords
           : kind == NORMALS   ? counts->normals
           : kind == POLYGONS  ? counts->polygons
                               : counts->triangles;
}

static size_t max_of(enum array kind, size_t bytes) { return bytes / kinds[kind].line + 1; }

// --- one piece

// The whole lines that begin in the piece.
static bool read_text(const struct large *large, struct scratch *scratch, size_t index, struct obj_chunk *piece)
{
    size_t size = large->file->size, nominal = index * PIECE, from = index ? nominal - 1 : 0;
    size_t to = size - nominal < PIECE + TAIL ? size : nominal + PIECE + TAIL;
    uint8_t *text = scratch->text, *end = text + (to - from);
    if (!file_read_part(large->file, from, text, to - from))
        return false;
    memset(end, 0, FILE_PADDING);
    const uint8_t *first = text, *last = end;
    if (index) {
        first = memchr(text, '\n', (size_t)(end - text));
        first = first ? first + 1 : end;
    } else if (memcmp(text, "\xef\xbb\xbf", 3) == 0) { // a byte order mark
        first += 3;
    }
    if (size - nominal > PIECE) {
        const uint8_t *edge = text + (nominal + PIECE - 1 - from);
        last = memchr(edge, '\n', (size_t)(end - edge));
        if (!last && to < size)
            return false;
        last = last ? last + 1 : end;
    }
    if (first > last)
        return false;
    // A line that goes on in the next piece?
    if (last - first >= 3 && (last[-2] == '\\' || last[-3] == '\\'))
        return false;
    *piece = (struct obj_chunk){.begin = first, .end = last};
    return true;
}

static bool parse(struct scratch *scratch, struct obj_chunk *piece)
{
    struct obj *obj = &scratch->obj;
    const struct obj_chunk unread = *piece;
    obj->begin = piece->begin;
    obj->end = piece->end;
    for (;;) {
        *piece = unread;
        piece->holds = (struct obj_counts){
            .positions = max_of(POSITIONS, PIECE),
            .texcoords = max_of(TEXCOORDS, PIECE),
            .normals = max_of(NORMALS, PIECE),
            .triangles = max_of(CORNERS, PIECE),
            .polygons = max_of(POLYGONS, PIECE),
            .others = STATEMENTS,
        };
        obj->texcoord_indices = scratch->texcoords ? scratch->arrays[CORNER_TEXCOORDS] : NULL;
        obj->normal_indices = scratch->normals ? scratch->arrays[CORNER_NORMALS] : NULL;
        if (!obj_parse_chunk(obj, piece, NULL))
            return false;
        if (!piece->texcoord_unknown && !piece->normal_unknown)
            break;
        scratch->texcoords |= piece->texcoord_unknown; // the first faces that this thread sees
        scratch->normals |= piece->normal_unknown;
    }
    return !piece->colors && !piece->short_faces && !piece->odd_numbers &&
           !(scratch->texcoords && piece->texcoord_missing) && !(scratch->normals && piece->normal_missing);
}

// --- its place

static bool grow(struct arena *arena, void *array, size_t *scratch, size_t used, size_t more, size_t item)
{
    if (used + more <= *scratch)
        return true;
    size_t wanted = 2 * (used + more) + 1024;
    void *old, *larger = arena_array(arena, wanted, item);
    if (!larger)
        return false;
    memcpy(&old, array, sizeof old);
    if (used)
        memcpy(larger, old, used * item);
    memcpy(array, &larger, sizeof larger);
    *scratch = wanted;
    return true;
}

static bool keep_statements(struct large *large, const struct scratch *scratch, uint64_t count, uint32_t triangle)
{
    struct arena *memory = &large->obj->memory;
    size_t kept = (size_t)large->total.others;
    if (!grow(memory, &large->statements, &large->statements_capacity, kept, (size_t)count, sizeof *large->statements))
        return false;
    for (uint64_t i = 0; i < count; i++) {
        const uint8_t *at = scratch->statements[i].at;
        size_t length = (size_t)(obj_line_after(at, scratch->obj.end) - at);
        if (!grow(memory, &large->texts, &large->texts_capacity, large->texts_used, length + 1 + FILE_PADDING, 1))
            return false;
        large->statements[kept + i] =
            (struct large_statement){large->texts_used, triangle + scratch->statements[i].triangle};
        memcpy(large->texts + large->texts_used, at, length);
        large->texts_used += length;
    }
    return true;
}

// Counts the piece, in the pieces' order. `before` gets what stands above it.
static bool count_piece(struct large *large, struct scratch *scratch, size_t index, const struct obj_chunk *piece,
                        struct obj_counts *before)
{
    while (__atomic_load_n(&large->turn, __ATOMIC_ACQUIRE) != index) {
        if (!still_right(large))
            return false;
        sched_yield();
    }
    const struct obj_counts *holds = &piece->holds;
    struct obj_counts *total = &large->total;
    *before = *total;
    int layout = 1 + scratch->texcoords + 2 * scratch->normals;
    if (holds->triangles) {
        if (large->layout && large->layout != layout)
            return false;
        large->layout = layout;
    }
    if (holds->others && !keep_statements(large, scratch, holds->others, (uint32_t)total->triangles))
        return false;
    total->positions += holds->positions;
    total->texcoords += holds->texcoords;
    total->normals += holds->normals;
    total->triangles += holds->triangles;
    total->polygons += holds->polygons;
    total->others += holds->others;
    size_t bytes = 0;
    for (enum array kind = 0; kind < ARRAYS; kind++) {
        if (count_of(total, kind) > max_of(kind, large->file->size))
            return false;
        bytes += (size_t)count_of(holds, kind) * kinds[kind].row;
    }
    if (!call_charge(large->loop.call, bytes))
        return false;
    large->charged += bytes;
    for (int i = 0; i < 3; i++) {
        large->low[i] = piece->low[i] < large->low[i] ? piece->low[i] : large->low[i];
        large->high[i] = piece->high[i] > large->high[i] ? piece->high[i] : large->high[i];
    }
    __atomic_store_n(&large->turn, index + 1, __ATOMIC_RELEASE);
    return true;
}

static void copy_corners(const struct large *large, struct scratch *scratch, enum array kind, uint64_t first,
                         uint64_t triangles)
{
    const uint32_t *from = scratch->arrays[kind];
    uint32_t *to = (uint32_t *)(void *)large->arrays[kind] + 3 * first;
    uint32_t highest = scratch->highest[kind - CORNERS];
    for (size_t i = 0; i < 3 * triangles; i++) {
        highest = from[i] > highest ? from[i] : highest;
        to[i] = from[i];
    }
    scratch->highest[kind - CORNERS] = highest;
}

static void copy_piece(const struct large *large, struct scratch *scratch, const struct obj_counts *holds,
                       const struct obj_counts *before)
{
    for (enum array kind = POSITIONS; kind <= NORMALS; kind++)
        memcpy(large->arrays[kind] + count_of(before, kind) * kinds[kind].row, scratch->arrays[kind],
               (size_t)count_of(holds, kind) * kinds[kind].row);
    copy_corners(large, scratch, CORNERS, before->triangles, holds->triangles);
    if (scratch->texcoords)
        copy_corners(large, scratch, CORNER_TEXCOORDS, before->triangles, holds->triangles);
    if (scratch->normals)
        copy_corners(large, scratch, CORNER_NORMALS, before->triangles, holds->triangles);
    const struct obj_polygon *from = scratch->arrays[POLYGONS];
    struct obj_polygon *to = (struct obj_polygon *)(void *)large->arrays[POLYGONS] + before->polygons;
    for (size_t i = 0; i < holds->polygons; i++)
        to[i] = (struct obj_polygon){(uint32_t)before->triangles + from[i].first_triangle, from[i].count};
}

static void take_piece(void *user, size_t index, int thread)
{
    struct large *large = user;
    struct scratch *scratch = &large->scratches[thread];
    struct obj_chunk piece;
    struct obj_counts before;
    if (!still_right(large))
        return;
    if (read_text(large, scratch, index, &piece) && parse(scratch, &piece) &&
        count_piece(large, scratch, index, &piece, &before))
        copy_piece(large, scratch, &piece.holds, &before);
    else
        __atomic_store_n(&large->wrong, 1, __ATOMIC_RELAXED);
}

// --- the whole

static bool make_rooms(struct large *large)
{
    struct obj *obj = large->obj;
    size_t threads = (size_t)pool_threads(obj->source->pool);
    large->scratches = arena_alloc_zeroed(&obj->memory, threads * sizeof *large->scratches);
    size_t text = PIECE + TAIL + FILE_PADDING, bytes = text;
    for (enum array kind = 0; kind < ARRAYS; kind++)
        bytes += (max_of(kind, PIECE) + 1) * kinds[kind].row / 64 * 64 + 64;
    uint8_t *memory = arena_array(&obj->memory, threads, bytes);
    if (!large->scratches || !memory)
        return false;
    for (size_t t = 0; t < threads; t++) {
        struct scratch *scratch = &large->scratches[t];
        scratch->text = memory;
        memory += text;
        for (enum array kind = 0; kind < ARRAYS; kind++) {
            scratch->arrays[kind] = memory;
            memory += (max_of(kind, PIECE) + 1) * kinds[kind].row / 64 * 64 + 64;
        }
        scratch->obj = (struct obj){
            .source = obj->source,
            .in_pieces = true,
            .total = {.positions = MOST, .texcoords = MOST, .normals = MOST},
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

static bool make_arrays(struct large *large)
{
    for (enum array kind = 0; kind < ARRAYS; kind++) {
        size_t bytes = max_of(kind, large->file->size) * kinds[kind].row;
        large->arrays[kind] = pages_get(bytes, &large->held[kind]);
        if (!large->arrays[kind])
            return false;
    }
    return true;
}

// Every face names what is there?
static bool corners_known(const struct large *large)
{
    const struct obj_counts *total = &large->total;
    const uint64_t limits[3] = {total->positions, total->texcoords, total->normals};
    const bool named[3] = {true, (large->layout - 1) & 1, (large->layout - 1) & 2};
    for (int t = 0; t < pool_threads(large->obj->source->pool); t++) {
        for (int k = 0; k < 3; k++) {
            if (named[k] && large->scratches[t].highest[k] >= limits[k])
                return false;
        }
    }
    return total->triangles > 0 && total->positions < MOST && total->triangles <= UINT32_MAX / 3;
}

// The arena owns the array from now on, as far as it is filled. NULL: there is none, or no memory.
static void *hand_over(struct large *large, enum array kind, struct arena *arena)
{
    size_t bytes = (size_t)count_of(&large->total, kind) * kinds[kind].row;
    pages_trim(large->arrays[kind], &large->held[kind], bytes);
    struct file_bytes block = {large->arrays[kind], bytes, large->held[kind], large->loop.call};
    if (!call_charge(large->loop.call, bytes + FILE_PADDING))
        return NULL;
    if (!arena_adopt(arena, &block)) {
        call_refund(large->loop.call, bytes + FILE_PADDING);
        return NULL;
    }
    large->held[kind] = 0;
    return large->arrays[kind];
}

static bool hand_over_all(struct large *large)
{
    struct obj *obj = large->obj;
    struct arena *kept = &obj->scene->arena;
    bool texcoords = (large->layout - 1) & 1, normals = (large->layout - 1) & 2;
    call_refund(large->loop.call, large->charged);
    large->charged = 0;
    obj->total = large->total;
    obj->positions = hand_over(large, POSITIONS, kept);
    obj->indices = hand_over(large, CORNERS, kept);
    obj->polygons = hand_over(large, POLYGONS, &obj->memory);
    bool done = obj->positions && obj->indices && obj->polygons;
    if (texcoords) {
        obj->texcoords = hand_over(large, TEXCOORDS, kept);
        obj->texcoord_indices = hand_over(large, CORNER_TEXCOORDS, kept);
        done = done && obj->texcoords && obj->texcoord_indices;
    }
    if (normals) {
        obj->normals = hand_over(large, NORMALS, kept);
        obj->normal_indices = hand_over(large, CORNER_NORMALS, kept);
        done = done && obj->normals && obj->normal_indices;
    }
    size_t count = (size_t)large->total.others;
    obj->statements = arena_array(&obj->memory, count, sizeof *obj->statements);
    if (!done || !obj->statements)
        return false;
    for (size_t i = 0; i < count; i++)
        obj->statements[i] =
            (struct obj_statement){large->texts + large->statements[i].offset, large->statements[i].triangle};
    if (count == 0)
        return true;
    memset(large->texts + large->texts_used, 0, FILE_PADDING);
    obj->begin = large->texts;
    obj->end = large->texts + large->texts_used;
    return true;
}

static bool near_zero(const struct large *large)
{
    double low[3], high[3], origin[3];
    for (int i = 0; i < 3; i++) {
        low[i] = (double)large->low[i];
        high[i] = (double)large->high[i];
    }
    return !origin_choose(low, high, origin);
}

static bool load(struct large *large)
{
    struct obj *obj = large->obj;
    if (!PAGES_WHEN_TOUCHED || !make_rooms(large) || !make_arrays(large))
        return false;
    for (int i = 0; i < 3; i++) {
        large->low[i] = __FLT_MAX__;
        large->high[i] = -__FLT_MAX__;
    }
    pool_run(obj->source->pool, (large->file->size + PIECE - 1) / PIECE, take_piece, large);
    if (!still_right(large) || !corners_known(large) || !near_zero(large) || !hand_over_all(large))
        return false;
    struct obj_chunk whole = {
        .texcoord_used = obj->texcoords != NULL,
        .normal_used = obj->normals != NULL,
    };
    obj->chunks = &whole;
    obj->chunk_count = 1;
    return obj_complete(obj, NULL) && !obj->line_missed;
}

bool obj_load_large(const struct import_source *source, const struct file_parts *file, struct lam_scene *scene)
{
    struct obj obj = {.source = source, .scene = scene, .in_pieces = true};
    struct large large = {.obj = &obj, .file = file, .loop = {.call = source->call}};
    arena_start(&obj.memory, source->call);
    obj.materials.memory = &obj.memory;
    bool done = load(&large);
    for (enum array kind = 0; kind < ARRAYS; kind++) {
        if (large.held[kind])
            pages_free(large.arrays[kind], large.held[kind]);
    }
    call_refund(source->call, large.charged);
    arena_free(&obj.memory);
    return done;
}
