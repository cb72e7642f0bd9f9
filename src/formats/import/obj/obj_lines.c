// obj_lines.c: a fast path for the most frequent lines: "v x y z", "vt s t", "vn x y z", and faces whose corners all
// contain the attributes that are kept. obj_line.c reads all other lines. The results are identical, because
// src/core/base/text/number.c parses all numbers whose last bit is uncertain.
#include "byte_masks.h"
#include "number_scan.h"
#include "obj.h"

static inline bool read_triangle(uint32_t index_limit, const uint8_t *line, const uint8_t *line_end, uint32_t to[3])
{
    const uint8_t *at = line + 1;
    for (int i = 0; i < 3; i++) {
        if (*at != ' ')
            return false;
        uint64_t eight = number_load8(++at);
        unsigned digits = number_digit_count(eight);
        uint64_t index = number_digits_value(eight, digits) - 1;
        if (digits == 0 || index >= index_limit)
            return false;
        to[i] = (uint32_t)index;
        at += digits;
    }
    return at + (*at == '\r') == line_end;
}

static inline bool read_coordinates(const uint8_t *line, const uint8_t *line_end, float out[3])
{
    const uint8_t *at = line + 1;
    for (int i = 0; i < 3; i++) {
        at = *at == ' ' ? number_float_quick(at + 1, line_end, &out[i]) : NULL;
        if (!at)
            return false;
    }
    float sum = (out[0] - out[0]) + (out[1] - out[1]) + (out[2] - out[2]);
    return at + (*at == '\r') == line_end && sum == 0; // all numbers are finite
}

// The output position of the fast path. A local variable of this type stays in registers, unlike `reader`.
struct output {
    float *position, *positions_end, *texcoord, *texcoords_end, *normal, *normals_end;
    size_t corner, corners_end;
    bool faces; // whether the fast path has read a face
    struct box {
        float low[4], high[4];
    } box;
};

static inline float *element(float *array, size_t width, uint64_t index)
{
    return array ? array + width * index : NULL;
}

static inline struct output load_output(const struct obj_reader *reader)
{
    const struct obj *obj = reader->obj;
    const struct obj_counts *next = &reader->next, *limit = &reader->limit;
    struct output output = {
        .position = obj->positions + 3 * next->positions,
        .positions_end = obj->positions + 3 * (obj->colors ? 0 : limit->positions),
        .texcoord = element(obj->texcoords, 2, next->texcoords),
        .texcoords_end = element(obj->texcoords, 2, limit->texcoords),
        .normal = element(obj->normals, 3, next->normals),
        .normals_end = element(obj->normals, 3, limit->normals),
        .corner = 3 * (size_t)next->triangles,
        .corners_end = 3 * (size_t)limit->triangles,
    };
    memcpy(&output.box.low, reader->low, sizeof reader->low);
    memcpy(&output.box.high, reader->high, sizeof reader->high);
    return output;
}

static inline void store_output(const struct output *output, struct obj_reader *reader)
{
    const struct obj *obj = reader->obj;
    reader->next.positions = (uint64_t)(output->position - obj->positions) / 3;
    if (obj->texcoords)
        reader->next.texcoords = (uint64_t)(output->texcoord - obj->texcoords) / 2;
    if (obj->normals)
        reader->next.normals = (uint64_t)(output->normal - obj->normals) / 3;
    reader->next.triangles = output->corner / 3;
    reader->chunk->texcoord_used |= output->faces && obj->texcoord_indices;
    reader->chunk->normal_used |= output->faces && obj->normal_indices;
    memcpy(reader->low, &output->box.low, sizeof reader->low);
    memcpy(reader->high, &output->box.high, sizeof reader->high);
}

static inline bool append_triangle(struct output *output, uint32_t index_limit, const struct obj *obj,
                                   const uint8_t *line, const uint8_t *line_end)
{
    if (output->corner >= output->corners_end)
        return false;
    if (!read_triangle(index_limit, line, line_end, obj->indices + output->corner))
        return false;
    output->corner += 3;
    return true;
}

static inline const uint8_t *read_index(const uint8_t *at, uint64_t total, uint32_t *to)
{
    uint64_t eight = number_load8(at);
    unsigned digits = number_digit_count(eight);
    uint64_t index = number_digits_value(eight, digits) - 1; // becomes UINT64_MAX if there is no digit
    *to = (uint32_t)index;
    return index < total ? at + digits : NULL;
}

