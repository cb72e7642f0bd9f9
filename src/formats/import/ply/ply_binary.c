// ply_binary.c: reads the rows of one element of a binary PLY as a table.
//
// Rows without lists have a fixed stride and stay in the file. Rows with lists must be in memory: a serial pass indexes
// them, and then their chunks are read in parallel. In nearly all files, each face is a list of three corners. If the
// number of remaining bytes matches this layout, the rows are read with the fixed stride of this layout, and checked.
#include "fail.h"
#include "mesh_build.h"
#include "shown_name.h"
#include "ply_load.h"
#include "ply_rows.h"

#include <string.h>

// Reports an invalid item in a row's list. The list is at `items` in memory, and at `offset` in the file.
static bool fail_item(const struct ply_reader *reader, size_t row, const uint8_t *items, size_t offset, uint32_t item,
                      lam_error *error)
{
    const struct ply_element *element = reader->element;
    const struct ply_property *list = &element->properties[reader->request->list];
    size_t at = item * ply_type_size(list->type);
    return fail_byte(error, reader->source, offset + at, "%s %zu of %llu: found index %lld in %s, expected 0 to %lld",
                     element->name, row + 1, (unsigned long long)element->count,
                     (long long)ply_load_integer(items + at, list->type, reader->table->swapped), list->name,
                     (long long)reader->request->item_limit - 1);
}

// Reads and checks the items of one row's list. Returns the number of items before the first wrong item.
static uint32_t read_items(const struct ply_reader *reader, const uint8_t *at, uint32_t count, uint32_t *items)
{
    enum ply_type type = reader->element->properties[reader->request->list].type;
    bool swapped = reader->table->swapped;
    size_t size = ply_type_size(type);
    for (uint32_t i = 0; i < count; i++, at += size) {
        int64_t item = ply_load_integer(at, type, swapped);
        if (item == -1 && reader->request->restarts)
            items[i] = PLY_RESTART;
        else if (item < 0 || item >= (int64_t)reader->request->item_limit)
            return i;
        else
            items[i] = (uint32_t)item;
    }
    return count;
}

static void mark_items(const struct ply_reader *reader, size_t first, size_t last)
{
    if (reader->marks)
        mesh_mark_vertices(reader->items + 3 * first, 3 * (last - first), reader->marks);
}

// Reads a chunk of rows with three items each, at a fixed stride.
static bool read_triangles(void *user, size_t index, const uint8_t *rows, lam_error *error)
{
    struct ply_reader *reader = user;
    const struct ply_property *list = &reader->element->properties[reader->request->list];
    const struct row_bytes *all = &reader->table->rows;
    size_t first, last, count_size = ply_type_size(list->count_type), stride = all->stride;
    parallel_rows_range(all->count, index, &first, &last);
    const uint8_t *at = rows + reader->list_offset;
    uint32_t *items = reader->items + 3 * first, limit = reader->request->item_limit;
    bool swapped = reader->table->swapped;

    // The case of a one-byte count and three 32-bit items is branch-free. Negative items, read as unsigned numbers,
    // exceed the limit too.
    if (count_size == 1 && ply_type_size(list->type) == 4 && !swapped) {
        uint32_t other = 0, wrong = 0;
        for (size_t row = first; row < last; row++, at += stride, items += 3) {
            uint32_t three[3];
            memcpy(three, at + 1, sizeof three);
            memcpy(items, three, sizeof three);
            other |= at[0] ^ 3u;
            wrong |= (three[0] >= limit) | (three[1] >= limit) | (three[2] >= limit);
        }
        if (other) {
            __atomic_store_n(&reader->mixed, 1, __ATOMIC_RELAXED);
            return true;
        }
        if (!wrong) {
            mark_items(reader, first, last);
            return true;
        }
        at = rows + reader->list_offset;
        items = reader->items + 3 * first;
    }
    for (size_t row = first; row < last; row++, at += stride, items += 3) {
        if (ply_load_integer(at, list->count_type, swapped) != 3) {
            __atomic_store_n(&reader->mixed, 1, __ATOMIC_RELAXED);
            return true;
        }
        uint32_t good = read_items(reader, at + count_size, 3, items);
        if (good < 3)
            return fail_item(reader, row, at + count_size,
                             all->offset + row * stride + reader->list_offset + count_size, good, error);
    }
    mark_items(reader, first, last);
    return true;
}

