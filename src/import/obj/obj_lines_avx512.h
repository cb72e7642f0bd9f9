// obj_lines_avx512.h: the line parsers of obj_lines.c for AVX-512 with VBMI. VBMI instructions can move any byte of a
// register to any position.
//
// A line is loaded into one register, and bit masks of its digits, spaces and points are computed. The starts and ends
// of the numbers are packed into bytes. From these bytes, the parser computes a permutation that moves every number to
// its own lane, right-aligned and padded with leading zeros.
#ifndef OBJ_LINES_AVX512_H
#define OBJ_LINES_AVX512_H

#include "number_scan.h"

#include <immintrin.h>
#include <stdbool.h>

static inline unsigned lowest_bit(uint64_t set) { return (unsigned)__builtin_ctzll(set); }
static inline uint64_t without_lowest(uint64_t set) { return set & (set - 1); }
// Moves a mask to a general register. Without the barrier, the compiler would use the mask registers for the
// calculations, which is slower.
static inline uint64_t mask_bits(__mmask64 bytes)
{
    uint64_t set = bytes;
    __asm__("" : "+r"(set));
    return set;
}
static inline uint32_t pack(unsigned a, unsigned b, unsigned c) { return a | b << 8 | c << 16; }

// Constants that stay in registers from line to line; the compiler would otherwise reload each constant before its use.
struct constants {
    __m512i newline, zero, nine, space, slash, point, minus, one;
    __m512i lanes_of_8, lanes_of_16;       // shuffle: copies byte k of a packed number to each byte of lane k
    __m512i back_8, back_16;               // the (negative) offset of each byte from the end of its lane
    __m512i tens, hundreds, ten_thousands; // weights of two adjacent values
    __m512d tenths_to_6, tenths_to_14;     // 10 to the power of 1 − i
    __m256i cut, middle, doubt;            // number_rounds_surely
    __m256i hundred_millions;
    __m128 sign;
    __m128i one_32, index_limit; // index_limit: the number of positions, or 0 if corners also have other attributes
    __m256i index_limits;        // per lane: position, texture coordinate, normal, position …
    __mmask8 index_lanes;        // the lanes that contain an index
};
static inline struct constants constants_of(const struct obj *obj)
{
    const bool plain = !obj->texcoord_indices && !obj->normal_indices;
    const int v = (int)obj->total.positions, vt = (int)obj->total.texcoords, vn = (int)obj->total.normals;
    const double *t = number_tenths;
    struct constants c = {
        .newline = _mm512_set1_epi8('\n'),
        .zero = _mm512_set1_epi8('0'),
        .nine = _mm512_set1_epi8(9),
        .space = _mm512_set1_epi8(' '),
        .slash = _mm512_set1_epi8('/'),
        .point = _mm512_set1_epi8('.'),
        .minus = _mm512_set1_epi8('-'),
        .one = _mm512_set1_epi8(1),
        .lanes_of_8 = _mm512_setr_epi64(0, 0x0101010101010101, 0x0202020202020202, 0x0303030303030303,
                                        0x0404040404040404, 0x0505050505050505, 0x0606060606060606, 0x0707070707070707),
        .lanes_of_16 = _mm512_setr_epi64(0, 0, 0x0101010101010101, 0x0101010101010101, 0x0202020202020202,
                                         0x0202020202020202, 0x0303030303030303, 0x0303030303030303),
        .back_8 = _mm512_set1_epi64((long long)0xfffefdfcfbfaf9f8u),
        .back_16 = _mm512_broadcast_i32x4(
            _mm_setr_epi8(-16, -15, -14, -13, -12, -11, -10, -9, -8, -7, -6, -5, -4, -3, -2, -1)),
        .tens = _mm512_set1_epi16(1 << 8 | 10),
        .hundreds = _mm512_set1_epi32(1 << 16 | 100),
        .ten_thousands = _mm512_set1_epi32(1 << 16 | 10000),
        .tenths_to_6 = _mm512_setr_pd(0, t[0], t[1], t[2], t[3], t[4], t[5], t[6]),
        .tenths_to_14 = _mm512_setr_pd(t[7], t[8], t[9], t[10], t[11], t[12], t[13], t[14]),
        .cut = _mm256_set1_epi64x(0x1fffffff),
        .middle = _mm256_set1_epi64x(0x0ffffffc),
        .doubt = _mm256_set1_epi64x(8),
        .hundred_millions = _mm256_set1_epi64x(100000000),
        .sign = _mm_set1_ps(-0.0f),
        .one_32 = _mm_set1_epi32(1),
        .index_limit = _mm_set1_epi32(plain ? v : 0),
        .index_limits = _mm256_setr_epi32(v, vt, vn, v, vt, vn, v, vt),
        .index_lanes = obj->texcoord_indices ? 0xff : 0x6d,
    };
    // Hides the values from the compiler, so that it keeps them in registers.
    __asm__("" : "+v"(c.newline), "+v"(c.zero), "+v"(c.nine), "+v"(c.space), "+v"(c.point), "+v"(c.minus));
    __asm__("" : "+v"(c.lanes_of_8), "+v"(c.lanes_of_16), "+v"(c.back_8), "+v"(c.back_16));
    __asm__("" : "+v"(c.tens), "+v"(c.hundreds), "+v"(c.ten_thousands), "+v"(c.tenths_to_6), "+v"(c.tenths_to_14));
    __asm__("" : "+v"(c.cut), "+v"(c.middle), "+v"(c.doubt), "+v"(c.hundred_millions), "+v"(c.sign));
    __asm__("" : "+v"(c.one), "+v"(c.one_32), "+v"(c.index_limit));
    return c;
}

