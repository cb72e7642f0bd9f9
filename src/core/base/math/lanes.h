// lanes.h: SIMD values of LANES numbers. Define LANES as 1, 4, 8 or 16 before including this file.
//
//  num    LANES floats          inum   LANES 32-bit integers          mask   LANES truth values (from comparisons)
//
// If LANES is 1, a num is a float and the same source is ordinary C. Otherwise a num is a GCC/Clang vector type, which
// compiles for any instruction set; a vector that is wider than a register occupies several registers. The code
// therefore runs on every machine with every width. All widths give bit-identical results, because all operations (+ −
// × ÷ √, never fused) are correctly rounded. All intrinsics for lanes are in this file. (Two other files use
// intrinsics: src/formats/import/obj/byte_masks.h, which reads text one register at a time, and float_state.h, which sets the
// floating-point control register.) Code that works on lanes uses only the functions below and + − * / < <= > >= == !=.
// A vector operator accepts a C float on one side, but a variable initialised with a float needs num_of().
#ifndef LANES_H
#define LANES_H

#include <stdint.h>
#include <string.h>

#ifndef LANES
#error "define LANES as 1, 4, 8 or 16 before including lanes.h"
#endif

#if defined(__AVX512F__) || defined(__AVX__) || defined(__SSE4_1__) || defined(__SSE2__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

// The name of a function or table in the version for one instruction set: FOR_ISA(pass) is pass_avx2 if ISA is avx2.
#define JOIN_ISA(name, isa)    name##_##isa
#define NAME_OF_ISA(name, isa) JOIN_ISA(name, isa)
#define FOR_ISA(name)          NAME_OF_ISA(name, ISA)

// These functions are always inlined, so that lanes stay in registers. The exception is code that computes one pixel at
// a time (src/core/cpu/kernels.h): there, small code is more important.
#ifdef RECORDING
#define LANE_FN static inline __attribute__((unused))
#else
#define LANE_FN static inline __attribute__((always_inline, unused))
#endif

#if LANES == 1
typedef float num;
typedef int32_t inum;
typedef int32_t mask; // 0 or 1
#else
typedef float num __attribute__((vector_size(LANES * 4)));
typedef int32_t inum __attribute__((vector_size(LANES * 4)));
typedef inum mask; // each lane is 0 or −1
typedef uint32_t unsigned_lanes __attribute__((vector_size(LANES * 4)));
// The same types for memory that is aligned to 4 bytes or more. Loads and stores use these types.
typedef float num_memory __attribute__((vector_size(LANES * 4), aligned(4), may_alias));
typedef int32_t inum_memory __attribute__((vector_size(LANES * 4), aligned(4), may_alias));
#endif

// Sets all lanes to one number.
LANE_FN num num_of(float x)
{
#if LANES == 1
    return x;
#else
    return x - (num){0};
#endif
}
LANE_FN inum inum_of(int32_t x)
{
#if LANES == 1
    return x;
#else
    return x - (inum){0};
#endif
}

