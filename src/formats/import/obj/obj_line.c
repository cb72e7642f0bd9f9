// obj_line.c: reads one line of any kind in an OBJ file: vertex, texture coordinate, normal, face.
#include "obj.h"

#include "number_scan.h"
#include "text_cursor.h"

#include <math.h>
#include <string.h>

static size_t count_newlines(const uint8_t *at, size_t size)
{
    size_t count = 0;
    for (size_t i = 0; i < size; i++)
        count += at[i] == '\n';
    return count;
}

size_t obj_line_number(const struct obj *obj, const uint8_t *at)
{
    const struct import_source *source = obj->source;
    uint8_t block[4096];
    size_t lines = 1, offset = (size_t)(at - obj->begin);
    if (!obj->streamed)
        return lines + count_newlines(obj->begin, offset);
    const struct obj_statement *s = obj->statements;
    while (s + 1 < obj->statements + obj->total.others && s[1].at <= at)
        s++;
    offset = s->offset + (size_t)(at - s->at);
    for (size_t from = 0, size; from < offset; from += size) {
        size = offset - from < sizeof block ? offset - from : sizeof block;
        if (!file_read_part(&source->parts, source->name, from, block, size, NULL))
            break; // the number of the last line that can still be read
        lines += count_newlines(block, size);
    }
    return lines;
}

// The "expected" part of the message if pass two finds more elements than pass one counted.
static const char changed[] = "the text that was counted first; the file changed during the load";

// Fills the reader's error: "found 'x', expected …". Returns NULL.
static const uint8_t *fail_expected(struct obj_reader *reader, const uint8_t *at, const char *expected)
{
    if (!reader->error) // skips the message, because its line number needs a pass over the text
        return NULL;
    char found[TEXT_FOUND_SIZE];
    struct obj *obj = reader->obj;
    const char *what = at < reader->end && *at == '\n' ? "the end of the line" : text_found(at, reader->end, found);
    fail_line(reader->error, obj->source, obj_line_number(obj, at), "found %s, expected %s", what, expected);
    return NULL;
}

// Reads `count` numbers. The numbers after the first `min` are optional, with a default of 0. Returns the next word, or
// NULL on error. `expected` describes a number in the message.
static inline const uint8_t *read_numbers(struct obj_reader *reader, const uint8_t *at, float *to, int min, int count,
                                          const char *expected)
{
    const uint8_t *end = reader->end;
    for (int i = 0; i < count; i++) {
        at = obj_next_word(at, end);
        if (i >= min && obj_at_line_end(at, end)) {
            to[i] = 0;
            continue;
        }
        const uint8_t *next = number_float_quick(at, end, &to[i]);
        if (__builtin_expect(!next || !obj_at_word_end(next), 0))
            return fail_expected(reader, at, expected);
        at = next;
    }
    return obj_next_word(at, end);
}

// Reads the numbers after x y z, if there are any: a weight w, which only rational curves use, or a colour r g b,
// possibly followed by further numbers.
static const uint8_t *read_color(struct obj_reader *reader, const uint8_t *at, float *color)
{
    const uint8_t *end = reader->end;
    float extra[4];
    int count = 0;
    while (count < 4 && !obj_at_line_end(at, end)) {
        const uint8_t *next = number_float_quick(at, end, &extra[count]);
        if (!next || !obj_at_word_end(next))
            return fail_expected(reader, at, "a weight or a colour after the position");
        count++;
        at = obj_next_word(next, end);
    }
    reader->chunk->colors |= count >= 3;
    if (color && count >= 3) {
        for (int i = 0; i < 3; i++)
            color[i] = extra[i] >= 0 ? extra[i] : NAN; // mesh_convert_colors counts it
    }
    return at;
}

static const uint8_t *read_position(struct obj_reader *reader, const uint8_t *at)
{
    struct obj *obj = reader->obj;
    if (reader->next.positions >= reader->limit.positions)
        return fail_expected(reader, at, changed);
    float *to = obj->positions + 3 * reader->next.positions;
    at = read_numbers(reader, at + 1, to, 3, 3, "a coordinate (v x y z)");
    if (!at)
        return NULL;
    for (int i = 0; i < 3 && obj_finite(to); i++) {
        reader->low[i] = to[i] < reader->low[i] ? to[i] : reader->low[i];
        reader->high[i] = to[i] > reader->high[i] ? to[i] : reader->high[i];
    }
    float *color = obj->colors ? obj->colors + 4 * reader->next.positions : NULL;
    if (color) {
        color[0] = color[1] = color[2] = -1; // no colour
        color[3] = 1;
    }
    if (__builtin_expect(!obj_at_line_end(at, reader->end), 0)) {
        at = read_color(reader, at, color);
        if (!at)
            return NULL;
        at = obj_skip_line(at, reader->end);
    } else {
        at += at < reader->end;
    }
    reader->next.positions++;
    return at;
}

// Reads a texture coordinate or a normal. Texture coordinates with numbers that are not finite become 0, because some
// exporters write "nan". One warning is added for all of them.
static const uint8_t *read_attribute(struct obj_reader *reader, const uint8_t *at, bool normal)
{
    struct obj *obj = reader->obj;
    float *array = normal ? obj->normals : obj->texcoords;
    if (!array)
        return obj_skip_line(at, reader->end);
    uint64_t *next = normal ? &reader->next.normals : &reader->next.texcoords;
    if (*next >= (normal ? reader->limit.normals : reader->limit.texcoords))
        return fail_expected(reader, at, changed);
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
    if (__builtin_expect(sum != 0 && !normal, 0)) {
        for (int i = 0; i < width; i++)
            to[i] = 0;
        struct obj_chunk *chunk = reader->chunk;
        if (chunk->nonfinite_numbers++ == 0)
            chunk->first_nonfinite = begin;
    }
    ++*next;
    return obj_skip_line(at, reader->end);
}

