// random.h: numbers that are the same in every run (xorshift*, Marsaglia 2003 and Vigna 2016).
#ifndef TEST_RANDOM_H
#define TEST_RANDOM_H

#include <stdint.h>
#include <string.h>

struct random {
    uint64_t state; // not 0
};

static inline uint32_t random_bits(struct random *r)
{
    r->state ^= r->state >> 12;
    r->state ^= r->state << 25;
    r->state ^= r->state >> 27;
    return (uint32_t)((r->state * 0x2545f4914f6cdd1dull) >> 32);
}

// A number evenly distributed from low to high.
static inline float random_between(struct random *r, float low, float high)
{
    return low + (high - low) * ((float)(random_bits(r) >> 8) * 0x1p-24f);
}

static inline float float_of_bits(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, 4);
    return x;
}

static inline uint32_t bits_of_float(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, 4);
    return bits;
}

#endif