// Checks only that each row of a chunk has three items.
static bool check_counts(void *user, size_t index, const uint8_t *rows, lam_error *error)
{
    (void)error;
    struct ply_reader *reader = user;
    const struct row_bytes *all = &reader->table->rows;
    size_t first, last;
    parallel_rows_range(all->count, index, &first, &last);
    const uint8_t *at = rows + reader->list_offset;
    for (size_t row = first; row < last; row++, at += all->stride)
        if (ply_load_integer(at, reader->element->properties[reader->request->list].count_type,
                             reader->table->swapped) != 3)
            __atomic_store_n(&reader->mixed, 1, __ATOMIC_RELAXED);
    return true;
}

// Returns whether the rest of the file has the right size for rows with three items each, followed by the remaining
// elements.
static bool may_be_triangles(const struct ply_reader *reader, const struct ply_header *header)
{
    const struct ply_element *element = reader->element, *end = header->elements + header->element_count;
    if (reader->request->list < 0 || reader->request->restarts || element->list_count != 1)
        return false;
    uint64_t left = reader->source->parts.size - reader->offset;
    const struct ply_property *list = &element->properties[reader->request->list];
    for (const struct ply_element *e = element; e < end; e++) {
        if (e != element && e->list_count > 0)
            return false;
        uint64_t bytes, row = e->min_bytes + (e == element ? 3 * ply_type_size(list->type) : 0);
        if (__builtin_mul_overflow(e->count, row, &bytes) || bytes > left)
            return false;
        left -= bytes;
    }
    return left == 0;
}

// Assumes that each row has three items, and reads the rows as triangles. Sets *done to true if the assumption is
// correct, otherwise to false.
static bool try_triangles(struct ply_reader *reader, struct arena *keep, struct arena *scratch, bool *done,
                          lam_error *error)
{
    const struct ply_element *element = reader->element;
    int list = reader->request->list;
    size_t count = (size_t)element->count, property_count = (size_t)element->property_count;
    size_t list_bytes =
        ply_type_size(element->properties[list].count_type) + 3 * ply_type_size(element->properties[list].type);
    reader->items = arena_array(keep, count, 3 * sizeof *reader->items);
    uint32_t *offsets = arena_array(scratch, property_count, sizeof *offsets);
    const size_t limit = reader->request->item_limit;
    const bool may_use_all = limit <= 3 * count;
    reader->marks = may_use_all ? arena_alloc_zeroed(scratch, limit) : NULL;
    if (!reader->items || !offsets || (may_use_all && !reader->marks))
        return call_memory_error(reader->source->call, count * 3 * sizeof *reader->items, error);
    struct ply_table *table = reader->table;
    reader->list_offset = table->offsets[list];
    table->rows.stride = element->scalar_bytes + list_bytes;

    lam_error wrong;
    bool good = parallel_rows_read(reader->source, &table->rows, read_triangles, reader, &wrong);
    // After an error, the number of threads decides which other chunks were read.
    if (!good && !reader->mixed && !parallel_rows_read(reader->source, &table->rows, check_counts, reader, error))
        return false;
    if (reader->mixed)
        return true; // errors found with the wrong stride are meaningless
    if (!good) {
        if (error)
            *error = wrong;
        return false;
    }
    for (size_t i = 0; i < property_count; i++) // properties after the list
        offsets[i] = table->offsets[i] + ((int)i > list ? (uint32_t)list_bytes : 0);
    table->offsets = offsets;
    table->items = reader->items;
    table->all_used = may_use_all && !memchr(reader->marks, 0, limit);
    *done = true;
    return true;
}

