// splits.c: divides the triangles of a range into the nodes of a hierarchy.
#include "ray_triangles.h"
#include "ranges.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

enum {
    LEAF_MAX = 8,   // triangles
    LEAF_MIN = 3,   // ranges of up to this many triangles are not divided
    MIDDLE_MAX = 12 // ranges of up to this many triangles are divided in the middle; at least LEAF_MAX
};

// The cost of testing a triangle, relative to visiting a node.
#define TRIANGLE_WORK 1.0f

// --- leaves

static void ray_triangle_fill(const struct builder *b, uint32_t number, struct placement *place, double p[3][3])
{
    struct point corners[3];
    ray_space_corners(b, number, place, corners);
    for (int k = 0; k < 3; k++)
        store_point(corners[k], p[k]);
}

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

// Makes a leaf. Triangles with the same positions have the same box, and are therefore in the same leaf or in the same
// group. sort_group has already found the twins in groups.
static void make_leaf(struct builder *b, const struct range *r, struct placement *place)
{
    const struct primitive *p = b->primitives + r->first;
    struct ray_triangle *triangles = b->triangles + r->first;
    for (uint32_t i = 0; i < r->count; i++) {
        struct ray_triangle *t = &triangles[i];
        uint32_t number = primitive_number(&p[i]);
        ray_triangle_fill(b, number, place, t->p);
        t->number = number;
        t->twin = r->sorted ? b->twins[number] : number;
    }
    for (uint32_t i = 0; i < r->count && !r->sorted; i++)
        for (uint32_t j = 0; j < r->count; j++)
            if (triangles[j].number < triangles[i].twin && same_box(&p[i], &p[j]) &&
                same_positions(&triangles[i], &triangles[j]))
                triangles[i].twin = triangles[j].number;
    for (uint32_t i = 0; i < r->count; i++)
        b->twins[triangles[i].number] = triangles[i].twin;
    *r->child = r->first;
    *r->child_count = r->count;
}

// --- nodes

// Stores the node of a range that was divided into `parts`, and sets the addresses at which the parts store their
// nodes.
void range_enter_node(struct builder *b, const struct range *r, struct range *parts, int count)
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
        next += ray_nodes_below(parts[i].count);
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
static void divide_at(struct builder *b, struct range *r, uint32_t left, struct range *right)
{
    const struct primitive *p = b->primitives + r->first;
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
static bool sort_group(struct builder *b, const struct range *r)
{
    struct placement place = {0};
    struct primitive *p = b->primitives + r->first;
    struct call_control *call = b->loop.call;
    size_t bytes = (r->count * sizeof(struct sorted_triangle) + 63) & ~(size_t)63;
    bool counted = !call || call_charge(call, bytes);
    struct sorted_triangle *sorted = counted ? aligned_alloc(64, bytes) : NULL;
    if (!sorted) {
        if (call && counted)
            call_refund(call, bytes);
        no_memory(&b->loop);
        return false;
    }
    for (uint32_t i = 0; i < r->count; i++) {
        sorted[i].number = primitive_number(&p[i]);
        sorted[i].primitive = p[i];
        ray_triangle_fill(b, sorted[i].number, &place, sorted[i].p);
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
    if (call)
        call_refund(call, bytes);
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
    if (r->count <= LEAF_MAX && TRIANGLE_WORK * r->area * (float)r->count <= r->area + TRIANGLE_WORK * cost)
        return false;
    memcpy(p, sorted, r->count * sizeof *p);
    halves_of(r, left, boxes, middles, right);
    return true;
}

bool range_halve(struct builder *b, struct range *r, struct range *right)
{
    struct primitive *p = b->primitives + r->first;
    struct split split;
    if (r->count <= LEAF_MIN)
        return false;
    if (r->sorted || !choose_axis(r, &split)) {
        if (r->count <= LEAF_MAX || (!r->sorted && !sort_group(b, r)))
            return false;
        r->sorted = true;
        divide_at(b, r, r->count / 2, right);
        return true;
    }
    if (r->depth >= BALANCED_AT) {
        if (r->count <= LEAF_MAX)
            return false;
        divide_at(b, r, divide_evenly(p, r->count, split.axis), right);
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

// Makes the nodes of a range, or a leaf if the range is not divided. The root is always a node.
static void divide(struct builder *b, const struct range *r, struct placement *place)
{
    struct range parts[NODE_CHILDREN];
    bool open[NODE_CHILDREN] = {true};
    int count = 1, i;
    parts[0] = *r;
    while (count < NODE_CHILDREN && (i = widest_part(parts, open, count)) >= 0) {
        open[i] = range_halve(b, &parts[i], &parts[count]);
        if (open[i])
            open[count++] = true;
    }
    if (r->count > 512 && !should_continue(&b->loop))
        return;
    if (count == 1 && r->child) {
        make_leaf(b, &parts[0], place);
        return;
    }
    range_enter_node(b, r, parts, count);
    for (i = 0; i < count; i++)
        if (open[i])
            divide(b, &parts[i], place);
        else
            make_leaf(b, &parts[i], place);
}

void range_divide(struct builder *b, const struct range *r)
{
    struct placement place = {0};
    divide(b, r, &place);
}
