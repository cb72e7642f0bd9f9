// obj_line.c: reads one line of an OBJ file: a vertex, a texture coordinate, a normal or a face, straight into its place.
#include "obj.h"

#include "number_scan.h"
#include "text_cursor.h"

#include <string.h>

size_t obj_line(struct obj *obj, const uint8_t *at)
{
    if (obj->in_pieces) {
        obj->line_missed = true;
        return 0;
    }
    size_t lines = 1;
    for (const uint8_t *c = obj->begin; c < at; c++)
        lines += *c == '\n';
    return lines;
}

// What went wrong at `at`: "found 'x', expected WHAT".
static const uint8_t *wrong(struct obj_reader *reader, const uint8_t *at, const char *expected)
{
    if (!reader->error) // the line's number takes a pass
        return NULL;
    char found[TEXT_FOUND_SIZE];
    struct obj *obj = reader->obj;
    const char *what = at < reader->end && *at == '\n' ? "the end of the line" : text_found(at, reader->end, found);
    fail_line(reader->error, obj->source, obj_line(obj, at), "found %s, expected %s", what, expected);
    return NULL;
}

// Reads `count` numbers; a missing one is 0 where `min` are there. Returns the place of the word behind
// them; NULL: wrong. `expected` names them.
static inline const uint8_t *read_numbers(struct obj_reader *reader, const uint8_t *at, float *to, int min, int count,
                                          const char *expected)
{
    const uint8_t *end = reader->end;
    for (int i = 0; i < count; i++) {
        at = obj_next(at, end);
        if (i >= min && obj_over(at, end)) {
            to[i] = 0;
            continue;
        }
        const uint8_t *after = number_float_quick(at, end, &to[i]);
        if (__builtin_expect(!after || !obj_word_over(after), 0))
            return wrong(reader, at, expected);
        at = after;
    }
    return obj_next(at, end);
}

static float clean(float x) { return x > 0 ? x : 0; } // NaN too

// What may follow x y z: nothing; w, which only rational curves use; r g b, perhaps with more behind.
static const uint8_t *read_color(struct obj_reader *reader, const uint8_t *at, float *color)
{
    const uint8_t *end = reader->end;
    float extra[4];
    int count = 0;
    while (count < 4 && !obj_over(at, end)) {
        const uint8_t *after = number_float_quick(at, end, &extra[count]);
        if (!after || !obj_word_over(after))
            return wrong(reader, at, "a weight or a colour behind the position");
        count++;
        at = obj_next(after, end);
    }
    reader->chunk->colors |= count >= 3;
    if (color && count >= 3) {
        for (int i = 0; i < 3; i++) {
            color[i] = clean(extra[i]);
            reader->chunk->brightest = color[i] > reader->chunk->brightest ? color[i] : reader->chunk->brightest;
        }
    }
    return at;
}

static const uint8_t *read_position(struct obj_reader *reader, const uint8_t *at)
{
    struct obj *obj = reader->obj;
    if (reader->at.positions >= reader->limit.positions)
        return wrong(reader, at, "what was there a moment ago");
    float *to = obj->positions + 3 * reader->at.positions;
    const uint8_t *begin = at;
    at = read_numbers(reader, at + 1, to, 3, 3, "a coordinate (v x y z)");
    if (!at)
        return NULL;
    float sum = 0;
    for (int i = 0; i < 3; i++) {
        reader->low[i] = to[i] < reader->low[i] ? to[i] : reader->low[i];
        reader->high[i] = to[i] > reader->high[i] ? to[i] : reader->high[i];
        sum += to[i] - to[i];
    }
    if (__builtin_expect(sum != 0, 0)) { // inf − inf and nan are not 0
        const uint8_t *word = begin + 1;
        for (int i = 0; i < 3; i++) {
            word = obj_next(word, reader->end);
            if (to[i] - to[i] != 0)
                break;
            while (!obj_word_over(word))
                word++;
        }
        return wrong(reader, word, "a finite coordinate");
    }
    float *color = obj->colors ? obj->colors + 4 * reader->at.positions : NULL;
    if (color) {
        color[0] = color[1] = color[2] = -1; // none given
        color[3] = 1;
    }
    if (__builtin_expect(!obj_over(at, reader->end), 0)) {
        at = read_color(reader, at, color);
        if (!at)
            return NULL;
        at = obj_finish_line(at, reader->end);
    } else {
        at += at < reader->end;
    }
    reader->at.positions++;
    return at;
}

