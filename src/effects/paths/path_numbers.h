// path_numbers.h: the random numbers of paths: Owen-scrambled Sobol points, computed from a hash, the same on every
// machine.
//
// Each decision of a path uses one pair of numbers. Over the paths of a pixel, the pairs of one decision are the first two
// dimensions of Sobol's sequence in a random order, scrambled by a seed of pixel and decision (Burley, "Practical
// hash-based Owen scrambling", 2020; the hash is by Laine and Karras, 2011, in a version of Vegdahl, 2021). Scrambling makes
// them independent of all other decisions, so the mean is unbiased, and with a power of two of paths each elementary
// interval receives one number.
#ifndef PATH_NUMBERS_H
#define PATH_NUMBERS_H

#include <stdint.h>

static inline uint32_t path_hash(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

static inline uint32_t reversed_bits(uint32_t x)
{
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    return __builtin_bswap32(x);
}

// Scrambles a number whose bits are reversed.
static inline uint32_t scrambled_reverse(uint32_t x, uint32_t seed)
{
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    return x ^ x * 0x8d22f6e6u;
}

// Returns a number between 0 and 1, but neither of them.
static inline float unit_number(uint32_t x) { return ((float)(x >> 9) + 0.5f) * 0x1p-23f; }

// Stores pair `decision` of a path.
static inline void path_numbers(uint32_t seed, uint32_t number, uint32_t decision, float *u, float *v)
{
    seed = path_hash(seed + decision * 0x9e3779b9u);
    uint32_t at = reversed_bits(scrambled_reverse(reversed_bits(number), seed));
    uint32_t second = at; // times Pascal's triangle modulo 2, which generates Sobol's second dimension
    second ^= (second & 0xaaaaaaaau) >> 1;
    second ^= (second & 0xccccccccu) >> 2;
    second ^= (second & 0xf0f0f0f0u) >> 4;
    second ^= (second & 0xff00ff00u) >> 8;
    second ^= (second & 0xffff0000u) >> 16;
    *u = unit_number(reversed_bits(scrambled_reverse(at, path_hash(seed ^ 0x5bd1e995u))));
    *v = unit_number(reversed_bits(scrambled_reverse(second, path_hash(seed ^ 0x27d4eb2fu))));
}

#endif
