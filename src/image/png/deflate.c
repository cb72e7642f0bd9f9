// deflate.c: converts rows of filtered pixels to tokens, and counts the tokens.
#include "deflate.h"

#include <string.h>

enum {
    CHUNK = 16, // pixels that are processed together
    // Padding words before and after a row, so that loops may read beyond both ends of the row.
    PADDING_BEFORE = 4,
    PADDING_AFTER = CHUNK,
};

typedef uint8_t u8x16 __attribute__((vector_size(16)));
typedef uint32_t u32x4 __attribute__((vector_size(16)));
typedef uint64_t u64x2 __attribute__((vector_size(16)));
typedef u32x4 u32x4_memory __attribute__((aligned(4), may_alias));

static inline u32x4 load(const uint32_t *at) { return (u32x4) * (const u32x4_memory *)at; }

// Tokens are built as 64-bit integers; the first quarter is the lowest 16 bits.
static inline void put_token(struct token *at, uint64_t token) { memcpy(at, &token, sizeof token); }

static size_t stride_of(int width) { return PADDING_BEFORE + (size_t)width + PADDING_AFTER; }

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
    deflate->last_positions = arena_array(arena, 1 << DEFLATE_HASH_BITS, sizeof *deflate->last_positions);
    // There is space for one more token than will be kept, because find_runs writes a token for each pixel before it
    // decides whether to keep it.
    deflate->tokens = arena_array(arena, (size_t)rows * ((size_t)width + 1) + 1, sizeof *deflate->tokens);
    if (!words || !deflate->last_positions || !deflate->tokens)
        return false;
    deflate->words = words + PADDING_BEFORE;
    return true;
}

void deflate_start(struct deflate *deflate, uint8_t filter, bool matches)
{
    deflate->filter = filter;
    deflate->row = deflate->words;
    deflate->matches = matches || deflate->bytes_per_pixel < 3; // grey pictures always use matches
    deflate->y = 0;
    deflate->end = deflate->tokens;
    memset(deflate->counts, 0, sizeof deflate->counts);
    if (deflate->matches)
        memset(deflate->last_positions, 0xFF, sizeof *deflate->last_positions << DEFLATE_HASH_BITS); // no positions yet
}

// Returns a token whose first `used` (1 … 4) quarters are zero, and whose other quarters are empty.
static inline uint64_t unused_after(int used)
{
    const uint64_t all = (uint64_t)DEFLATE_NOTHING * 0x0001000100010001u;
    return used == 4 ? 0 : all << 16 * used;
}

// Returns the symbol and the extra bits of a distance (RFC 1951, 3.2.5). For distances of 5 or more, there are two
// symbols for each power of two.
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

// Returns the token of a match of 3 … 258 bytes.
static inline uint64_t match_of(size_t length, uint64_t distance)
{
    return (DEFLATE_MATCH + length - DEFLATE_SHORTEST) | distance << 16;
}

// Splits a match of any length into matches of at most 258 bytes. Each match is as long as possible, but never leaves a
// remainder of 1 or 2 bytes.
static struct token *put_match(struct token *token, size_t left, uint64_t distance)
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

// Returns whether all CHUNK pixels, starting with row[x], are equal to row[x - 1].
static inline bool chunk_repeats(const uint32_t *row, int x)
{
    const u32x4 pixel = (u32x4){0} + row[x - 1];
    u32x4 differ = {0};
    for (int i = 0; i < CHUNK; i += 4)
        differ |= load(row + x + i) ^ pixel;
    u64x2 halves = (u64x2)differ;
    return (halves[0] | halves[1]) == 0;
}

// The tokens of a chunk's pixels, computed from each pixel and its neighbours.
struct chunk {
    uint64_t literal[CHUNK]; // the pixel's bytes as a token
    uint32_t in_run[CHUNK];  // all bits are set if the pixel belongs to a run; otherwise 0
    int32_t step[CHUNK];     // 0 if the run continues after the pixel; otherwise 1
};

