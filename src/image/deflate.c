// deflate.c: rows of filtered pixels become a deflate block: runs of a pixel, and one Huffman code a strip.
#include "deflate.h"

#include "huffman.h"

#include <string.h>

enum {
    LITERALS = 286, // bytes 0…255, end of block, lengths 257…285
    END_OF_BLOCK = 256,
    FIRST_LENGTH = 257,
    SHORTEST_MATCH = 3,
    LONGEST_MATCH = 258,
    CODE_LIMIT = 14, // a token in one 64-bit step: four codes, 4·14 bits, and the 7 bits still waiting
    STORED_MOST = 65535,
    CHUNK = 16, // pixels that are looked at together for a long run
};

// Tokens are made as 64-bit numbers, the first kind lowest. This one holds one thing only.
#define ONE(kind) ((uint64_t)(kind) | (uint64_t)DEFLATE_NOTHING * 0x0001000100010000u)

typedef uint8_t u8x16 __attribute__((vector_size(16)));
typedef uint32_t u32x4 __attribute__((vector_size(16)));
typedef uint64_t u64x2 __attribute__((vector_size(16)));
typedef u32x4 u32x4_memory __attribute__((aligned(4), may_alias));

static inline u32x4 load(const uint32_t *at)
{
    return (u32x4) * (const u32x4_memory *)at;
}
static inline void put_token(struct token *at, uint64_t token)
{
    memcpy(at, &token, sizeof token);
}

enum { ROOM_BEFORE = 4 };

size_t deflate_scratch(int width, int rows)
{
    return (size_t)rows * ((size_t)width + 1) * sizeof(struct token) +
           (ROOM_BEFORE + (size_t)width + CHUNK) * sizeof(uint32_t);
}

size_t deflate_room(int width, int rows, int bytes_per_pixel)
{
    // Stored blocks, the ending one, and what the last 8-byte step may touch beyond.
    size_t bytes = (size_t)rows * ((size_t)width * (unsigned)bytes_per_pixel + 1);
    return bytes + 5 * (bytes / STORED_MOST + 2) + 8;
}

bool deflate_make(struct deflate *deflate, struct arena *arena, int width, int rows, int bytes_per_pixel)
{
    deflate->width = width;
    deflate->bytes_per_pixel = bytes_per_pixel;
    uint32_t *row = arena_alloc_zeroed(arena, (ROOM_BEFORE + (size_t)width + CHUNK) * sizeof *row);
    // One more than there can be: a run's pixels write a token each before they know which is the last.
    deflate->tokens = arena_array(arena, (size_t)rows * ((size_t)width + 1) + 1, sizeof *deflate->tokens);
    if (!row || !deflate->tokens)
        return false;
    deflate->row = row + ROOM_BEFORE;
    deflate->end = deflate->tokens;
    return true;
}

void deflate_start(struct deflate *deflate)
{
    deflate->end = deflate->tokens;
    memset(deflate->counts, 0, sizeof deflate->counts);
}

