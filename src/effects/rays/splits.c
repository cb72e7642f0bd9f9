// splits.c: divides the triangles of a range into the nodes of a hierarchy.
#include "ray_triangles.h"
#include "ranges.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

enum {
    LEAF_MIN = 3,   // ranges of up to this many triangles are not divided
    MIDDLE_MAX = 16 // ranges of up to this many triangles are divided in the middle; at least LEAF_MAX
};

// The cost of a triangle of a leaf, relative to visiting the leaf: all triangles are tested at once.
#define TRIANGLE_WORK 0.25f

// The memory for dividing one range. Positions are counted from the first triangle of the range.
struct division {
    struct builder *builder;
    const struct range *range;
    struct primitive *primitives; // low[3] contains the position in `corners`
    float (*corners)[9];
    struct ray_node *nodes;
    uint32_t node_count;
};

static bool charge(struct builder *b, size_t bytes) { return !b->loop.call || call_charge(b->loop.call, bytes); }

static void refund(struct builder *b, size_t bytes)
{
    if (b->loop.call)
        call_refund(b->loop.call, bytes);
}

static uint32_t number_of(const struct division *d, const struct primitive *p)
{
    return d->builder->numbers[d->range->first + primitive_number(p)];
}

// --- leaves

static bool same_point(const double a[3], const double b[3]) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

// Returns whether two triangles have the same three positions, in any order.
static bool same_positions(const struct ray_triangle *a, const struct ray_triangle *b)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int i = 0; i < 6; i++)
        if (same_point(a->p[0], b->p[orders[i][0]]) && same_point(a->p[1], b->p[orders[i][1]]) &&
            same_point(a->p[2], b->p[orders[i][2]]))
            return true;
    return false;
}

static bool same_box(const struct primitive *p, const struct primitive *q)
{
    struct box a = box_of(p), b = box_of(q);
    return (mask_bits((a.low == b.low) & (a.high == b.high)) & 7) == 7;
}

// Finds the twins of a leaf. Triangles with the same positions have the same box, and are therefore in the same leaf or
// in the same group. sort_group has already found the twins in groups.
static void find_twins(const struct division *d, const struct primitive *p, uint32_t count)
{
    const struct hierarchy *h = d->builder->hierarchy;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < count; j++) {
            uint32_t *twin = &d->builder->twins[number_of(d, &p[i])], other = number_of(d, &p[j]);
            struct ray_triangle a, b;
            if (other >= *twin || !same_box(&p[i], &p[j]))
                continue;
            hierarchy_triangle(h, number_of(d, &p[i]), &a);
            hierarchy_triangle(h, other, &b);
            if (same_positions(&a, &b)) {
                *twin = other;
                __atomic_store_n(&d->builder->has_twins, true, __ATOMIC_RELAXED);
            }
        }
}

static void make_leaf(const struct division *d, const struct range *r, uint32_t *child, uint32_t *child_count)
{
    const struct primitive *p = d->primitives + r->first;
    *child = d->range->first + r->first;
    *child_count = r->count;
    float *leaf = d->builder->leaves + (size_t)LEAF_FLOATS * *child;
    for (uint32_t i = 0; i < r->count; i++) {
        const float *from = d->corners[primitive_number(&p[i])];
        for (uint32_t row = 0; row < LEAF_FLOATS - 1; row++)
            leaf[row * r->count + i] = from[row];
        uint32_t number = number_of(d, &p[i]);
        memcpy(&leaf[(LEAF_FLOATS - 1) * r->count + i], &number, sizeof number);
    }
    if (!r->sorted)
        find_twins(d, p, r->count);
}

// --- nodes

void range_set_planes(struct ray_node *node, const struct range *parts, int count)
{
    *node = (struct ray_node){0};
    for (int i = 0; i < NODE_CHILDREN; i++) {
        struct box box = i < count ? parts[i].box : empty_box();
        for (int axis = 0; axis < 3; axis++) {
            node->planes[0][axis][i] = lane(box.low, axis);
            node->planes[1][axis][i] = lane(box.high, axis);
        }
    }
}

// --- halves

void range_measure(const struct primitive *p, uint32_t count, struct box *box, struct box *middles)
{
    *box = *middles = empty_box();
    for (uint32_t i = 0; i < count; i++) {
        *box = around(*box, box_of(&p[i]));
        *middles = around(*middles, (struct box){middle_of(&p[i]), middle_of(&p[i])});
    }
}

// Divides a range whose primitives are in order.
static void divide_at(const struct division *d, struct range *r, uint32_t left, struct range *right)
{
    const struct primitive *p = d->primitives + r->first;
    struct box boxes[2], middles[2];
    range_measure(p, left, &boxes[0], &middles[0]);
    range_measure(p + left, r->count - left, &boxes[1], &middles[1]);
    halves_of(r, left, boxes, middles, right);
}

