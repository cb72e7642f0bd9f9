// cells.c: divides large ranges of a hierarchy's triangles, and distributes small ranges to threads.
//
// The centres of a large range's triangles are counted in the cells of a grid, and the boxes of the cells determine how
// the range is divided. There are far fewer cells than triangles. Only then are the numbers of the triangles sorted. A
// small range is divided by one thread, without cells (splits.c). A large range within one cell gets its own grid. The
// tasks, and the order of the nodes, depend only on the triangles. The result is therefore the same for any number of
// threads.
#include "ray_triangles.h"
#include "ranges.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

enum {
    SMALL = 512, // one thread divides a range of up to this size, or of about SMALL_CELLS cells
    SMALL_CELLS = 64,
    PART = 32, // parts of up to this many triangles are not divided into children of the same node
    CELL_BITS_MAX = 16,
    CHUNKS_MAX = 8,
};
#define NO_CELL 0xffffffffu // rays ignore the triangle

// A grid over the centres of a range's triangles.
struct grid {
    num start, factor, last; // convert the doubled coordinates of a centre to a cell's index, 0 … last
    int shift[3];            // for each axis, the position of its bits in a cell's number
    uint32_t cell_count;
};

// Ranges that remain to be divided, and nodes.
struct list {
    struct buffer memory;
    size_t count;
};

struct large {
    struct builder *builder;
    const uint32_t *numbers; // the triangles of the range; NULL for all triangles
    uint32_t count;
    struct grid grid;
    uint32_t chunk, chunks, small; // triangles sorted together; the largest range for one thread
    struct box bounds[CHUNKS_MAX]; // of twice the centres
    // For each task and cell: the box and the number of the triangles. The first task's cells become the range's cells.
    struct primitive *cells;
    uint32_t *offsets; // for each task and cell, the position of the next triangle
    // Ranges that one thread divides, ranges that need their own grids, and the nodes of large ranges.
    struct list small_ranges, waiting, nodes;
    struct range_nodes *made; // of the small ranges
    struct buffer cells_memory, offsets_memory, numbers_memory, made_memory;
};

// --- the grid

// Makes the grid. Each bit of a cell's number halves the cells along the axis on which they are longest at that time.
static struct grid grid_over(const struct box *middles, uint32_t count)
{
    int bits = 31 - __builtin_clz(count | 16) - 4, of_axis[3] = {0, 0, 0};
    float side[3];
    struct grid grid;
    bits = bits > CELL_BITS_MAX ? CELL_BITS_MAX : bits;
    for (int axis = 0; axis < 3; axis++)
        side[axis] = lane(middles->high, axis) - lane(middles->low, axis);
    for (int bit = 0; bit < bits; bit++) {
        int longest = side[0] >= side[1] ? 0 : 1;
        longest = side[longest] >= side[2] ? longest : 2;
        side[longest] *= 0.5f;
        of_axis[longest]++;
    }
    float factor[4] = {0}, last[4] = {0};
    int shift = 0;
    for (int axis = 0; axis < 3; axis++) {
        float length = lane(middles->high, axis) - lane(middles->low, axis);
        int steps = 1 << of_axis[axis];
        factor[axis] = length > 1e-30f ? (float)steps * 0.99999f / length : 0;
        last[axis] = (float)(steps - 1);
        grid.shift[axis] = shift;
        shift += of_axis[axis];
    }
    grid.start = middles->low;
    grid.factor = num_load(factor);
    grid.last = num_load(last);
    grid.cell_count = 1u << bits;
    return grid;
}

static uint32_t cell_of(const struct grid *grid, const struct primitive *p)
{
    num at = min_of(max_of((middle_of(p) - grid->start) * grid->factor, num_of(0.0f)), grid->last);
    inum i = int_of(at);
    return (uint32_t)(ilane(i, 0) << grid->shift[0] | ilane(i, 1) << grid->shift[1] | ilane(i, 2) << grid->shift[2]);
}

static uint32_t number_at(const struct large *l, uint32_t i) { return l->numbers ? l->numbers[i] : i; }

