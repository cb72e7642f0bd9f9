// ranges.h: ranges of primitives, which become the nodes of a hierarchy, and the bins that determine how a range is
// divided.
//
// The surface area heuristic (MacDonald and Booth, 1990) with the candidates of Wald, "On fast construction of
// SAH-based bounding volume hierarchies", 2007. A range's primitives are sorted into bins by the centres of their
// boxes, and the range is divided at the boundary between two bins with the smallest
//    area(left) count(left) + area(right) count(right)
#ifndef RANGES_H
#define RANGES_H

#ifndef LANES
#define LANES 4
#endif
#include "lanes.h"

#include "builder.h"

enum {
    BINS = 16,
    FEW_BINS = 8, // the number of bins for ranges of up to FEW triangles
    FEW = 64,
    BALANCED_AT = 48 // from this depth on, ranges are divided in the middle
};

// Four floats; the last is unused.
struct box {
    num low, high;
};

static inline struct box empty_box(void) { return (struct box){num_of(3e38f), num_of(-3e38f)}; }

static inline struct box around(struct box a, struct box b)
{
    return (struct box){min_of(a.low, b.low), max_of(a.high, b.high)};
}

static inline struct box box_of(const struct primitive *p) { return (struct box){num_load(p->low), num_load(p->high)}; }

// Returns twice the centre of a triangle's box.
static inline num middle_of(const struct primitive *p) { return num_load(p->low) + num_load(p->high); }

static inline float half_area(struct box b)
{
    num d = b.high - b.low;
    return lane(d, 0) * lane(d, 1) + lane(d, 1) * lane(d, 2) + lane(d, 2) * lane(d, 0);
}

// A range of primitives that becomes nodes.
struct range {
    uint32_t first, count; // triangles
    int depth;
    bool sorted;                     // whether all centres are equal, and the primitives are in the order of sort_group
    uint32_t first_cell, cell_count; // the cells that contain the triangles (cells.c)
    struct box box, middles;         // the box of the primitives or cells, and the box of twice their centres
    float area;                      // half of the box's surface area
    uint32_t parent, slot;           // the node that contains the range as a child, or NO_PARENT (cells.c)
};
#define NO_PARENT 0xffffffffu

// Reduces a range to its first `left` triangles, and sets *right to the rest.
static inline void halves_of(struct range *r, uint32_t left, const struct box boxes[2], const struct box middles[2],
                             struct range *right)
{
    r->depth++;
    *right = *r;
    right->first += left;
    right->count -= left;
    right->box = boxes[1];
    right->middles = middles[1];
    right->area = half_area(boxes[1]);
    r->count = left;
    r->box = boxes[0];
    r->middles = middles[0];
    r->area = half_area(boxes[0]);
}

// Returns the part with the largest box among the parts that `open` marks as divisible, or −1 if there is none.
static inline int widest_part(const struct range *parts, const bool *open, int count, uint32_t first)
{
    int widest = -1;
    float most = -1;
    for (int pass = 0; pass < 2 && widest < 0; pass++, first = 0)
        for (int i = 0; i < count; i++)
            if (open[i] && parts[i].count > first && parts[i].area > most) {
                most = parts[i].area;
                widest = i;
            }
    return widest;
}

// --- bins

struct bins {
    int count;
    struct box boxes[BINS], middles[BINS];
    uint32_t counts[BINS];
};

// The division of a range: primitives in bins below `bin` belong to the left half.
struct split {
    int axis, bin, bins;
    float start, factor;
};

static inline int bin_of(const struct split *s, const struct primitive *p)
{
    float middle = p->low[s->axis] + p->high[s->axis];
    int bin = (int)((middle - s->start) * s->factor);
    return bin < 0 ? 0 : bin < s->bins ? bin : s->bins - 1;
}

static inline void clear_bins(struct bins *bins, int count)
{
    bins->count = count;
    for (int i = 0; i < count; i++) {
        bins->boxes[i] = bins->middles[i] = empty_box();
        bins->counts[i] = 0;
    }
}

static inline void fill_bins(struct bins *bins, const struct split *s, const struct primitive *p, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        int bin = bin_of(s, &p[i]);
        num middle = middle_of(&p[i]);
        bins->boxes[bin] = around(bins->boxes[bin], box_of(&p[i]));
        bins->middles[bin] = around(bins->middles[bin], (struct box){middle, middle});
        bins->counts[bin] += primitive_weight(&p[i]);
    }
}

// Fills the bins along the longest side of the box of centres. Returns false if the centres are equal.
static inline bool choose_axis(const struct range *r, struct split *s)
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

// Finds the cheapest boundary between bins, and returns its cost.
static inline float choose_bin(const struct bins *bins, struct split *s)
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

static inline uint32_t sides_of(const struct bins *bins, int bin, struct box boxes[2], struct box middles[2])
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

// Moves the primitives of the left side to the front. Returns their number.
static inline uint32_t partition(struct primitive *p, uint32_t count, const struct split *s)
{
    uint32_t low = 0, high = count;
    for (;;) {
        while (low < high && bin_of(s, &p[low]) < s->bin)
            low++;
        while (low < high && bin_of(s, &p[high - 1]) >= s->bin)
            high--;
        if (low >= high)
            return low;
        struct primitive kept = p[low];
        p[low++] = p[--high];
        p[high] = kept;
    }
}

// --- the nodes of one range (splits.c)

// Computes the box of primitives, and the box of twice their centres.
void range_measure(const struct primitive *p, uint32_t count, struct box *box, struct box *middles);

// Sets the planes of a node whose children have the boxes of `parts`.
void range_set_planes(struct ray_node *node, const struct range *parts, int count);

// The nodes of a range. The first of them has the triangles of the whole range, and the children that are nodes are
// counted from there. Without nodes, the range is a leaf.
struct range_nodes {
    struct ray_node *list;
    uint32_t count;
};

// Makes the nodes and leaves of a range with one thread. A range without a parent gets at least one node. Returns false
// if memory runs out.
bool range_divide(struct builder *builder, const struct range *range, struct range_nodes *nodes);
void range_nodes_free(struct builder *builder, struct range_nodes *nodes);

#endif
