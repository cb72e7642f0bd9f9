// cells.c: divides large ranges of a hierarchy's triangles, and distributes small ranges to threads.
//
// The centres of a large range's triangles are sorted into the cells of a grid, and the boxes of the cells determine
// how the range is divided. There are far fewer cells than triangles. A small range is divided by one thread, without
// cells (splits.c). A large range within one cell gets its own grid. The tasks depend only on the number of triangles.
// The positions of nodes in the array depend only on the triangles of the range. The result is therefore the same for
// any number of threads.
#include "ranges.h"

#include "fail.h"

#include <string.h>

enum {
    PART = 32, // only ranges of more than this many triangles are divided by cells
    // one thread divides a range of up to this size; nodes of larger ranges have the maximum number of children
    SMALL = NODE_CHILDREN * PART,
    CELL_BITS_MAX = 16,
    CHUNKS_MAX = 16,
    CELLS_CHUNK = 256 // cells measured together
};

// A grid over the centres of a range's triangles.
struct grid {
    num start, factor, last; // convert the doubled coordinates of a centre to a cell's index, 0 … last
    int shift[3];            // for each axis, the position of its bits in a cell's number
    uint32_t cell_count;
};

// Ranges that remain to be divided.
struct list {
    struct buffer memory;
    size_t count;
};

struct large {
    struct builder *builder;
    const struct range *range;
    struct grid grid;
    uint32_t chunk, chunks; // triangles sorted together
    uint16_t *keys;         // the cell of each triangle
    // For each task and cell: first the number of triangles, later the position of the next triangle.
    uint32_t *offsets;
    struct primitive *cells; // cells that contain triangles
    uint32_t used_cells;
    struct box *boxes;          // for each task, the box of its triangles and the box of twice their centres
    struct list small, waiting; // ranges that one thread divides, and ranges that need their own grids
    struct buffer keys_memory, offsets_memory, cells_memory;
};

// --- the grid

// Makes the grid. Each bit of a cell's number halves the cells along the axis on which they are longest at that time.
static struct grid grid_over(const struct box *middles, uint32_t count)
{
    int bits = 31 - __builtin_clz(count) - 2, of_axis[3] = {0, 0, 0};
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

static uint32_t chunk_count(const struct large *l, size_t index)
{
    uint32_t first = (uint32_t)index * l->chunk;
    return l->range->count - first < l->chunk ? l->range->count - first : l->chunk;
}

static void measure_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    const struct primitive *p = l->builder->primitives + l->range->first + index * l->chunk;
    range_measure(p, chunk_count(l, index), &l->boxes[2 * index], &l->boxes[2 * index + 1]);
}

static void count_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    const struct primitive *p = l->builder->primitives + l->range->first + index * l->chunk;
    uint16_t *keys = l->keys + index * l->chunk;
    uint32_t *offsets = l->offsets + index * l->grid.cell_count;
    for (uint32_t i = 0, count = chunk_count(l, index); i < count; i++) {
        keys[i] = (uint16_t)cell_of(&l->grid, &p[i]);
        offsets[keys[i]]++;
    }
}

static void sort_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    const struct primitive *p = l->builder->primitives + l->range->first + index * l->chunk;
    const uint16_t *keys = l->keys + index * l->chunk;
    uint32_t *offsets = l->offsets + index * l->grid.cell_count;
    for (uint32_t i = 0, count = chunk_count(l, index); i < count; i++)
        l->builder->in_cells[offsets[keys[i]]++] = p[i];
}

static void cells_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    uint32_t end =
        (uint32_t)(index + 1) * CELLS_CHUNK < l->used_cells ? (uint32_t)(index + 1) * CELLS_CHUNK : l->used_cells;
    for (uint32_t i = (uint32_t)index * CELLS_CHUNK; i < end; i++) {
        struct primitive *cell = &l->cells[i];
        uint32_t first = primitive_number(cell), count = primitive_weight(cell);
        struct box box, middles;
        range_measure(l->builder->in_cells + first, count, &box, &middles);
        num_store(cell->low, box.low);
        num_store(cell->high, box.high);
        primitive_note(cell, first, count);
    }
}

