// byte_masks.h: bit masks of the line endings, white space and special characters in 64 bytes of text. The masks are
// computed with SSE2 if the compiler supports SSE2 on the target. The scalar version returns the same masks.
#ifndef BYTE_MASKS_H
#define BYTE_MASKS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// Bit i represents byte i.
struct byte_masks {
    uint64_t newline; // '\n'
    uint64_t white;   // all bytes up to and including the space, such as '\n'
    uint64_t slash;   // '/'
    uint64_t special; // '#' or '\\'
};

// Counts the set bits. Uses the compiler's builtin only if the target has an instruction that counts bits. Otherwise,
// the builtin would call a function with a lookup table.
static inline unsigned byte_masks_count(uint64_t bits)
{
#if defined(__POPCNT__) || defined(__aarch64__)
    return (unsigned)__builtin_popcountll(bits);
#else
    bits -= bits >> 1 & 0x5555555555555555u;
    bits = (bits & 0x3333333333333333u) + (bits >> 2 & 0x3333333333333333u);
    bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (unsigned)(bits * 0x0101010101010101u >> 56);
#endif
}

#if defined(__SSE2__)
static inline struct byte_masks byte_masks_of(const uint8_t *at)
{
    const __m128i newline = _mm_set1_epi8('\n'), space = _mm_set1_epi8(' '), slash = _mm_set1_epi8('/');
    const __m128i hash = _mm_set1_epi8('#'), backslash = _mm_set1_epi8('\\');
    struct byte_masks masks = {0};
    for (int i = 0; i < 4; i++) {
        __m128i bytes = _mm_loadu_si128((const __m128i *)(const void *)(at + 16 * i));
        __m128i special = _mm_or_si128(_mm_cmpeq_epi8(bytes, hash), _mm_cmpeq_epi8(bytes, backslash));
        masks.newline |= (uint64_t)(unsigned)_mm_movemask_epi8(_mm_cmpeq_epi8(bytes, newline)) << 16 * i;
        masks.white |= (uint64_t)(unsigned)_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_min_epu8(bytes, space), bytes))
                       << 16 * i;
        masks.slash |= (uint64_t)(unsigned)_mm_movemask_epi8(_mm_cmpeq_epi8(bytes, slash)) << 16 * i;
        masks.special |= (uint64_t)(unsigned)_mm_movemask_epi8(special) << 16 * i;
    }
    return masks;
}

// Returns only the newline mask.
static inline uint64_t byte_masks_newlines(const uint8_t *at)
{
    const __m128i newline = _mm_set1_epi8('\n');
    uint64_t mask = 0;
    for (int i = 0; i < 4; i++) {
        __m128i bytes = _mm_loadu_si128((const __m128i *)(const void *)(at + 16 * i));
        mask |= (uint64_t)(unsigned)_mm_movemask_epi8(_mm_cmpeq_epi8(bytes, newline)) << 16 * i;
    }
    return mask;
}
#else
static inline struct byte_masks byte_masks_of(const uint8_t *at)
{
    struct byte_masks masks = {0};
    for (int i = 0; i < 64; i++) {
        uint8_t c = at[i];
        masks.newline |= (uint64_t)(c == '\n') << i;
        masks.white |= (uint64_t)(c <= ' ') << i;
        masks.slash |= (uint64_t)(c == '/') << i;
        masks.special |= (uint64_t)(c == '#' || c == '\\') << i;
    }
    return masks;
}

static inline uint64_t byte_masks_newlines(const uint8_t *at)
{
    uint64_t mask = 0;
    for (int i = 0; i < 64; i++)
        mask |= (uint64_t)(at[i] == '\n') << i;
    return mask;
}
#endif

#endif
