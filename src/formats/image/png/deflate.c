// deflate.c: converts rows of filtered pixels to tokens, and counts the tokens.
#include "deflate.h"

#include <string.h>

enum {
    CHUNK = 16, // pixels that are processed together
    // Padding words before and after a row, so that loops may read beyond both ends of the row.
    PADDING_BEFORE = 4,
    PADDING_AFTER = CHUNK,
    STREAM_PADDING = 2 * CHUNK, // bytes before and after the packed rows of a strip
};

typedef uint8_t u8x16 __attribute__((vector_size(16)));
typedef uint32_t u32x4 __attribute__((vector_size(16)));
typedef uint64_t u64x2 __attribute__((vector_size(16)));
typedef u32x4 u32x4_memory __attribute__((aligned(4), may_alias));

static inline u32x4 load(const uint32_t *at) { return (u32x4) * (const u32x4_memory *)at; }

// A value in last_positions that means "no position". All its bytes are equal, and its distance from any position is
// above DEFLATE_FARTHEST.
#define NO_POSITION 0x80808080u

// Tokens are built as 64-bit integers; the first quarter is the lowest 16 bits.
static inline void put_token(struct token *at, uint64_t token) { memcpy(at, &token, sizeof token); }

static size_t stride_of(int width) { return PADDING_BEFORE + (size_t)width + PADDING_AFTER; }

// Returns the number of bytes that a filtered row occupies in the stream, including the filter byte.
static size_t stream_row(const struct deflate *deflate)
{
    return (size_t)deflate->width * (unsigned)deflate->bytes_per_pixel + 1;
}

size_t deflate_scratch(int width, int rows)
{
    return (size_t)rows * (((size_t)width + 1) * sizeof(struct token) + stride_of(width) * sizeof(uint32_t));
}

bool deflate_make(struct deflate *deflate, struct arena *arena, int width, int rows, int bytes_per_pixel)
{
    deflate->width = width;
    deflate->bytes_per_pixel = bytes_per_pixel;
    const bool packed = bytes_per_pixel <= DEFLATE_PACKED;
    const int pixels_per_token = packed ? 4 / bytes_per_pixel : 1;
    deflate->stride = packed ? 0 : stride_of(width);
    uint32_t *words = arena_array(arena, packed ? stride_of(width) : (size_t)rows * deflate->stride, sizeof *words);
    uint8_t *stream = packed ? arena_array(arena, (size_t)rows * stream_row(deflate) + 2 * STREAM_PADDING, 1) : NULL;
    deflate->last_positions = arena_array(arena, 1 << DEFLATE_HASH_BITS, sizeof *deflate->last_positions);
    // Reserves space for one additional token, because find_runs writes each token before deciding whether to keep the
    // token.
    const size_t tokens = (size_t)rows * ((size_t)((width + pixels_per_token - 1) / pixels_per_token) + 1) + 1;
    deflate->tokens = arena_array(arena, tokens, sizeof *deflate->tokens);
    if (!words || (packed && !stream) || !deflate->last_positions || !deflate->tokens)
        return false;
    deflate->words = words + PADDING_BEFORE;
    deflate->stream = packed ? stream + STREAM_PADDING : NULL;
    return true;
}