// Compares two primitives by twice their centres along one axis, then by number.
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

// Divides a range in the middle if bins have repeatedly produced uneven parts, so that the depth is bounded. The range
// is divided between two different centres, as near to its middle as possible.
static uint32_t divide_evenly(struct primitive *p, uint32_t count, int axis)
{
    static int (*const along[3])(const void *, const void *) = {along_x, along_y, along_z};
    qsort(p, count, sizeof *p, along[axis]);
    for (uint32_t distance = 0; distance <= count; distance++)
        for (int side = -1; side <= 1; side += 2) {
            int64_t at = (int64_t)(count / 2) + side * (int64_t)distance;
            if (at >= 1 && at < count &&
                p[at - 1].low[axis] + p[at - 1].high[axis] < p[at].low[axis] + p[at].high[axis])
                return (uint32_t)at;
        }
    return count / 2; // unreachable: the centres differ
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

// Sorts the triangles of a range, and finds twins. All triangles have the same centre, and a leaf cannot contain all of
// them. The range can then be divided at any position.
static bool sort_group(const struct division *d, const struct range *r)
{
    struct builder *b = d->builder;
    struct primitive *p = d->primitives + r->first;
    size_t bytes = (r->count * sizeof(struct sorted_triangle) + 63) & ~(size_t)63;
    bool counted = charge(b, bytes);
    struct sorted_triangle *sorted = counted ? aligned_alloc(64, bytes) : NULL;
    if (!sorted) {
        refund(b, counted ? bytes : 0);
        no_memory(&b->loop);
        return false;
    }
    for (uint32_t i = 0; i < r->count; i++) {
        struct ray_triangle triangle;
        hierarchy_triangle(b->hierarchy, number_of(d, &p[i]), &triangle);
        sorted[i].number = triangle.number;
        sorted[i].primitive = p[i];
        memcpy(sorted[i].p, triangle.p, sizeof triangle.p);
        sort_corners(sorted[i].p);
    }
    qsort(sorted, r->count, sizeof *sorted, compare_sorted);
    for (uint32_t i = 0; i < r->count; i++) {
        bool twin = i > 0;
        for (int k = 0; k < 3 && twin; k++)
            twin = same_point(sorted[i].p[k], sorted[i - 1].p[k]);
        b->twins[sorted[i].number] = twin ? b->twins[sorted[i - 1].number] : sorted[i].number;
        if (twin)
            __atomic_store_n(&b->has_twins, true, __ATOMIC_RELAXED);
        p[i] = sorted[i].primitive;
    }
    free(sorted);
    refund(b, bytes);
    return true;
}

// Divides a range of few triangles at the midpoint between the outermost centres. The best of many boundaries would
// hardly be better, but takes much longer to find. Returns false if the range becomes a leaf.
static bool halve_few(struct primitive *p, struct range *r, int axis, struct range *right)
{
    struct primitive sorted[MIDDLE_MAX];
    float low = lane(r->middles.low, axis), high = lane(r->middles.high, axis), middle = 0.5f * low + 0.5f * high;
    float boundary = middle > low ? middle : high; // both sides contain triangles
    uint32_t left = 0, end = r->count;
    for (uint32_t i = 0; i < r->count; i++) { // branchless: each primitive is written to the front and to the back, and
                                              // one of the two copies is kept
        bool on_left = p[i].low[axis] + p[i].high[axis] < boundary;
        sorted[left] = sorted[end - 1] = p[i];
        left += on_left;
        end -= !on_left;
    }
    struct box boxes[2], middles[2];
    range_measure(sorted, left, &boxes[0], &middles[0]);
    range_measure(sorted + left, r->count - left, &boxes[1], &middles[1]);
    float cost = half_area(boxes[0]) * (float)left + half_area(boxes[1]) * (float)(r->count - left);
    float leaves = half_area(boxes[0]) + half_area(boxes[1]);
    if (r->count <= LEAF_MAX && r->area + TRIANGLE_WORK * r->area * (float)r->count <= leaves + TRIANGLE_WORK * cost)
        return false;
    memcpy(p, sorted, r->count * sizeof *p);
    halves_of(r, left, boxes, middles, right);
    return true;
}

// Divides a range: reduces `r` to the left half, and sets *right to the right half. Returns false if the range becomes a
// leaf, or if memory runs out.
static bool halve(const struct division *d, struct range *r, struct range *right)
{
    struct primitive *p = d->primitives + r->first;
    struct split split;
    if (r->count <= LEAF_MIN)
        return false;
    if (r->sorted || !choose_axis(r, &split)) {
        if (r->count <= LEAF_MAX || (!r->sorted && !sort_group(d, r)))
            return false;
        r->sorted = true;
        divide_at(d, r, r->count / 2, right);
        return true;
    }
    if (r->depth >= BALANCED_AT) {
        if (r->count <= LEAF_MAX)
            return false;
        divide_at(d, r, divide_evenly(p, r->count, split.axis), right);
        return true;
    }
    if (r->count <= MIDDLE_MAX)
        return halve_few(p, r, split.axis, right);
    struct bins bins;
    struct box boxes[2], middles[2];
    clear_bins(&bins, split.bins);
    fill_bins(&bins, &split, p, r->count);
    choose_bin(&bins, &split);
    partition(p, r->count, &split);
    halves_of(r, sides_of(&bins, split.bin, boxes, middles), boxes, middles, right);
    return true;
}

// Makes the node of a range that is larger than a leaf, or of the root. Returns its index.
static uint32_t divide(struct division *d, const struct range *r)
{
    struct range parts[NODE_CHILDREN] = {*r};
    bool open[NODE_CHILDREN] = {true};
    int count = 1, i;
    uint32_t index = d->node_count++;
    while (count < NODE_CHILDREN && (i = widest_part(parts, open, count, r->count > FEW ? 0 : LEAF_MAX)) >= 0) {
        open[i] = halve(d, &parts[i], &parts[count]);
        if (open[i])
            open[count++] = true;
    }
    range_set_planes(&d->nodes[index], parts, r->count ? count : 0);
    if ((r->count > 512 && !should_continue(&d->builder->loop)) || (count == 1 && r->count > LEAF_MAX))
        return index; // cancelled, or no memory to divide the range
    for (i = 0; i < count && r->count; i++) {
        struct ray_node *node = &d->nodes[index];
        if (parts[i].count > LEAF_MAX)
            node->child[i] = divide(d, &parts[i]);
        else
            make_leaf(d, &parts[i], &node->child[i], &node->count[i]);
    }
    return index;
}

// Fills the primitives and corners.
static void measure(struct division *d)
{
    struct placement place = {0};
    for (uint32_t i = 0; i < d->range->count; i++) {
        struct point p[3];
        float corner[4];
        ray_space_corners(d->builder, d->builder->numbers[d->range->first + i], &place, p);
        store_box(&d->primitives[i], p);
        primitive_note(&d->primitives[i], i, 1);
        for (int k = 0; k < 3; k++) {
            store_floats(corner, p[k].xy, p[k].z);
            memcpy(d->corners[i] + (size_t)3 * (size_t)k, corner, 3 * sizeof *corner);
        }
    }
}

// Returns the largest number of nodes for a range of this many triangles. A node has more than LEAF_MAX triangles. If
// it has fewer than NODE_CHILDREN children, all of them are leaves. By induction, the number of nodes is at most
// (count − 2)/7, except for a root with few triangles.
static size_t nodes_below(uint32_t count) { return 1 + (size_t)count / (NODE_CHILDREN - 1); }

void range_nodes_free(struct builder *b, struct range_nodes *nodes)
{
    if (nodes->list)
        refund(b, nodes->count * sizeof *nodes->list);
    free(nodes->list);
}

bool range_divide(struct builder *b, const struct range *r, struct range_nodes *nodes)
{
    size_t count = r->count, most = nodes_below(r->count);
    size_t bytes = most * sizeof(struct ray_node) + count * (sizeof(struct primitive) + 9 * sizeof(float));
    bytes = (bytes + 63) / 64 * 64;
    if (!charge(b, bytes))
        return false;
    char *memory = aligned_alloc(64, bytes);
    struct range whole = *r;
    struct division d = {.builder = b, .range = r, .nodes = (struct ray_node *)memory};
    bool ok = memory;
    if (memory) {
        d.primitives = (struct primitive *)(d.nodes + most);
        d.corners = (float(*)[9])(d.primitives + count);
        measure(&d);
        whole.first = 0;
        range_measure(d.primitives, r->count, &whole.box, &whole.middles);
        whole.area = half_area(whole.box);
        if (r->count <= LEAF_MAX && r->parent != NO_PARENT) {
            uint32_t child, child_count;
            make_leaf(&d, &whole, &child, &child_count);
        } else {
            divide(&d, &whole);
        }
    }
    size_t kept = d.node_count * sizeof *nodes->list;
    if (ok && kept && (ok = charge(b, kept))) {
        nodes->list = malloc(kept);
        nodes->count = d.node_count;
        if (nodes->list)
            memcpy(nodes->list, d.nodes, kept);
        else
            refund(b, kept);
        ok = nodes->list;
    }
    free(memory);
    refund(b, bytes);
    return ok;
}
