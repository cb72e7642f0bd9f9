// aabb_tree.h: a tree of boxes around a mesh's vertices. The tree helps to find the farthest vertex in a direction
// without visiting most of the vertices.
#ifndef AABB_TREE_H
#define AABB_TREE_H

#include "arena.h"
#include "pool.h"

#include <lambent/scene.h>

enum {
    BOX_CHILDREN = 16, // boxes that one box of the next level contains
    BOX_LEVELS = 8,    // one more than the levels of 2³² vertices in blocks of 64
};

// Minimum and maximum, relative to the mesh's origin.
typedef float box_of_six[6];

// Box i of the lowest level contains `block` used vertices, starting with number i · block. A box of each higher level
// contains BOX_CHILDREN boxes of the level below. The topmost level has at most BOX_CHILDREN boxes.
struct aabb_tree {
    const box_of_six *boxes; // one level after the other, the lowest first; NULL means no vertices
    size_t block;
    size_t vertices;
    int levels;
    size_t first[BOX_LEVELS], count[BOX_LEVELS];
};

// Builds the tree. `used` lists the vertices of the tree, in order (NULL means the first `count` vertices). Returns
// false if memory runs out.
bool box_tree_make(struct aabb_tree *tree, const lam_mesh *mesh, const uint32_t *used, size_t count,
                   struct arena *arena, struct pool *pool, lam_error *error);

// Returns the box around all vertices. The tree must contain vertices.
void box_tree_whole(const struct aabb_tree *tree, box_of_six whole);

static inline const box_of_six *boxes_of_level(const struct aabb_tree *tree, int level)
{
    return tree->boxes + tree->first[level];
}

// Returns the end of the items of a box whose first item is `first`. There are `each` items per box and `all` items in
// total.
static inline size_t box_end(size_t first, size_t each, size_t all) { return all - first < each ? all : first + each; }

#endif