// Reads an index of a corner: 1 refers to the first element, and −1 to the last of the `so_far` elements before this
// line. `what` names the kind of element in messages. Returns NULL on error.
static inline const uint8_t *read_index(struct obj_reader *reader, const uint8_t *at, uint64_t total, uint64_t so_far,
                                        const char *what, uint32_t *out)
{
    uint64_t eight = number_load8(at);
    unsigned digits = number_digit_count(eight);
    uint64_t index = number_digits_value(eight, digits) - 1;
    const uint8_t *next = at + digits;
    if (__builtin_expect(digits - 1 >= 7, 0)) { // a sign, eight digits or more, or not a number
        int64_t value;
        next = number_int(at, reader->end, &value);
        if (!next)
            return fail_expected(reader, at, what);
        bool relative = value < 0 && !reader->obj->streamed;
        index = value > 0 ? (uint64_t)value - 1 : relative ? so_far + (uint64_t)value : UINT64_MAX;
    }
    if (__builtin_expect(index >= total, 0)) {
        if (!reader->error)
            return NULL;
        char found[TEXT_FOUND_SIZE];
        int64_t value = 0;
        number_int(at, reader->end, &value);
        const char *name = what + 2; // skips the article
        struct obj *obj = reader->obj;
        size_t line = obj_line_number(obj, at);
        text_found(at, next, found);
        if (value == 0)
            fail_line(reader->error, obj->source, line, "a face names %s 0, expected an index from 1", name);
        else if (value > 0)
            fail_line(reader->error, obj->source, line, "a face names %s %s, but the file has %llu", name, found,
                      (unsigned long long)total);
        else
            fail_line(reader->error, obj->source, line, "a face names %s %s, counted back, but only %llu precede it",
                      name, found, (unsigned long long)so_far);
        return NULL;
    }
    *out = (uint32_t)index;
    return next;
}

// Reads the index of a corner's texture coordinate or normal. If such elements are not kept (`kept` is false), the
// index is skipped and *unknown is set.
static inline const uint8_t *read_further_index(struct obj_reader *reader, const uint8_t *at, bool kept, uint64_t total,
                                                uint64_t so_far, const char *what, bool *unknown, uint32_t *out)
{
    if (kept)
        return read_index(reader, at, total, so_far, what, out);
    int64_t unused;
    const uint8_t *next = number_int(at, reader->end, &unused);
    if (!next)
        return fail_expected(reader, at, what);
    *unknown = true;
    return next;
}

static const char name_position[] = "a vertex", name_texcoord[] = "a texture coordinate", name_normal[] = "a normal";

// Reads a face with v, v/t, v//n or v/t/n for each corner; the forms may be mixed.
static const uint8_t *read_face(struct obj_reader *reader, const uint8_t *at)
{
    struct obj *obj = reader->obj;
    struct obj_chunk *chunk = reader->chunk;
    const uint8_t *begin = at, *end = reader->end;
    const uint64_t first = 3 * reader->next.triangles, limit = 3 * reader->limit.triangles;
    uint32_t *texcoords = obj->texcoord_indices, *normals = obj->normal_indices;
    uint64_t count = 0;
    bool texcoord_used = false, texcoord_missing = false, normal_used = false, normal_missing = false;
    at = obj_next_word(at + 1, end);
    for (; !obj_at_line_end(at, end); count++) {
        uint32_t position, texcoord = OBJ_MISSING, normal = OBJ_MISSING;
        at = read_index(reader, at, obj->total.positions, reader->next.positions, name_position, &position);
        if (!at)
            return NULL;
        if (*at == '/') {
            at++;
            if (*at != '/' && !obj_at_word_end(at))
                at = read_further_index(reader, at, texcoords, obj->total.texcoords, reader->next.texcoords,
                                        name_texcoord, &chunk->texcoord_unknown, &texcoord);
            if (at && *at == '/' && !obj_at_word_end(++at))
                at = read_further_index(reader, at, normals, obj->total.normals, reader->next.normals, name_normal,
                                        &chunk->normal_unknown, &normal);
            if (!at)
                return NULL;
        }
        if (__builtin_expect(!obj_at_word_end(at), 0))
            return fail_expected(reader, at, "a space between a face's corners (v, v/t, v//n or v/t/n)");
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
        at = obj_next_word(at, end);
    }
    chunk->texcoord_used |= texcoord_used;
    chunk->normal_used |= normal_used;
    chunk->texcoord_missing |= texcoord_missing;
    chunk->normal_missing |= normal_missing;
    if (count >= 3) {
        if (first + 3 * (count - 2) > limit || (count > 3 && reader->next.polygons >= reader->limit.polygons))
            return fail_expected(reader, begin, changed);
        if (count > 3)
            obj->polygons[reader->next.polygons++] =
                (struct mesh_polygon){(uint32_t)reader->next.triangles, (uint32_t)count};
        reader->next.triangles += count - 2;
    } else if (chunk->short_faces++ == 0) {
        chunk->first_short_face = begin;
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
        if (reader->next.others >= reader->limit.others)
            return fail_expected(reader, at, changed);
        reader->obj->statements[reader->next.others++] =
            (struct obj_statement){at, 0, (uint32_t)reader->next.triangles, (uint32_t)reader->next.positions,
                                   (uint32_t)reader->next.texcoords};
        return obj_next_line(at, end);
    case OBJ_EMPTY:
        if (*at == 0 && at < end)
            return fail_expected(reader, at, "text (this is a zero byte)");
        at = memchr(at, '\n', (size_t)(end - at));
        return at ? at + 1 : end;
    }
    return NULL;
}
