// splits.c: divides the triangles of a hierarchy into nodes.
//
// The surface area heuristic (MacDonald and Booth, 1990) with the candidates of Wald, "On fast construction of SAH-based
// bounding volume hierarchies", 2007: a node's triangles are sorted into bins by the middles of their boxes, and the
// boundary between two bins is taken where
//     area(left) count(left) + area(right) count(right)
// is least. Large ranges are divided first, one after the other, their triangles in pieces of a fixed size side by side;
// then each of the small ranges by one thread. A range's nodes have a place that follows from its triangles alone, so
// neither the threads nor their number matter.
#define LANES 4
#include "lanes.h"

#include "builder.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

enum {
    BINS = 16,
    FEW_BINS = 8, // of ranges of up to FEW triangles
    FEW = 64,
    SMALL = 8192,    // triangles of a range that one thread divides
    LEAF_MAX = 8,    // triangles
    LEAF_MIN = 3,    // triangles that are not divided any more
    BALANCED_AT = 48 // nodes above one that is divided in the middle
};

// The work of a ray at a triangle, where that at a node is 1.
#define TRIANGLE_WORK 1.0f

// Four floats of which the last means nothing.
struct box {
    num low, high;
};

static struct box empty_box(void) { return (struct box){num_of(3e38f), num_of(-3e38f)}; }

static struct box around(struct box a, struct box b)
{
    return (struct box){min_of(a.low, b.low), max_of(a.high, b.high)};
}

static struct box box_of(const struct primitive *p) { return (struct box){num_load(p->low), num_load(p->high)}; }

// Twice the middle of a triangle's box.
static num middle_of(const struct primitive *p) { return num_load(p->low) + num_load(p->high); }

static float half_area(struct box b)
{
    num d = b.high - b.low;
    return lane(d, 0) * lane(d, 1) + lane(d, 1) * lane(d, 2) + lane(d, 2) * lane(d, 0);
}

// Primitives of which nodes are to be made.
struct range {
    uint32_t first, count;
    uint32_t node; // the first of count − 1 nodes that it may use
    int depth, buffer;
    struct box box, middles;       // of the triangles; of twice the middles of their boxes
    uint32_t *child, *child_count; // where its node or leaf is entered
};

// --- leaves

static bool same_point(const double a[3], const double b[3]) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

// Whether two triangles have the same three positions, in any order.
static bool same_positions(const struct ray_triangle *a, const struct ray_triangle *b)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int i = 0; i < 6; i++)
        if (same_point(a->p[0], b->p[orders[i][0]]) && same_point(a->p[1], b->p[orders[i][1]]) &&
            same_point(a->p[2], b->p[orders[i][2]]))
            return true;
    return false;
}

// Makes a leaf. Triangles with the same positions have the same box, and are therefore in one leaf, or in one group
// (divide_group), which has found them.
static void make_leaf(struct builder *b, const struct range *r, bool grouped)
{
    const struct primitive *p = b->primitives[r->buffer] + r->first;
    for (uint32_t i = 0; i < r->count; i++) {
        struct ray_triangle *t = &b->triangles[r->first + i];
        *t = b->prepared[primitive_number(&p[i])];
        for (uint32_t j = 0; j < r->count && !grouped; j++) {
            uint32_t other = primitive_number(&p[j]);
            if (other < t->twin && same_positions(t, &b->prepared[other]))
                t->twin = other;
        }
        if (grouped)
            t->twin = b->twins[t->number];
        b->twins[t->number] = t->twin;
    }
    *r->child = r->first;
    *r->child_count = r->count;
}

// --- nodes

static void set_box(struct ray_node *node, int child, struct box box)
{
    for (int axis = 0; axis < 3; axis++) {
        node->low[child][axis] = lane(box.low, axis);
        node->high[child][axis] = lane(box.high, axis);
    }
}

