// deflate_codes.c: builds a block's prefix codes from counts, and writes them.
#include "deflate.h"

#include <string.h>

// The symbols of lengths above 10 form groups of four with the same number of extra bits. Length 258 has its own
// symbol.
unsigned length_symbol(unsigned length, unsigned *extra)
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

static const uint8_t code_length_order[CODE_LENGTHS] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                        11, 4,  12, 3, 13, 2, 14, 1, 15};
static const uint8_t code_length_extra[CODE_LENGTHS] = {[16] = 2, [17] = 3, [18] = 7};

static void put_length(struct codes *codes, uint8_t symbol, unsigned extra)
{
    codes->length_symbols[codes->length_symbol_count] = symbol;
    codes->length_extra[codes->length_symbol_count++] = (uint8_t)extra;
}

// Encodes the code lengths with run lengths (RFC 1951, 3.2.7). Symbol 16 repeats the previous length 3–6 times; symbols
// 17 and 18 mean 3–10 and 11–138 zeros.
static void encode_lengths(struct codes *codes, const uint8_t *lengths, unsigned count)
{
    for (unsigned i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && lengths[end] == lengths[i];)
            end++;
        unsigned left = end - i;
        if (lengths[i]) {
            put_length(codes, lengths[i], 0);
            left--;
        }
        while (left >= 3) {
            unsigned max = lengths[i] ? 6 : left > 10 ? 138 : 10;
            unsigned n = left < max ? left : max;
            put_length(codes, lengths[i] ? 16 : left > 10 ? 18 : 17, n - (!lengths[i] && left > 10 ? 11 : 3));
            left -= n;
        }
        for (; left; left--)
            put_length(codes, lengths[i], 0);
    }
}

void codes_make(struct codes *codes, const uint32_t counts[LITERALS], const uint32_t distance_counts[DISTANCES],
                uint64_t extra_bits)
{
    codes->bits = extra_bits;
    huffman_lengths(counts, LITERALS, CODE_LIMIT, codes->length);
    huffman_codes(codes->length, LITERALS, codes->code);

    huffman_lengths(distance_counts, DISTANCES, CODE_LIMIT, codes->distance_length);
    huffman_codes(codes->distance_length, DISTANCES, codes->distance_code);
    for (int i = 0; i < LITERALS; i++)
        codes->bits += (uint64_t)counts[i] * codes->length[i];
    for (int i = 0; i < DISTANCES; i++)
        codes->bits += (uint64_t)distance_counts[i] * (codes->distance_length[i] + distance_extra(i));
    // Trailing zeros are not written. The code length of the first distance is always written. If the first length is
    // zero and no other length follows, there are no distances.
    for (codes->literals = LITERALS; !codes->length[codes->literals - 1];)
        codes->literals--;
    for (codes->distances = DISTANCES; codes->distances > 1 && !codes->distance_length[codes->distances - 1];)
        codes->distances--;

    uint8_t all[LITERALS + DISTANCES];
    memcpy(all, codes->length, codes->literals);
    memcpy(all + codes->literals, codes->distance_length, codes->distances);
    codes->length_symbol_count = 0;
    encode_lengths(codes, all, codes->literals + codes->distances);

    uint32_t counts_of_lengths[CODE_LENGTHS] = {0};
    for (unsigned i = 0; i < codes->length_symbol_count; i++)
        counts_of_lengths[codes->length_symbols[i]]++;
    huffman_lengths(counts_of_lengths, CODE_LENGTHS, 7, codes->code_length_length);
    huffman_codes(codes->code_length_length, CODE_LENGTHS, codes->code_length_code);
    codes->code_lengths = CODE_LENGTHS;
    while (codes->code_lengths > 4 && !codes->code_length_length[code_length_order[codes->code_lengths - 1]])
        codes->code_lengths--;
    codes->bits += 3 + 5 + 5 + 4 + 3 * codes->code_lengths;
    for (int i = 0; i < CODE_LENGTHS; i++)
        codes->bits += (uint64_t)counts_of_lengths[i] * (codes->code_length_length[i] + code_length_extra[i]);
}

void put_codes(struct bits *bits, const struct codes *codes)
{
    put(bits, 0 | 2 << 1, 3); // not the last block; dynamic codes
    put(bits, codes->literals - 257, 5);
    put(bits, codes->distances - 1, 5);
    put(bits, codes->code_lengths - 4, 4);
    for (unsigned i = 0; i < codes->code_lengths; i++)
        put(bits, codes->code_length_length[code_length_order[i]], 3);
    for (unsigned i = 0; i < codes->length_symbol_count; i++) {
        uint8_t symbol = codes->length_symbols[i];
        put(bits, codes->code_length_code[symbol], codes->code_length_length[symbol]);
        put(bits, codes->length_extra[i], code_length_extra[symbol]);
    }
}