// Returns 0, 1, 2, … LANES − 1.
LANE_FN inum lane_numbers(void)
{
#if LANES == 1
    return 0;
#elif LANES == 4
    return (inum){0, 1, 2, 3};
#elif LANES == 8
    return (inum){0, 1, 2, 3, 4, 5, 6, 7};
#else
    return (inum){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
#endif
}

#if LANES == 1
LANE_FN num num_load(const float *at) { return *at; }
LANE_FN void num_store(float *at, num x) { *at = x; }
LANE_FN inum inum_load(const int32_t *at) { return *at; }
LANE_FN void inum_store(int32_t *at, inum x) { *at = x; }
LANE_FN inum bits_of(num x)
{
    inum i;
    memcpy(&i, &x, 4);
    return i;
}
LANE_FN num num_of_bits(inum i)
{
    num x;
    memcpy(&x, &i, 4);
    return x;
}
LANE_FN num pick(mask m, num a, num b) { return m ? a : b; } // selects a if m is set, otherwise b
LANE_FN inum ipick(mask m, inum a, inum b) { return m ? a : b; }
LANE_FN mask both(mask a, mask b) { return a & b; }
LANE_FN mask either(mask a, mask b) { return a | b; }
LANE_FN mask negate(mask a) { return !a; }
LANE_FN int any_lane(mask m) { return m != 0; }
LANE_FN int all_lanes(mask m) { return m != 0; }
LANE_FN unsigned mask_bits(mask m) { return m != 0; } // bit i represents lane i
// Rounds towards zero. |x| must be below 2³¹ and not NaN, so clamp x first.
LANE_FN inum int_of(num x) { return (int32_t)x; }
LANE_FN num num_of_int(inum i) { return (float)i; }
LANE_FN inum wrap_add(inum a, inum b) { return (int32_t)((uint32_t)a + (uint32_t)b); } // modulo 2³²
LANE_FN inum wrap_sub(inum a, inum b) { return (int32_t)((uint32_t)a - (uint32_t)b); }
LANE_FN inum wrap_mul(inum a, inum b) { return (int32_t)((uint32_t)a * (uint32_t)b); }
LANE_FN inum shift_left(inum i, int n) { return (int32_t)((uint32_t)i << n); }
LANE_FN inum shift_right(inum i, int n) { return i >> n; } // keeps the sign
LANE_FN num square_root(num x) { return __builtin_sqrtf(x); }
LANE_FN float lane(num x, int i)
{
    (void)i;
    return x;
}
LANE_FN int32_t ilane(inum x, int i)
{
    (void)i;
    return x;
}
#else
LANE_FN num num_load(const float *at) { return (num) * (const num_memory *)at; }
LANE_FN void num_store(float *at, num x) { *(num_memory *)at = (num_memory)x; }
LANE_FN inum inum_load(const int32_t *at) { return (inum) * (const inum_memory *)at; }
LANE_FN void inum_store(int32_t *at, inum x) { *(inum_memory *)at = (inum_memory)x; }
LANE_FN inum bits_of(num x) { return (inum)x; }
LANE_FN num num_of_bits(inum i) { return (num)i; }
LANE_FN num pick(mask m, num a, num b) { return (num)(((inum)a & m) | ((inum)b & ~m)); }
LANE_FN inum ipick(mask m, inum a, inum b) { return (a & m) | (b & ~m); }
LANE_FN mask both(mask a, mask b) { return a & b; }
LANE_FN mask either(mask a, mask b) { return a | b; }
LANE_FN mask negate(mask a) { return ~a; }
LANE_FN inum int_of(num x) { return __builtin_convertvector(x, inum); }
LANE_FN num num_of_int(inum i) { return __builtin_convertvector(i, num); }
LANE_FN inum wrap_add(inum a, inum b) { return (inum)((unsigned_lanes)a + (unsigned_lanes)b); }
LANE_FN inum wrap_sub(inum a, inum b) { return (inum)((unsigned_lanes)a - (unsigned_lanes)b); }
LANE_FN inum wrap_mul(inum a, inum b) { return (inum)((unsigned_lanes)a * (unsigned_lanes)b); }
LANE_FN inum shift_left(inum i, int n) { return (inum)((unsigned_lanes)i << n); }
LANE_FN inum shift_right(inum i, int n) { return i >> n; }
LANE_FN float lane(num x, int i) { return x[i]; }
LANE_FN int32_t ilane(inum x, int i) { return x[i]; }
LANE_FN unsigned mask_bits(mask m)
{
#if LANES == 16 && defined(__AVX512DQ__)
    return (unsigned)_mm512_movepi32_mask((__m512i)m);
#elif LANES == 8 && defined(__AVX__)
    return (unsigned)_mm256_movemask_ps((__m256)m);
#elif LANES == 4 && defined(__SSE2__)
    return (unsigned)_mm_movemask_ps((__m128)m);
#elif LANES == 4 && defined(__wasm_simd128__)
    return wasm_i32x4_bitmask((v128_t)m);
#else
    unsigned bits = 0;
    for (int i = 0; i < LANES; i++)
        bits |= (unsigned)(m[i] & 1) << i;
    return bits;
#endif
}
#if LANES == 4 && defined(__wasm_simd128__)
LANE_FN int any_lane(mask m) { return wasm_v128_any_true((v128_t)m); }
LANE_FN int all_lanes(mask m) { return wasm_i32x4_all_true((v128_t)m); }
#else
LANE_FN int any_lane(mask m) { return mask_bits(m) != 0; }
LANE_FN int all_lanes(mask m) { return mask_bits(m) == (1u << LANES) - 1; }
#endif
// Returns √x, correctly rounded. Clang turns the plain loop into scalar code for AVX-512, so this function uses
// intrinsics.
LANE_FN num square_root(num x)
{
#if LANES == 16 && defined(__AVX512F__)
    return (num)_mm512_sqrt_ps((__m512)x);
#elif LANES == 8 && defined(__AVX__)
    return (num)_mm256_sqrt_ps((__m256)x);
#elif LANES == 4 && defined(__SSE2__)
    return (num)_mm_sqrt_ps((__m128)x);
#elif LANES == 4 && defined(__wasm_simd128__)
    return (num)wasm_f32x4_sqrt((v128_t)x);
#else
    num r = x;
    for (int i = 0; i < LANES; i++)
        r[i] = __builtin_sqrtf(x[i]);
    return r;
#endif
}
#endif

// The minimum and maximum of a and b. The result is b if either is NaN, or if both are zeros, because the x86
// instructions work like this. A comparison and a selection would take twice as long.
#if LANES == 16 && defined(__AVX512F__)
LANE_FN num min_of(num a, num b) { return (num)_mm512_min_ps((__m512)a, (__m512)b); }
LANE_FN num max_of(num a, num b) { return (num)_mm512_max_ps((__m512)a, (__m512)b); }
#elif LANES == 8 && defined(__AVX__)
LANE_FN num min_of(num a, num b) { return (num)_mm256_min_ps((__m256)a, (__m256)b); }
LANE_FN num max_of(num a, num b) { return (num)_mm256_max_ps((__m256)a, (__m256)b); }
#elif LANES == 4 && defined(__SSE2__)
LANE_FN num min_of(num a, num b) { return (num)_mm_min_ps((__m128)a, (__m128)b); }
LANE_FN num max_of(num a, num b) { return (num)_mm_max_ps((__m128)a, (__m128)b); }
#elif LANES == 4 && defined(__wasm_simd128__)
// WebAssembly defines pmin(x, y) as y < x ? y : x, so the operands are swapped here.
LANE_FN num min_of(num a, num b) { return (num)wasm_f32x4_pmin((v128_t)b, (v128_t)a); }
LANE_FN num max_of(num a, num b) { return (num)wasm_f32x4_pmax((v128_t)b, (v128_t)a); }
#else
LANE_FN num min_of(num a, num b) { return pick(a < b, a, b); }
LANE_FN num max_of(num a, num b) { return pick(a > b, a, b); }
#endif
// gcc does not combine an integer comparison and a selection into one instruction.
#if LANES == 16 && defined(__AVX512F__)
LANE_FN inum imin_of(inum a, inum b) { return (inum)_mm512_min_epi32((__m512i)a, (__m512i)b); }
LANE_FN inum imax_of(inum a, inum b) { return (inum)_mm512_max_epi32((__m512i)a, (__m512i)b); }
#elif LANES == 8 && defined(__AVX2__)
LANE_FN inum imin_of(inum a, inum b) { return (inum)_mm256_min_epi32((__m256i)a, (__m256i)b); }
LANE_FN inum imax_of(inum a, inum b) { return (inum)_mm256_max_epi32((__m256i)a, (__m256i)b); }
#elif LANES == 4 && defined(__SSE4_1__)
LANE_FN inum imin_of(inum a, inum b) { return (inum)_mm_min_epi32((__m128i)a, (__m128i)b); }
LANE_FN inum imax_of(inum a, inum b) { return (inum)_mm_max_epi32((__m128i)a, (__m128i)b); }
#else
LANE_FN inum imin_of(inum a, inum b) { return ipick(a < b, a, b); }
LANE_FN inum imax_of(inum a, inum b) { return ipick(a > b, a, b); }
#endif
// Returns |x| by clearing the sign bit; NaN stays NaN.
LANE_FN num absolute(num x) { return num_of_bits(bits_of(x) & 0x7fffffff); }
// Returns max(x, 0), and 0 for NaN.
LANE_FN num positive(num x) { return max_of(x, num_of(0.0f)); }
// Clamps x to 0…1; NaN becomes 0.
LANE_FN num saturate(num x) { return min_of(positive(x), num_of(1.0f)); }

// Stores the lanes of x that are set in m; the memory of the other lanes is unchanged.
LANE_FN void num_store_where(float *at, mask m, num x, num old)
{
#if LANES == 16 && defined(__AVX512DQ__)
    (void)old;
    _mm512_mask_storeu_ps(at, _mm512_movepi32_mask((__m512i)m), (__m512)x);
#else
    num_store(at, pick(m, x, old));
#endif
}

// Converts bits to a mask: the inverse of mask_bits.
LANE_FN mask mask_of_bits(unsigned bits)
{
#if LANES == 1
    return (int32_t)(bits & 1);
#elif LANES == 16 && defined(__AVX512DQ__)
    return (mask)_mm512_movm_epi32((__mmask16)bits);
#else
    return (inum_of((int32_t)bits) >> lane_numbers() & 1) == 1;
#endif
}

// Loads LANES consecutive numbers of 16 or 8 bits.
LANE_FN inum inum_load_16(const uint16_t *at)
{
#if LANES == 1
    return *at;
#elif LANES == 16 && defined(__AVX512F__)
    return (inum)_mm512_cvtepu16_epi32(_mm256_loadu_si256((const __m256i *)(const void *)at));
#elif LANES == 8 && defined(__AVX2__)
    return (inum)_mm256_cvtepu16_epi32(_mm_loadu_si128((const __m128i *)(const void *)at));
#else
    typedef uint16_t narrow __attribute__((vector_size(LANES * 2)));
    narrow n;
    memcpy(&n, at, sizeof n);
    return __builtin_convertvector(n, inum);
#endif
}
LANE_FN inum inum_load_8(const uint8_t *at)
{
#if LANES == 1
    return *at;
#elif LANES == 16 && defined(__AVX512F__)
    return (inum)_mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)(const void *)at));
