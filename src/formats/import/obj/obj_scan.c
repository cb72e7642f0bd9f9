// obj_scan.c: pass one over an OBJ file: splits the file into chunks and counts the elements of each chunk, 64 bytes at
// a time.
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

const uint8_t *obj_next_line(const uint8_t *at, const uint8_t *end)
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

const uint8_t *obj_next_word_slow(const uint8_t *at, const uint8_t *end)
{
    for (;;) {
        while (at < end && obj_white(*at))
            at++;
        if (at >= end)
            return end;
        if (*at == '#') // a comment extends to the end of its line
            return newline_or(at, end);
        if (*at != '\\' || !obj_at_word_end(at))
            return at;
        at = newline_or(at, end) + 1; // obj_at_word_end has checked that a newline follows
    }
}

bool obj_split(struct obj *obj, size_t chunk_bytes, lam_error *error)
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
        // otherwise the previous chunk's last line extends beyond this chunk, and this chunk stays empty
        else if (obj->begin + nominal > at)
            at = obj_next_line(obj->begin + nominal, obj->end);
        // obj_next_line may have started after the backslash of a line continuation.
        while (at < obj->end && continued(obj->begin, at - 1))
            at = obj_next_line(at, obj->end);
        obj->chunks[i].end = at;
    }
    return true;
}

static void count_face(struct obj_counts *counts, uint64_t corners)
{
    if (corners < 3)
        return;
    counts->triangles += corners - 2;
    counts->polygons += corners > 3;
}

// Counts a statement that contains a comment or a continuation, or the last statement of the file. Returns the start of
// the next line.
static const uint8_t *count_slowly(struct obj_chunk *chunk, const uint8_t *at, const uint8_t *end)
{
    while (at < end && obj_white(*at))
        at++;
    if (at >= end)
        return end;
    enum obj_kind kind = obj_kind_of(at);
    if (kind == OBJ_OTHER) {
        chunk->counts.others++;
        return obj_next_line(at, end);
    }
    if (kind == OBJ_EMPTY) {
        const uint8_t *newline = newline_or(at, end);
        return newline < end ? newline + 1 : end;
    }
    uint64_t words = 0;
    while (!obj_at_line_end(at, end)) {
        words++;
        while (at < end && !obj_at_word_end(at))
            at++;
        const uint8_t *next = obj_next_word(at, end);
        if (next == at && !obj_at_line_end(at, end))
            at++; // a zero byte is not a word; pass two reports it
        else
            at = next;
    }
    struct obj_counts *counts = &chunk->counts;
    counts->positions += kind == OBJ_POSITION;
    counts->texcoords += kind == OBJ_TEXCOORD;
    counts->normals += kind == OBJ_NORMAL;
    if (kind == OBJ_FACE)
        count_face(counts, words - 1);
    chunk->colors |= kind == OBJ_POSITION && words >= 7;
    return at < end ? at + 1 : end;
}

static bool scan_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    struct obj *obj = user;
    struct obj_chunk *chunk = &obj->chunks[index];
    const uint8_t *line = chunk->begin, *end = chunk->end;
    // This local copy of the counts stays in registers.
    struct obj_counts counts = {0};
    chunk->counts = counts;
    bool colors = false;
    uint64_t slashes = 0;
    while (line < end) {
        // At the start of a line, the previous byte is treated as white space.
        const uint8_t *block = line;
        uint64_t white_before = 1, special_before = 0;
        uint64_t words = 0, words_at_line = 0; // number of words that begin before the block, and before the line
        bool leave = false;                    // whether to leave the loop over blocks, at a slow line or at the
                                               // chunk's end
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
                    counts.positions++;
                    colors |= words_here - words_at_line >= 7;
                    break;
                case OBJ_TEXCOORD:
                    counts.texcoords++;
                    break;
                case OBJ_NORMAL:
                    counts.normals++;
                    break;
                case OBJ_FACE:
                    count_face(&counts, words_here - words_at_line - 1);
                    break;
                case OBJ_EMPTY:
                    break;
                case OBJ_OTHER:
                    counts.others++;
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
            if (block + 64 >= end) { // the file's last line, without a line end
                line = count_slowly(chunk, line, end);
                break;
            }
        }
    }
    chunk->counts.positions += counts.positions;
    chunk->counts.texcoords += counts.texcoords;
    chunk->counts.normals += counts.normals;
    chunk->counts.triangles += counts.triangles;
    chunk->counts.polygons += counts.polygons;
    chunk->counts.others += counts.others;
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
        sum.positions += chunk->counts.positions;
        sum.texcoords += chunk->counts.texcoords;
        sum.normals += chunk->counts.normals;
        sum.triangles += chunk->counts.triangles;
        sum.polygons += chunk->counts.polygons;
        sum.others += chunk->counts.others;
        obj->colors_present |= chunk->colors;
        slashes |= chunk->slashes;
    }
    obj->total = sum;
    if (!slashes && sum.triangles) // no face has texture coordinates or normals
        obj->total.texcoords = obj->total.normals = 0;
    const char *name = obj->source->name;
    uint64_t largest = sum.positions > sum.texcoords ? sum.positions : sum.texcoords;
    largest = largest > sum.normals ? largest : sum.normals;
    if (largest >= UINT32_MAX)
        return fail(error, LAM_LIMIT, "%s: %llu positions, normals or texture coordinates, expected at most 4294967294",
                    name, (unsigned long long)largest);
    if (sum.triangles > UINT32_MAX / 3)
        return fail(error, LAM_LIMIT, "%s: %llu triangles, expected at most %u", name,
                    (unsigned long long)sum.triangles, UINT32_MAX / 3);
    return call_check_triangles(obj->source->call, name, sum.triangles, "triangles", error);
}