// Texture coordinates and normals: what is not finite becomes 0 and is told once, since exporters do write
// "nan" here.
static const uint8_t *read_attribute(struct obj_reader *reader, const uint8_t *at, bool normal)
{
    struct obj *obj = reader->obj;
    float *array = normal ? obj->normals : obj->texcoords;
    if (!array)
        return obj_finish_line(at, reader->end);
    uint64_t *next = normal ? &reader->at.normals : &reader->at.texcoords;
    if (*next >= (normal ? reader->limit.normals : reader->limit.texcoords))
        return wrong(reader, at, "what was there a moment ago");
    int width = normal ? 3 : 2;
    float *to = array + (size_t)width * *next;
    const uint8_t *begin = at;
    at = read_numbers(reader, at + 2, to, normal ? 3 : 1, width,
                      normal ? "a normal's coordinate (vn x y z)" : "a texture coordinate (vt s t)");
    if (!at)
        return NULL;
    float sum = 0;
    for (int i = 0; i < width; i++)
        sum += to[i] - to[i];
    if (__builtin_expect(sum != 0, 0)) {
        for (int i = 0; i < width; i++)
            to[i] = 0;
        struct obj_chunk *chunk = reader->chunk;
        if (chunk->odd_numbers++ == 0)
            chunk->odd_number = begin;
    }
    ++*next;
    return obj_finish_line(at, reader->end);
}

// Reads a number of a corner: 1 is the first, −1 the last above. NULL: wrong. `what` names it, `so_far` are
// above it.
static inline const uint8_t *read_index(struct obj_reader *reader, const uint8_t *at, uint64_t total, uint64_t so_far,
                                        const char *what, uint32_t *out)
{
    uint64_t eight = number_load8(at);
    unsigned digits = number_digit_count(eight);
    uint64_t index = number_digits_value(eight, digits) - 1;
    const uint8_t *after = at + digits;
    if (__builtin_expect(digits - 1 >= 7, 0)) { // a sign, eight digits or more, or no number
        int64_t value;
        after = number_int(at, reader->end, &value);
        if (!after)
            return wrong(reader, at, what);
        bool relative = value < 0 && !reader->obj->in_pieces;
        index = value > 0 ? (uint64_t)value - 1 : relative ? so_far + (uint64_t)value : UINT64_MAX;
    }
    if (__builtin_expect(index >= total, 0)) {
        if (!reader->error)
            return NULL;
        char found[TEXT_FOUND_SIZE];
        int64_t value = 0;
        number_int(at, reader->end, &value);
        const char *name = what + 2; // without the article
        struct obj *obj = reader->obj;
        size_t line = obj_line(obj, at);
        text_found(at, after, found);
        if (value == 0)
            fail_line(reader->error, obj->source, line, "a face names %s 0; they are counted from 1", name);
        else if (value > 0)
            fail_line(reader->error, obj->source, line, "a face names %s %s; the file has %llu", name, found,
                      (unsigned long long)total);
        else
            fail_line(reader->error, obj->source, line, "a face names %s %s, counted back; %llu are above it", name,
                      found, (unsigned long long)so_far);
        return NULL;
    }
    *out = (uint32_t)index;
    return after;
}

static const char what_position[] = "a vertex", what_texcoord[] = "a texture coordinate", what_normal[] = "a normal";