void deflate_start(struct deflate *deflate, uint8_t filter, bool matches)
{
    deflate->filter = filter;
    deflate->row = deflate->words;
    deflate->matches = matches;
    deflate->y = 0;
    deflate->end = deflate->tokens;
    memset(deflate->counts, 0, sizeof deflate->counts);
    if (deflate->matches || deflate->stream) // no positions yet
        memset(deflate->last_positions, NO_POSITION & 0xFF, sizeof *deflate->last_positions << DEFLATE_HASH_BITS);
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

static inline uint64_t hash_of(uint64_t key) { return key * 0x9E3779B97F4A7C15u >> (64 - DEFLATE_HASH_BITS); }

// At each pixel, uses a run if possible, otherwise a match with the last position of the same two pixels if possible,
// otherwise a literal. A single repetition is also a match. The source and the target of a match are each within one
// row, so they contain no filter byte.
static inline __attribute__((always_inline)) void find_matches(struct deflate *deflate, const int bytes_per_pixel,
                                                               int first, int end)
{
    enum { SHORTEST = 2 }; // pixels of a match or a run
    struct token *token = deflate->end;
    const int width = deflate->width, max_match = DEFLATE_LONGEST / bytes_per_pixel;
    const uint32_t *row = deflate->row;
    const int64_t row_bytes = (int64_t)stream_row(deflate);
    const uint64_t near = distance_of((uint32_t)bytes_per_pixel), one_more = match_of((size_t)bytes_per_pixel, near);
    for (int x = 0; x < width;) {
        const uint64_t key = two_pixels(row + x);
        if (key == two_pixels(row + x - 1)) {
            int run = x < first ? first - x : x >= end ? width - x : SHORTEST;
            while (x + run + CHUNK <= width && chunk_repeats(row, x + run))
                run += CHUNK;
            while (row[x + run] == row[x - 1])
                run++;
            token = put_match(token, (size_t)run * (unsigned)bytes_per_pixel, near);
            x += run;
            continue;
        }
        if (x + SHORTEST <= width) {
            uint32_t *last = &deflate->last_positions[hash_of(key)];
            const uint32_t position = *last, there_y = position >> 16;
            const int there_x = (int)(position & 0xFFFF);
            *last = deflate->y << 16 | (uint32_t)x;
            if (position != NO_POSITION) {
                const int64_t back =
                    (int64_t)(deflate->y - there_y) * row_bytes + (int64_t)(x - there_x) * bytes_per_pixel;
                const uint32_t *there = deflate->words + there_y * deflate->stride + there_x;
                if ((back <= DEFLATE_FARTHEST) & (two_pixels(there) == key)) {
                    const int max = width - (x > there_x ? x : there_x);
                    const int count = equal_pixels(row + x, there, max < max_match ? max : max_match);
                    if (count >= SHORTEST) {
                        put_token(token++, match_of((size_t)(count * bytes_per_pixel), distance_of((uint32_t)back)));
                        x += count;
                        continue;
                    }
                }
            }
        }
        const uint64_t literal = spread(row[x]) | unused_after(bytes_per_pixel);
        const uint64_t run = 0 - (uint64_t)(row[x] == row[x - 1]);
        put_token(token++, literal ^ ((literal ^ one_more) & run)); // a branchless selection
        x++;
    }
    deflate->end = token;
}

static inline uint64_t eight_bytes(const uint8_t *at)
{
    uint64_t bytes;
    memcpy(&bytes, at, sizeof bytes);
    return bytes;
}

// Returns the number of equal bytes starting at `a` and `b`, at most `max`. The function may read seven bytes beyond
// the end.
static inline int equal_bytes(const uint8_t *a, const uint8_t *b, int max)
{
    for (int count = 0; count < max; count += 8) {
        const uint64_t differ = eight_bytes(a + count) ^ eight_bytes(b + count);
        if (differ) {
            count += __builtin_ctzll(differ) / 8;
            return count < max ? count : max;
        }
    }
    return max;
}

// Stores the lowest byte, or the two lowest bytes, of each of `count` words. Rounds `count` up to a multiple of 16.
static inline void pack(uint8_t *out, const uint32_t *words, int count, int bytes_per_pixel)
{
    typedef uint16_t u16x8 __attribute__((vector_size(16)));
    for (int i = 0; i < count; i += CHUNK) {
        u16x8 halves[2];
        for (int k = 0; k < 2; k++)
            halves[k] = __builtin_shufflevector((u16x8)load(words + i + 8 * k), (u16x8)load(words + i + 8 * k + 4), 0,
                                                2, 4, 6, 8, 10, 12, 14);
        const u8x16 bytes = __builtin_shufflevector((u8x16)halves[0], (u8x16)halves[1], 0, 2, 4, 6, 8, 10, 12, 14, 16,
                                                    18, 20, 22, 24, 26, 28, 30);
        if (bytes_per_pixel == 1)
            memcpy(out + i, &bytes, sizeof bytes);
        else
            memcpy(out + 2 * i, halves, sizeof halves);
    }
}

// Does the same as find_matches for pixels of one or two bytes, whose rows are packed as in the stream. Such pixels
// need few bits as literals, so only longer matches and runs reduce the size (measured). `row` is the row in the
// stream; a token contains four bytes. Offsets and lengths are in bytes.
static inline __attribute__((always_inline)) void find_packed(struct deflate *deflate, uint8_t *row, const int pixel,
                                                              int first, int end)
{
    enum { KEY = 8 };                          // bytes that are hashed together
    const int shortest = pixel == 1 ? 20 : 24; // bytes of a match
    const int shortest_run = pixel == 1 ? 8 : 10;
    const int size = deflate->width * pixel;
    const uint32_t row_offset = (uint32_t)(row - deflate->stream);
    const uint64_t near = distance_of((uint32_t)pixel);
    struct token *token = deflate->end;
    row[size] = (uint8_t)~row[size - pixel]; // every run ends at the last pixel
    int at = 0;
    while (at + KEY <= size) {
        const uint64_t key = eight_bytes(row + at);
        if (key == eight_bytes(row + at - pixel) && at > 0) {
            int run = at < first * pixel ? first * pixel - at : at >= end * pixel ? size - at : KEY;
            while (at + run + KEY <= size && eight_bytes(row + at + run) == eight_bytes(row + at + run - pixel))
                run += KEY;
            while (row[at + run] == row[at + run - pixel] && row[at + run + pixel - 1] == row[at + run - 1])
                run += pixel;
            if (run >= shortest_run) {
                token = put_match(token, (size_t)run, near);
                at += run;
                continue;
            }
        }
        uint32_t *last = &deflate->last_positions[hash_of(key)];
        const uint32_t here = row_offset + (uint32_t)at, position = *last, back = here - position;
        *last = here;
        const uint8_t *there = row + at - (back <= DEFLATE_FARTHEST ? back : 0);
        // also compares the bytes after the key, because most repeated keys do not begin a match of the shortest length
        if ((int)(back <= DEFLATE_FARTHEST) & (int)(eight_bytes(there) == key) &
            (int)(eight_bytes(there + KEY) == eight_bytes(row + at + KEY))) {
            const int there_at = (int)((position - 1) % ((uint32_t)size + 1));
            const int left = size - (at > there_at ? at : there_at);
            const int max = left < DEFLATE_LONGEST ? left : DEFLATE_LONGEST;
            const int length = equal_bytes(row + at, there, max) / pixel * pixel;
            if (length >= shortest) {
                put_token(token++, match_of((size_t)length, distance_of(back)));
                at += length;
                continue;
            }
        }
        put_token(token++, spread((uint32_t)key));
        at += 4;
    }
    for (; at < size; at += 4) {
        const int bytes = size - at < 4 ? size - at : 4;
        put_token(token++,
                  (spread((uint32_t)eight_bytes(row + at)) & (UINT64_MAX >> (64 - 16 * bytes))) | unused_after(bytes));
    }
    deflate->end = token;
}

// Packs the row and finds its tokens.
static void packed_row(struct deflate *deflate, int first, int end)
{
    const int pixel = deflate->bytes_per_pixel;
    uint8_t *row = deflate->stream + deflate->y * stream_row(deflate) + 1;
    row[-1] = deflate->filter;
    memset(row, 0, (size_t)(first * pixel));
    pack(row + first * pixel, deflate->row + first, end - first, pixel);
    memset(row + end * pixel, 0, (size_t)((deflate->width - end) * pixel));
    if (pixel == 1)
        find_packed(deflate, row, 1, first, end);
    else
        find_packed(deflate, row, 2, first, end);
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
    if (deflate->stream)
        packed_row(deflate, first, end);
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
    // There are two sets of counts, because neighbouring tokens are often equal. If both used the same counter, the
    // second addition would wait for the first.
    for (; token + 2 <= deflate->end; token += 2) {
        count(deflate->counts[0], token);
        count(deflate->counts[1], token + 1);
    }
    if (token < deflate->end)
        count(deflate->counts[0], token);
}
