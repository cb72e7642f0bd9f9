// obj_scan.c: pass one over an OBJ file: cuts it into chunks and counts what each holds, 64 bytes at a time.
#include "obj.h"

#include "byte_masks.h"
#include "parallel_rows.h"
#include "fail.h"

#include <string.h>

static const uint8_t *newline_or(const uint8_t *at, const uint8_t *end)
{
    const uint8_t *newline = at < end ? memchr(at, '\n', (size_t)(end - at)) : NULL;
    return newline ? newline : end;
}

static bool continued(const uint8_t *begin, const uint8_t *newline)
{
    if (newline > begin && newline[-1] == '\r')
        newline--;
    return newline > begin && newline[-1] == '\\';
}

const uint8_t *obj_line_after(const uint8_t *at, const uint8_t *end)
{
    for (;;) {
        const uint8_t *newline = newline_or(at, end);
        if (newline == end)
            return end;
        if (!continued(at, newline))
            return newline + 1;
        at = newline + 1;
    }
}

const uint8_t *obj_next_slowly(const uint8_t *at, const uint8_t *end)
{
    for (;;) {
        while (at < end && obj_white(*at))
            at++;
        if (at >= end)
            return end;
        if (*at == '#') // a comment runs to the end of its line; it is not continued
            return newline_or(at, end);
        if (*at != '\\' || !obj_word_over(at))
            return at;
        at = newline_or(at, end) + 1; // obj_word_over has seen the newline
    }
}

bool obj_cut(struct obj *obj, size_t chunk_bytes, lam_error *error)
{
    size_t size = (size_t)(obj->end - obj->begin);
    obj->chunk_count = size / chunk_bytes + 1;
    obj->chunks = arena_array(&obj->memory, obj->chunk_count, sizeof *obj->chunks);
    if (!obj->chunks)
        return call_memory_error(obj->source->call, obj->chunk_count * sizeof *obj->chunks, error);
    const uint8_t *at = obj->begin;
    for (size_t i = 0; i < obj->chunk_count; i++) {
        obj->chunks[i] = (struct obj_chunk){.begin = at};
        size_t nominal = (i + 1) * chunk_bytes;
        if (nominal >= size)
            at = obj->end;
        else if (obj->begin + nominal > at) // else a line so long that this chunk stays empty
            at = obj_line_after(obj->begin + nominal, obj->end);
        // obj_line_behind may have begun behind the backslash of a continued line.
        while (at < obj->end && continued(obj->begin, at - 1))
            at = obj_line_after(at, obj->end);
        obj->chunks[i].end = at;
    }
    return true;
}

static void count_face(struct obj_counts *holds, uint64_t corners)
{
    if (corners < 3)
        return;
    holds->triangles += corners - 2;
    holds->polygons += corners > 3;
}

// One statement with a comment, a continued line, or without an end. Returns the place behind it.
static const uint8_t *count_slowly(struct obj_chunk *chunk, const uint8_t *at, const uint8_t *end)
{
    while (at < end && obj_white(*at))
        at++;
    if (at >= end)
        return end;
    enum obj_kind kind = obj_kind_of(at);
    if (kind == OBJ_OTHER) {
        chunk->holds.others++;
        return obj_line_after(at, end);
    }
    if (kind == OBJ_EMPTY) {
        const uint8_t *newline = newline_or(at, end);
        return newline < end ? newline + 1 : end;
    }
    uint64_t words = 0;
    while (!obj_over(at, end)) {
        words++;
        while (at < end && !obj_word_over(at))
            at++;
        const uint8_t *next = obj_next(at, end);
        if (next == at && !obj_over(at, end))
            at++; // a zero byte: no word; the next pass refuses it
        else
            at = next;
    }
    struct obj_counts *holds = &chunk->holds;
    holds->positions += kind == OBJ_POSITION;
    holds->texcoords += kind == OBJ_TEXCOORD;
    holds->normals += kind == OBJ_NORMAL;
    if (kind == OBJ_FACE)
        count_face(holds, words - 1);
    chunk->colors |= kind == OBJ_POSITION && words >= 7;
    return at < end ? at + 1 : end;
}