static inline uint64_t newlines_of(const struct constants *c, const uint8_t *block)
{
    return mask_bits(_mm512_cmpeq_epi8_mask(_mm512_loadu_epi8(block), c->newline));
}

// Reads three numbers of one to eight digits, separated by one space, each from 1 to the index limit. Returns false if
// the line, which ends at `line_end`, has another form.
static inline bool read_triangle(const struct constants *c, const uint8_t *line, const uint8_t *line_end,
                                 uint32_t to[3])
{
    const uint8_t *at = line + 2;
    unsigned length = (unsigned)(line_end - at) - (line_end[-1] == '\r');
    if (line[1] != ' ' || length > 31)
        return false;
    __m256i bytes = _mm256_loadu_epi8(at), values = _mm256_sub_epi8(bytes, _mm512_castsi512_si256(c->zero));
    uint32_t inside = _bzhi_u32(UINT32_MAX, length);
    uint32_t digits = _mm256_cmple_epu8_mask(values, _mm512_castsi512_si256(c->nine)) & inside;
    uint32_t spaces = _mm256_cmpeq_epi8_mask(bytes, _mm512_castsi512_si256(c->space)) & inside;
    uint32_t second = (uint32_t)without_lowest(spaces);
    if ((digits | spaces) != inside || !second || without_lowest(second))
        return false;
    uint32_t ends = pack(lowest_bit(spaces), lowest_bit(second), length), begins = (ends << 8) + 0x010100;
    if (((ends - (begins & 0xffffff)) - 0x010101) & 0xf8f8f8) // a number has no digit or more than 8 digits
        return false;
    const __m256i lanes = _mm512_castsi512_si256(c->lanes_of_8);
    __m256i from =
        _mm256_add_epi8(_mm256_shuffle_epi8(_mm256_set1_epi32((int)ends), lanes), _mm512_castsi512_si256(c->back_8));
    __mmask32 is = _mm256_cmpge_epi8_mask(from, _mm256_shuffle_epi8(_mm256_set1_epi32((int)begins), lanes));
    // Adjacent values are combined in three steps: into numbers of two, four and eight digits.
    __m256i pairs =
        _mm256_maddubs_epi16(_mm256_maskz_permutexvar_epi8(is, from, values), _mm512_castsi512_si256(c->tens));
    __m256i fours = _mm256_madd_epi16(pairs, _mm512_castsi512_si256(c->hundreds));
    __m128i numbers = _mm_madd_epi16(_mm256_cvtepi32_epi16(fours), _mm512_castsi512_si128(c->ten_thousands));
    __m128i indices = _mm_sub_epi32(numbers, c->one_32);
    if (_mm_mask_cmpge_epu32_mask(7, indices, c->index_limit))
        return false;
    _mm_storel_epi64((__m128i *)(void *)to, indices);
    to[2] = (uint32_t)_mm_extract_epi32(indices, 2);
    return true;
}

