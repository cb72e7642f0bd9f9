// deflate_write.c: counted tokens become bits: the strip's own Huffman codes, or the bytes as they are.
#include "deflate.h"

#include "huffman.h"

#include <string.h>

enum {
    LITERALS = 286, // bytes 0…255, end of block, lengths 257…285
    END_OF_BLOCK = 256,
    FIRST_LENGTH = 257,
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
    for (unsigned length = DEFLATE_SHORTEST; length <= DEFLATE_LONGEST; length++) {
        unsigned extra, symbol = length_symbol(length, &extra);
        uint32_t count = deflate->counts[0][0][DEFLATE_MATCH + length - DEFLATE_SHORTEST] +
                         deflate->counts[1][0][DEFLATE_MATCH + length - DEFLATE_SHORTEST];
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
    for (unsigned length = DEFLATE_SHORTEST; length <= DEFLATE_LONGEST; length++) {
        unsigned extra, symbol = length_symbol(length, &extra), count = codes->length[symbol];
        uint32_t more = (length - DEFLATE_SHORTEST) & ((1u << extra) - 1);
        // Then the distance, whose only code is a zero bit.
        entries[DEFLATE_MATCH + length - DEFLATE_SHORTEST] =
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
                end = at + token->kind[0] - DEFLATE_MATCH + DEFLATE_SHORTEST;
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