// Computes the tokens of a chunk. A run repeats the previous pixel at least twice.
static inline __attribute__((always_inline)) void examine(struct chunk *chunk, const uint32_t *at, int bytes_per_pixel)
{
    const u64x2 unused = (u64x2){0} + unused_after(bytes_per_pixel);
    for (int i = 0; i < CHUNK; i += 4) {
        const u32x4 here = load(at + i), before = load(at + i - 1);
        const u32x4 same = (u32x4)(here == before), next = (u32x4)(load(at + i + 1) == here);
        const u32x4 previous = (u32x4)(before == load(at + i - 2));
        const u32x4 in_run = same & (previous | next), step = (in_run & next) + 1;
        const u8x16 bytes = (u8x16)here, zero = {0};
        // Inserts a zero byte after each byte.
        const u64x2 low = unused | (u64x2)__builtin_shufflevector(bytes, zero, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21,
                                                                  6, 22, 7, 23);
        const u64x2 high = unused | (u64x2)__builtin_shufflevector(bytes, zero, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28,
                                                                   13, 29, 14, 30, 15, 31);
        memcpy(chunk->literal + i, &low, sizeof low);
        memcpy(chunk->literal + i + 2, &high, sizeof high);
        memcpy(chunk->in_run + i, &in_run, sizeof in_run);
        memcpy(chunk->step + i, &step, sizeof step);
    }
}

// Finds the runs of a row. For every pixel, the next token is written, but it is kept only for a literal or for the
// last pixel of a run. Therefore the only branch is the check for chunks of a single colour. A run that is pending at
// the start of a chunk is shorter than a chunk, so one match can represent it.
static inline __attribute__((always_inline)) void find_runs(struct deflate *deflate, unsigned bytes_per_pixel,
                                                            int first, int end)
{
    const int width = deflate->width;
    const uint32_t *row = deflate->row;
    struct token *token = deflate->end;
    const uint64_t distance = distance_of(bytes_per_pixel), shortest = match_of(DEFLATE_SHORTEST, distance);
    uint32_t pending = 0; // length of the current run in bytes
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
            token = put_match(token, pending + (size_t)(x - start) * bytes_per_pixel, distance);
            pending = 0;
            continue;
        }
        const int count = width - x < CHUNK ? width - x : CHUNK;
        examine(&chunk, row + x, (int)bytes_per_pixel);
        for (int i = 0; i < count; i++) {
            pending = (pending + bytes_per_pixel) & chunk.in_run[i];
            const uint64_t match = shortest + pending - DEFLATE_SHORTEST, literal = chunk.literal[i];
            const uint64_t run = (uint64_t)(int32_t)chunk.in_run[i];
            put_token(token, literal ^ ((literal ^ match) & run)); // a branchless selection
            token += chunk.step[i];
        }
        x += count;
    }
    deflate->end = token;
}

// Returns the four bytes of a pixel, each in 16 bits.
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

// Returns the number of equal pixels starting at `a` and `b`, at most `max`. The function may read two pixels beyond
// the end, which is safe because rows are padded.
static inline int equal_pixels(const uint32_t *a, const uint32_t *b, int max)
{
    int count = 0;
    uint64_t differ = 0;
    while (count < max && (differ = two_pixels(a + count) ^ two_pixels(b + count)) == 0)
        count += 2;
    count += count < max && (uint32_t)differ == 0;
    return count < max ? count : max;
}

// Limits for find_matches, indexed by bytes_per_pixel. Pixels of one or two bytes need few bits as literals, so only
// longer matches and runs reduce the size (measured).
static const int key_pixels[5] = {0, 8, 4, 2, 2};  // pixels that are hashed together
static const int min_match[5] = {0, 20, 12, 2, 2}; // pixels
static const int min_run[5] = {0, 8, 5, 2, 2};     // number of pixels that repeat the previous pixel

// Returns the next key_pixels pixels as one integer.
static inline uint64_t key_of(const uint32_t *at, int bytes_per_pixel)
{
    if (bytes_per_pixel >= 3)
        return two_pixels(at);
    uint64_t key = 0;
    const int shift = 8 * bytes_per_pixel;
    for (int i = 0; i < key_pixels[bytes_per_pixel]; i += 2) {
        const uint64_t pair = two_pixels(at + i), mask = (UINT64_C(1) << 2 * shift) - 1;
        key |= ((pair | pair >> (32 - shift)) & mask) << i * shift;
    }
    return key;
}

