// png_filter.c: applies the row filters of PNG, sixteen bytes at a time.
#include "png_encoding.h"

#include <stdbool.h>
#include <string.h>

typedef uint8_t u8x16 __attribute__((vector_size(16)));
typedef int8_t s8x16 __attribute__((vector_size(16)));
typedef uint16_t u16x8 __attribute__((vector_size(16)));
typedef uint32_t u32x4 __attribute__((vector_size(16)));
typedef u8x16 u8x16_memory __attribute__((aligned(1), may_alias));

#define INLINE static inline __attribute__((always_inline))

INLINE u8x16 load(const uint8_t *at) { return (u8x16) * (const u8x16_memory *)at; }
INLINE u8x16 choose(u8x16 mask, u8x16 a, u8x16 b) { return (a & mask) | (b & ~mask); }
INLINE u8x16 below(u8x16 a, u8x16 b) { return (u8x16)(a < b); }
// Returns |a − b|; `a_below` is the mask of a < b.
INLINE u8x16 distance(u8x16 a, u8x16 b, u8x16 a_below) { return ((a - b) ^ a_below) - a_below; }

// Returns the mean, rounded down, with 8-bit arithmetic only.
INLINE u8x16 average(u8x16 a, u8x16 b)
{
    u16x8 half = (u16x8)((a ^ b) & 0xFE) >> 1; // clearing the lowest bit keeps bits from moving to the next byte
    return (a & b) + (u8x16)half;
}

// The Paeth predictor in 8-bit arithmetic. With p = a + b − c, |p − a| = |b − c| and |p − b| = |a − c|. If a and b are
// on different sides of c, |p − c| is the difference between the other two distances. If a and b are on the same side
// of c, |p − c| is the sum of the other two distances. This sum is never the smallest distance, so 255 replaces it. If
// distances are equal, a is preferred to b, and b to c.
INLINE u8x16 paeth(u8x16 a, u8x16 b, u8x16 c)
{
    u8x16 b_below = below(b, c), a_below = below(a, c);
    u8x16 to_a = distance(b, c, b_below), to_b = distance(a, c, a_below);
    u8x16 to_c = distance(to_a, to_b, below(to_a, to_b)) | ~(a_below ^ b_below);
    u8x16 take_a = ~(below(to_b, to_a) | below(to_c, to_a));
    return choose(take_a, a, choose(below(to_c, to_b), c, b));
}

INLINE u8x16 filtered(enum png_filter filter, u8x16 here, u8x16 left, u8x16 above, u8x16 above_left)
{
    switch (filter) {
    case PNG_FILTER_SUB:
        return here - left;
    case PNG_FILTER_UP:
        return here - above;
    case PNG_FILTER_AVERAGE:
        return here - average(left, above);
    case PNG_FILTER_PAETH:
        return here - paeth(left, above, above_left);
    default:
        return here;
    }
}

enum { VECTOR = 16, BLOCK = 4 * VECTOR, BLOCK_PIXELS = BLOCK / 4 };

// Filters one vector at a time. The first vector, which has no left neighbour, and the last, which may be incomplete,
// are read from copies. `low` is the mask of the bytes to keep in each pixel. With `gather`, alpha is stored directly
// after red.
INLINE void filter_row(enum png_filter filter, const uint8_t *row, const uint8_t *above, int width, uint32_t low,
                       bool gather, uint32_t *out)
{
    const int bytes = 4 * width;
    for (int at = 0; at < bytes; at += VECTOR) {
        u8x16 result;
        if (at > 0 && at + VECTOR <= bytes) {
            result = filtered(filter, load(row + at), load(row + at - 4), load(above + at), load(above + at - 4));
        } else {
            // this row and the row above, starting at the left pixel
            uint8_t near[VECTOR + 4] = {0}, far[VECTOR + 4] = {0};
            const int before = at > 0 ? 4 : 0, after = bytes - at < VECTOR ? bytes - at : VECTOR;
            memcpy(near + 4 - before, row + at - before, (size_t)(before + after));
            memcpy(far + 4 - before, above + at - before, (size_t)(before + after));
            result = filtered(filter, load(near + 4), load(near), load(far + 4), load(far));
            for (int i = after; i < VECTOR; i++)
                result[i] = 0;
        }
        u32x4 kept = (u32x4)result & ((u32x4){0} + low);
        if (gather)
            kept |= (u32x4)result >> 24 << 8;
        *(u8x16_memory *)(out + at / 4) = (u8x16)kept;
    }
}

