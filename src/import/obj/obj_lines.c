// obj_lines.c: a fast path for the most frequent lines, "v x y z" and "f a b c"; obj_line.c reads all other lines. The
// file is compiled for several instruction sets (meson.build defines ISA). The results are identical, because
// base/number.c parses all numbers whose last bit is uncertain.
#include "byte_masks.h"
#include "number_scan.h"
#include "obj.h"

#if !defined(ISA)
#define ISA scalar
#endif
#define JOIN_(a, b) a##b
#define JOIN(a, b)  JOIN_(a, b)

#if defined(__AVX512VBMI__)
#include "obj_lines_avx512.h"
#else

// Constants of the loop over the lines.
struct constants {
    uint32_t index_limit; // indices of faces are below this limit
};
static inline struct constants constants_of(uint32_t index_limit) { return (struct constants){index_limit}; }

static inline uint64_t newlines_of(const struct constants *c, const uint8_t *block)
{
    (void)c;
    return byte_masks_newlines(block);
}

static inline bool read_triangle(const struct constants *c, const uint8_t *line, const uint8_t *line_end,
                                 uint32_t to[3])
{
    const uint8_t *at = line + 1;
    for (int i = 0; i < 3; i++) {
        if (*at != ' ')
            return false;
        uint64_t eight = number_load8(++at);
        unsigned digits = number_digit_count(eight);
        uint64_t index = number_digits_value(eight, digits) - 1;
        if (digits == 0 || index >= c->index_limit)
            return false;
        to[i] = (uint32_t)index;
        at += digits;
    }
    return at + (*at == '\r') == line_end;
}

static inline bool read_coordinates(const struct constants *c, const uint8_t *line, const uint8_t *line_end,
                                    float out[3])
{
    (void)c;
    const uint8_t *at = line + 1;
    for (int i = 0; i < 3; i++) {
        at = *at == ' ' ? number_float_quick(at + 1, line_end, &out[i]) : NULL;
        if (!at)
            return false;
    }
    float sum = (out[0] - out[0]) + (out[1] - out[1]) + (out[2] - out[2]);
    return at + (*at == '\r') == line_end && sum == 0; // all numbers are finite
}

#endif

// The output position of the fast path. A local variable of this type stays in registers, unlike `reader`.
struct output {
    float *position, *positions_end;
    uint32_t *corners, *corners_end;
    struct box {
#if defined(__AVX512VBMI__)
        __m128 low, high;
#else
        float low[4], high[4];
#endif
    } box;
};

static inline struct output load_output(const struct obj_reader *reader)
{
    const struct obj *obj = reader->obj;
    struct output output = {
        .position = obj->positions + 3 * reader->next.positions,
        .positions_end = obj->positions + 3 * (obj->colors ? 0 : reader->limit.positions),
        .corners = obj->indices + 3 * reader->next.triangles,
        .corners_end = obj->indices + 3 * reader->limit.triangles,
    };
    memcpy(&output.box.low, reader->low, sizeof reader->low);
    memcpy(&output.box.high, reader->high, sizeof reader->high);
    return output;
}

static inline void store_output(const struct output *output, struct obj_reader *reader)
{
    const struct obj *obj = reader->obj;
    reader->next.positions = (uint64_t)(output->position - obj->positions) / 3;
    reader->next.triangles = (uint64_t)(output->corners - obj->indices) / 3;
    memcpy(reader->low, &output->box.low, sizeof reader->low);
    memcpy(reader->high, &output->box.high, sizeof reader->high);
}

static inline bool append_triangle(struct output *output, const struct constants *c, const uint8_t *line,
                                   const uint8_t *line_end)
{
    if (output->corners >= output->corners_end || !read_triangle(c, line, line_end, output->corners))
        return false;
    output->corners += 3;
    return true;
}

static inline bool append_position(struct output *output, const struct constants *c, const uint8_t *line,
                                   const uint8_t *line_end)
{
    if (output->position >= output->positions_end)
        return false;
    struct box *box = &output->box;
#if defined(__AVX512VBMI__)
    __m128 three;
    if (!read_coordinates(c, line, line_end, &three))
        return false;
    _mm_storel_pi((__m64 *)(void *)output->position, three);
    _mm_store_ss(output->position + 2, _mm_movehl_ps(three, three));
    box->low = _mm_min_ps(three, box->low);
    box->high = _mm_max_ps(three, box->high);
#else
    float *three = output->position;
    if (!read_coordinates(c, line, line_end, three))
        return false;
    for (int i = 0; i < 3; i++) {
        box->low[i] = three[i] < box->low[i] ? three[i] : box->low[i];
        box->high[i] = three[i] > box->high[i] ? three[i] : box->high[i];
    }
#endif
    output->position += 3;
    return true;
}

// Line ends are found 64 bytes at a time, so that reading a line does not depend on the previous line.
const uint8_t *JOIN(obj_read_lines_, ISA)(struct obj_reader *reader, const uint8_t *line, const uint8_t *end)
{
    const struct obj *obj = reader->obj;
    const bool plain_faces = !obj->texcoord_indices && !obj->normal_indices;
    const struct constants constants = constants_of(plain_faces ? (uint32_t)obj->total.positions : 0);
    struct output output = load_output(reader);
    for (const uint8_t *block = line;; block += 64) {
        for (uint64_t ends = newlines_of(&constants, block); ends; ends &= ends - 1) {
            const uint8_t *line_end = block + __builtin_ctzll(ends);
            if (!(line[0] == 'f'   ? append_triangle(&output, &constants, line, line_end)
                  : line[0] == 'v' ? append_position(&output, &constants, line, line_end)
                                   : false)) {
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