static uint32_t chunk_end(const struct large *l, size_t index)
{
    uint32_t first = (uint32_t)index * l->chunk;
    return l->count - first < l->chunk ? l->count : first + l->chunk;
}

static void measure_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    struct placement place = {0};
    struct box box = empty_box();
    for (uint32_t i = (uint32_t)index * l->chunk, end = chunk_end(l, index); i < end; i++) {
        struct point p[3];
        struct primitive own;
        ray_space_corners(l->builder, number_at(l, i), &place, p);
        store_box(&own, p);
        box = around(box, (struct box){middle_of(&own), middle_of(&own)});
    }
    l->bounds[index] = box;
}

// Stores the cell of each triangle in its entry of `twins`.
static void count_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    struct placement place = {0};
    struct primitive *cells = l->cells + index * l->grid.cell_count;
    struct box none = empty_box();
    for (uint32_t i = 0; i < l->grid.cell_count; i++) {
        num_store(cells[i].low, none.low);
        num_store(cells[i].high, none.high);
        primitive_note(&cells[i], i, 0);
    }
    for (uint32_t i = (uint32_t)index * l->chunk, end = chunk_end(l, index); i < end; i++) {
        struct point p[3];
        struct primitive own;
        uint32_t number = number_at(l, i), *key = &l->builder->twins[number];
        if (i % RAY_CHUNK == 0 && !should_continue(&l->builder->loop))
            return;
        *key = NO_CELL;
        if (!ray_space_corners(l->builder, number, &place, p))
            continue;
        store_box(&own, p);
        *key = cell_of(&l->grid, &own);
        struct primitive *cell = &cells[*key];
        uint32_t count = primitive_weight(cell);
        struct box box = around(box_of(cell), box_of(&own));
        num_store(cell->low, box.low);
        num_store(cell->high, box.high);
        primitive_note(cell, *key, count + 1);
    }
}

static void sort_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    uint32_t *offsets = l->offsets + index * l->grid.cell_count;
    for (uint32_t i = (uint32_t)index * l->chunk, end = chunk_end(l, index); i < end; i++) {
        uint32_t number = number_at(l, i), *key = &l->builder->twins[number];
        if (*key != NO_CELL)
            l->builder->numbers[offsets[*key]++] = number;
        *key = number;
    }
}

static bool reserve(struct large *l, struct buffer *buffer, size_t bytes)
{
    if (buffer_reserve(buffer, bytes, l->builder->loop.call, NULL))
        return true;
    no_memory(&l->builder->loop);
    return false;
}

// Counts the triangles of a range in cells, and lists the cells that contain triangles. Sets the range's box and count.
static bool count_in_cells(struct large *l, struct range *r)
{
    struct builder *b = l->builder;
    l->chunks = l->count >> 16 < 1 ? 1 : l->count >> 16 > CHUNKS_MAX ? CHUNKS_MAX : l->count >> 16;
    l->chunk = (l->count + l->chunks - 1) / l->chunks;
    if (l->numbers) {
        pool_run(b->pool, l->chunks, measure_task, l);
        for (uint32_t i = 0; i < l->chunks; i++)
            r->middles = i ? around(r->middles, l->bounds[i]) : l->bounds[i];
    } else {
        r->middles = (struct box){2 * num_load(b->low), 2 * num_load(b->high)};
    }
    l->grid = grid_over(&r->middles, l->count);
    size_t cells = l->grid.cell_count;
    l->small = (uint32_t)(SMALL_CELLS * (l->count / cells));
    l->small = l->small > SMALL ? l->small : SMALL;
    if (!reserve(l, &l->cells_memory, l->chunks * cells * sizeof *l->cells) ||
        !reserve(l, &l->offsets_memory, l->chunks * cells * sizeof *l->offsets))
        return false;
    l->cells = l->cells_memory.data;
    l->offsets = l->offsets_memory.data;
    pool_run(b->pool, l->chunks, count_task, l);
    if (!should_continue(&b->loop))
        return false;
    r->count = 0;
    r->first_cell = r->cell_count = 0;
    r->box = empty_box();
    for (uint32_t cell = 0; cell < cells; cell++) {
        struct box box = empty_box();
        uint32_t count = 0;
        for (uint32_t chunk = 0; chunk < l->chunks; chunk++) {
            const struct primitive *own = &l->cells[chunk * cells + cell];
            l->offsets[chunk * cells + cell] = count;
            count += primitive_weight(own);
            box = around(box, box_of(own));
        }
        if (!count)
            continue;
        struct primitive *to = &l->cells[r->cell_count++];
        num_store(to->low, box.low);
        num_store(to->high, box.high);
        primitive_note(to, cell, count);
        r->count += count;
        r->box = around(r->box, box);
    }
    struct box unused;
    range_measure(l->cells, r->cell_count, &unused, &r->middles);
    r->area = half_area(r->box);
    return true;
}