// One face: v, v/t, v//n or v/t/n for each corner, each corner by itself.
static const uint8_t *read_face(struct obj_reader *reader, const uint8_t *at)
{
    struct obj *obj = reader->obj;
    struct obj_chunk *chunk = reader->chunk;
    const uint8_t *begin = at, *end = reader->end;
    const uint64_t first = 3 * reader->at.triangles, limit = 3 * reader->limit.triangles;
    uint32_t *texcoords = obj->texcoord_indices, *normals = obj->normal_indices;
    uint64_t count = 0;
    bool texcoord_used = false, texcoord_missing = false, normal_used = false, normal_missing = false;
    at = obj_next(at + 1, end);
    for (; !obj_over(at, end); count++) {
        uint32_t position, texcoord = OBJ_MISSING, normal = OBJ_MISSING;
        at = read_index(reader, at, obj->total.positions, reader->at.positions, what_position, &position);
        if (!at)
            return NULL;
        if (*at == '/') {
            at++;
            if (*at != '/' && !obj_word_over(at)) {
                if (texcoords) {
                    at = read_index(reader, at, obj->total.texcoords, reader->at.texcoords, what_texcoord, &texcoord);
                    if (!at)
                        return NULL;
                } else {
                    int64_t unused;
                    const uint8_t *number = at;
                    at = number_int(at, end, &unused);
                    if (!at)
                        return wrong(reader, number, what_texcoord);
                    chunk->texcoord_unknown = true;
                }
            }
            if (*at == '/') {
                at++;
                if (!obj_word_over(at)) {
                    if (normals) {
                        at = read_index(reader, at, obj->total.normals, reader->at.normals, what_normal, &normal);
                        if (!at)
                            return NULL;
                    } else {
                        int64_t unused;
                        const uint8_t *number = at;
                        at = number_int(at, end, &unused);
                        if (!at)
                            return wrong(reader, number, what_normal);
                        chunk->normal_unknown = true;
                    }
                }
            }
        }
        if (__builtin_expect(!obj_word_over(at), 0))
            return wrong(reader, at, "a space between a face's corners (v, v/t, v//n or v/t/n)");
        if (first + count < limit) {
            obj->indices[first + count] = position;
            if (texcoords)
                texcoords[first + count] = texcoord;
            if (normals)
                normals[first + count] = normal;
        }
        texcoord_used |= texcoord != OBJ_MISSING;
        normal_used |= normal != OBJ_MISSING;
        texcoord_missing |= texcoord == OBJ_MISSING;
        normal_missing |= normal == OBJ_MISSING;
        at = obj_next(at, end);
    }
    chunk->texcoord_used |= texcoord_used;
    chunk->normal_used |= normal_used;
    chunk->texcoord_missing |= texcoord_missing;
    chunk->normal_missing |= normal_missing;
    if (count >= 3) {
        if (first + 3 * (count - 2) > limit || (count > 3 && reader->at.polygons >= reader->limit.polygons))
            return wrong(reader, begin, "what was there a moment ago");
        if (count > 3)
            obj->polygons[reader->at.polygons++] =
                (struct obj_polygon){(uint32_t)reader->at.triangles, (uint32_t)count};
        reader->at.triangles += count - 2;
    } else if (chunk->short_faces++ == 0) {
        chunk->short_face = begin;
    }
    return at < end ? at + 1 : end;
}

const uint8_t *obj_read_line(struct obj_reader *reader, const uint8_t *at)
{
    const uint8_t *end = reader->end;
    while (obj_white(*at))
        at++;
    switch (obj_kind_of(at)) {
    case OBJ_POSITION:
        return read_position(reader, at);
    case OBJ_FACE:
        return read_face(reader, at);
    case OBJ_TEXCOORD:
        return read_attribute(reader, at, false);
    case OBJ_NORMAL:
        return read_attribute(reader, at, true);
    case OBJ_OTHER:
        if (reader->at.others >= reader->limit.others)
            return wrong(reader, at, "what was there a moment ago");
        reader->obj->statements[reader->at.others++] = (struct obj_statement){at, (uint32_t)reader->at.triangles};
        return obj_line_after(at, end);
    case OBJ_EMPTY:
        if (*at == 0 && at < end)
            return wrong(reader, at, "text (this is a zero byte)");
        at = memchr(at, '\n', (size_t)(end - at));
        return at ? at + 1 : end;
    }
    return NULL;
}