// Calls filter_row with a constant filter, so that the compiler makes one loop for each filter.
INLINE void filter_row_by(enum png_filter filter, const uint8_t *row, const uint8_t *above, int width, uint32_t low,
                          bool gather, uint32_t *out)
{
    switch (filter) {
    case PNG_FILTER_SUB:
        filter_row(PNG_FILTER_SUB, row, above, width, low, gather, out);
        break;
    case PNG_FILTER_UP:
        filter_row(PNG_FILTER_UP, row, above, width, low, gather, out);
        break;
    case PNG_FILTER_AVERAGE:
        filter_row(PNG_FILTER_AVERAGE, row, above, width, low, gather, out);
        break;
    case PNG_FILTER_PAETH:
        filter_row(PNG_FILTER_PAETH, row, above, width, low, gather, out);
        break;
    default:
        filter_row(PNG_FILTER_NONE, row, above, width, low, gather, out);
        break;
    }
}

void png_filter_row(enum png_filter filter, const uint8_t *row, const uint8_t *above, int width, int bytes_per_pixel,
                    uint32_t *out)
{
    static const uint32_t low[5] = {[1] = 0xFF, [3] = 0xFFFFFF, [4] = 0xFFFFFFFF};
    if (bytes_per_pixel == 2)
        filter_row_by(filter, row, above, width, 0xFF, true, out);
    else
        filter_row_by(filter, row, above, width, low[bytes_per_pixel], false, out);
}

static bool is_blank(const uint8_t *block)
{
    typedef uint64_t u64x2 __attribute__((vector_size(16)));
    u64x2 any = (u64x2)(load(block) | load(block + VECTOR) | load(block + 2 * VECTOR) | load(block + 3 * VECTOR));
    return (any[0] | any[1]) == 0;
}

struct png_span png_span_of(const uint8_t *row, int width)
{
    struct png_span span = {0, width};
    while (span.first + BLOCK_PIXELS <= width && is_blank(row + 4 * (size_t)span.first))
        span.first += BLOCK_PIXELS;
    while (span.end - BLOCK_PIXELS >= span.first && is_blank(row + 4 * (size_t)(span.end - BLOCK_PIXELS)))
        span.end -= BLOCK_PIXELS;
    return span;
}

struct png_span png_span_filtered(struct png_span row, struct png_span above, int width)
{
    // Each pixel also affects the next filtered pixel, and the filter processes whole vectors.
    enum { FURTHER = VECTOR / 4 };
    struct png_span both = row.first == row.end ? above : row;
    if (above.first < above.end) {
        both.first = above.first < both.first ? above.first : both.first;
        both.end = above.end > both.end ? above.end : both.end;
    }
    if (both.first < both.end)
        both.end = width - both.end < FURTHER ? width : both.end + FURTHER;
    return both;
}

uint64_t png_filter_cost(const uint32_t *filtered_row, int width)
{
    // 16-bit lanes add two bytes of at most 128 per step, so 255 steps stay below 65536.
    enum { STEPS = 255 };
    const int vectors = (width + 3) / 4;
    const uint8_t *bytes = (const uint8_t *)filtered_row;
    uint64_t cost = 0;
    for (int first = 0; first < vectors; first += STEPS) {
        int end = first + STEPS < vectors ? first + STEPS : vectors;
        u16x8 sums = {0};
        for (int i = first; i < end; i++) {
            u8x16 byte = load(bytes + 16 * (size_t)i), negative = (u8x16)((s8x16)byte < 0);
            u16x8 pair = (u16x8)((byte ^ negative) - negative);
            sums += (pair & 255) + (pair >> 8);
        }
        for (int lane = 0; lane < 8; lane++)
            cost += sums[lane];
    }
    return cost;
}