#elif LANES == 8 && defined(__AVX2__)
    return (inum)_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)at));
#else
    typedef uint8_t narrow __attribute__((vector_size(LANES)));
    narrow n;
    memcpy(&n, at, sizeof n);
    return __builtin_convertvector(n, inum);
#endif
}

// Stores the lowest 16 or 8 bits of each lane consecutively.
LANE_FN void inum_store_16(uint16_t *at, inum x)
{
#if LANES == 1
    *at = (uint16_t)x;
#else
    typedef uint16_t narrow __attribute__((vector_size(LANES * 2)));
    narrow n = __builtin_convertvector((unsigned_lanes)x, narrow);
    memcpy(at, &n, sizeof n);
#endif
}
LANE_FN void inum_store_8(uint8_t *at, inum x)
{
#if LANES == 1
    *at = (uint8_t)x;
#elif LANES == 16 && defined(__AVX512F__)
    _mm_storeu_si128((__m128i *)(void *)at, _mm512_cvtepi32_epi8((__m512i)x));
#else
    typedef uint16_t half __attribute__((vector_size(LANES * 2)));
    typedef uint8_t narrow __attribute__((vector_size(LANES)));
    narrow n = __builtin_convertvector(__builtin_convertvector((unsigned_lanes)x, half), narrow);
    memcpy(at, &n, sizeof n);
#endif
}