// Enters a node for a range, with the first `left` of its primitives on the left.
static void make_node(struct builder *b, const struct range *r, uint32_t left, const struct box boxes[2],
                      const struct box middles[2], struct range out[2])
{
    struct ray_node *node = &b->nodes[r->node];
    *r->child = r->node;
    *r->child_count = 0;
    for (int i = 0; i < 2; i++) {
        set_box(node, i, boxes[i]);
        out[i] = (struct range){.first = i ? r->first + left : r->first,
                                .count = i ? r->count - left : left,
                                .node = i ? r->node + left : r->node + 1,
                                .depth = r->depth + 1,
                                .buffer = r->buffer,
                                .box = boxes[i],
                                .middles = middles[i],
                                .child = &node->child[i],
                                .child_count = &node->count[i]};
    }
}

static struct box middles_of(const struct primitive *p, uint32_t count)
{
    struct box box = empty_box();
    for (uint32_t i = 0; i < count; i++)
        box = around(box, (struct box){middle_of(&p[i]), middle_of(&p[i])});
    return box;
}

static struct box box_of_all(const struct primitive *p, uint32_t count)
{
    struct box box = empty_box();
    for (uint32_t i = 0; i < count; i++)
        box = around(box, box_of(&p[i]));
    return box;
}

// Enters a node for a range whose primitives are in order.
static void make_ordered_node(struct builder *b, const struct range *r, uint32_t left, struct range out[2])
{
    const struct primitive *p = b->primitives[r->buffer] + r->first;
    struct box boxes[2] = {box_of_all(p, left), box_of_all(p + left, r->count - left)};
    struct box middles[2] = {middles_of(p, left), middles_of(p + left, r->count - left)};
    make_node(b, r, left, boxes, middles, out);
}

// --- bins

struct bins {
    int count;
    struct box boxes[BINS], middles[BINS];
    uint32_t counts[BINS];
};

// How a range is divided: bin numbers below `bin` go to the left.
struct split {
    int axis, bin, bins;
    float start, factor;
};

static int bin_of(const struct split *s, const struct primitive *p)
{
    float middle = p->low[s->axis] + p->high[s->axis];
    int bin = (int)((middle - s->start) * s->factor);
    return bin < 0 ? 0 : bin < s->bins ? bin : s->bins - 1;
}

static void clear_bins(struct bins *bins, int count)
{
    bins->count = count;
    for (int i = 0; i < count; i++) {
        bins->boxes[i] = bins->middles[i] = empty_box();
        bins->counts[i] = 0;
    }
}

static void fill_bins(struct bins *bins, const struct split *s, const struct primitive *p, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        int bin = bin_of(s, &p[i]);
        num middle = middle_of(&p[i]);
        bins->boxes[bin] = around(bins->boxes[bin], box_of(&p[i]));
        bins->middles[bin] = around(bins->middles[bin], (struct box){middle, middle});
        bins->counts[bin]++;
    }
}

static void add_bins(struct bins *to, const struct bins *from)
{
    for (int i = 0; i < to->count; i++) {
        to->boxes[i] = around(to->boxes[i], from->boxes[i]);
        to->middles[i] = around(to->middles[i], from->middles[i]);
        to->counts[i] += from->counts[i];
    }
}

// The bins along the longest side of the box of middles. False: the middles are the same.
static bool choose_axis(const struct range *r, struct split *s)
{
    num size = r->middles.high - r->middles.low;
    s->axis = lane(size, 0) >= lane(size, 1) ? 0 : 1;
    s->axis = lane(size, s->axis) >= lane(size, 2) ? s->axis : 2;
    float length = lane(size, s->axis);
    s->start = lane(r->middles.low, s->axis);
    s->bins = r->count > FEW ? BINS : FEW_BINS;
    s->factor = length > 1e-30f ? (float)s->bins * 0.99999f / length : 0;
    return length > 1e-30f;
}

