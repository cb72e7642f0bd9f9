// deflate.c: rows of filtered pixels become tokens, and tokens are counted.
#include "deflate.h"

#include <string.h>

enum {
    CHUNK = 16, // pixels that are looked at together
    ROOM_BEFORE = 4,
};

// Tokens are made as 64-bit numbers, the first kind lowest. This one holds one thing only.
#define ONE(kind) ((uint64_t)(kind) | (uint64_t)DEFLATE_NOTHING * 0x0001000100010000u)

typedef uint8_t u8x16 __attribute__((vector_size(16)));
typedef uint32_t u32x4 __attribute__((vector_size(16)));
typedef uint64_t u64x2 __attribute__((vector_size(16)));
typedef u32x4 u32x4_memory __attribute__((aligned(4), may_alias));

static inline u32x4 load(const uint32_t *at) { return (u32x4) * (const u32x4_memory *)at; }

static inline void put_token(struct token *at, uint64_t token) { memcpy(at, &token, sizeof token); }

static size_t stride_of(int width) { return ROOM_BEFORE + (size_t)width + CHUNK; }

size_t deflate_scratch(int width, int rows)
{
    return (size_t)rows * (((size_t)width + 1) * sizeof(struct token) + stride_of(width) * sizeof(uint32_t));
}

bool deflate_make(struct deflate *deflate, struct arena *arena, int width, int rows, int bytes_per_pixel)
{
    deflate->width = width;
    deflate->bytes_per_pixel = bytes_per_pixel;
    deflate->stride = stride_of(width);
    uint32_t *words = arena_array(arena, (size_t)rows * deflate->stride, sizeof *words);
    deflate->last_places = arena_array(arena, 1 << DEFLATE_HASH_BITS, sizeof *deflate->last_places);
    // One more than there can be: a run's pixels write a token each before they know which is the last.
    deflate->tokens = arena_array(arena, (size_t)rows * ((size_t)width + 1) + 1, sizeof *deflate->tokens);
    if (!words || !deflate->last_places || !deflate->tokens)
        return false;
    deflate->words = words + ROOM_BEFORE;
    return true;
}

void deflate_start(struct deflate *deflate, uint8_t filter, bool pairs)
{
    deflate->filter = filter;
    deflate->row = deflate->words;
    deflate->pairs = pairs;
    deflate->y = 0;
    deflate->end = deflate->tokens;
    memset(deflate->counts, 0, sizeof deflate->counts);
    if (pairs)
        memset(deflate->last_places, 0xFF, sizeof *deflate->last_places << DEFLATE_HASH_BITS); // nowhere
}

// A distance's symbol and further bits (RFC 1951, 3.2.5): from 5 on, two symbols for each power of two.
static inline uint64_t distance_of(uint32_t distance)
{
    uint32_t before = distance - 1;
    if (before < 4)
        return (uint64_t)(DEFLATE_DISTANCE + before) | (uint64_t)DEFLATE_NOTHING * 0x000100010000u;
    uint32_t top = 31 - (uint32_t)__builtin_clz(before), bits = top - 1, more = before & ((1u << bits) - 1);
    uint32_t low_bits = bits < 8 ? bits : 8, high_bits = bits - low_bits;
    uint64_t symbol = DEFLATE_DISTANCE + 2 * top + (before >> bits & 1);
    uint64_t low = DEFLATE_BITS + (1u << low_bits) + (more & ((1u << low_bits) - 1));
    uint64_t high = DEFLATE_BITS + (1u << high_bits) + (more >> low_bits);
    return symbol | low << 16 | high << 32;
}

// A match of 3 … 258 bytes.
static inline uint64_t match_of(size_t length, uint64_t distance)
{
    return (DEFLATE_MATCH + length - DEFLATE_SHORTEST) | distance << 16;
}

// A match of any length as matches that can be told: the longest first, but never leaving 1 or 2 bytes.
static struct token *tell_match(struct token *token, size_t left, uint64_t distance)
{
    while (left) {
        size_t match = left <= DEFLATE_LONGEST                      ? left
                       : left - DEFLATE_LONGEST >= DEFLATE_SHORTEST ? DEFLATE_LONGEST
                                                                    : DEFLATE_LONGEST - DEFLATE_SHORTEST;
        put_token(token++, match_of(match, distance));
        left -= match;
    }
    return token;
}

