// triangulate.c: splits polygons of any size, convex or not, into triangles.
//
// Ear clipping (Meisters 1975): a corner is an ear if it is convex and its triangle contains no other corner. Cutting
// an ear changes only its two neighbours, so each corner is tested about three times. Only corners that are not convex
// can be inside an ear. Such corners are sorted in Morton order and stored in a tree of bounding boxes. Therefore a
// test takes about √count steps even for long thin ears, for any distribution of the corners.
//
// Decisions are exact. The corners are projected along the axis of the normal's largest component and snapped to
// integers, with 2^30 steps along the longer side of their bounding box. The grid is finer than the resolution of a
// float, and a cross product fits into 64 bits.
#include "triangulate.h"

#include <string.h>

enum {
    NONE = UINT32_MAX,
    LEAF = 8,      // points per leaf of the tree
    STEP_RATE = 4, // at most STEP_RATE · count·√count nodes and points are visited; simple polygons need a third
    CHECK_INTERVAL = 65536,
    STEPS = 1 << 30, // grid steps along the polygon's longer side
};

// The conditions for cutting a corner. A corner that fails the test of a level is moved to the next level. The corner
// is tested again only when the queues of all earlier levels are empty. Simple polygons use only the first two levels.
enum level {
    LEVEL_EAR,    // convex, and its triangle contains no other corner, not even on its edges
    LEVEL_FLAT,   // as above, or its triangle has no area: the corner is collinear with its neighbours, a spike, or a
                  // repeated point
    LEVEL_TOUCH,  // convex, and no other corner is strictly inside
    LEVEL_CONVEX, // convex
    LEVEL_ANY,
    LEVELS,
};

struct corner {
    int32_t x, y;
    uint32_t previous, next; // around the remaining polygon
    uint32_t earlier, later; // in the queue of its level
    uint32_t slot;           // in the tree; NONE if not in it
    uint8_t level;           // LEVELS if it is in no queue
};

// The bounding box of a node's points. `count` of these points remain.
struct box {
    int32_t min_x, min_y, max_x, max_y;
    uint32_t count;
};

struct clip {
    struct corner *corners;
    uint32_t first[LEVELS], last[LEVELS]; // queues
    uint32_t *points;                     // corner numbers in Morton order
    struct box *boxes; // a complete binary tree: node i has the children 2i and 2i + 1; node `leaves` is the first leaf
    uint32_t leaves;   // a power of two; 0 means no points
    uint64_t steps;    // number of nodes and points of the tree that tests have visited
    uint64_t most;     // limit of `steps`
};

void triangulator_start(struct triangulator *scratch, struct call_control *call)
{
    *scratch = (struct triangulator){.call = call};
    arena_start(&scratch->memory, NULL);
}

void triangulator_stop(struct triangulator *scratch)
{
    arena_free(&scratch->memory);
    *scratch = (struct triangulator){0};
}

static const float *position_of(const float *positions, const uint32_t *corners, uint32_t i)
{
    return positions + 3 * (size_t)corners[i];
}

// Computes (b − a) × (c − a) in double: because coordinates have 24 bits, the sign is correct except for the flattest
// triangles.
static void face_normal(const float *a, const float *b, const float *c, double out[3])
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = (double)b[k] - (double)a[k];
        v[k] = (double)c[k] - (double)a[k];
    }
    out[0] = u[1] * v[2] - u[2] * v[1];
    out[1] = u[2] * v[0] - u[0] * v[2];
    out[2] = u[0] * v[1] - u[1] * v[0];
}

// Returns whether the two triangles of a quad face in the same direction.
static bool same_side(const float *a, const float *b, const float *c, const float *d, const float *e, const float *f)
{
    double m[3], n[3];
    face_normal(a, b, c, m);
    face_normal(d, e, f, n);
    return m[0] * n[0] + m[1] * n[1] + m[2] * n[2] > 0.0;
}

static void write_fan(uint32_t count, uint32_t *triples)
{
    for (uint32_t i = 1; i + 1 < count; i++, triples += 3) {
        triples[0] = 0;
        triples[1] = i;
        triples[2] = i + 1;
    }
}