static inline void store_indices(uint32_t *to, __m256i indices, __mmask8 lanes)
{
    const __m128i chosen = _mm256_castsi256_si128(_mm256_maskz_compress_epi32(lanes, indices));
    _mm_storel_epi64((__m128i *)(void *)to, chosen);
    to[2] = (uint32_t)_mm_extract_epi32(chosen, 2);
}

// Reads three corners, separated by one space, and stores them from corner `to` of the arrays. The form of a corner is
// 12/34/56, or 12//56 if texture coordinates are not kept. Eight of the nine numbers are computed in lanes.
static inline bool read_corners(const struct constants *c, const struct obj *obj, const uint8_t *line,
                                const uint8_t *line_end, size_t to)
{
    const uint8_t *at = line + 2;
    const unsigned length = (unsigned)(line_end - at) - (line_end[-1] == '\r');
    if (!obj->normal_indices || line[1] != ' ' || length > 63)
        return false;
    const __m512i bytes = _mm512_loadu_epi8(at), values = _mm512_sub_epi8(bytes, c->zero);
    const uint64_t inside = _bzhi_u64(UINT64_MAX, length);
    const uint64_t spaces = mask_bits(_mm512_cmpeq_epi8_mask(bytes, c->space)) & inside;
    const uint64_t slashes = mask_bits(_mm512_cmpeq_epi8_mask(bytes, c->slash)) & inside;
    uint64_t between = inside & ~mask_bits(_mm512_cmple_epu8_mask(values, c->nine)), ends = 0;
    if (between != (spaces | slashes) || _pext_u64(slashes, between) != 0xdb) // / / space / / space / /
        return false;
    for (int i = 0; i < 64; i += 8, between = without_lowest(between))
        ends |= (uint64_t)lowest_bit(between) << i;
    const uint64_t begins = (ends << 8) + 0x0101010101010100, last = (ends >> 56) + 1;
    const uint64_t texcoords = 0xff0000ff0000ff00, sizes = ends - begins;
    const uint64_t absent = obj->texcoord_indices ? 0 : texcoords;
    // The line is invalid if a number has no digit or more than 8 digits, or if the line contains further separators.
    if ((sizes & absent) | ((sizes - (0x0101010101010101 & ~absent)) & 0xf8f8f8f8f8f8f8f8) | between ||
        length - last - 1 > 7)
        return false;
    const __m512i from =
        _mm512_add_epi8(_mm512_shuffle_epi8(_mm512_set1_epi64((long long)ends), c->lanes_of_8), c->back_8);
    const __mmask64 is =
        _mm512_cmpge_epi8_mask(from, _mm512_shuffle_epi8(_mm512_set1_epi64((long long)begins), c->lanes_of_8));
    const __m512i pairs = _mm512_maddubs_epi16(_mm512_maskz_permutexvar_epi8(is, from, values), c->tens);
    const __m256i fours = _mm512_cvtepi32_epi16(_mm512_madd_epi16(pairs, c->hundreds));
    const __m256i numbers = _mm256_madd_epi16(fours, _mm512_castsi512_si256(c->ten_thousands));
    const __m256i indices = _mm256_sub_epi32(numbers, _mm256_set1_epi32(1));
    const uint64_t normal = number_digits_value(number_load8(at + last), length - (unsigned)last) - 1;
    if (_mm256_mask_cmpge_epu32_mask(c->index_lanes, indices, c->index_limits) || normal >= obj->total.normals)
        return false;
    store_indices(obj->indices + to, indices, 1 << 0 | 1 << 3 | 1 << 6);
    if (obj->texcoord_indices)
        store_indices(obj->texcoord_indices + to, indices, 1 << 1 | 1 << 4 | 1 << 7);
    store_indices(obj->normal_indices + to, indices, 1 << 2 | 1 << 5);
    obj->normal_indices[to + 2] = (uint32_t)normal;
    return true;
}