// Rounds down. |x| must be below 2³¹ and not NaN, so clamp x first.
LANE_FN inum floor_of(num x)
{
#if LANES == 16 && defined(__AVX512F__)
    return (inum)_mm512_cvt_roundps_epi32((__m512)x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
#elif LANES == 8 && defined(__AVX__)
    return (inum)_mm256_cvttps_epi32(_mm256_floor_ps((__m256)x));
#elif LANES == 4 && defined(__SSE4_1__)
    return (inum)_mm_cvttps_epi32(_mm_floor_ps((__m128)x));
#elif LANES == 4 && defined(__wasm_simd128__)
    return (inum)wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_floor((v128_t)x));
#else
    inum i = int_of(x);
    return i - ipick(num_of_int(i) > x, inum_of(1), inum_of(0));
#endif
}

// Returns a bit mask of the lanes that are below 0: bit i represents lane i.
LANE_FN unsigned negative_bits(inum x)
{
#if LANES == 16 && defined(__AVX512DQ__)
    return (unsigned)_mm512_movepi32_mask((__m512i)x);
#else
    return mask_bits(x < 0);
#endif
}

// Returns, for each lane, the number of bits that are set in `bits` up to and including this lane.
LANE_FN inum bits_up_to_lane(unsigned bits)
{
    inum x = inum_of((int32_t)bits) & ((inum_of(2) << lane_numbers()) - 1);
    x = x - (x >> 1 & 0x5555); // sums bits in pairs, then in groups of four, eight and sixteen
    x = (x & 0x3333) + (x >> 2 & 0x3333);
    x = (x + (x >> 4)) & 0x0f0f;
    return (x + (x >> 8)) & 0x1f;
}