static void cut_quad(const float *positions, const uint32_t *corners, uint32_t *triples)
{
    const float *a = position_of(positions, corners, 0), *b = position_of(positions, corners, 1);
    const float *c = position_of(positions, corners, 2), *d = position_of(positions, corners, 3);
    static const uint32_t other[6] = {0, 1, 3, 1, 2, 3};
    if (!same_side(a, b, c, a, c, d) && same_side(a, b, d, b, c, d))
        memcpy(triples, other, sizeof other);
    else
        write_fan(4, triples);
}

// Returns twice the signed area of the triangle, in grid steps. The result is exact and below 2^62.
static int64_t turn(const struct corner *a, const struct corner *b, const struct corner *c)
{
    return ((int64_t)b->x - a->x) * ((int64_t)c->y - a->y) - ((int64_t)b->y - a->y) * ((int64_t)c->x - a->x);
}

static int64_t turn_at(const struct corner *corners, uint32_t i)
{
    return turn(&corners[corners[i].previous], &corners[i], &corners[corners[i].next]);
}

static bool same_place(const struct corner *a, const struct corner *b) { return a->x == b->x && a->y == b->y; }

// Projects and snaps the corners. The result is oriented so that the polygon is counter-clockwise. Returns false if the
// polygon has no area.
static bool snap(const float *positions, const uint32_t *numbers, uint32_t count, struct corner *corners)
{
    // The polygon's normal by Newell's method, relative to the first corner: the sum over the triangles of a fan.
    double normal[3] = {0, 0, 0};
    const float *base = position_of(positions, numbers, 0);
    double low[3], high[3];
    for (int k = 0; k < 3; k++)
        low[k] = high[k] = (double)base[k];
    for (uint32_t i = 1; i < count; i++) {
        const float *p = position_of(positions, numbers, i);
        for (int k = 0; k < 3; k++) {
            low[k] = (double)p[k] < low[k] ? (double)p[k] : low[k];
            high[k] = (double)p[k] > high[k] ? (double)p[k] : high[k];
        }
        if (i + 1 < count) {
            double n[3];
            face_normal(base, p, position_of(positions, numbers, i + 1), n);
            for (int k = 0; k < 3; k++)
                normal[k] += n[k];
        }
    }
    double size[3] = {normal[0] < 0 ? -normal[0] : normal[0], normal[1] < 0 ? -normal[1] : normal[1],
                      normal[2] < 0 ? -normal[2] : normal[2]};
    int away = size[2] >= size[0] && size[2] >= size[1] ? 2 : size[1] >= size[0] ? 1 : 0;
    int across = (away + 1) % 3, up = (away + 2) % 3;
    if (normal[away] < 0) {
        int swap = across;
        across = up;
        up = swap;
    }

    double side = high[across] - low[across] > high[up] - low[up] ? high[across] - low[across] : high[up] - low[up];
    double scale = (double)STEPS / side;
    if (!(side > 0) || !(scale < 1e300)) // the polygon has no extent, or `side` is not finite
        return false;
    __extension__ __int128 area = 0;
    for (uint32_t i = 0; i < count; i++) {
        const float *p = position_of(positions, numbers, i);
        corners[i] = (struct corner){
            .x = (int32_t)(((double)p[across] - low[across]) * scale),
            .y = (int32_t)(((double)p[up] - low[up]) * scale),
            .previous = i ? i - 1 : count - 1,
            .next = i + 1 < count ? i + 1 : 0,
            .slot = NONE,
            .level = LEVELS,
        };
        if (i > 1)
            area += turn(&corners[0], &corners[i - 1], &corners[i]);
    }
    return area > 0;
}

// --- the tree of non-convex corners

// Spreads the low 31 bits of x to the even positions.
static uint64_t spread(uint32_t x)
{
    uint64_t v = x;
    v = (v | v << 16) & 0x0000ffff0000ffffu;
    v = (v | v << 8) & 0x00ff00ff00ff00ffu;
    v = (v | v << 4) & 0x0f0f0f0f0f0f0f0fu;
    v = (v | v << 2) & 0x3333333333333333u;
    return (v | v << 1) & 0x5555555555555555u;
}