// The cheapest boundary between bins; returns its cost.
static float choose_bin(const struct bins *bins, struct split *s)
{
    float right_cost[BINS];
    struct box box = empty_box();
    uint32_t count = 0;
    for (int i = bins->count - 1; i > 0; i--) {
        box = around(box, bins->boxes[i]);
        count += bins->counts[i];
        right_cost[i] = count ? half_area(box) * (float)count : 0;
    }
    float best = 3e38f;
    uint32_t all = count + bins->counts[0];
    box = empty_box();
    count = 0;
    s->bin = 0;
    for (int i = 1; i < bins->count; i++) {
        box = around(box, bins->boxes[i - 1]);
        count += bins->counts[i - 1];
        if (!count || count == all)
            continue;
        float cost = half_area(box) * (float)count + right_cost[i];
        if (!s->bin || cost < best) {
            best = cost;
            s->bin = i;
        }
    }
    return best;
}

static uint32_t sides_of(const struct bins *bins, int bin, struct box boxes[2], struct box middles[2])
{
    uint32_t left = 0;
    boxes[0] = boxes[1] = middles[0] = middles[1] = empty_box();
    for (int i = 0; i < bins->count; i++) {
        boxes[i >= bin] = around(boxes[i >= bin], bins->boxes[i]);
        middles[i >= bin] = around(middles[i >= bin], bins->middles[i]);
        left += i < bin ? bins->counts[i] : 0;
    }
    return left;
}

// --- small ranges

static void partition(struct primitive *p, uint32_t count, const struct split *s)
{
    uint32_t low = 0, high = count;
    for (;;) {
        while (low < high && bin_of(s, &p[low]) < s->bin)
            low++;
        while (low < high && bin_of(s, &p[high - 1]) >= s->bin)
            high--;
        if (low >= high)
            return;
        struct primitive kept = p[low];
        p[low++] = p[--high];
        p[high] = kept;
    }
}

// Compared by twice the middle along one axis, then by number.
static int compare_along(const void *a, const void *b, int axis)
{
    const struct primitive *p = a, *q = b;
    float x = p->low[axis] + p->high[axis], y = q->low[axis] + q->high[axis];
    if (x != y)
        return x < y ? -1 : 1;
    return primitive_number(p) < primitive_number(q) ? -1 : 1;
}
static int along_x(const void *a, const void *b) { return compare_along(a, b, 0); }
static int along_y(const void *a, const void *b) { return compare_along(a, b, 1); }
static int along_z(const void *a, const void *b) { return compare_along(a, b, 2); }

// Where bins have divided again and again, and always unevenly: divides in the middle, so that the depth is bounded, at the
// nearest place between two different middles.
static uint32_t divide_evenly(struct primitive *p, uint32_t count, int axis)
{
    static int (*const along[3])(const void *, const void *) = {along_x, along_y, along_z};
    qsort(p, count, sizeof *p, along[axis]);
    for (uint32_t apart = 0; apart <= count; apart++)
        for (int side = -1; side <= 1; side += 2) {
            int64_t at = (int64_t)(count / 2) + side * (int64_t)apart;
            if (at >= 1 && at < count &&
                p[at - 1].low[axis] + p[at - 1].high[axis] < p[at].low[axis] + p[at].high[axis])
                return (uint32_t)at;
        }
    return count / 2; // not reached: the middles differ
}

// A triangle with its corners in ascending order.
struct sorted_triangle {
    double p[3][3];
    uint32_t number;
    struct primitive primitive;
};