// Permutes lanes: lane i of the result is lane at[i] of x. Each at[i] is 0 to LANES − 1.
LANE_FN num lanes_at(num x, inum at)
{
#if LANES == 16 && defined(__AVX512F__)
    return (num)_mm512_permutexvar_ps((__m512i)at, (__m512)x);
#elif LANES == 8 && defined(__AVX2__)
    return (num)_mm256_permutevar8x32_ps((__m256)x, (__m256i)at);
#elif LANES == 4 && defined(__wasm_simd128__)
    // The indices of the four bytes of each lane.
    inum bytes = at * 0x04040404 + 0x03020100;
    return (num)wasm_i8x16_swizzle((v128_t)x, (v128_t)bytes);
#else
    float from[LANES], to[LANES];
    num_store(from, x);
    for (int i = 0; i < LANES; i++)
        to[i] = from[ilane(at, i)];
    return num_load(to);
#endif
}

// Returns table[at] for a table of 16 floats. Each at[i] is below `count`.
LANE_FN num look_up(const float table[16], int count, inum at)
{
    if (count <= LANES)
        return lanes_at(num_load(table), at & (LANES - 1));
    float to[LANES];
    for (int i = 0; i < LANES; i++)
        to[i] = table[ilane(at, i) & 15];
    return num_load(to);
}

// Returns the minimum of all lanes, none of which may be NaN.
LANE_FN float min_lane(num x)
{
#if (LANES == 16 && defined(__AVX512DQ__)) || (LANES == 8 && defined(__AVX__))
#if LANES == 16
    __m256 half = _mm256_min_ps(_mm512_castps512_ps256((__m512)x), _mm512_extractf32x8_ps((__m512)x, 1));
#else
    __m256 half = (__m256)x;
#endif
    __m128 four = _mm_min_ps(_mm256_castps256_ps128(half), _mm256_extractf128_ps(half, 1));
    four = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(four, _mm_movehdup_ps(four)));
#else
    for (int distance = 1; distance < LANES; distance *= 2)
        x = min_of(x, lanes_at(x, lane_numbers() ^ distance));
    return lane(x, 0);