// Whether the pixels from row[x] on all equal the one before.
static inline bool chunk_repeats(const uint32_t *row, int x)
{
    const u32x4 pixel = (u32x4){0} + row[x - 1];
    u32x4 differ = {0};
    for (int i = 0; i < CHUNK; i += 4)
        differ |= load(row + x + i) ^ pixel;
    u64x2 halves = (u64x2)differ;
    return (halves[0] | halves[1]) == 0;
}

// What the pixels of a chunk are, each by itself and its neighbours: its bytes as a token; all bits set where
// it equals the pixel before and so does the next one or did that one, else 0; 0 in a run that goes on,
// else 1.
struct chunk {
    uint64_t told[CHUNK];
    uint32_t in_run[CHUNK];
    int32_t step[CHUNK];
};

static inline void look_at(struct chunk *chunk, const uint32_t *at, uint64_t fourth)
{
    for (int i = 0; i < CHUNK; i += 4) {
        const u32x4 here = load(at + i), before = load(at + i - 1);
        const u32x4 same = (u32x4)(here == before), next = (u32x4)(load(at + i + 1) == here);
        const u32x4 was = (u32x4)(before == load(at + i - 2));
        const u32x4 in_run = same & (was | next), step = (in_run & next) + 1;
        const u8x16 bytes = (u8x16)here, zero = {0};
        const u64x2 extra = (u64x2){0} + fourth;
        // Each byte gets a zero byte above it.
        const u64x2 low =
            extra | (u64x2)__builtin_shufflevector(bytes, zero, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
        const u64x2 high = extra | (u64x2)__builtin_shufflevector(bytes, zero, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13,
                                                                  29, 14, 30, 15, 31);
        memcpy(chunk->told + i, &low, sizeof low);
        memcpy(chunk->told + i + 2, &high, sizeof high);
        memcpy(chunk->in_run + i, &in_run, sizeof in_run);
        memcpy(chunk->step + i, &step, sizeof step);
    }
}

// A pixel belongs to a run if it equals the one before, and so does the next one or did the last one. Each
// pixel writes the next token, but only a pixel told as it is or a run's last one keeps it: no branch, but
// for whole chunks of one colour. A run that is pending at a chunk's start is shorter than a chunk, so that
// it always fits a match.
static inline __attribute__((always_inline)) void find_runs(struct deflate *deflate, unsigned bytes_per_pixel,
                                                            int first, int end)
{
    const int width = deflate->width;
    const uint32_t *row = deflate->row;
    struct token *token = deflate->end;
    const uint64_t fourth = bytes_per_pixel == 3 ? (uint64_t)DEFLATE_NOTHING << 48 : 0;
    const uint64_t distance = distance_of(bytes_per_pixel), shortest = match_of(DEFLATE_SHORTEST, distance);
    uint32_t pending = 0; // bytes of the run so far
    struct chunk chunk;
    for (int x = 0; x < width;) {
        if (x + CHUNK <= width && chunk_repeats(row, x)) {
            int start = x;
            if (x < first || x >= end)
                x = x < first ? first : width;
            while (x + CHUNK <= width && chunk_repeats(row, x))
                x += CHUNK;
            while (row[x] == row[x - 1])
                x++;
            token = tell_match(token, pending + (size_t)(x - start) * bytes_per_pixel, distance);
            pending = 0;
            continue;
        }
        const int count = width - x < CHUNK ? width - x : CHUNK;
        look_at(&chunk, row + x, fourth);
        for (int i = 0; i < count; i++) {
            pending = (pending + bytes_per_pixel) & chunk.in_run[i];
            uint64_t match = shortest + pending - DEFLATE_SHORTEST, told = chunk.told[i];
            uint64_t run = (uint64_t)(int32_t)chunk.in_run[i];
            put_token(token, told ^ ((told ^ match) & run)); // a choice without a branch
            token += chunk.step[i];
        }
        x += count;
    }
    deflate->end = token;
}

// A pixel's four bytes, 16 bits apart.
static inline uint64_t spread(uint32_t pixel)
{
    uint64_t x = (pixel | (uint64_t)pixel << 16) & 0x0000FFFF0000FFFFu;
    return (x | x << 8) & 0x00FF00FF00FF00FFu;
}

static inline uint64_t two_pixels(const uint32_t *at)
{
    uint64_t pair;
    memcpy(&pair, at, sizeof pair);
    return pair;
}

// How many pixels are the same from here and from there on, of which two are known to be, and `most` count.
// One more is looked at: there is room behind a row.
static inline int equal_pixels(const uint32_t *here, const uint32_t *there, int most)
{
    int count = 2;
    uint64_t differ = 0;
    while (count < most && (differ = two_pixels(here + count) ^ two_pixels(there + count)) == 0)
        count += 2;
    count += count < most && (uint32_t)differ == 0;
    return count < most ? count : most;
}

// Takes a run of two and more; else the last place of these two pixels, if the match is longer than a run of
// one would be; else a run of one; else the pixel. Matches stay within a row on both sides, so that no
// filter's byte is in them.
static void find_pairs(struct deflate *deflate, int first, int end)
{
    struct token *token = deflate->end;
    const int width = deflate->width, bytes_per_pixel = deflate->bytes_per_pixel;
    const int longest = DEFLATE_LONGEST / bytes_per_pixel;
    const uint32_t *row = deflate->row;
    const int64_t row_bytes = (int64_t)width * bytes_per_pixel + 1;
    const uint64_t fourth = bytes_per_pixel == 3 ? (uint64_t)DEFLATE_NOTHING << 48 : 0;
    const uint64_t near = distance_of((uint32_t)bytes_per_pixel), one_more = match_of((size_t)bytes_per_pixel, near);
    for (int x = 0; x < width;) {
        const uint64_t pair = two_pixels(row + x);
        if (pair == two_pixels(row + x - 1)) {
            int run = x < first ? first - x : x >= end ? width - x : 2;
            while (x + run + CHUNK <= width && chunk_repeats(row, x + run))
                run += CHUNK;
            while (row[x + run] == row[x - 1])
                run++;
            token = tell_match(token, (size_t)run * (unsigned)bytes_per_pixel, near);
            x += run;
            continue;
        }
        if (x + 1 < width) {
            uint32_t *last = &deflate->last_places[pair * 0x9E3779B97F4A7C15u >> (64 - DEFLATE_HASH_BITS)];
            const uint32_t place = *last, there_y = place >> 16;
            const int there_x = (int)(place & 0xFFFF);
            *last = deflate->y << 16 | (uint32_t)x;
            if (place != UINT32_MAX) {
                const int64_t back =
                    (int64_t)(deflate->y - there_y) * row_bytes + (int64_t)(x - there_x) * bytes_per_pixel;
                // Its row goes on by two pixels at least: else it would not have been noted.
                const uint32_t *there = deflate->words + there_y * deflate->stride + there_x;
                if ((back <= DEFLATE_FARTHEST) & (two_pixels(there) == pair)) {
                    int most = width - (x > there_x ? x : there_x);
                    int count = equal_pixels(row + x, there, most < longest ? most : longest);
                    put_token(token++, match_of((size_t)(count * bytes_per_pixel), distance_of((uint32_t)back)));
                    x += count;
                    continue;
                }
            }
        }
        const uint64_t told = spread(row[x]) | fourth, run = 0 - (uint64_t)(row[x] == row[x - 1]);
        put_token(token++, told ^ ((told ^ one_more) & run)); // a choice without a branch
        x++;
    }
    deflate->end = token;
}

static inline void count(uint32_t counts[4][DEFLATE_KINDS], const struct token *token)
{
    for (int i = 0; i < 4; i++)
        counts[i][token->kind[i]]++;
}

void deflate_row(struct deflate *deflate, int first, int end)
{
    struct token *token = deflate->end;
    put_token(deflate->end++, ONE(deflate->filter));
    // The first pixel repeats nothing: the filter's byte stands before it. Behind the last one every run ends.
    uint32_t *row = deflate->row;
    row[-1] = ~row[0];
    row[deflate->width] = ~row[deflate->width - 1];
    if (deflate->pairs)
        find_pairs(deflate, first, end);
    else if (deflate->bytes_per_pixel == 4)
        find_runs(deflate, 4, first, end);
    else
        find_runs(deflate, 3, first, end);
    deflate->row += deflate->stride;
    deflate->y++;
    // Two sets of counts: neighbours are often equal, and adding to what was just stored takes some cycles.
    for (; token + 2 <= deflate->end; token += 2) {
        count(deflate->counts[0], token);
        count(deflate->counts[1], token + 1);
    }
    if (token < deflate->end)
        count(deflate->counts[0], token);
}