static uint64_t morton(const struct corner *c) { return spread((uint32_t)c->x) | spread((uint32_t)c->y) << 1; }

// Sorts corner indices by Morton code, with a stable radix sort by the bytes of the code. Returns false if the call
// must stop.
static bool sort_points(const struct corner *corners, uint32_t *points, uint32_t *extra, uint32_t count,
                        struct call_control *call)
{
    for (int shift = 0; shift < 64; shift += 8) {
        if (!call_should_continue(call))
            return false;
        uint32_t starts[257] = {0};
        for (uint32_t i = 0; i < count; i++)
            starts[(morton(&corners[points[i]]) >> shift & 255) + 1]++;
        for (int b = 0; b < 256; b++)
            starts[b + 1] += starts[b];
        for (uint32_t i = 0; i < count; i++)
            extra[starts[morton(&corners[points[i]]) >> shift & 255]++] = points[i];
        uint32_t *swap = points;
        points = extra;
        extra = swap;
    } // after eight rounds, the result is in `points` again
    return true;
}

static void build_tree(struct clip *clip, uint32_t count)
{
    for (uint32_t leaf = 0; leaf < clip->leaves; leaf++) {
        struct box box = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN, 0};
        for (uint32_t slot = leaf * LEAF; slot < count && slot < (leaf + 1) * LEAF; slot++) {
            struct corner *c = &clip->corners[clip->points[slot]];
            c->slot = slot;
            box.min_x = c->x < box.min_x ? c->x : box.min_x;
            box.min_y = c->y < box.min_y ? c->y : box.min_y;
            box.max_x = c->x > box.max_x ? c->x : box.max_x;
            box.max_y = c->y > box.max_y ? c->y : box.max_y;
            box.count++;
        }
        clip->boxes[clip->leaves + leaf] = box;
    }
    for (uint32_t node = clip->leaves - 1; node > 0; node--) {
        const struct box *a = &clip->boxes[2 * node], *b = a + 1;
        clip->boxes[node] = (struct box){
            a->min_x < b->min_x ? a->min_x : b->min_x,
            a->min_y < b->min_y ? a->min_y : b->min_y,
            a->max_x > b->max_x ? a->max_x : b->max_x,
            a->max_y > b->max_y ? a->max_y : b->max_y,
            a->count + b->count,
        };
    }
}

static void tree_remove(struct clip *clip, uint32_t i)
{
    uint32_t slot = clip->corners[i].slot;
    if (slot == NONE)
        return;
    clip->corners[i].slot = NONE;
    clip->points[slot] = NONE;
    for (uint32_t node = clip->leaves + slot / LEAF; node > 0; node /= 2)
        clip->boxes[node].count--;
}

// Returns whether the whole box is to the right of a→b. Unless `touching` is set, a box that touches a→b is treated as
// if it were to the right.
static bool box_outside(const struct box *box, const struct corner *a, const struct corner *b, bool touching)
{
    // The corner of the box that is farthest to the left of the edge.
    struct corner far = {.x = b->y < a->y ? box->max_x : box->min_x, .y = b->x > a->x ? box->max_y : box->min_y};
    int64_t side = turn(a, b, &far);
    return touching ? side < 0 : side <= 0;
}

static int32_t min_int(int32_t a, int32_t b) { return a < b ? a : b; }
static int32_t max_int(int32_t a, int32_t b) { return a > b ? a : b; }

static bool point_inside(const struct corner *const triangle[3], const struct corner *p, bool touching)
{
    for (int k = 0; k < 3; k++) {
        // A point does not block its own ear, even if a bridge to a hole repeats the point.
        if (same_place(p, triangle[k]))
            return false;
        int64_t side = turn(triangle[k], triangle[k == 2 ? 0 : k + 1], p);
        if (touching ? side < 0 : side <= 0)
            return false;
    }
    return true;
}