#endif
}

// Loads the lower half of the lanes from one address, and the upper half from another.
LANE_FN num num_load_halves(const float *low, const float *high)
{
#if LANES == 1
    return (void)high, *low;
#elif LANES == 16 && defined(__AVX512DQ__)
    return (num)_mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(low)), _mm256_loadu_ps(high), 1);
#else
    num x;
    memcpy(&x, low, LANES * 2);
    memcpy((char *)&x + LANES * 2, high, LANES * 2);
    return x;
#endif
}

#if LANES == 8 && defined(__AVX2__)
// For each value of a byte: the indices of the set bits in ascending order, one byte per index.
#define BIT_NUMBER(b, i) ((b) >> (i) & 1 ? (uint64_t)(i) << 8 * __builtin_popcount((b) & ((1u << (i)) - 1)) : 0)
#define BIT_NUMBERS(b)                                                                                                 \
    (BIT_NUMBER(b, 0) | BIT_NUMBER(b, 1) | BIT_NUMBER(b, 2) | BIT_NUMBER(b, 3) | BIT_NUMBER(b, 4) | BIT_NUMBER(b, 5) | \
     BIT_NUMBER(b, 6) | BIT_NUMBER(b, 7))
#define BIT_NUMBERS_4(b)  BIT_NUMBERS(b), BIT_NUMBERS(b + 1), BIT_NUMBERS(b + 2), BIT_NUMBERS(b + 3)
#define BIT_NUMBERS_16(b) BIT_NUMBERS_4(b), BIT_NUMBERS_4(b + 4), BIT_NUMBERS_4(b + 8), BIT_NUMBERS_4(b + 12)
#define BIT_NUMBERS_64(b) BIT_NUMBERS_16(b), BIT_NUMBERS_16(b + 16), BIT_NUMBERS_16(b + 32), BIT_NUMBERS_16(b + 48)
static const uint64_t bit_numbers[256]
    __attribute__((unused)) = {BIT_NUMBERS_64(0u), BIT_NUMBERS_64(64u), BIT_NUMBERS_64(128u), BIT_NUMBERS_64(192u)};
#undef BIT_NUMBER
#undef BIT_NUMBERS
#undef BIT_NUMBERS_4
#undef BIT_NUMBERS_16
#undef BIT_NUMBERS_64
#endif

#if LANES == 4 && defined(__wasm_simd128__)
// For each subset of four lanes, the indices of the bytes in these lanes, in ascending order. An index of 16 gives 0.
#define LANE_BYTES(i) 4 * (i), 4 * (i) + 1, 4 * (i) + 2, 4 * (i) + 3
#define NO_LANE       16, 16, 16, 16
static const uint8_t packed_bytes[16][16] __attribute__((unused)) = {
    {NO_LANE, NO_LANE, NO_LANE, NO_LANE},
    {LANE_BYTES(0), NO_LANE, NO_LANE, NO_LANE},
    {LANE_BYTES(1), NO_LANE, NO_LANE, NO_LANE},
    {LANE_BYTES(0), LANE_BYTES(1), NO_LANE, NO_LANE},
    {LANE_BYTES(2), NO_LANE, NO_LANE, NO_LANE},
    {LANE_BYTES(0), LANE_BYTES(2), NO_LANE, NO_LANE},
    {LANE_BYTES(1), LANE_BYTES(2), NO_LANE, NO_LANE},
    {LANE_BYTES(0), LANE_BYTES(1), LANE_BYTES(2), NO_LANE},
    {LANE_BYTES(3), NO_LANE, NO_LANE, NO_LANE},
    {LANE_BYTES(0), LANE_BYTES(3), NO_LANE, NO_LANE},
    {LANE_BYTES(1), LANE_BYTES(3), NO_LANE, NO_LANE},
    {LANE_BYTES(0), LANE_BYTES(1), LANE_BYTES(3), NO_LANE},
    {LANE_BYTES(2), LANE_BYTES(3), NO_LANE, NO_LANE},
    {LANE_BYTES(0), LANE_BYTES(2), LANE_BYTES(3), NO_LANE},
    {LANE_BYTES(1), LANE_BYTES(2), LANE_BYTES(3), NO_LANE},
    {LANE_BYTES(0), LANE_BYTES(1), LANE_BYTES(2), LANE_BYTES(3)},
};
#undef LANE_BYTES
#undef NO_LANE
#endif