// At each pixel, uses the first possible of three encodings: a run, a match with the last position of the same key, or
// literals for as many pixels as one token can contain. If a match may be as short as one pixel, a single repetition is
// also a match. The source and the target of a match are each within one row, so they contain no filter byte.
static inline __attribute__((always_inline)) void find_matches(struct deflate *deflate, const int bytes_per_pixel,
                                                               int first, int end)
{
    struct token *token = deflate->end;
    const int width = deflate->width, max_match = DEFLATE_LONGEST / bytes_per_pixel;
    const uint32_t *row = deflate->row;
    const int64_t row_bytes = (int64_t)width * bytes_per_pixel + 1;
    const uint64_t near = distance_of((uint32_t)bytes_per_pixel), one_more = match_of((size_t)bytes_per_pixel, near);
    for (int x = 0; x < width;) {
        if (two_pixels(row + x) == two_pixels(row + x - 1)) {
            int run = x < first ? first - x : x >= end ? width - x : 2;
            while (x + run + CHUNK <= width && chunk_repeats(row, x + run))
                run += CHUNK;
            while (row[x + run] == row[x - 1])
                run++;
            if (run >= min_run[bytes_per_pixel]) {
                token = put_match(token, (size_t)run * (unsigned)bytes_per_pixel, near);
                x += run;
                continue;
            }
        }
        const uint64_t key = key_of(row + x, bytes_per_pixel);
        if (x + key_pixels[bytes_per_pixel] <= width) {
            uint32_t *last = &deflate->last_positions[key * 0x9E3779B97F4A7C15u >> (64 - DEFLATE_HASH_BITS)];
            const uint32_t position = *last, there_y = position >> 16;
            const int there_x = (int)(position & 0xFFFF);
            *last = deflate->y << 16 | (uint32_t)x;
            if (position != UINT32_MAX) {
                const int64_t back =
                    (int64_t)(deflate->y - there_y) * row_bytes + (int64_t)(x - there_x) * bytes_per_pixel;
                const uint32_t *there = deflate->words + there_y * deflate->stride + there_x;
                if ((back <= DEFLATE_FARTHEST) & (key_of(there, bytes_per_pixel) == key)) {
                    const int max = width - (x > there_x ? x : there_x);
                    const int count = equal_pixels(row + x, there, max < max_match ? max : max_match);
                    if (count >= min_match[bytes_per_pixel]) {
                        put_token(token++, match_of((size_t)(count * bytes_per_pixel), distance_of((uint32_t)back)));
                        x += count;
                        continue;
                    }
                }
            }
        }
        if (bytes_per_pixel < DEFLATE_SHORTEST) {
            const int left = (width - x) * bytes_per_pixel, bytes = left < 4 ? left : 4;
            put_token(token++, (spread((uint32_t)key) & (UINT64_MAX >> (64 - 16 * bytes))) | unused_after(bytes));
            x += 4 / bytes_per_pixel;
        } else {
            const uint64_t literal = spread(row[x]) | unused_after(bytes_per_pixel);
            const uint64_t run = 0 - (uint64_t)(row[x] == row[x - 1]);
            put_token(token++, literal ^ ((literal ^ one_more) & run)); // a branchless selection
            x++;
        }
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
    put_token(deflate->end++, deflate->filter | unused_after(1));
    // The first pixel of a row never repeats a pixel, because the filter byte is before it. Every run ends at the last
    // pixel of the row.
    uint32_t *row = deflate->row;
    row[-1] = ~row[0];
    row[deflate->width] = ~row[deflate->width - 1];
    if (deflate->bytes_per_pixel == 1)
        find_matches(deflate, 1, first, end);
    else if (deflate->bytes_per_pixel == 2)
        find_matches(deflate, 2, first, end);
    else if (deflate->matches && deflate->bytes_per_pixel == 3)
        find_matches(deflate, 3, first, end);
    else if (deflate->matches)
        find_matches(deflate, 4, first, end);
    else if (deflate->bytes_per_pixel == 4)
        find_runs(deflate, 4, first, end);
    else
        find_runs(deflate, 3, first, end);
    deflate->row += deflate->stride;
    deflate->y++;
    // There are two sets of counts, because neighbouring tokens are often equal. Adding to a counter that was just
    // stored would have to wait for some cycles.
    for (; token + 2 <= deflate->end; token += 2) {
        count(deflate->counts[0], token);
        count(deflate->counts[1], token + 1);
    }
    if (token < deflate->end)
        count(deflate->counts[0], token);
}