static int compare_points(const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

static int compare_sorted(const void *a, const void *b)
{
    const struct sorted_triangle *s = a, *t = b;
    for (int k = 0; k < 3; k++) {
        int order = compare_points(s->p[k], t->p[k]);
        if (order)
            return order;
    }
    return s->number < t->number ? -1 : s->number > t->number;
}

static void sort_corners(double p[3][3])
{
    for (int step = 0; step < 3; step++) {
        int k = step & 1;
        if (compare_points(p[k], p[k + 1]) > 0)
            for (int i = 0; i < 3; i++) {
                double kept = p[k][i];
                p[k][i] = p[k + 1][i];
                p[k + 1][i] = kept;
            }
    }
}

// Puts the leaves of a group in order: any halves will do.
static void halve(struct builder *b, const struct range *r)
{
    if (r->count <= LEAF_MAX) {
        make_leaf(b, r, true);
        return;
    }
    struct range halves[2];
    make_ordered_node(b, r, r->count / 2, halves);
    halve(b, &halves[0]);
    halve(b, &halves[1]);
}

// More triangles than a leaf holds, all with the same middle.
static void divide_group(struct builder *b, const struct range *r)
{
    struct primitive *p = b->primitives[r->buffer] + r->first;
    size_t bytes = r->count * sizeof(struct sorted_triangle);
    struct sorted_triangle *sorted = aligned_alloc(64, (bytes + 63) & ~(size_t)63);
    if (!sorted) {
        no_memory(&b->loop);
        return;
    }
    for (uint32_t i = 0; i < r->count; i++) {
        sorted[i].number = primitive_number(&p[i]);
        sorted[i].primitive = p[i];
        memcpy(sorted[i].p, b->prepared[sorted[i].number].p, sizeof sorted[i].p);
        sort_corners(sorted[i].p);
    }
    qsort(sorted, r->count, sizeof *sorted, compare_sorted);
    for (uint32_t i = 0; i < r->count; i++) {
        bool twin = i > 0;
        for (int k = 0; k < 3 && twin; k++)
            twin = same_point(sorted[i].p[k], sorted[i - 1].p[k]);
        b->twins[sorted[i].number] = twin ? b->twins[sorted[i - 1].number] : sorted[i].number;
        p[i] = sorted[i].primitive;
    }
    free(sorted);
    halve(b, r);
}

static void divide(struct builder *b, const struct range *r)
{
    struct primitive *p = b->primitives[r->buffer] + r->first;
    struct split split;
    struct range sides[2];
    if (r->count <= LEAF_MIN) {
        make_leaf(b, r, false);
        return;
    }
    if (!choose_axis(r, &split)) {
        if (r->count <= LEAF_MAX)
            make_leaf(b, r, false);
        else
            divide_group(b, r);
        return;
    }
    if (r->depth >= BALANCED_AT) {
        if (r->count <= LEAF_MAX) {
            make_leaf(b, r, false);
            return;
        }
        make_ordered_node(b, r, divide_evenly(p, r->count, split.axis), sides);
    } else {
        struct bins bins;
        struct box boxes[2], middles[2];
        clear_bins(&bins, split.bins);
        fill_bins(&bins, &split, p, r->count);
        float cost = choose_bin(&bins, &split), area = half_area(r->box);
        if (r->count <= LEAF_MAX && TRIANGLE_WORK * area * (float)r->count <= area + TRIANGLE_WORK * cost) {
            make_leaf(b, r, false);
            return;
        }
        partition(p, r->count, &split);
        uint32_t left = sides_of(&bins, split.bin, boxes, middles);
        make_node(b, r, left, boxes, middles, sides);
    }
    if (r->count > 512 && !should_continue(&b->loop))
        return;
    divide(b, &sides[0]);
    divide(b, &sides[1]);
}

// --- large ranges

struct large {
    struct builder *builder;
    const struct range *range;
    struct split split;
    struct bins *bins;   // of each piece
    uint32_t *to;        // of each piece: where its primitives go, left and right
    struct range *small; // ranges that are left
    size_t small_count;
};

static void bins_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    const struct range *r = l->range;
    uint32_t first = (uint32_t)index * RAY_PIECE, count = r->count - first < RAY_PIECE ? r->count - first : RAY_PIECE;
    clear_bins(&l->bins[index], l->split.bins);
    fill_bins(&l->bins[index], &l->split, l->builder->primitives[r->buffer] + r->first + first, count);
}