// Returns whether a non-convex corner is inside corner i's triangle (with `touching`, also on its edges). If a polygon
// repeats a few points many times, the search could visit all nodes for each corner. Once the maximum number of steps
// is reached, all corners are therefore treated as blocked.
static bool blocked(struct clip *clip, uint32_t i, bool touching)
{
    if (clip->leaves == 0 || clip->boxes[1].count == 0)
        return false;
    if (clip->steps > clip->most)
        return true;
    const struct corner *tip = &clip->corners[i];
    const struct corner *const triangle[3] = {&clip->corners[tip->previous], tip, &clip->corners[tip->next]};
    // For a sliver, tests of the edges alone would not exclude points beyond its ends.
    const struct box around = {
        min_int(min_int(triangle[0]->x, triangle[1]->x), triangle[2]->x),
        min_int(min_int(triangle[0]->y, triangle[1]->y), triangle[2]->y),
        max_int(max_int(triangle[0]->x, triangle[1]->x), triangle[2]->x),
        max_int(max_int(triangle[0]->y, triangle[1]->y), triangle[2]->y),
        0,
    };
    uint32_t stack[64], depth = 0;
    stack[depth++] = 1;
    while (depth > 0) {
        uint32_t node = stack[--depth];
        const struct box *box = &clip->boxes[node];
        clip->steps++;
        if (box->count == 0 || box->min_x > around.max_x || box->max_x < around.min_x || box->min_y > around.max_y ||
            box->max_y < around.min_y || box_outside(box, triangle[0], triangle[1], touching) ||
            box_outside(box, triangle[1], triangle[2], touching) ||
            box_outside(box, triangle[2], triangle[0], touching))
            continue;
        if (node < clip->leaves) {
            stack[depth++] = 2 * node + 1;
            stack[depth++] = 2 * node;
            continue;
        }
        clip->steps += LEAF;
        for (uint32_t slot = (node - clip->leaves) * LEAF; slot < (node - clip->leaves + 1) * LEAF; slot++) {
            // Slots after the last point are unused. The leaf of such slots has the count 0, or is the last leaf with
            // points.
            if (clip->points[slot] != NONE && point_inside(triangle, &clip->corners[clip->points[slot]], touching))
                return true;
        }
    }
    return false;
}

// --- queues

static void queue_leave(struct clip *clip, uint32_t i)
{
    struct corner *c = &clip->corners[i];
    if (c->level == LEVELS)
        return;
    if (c->earlier == NONE)
        clip->first[c->level] = c->later;
    else
        clip->corners[c->earlier].later = c->later;
    if (c->later == NONE)
        clip->last[c->level] = c->earlier;
    else
        clip->corners[c->later].earlier = c->earlier;
    c->level = LEVELS;
}

// Appends a corner to a queue. The neighbours of a cut corner are also appended at the end, so that cuts are
// distributed around the polygon and triangles do not become slivers.
static void queue_join(struct clip *clip, uint32_t i, enum level level)
{
    queue_leave(clip, i);
    struct corner *c = &clip->corners[i];
    c->level = (uint8_t)level;
    c->later = NONE;
    c->earlier = clip->last[level];
    if (c->earlier == NONE)
        clip->first[level] = i;
    else
        clip->corners[c->earlier].later = i;
    clip->last[level] = i;
}

static bool may_cut(struct clip *clip, uint32_t i, enum level level)
{
    int64_t area = turn_at(clip->corners, i);
    switch (level) {
    case LEVEL_EAR:
        return area > 0 && !blocked(clip, i, true);
    case LEVEL_FLAT:
        return area == 0 || (area > 0 && !blocked(clip, i, true));
    case LEVEL_TOUCH:
        return area > 0 && !blocked(clip, i, false);
    case LEVEL_CONVEX:
        return area > 0;
    default:
        return true;
    }
}

static void cut(struct clip *clip, uint32_t i)
{
    struct corner *c = &clip->corners[i];
    tree_remove(clip, i);
    queue_leave(clip, i);
    clip->corners[c->previous].next = c->next;
    clip->corners[c->next].previous = c->previous;
    const uint32_t neighbours[2] = {c->previous, c->next};
    for (int k = 0; k < 2; k++) {
        if (turn_at(clip->corners, neighbours[k]) > 0)
            tree_remove(clip, neighbours[k]);
        queue_join(clip, neighbours[k], LEVEL_EAR);
    }
}

