// obj_lines.c: the lines that OBJ files are full of, "v x y z" and "f a b c", by straight code; all others
// are handed to obj_parse.c. Compiled for several instruction sets (meson.build, with ISA), which give the
// same numbers: where one is not sure of a number's last bit, base/number.c decides.
#include "byte_masks.h"
#include "number_scan.h"
#include "obj.h"

#if defined(__AVX512VBMI2__)
#include <immintrin.h>
#endif

#if !defined(ISA)
#define ISA plain
#endif
#define JOIN_(a, b) a##b
#define JOIN(a, b)  JOIN_(a, b)

#if defined(__AVX512VBMI2__)

// A line's bytes are one register: sets of bits say what is a digit, a space or a point, and how many digits
// each number has. All digits are moved together, and from there each number's to the end of a lane of its
// own, behind zeros.

static inline unsigned first_of(uint64_t set) { return (unsigned)__builtin_ctzll(set); }
static inline uint64_t but_first(uint64_t set) { return set & (set - 1); }

// Neighbours are joined: digits to pairs, pairs to fours; then, as 16 bits each, fours to numbers of eight.
#define TENS          (1 << 8 | 10)
#define HUNDREDS      (1 << 16 | 100)
#define TEN_THOUSANDS (1 << 16 | 10000)

// Three numbers of one to eight digits, one space between them, each from 1 to `most`. Whether that is the
// line, which ends at `stop`.
static inline bool read_triangle(const uint8_t *line, const uint8_t *stop, uint32_t most, uint32_t to[3])
{
    const uint8_t *at = line + 2;
    unsigned length = (unsigned)(stop - at) - (stop[-1] == '\r');
    if (line[1] != ' ' || length > 31)
        return false;
    __m256i bytes = _mm256_loadu_epi8(at), values = _mm256_sub_epi8(bytes, _mm256_set1_epi8('0'));
    uint32_t inside = _bzhi_u32(UINT32_MAX, length);
    uint32_t digits = _mm256_cmple_epu8_mask(values, _mm256_set1_epi8(9)) & inside;
    uint32_t spaces = _mm256_cmpeq_epi8_mask(bytes, _mm256_set1_epi8(' ')) & inside;
    uint32_t second = (uint32_t)but_first(spaces);
    if ((digits | spaces) != inside || !second || but_first(second))
        return false;
    unsigned a = first_of(spaces), b = first_of(second) - a - 1, c = length - 2 - a - b;
    if (((a - 1) | (b - 1) | (c - 1)) >= 8)
        return false;
    __mmask32 ends = (0xff00u >> a & 0xff) | (0xff00u >> b & 0xff) << 8 | (0xff00u >> c & 0xff) << 16;
    __m256i lanes = _mm256_maskz_expand_epi8(ends, _mm256_maskz_compress_epi8(digits, values));
    __m256i pairs = _mm256_maddubs_epi16(lanes, _mm256_set1_epi16(TENS));
    __m256i fours = _mm256_madd_epi16(pairs, _mm256_set1_epi32(HUNDREDS));
    __m128i numbers = _mm_madd_epi16(_mm256_cvtepi32_epi16(fours), _mm_set1_epi32(TEN_THOUSANDS));
    __m128i indices = _mm_sub_epi32(numbers, _mm_set1_epi32(1));
    if (_mm_mask_cmpge_epu32_mask(7, indices, _mm_set1_epi32((int)most)))
        return false;
    _mm_mask_storeu_epi32(to, 7, indices);
    return true;
}

// Three numbers like -12.3456, of 2 to 15 digits with some on both sides of the point, one space between
// them.
static inline bool read_point_numbers(const uint8_t *line, const uint8_t *stop, __m128 *out)
{
    const uint8_t *at = line + 2;
    unsigned length = (unsigned)(stop - at) - (stop[-1] == '\r');
    if (line[1] != ' ' || length > 63)
        return false;
    __m512i bytes = _mm512_loadu_epi8(at), values = _mm512_sub_epi8(bytes, _mm512_set1_epi8('0'));
    uint64_t inside = _bzhi_u64(UINT64_MAX, length);
    uint64_t digits = _mm512_cmple_epu8_mask(values, _mm512_set1_epi8(9)) & inside;
    uint64_t spaces = _mm512_cmpeq_epi8_mask(bytes, _mm512_set1_epi8(' ')) & inside;
    uint64_t points = _mm512_cmpeq_epi8_mask(bytes, _mm512_set1_epi8('.')) & inside;
    uint64_t signs = _mm512_cmpeq_epi8_mask(bytes, _mm512_set1_epi8('-')) & (spaces << 1 | 1);
    uint64_t spaces_2 = but_first(spaces), points_2 = but_first(points), points_3 = but_first(points_2);
    if ((digits | spaces | points | signs) != inside || !spaces_2 || !points_3 || but_first(spaces_2) ||
        but_first(points_3))
        return false;
    // Ends of the first two, digits of each, those behind the point.
    int x_end = (int)first_of(spaces), y_end = (int)first_of(spaces_2);
    int x = (int)_mm_popcnt_u64(_bzhi_u64(digits, (unsigned)x_end));
    int xy = (int)_mm_popcnt_u64(_bzhi_u64(digits, (unsigned)y_end)), y = xy - x;
    int z = (int)_mm_popcnt_u64(digits) - xy;
    int x_behind = x_end - (int)first_of(points) - 1, y_behind = y_end - (int)first_of(points_2) - 1;
    int z_behind = (int)length - (int)first_of(points_3) - 1;
    if (((x_behind - 1) | (y_behind - 1) | (z_behind - 1) | (x - x_behind - 1) | (y - y_behind - 1) |
         (z - z_behind - 1) | (15 - x) | (15 - y) | (15 - z)) < 0)
        return false;
    __mmask64 ends = (0xffff0000u >> x & 0xffff) | (uint64_t)(0xffff0000u >> y & 0xffff) << 16 |
                     (uint64_t)(0xffff0000u >> z & 0xffff) << 32;
    __m512i lanes = _mm512_maskz_expand_epi8(ends, _mm512_maskz_compress_epi8(digits, values));
    __m512i pairs = _mm512_maddubs_epi16(lanes, _mm512_set1_epi16(TENS));
    __m512i fours = _mm512_madd_epi16(pairs, _mm512_set1_epi32(HUNDREDS));
    __m256i eights = _mm256_madd_epi16(_mm512_cvtepi32_epi16(fours), _mm256_set1_epi32(TEN_THOUSANDS));
    // Of each two the first counts 10⁸.
    __m256i whole = _mm256_add_epi64(_mm256_mul_epu32(eights, _mm256_set1_epi64x(100000000)),
                                     _mm256_srli_epi64(eights, 32));
    __m256d tenths =
        _mm256_setr_pd(number_tenths[x_behind], number_tenths[y_behind], number_tenths[z_behind], 1);
    __m256d product = _mm256_mul_pd(_mm256_cvtepi64_pd(whole), tenths); // as number_float_quick has it
    __m256i cut = _mm256_and_si256(_mm256_castpd_si256(product), _mm256_set1_epi64x(0x1fffffff));
    __m256i off = _mm256_sub_epi64(cut, _mm256_set1_epi64x(0x0ffffffc));
    if (_mm256_cmple_epu64_mask(off,
                                _mm256_set1_epi64x(8))) // number_rounds_surely; the fourth is 0, and sure
        return false;
    __m128 result = _mm256_cvtpd_ps(product);
    *out = _mm_mask_xor_ps(result, (__mmask8)_pext_u64(signs, spaces << 1 | 1), result, _mm_set1_ps(-0.0f));
    return true;
}