static bool scan_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    struct obj *obj = user;
    struct obj_chunk *chunk = &obj->chunks[index];
    const uint8_t *line = chunk->begin, *end = chunk->end;
    // Counted here, not in memory that the compiler must write each time.
    struct obj_counts holds = {0};
    chunk->holds = holds;
    bool colors = false;
    uint64_t slashes = 0;
    while (line < end) {
        // Begins at a line's begin: the byte before counts as white.
        const uint8_t *block = line;
        uint64_t white_before = 1, special_before = 0;
        uint64_t words = 0, words_at_line = 0; // that began before the block; before the line
        bool leave = false;                    // this run of blocks, for the next line or the chunk's end
        for (;; block += 64) {
            struct byte_masks masks = byte_masks_of(block);
            uint64_t begins = ~masks.white & (masks.white << 1 | white_before);
            white_before = masks.white >> 63;
            slashes |= masks.slash;
            for (uint64_t ends = masks.newline; ends; ends &= ends - 1) {
                uint64_t below = (ends & (0 - ends)) - 1; // the bytes before this newline
                if (special_before | (masks.special & below)) {
                    line = count_slowly(chunk, line, end);
                    leave = true;
                    break;
                }
                uint64_t words_here = words + byte_masks_count(begins & below);
                while (obj_white(*line))
                    line++;
                switch (obj_kind_of(line)) {
                case OBJ_POSITION:
                    holds.positions++;
                    colors |= words_here - words_at_line >= 7;
                    break;
                case OBJ_TEXCOORD:
                    holds.texcoords++;
                    break;
                case OBJ_NORMAL:
                    holds.normals++;
                    break;
                case OBJ_FACE:
                    count_face(&holds, words_here - words_at_line - 1);
                    break;
                case OBJ_EMPTY:
                    break;
                case OBJ_OTHER:
                    holds.others++;
                    break;
                }
                words_at_line = words_here;
                line = block + __builtin_ctzll(ends) + 1;
                masks.special &= ~below;
                if (line >= end) {
                    leave = true;
                    break;
                }
            }
            if (leave)
                break;
            special_before |= masks.special;
            words += byte_masks_count(begins);
            if (block + 64 >= end) { // the file's last line, without an end
                line = count_slowly(chunk, line, end);
                break;
            }
        }
    }
    chunk->holds.positions += holds.positions;
    chunk->holds.texcoords += holds.texcoords;
    chunk->holds.normals += holds.normals;
    chunk->holds.triangles += holds.triangles;
    chunk->holds.polygons += holds.polygons;
    chunk->holds.others += holds.others;
    chunk->colors |= colors;
    chunk->slashes = slashes != 0;
    return true;
}

bool obj_scan(struct obj *obj, lam_error *error)
{
    if (!parallel_rows_run(obj->source, obj->chunk_count, scan_chunk, obj, error))
        return false;
    struct obj_counts sum = {0};
    bool slashes = false;
    for (size_t i = 0; i < obj->chunk_count; i++) {
        struct obj_chunk *chunk = &obj->chunks[i];
        chunk->before = sum;
        sum.positions += chunk->holds.positions;
        sum.texcoords += chunk->holds.texcoords;
        sum.normals += chunk->holds.normals;
        sum.triangles += chunk->holds.triangles;
        sum.polygons += chunk->holds.polygons;
        sum.others += chunk->holds.others;
        obj->colors_present |= chunk->colors;
        slashes |= chunk->slashes;
    }
    obj->total = sum;
    if (!slashes) // no face names any
        obj->total.texcoords = obj->total.normals = 0;
    const char *name = obj->source->name;
    uint64_t max = sum.positions > sum.texcoords ? sum.positions : sum.texcoords;
    max = max > sum.normals ? max : sum.normals;
    if (max >= UINT32_MAX)
        return fail(error, LAM_LIMIT, "%s: holds %llu vertices of a kind; at most 4294967294 can be held", name,
                    (unsigned long long)max);
    if (sum.triangles > UINT32_MAX / 3)
        return fail(error, LAM_LIMIT, "%s: holds %llu triangles; at most %u can be held", name,
                    (unsigned long long)sum.triangles, UINT32_MAX / 3);
    return true;
}