// Sorts the primitives of a range into cells, and computes the range's box and centres.
static bool sort_into_cells(struct large *l, struct range *r)
{
    struct builder *b = l->builder;
    l->range = r;
    l->chunk = r->count / CHUNKS_MAX > 8 * RAY_CHUNK ? r->count / CHUNKS_MAX + 1 : 8 * RAY_CHUNK;
    l->chunks = (r->count + l->chunk - 1) / l->chunk;
    struct box boxes[2 * (CHUNKS_MAX + 1)];
    l->boxes = boxes;
    pool_run(b->pool, l->chunks, measure_task, l);
    r->box = r->middles = empty_box();
    for (uint32_t i = 0; i < l->chunks; i++) {
        r->box = around(r->box, boxes[2 * i]);
        r->middles = around(r->middles, boxes[2 * i + 1]);
    }
    l->grid = grid_over(&r->middles, r->count);
    size_t cells = l->grid.cell_count;
    size_t keys_bytes = r->count * sizeof *l->keys, offsets_bytes = l->chunks * cells * sizeof *l->offsets;
    if (!buffer_reserve(&l->keys_memory, keys_bytes, b->loop.call, NULL) ||
        !buffer_reserve(&l->offsets_memory, offsets_bytes, b->loop.call, NULL) ||
        !buffer_reserve(&l->cells_memory, cells * sizeof *l->cells, b->loop.call, NULL)) {
        no_memory(&b->loop);
        return false;
    }
    l->keys = l->keys_memory.data;
    l->offsets = memset(l->offsets_memory.data, 0, offsets_bytes);
    l->cells = l->cells_memory.data;
    pool_run(b->pool, l->chunks, count_task, l);
    uint32_t at = 0;
    l->used_cells = 0;
    for (size_t cell = 0; cell < cells; cell++) {
        uint32_t first = at;
        for (uint32_t chunk = 0; chunk < l->chunks; chunk++) {
            uint32_t *offset = &l->offsets[chunk * cells + cell], count = *offset;
            *offset = at;
            at += count;
        }
        if (at > first)
            primitive_note(&l->cells[l->used_cells++], first, at - first);
    }
    pool_run(b->pool, l->chunks, sort_task, l);
    pool_run(b->pool, (l->used_cells + CELLS_CHUNK - 1) / CELLS_CHUNK, cells_task, l);
    r->first_cell = 0;
    r->cell_count = l->used_cells;
    struct box unused;
    range_measure(l->cells, l->used_cells, &unused, &r->middles);
    return true;
}

// --- dividing ranges

static struct range *ranges_of(const struct list *list) { return list->memory.data; }

static void add(struct large *l, const struct range *r, struct list *list)
{
    size_t bytes = list->count * sizeof *r;
    if (bytes + sizeof *r > list->memory.capacity) {
        struct call_control *call = l->builder->loop.call;
        struct buffer grown = {0};
        if (!buffer_reserve(&grown, bytes ? 2 * bytes : 64 * sizeof *r, call, NULL)) {
            no_memory(&l->builder->loop);
            return;
        }
        if (bytes)
            memcpy(grown.data, list->memory.data, bytes);
        buffer_release(&list->memory, call);
        list->memory = grown;
    }
    ranges_of(list)[list->count++] = *r;
}

// Divides a range by its cells. Returns false if the range contains only one cell, if all its centres are equal, or if
// the range is too deep.
static bool halve_cells(struct large *l, struct range *r, struct range *right)
{
    struct split split;
    struct bins bins;
    struct box boxes[2], middles[2];
    if (r->cell_count < 2 || r->depth >= BALANCED_AT || !choose_axis(r, &split))
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

// Copies the triangles of a range from in_cells back to the builder's primitives, and measures the range.
static void leave_cells(const struct large *l, struct range *r)
{
    struct primitive *to = l->builder->primitives + r->first;
    for (uint32_t i = 0; i < r->cell_count; i++) {
        const struct primitive *cell = &l->cells[r->first_cell + i];
        memcpy(to, l->builder->in_cells + primitive_number(cell), primitive_weight(cell) * sizeof *to);
        to += primitive_weight(cell);
    }
    if (r->cell_count)
        range_measure(l->builder->primitives + r->first, r->count, &r->box, &r->middles);
    r->cell_count = 0;
}

static void divide_by_cells(struct large *l, const struct range *r)
{
    struct range parts[NODE_CHILDREN] = {*r};
    bool open[NODE_CHILDREN] = {true};
    int count = 1, i;
    if (!should_continue(&l->builder->loop))
        return;
    while (count < NODE_CHILDREN && (i = widest_part(parts, open, count)) >= 0) {
        if (!halve_cells(l, &parts[i], &parts[count])) {
            leave_cells(l, &parts[i]);
            if (!range_halve(l->builder, &parts[i], &parts[count])) // memory ran out
                return;
        }
        open[i] = parts[i].count > PART;
        open[count] = parts[count].count > PART;
        count++;
    }
    range_enter_node(l->builder, r, parts, count);
    for (i = 0; i < count; i++)
        if (parts[i].count > SMALL && parts[i].cell_count)
            divide_by_cells(l, &parts[i]);
        else if (parts[i].count > SMALL && parts[i].depth < BALANCED_AT && !parts[i].sorted)
            add(l, &parts[i], &l->waiting);
        else
            add(l, &parts[i], &l->small);
}

static void small_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct large *l = user;
    if (!should_continue(&l->builder->loop))
        return;
    struct range *r = &ranges_of(&l->small)[index];
    leave_cells(l, r);
    range_divide(l->builder, r);
}

bool ray_nodes_build(struct builder *b, lam_error *error)
{
    struct large l = {.builder = b};
    struct range r = {.count = b->frame->triangle_count};
    if (r.count > SMALL) {
        add(&l, &r, &l.waiting);
    } else {
        range_measure(b->primitives, r.count, &r.box, &r.middles);
        range_divide(b, &r);
    }
    while (l.waiting.count && should_continue(&b->loop)) {
        r = ranges_of(&l.waiting)[--l.waiting.count];
        l.small.count = 0;
        if (sort_into_cells(&l, &r)) {
            divide_by_cells(&l, &r);
            pool_run(b->pool, l.small.count, small_task, &l);
        }
    }
    struct buffer *own[] = {&l.keys_memory, &l.offsets_memory, &l.cells_memory, &l.small.memory, &l.waiting.memory};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        buffer_release(own[i], b->loop.call);
    return should_continue(&b->loop) || loop_error(&b->loop, (size_t)b->frame->triangle_count * 4, error);
}
