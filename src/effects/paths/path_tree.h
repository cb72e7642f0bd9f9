// path_tree.h: a binary tree of the lamps, or of the emitting triangles, that chooses one of them for a point.
//
// The tree is complete, with medians along the longest sides: node i has the children 2i and 2i + 1, and node `leaves` is
// the first leaf. At each node, a child is chosen in proportion to the light that its sources would send to the point:
// at the geometric mean of their least and greatest distances, and at their greatest height above the surface. (Conty
// Estevez and Kulla 2018 take the middle of the box: with 10,000 lamps over a floor, the standard deviation of the choice
// is 6.4 times the mean with it, and 0.5 times with this; by power alone, 12 times.)
#ifndef PATH_TREE_H
#define PATH_TREE_H

#include "hierarchy.h"
#include "paths.h"

// Sources behind a surface keep this share, for coats with a normal of their own.
#define COSINE_LEAST 0.03f

// In a group of up to 16 leaves, all sources are compared at once.
enum { TREE_FEW = 16 };

// The distance to a cone is rounded by less than this share of the distance to its source.
#define CONE_MARGIN 0.001f

// A point in a box has this part of the box's half diagonal as its least distance, squared.
#define NEAREST 0.001f

// Sources in a box, in the hierarchy's space. Their light at a distance d is power / (a0 + a1 d + a2 d²).
struct path_node {
    float low[3], high[3];
    float power;
    float attenuation[3]; // the mean, weighted by power
    float reach;          // the square of the distance beyond which no source has light; may be infinite
    // The cone of all directions of the light: its axis, and the cosine and sine of its half angle. Both 0: all directions.
    float axis[3], cosine, sine;
    // A directional light, far outside the scene. Above the leaves, the members describe all other sources, and `suns` is
    // the power of the directional lights, which is the same everywhere.
    bool is_sun;
    float suns;
};

// Fills the tree. The caller sets `leaves` (a power of two, at least `count`), allocates `nodes` (2 · leaves), `item`
// (leaves), `leaf` and `keys` (count), and sets the first `count` nodes to the sources.
void path_tree_make(struct path_tree *tree, uint64_t *keys);

static inline float path_node_middle(const struct path_node *n, int c) { return 0.5f * (n->low[c] + n->high[c]); }

static inline double path_triangle_area(const struct ray_triangle *t)
{
    double square = 0;
    for (int c = 0, j = 1, k = 2; c < 3; j = k, k = c++) {
        double n = (t->p[1][j] - t->p[0][j]) * (t->p[2][k] - t->p[0][k]) -
                   (t->p[1][k] - t->p[0][k]) * (t->p[2][j] - t->p[0][j]);
        square += n * n;
    }
    return 0.5 * __builtin_sqrt(square);
}

// Returns whether a node's cone lights no point at d from the middle of the box, whose half diagonal is `radius`.
static inline bool tree_cone_misses(const struct path_node *n, const float d[3], float radius)
{
    float along = 0, square = 0;
    for (int c = 0; c < 3; c++) {
        along += n->axis[c] * d[c];
        square += d[c] * d[c];
    }
    float across = square - along * along, margin = radius + CONE_MARGIN * __builtin_sqrtf(square);
    return __builtin_sqrtf(across > 0 ? across : 0) * n->cosine - along * n->sine > margin;
}

// Returns the light of a node at x. `normal` is the normal of a surface that reflects light only from the front, or 0.
static inline float tree_light(const struct path_node *n, const double x[3], const float normal[3])
{
    float least = 0, most = 0, size = 0, above = 0, facing = 0, away[3];
    for (int c = 0; c < 3; c++) {
        float half = 0.5f * (n->high[c] - n->low[c]), d = path_node_middle(n, c) - (float)x[c];
        float far = __builtin_fabsf(d) + half, near = far - 2 * half;
        away[c] = -d;
        least += near > 0 ? near * near : 0;
        most += far * far;
        size += half * half;
        above += normal[c] * d + __builtin_fabsf(normal[c]) * half;
        facing += normal[c] * normal[c];
    }
    if (least > n->reach)
        return n->suns;
    if ((n->cosine != 0 || n->sine != 0) && tree_cone_misses(n, away, __builtin_sqrtf(size)))
        return n->suns;
    float square = __builtin_sqrtf((least + NEAREST * size) * most), distance = __builtin_sqrtf(square);
    float cosine = facing > 0 && above < distance ? above / distance : 1;
    cosine = cosine > COSINE_LEAST ? cosine : COSINE_LEAST;
    float weakening = (n->attenuation[0] + n->attenuation[1] * distance) + (n->attenuation[2] * square + 0x1p-40f);
    return n->suns + n->power * cosine / weakening;
}

// Returns the probability of the left child of a node.
static inline float tree_left(const struct path_tree *t, uint32_t node, const double x[3], const float normal[3])
{
    const struct path_node *left = &t->nodes[2 * node], *right = left + 1;
    if (!(left->power + left->suns > 0) || !(right->power + right->suns > 0))
        return left->power + left->suns > 0;
    float a = tree_light(left, x, normal), b = tree_light(right, x, normal), share = a / (a + b);
    return share >= 0 ? share : 0.5f; // NaN becomes ½
}

// Sets the light of the leaves of a group. Returns their sum.
static inline float tree_group(const struct path_tree *t, uint32_t first, uint32_t count, const double x[3],
                               const float normal[3], float light[TREE_FEW])
{
    const struct path_node *leaves = &t->nodes[t->leaves + first];
    float sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        light[i] = leaves[i].power > 0 ? tree_light(&leaves[i], x, normal) : 0;
        sum += light[i];
    }
    if (sum > 0 && sum < __builtin_inff())
        return sum;
    sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        light[i] = leaves[i].power > 0;
        sum += light[i];
    }
    return sum;
}

// Chooses a source for a point by u, in [0, 1). Returns the source's number, and its probability.
static inline uint32_t tree_choose(const struct path_tree *t, const double x[3], const float normal[3], float u,
                                   float *share)
{
    const uint32_t count = t->leaves < TREE_FEW ? t->leaves : TREE_FEW, groups = t->leaves / count;
    uint32_t node = 1, chosen = 0;
    float reached = 1, light[TREE_FEW] = {0};
    while (node < groups) {
        float left = tree_left(t, node, x, normal);
        bool right = u >= left && left < 1;
        u = right ? (u - left) / (1 - left) : u / left;
        reached *= right ? 1 - left : left;
        node = 2 * node + right;
    }
    const uint32_t first = (node - groups) * count;
    const float sum = tree_group(t, first, count, x, normal, light);
    u *= sum;
    for (uint32_t i = 0; i < count; i++)
        if (light[i] > 0) {
            chosen = i;
            if (u < light[i])
                break;
            u -= light[i];
        }
    *share = reached * (light[chosen] / sum);
    return t->item[first + chosen];
}

// Returns the probability of choosing source `number` for a point.
static inline float tree_share(const struct path_tree *t, uint32_t number, const double x[3], const float normal[3])
{
    const uint32_t count = t->leaves < TREE_FEW ? t->leaves : TREE_FEW, leaf = t->leaf[number];
    float light[TREE_FEW];
    const float sum = tree_group(t, leaf / count * count, count, x, normal, light);
    float share = light[leaf % count] / sum;
    for (uint32_t node = (t->leaves + leaf) / count; node > 1; node /= 2) {
        float left = tree_left(t, node / 2, x, normal);
        share *= node & 1 ? 1 - left : left;
    }
    return share;
}

#endif
