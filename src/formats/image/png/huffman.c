// huffman.c: builds prefix codes of limited length: first a Huffman tree, then a correction for leaves that are too
// deep.
#include "huffman.h"

#include <string.h>

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