// Reads a face whose corners all have the attributes that are kept: v, v/t, v//n or v/t/n.
static inline bool append_face(struct output *output, struct obj_reader *reader, const uint8_t *line,
                               const uint8_t *line_end)
{
    const struct obj *obj = reader->obj;
    uint32_t *texcoords = obj->texcoord_indices, *normals = obj->normal_indices;
    const uint8_t *at = line + 1;
    size_t corner = output->corner;
    for (; *at == ' ' && corner < output->corners_end; corner++) {
        at = read_index(at + 1, obj->total.positions, &obj->indices[corner]);
        if (at && (texcoords || normals))
            at = *at == '/' ? at + 1 : NULL;
        if (at && texcoords)
            at = read_index(at, obj->total.texcoords, &texcoords[corner]);
        if (at && normals)
            at = *at == '/' ? read_index(at + 1, obj->total.normals, &normals[corner]) : NULL;
        if (!at)
            return false;
    }
    size_t corners = corner - output->corner;
    if (at + (*at == '\r') != line_end || corners < 3 || output->corner + 3 * (corners - 2) > output->corners_end)
        return false;
    if (corners > 3) {
        if (reader->next.polygons >= reader->limit.polygons)
            return false;
        obj->polygons[reader->next.polygons++] =
            (struct mesh_polygon){(uint32_t)(output->corner / 3), (uint32_t)corners};
    }
    output->corner += 3 * (corners - 2);
    output->faces = true;
    return true;
}

static inline bool append_texcoord(struct output *output, const uint8_t *line, const uint8_t *line_end)
{
    if (output->texcoord == output->texcoords_end || line[2] != ' ')
        return false;
    float *to = output->texcoord;
    const uint8_t *at = number_float_quick(line + 3, line_end, &to[0]);
    at = at && *at == ' ' ? number_float_quick(at + 1, line_end, &to[1]) : NULL;
    if (!at || at + (*at == '\r') != line_end || (to[0] - to[0]) + (to[1] - to[1]) != 0)
        return false;
    output->texcoord += 2;
    return true;
}

static inline bool append_position(struct output *output, const uint8_t *line, const uint8_t *line_end)
{
    if (output->position >= output->positions_end)
        return false;
    struct box *box = &output->box;
    float *three = output->position;
    if (!read_coordinates(line, line_end, three))
        return false;
    for (int i = 0; i < 3; i++) {
        box->low[i] = three[i] < box->low[i] ? three[i] : box->low[i];
        box->high[i] = three[i] > box->high[i] ? three[i] : box->high[i];
    }
    output->position += 3;
    return true;
}

static inline bool append_normal(struct output *output, const uint8_t *line, const uint8_t *line_end)
{
    if (output->normal == output->normals_end)
        return false;
    if (!read_coordinates(line + 1, line_end, output->normal))
        return false;
    output->normal += 3;
    return true;
}

static inline bool append_line(struct output *output, struct obj_reader *reader, uint32_t index_limit,
                               const uint8_t *line, const uint8_t *line_end)
{
    if (line[0] == 'f')
        return append_triangle(output, index_limit, reader->obj, line, line_end) ||
               append_face(output, reader, line, line_end);
    if (line[0] != 'v')
        return false;
    return line[1] == 'n'   ? append_normal(output, line, line_end)
           : line[1] == 't' ? append_texcoord(output, line, line_end)
                            : append_position(output, line, line_end);
}

// Line ends are found 64 bytes at a time, so that reading a line does not depend on the previous line.
const uint8_t *obj_read_lines(struct obj_reader *reader, const uint8_t *line, const uint8_t *end)
{
    const struct obj *obj = reader->obj;
    // Triangles without attributes have indices below this limit; 0 if faces have other attributes.
    const uint32_t index_limit = obj->texcoord_indices || obj->normal_indices ? 0 : (uint32_t)obj->total.positions;
    struct output output = load_output(reader);
    for (const uint8_t *block = line;; block += 64) {
        for (uint64_t ends = byte_masks_newlines(block); ends; ends &= ends - 1) {
            const uint8_t *line_end = block + __builtin_ctzll(ends);
            if (!append_line(&output, reader, index_limit, line, line_end)) {
                store_output(&output, reader);
                const uint8_t *next = obj_read_line(reader, line);
                if (next != line_end + 1)
                    return next;
                output = load_output(reader);
            }
            line = line_end + 1;
            if (line >= end) {
                store_output(&output, reader);
                return line;
            }
        }
        if (block + 64 >= end) { // the file's last line, without a line end
            store_output(&output, reader);
            return obj_read_line(reader, line);
        }
    }
}