// Stores the lanes selected by `bits` (bit i selects lane i) consecutively, in order, and returns the number of stored
// lanes. LANES elements must be writable.
LANE_FN uint32_t pack_lanes(int32_t *to, unsigned bits, inum x)
{
#if LANES == 16 && defined(__AVX512F__)
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32((__mmask16)bits, (__m512i)x));
    return (uint32_t)__builtin_popcount(bits);
#elif LANES == 8 && defined(__AVX2__)
    __m256i from = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)bit_numbers[bits]));
    _mm256_storeu_si256((__m256i *)(void *)to, _mm256_permutevar8x32_epi32((__m256i)x, from));
    return (uint32_t)__builtin_popcount(bits);
#elif LANES == 4 && defined(__wasm_simd128__)
    wasm_v128_store(to, wasm_i8x16_swizzle((v128_t)x, wasm_v128_load(packed_bytes[bits])));
    return (uint32_t)__builtin_popcount(bits);
#else
    int32_t lanes[LANES];
    inum_store(lanes, x);
    uint32_t count = 0;
    for (; bits; bits &= bits - 1)
        to[count++] = lanes[__builtin_ctz(bits)];
    return count;
#endif
}

// Gathers elements: lane i of the result is from[at[i]]. Each at[i] is below 2³¹.
LANE_FN inum igather(const int32_t *from, inum at)
{
#if LANES == 1
    return from[at];
#elif LANES == 16 && defined(__AVX512F__)
    return (inum)_mm512_i32gather_epi32((__m512i)at, from, 4);
#elif LANES == 8 && defined(__AVX2__)
    return (inum)_mm256_i32gather_epi32(from, (__m256i)at, 4);
#else
    inum x = at;
    for (int i = 0; i < LANES; i++)
        x[i] = from[at[i]];
    return x;
#endif
}

LANE_FN num gather_float(const float *from, inum at) { return num_of_bits(igather((const int32_t *)from, at)); }

