// deflate_codes.c: a block's prefix codes: made from counts, and told.
#include "deflate_codes.h"

#include "huffman.h"

// Lengths over 10 come in groups of four symbols with as many extra bits as it takes; 258 has a symbol of its own.
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

void put_codes(struct bits *bits, const struct codes *codes)
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