// A match of any length as matches that can be told: the longest first, but never leaving 1 or 2 bytes.
static struct token *tell_match(struct token *token, size_t left)
{
    while (left) {
        size_t match = left <= LONGEST_MATCH                    ? left
                       : left - LONGEST_MATCH >= SHORTEST_MATCH ? LONGEST_MATCH
                                                                : LONGEST_MATCH - SHORTEST_MATCH;
        put_token(token++, ONE(DEFLATE_MATCH + match - SHORTEST_MATCH));
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

// What the pixels of a chunk are, each by itself and its neighbours.
struct chunk {
    uint64_t told[CHUNK]; // the pixel's bytes as a token
    uint32_t
        in_run[CHUNK]; // all bits: equals the pixel before, and so does the next one or did that one; else 0
    int32_t step[CHUNK]; // 0: in a run that goes on; else 1
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
        const u64x2 low = extra | (u64x2)__builtin_shufflevector(bytes, zero, 0, 16, 1, 17, 2, 18, 3, 19, 4,
                                                                 20, 5, 21, 6, 22, 7, 23);
        const u64x2 high = extra | (u64x2)__builtin_shufflevector(bytes, zero, 8, 24, 9, 25, 10, 26, 11, 27,
                                                                  12, 28, 13, 29, 14, 30, 15, 31);
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
static inline __attribute__((always_inline)) void make_tokens(struct deflate *deflate,
                                                              unsigned bytes_per_pixel)
{
    const int width = deflate->width;
    uint32_t *row = deflate->row;
    struct token *token = deflate->end;
    const uint64_t fourth = bytes_per_pixel == 3 ? (uint64_t)DEFLATE_NOTHING << 48 : 0;
    // The first pixel repeats nothing: the filter's byte stands before it. Behind the last one every run
    // ends.
    row[-1] = ~row[0];
    row[width] = ~row[width - 1];
    uint32_t pending = 0; // bytes of the run so far
    struct chunk chunk;
    for (int x = 0; x < width;) {
        if (x + CHUNK <= width && chunk_repeats(row, x)) {
            int start = x;
            do
                x += CHUNK;
            while (x + CHUNK <= width && chunk_repeats(row, x));
            while (row[x] == row[x - 1])
                x++;
            token = tell_match(token, pending + (size_t)(x - start) * bytes_per_pixel);
            pending = 0;
            continue;
        }
        const int count = width - x < CHUNK ? width - x : CHUNK;
        look_at(&chunk, row + x, fourth);
        for (int i = 0; i < count; i++) {
            pending = (pending + bytes_per_pixel) & chunk.in_run[i];
            uint64_t match = ONE(DEFLATE_MATCH - SHORTEST_MATCH) + pending, told = chunk.told[i];
            uint64_t run = (uint64_t)(int32_t)chunk.in_run[i];
            put_token(token, told ^ ((told ^ match) & run)); // a choice without a branch
            token += chunk.step[i];
        }
        x += count;
    }
    deflate->end = token;
}

static inline void count(uint32_t counts[4][DEFLATE_KINDS], const struct token *token)
{
    for (int i = 0; i < 4; i++)
        counts[i][token->kind[i]]++;
}

void deflate_row(struct deflate *deflate, uint8_t filter)
{
    struct token *token = deflate->end;
    put_token(deflate->end++, ONE(filter));
    if (deflate->bytes_per_pixel == 4)
        make_tokens(deflate, 4);
    else
        make_tokens(deflate, 3);
    // Two sets of counts: neighbours are often equal, and adding to what was just stored takes some cycles.
    for (; token + 2 <= deflate->end; token += 2) {
        count(deflate->counts[0], token);
        count(deflate->counts[1], token + 1);
    }
    if (token < deflate->end)
        count(deflate->counts[0], token);
}

// The symbol and the number of extra bits of a match of 3 … 258 bytes. Lengths over 10 come in groups of four
// symbols with as many extra bits as it takes; 258 has a symbol of its own.
static unsigned length_symbol(unsigned length, unsigned *extra)
{
    unsigned beyond = length - SHORTEST_MATCH;
    *extra = 0;
    if (length == LONGEST_MATCH)
        return FIRST_LENGTH + 28;
    if (beyond < 8)
        return FIRST_LENGTH + beyond;
    unsigned top = 31 - (unsigned)__builtin_clz(beyond);
    *extra = top - 2;
    return FIRST_LENGTH + 4 * (top - 1) + (beyond >> (top - 2) & 3);
}

// Bits waiting to become bytes, the first lowest. After put() fewer than 8 wait.
struct bits {
    uint8_t *at;
    uint64_t waiting;
    unsigned count;
};

static inline __attribute__((always_inline)) void put(struct bits *bits, uint64_t value, unsigned count)
{
    bits->waiting |= value << bits->count;
    bits->count += count;
    memcpy(bits->at, &bits->waiting, 8);
    bits->at += bits->count >> 3;
    bits->waiting >>= bits->count & 56;
    bits->count &= 7;
}

// Ends on a byte boundary with an empty stored block.
static uint8_t *put_boundary(struct bits *bits)
{
    put(bits, 0, 3);
    if (bits->count)
        put(bits, 0, 8 - bits->count);
    put(bits, 0xFFFF0000u, 32);
    return bits->at;
}

// A block's two codes and how they are told.
struct codes {
    uint8_t length[LITERALS];
    uint16_t code[LITERALS];
    unsigned literals, distances; // how many lengths are told
    uint8_t told[LITERALS + 4];   // the lengths' own symbols 0…18, in order …
    uint8_t more[LITERALS + 4];   // … and what follows each in extra bits
    unsigned told_count;
    uint8_t told_length[19];
    uint16_t told_code[19];
    unsigned told_lengths; // how many of told_length, in the format's order
    uint64_t bits;         // of the whole block
};

static const uint8_t told_order[19] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
static const uint8_t told_extra[19] = {[16] = 2, [17] = 3, [18] = 7};

static void tell(struct codes *codes, uint8_t symbol, unsigned more)
{
    codes->told[codes->told_count] = symbol;
    codes->more[codes->told_count++] = (uint8_t)more;
}

// Run-length code of the code lengths (RFC 1951, 3.2.7): 16 repeats the last 3–6 times, 17 and 18 are 3–10
// and 11–138 zeros.
static void tell_lengths(struct codes *codes, const uint8_t *lengths, unsigned count)
{
    for (unsigned i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && lengths[end] == lengths[i];)
            end++;
        unsigned left = end - i;
        if (lengths[i]) {
            tell(codes, lengths[i], 0);
            left--;
        }
        while (left >= 3) {
            unsigned most = lengths[i] ? 6 : left > 10 ? 138 : 10;
            unsigned n = left < most ? left : most;
            tell(codes, lengths[i] ? 16 : left > 10 ? 18 : 17, n - (!lengths[i] && left > 10 ? 11 : 3));
            left -= n;
        }
        for (; left; left--)
            tell(codes, lengths[i], 0);
    }
}

static uint32_t count_of(const struct deflate *deflate, int kind)
{
    uint32_t count = 0;
    for (int quarter = 0; quarter < 4; quarter++)
        count += deflate->counts[0][quarter][kind] + deflate->counts[1][quarter][kind];
    return count;
}

static void make_codes(struct codes *codes, const struct deflate *deflate)
{
    uint32_t counts[LITERALS] = {[END_OF_BLOCK] = 1};
    for (int i = 0; i < 256; i++)
        counts[i] = count_of(deflate, i);
    codes->bits = 0;
    for (unsigned length = SHORTEST_MATCH; length <= LONGEST_MATCH; length++) {
        unsigned extra, symbol = length_symbol(length, &extra);
        uint32_t count = deflate->counts[0][0][DEFLATE_MATCH + length - SHORTEST_MATCH] +
                         deflate->counts[1][0][DEFLATE_MATCH + length - SHORTEST_MATCH];
        counts[symbol] += count;
        codes->bits += (uint64_t)count * extra;
    }
    huffman_lengths(counts, LITERALS, CODE_LIMIT, codes->length);
    huffman_codes(codes->length, LITERALS, codes->code);

    uint64_t matches = 0;
    for (int i = 0; i < LITERALS; i++) {
        codes->bits += (uint64_t)counts[i] * codes->length[i];
        matches += i >= FIRST_LENGTH ? counts[i] : 0;
    }
    // The one distance has a code of one bit; where there is no run, one length of zero says that none is
    // used.
    codes->bits += matches;
    uint8_t distance_length[4] = {0};
    const unsigned distance_symbol = (unsigned)deflate->bytes_per_pixel - 1; // distances 1…4 are symbols 0…3
    distance_length[distance_symbol] = 1;
    codes->distances = matches ? distance_symbol + 1 : 1;
    codes->literals = LITERALS;
    while (!codes->length[codes->literals - 1])
        codes->literals--;

    uint8_t all[LITERALS + 4];
    memcpy(all, codes->length, codes->literals);
    memcpy(all + codes->literals, distance_length, codes->distances);
    codes->told_count = 0;
    tell_lengths(codes, all, codes->literals + codes->distances);

    uint32_t told_counts[19] = {0};
    for (unsigned i = 0; i < codes->told_count; i++)
        told_counts[codes->told[i]]++;
    huffman_lengths(told_counts, 19, 7, codes->told_length);
    huffman_codes(codes->told_length, 19, codes->told_code);
    codes->told_lengths = 19;
    while (codes->told_lengths > 4 && !codes->told_length[told_order[codes->told_lengths - 1]])
        codes->told_lengths--;
    codes->bits += 3 + 5 + 5 + 4 + 3 * codes->told_lengths;
    for (int i = 0; i < 19; i++)
        codes->bits += (uint64_t)told_counts[i] * (codes->told_length[i] + told_extra[i]);
}

static void put_codes(struct bits *bits, const struct codes *codes)
{
    put(bits, 0 | 2 << 1, 3); // not the last block; codes of its own
    put(bits, codes->literals - 257, 5);
    put(bits, codes->distances - 1, 5);
    put(bits, codes->told_lengths - 4, 4);
    for (unsigned i = 0; i < codes->told_lengths; i++)
        put(bits, codes->told_length[told_order[i]], 3);
    for (unsigned i = 0; i < codes->told_count; i++) {
        uint8_t symbol = codes->told[i];
        put(bits, codes->told_code[symbol], codes->told_length[symbol]);
        put(bits, codes->more[i], told_extra[symbol]);
    }
}

// A kind as it is written.
struct entry {
    uint32_t bits, count;
};

static void make_entries(struct entry entries[DEFLATE_KINDS], const struct codes *codes)
{
    for (int i = 0; i < 256; i++)
        entries[i] = (struct entry){codes->code[i], codes->length[i]};
    for (unsigned length = SHORTEST_MATCH; length <= LONGEST_MATCH; length++) {
        unsigned extra, symbol = length_symbol(length, &extra), count = codes->length[symbol];
        uint32_t more = (length - SHORTEST_MATCH) & ((1u << extra) - 1);
        // Then the distance, whose only code is a zero bit.
        entries[DEFLATE_MATCH + length - SHORTEST_MATCH] =
            (struct entry){codes->code[symbol] | more << count, count + extra + 1};
    }
    entries[DEFLATE_NOTHING] = (struct entry){0};
}

static uint8_t *put_tokens(const struct deflate *deflate, const struct codes *codes, uint8_t *out)
{
    struct bits head = {.at = out};
    put_codes(&head, codes);
    struct entry entries[DEFLATE_KINDS];
    make_entries(entries, codes);
    struct bits bits = head; // a copy whose address nobody has, so that it stays in registers
    for (const struct token *token = deflate->tokens, *end = deflate->end; token < end; token++) {
        const struct entry a = entries[token->kind[0]], b = entries[token->kind[1]];
        const struct entry c = entries[token->kind[2]], d = entries[token->kind[3]];
        uint64_t low = a.bits | (uint64_t)b.bits << a.count, high = c.bits | (uint64_t)d.bits << c.count;
        unsigned low_count = a.count + b.count;
        put(&bits, low | high << low_count, low_count + c.count + d.count);
    }
    head = bits;
    put(&head, codes->code[END_OF_BLOCK], codes->length[END_OF_BLOCK]);
    return put_boundary(&head);
}

// The stream's bytes, stored as they are in blocks of at most STORED_MOST.
struct storing {
    uint8_t *at;
    size_t left, in_block; // bytes still to come, of them in this block
};

static void store(struct storing *storing, uint8_t byte)
{
    if (storing->in_block == 0) {
        size_t n = storing->in_block = storing->left < STORED_MOST ? storing->left : STORED_MOST;
        const uint8_t head[5] = {0, (uint8_t)n, (uint8_t)(n >> 8), (uint8_t)~n, (uint8_t)(~n >> 8)};
        memcpy(storing->at, head, sizeof head);
        storing->at += sizeof head;
    }
    *storing->at++ = byte;
    storing->in_block--;
    storing->left--;
}

// Where codes would only make it longer: noise, and pictures of a few pixels.
static uint8_t *put_stored(const struct deflate *deflate, size_t bytes, uint8_t *out)
{
    struct storing storing = {out, bytes, 0};
    const struct token *token = deflate->tokens;
    while (token < deflate->end) {
        store(&storing, (uint8_t)token++->kind[0]); // the filter
        const struct token *pixel = token;
        for (int at = 0; at < deflate->width * deflate->bytes_per_pixel; token++) {
            int end = at + deflate->bytes_per_pixel;
            if (token->kind[0] < DEFLATE_MATCH)
                pixel = token;
            else
                end = at + token->kind[0] - DEFLATE_MATCH + SHORTEST_MATCH;
            for (; at < end; at++)
                store(&storing, (uint8_t)pixel->kind[at % deflate->bytes_per_pixel]);
        }
    }
    struct bits bits = {.at = storing.at};
    return put_boundary(&bits);
}

size_t deflate_write(struct deflate *deflate, size_t rows, uint8_t *out)
{
    struct codes codes;
    make_codes(&codes, deflate);
    size_t bytes = ((size_t)deflate->width * (unsigned)deflate->bytes_per_pixel + 1) * rows;
    uint8_t *end =
        codes.bits / 8 < bytes ? put_tokens(deflate, &codes, out) : put_stored(deflate, bytes, out);
    return (size_t)(end - out);
}