#else

static inline bool read_triangle(const uint8_t *line, const uint8_t *stop, uint32_t most, uint32_t to[3])
{
    const uint8_t *at = line + 1;
    for (int i = 0; i < 3; i++) {
        if (*at != ' ')
            return false;
        uint64_t eight = number_load8(++at);
        unsigned digits = number_digit_count(eight);
        uint64_t index = number_digits_value(eight, digits) - 1;
        if (digits == 0 || index >= most)
            return false;
        to[i] = (uint32_t)index;
        at += digits;
    }
    return at + (*at == '\r') == stop;
}

// One number like -1.234, of one digit before the point and up to eight behind it: the place behind.
static inline const uint8_t *read_point_number(const uint8_t *at, float *out)
{
    uint64_t minus = *at == '-';
    at += minus;
    uint64_t whole = (uint64_t)*at - '0', eight = number_load8(at + 2);
    unsigned fraction = number_digit_count(eight);
    uint64_t value = whole * number_integer_powers[fraction] + number_digits_value(eight, fraction);
    double x = (double)(int64_t)value * number_tenths[fraction];
    if (whole > 9 || at[1] != '.' || fraction == 0 || !number_rounds_surely(x))
        return NULL;
    *out = (float)(minus ? -x : x);
    return at + 2 + fraction;
}

static inline bool read_point_numbers(const uint8_t *line, const uint8_t *stop, float out[3])
{
    const uint8_t *at = line + 1;
    for (int i = 0; i < 3; i++) {
        at = *at == ' ' ? read_point_number(at + 1, &out[i]) : NULL;
        if (!at)
            return false;
    }
    return at + (*at == '\r') == stop;
}

#endif

// Where plain lines go, at hand: the compiler keeps it in registers, which `reader` may not be kept in.
struct hand {
    float *position, *positions_end;
    uint32_t *corners, *corners_end;
    uint32_t most; // positions; 0: no face is plain
    struct box {
#if defined(__AVX512VBMI2__)
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
        .most = obj->texcoord_indices || obj->normal_indices ? 0 : (uint32_t)obj->total.positions,
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

static inline bool take_triangle(struct hand *hand, const uint8_t *line, const uint8_t *stop)
{
    if (hand->corners >= hand->corners_end || !hand->most ||
        !read_triangle(line, stop, hand->most, hand->corners))
        return false;
    hand->corners += 3;
    return true;
}

static inline bool take_position(struct hand *hand, const uint8_t *line, const uint8_t *stop)
{
    if (hand->position >= hand->positions_end)
        return false;
    struct box *box = &hand->box;
#if defined(__AVX512VBMI2__)
    __m128 three;
    if (!read_point_numbers(line, stop, &three))
        return false;
    _mm_mask_storeu_ps(hand->position, 7, three);
    box->low = _mm_min_ps(three, box->low);
    box->high = _mm_max_ps(three, box->high);
#else
    float *three = hand->position;
    if (!read_point_numbers(line, stop, three))
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
    struct hand hand = take_up(reader);
    for (const uint8_t *block = line;; block += 64) {
        for (uint64_t ends = byte_masks_newlines(block); ends; ends &= ends - 1) {
            const uint8_t *stop = block + __builtin_ctzll(ends);
            if (!(line[0] == 'f'   ? take_triangle(&hand, line, stop)
                  : line[0] == 'v' ? take_position(&hand, line, stop)
                                   : false)) {
                put_down(&hand, reader);
                const uint8_t *behind = obj_read_line(reader, line);
                if (behind != stop + 1)
                    return behind;
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
