// aabb_tree.c: builds a tree of boxes around blocks of vertices.
#include "aabb_tree.h"

#define LANES 4
#include "lanes.h"

#include <string.h>

enum {
    // Vertices per box. In indexed meshes, triangles share vertices, so the same number of vertices covers more of the
    // surface.
    BLOCK_SHARED = 64,
    BLOCK_CORNERS = 256,
    CHUNK = 1 << 16, // vertices per task: a whole number of boxes of the two lowest levels
};

struct boxing {
    struct aabb_tree *tree;
    box_of_six *boxes;
    const float *positions;
    const uint32_t *used;
};

static const box_of_six nothing = {3e38f, 3e38f, 3e38f, -3e38f, -3e38f, -3e38f};

static void widen(box_of_six box, const float low[3], const float high[3])
{
    for (int a = 0; a < 3; a++) {
        box[a] = low[a] < box[a] ? low[a] : box[a];
        box[a + 3] = high[a] > box[a + 3] ? high[a] : box[a + 3];
    }
}

// Computes the box of consecutive vertices, four at a time: their twelve floats alternate x, y and z.
static void box_of_row(const float *p, size_t count, box_of_six box)
{
    num low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = num_of(nothing[0]);
        high[k] = num_of(nothing[3]);
    }
    size_t fours = count / 4;
    for (size_t i = 0; i < fours; i++, p += 12)
        for (int k = 0; k < 3; k++) {
            num four = num_load(p + 4 * k);
            low[k] = min_of(four, low[k]);
            high[k] = max_of(four, high[k]);
        }
    float lows[12], highs[12];
    memcpy(lows, low, sizeof lows);
    memcpy(highs, high, sizeof highs);
    memcpy(box, nothing, sizeof nothing);
    for (int k = 0; k < 12; k += 3)
        widen(box, lows + k, highs + k);
    for (size_t i = 4 * fours; i < count; i++, p += 3)
        widen(box, p, p);
}

static void box_of_block(const struct boxing *boxing, size_t first, size_t end, box_of_six box)
{
    if (!boxing->used) {
        box_of_row(boxing->positions + 3 * first, end - first, box);
        return;
    }
    memcpy(box, nothing, sizeof nothing);
    for (size_t i = first; i < end; i++) {
        const float *p = boxing->positions + 3 * (size_t)boxing->used[i];
        widen(box, p, p);
    }
}

static void box_of_boxes(const box_of_six *below, size_t count, box_of_six box)
{
    memcpy(box, nothing, sizeof nothing);
    for (size_t i = 0; i < count; i++)
        widen(box, below[i], below[i] + 3);
}

// Computes the boxes `first` to `end` of a level from the boxes of the level below.
static void box_level(const struct boxing *boxing, int level, size_t first, size_t end)
{
    const struct aabb_tree *tree = boxing->tree;
    for (size_t i = first; i < end; i++) {
        size_t child = i * BOX_CHILDREN;
        box_of_boxes((const box_of_six *)boxing->boxes + tree->first[level - 1] + child,
                     box_end(child, BOX_CHILDREN, tree->count[level - 1]) - child,
                     boxing->boxes[tree->first[level] + i]);
    }
}

static void box_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    const struct boxing *boxing = user;
    const struct aabb_tree *tree = boxing->tree;
    size_t each = CHUNK / tree->block, first = index * each, end = box_end(first, each, tree->count[0]);
    for (size_t i = first; i < end; i++) {
        size_t vertex = i * tree->block;
        box_of_block(boxing, vertex, box_end(vertex, tree->block, tree->vertices), boxing->boxes[i]);
    }
    if (tree->levels > 1)
        box_level(boxing, 1, first / BOX_CHILDREN, (end + BOX_CHILDREN - 1) / BOX_CHILDREN);
}

bool box_tree_make(struct aabb_tree *tree, const lam_mesh *mesh, const uint32_t *used, size_t count,
                   struct arena *arena, struct pool *pool, lam_error *error)
{
    *tree = (struct aabb_tree){.block = mesh->indices ? BLOCK_SHARED : BLOCK_CORNERS, .vertices = count};
    if (!count)
        return true;
    size_t boxes = 0, each = tree->block, below = count;
    do {
        below = (below + each - 1) / each;
        tree->first[tree->levels] = boxes;
        tree->count[tree->levels++] = below;
        boxes += below;
        each = BOX_CHILDREN;
    } while (below > BOX_CHILDREN);
    struct boxing boxing = {tree, arena_array(arena, boxes, sizeof *boxing.boxes), mesh->positions, used};
    if (!boxing.boxes)
        return call_memory_error(arena->call, boxes * sizeof *boxing.boxes, error);
    pool_run(pool, (count + CHUNK - 1) / CHUNK, box_chunk, &boxing);
    for (int level = 2; level < tree->levels; level++)
        box_level(&boxing, level, 0, tree->count[level]);
    tree->boxes = (const box_of_six *)boxing.boxes;
    return true;
}

void box_tree_whole(const struct aabb_tree *tree, box_of_six whole)
{
    box_of_boxes(boxes_of_level(tree, tree->levels - 1), tree->count[tree->levels - 1], whole);
}
