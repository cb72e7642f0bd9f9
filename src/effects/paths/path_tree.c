// path_tree.c: builds the tree of sources (path_tree.h).
#include "path_tree.h"

#include "path_numbers.h"

#include <string.h>

// Moves the `wanted` least keys to the front. All keys differ.
static void select_least(uint64_t *keys, uint32_t count, uint32_t wanted)
{
    for (uint32_t low = 0, high = count; low < high;) {
        uint32_t at = low + path_hash(low ^ high) % (high - low), less = low;
        uint64_t pivot = keys[at];
        keys[at] = keys[high - 1];
        for (uint32_t i = low; i + 1 < high; i++)
            if (keys[i] < pivot) {
                uint64_t moved = keys[i];
                keys[i] = keys[less];
                keys[less++] = moved;
            }
        keys[high - 1] = keys[less];
        keys[less] = pivot;
        if (wanted <= less)
            high = less;
        else
            low = less + 1;
    }
}

// Returns a number that is ordered as the floats are.
static uint32_t float_order(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits >> 31 ? ~bits : bits | 1u << 31;
}

// Divides the sources of `keys` (their lower halves) among the leaves below a node, at the median of the longest side.
static void split(struct path_tree *t, uint64_t *keys, uint32_t count, uint32_t node)
{
    if (node >= t->leaves) {
        t->nodes[node] = count ? t->nodes[(uint32_t)keys[0]] : (struct path_node){0};
        t->item[node - t->leaves] = count ? (uint32_t)keys[0] : 0;
        if (count)
            t->leaf[(uint32_t)keys[0]] = node - t->leaves;
        return;
    }
    float longest = -1;
    int axis = 0;
    for (int c = 0; c < 3; c++) {
        float low = __builtin_inff(), high = -low;
        for (uint32_t i = 0; i < count; i++) {
            float middle = path_node_middle(&t->nodes[(uint32_t)keys[i]], c);
            low = middle < low ? middle : low;
            high = middle > high ? middle : high;
        }
        axis = high - low > longest ? c : axis;
        longest = high - low > longest ? high - low : longest;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t number = (uint32_t)keys[i];
        keys[i] = (uint64_t)float_order(path_node_middle(&t->nodes[number], axis)) << 32 | number;
    }
    const uint32_t half = (count + 1) / 2;
    select_least(keys, count, half);
    split(t, keys, half, 2 * node);
    split(t, keys + half, count - half, 2 * node + 1);
}

// Sets the cone that contains the cones of two nodes.
static void join_cones(struct path_node *both, const struct path_node *const nodes[2])
{
    float square = 0;
    for (int c = 0; c < 3; c++) {
        both->axis[c] = nodes[0]->axis[c] + nodes[1]->axis[c];
        square += both->axis[c] * both->axis[c];
    }
    bool all = !(square > 0);
    for (int c = 0; c < 3 && !all; c++)
        both->axis[c] /= __builtin_sqrtf(square);
    both->cosine = 1;
    for (int i = 0; i < 2; i++) { // the sums of two angles: between the axes, and half the opening
        const struct path_node *n = nodes[i];
        float between = 0;
        for (int c = 0; c < 3; c++)
            between += both->axis[c] * n->axis[c];
        between = between < 1 ? between : 1;
        float apart = __builtin_sqrtf(1 - between * between), cosine = between * n->cosine - apart * n->sine,
              sine = apart * n->cosine + between * n->sine;
        all |= sine < 0 || (n->cosine == 0 && n->sine == 0);
        both->sine = cosine < both->cosine ? sine : both->sine;
        both->cosine = cosine < both->cosine ? cosine : both->cosine;
    }
    if (all)
        both->cosine = both->sine = 0;
}

// Returns the node above two others.
static struct path_node joined(const struct path_node *a, const struct path_node *b)
{
    const struct path_node sun_a = {.suns = a->power}, sun_b = {.suns = b->power};
    a = a->is_sun ? &sun_a : a;
    b = b->is_sun ? &sun_b : b;
    struct path_node both = a->power > 0 ? *a : *b;
    both.suns = a->suns + b->suns;
    if (!(a->power > 0) || !(b->power > 0))
        return both;
    both.power = a->power + b->power;
    both.reach = a->reach > b->reach ? a->reach : b->reach;
    for (int c = 0; c < 3; c++) {
        both.low[c] = a->low[c] < b->low[c] ? a->low[c] : b->low[c];
        both.high[c] = a->high[c] > b->high[c] ? a->high[c] : b->high[c];
        both.attenuation[c] = (a->attenuation[c] * a->power + b->attenuation[c] * b->power) / both.power;
    }
    join_cones(&both, (const struct path_node *const[2]){a, b});
    return both;
}

void path_tree_make(struct path_tree *t, uint64_t *keys)
{
    for (uint32_t i = 0; i < t->count; i++)
        keys[i] = i;
    split(t, keys, t->count, 1);
    for (uint32_t i = t->leaves - 1; i > 0; i--)
        t->nodes[i] = joined(&t->nodes[2 * i], &t->nodes[2 * i + 1]);
}
