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
    uint32_t node; // the first of node_places(count) nodes that it may use
    int depth, buffer;
    bool sorted;                   // the middles are the same; the primitives lie in the order of sort_group
    struct box box, middles;       // of the triangles; of twice the middles of their boxes
    uint32_t *child, *child_count; // where its node or leaf is entered; NULL: it is the root
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
// (sort_group), which has found them.
static void make_leaf(struct builder *b, const struct range *r)
{
    const struct primitive *p = b->primitives[r->buffer] + r->first;
    for (uint32_t i = 0; i < r->count; i++) {
        struct ray_triangle *t = &b->triangles[r->first + i];
        *t = b->prepared[primitive_number(&p[i])];
        for (uint32_t j = 0; j < r->count && !r->sorted; j++) {
            uint32_t other = primitive_number(&p[j]);
            if (other < t->twin && same_positions(t, &b->prepared[other]))
                t->twin = other;
        }
        if (r->sorted)
            t->twin = b->twins[t->number];
        b->twins[t->number] = t->twin;
    }
    *r->child = r->first;
    *r->child_count = r->count;
}

// --- nodes

// The nodes below a range of so many triangles, at most. A node with fewer than NODE_CHILDREN children has leaves alone, and
// more than LEAF_MIN triangles; hence, by induction, (2 count − 1)/7 — and one more for ranges above SMALL, which are divided in two
// steps.
static uint32_t node_places(uint32_t count)
{
    return count ? (uint32_t)((2 * (uint64_t)count - 1) / 7) + count / SMALL : 0;
}

// Enters the node of a range that was divided into `parts`, and says where theirs go.
static void make_node(struct builder *b, const struct range *r, struct range *parts, int count)
{
    struct ray_node *node = &b->nodes[r->node];
    uint32_t next = r->node + 1;
    if (r->child) {
        *r->child = r->node;
        *r->child_count = 0;
    }
    for (int i = 0; i < NODE_CHILDREN; i++) {
        struct box box = i < count ? parts[i].box : empty_box();
        for (int axis = 0; axis < 3; axis++) {
            node->planes[0][axis][i] = lane(box.low, axis);
            node->planes[1][axis][i] = lane(box.high, axis);
        }
        node->child[i] = node->count[i] = 0;
        if (i >= count)
            continue;
        parts[i].node = next;
        parts[i].child = &node->child[i];
        parts[i].child_count = &node->count[i];
        next += node_places(parts[i].count);
    }
}

