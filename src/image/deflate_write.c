// deflate_write.c: counted tokens become bits: the strip's own Huffman codes, or the bytes as they are.
#include "deflate.h"

#include "huffman.h"

#include <string.h>

enum {
    LITERALS = 286, // bytes 0…255, end of block, lengths 257…285
    END_OF_BLOCK = 256,
    FIRST_LENGTH = 257,
    DISTANCES = 30,
    CODE_LIMIT = 14, // a token in one 64-bit step: four codes, 4·14 bits, and the 7 bits still waiting
    STORED_MOST = 65535,
};

size_t deflate_room(int width, int rows, int bytes_per_pixel)
{
    // Stored blocks, the ending one, and what the last 8-byte step may touch beyond.
    size_t bytes = (size_t)rows * ((size_t)width * (unsigned)bytes_per_pixel + 1);
    return bytes + 5 * (bytes / STORED_MOST + 2) + 8;
}

// The symbol and the number of extra bits of a match of 3 … 258 bytes. Lengths over 10 come in groups of four
// symbols with as many extra bits as it takes; 258 has a symbol of its own.
static unsigned length_symbol(unsigned length, unsigned *extra)
{
    unsigned beyond = length - DEFLATE_SHORTEST;
    *extra = 0;
    if (length == DEFLATE_LONGEST)
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
    uint8_t length[LITERALS], distance_length[DISTANCES];
    uint16_t code[LITERALS], distance_code[DISTANCES];
    unsigned literals, distances;       // how many lengths are told
    uint8_t told[LITERALS + DISTANCES]; // the lengths' own symbols 0…18, in order …
    uint8_t more[LITERALS + DISTANCES]; // … and what follows each in extra bits
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

// Further bits of a distance symbol.
static unsigned distance_extra(int symbol) { return symbol < 4 ? 0 : (unsigned)symbol / 2 - 1; }

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
    for (unsigned length = DEFLATE_SHORTEST; length <= DEFLATE_LONGEST; length++) {
        unsigned extra, symbol = length_symbol(length, &extra);
        uint32_t count = deflate->counts[0][0][DEFLATE_MATCH + length - DEFLATE_SHORTEST] +
                         deflate->counts[1][0][DEFLATE_MATCH + length - DEFLATE_SHORTEST];
        counts[symbol] += count;
        codes->bits += (uint64_t)count * extra;
    }
    huffman_lengths(counts, LITERALS, CODE_LIMIT, codes->length);
    huffman_codes(codes->length, LITERALS, codes->code);

    uint32_t distance_counts[DISTANCES];
    for (int i = 0; i < DISTANCES; i++)
        distance_counts[i] = count_of(deflate, DEFLATE_DISTANCE + i);
    huffman_lengths(distance_counts, DISTANCES, CODE_LIMIT, codes->distance_length);
    huffman_codes(codes->distance_length, DISTANCES, codes->distance_code);
    for (int i = 0; i < LITERALS; i++)
        codes->bits += (uint64_t)counts[i] * codes->length[i];
    for (int i = 0; i < DISTANCES; i++)
        codes->bits += (uint64_t)distance_counts[i] * (codes->distance_length[i] + distance_extra(i));
    // Lengths of zero at the end are not told, but for the first: alone it says that there is no distance.
    for (codes->literals = LITERALS; !codes->length[codes->literals - 1];)
        codes->literals--;
    for (codes->distances = DISTANCES; codes->distances > 1 && !codes->distance_length[codes->distances - 1];)
        codes->distances--;

    uint8_t all[LITERALS + DISTANCES];
    memcpy(all, codes->length, codes->literals);
    memcpy(all + codes->literals, codes->distance_length, codes->distances);
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
    for (unsigned length = DEFLATE_SHORTEST; length <= DEFLATE_LONGEST; length++) {
        unsigned extra, symbol = length_symbol(length, &extra), count = codes->length[symbol];
        uint32_t more = (length - DEFLATE_SHORTEST) & ((1u << extra) - 1);
        entries[DEFLATE_MATCH + length - DEFLATE_SHORTEST] =
            (struct entry){codes->code[symbol] | more << count, count + extra};
    }
    for (int i = 0; i < DISTANCES; i++)
        entries[DEFLATE_DISTANCE + i] = (struct entry){codes->distance_code[i], codes->distance_length[i]};
    entries[DEFLATE_BITS] = (struct entry){0}; // no kind
    for (uint32_t n = 0; n <= 8; n++)
        for (uint32_t value = 0; value < 1u << n; value++)
            entries[DEFLATE_BITS + (1u << n) + value] = (struct entry){value, n};
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

static size_t stream_bytes(const struct deflate *deflate)
{
    return ((size_t)deflate->width * (unsigned)deflate->bytes_per_pixel + 1) * deflate->y;
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
static uint8_t *put_stored(const struct deflate *deflate, uint8_t *out)
{
    struct storing storing = {out, stream_bytes(deflate), 0};
    for (size_t y = 0; y < deflate->y; y++) {
        const uint32_t *row = deflate->words + y * deflate->stride;
        store(&storing, deflate->filter);
        for (int x = 0; x < deflate->width; x++)
            for (int channel = 0; channel < deflate->bytes_per_pixel; channel++)
                store(&storing, (uint8_t)(row[x] >> 8 * channel));
    }
    struct bits bits = {.at = storing.at};
    return put_boundary(&bits);
}

size_t deflate_write(const struct deflate *deflate, uint8_t *out)
{
    struct codes codes;
    make_codes(&codes, deflate);
    bool shorter = codes.bits / 8 < stream_bytes(deflate);
    uint8_t *end = shorter ? put_tokens(deflate, &codes, out) : put_stored(deflate, out);
    return (size_t)(end - out);
}