// Runs the serial pass: finds the start of each chunk and of each row's list, and sets *offset to the end of the last
// row.
static bool index_rows(struct ply_reader *reader, size_t *offset, lam_error *error)
{
    const struct ply_element *element = reader->element;
    const uint8_t *at = reader->first, *file_end = at + (reader->source->parts.size - reader->offset);
    for (size_t row = 0; row < element->count; row++) {
        if (!ply_index_row(reader, row, at, error))
            return false;
        for (int i = 0; i < element->property_count; i++) {
            const struct ply_property *property = &element->properties[i];
            size_t size = ply_type_size(property->list ? property->count_type : property->type);
            if ((size_t)(file_end - at) < size)
                return ply_fail_truncated(reader->source, element, row, true, error);
            if (property->list) {
                int64_t items = ply_load_integer(at, property->count_type, reader->table->swapped);
                char shown[2][SHOWN_NAME_SIZE];
                if (items < 0)
                    return fail_byte(error, reader->source, reader->offset + (size_t)(at - reader->first),
                                     "%s %zu of %llu: found %lld as the number of items of %s, expected 0 or more",
                                     shown_name(element->name, shown[0]), row + 1, (unsigned long long)element->count,
                                     (long long)items, shown_name(property->name, shown[1]));
                at += size;
                size = (size_t)items * ply_type_size(property->type); // at most 2³² · 8
                if ((size_t)(file_end - at) < size)
                    return ply_fail_truncated(reader->source, element, row, true, error);
                if (i == reader->request->list)
                    ply_count_items(reader, items);
            }
            at += size;
        }
        if (reader->total >= UINT32_MAX)
            return ply_fail_too_many(reader->source, element, error);
    }
    *offset += (size_t)(at - reader->first);
    return true;
}

static bool read_chunk(void *user, size_t index, lam_error *error)
{
    const struct ply_reader *reader = user;
    const struct ply_element *element = reader->element;
    size_t first, last, stride = reader->table->rows.stride;
    parallel_rows_range(reader->table->rows.count, index, &first, &last);
    const uint8_t *at = reader->chunks[index];
    uint32_t unused[2]; // items of a row without triangles
    for (size_t row = first; row < last; row++) {
        for (int i = 0; i < element->property_count; i++) {
            const struct ply_property *property = &element->properties[i];
            size_t size = ply_type_size(property->type);
            if (property->list) {
                uint32_t count = (uint32_t)ply_load_integer(at, property->count_type, reader->table->swapped);
                at += ply_type_size(property->count_type);
                uint32_t good =
                    i != reader->request->list
                        ? count
                        : read_items(reader, at, count, count < 3 ? unused : reader->items + reader->starts[row]);
                if (good < count)
                    return fail_item(reader, row, at, reader->offset + (size_t)(at - reader->first), good, error);
                for (uint32_t k = 0; property == reader->request->wedges && k < count; k++)
                    ply_put_wedge(reader, row, k, count,
                                  (float)ply_load_double(at + k * size, property->type, reader->table->swapped));
                size *= count;
            } else if (reader->rows) {
                memcpy(reader->rows + row * stride + reader->table->offsets[i], at, size);
            }
            at += size;
        }
    }
    return true;
}

bool ply_read_binary(const struct import_source *source, const struct ply_header *header,
                     const struct ply_element *element, const struct ply_request *request, size_t *at,
                     struct ply_table *table, lam_error *error)
{
    struct arena *keep = request->keep, *scratch = request->scratch;
    // Check the file's size before any allocation.
    uint64_t left = source->parts.size - *at;
    if (element->min_bytes > 0 && element->count > left / element->min_bytes)
        return ply_fail_truncated(source, element, left / element->min_bytes, !element->list_count, error);

    static const struct ply_request nothing = {.list = -1};
    struct ply_table unused = {0};
    bool skip = !table;
    table = skip ? &unused : table;
    *table = (struct ply_table){.element = element, .rows = {.offset = *at, .count = (size_t)element->count}};
    bool big = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    table->swapped = (header->format == PLY_BIG) != big;
    struct ply_reader reader = {
        .source = source, .element = element, .request = skip ? &nothing : request, .table = table, .offset = *at};
    if (!skip && !ply_plan_rows(source, request, scratch, table, error))
        return false;
    if (element->list_count == 0) {
        *at += table->rows.count * element->scalar_bytes;
        return true;
    }
    bool done = false;
    if (!skip && may_be_triangles(&reader, header) && !try_triangles(&reader, keep, scratch, &done, error))
        return false;
    if (done) {
        *at += table->rows.count * table->rows.stride;
        return true;
    }
    reader.first = parallel_rows_rest(source, *at, scratch, error);
    if (!reader.first)
        return false;
    if (skip)
        return index_rows(&reader, at, error);
    table->rows.stride = element->scalar_bytes; // try_triangles may have changed the stride
    return ply_start_rows(&reader, scratch, error) && index_rows(&reader, at, error) &&
           ply_read_rows(&reader, read_chunk, keep, scratch, error);
}