// Sorts the numbers of the triangles into the ranges that were added since the lists had these sizes.
static void sort_numbers(struct large *l, size_t small, size_t waiting)
{
    const struct list *lists[2] = {&l->small_ranges, &l->waiting};
    size_t first[2] = {small, waiting}, cells = l->grid.cell_count;
    for (int k = 0; k < 2; k++)
        for (size_t i = first[k]; i < lists[k]->count; i++) {
            const struct range *r = (const struct range *)lists[k]->memory.data + i;
            uint32_t at = r->first;
            for (uint32_t c = r->first_cell; c < r->first_cell + r->cell_count; c++) {
                for (uint32_t chunk = 0; chunk < l->chunks; chunk++)
                    l->offsets[chunk * cells + primitive_number(&l->cells[c])] += at;
                at += primitive_weight(&l->cells[c]);
            }
        }
    pool_run(l->builder->pool, l->chunks, sort_task, l);
}

// --- dividing ranges

// Appends an item, and returns its address, or NULL if memory runs out.
static void *add(struct large *l, struct list *list, const void *item, size_t size)
{
    size_t bytes = list->count * size;
    if (bytes + size > list->memory.capacity) {
        struct call_control *call = l->builder->loop.call;
        struct buffer grown = {0};
        if (!reserve(l, &grown, bytes ? 2 * bytes : 64 * size))
            return NULL;
        if (bytes)
            memcpy(grown.data, list->memory.data, bytes);
        buffer_release(&list->memory, call);
        list->memory = grown;
    }
    return memcpy((char *)list->memory.data + size * list->count++, item, size);
}

// Divides a range by its cells. Returns false if the range contains only one cell, or if all its centres are equal.
static bool halve_cells(struct large *l, struct range *r, struct range *right)
{
    struct split split;
    struct bins bins;
    struct box boxes[2], middles[2];
    if (r->cell_count < 2 || !choose_axis(r, &split))
        return false;
    clear_bins(&bins, split.bins);
    fill_bins(&bins, &split, l->cells + r->first_cell, r->cell_count);
    choose_bin(&bins, &split);
    uint32_t left = partition(l->cells + r->first_cell, r->cell_count, &split);
    halves_of(r, sides_of(&bins, split.bin, boxes, middles), boxes, middles, right);
    r->cell_count = left;
    right->first_cell += left;
    right->cell_count -= left;
    return true;
}

// Divides a range by its cells into nodes. `again` is whether the grid was made for this range alone.
static void divide_by_cells(struct large *l, const struct range *r, bool again)
{
    struct range parts[NODE_CHILDREN] = {*r};
    bool open[NODE_CHILDREN] = {r->count > l->small && r->depth < BALANCED_AT};
    struct ray_node node;
    int count = 1, i;
    bool large = open[0];
    while (count < NODE_CHILDREN && (i = widest_part(parts, open, count, 0)) >= 0) {
        bool halved = halve_cells(l, &parts[i], &parts[count]);
        open[i] = halved && parts[i].count > PART;
        if (halved) {
            open[count] = parts[count].count > PART;
            count++;
        }
    }
    if (count == 1) {
        add(l, large && !again ? &l->waiting : &l->small_ranges, r, sizeof *r);
        return;
    }
    uint32_t index = (uint32_t)l->nodes.count;
    range_set_planes(&node, parts, count);
    if (!should_continue(&l->builder->loop) || !add(l, &l->nodes, &node, sizeof node))
        return;
    if (r->parent != NO_PARENT)
        ((struct ray_node *)l->nodes.memory.data)[r->parent].child[r->slot] = index;
    for (i = 0; i < count; i++) {
        parts[i].parent = index;
        parts[i].slot = (uint32_t)i;
        divide_by_cells(l, &parts[i], false);
    }
}