// --- builds prefix codes of limited length: first a Huffman tree, then a correction for leaves that are too deep.

// Sorts in ascending order. There are at most 286 keys, for which Shellsort is simple and takes only a few
// microseconds.
static void sort(uint32_t *keys, int count)
{
    static const int gaps[] = {132, 57, 23, 10, 4, 1};
    for (unsigned g = 0; g < sizeof gaps / sizeof *gaps; g++)
        for (int i = gaps[g]; i < count; i++) {
            uint32_t key = keys[i];
            int j = i;
            for (; j >= gaps[g] && keys[j - gaps[g]] > key; j -= gaps[g])
                keys[j] = keys[j - gaps[g]];
            keys[j] = key;
        }
}

// Finds the depth of each leaf in the Huffman tree of at least two ascending weights. Leaves are nodes 0 … leaves−1.
// Each further node joins the two lightest nodes that are not joined yet. These two are at the front of two queues: the
// leaves, and the joined nodes in the order of their creation.
static void tree_depths(const uint32_t *weights, int leaves, uint8_t *depths)
{
    uint32_t weight[2 * HUFFMAN_SYMBOLS];
    uint16_t parent[2 * HUFFMAN_SYMBOLS];
    uint8_t depth[2 * HUFFMAN_SYMBOLS];
    memcpy(weight, weights, (size_t)leaves * sizeof *weight);
    const int nodes = 2 * leaves - 1;
    int leaf = 0, joined = leaves;
    for (int node = leaves; node < nodes; node++) {
        weight[node] = 0;
        for (int child = 0; child < 2; child++) {
            int lightest = leaf < leaves && (joined >= node || weight[leaf] <= weight[joined]) ? leaf++ : joined++;
            weight[node] += weight[lightest];
            parent[lightest] = (uint16_t)node;
        }
    }
    depth[nodes - 1] = 0;
    for (int node = nodes - 2; node >= 0; node--)
        // the depth is below 40, because the counts for a deep tree grow like Fibonacci numbers
        depth[node] = (uint8_t)(depth[parent[node]] + 1);
    memcpy(depths, depth, (size_t)leaves);
}

void huffman_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths)
{
    uint32_t keys[HUFFMAN_SYMBOLS];
    uint8_t depths[HUFFMAN_SYMBOLS];
    int used = 0;
    memset(lengths, 0, (size_t)symbols);
    for (int i = 0; i < symbols; i++)
        if (counts[i])
            keys[used++] = counts[i] << 9 | (uint32_t)i;
    if (used < 2) {
        if (used == 1)
            lengths[keys[0] & 511] = 1;
        return;
    }
    sort(keys, used);
    uint32_t weights[HUFFMAN_SYMBOLS];
    for (int i = 0; i < used; i++)
        weights[i] = keys[i] >> 9;
    tree_depths(weights, used, depths);

    // The number of codes of each length; codes above the limit are shortened to the limit. A code of length l occupies
    // 2^(limit−l) of 2^limit positions, so after the shortening, too many positions are occupied. The extra positions
    // are released one by one. In each step, a code of the longest length below the limit becomes one bit longer, and a
    // code of the limit's length shares its position.
    uint32_t of_length[64] = {0}, taken = 0;
    for (int i = 0; i < used; i++) {
        int length = depths[i] < limit ? depths[i] : limit;
        of_length[length]++;
        taken += 1u << (limit - length);
    }
    for (; taken > 1u << limit; taken--) {
        int length = limit - 1;
        while (of_length[length] == 0)
            length--;
        of_length[length]--;
        of_length[length + 1] += 2;
        of_length[limit]--;
    }
    // The rarest symbols have the longest codes.
    int next = 0;
    for (int length = limit; length > 0; length--)
        for (uint32_t i = 0; i < of_length[length]; i++)
            lengths[keys[next++] & 511] = (uint8_t)length;
}

void huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes)
{
    unsigned of_length[16] = {0}, next[16] = {0};
    for (int i = 0; i < symbols; i++)
        of_length[lengths[i]]++;
    of_length[0] = 0;
    for (int length = 1; length < 16; length++)
        next[length] = (next[length - 1] + of_length[length - 1]) << 1;
    for (int i = 0; i < symbols; i++) {
        unsigned code = lengths[i] ? next[lengths[i]]++ : 0, reversed = 0;
        for (int bit = 0; bit < lengths[i]; bit++)
            reversed |= (code >> bit & 1) << (lengths[i] - 1 - bit);
        codes[i] = (uint16_t)reversed;
    }
}
