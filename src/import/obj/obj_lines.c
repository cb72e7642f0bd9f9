// obj_lines.c: the lines that OBJ files are full of, "v x y z" and "f a b c", by straight code; all others
// are handed to obj_parse.c. Compiled for several instruction sets (meson.build, with ISA), which give the
// same numbers: where one is not sure of a number's last bit, base/number.c decides.
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

// Numbers that every line needs; none here but:
struct constants {
    uint32_t max;
};
static inline struct constants constants_of(uint32_t max) { return (struct constants){max}; }

static inline uint64_t newlines_of(const struct constants *c, const uint8_t *block)
{
    (void)c;
    return byte_masks_newlines(block);
}

static inline bool read_triangle(const struct constants *c, const uint8_t *line, const uint8_t *stop, uint32_t to[3])
{
    const uint8_t *at = line + 1;
    for (int i = 0; i < 3; i++) {
        if (*at != ' ')
            return false;
        uint64_t eight = number_load8(++at);
        unsigned digits = number_digit_count(eight);
        uint64_t index = number_digits_value(eight, digits) - 1;
        if (digits == 0 || index >= c->max)
            return false;
        to[i] = (uint32_t)index;
        at += digits;
    }
    return at + (*at == '\r') == stop;
}

static inline bool read_coordinates(const struct constants *c, const uint8_t *line, const uint8_t *stop, float out[3])
{
    (void)c;
    const uint8_t *at = line + 1;
    for (int i = 0; i < 3; i++) {
        at = *at == ' ' ? number_float_quick(at + 1, stop, &out[i]) : NULL;
        if (!at)
            return false;
    }
    float sum = (out[0] - out[0]) + (out[1] - out[1]) + (out[2] - out[2]);
    return at + (*at == '\r') == stop && sum == 0; // all are finite
}

#endif

// Where plain lines go, at hand: the compiler keeps it in registers, which `reader` may not be kept in.
struct hand {
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

static inline struct hand take_up(const struct obj_reader *reader)
{
    const struct obj *obj = reader->obj;
    struct hand hand = {
        .position = obj->positions + 3 * reader->at.positions,
        .positions_end = obj->positions + 3 * (obj->colors ? 0 : reader->limit.positions),
        .corners = obj->indices + 3 * reader->at.triangles,
        .corners_end = obj->indices + 3 * reader->limit.triangles,
    };
    memcpy(&hand.box.low, reader->low, sizeof reader->low);
    memcpy(&hand.box.high, reader->high, sizeof reader->high);
    return hand;
}

static inline void put_down(const struct hand *hand, struct obj_reader *reader)
{
    const struct obj *obj = reader->obj;
    reader->at.positions = (uint64_t)(hand->position - obj->positions) / 3;
    reader->at.triangles = (uint64_t)(hand->corners - obj->indices) / 3;
    memcpy(reader->low, &hand->box.low, sizeof reader->low);
    memcpy(reader->high, &hand->box.high, sizeof reader->high);
}

static inline bool take_triangle(struct hand *hand, const struct constants *c, const uint8_t *line, const uint8_t *stop)
{
    if (hand->corners >= hand->corners_end || !read_triangle(c, line, stop, hand->corners))
        return false;
    hand->corners += 3;
    return true;
}

static inline bool take_position(struct hand *hand, const struct constants *c, const uint8_t *line, const uint8_t *stop)
{
    if (hand->position >= hand->positions_end)
        return false;
    struct box *box = &hand->box;
#if defined(__AVX512VBMI__)
    __m128 three;
    if (!read_coordinates(c, line, stop, &three))
        return false;
    _mm_storel_pi((__m64 *)(void *)hand->position, three);
    _mm_store_ss(hand->position + 2, _mm_movehl_ps(three, three));
    box->low = _mm_min_ps(three, box->low);
    box->high = _mm_max_ps(three, box->high);
#else
    float *three = hand->position;
    if (!read_coordinates(c, line, stop, three))
        return false;
    for (int i = 0; i < 3; i++) {
        box->low[i] = three[i] < box->low[i] ? three[i] : box->low[i];
        box->high[i] = three[i] > box->high[i] ? three[i] : box->high[i];
    }
#endif
    hand->position += 3;
    return true;
}

// Line ends are found 64 bytes at a time, so that no line's reading waits for the numbers of the one before.
const uint8_t *JOIN(obj_read_lines_, ISA)(struct obj_reader *reader, const uint8_t *line, const uint8_t *end)
{
    const struct obj *obj = reader->obj;
    const bool plain_faces = !obj->texcoord_indices && !obj->normal_indices;
    const struct constants constants = constants_of(plain_faces ? (uint32_t)obj->total.positions : 0);
    struct hand hand = take_up(reader);
    for (const uint8_t *block = line;; block += 64) {
        for (uint64_t ends = newlines_of(&constants, block); ends; ends &= ends - 1) {
            const uint8_t *stop = block + __builtin_ctzll(ends);
            if (!(line[0] == 'f'   ? take_triangle(&hand, &constants, line, stop)
                  : line[0] == 'v' ? take_position(&hand, &constants, line, stop)
                                   : false)) {
                put_down(&hand, reader);
                const uint8_t *after = obj_read_line(reader, line);
                if (after != stop + 1)
                    return after;
                hand = take_up(reader);
            }
            line = stop + 1;
            if (line >= end) {
                put_down(&hand, reader);
                return line;
            }
        }
        if (block + 64 >= end) { // the file's last line, without an end
            put_down(&hand, reader);
            return obj_read_line(reader, line);
        }
    }
}