// Cuts off the corners one by one. Returns false if the call must stop.
static bool clip_ears(struct clip *clip, uint32_t count, struct call_control *call, uint32_t *triples)
{
    uint32_t left = count;
    uint64_t next_check = 0;
    for (uint64_t looks = 0; left > 3; looks++) {
        if (looks + clip->steps >= next_check) {
            if (!call_should_continue(call))
                return false;
            next_check = looks + clip->steps + CHECK_INTERVAL;
        }
        int level = LEVEL_EAR;
        while (level < LEVEL_ANY && clip->first[level] == NONE)
            level++;
        uint32_t i = clip->first[level];
        if (!may_cut(clip, i, (enum level)level)) {
            queue_join(clip, i, (enum level)(level + 1));
            continue;
        }
        triples[0] = clip->corners[i].previous;
        triples[1] = i;
        triples[2] = clip->corners[i].next;
        triples += 3;
        cut(clip, i);
        left--;
    }
    uint32_t i = 0;
    while (clip->corners[i].level == LEVELS) // removed corners are in no queue
        i++;
    triples[0] = clip->corners[i].previous;
    triples[1] = i;
    triples[2] = clip->corners[i].next;
    return true;
}

// Divides the block of scratch memory into the arrays for a polygon with `count` corners. The block grows if necessary
// and never shrinks.
static bool reserve_memory(struct triangulator *scratch, uint32_t count, struct clip *clip, uint32_t **extra)
{
    uint32_t leaves = 1;
    while ((uint64_t)leaves * LEAF < count)
        leaves *= 2;
    size_t corner_bytes = (size_t)count * sizeof(struct corner);
    size_t point_bytes = (size_t)leaves * LEAF * sizeof(uint32_t);
    size_t box_bytes = 2 * (size_t)leaves * sizeof(struct box);
    size_t wanted = corner_bytes + 2 * point_bytes + box_bytes;
    if (wanted > scratch->capacity) {
        size_t capacity = scratch->capacity * 2 > wanted ? scratch->capacity * 2 : wanted;
        arena_free(&scratch->memory);
        scratch->capacity = 0;
        scratch->block = arena_alloc(&scratch->memory, capacity);
        if (!scratch->block)
            return false;
        scratch->capacity = capacity;
    }
    char *at = scratch->block;
    clip->corners = (struct corner *)at;
    clip->boxes = (struct box *)(at + corner_bytes);
    clip->points = (uint32_t *)(at + corner_bytes + box_bytes);
    *extra = (uint32_t *)(at + corner_bytes + box_bytes + point_bytes);
    return true;
}

bool triangulate(struct triangulator *scratch, const float *positions, const uint32_t *corners, uint32_t count,
                 uint32_t *triples)
{
    if (count == 4)
        cut_quad(positions, corners, triples);
    if (count == 3)
        write_fan(3, triples);
    if (count <= 4)
        return true;

    struct clip clip = {0};
    uint32_t *extra;
    if (!reserve_memory(scratch, count, &clip, &extra))
        return false;
    if (!snap(positions, corners, count, clip.corners)) {
        write_fan(count, triples);
        return true;
    }
    for (int level = 0; level < LEVELS; level++)
        clip.first[level] = clip.last[level] = NONE;
    uint32_t points = 0;
    for (uint32_t i = 0; i < count; i++) {
        queue_join(&clip, i, LEVEL_EAR);
        if (turn_at(clip.corners, i) <= 0)
            clip.points[points++] = i;
    }
    if (points == 0) {
        write_fan(count, triples);
        return true;
    }
    if (!sort_points(clip.corners, clip.points, extra, points, scratch->call))
        return false;
    clip.leaves = 1;
    while ((uint64_t)clip.leaves * LEAF < points)
        clip.leaves *= 2;
    for (uint32_t slot = points; slot < clip.leaves * LEAF; slot++)
        clip.points[slot] = NONE;
    build_tree(&clip, points);
    uint64_t root = 1;
    while (root * root < count)
        root++;
    clip.most = CHECK_INTERVAL + STEP_RATE * root * count;
    return clip_ears(&clip, count, scratch->call, triples);
}
