// deflate_write.c: writes counted tokens as bits, with the strip's own Huffman codes, or stores the bytes uncompressed.
#include "deflate.h"

size_t deflate_capacity(int width, int rows, int bytes_per_pixel)
{
    // The sum of three sizes: the stored blocks, the empty block at the end, and the bytes after the end that the last
    // 8-byte step overwrites.
    size_t bytes = (size_t)rows * ((size_t)width * (unsigned)bytes_per_pixel + 1);
    return bytes + 5 * (bytes / MAX_STORED + 2) + 8;
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
    uint32_t counts[LITERALS] = {[END_OF_BLOCK] = 1}, distance_counts[DISTANCES];
    uint64_t extra_bits = 0;
    for (int i = 0; i < 256; i++)
        counts[i] = count_of(deflate, i);
    for (unsigned length = DEFLATE_SHORTEST; length <= DEFLATE_LONGEST; length++) {
        unsigned extra, symbol = length_symbol(length, &extra);
        uint32_t count = deflate->counts[0][0][DEFLATE_MATCH + length - DEFLATE_SHORTEST] +
                         deflate->counts[1][0][DEFLATE_MATCH + length - DEFLATE_SHORTEST];
        counts[symbol] += count;
        extra_bits += (uint64_t)count * extra;
    }
    for (int i = 0; i < DISTANCES; i++)
        distance_counts[i] = count_of(deflate, DEFLATE_DISTANCE + i);
    codes_make(codes, counts, distance_counts, extra_bits);
}

// The bits that encode a kind, and their number.
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
    entries[DEFLATE_BITS] = (struct entry){0}; // this value is not a kind
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
    struct bits bits = head; // a local copy, which stays in registers
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

// The state of the writer of uncompressed data, in blocks of at most MAX_STORED bytes.
struct storing {
    uint8_t *at;
    size_t left, in_block; // remaining bytes in total, and in the current block
};

static void store(struct storing *storing, uint8_t byte)
{
    if (storing->in_block == 0) {
        size_t n = storing->in_block = storing->left < MAX_STORED ? storing->left : MAX_STORED;
        const uint8_t head[5] = {0, (uint8_t)n, (uint8_t)(n >> 8), (uint8_t)~n, (uint8_t)(~n >> 8)};
        memcpy(storing->at, head, sizeof head);
        storing->at += sizeof head;
    }
    *storing->at++ = byte;
    storing->in_block--;
    storing->left--;
}

// Stores a strip uncompressed. Strips are stored if compression would make them longer, as for noise and for pictures
// with few pixels.
static uint8_t *put_stored(const struct deflate *deflate, uint8_t *out)
{
    struct storing storing = {out, stream_bytes(deflate), 0};
    for (size_t i = 0; deflate->stream && i < stream_bytes(deflate); i++)
        store(&storing, deflate->stream[i]);
    for (size_t y = 0; !deflate->stream && y < deflate->y; y++) {
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