static void move_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    const struct range *r = l->range;
    uint32_t first = (uint32_t)index * RAY_PIECE, count = r->count - first < RAY_PIECE ? r->count - first : RAY_PIECE;
    const struct primitive *from = l->builder->primitives[r->buffer] + r->first + first;
    struct primitive *to = l->builder->primitives[!r->buffer] + r->first;
    uint32_t at[2] = {l->to[2 * index], l->to[2 * index + 1]};
    for (uint32_t i = 0; i < count; i++)
        to[at[bin_of(&l->split, &from[i]) >= l->split.bin]++] = from[i];
}

// Divides a range down to small ones.
static void divide_large(struct large *l, const struct range *r)
{
    struct builder *b = l->builder;
    size_t pieces = ((size_t)r->count + RAY_PIECE - 1) / RAY_PIECE;
    l->range = r;
    if (r->count <= SMALL || r->depth >= BALANCED_AT || !choose_axis(r, &l->split)) {
        l->small[l->small_count++] = *r;
        return;
    }
    pool_run(b->pool, pieces, bins_task, l);
    struct bins all;
    clear_bins(&all, l->split.bins);
    for (size_t i = 0; i < pieces; i++)
        add_bins(&all, &l->bins[i]);
    choose_bin(&all, &l->split);
    struct box boxes[2], middles[2];
    uint32_t left = sides_of(&all, l->split.bin, boxes, middles), at[2] = {0, left};
    for (size_t i = 0; i < pieces; i++) {
        l->to[2 * i] = at[0];
        l->to[2 * i + 1] = at[1];
        for (int n = 0; n < all.count; n++)
            at[n >= l->split.bin] += l->bins[i].counts[n];
    }
    pool_run(b->pool, pieces, move_task, l);
    struct range moved = *r, sides[2];
    moved.buffer = !r->buffer;
    make_node(b, &moved, left, boxes, middles, sides);
    if (!should_continue(&b->loop))
        return;
    divide_large(l, &sides[0]);
    divide_large(l, &sides[1]);
}

static void small_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    if (should_continue(&l->builder->loop))
        divide(l->builder, &l->small[index]);
}

bool ray_nodes_build(struct builder *b, lam_error *error)
{
    uint32_t count = b->frame->triangle_count, root = 0, root_count = 0;
    size_t pieces = ((size_t)count + RAY_PIECE - 1) / RAY_PIECE;
    // A range that is divided has more than SMALL triangles, and those at one depth have none in common.
    size_t smalls = 2 + (size_t)BALANCED_AT * (count / SMALL);
    struct large l = {.builder = b};
    l.bins = aligned_alloc(64, (pieces * sizeof *l.bins + 127) & ~(size_t)63);
    l.to = malloc((2 * pieces + 1) * sizeof *l.to);
    l.small = aligned_alloc(64, (smalls * sizeof *l.small + 63) & ~(size_t)63);
    bool ok = l.bins && l.to && l.small;
    if (ok) {
        struct range all = {.count = count, .child = &root, .child_count = &root_count};
        all.box = box_of_all(b->primitives[0], count);
        all.middles = middles_of(b->primitives[0], count);
        divide_large(&l, &all);
        pool_run(b->pool, l.small_count, small_task, &l);
    } else {
        no_memory(&b->loop);
    }
    free(l.bins);
    free(l.to);
    free(l.small);
    if (!should_continue(&b->loop))
        return loop_error(&b->loop, pieces * sizeof *l.bins, error);
    if (root_count) { // a leaf alone: beside it one of a triangle that no ray meets
        struct box box = box_of_all(b->primitives[0], count);
        b->triangles[count] = (struct ray_triangle){.number = count, .twin = count};
        b->nodes[0] = (struct ray_node){.child = {root, count}, .count = {root_count, 1}};
        set_box(&b->nodes[0], 0, box);
        set_box(&b->nodes[0], 1, box);
    }
    return true;
}