static void halves_of(const struct range *r, uint32_t left, const struct box boxes[2], const struct box middles[2],
                      struct range out[2])
{
    for (int i = 0; i < 2; i++) {
        out[i] = *r;
        out[i].first = i ? r->first + left : r->first;
        out[i].count = i ? r->count - left : left;
        out[i].depth = r->depth + 1;
        out[i].box = boxes[i];
        out[i].middles = middles[i];
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

// Divides a range whose primitives are in order.
static void divide_at(struct builder *b, const struct range *r, uint32_t left, struct range out[2])
{
    const struct primitive *p = b->primitives[r->buffer] + r->first;
    struct box boxes[2] = {box_of_all(p, left), box_of_all(p + left, r->count - left)};
    struct box middles[2] = {middles_of(p, left), middles_of(p + left, r->count - left)};
    halves_of(r, left, boxes, middles, out);
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

// More triangles than a leaf holds, all with the same middle: sorts them, and finds twins. Any halves will do then.
static bool sort_group(struct builder *b, const struct range *r)
{
    struct primitive *p = b->primitives[r->buffer] + r->first;
    size_t bytes = r->count * sizeof(struct sorted_triangle);
    struct sorted_triangle *sorted = aligned_alloc(64, (bytes + 63) & ~(size_t)63);
    if (!sorted) {
        no_memory(&b->loop);
        return false;
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
    return true;
}

// Divides a range in two. False: it is to be a leaf.
static bool divide_range(struct builder *b, struct range *r, struct range out[2])
{
    struct primitive *p = b->primitives[r->buffer] + r->first;
    struct split split;
    if (r->count <= LEAF_MIN)
        return false;
    if (r->sorted || !choose_axis(r, &split)) {
        if (r->count <= LEAF_MAX || (!r->sorted && !sort_group(b, r)))
            return false;
        r->sorted = true;
        divide_at(b, r, r->count / 2, out);
        return true;
    }
    if (r->depth >= BALANCED_AT) {
        if (r->count <= LEAF_MAX)
            return false;
        divide_at(b, r, divide_evenly(p, r->count, split.axis), out);
        return true;
    }
    struct bins bins;
    struct box boxes[2], middles[2];
    clear_bins(&bins, split.bins);
    fill_bins(&bins, &split, p, r->count);
    float cost = choose_bin(&bins, &split), area = half_area(r->box);
    if (r->count <= LEAF_MAX && TRIANGLE_WORK * area * (float)r->count <= area + TRIANGLE_WORK * cost)
        return false;
    partition(p, r->count, &split);
    halves_of(r, sides_of(&bins, split.bin, boxes, middles), boxes, middles, out);
    return true;
}

// The part with the largest box of those that are `open` to be divided; −1: none is.
static int widest_part(const struct range *parts, const bool *open, int count)
{
    int widest = -1;
    float most = -1;
    for (int i = 0; i < count; i++)
        if (open[i] && half_area(parts[i].box) > most) {
            most = half_area(parts[i].box);
            widest = i;
        }
    return widest;
}

// Makes the nodes of a range, or a leaf where it is not divided. The root is a node always.
static void divide(struct builder *b, const struct range *r)
{
    struct range parts[NODE_CHILDREN], two[2];
    bool open[NODE_CHILDREN] = {true};
    int count = 1, i;
    parts[0] = *r;
    while (count < NODE_CHILDREN && (i = widest_part(parts, open, count)) >= 0) {
        open[i] = divide_range(b, &parts[i], two);
        if (!open[i])
            continue;
        parts[i] = two[0];
        parts[count] = two[1];
        open[count++] = true;
    }
    if (r->count > 512 && !should_continue(&b->loop))
        return;
    if (count == 1 && r->child) {
        make_leaf(b, &parts[0]);
        return;
    }
    make_node(b, r, parts, count);
    for (i = 0; i < count; i++)
        if (open[i])
            divide(b, &parts[i]);
        else
            make_leaf(b, &parts[i]);
}

// --- large ranges

struct large {
    struct builder *builder;
    const struct range *range;
    struct split split;
    struct bins *bins;   // of each piece
    uint32_t *to;        // of each piece: where its primitives go, left and right
    struct range *small; // ranges that are left
    size_t small_count, small_capacity;
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

// As divide_range.
static bool divide_large_range(struct large *l, struct range *r, struct range out[2])
{
    struct builder *b = l->builder;
    size_t pieces = ((size_t)r->count + RAY_PIECE - 1) / RAY_PIECE;
    if (r->depth >= BALANCED_AT || r->sorted || !choose_axis(r, &l->split))
        return divide_range(b, r, out);
    l->range = r;
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
    r->buffer = !r->buffer;
    halves_of(r, left, boxes, middles, out);
    return true;
}

static void add_small(struct large *l, const struct range *r)
{
    if (l->small_count == l->small_capacity) {
        size_t capacity = l->small_capacity ? 2 * l->small_capacity : 64;
        struct range *grown = aligned_alloc(64, (capacity * sizeof *grown + 63) & ~(size_t)63);
        if (!grown) {
            no_memory(&l->builder->loop);
            return;
        }
        if (l->small_count)
            memcpy(grown, l->small, l->small_count * sizeof *grown);
        free(l->small);
        l->small = grown;
        l->small_capacity = capacity;
    }
    l->small[l->small_count++] = *r;
}

// Divides a range down to small ones.
static void divide_large(struct large *l, const struct range *r)
{
    struct range parts[NODE_CHILDREN] = {*r}, two[2];
    bool open[NODE_CHILDREN] = {r->count > SMALL};
    int count = 1, i;
    if (!should_continue(&l->builder->loop))
        return;
    while (count < NODE_CHILDREN && (i = widest_part(parts, open, count)) >= 0) {
        open[i] = divide_large_range(l, &parts[i], two);
        if (!open[i]) // no memory
            return;
        parts[i] = two[0];
        parts[count] = two[1];
        open[i] = two[0].count > SMALL;
        open[count++] = two[1].count > SMALL;
    }
    if (count == 1) {
        add_small(l, r);
        return;
    }
    make_node(l->builder, r, parts, count);
    for (i = 0; i < count; i++)
        if (open[i])
            divide_large(l, &parts[i]);
        else
            add_small(l, &parts[i]);
}

static void small_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    if (should_continue(&l->builder->loop))
        divide(l->builder, &l->small[index]);
}

uint32_t ray_nodes_max(uint32_t triangle_count) { return 1 + node_places(triangle_count); }

bool ray_nodes_build(struct builder *b, lam_error *error)
{
    uint32_t count = b->frame->triangle_count;
    size_t pieces = ((size_t)count + RAY_PIECE - 1) / RAY_PIECE;
    struct large l = {.builder = b};
    l.bins = aligned_alloc(64, (pieces * sizeof *l.bins + 127) & ~(size_t)63);
    l.to = malloc((2 * pieces + 1) * sizeof *l.to);
    bool ok = l.bins && l.to;
    if (ok) {
        struct range all = {.count = count};
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
    return true;
}