// Divides a range that one thread cannot divide.
static void divide_large(struct large *l, struct range *r)
{
    struct builder *b = l->builder;
    size_t small = l->small_ranges.count, waiting = l->waiting.count;
    l->count = r->count;
    l->numbers = NULL;
    if (b->sorted) {
        size_t bytes = r->count * sizeof *b->numbers;
        if (!reserve(l, &l->numbers_memory, bytes))
            return;
        l->numbers = memcpy(l->numbers_memory.data, b->numbers + r->first, bytes);
    }
    if (!count_in_cells(l, r))
        return;
    divide_by_cells(l, r, b->sorted);
    sort_numbers(l, small, waiting);
    b->sorted = true;
}

static void small_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    struct builder *b = l->builder;
    if (should_continue(&b->loop) &&
        !range_divide(b, (const struct range *)l->small_ranges.memory.data + index, &l->made[index]))
        no_memory(&b->loop);
}

// Puts the nodes of all ranges into one array: the nodes of large ranges, then the small ranges' nodes.
static bool join_nodes(struct large *l, lam_error *error)
{
    struct builder *b = l->builder;
    size_t total = l->nodes.count;
    for (size_t i = 0; i < l->small_ranges.count; i++)
        total += l->made[i].count;
    if (!buffer_reserve(b->nodes, total * sizeof(struct ray_node), b->loop.call, error))
        return false;
    struct ray_node *nodes = b->nodes->data;
    if (l->nodes.count)
        memcpy(nodes, l->nodes.memory.data, l->nodes.count * sizeof *nodes);
    uint32_t base = (uint32_t)l->nodes.count;
    for (size_t i = 0; i < l->small_ranges.count; i++) {
        const struct range *r = (const struct range *)l->small_ranges.memory.data + i;
        const struct range_nodes *own = &l->made[i];
        if (r->parent != NO_PARENT) {
            nodes[r->parent].child[r->slot] = own->count ? base : r->first;
            nodes[r->parent].count[r->slot] = own->count ? 0 : r->count;
        }
        for (uint32_t n = 0; n < own->count; n++, base++) {
            nodes[base] = own->list[n];
            for (int child = 0; child < NODE_CHILDREN; child++)
                if (!nodes[base].count[child])
                    nodes[base].child[child] += base - n;
        }
    }
    b->hierarchy->nodes = nodes;
    b->hierarchy->node_count = base;
    return true;
}

bool ray_nodes_build(struct builder *b, lam_error *error)
{
    struct large l = {.builder = b};
    struct range r = {.count = b->frame->triangle_count, .parent = NO_PARENT};
    divide_large(&l, &r);
    while (l.waiting.count && should_continue(&b->loop)) {
        r = ((const struct range *)l.waiting.memory.data)[--l.waiting.count];
        divide_large(&l, &r);
    }
    buffer_release(&l.cells_memory, b->loop.call);
    size_t bytes = l.small_ranges.count * sizeof *l.made;
    if (should_continue(&b->loop) && reserve(&l, &l.made_memory, bytes)) {
        l.made = memset(l.made_memory.data, 0, bytes);
        pool_run(b->pool, l.small_ranges.count, small_task, &l);
    }
    bool ok = should_continue(&b->loop) ? join_nodes(&l, error)
                                        : loop_error(&b->loop, (size_t)b->frame->triangle_count * 4, error);
    for (size_t i = 0; i < l.small_ranges.count && l.made; i++)
        range_nodes_free(b, &l.made[i]);
    struct buffer *own[] = {&l.offsets_memory, &l.numbers_memory, &l.made_memory, &l.small_ranges.memory,
                            &l.waiting.memory, &l.nodes.memory,   &l.cells_memory};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        buffer_release(own[i], b->loop.call);
    return ok;
}