// Gathers three consecutive numbers at each of LANES addresses: lane i of out[k] is the 32 bits at from[stride · at[i]
// + k]. Nothing else is read, so the array may end with the last of these numbers. On x86 three numbers are loaded at
// once and transposed, which is four times as fast as the gather instruction.
LANE_FN void igather3(const void *from, const uint32_t *at, int stride, inum out[3])
{
    const char *base = from;
    size_t step = (size_t)stride * 4;
#if (LANES == 16 && defined(__AVX512VL__) && defined(__AVX512DQ__)) || (LANES == 8 && defined(__AVX2__))
    enum { QUADS = LANES / 4 };
    __m128i three = _mm_set_epi32(0, -1, -1, -1);
    inum row[4]; // row[j] contains four numbers for each of the lanes j, 4 + j …; the fourth number is 0
    for (int j = 0; j < 4; j++) {
        __m128i v[QUADS];
        for (int q = 0; q < QUADS; q++)
            v[q] = _mm_maskload_epi32((const int *)(const void *)(base + at[4 * q + j] * step), three);
        __m256i low = _mm256_inserti128_si256(_mm256_castsi128_si256(v[0]), v[1], 1);
#if LANES == 16
        __m256i high = _mm256_inserti128_si256(_mm256_castsi128_si256(v[2]), v[3], 1);
        row[j] = (inum)_mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
#else
        row[j] = (inum)low;
#endif
    }
#if LANES == 16
    __m512i xy0 = _mm512_unpacklo_epi32((__m512i)row[0], (__m512i)row[1]);
    __m512i xy1 = _mm512_unpacklo_epi32((__m512i)row[2], (__m512i)row[3]);
    __m512i z0 = _mm512_unpackhi_epi32((__m512i)row[0], (__m512i)row[1]);
    __m512i z1 = _mm512_unpackhi_epi32((__m512i)row[2], (__m512i)row[3]);
    out[0] = (inum)_mm512_unpacklo_epi64(xy0, xy1);
    out[1] = (inum)_mm512_unpackhi_epi64(xy0, xy1);
    out[2] = (inum)_mm512_unpacklo_epi64(z0, z1);
#else
    __m256i xy0 = _mm256_unpacklo_epi32((__m256i)row[0], (__m256i)row[1]);
    __m256i xy1 = _mm256_unpacklo_epi32((__m256i)row[2], (__m256i)row[3]);
    __m256i z0 = _mm256_unpackhi_epi32((__m256i)row[0], (__m256i)row[1]);
    __m256i z1 = _mm256_unpackhi_epi32((__m256i)row[2], (__m256i)row[3]);
    out[0] = (inum)_mm256_unpacklo_epi64(xy0, xy1);
    out[1] = (inum)_mm256_unpackhi_epi64(xy0, xy1);
    out[2] = (inum)_mm256_unpacklo_epi64(z0, z1);
#endif
#elif LANES == 4 && defined(__SSE2__)
    __m128i row[4];
    for (int j = 0; j < 4; j++) {
        const char *at_row = base + at[j] * step;
        int32_t third;
        memcpy(&third, at_row + 8, 4);
        row[j] = _mm_unpacklo_epi64(_mm_loadl_epi64((const __m128i *)(const void *)at_row), _mm_cvtsi32_si128(third));
    }
    __m128i xy0 = _mm_unpacklo_epi32(row[0], row[1]), xy1 = _mm_unpacklo_epi32(row[2], row[3]);
    __m128i z0 = _mm_unpackhi_epi32(row[0], row[1]), z1 = _mm_unpackhi_epi32(row[2], row[3]);
    out[0] = (inum)_mm_unpacklo_epi64(xy0, xy1);
    out[1] = (inum)_mm_unpackhi_epi64(xy0, xy1);
    out[2] = (inum)_mm_unpacklo_epi64(z0, z1);
#elif LANES == 4 && defined(__wasm_simd128__)
    v128_t row[4];
    for (int j = 0; j < 4; j++) {
        const char *at_row = base + at[j] * step;
        row[j] = wasm_v128_load32_lane(at_row + 8, wasm_v128_load64_zero(at_row), 2);
    }
    v128_t xy0 = wasm_i32x4_shuffle(row[0], row[1], 0, 4, 1, 5), xy1 = wasm_i32x4_shuffle(row[2], row[3], 0, 4, 1, 5);
    v128_t z0 = wasm_i32x4_shuffle(row[0], row[1], 2, 6, 3, 7), z1 = wasm_i32x4_shuffle(row[2], row[3], 2, 6, 3, 7);
    out[0] = (inum)wasm_i64x2_shuffle(xy0, xy1, 0, 2);
    out[1] = (inum)wasm_i64x2_shuffle(xy0, xy1, 1, 3);
    out[2] = (inum)wasm_i64x2_shuffle(z0, z1, 0, 2);
#else
    int32_t columns[3][LANES];
    for (int i = 0; i < LANES; i++) {
        int32_t row[3];
        memcpy(row, base + at[i] * step, sizeof row);
        for (int k = 0; k < 3; k++)
            columns[k][i] = row[k];
    }
    for (int k = 0; k < 3; k++)
        out[k] = inum_load(columns[k]);
#endif
}

LANE_FN void gather3(const float *from, const uint32_t *at, int stride, num out[3])
{
    inum bits[3];
    igather3(from, at, stride, bits);
    for (int k = 0; k < 3; k++)
        out[k] = num_of_bits(bits[k]);
}

#endif