// Reads three numbers like -12.3456, separated by one space. Each number has 2 to 15 digits, at least one on each side
// of the point.
static inline bool read_coordinates(const struct constants *c, const uint8_t *line, const uint8_t *line_end,
                                    __m128 *out)
{
    const uint8_t *at = line + 2;
    unsigned length = (unsigned)(line_end - at) - (line_end[-1] == '\r');
    if (line[1] != ' ' || length > 63)
        return false;
    __m512i bytes = _mm512_loadu_epi8(at), values = _mm512_sub_epi8(bytes, c->zero);
    uint64_t inside = _bzhi_u64(UINT64_MAX, length);
    uint64_t digits = mask_bits(_mm512_cmple_epu8_mask(values, c->nine)) & inside;
    uint64_t spaces = mask_bits(_mm512_cmpeq_epi8_mask(bytes, c->space)) & inside;
    uint64_t points = mask_bits(_mm512_cmpeq_epi8_mask(bytes, c->point)) & inside;
    uint64_t starts = spaces << 1 | 1, signs = mask_bits(_mm512_cmpeq_epi8_mask(bytes, c->minus)) & starts & inside;
    // The line is invalid if it contains other bytes. Digits must begin at the start of a number or after its sign or
    // point. The separators must be point, space, point, space, point.
    uint64_t between = spaces | points, invalid = (digits | signs | between) ^ inside;
    invalid |= (digits & ~(digits << 1)) ^ ((starts & ~signs) | (signs | points) << 1);
    if (invalid | (_pext_u64(points, between) ^ 21) | (_pext_u64(spaces, between) ^ 10))
        return false;
    uint64_t points_2 = without_lowest(points), negative = _pext_u64(signs, starts);
    uint32_t ends = pack(lowest_bit(spaces), lowest_bit(without_lowest(spaces)), length);
    uint32_t middles = pack(lowest_bit(points), lowest_bit(points_2), lowest_bit(without_lowest(points_2)));
    uint32_t begins = (ends << 8) + 0x010100 + (uint32_t)_pdep_u64(negative, 0x010101);
    if (((ends - (begins & 0xffffff)) - 0x010101) & 0xf0f0f0) // a number has more than 15 digits
        return false;
    __m512i from = _mm512_add_epi8(_mm512_shuffle_epi8(_mm512_set1_epi32((int)ends), c->lanes_of_16), c->back_16);
    __m512i point_at = _mm512_shuffle_epi8(_mm512_set1_epi32((int)middles), c->lanes_of_16);
    __m512i begin_at = _mm512_shuffle_epi8(_mm512_set1_epi32((int)begins), c->lanes_of_16);
    from = _mm512_mask_sub_epi8(from, _mm512_cmple_epi8_mask(from, point_at), from, c->one);
    __m512i lanes = _mm512_maskz_permutexvar_epi8(_mm512_cmpge_epi8_mask(from, begin_at), from, values);
    __m512i fours = _mm512_madd_epi16(_mm512_maddubs_epi16(lanes, c->tens), c->hundreds);
    __m256i eights = _mm256_madd_epi16(_mm512_cvtepi32_epi16(fours), _mm512_castsi512_si256(c->ten_thousands));
    // whole = first · 10⁸ + second of each pair
    __m256i whole = _mm256_add_epi64(_mm256_mul_epu32(eights, c->hundred_millions), _mm256_srli_epi64(eights, 32));
    __m512i decimals = _mm512_cvtepu8_epi64(_mm_cvtsi32_si128((int)(ends - middles))); // digits after the point, plus 1
    __m256d tenths = _mm512_castpd512_pd256(_mm512_permutex2var_pd(c->tenths_to_6, decimals, c->tenths_to_14));
    __m256d product = _mm256_mul_pd(_mm256_cvtepi64_pd(whole), tenths); // the same computation as in number_float_quick
    __m256i off = _mm256_sub_epi64(_mm256_and_si256(_mm256_castpd_si256(product), c->cut), c->middle);
    if (_mm256_cmple_epu64_mask(off, c->doubt)) // the test of number_rounds_surely; the unused fourth lane is 0
        return false;
    __m128 result = _mm256_cvtpd_ps(product);
    *out = _mm_mask_xor_ps(result, (__mmask8)negative, result, c->sign);
    return true;
}

#endif
