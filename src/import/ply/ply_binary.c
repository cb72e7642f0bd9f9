// ply_binary.c: the rows of one element of a binary PLY.
//
// Rows without lists lie at a fixed stride and are used where they are. Rows with lists must be walked, one
// after the other; then pieces of them are read in parallel. The one layout that nearly all files have, faces
// with one list each of three corners, is recognised by the bytes that are left, tried at its fixed stride,
// and checked row by row.
#include "parallel_rows.h"
#include "fail.h"
#include "ply_load.h"

bool ply_fail_short(const struct import_source *source, const struct ply_element *element, uint64_t row,
                    lam_error *error)
{
    return fail(error, LAM_CANNOT_READ,
                "%s: the file is cut short: its header promises %llu rows of element \"%s\", found %llu in %zu bytes",
                source->name, (unsigned long long)element->count, element->name, (unsigned long long)row, source->size);
}

bool ply_fail_too_many(const struct import_source *source, const struct ply_element *element, lam_error *error)
{
    return fail(error, LAM_LIMIT, "%s: element \"%s\" holds more than %u numbers, the most this program can tell apart",
                source->name, element->name, UINT32_MAX - 1);
}

bool ply_plan_rows(const struct import_source *source, const struct ply_request *request, struct arena *scratch,
                   struct ply_table *table, lam_error *error)
{
    const struct ply_element *element = table->element;
    size_t count = (size_t)element->property_count;
    uint32_t *offsets = arena_array(scratch, count, sizeof *offsets);
    enum ply_type *types = arena_array(scratch, count, sizeof *types);
    if (!offsets || !types)
        return call_memory_error(source->call, count * (sizeof *offsets + sizeof *types), error);
    table->stride = 0;
    for (size_t i = 0; i < count; i++) {
        const struct ply_property *property = &element->properties[i];
        bool position = !property->list && property->name[0] >= 'x' && property->name[0] <= 'z' && !property->name[1];
        types[i] = property->type;
        if (position && request->positions != PLY_AS_DECLARED)
            types[i] = request->positions == PLY_AS_FLOAT ? PLY_F32 : PLY_F64;
        offsets[i] = (uint32_t)table->stride;
        table->stride += property->list ? 0 : ply_type_size(types[i]);
    }
    table->offsets = offsets;
    table->types = types;
    table->positions = request->positions;
    return true;
}

struct reading {
    const struct import_source *source;
    const struct ply_element *element;
    const struct ply_request *request;
    struct ply_table *table;
    const uint8_t *first;     // row 0
    const uint8_t **pieces;   // where each piece begins
    uint32_t *items, *starts; // of the list that was asked for
    uint8_t *rows;            // scalars; NULL: not wanted
    // Rows with three items each
    size_t list_offset, stride;
    int mixed; // touched atomically: some row has another number of items
};

static bool fail_item(const struct reading *reading, size_t row, const uint8_t *at, lam_error *error)
{
    const struct ply_element *element = reading->element;
    const struct ply_property *list = &element->properties[reading->request->list];
    return fail_byte(error, reading->source, (size_t)(at - reading->source->bytes),
                     "%s %zu of %llu: found index %lld in %s, expected 0 to %lld", element->name, row + 1,
                     (unsigned long long)element->count,
                     (long long)ply_load_integer(at, list->type, reading->table->swapped), list->name,
                     (long long)reading->request->item_limit - 1);
}

// Reads the items of one row's list, with their check.
static bool read_items(const struct reading *reading, size_t row, const uint8_t *at, uint32_t count, uint32_t *items,
                       lam_error *error)
{
    enum ply_type type = reading->element->properties[reading->request->list].type;
    bool swapped = reading->table->swapped;
    size_t size = ply_type_size(type);
    for (uint32_t i = 0; i < count; i++, at += size) {
        int64_t item = ply_load_integer(at, type, swapped);
        if (item == -1 && reading->request->restarts)
            items[i] = PLY_RESTART;
        else if (item < 0 || item >= (int64_t)reading->request->item_limit)
            return fail_item(reading, row, at, error);
        else
            items[i] = (uint32_t)item;
    }
    return true;
}

// Three items in each row, at a fixed stride.
static bool read_threes(void *user, size_t index, lam_error *error)
{
    struct reading *reading = user;
    const struct ply_property *list = &reading->element->properties[reading->request->list];
    size_t first, last, count_size = ply_type_size(list->count_type);
    parallel_rows_range(reading->table->count, index, &first, &last);
    const uint8_t *at = reading->first + first * reading->stride + reading->list_offset;
    uint32_t *items = reading->items + 3 * first, limit = reading->request->item_limit;
    bool swapped = reading->table->swapped;

    // One byte and three 32-bit numbers, without a branch. Negative items are above the limit too.
    if (count_size == 1 && ply_type_size(list->type) == 4 && !swapped) {
        uint32_t other = 0, wrong = 0;
        for (size_t row = first; row < last; row++, at += reading->stride, items += 3) {
            uint32_t three[3];
            memcpy(three, at + 1, sizeof three);
            memcpy(items, three, sizeof three);
            other |= at[0] ^ 3u;
            wrong |= (three[0] >= limit) | (three[1] >= limit) | (three[2] >= limit);
        }
        if (other) {
            __atomic_store_n(&reading->mixed, 1, __ATOMIC_RELAXED);
            return true;
        }
        if (!wrong)
            return true;
        at = reading->first + first * reading->stride + reading->list_offset;
        items = reading->items + 3 * first;
    }
    for (size_t row = first; row < last; row++, at += reading->stride, items += 3) {
        if (ply_load_integer(at, list->count_type, swapped) != 3) {
            __atomic_store_n(&reading->mixed, 1, __ATOMIC_RELAXED);
            return true;
        }
        if (!read_items(reading, row, at + count_size, 3, items, error))
            return false;
    }
    return true;
}

// Whether the bytes that are left are what rows with three items each would take, the elements behind included.
static bool may_be_threes(const struct reading *reading, const struct ply_header *header)
{
    const struct ply_element *element = reading->element, *end = header->elements + header->element_count;
    if (reading->request->list < 0 || reading->request->restarts || element->list_count != 1)
        return false;
    uint64_t left = reading->source->size - (size_t)(reading->first - reading->source->bytes);
    const struct ply_property *list = &element->properties[reading->request->list];
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

// Tries that layout. *done: it was it.
static bool try_threes(struct reading *reading, struct arena *keep, struct arena *scratch, bool *done, lam_error *error)
{
    const struct ply_element *element = reading->element;
    int list = reading->request->list;
    size_t count = (size_t)element->count, property_count = (size_t)element->property_count;
    size_t list_bytes =
        ply_type_size(element->properties[list].count_type) + 3 * ply_type_size(element->properties[list].type);
    reading->items = arena_array(keep, count, 3 * sizeof *reading->items);
    uint32_t *offsets = arena_array(scratch, property_count, sizeof *offsets);
    if (!reading->items || !offsets)
        return call_memory_error(reading->source->call, count * 3 * sizeof *reading->items, error);
    reading->list_offset = reading->table->offsets[list];
    reading->stride = element->scalar_bytes + list_bytes;

    lam_error wrong;
    bool good = parallel_rows_run(reading->source, parallel_rows_count(count), read_threes, reading, &wrong);
    if (reading->mixed)
        return true; // what was wrong is judged again, with the rows where they are
    if (!good) {
        if (error)
            *error = wrong;
        return false;
    }
    for (size_t i = 0; i < property_count; i++) // in the file, what stands behind the list is farther on
        offsets[i] = reading->table->offsets[i] + ((int)i > list ? (uint32_t)list_bytes : 0);
    reading->table->offsets = offsets;
    reading->table->stride = reading->stride;
    reading->table->rows = reading->first;
    reading->table->items = reading->items;
    *done = true;
    return true;
}

// Walks over the rows: where each piece begins, how many items each row's list has. *end is behind the last row.
static bool walk(struct reading *reading, bool *threes, const uint8_t **end, lam_error *error)
{
    const struct ply_element *element = reading->element;
    const uint8_t *at = reading->first, *file_end = reading->source->bytes + reading->source->size;
    uint64_t total = 0;
    *threes = true;
    for (size_t row = 0; row < element->count; row++) {
        if (row % PARALLEL_ROWS == 0) {
            if (reading->pieces)
                reading->pieces[row / PARALLEL_ROWS] = at;
            if (!call_should_continue(reading->source->call))
                return call_error(reading->source->call, error);
        }
        if (reading->starts)
            reading->starts[row] = (uint32_t)total;
        for (int i = 0; i < element->property_count; i++) {
            const struct ply_property *property = &element->properties[i];
            size_t size = ply_type_size(property->list ? property->count_type : property->type);
            if ((size_t)(file_end - at) < size)
                return ply_fail_short(reading->source, element, row, error);
            if (property->list) {
                int64_t items = ply_load_integer(at, property->count_type, reading->table->swapped);
                if (items < 0)
                    return fail_byte(error, reading->source, (size_t)(at - reading->source->bytes),
                                     "%s %zu of %llu: found %lld as the number of items of %s, expected 0 or more",
                                     element->name, row + 1, (unsigned long long)element->count, (long long)items,
                                     property->name);
                at += size;
                size = (size_t)items * ply_type_size(property->type); // at most 2³² · 8
                if ((size_t)(file_end - at) < size)
                    return ply_fail_short(reading->source, element, row, error);
                if (i == reading->request->list) {
                    total += (uint64_t)items;
                    *threes &= items == 3;
                }
            }
            at += size;
        }
        if (total >= UINT32_MAX)
            return ply_fail_too_many(reading->source, element, error);
    }
    if (reading->starts)
        reading->starts[element->count] = (uint32_t)total;
    *end = at;
    return true;
}

static bool read_piece(void *user, size_t index, lam_error *error)
{
    const struct reading *reading = user;
    const struct ply_element *element = reading->element;
    size_t first, last;
    parallel_rows_range(reading->table->count, index, &first, &last);
    const uint8_t *at = reading->pieces[index];
    for (size_t row = first; row < last; row++) {
        for (int i = 0; i < element->property_count; i++) {
            const struct ply_property *property = &element->properties[i];
            size_t size = ply_type_size(property->type);
            if (property->list) {
                uint32_t count = (uint32_t)ply_load_integer(at, property->count_type, reading->table->swapped);
                at += ply_type_size(property->count_type);
                if (i == reading->request->list &&
                    !read_items(reading, row, at, count, reading->items + reading->starts[row], error))
                    return false;
                size *= count;
            } else if (reading->rows) {
                memcpy(reading->rows + row * reading->table->stride + reading->table->offsets[i], at, size);
            }
            at += size;
        }
    }
    return true;
}

static bool read_lists(struct reading *reading, struct arena *keep, struct arena *scratch, const uint8_t **end,
                       lam_error *error)
{
    struct ply_table *table = reading->table;
    const struct ply_request *request = reading->request;
    size_t pieces = parallel_rows_count(table->count);
    reading->pieces = arena_array(scratch, pieces, sizeof *reading->pieces);
    if (!reading->pieces)
        return call_memory_error(reading->source->call, pieces * sizeof *reading->pieces, error);
    if (request->list >= 0) {
        reading->starts = arena_array(scratch, table->count + 1, sizeof *reading->starts);
        if (!reading->starts)
            return call_memory_error(reading->source->call, table->count * sizeof *reading->starts, error);
    }
    bool threes;
    if (!walk(reading, &threes, end, error))
        return false;
    threes = threes && !request->restarts;
    if (request->list >= 0) {
        size_t total = reading->starts[table->count];
        reading->items = arena_array(threes ? keep : scratch, total, sizeof *reading->items);
        if (!reading->items)
            return call_memory_error(reading->source->call, total * sizeof *reading->items, error);
    }
    if (request->scalars) {
        reading->rows = arena_array(scratch, table->count, table->stride);
        if (!reading->rows)
            return call_memory_error(reading->source->call, table->count * table->stride, error);
    }
    if (!parallel_rows_run(reading->source, pieces, read_piece, reading, error))
        return false;
    table->rows = reading->rows;
    table->items = reading->items;
    table->starts = threes ? NULL : reading->starts;
    return true;
}

bool ply_read_binary(const struct import_source *source, const struct ply_header *header,
                     const struct ply_element *element, const struct ply_request *request, struct arena *keep,
                     struct arena *scratch, size_t *at, struct ply_table *table, lam_error *error)
{
    // Nothing is asked for before the bytes that it would come from are known to be there.
    uint64_t left = source->size - *at;
    if (element->min_bytes > 0 && element->count > left / element->min_bytes)
        return ply_fail_short(source, element, left / element->min_bytes, error);

    static const struct ply_request nothing = {.list = -1};
    struct ply_table unused = {0};
    bool skip = !table;
    table = skip ? &unused : table;
    *table = (struct ply_table){.element = element, .count = (size_t)element->count};
    bool big = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    table->swapped = (header->format == PLY_BIG) != big;
    struct reading reading = {.source = source, .element = element, .request = skip ? &nothing : request};
    reading.table = table;
    reading.first = source->bytes + *at;

    if (element->list_count == 0) {
        *at += table->count * element->scalar_bytes;
        table->rows = reading.first;
        return skip || ply_plan_rows(source, request, scratch, table, error);
    }
    const uint8_t *end = source->bytes + source->size;
    bool done = false;
    if (skip) {
        bool threes;
        if (!walk(&reading, &threes, &end, error))
            return false;
    } else {
        if (!ply_plan_rows(source, request, scratch, table, error))
            return false;
        if (may_be_threes(&reading, header) && !try_threes(&reading, keep, scratch, &done, error))
            return false;
        if (!done && !read_lists(&reading, keep, scratch, &end, error))
            return false;
        if (done)
            end = reading.first + table->count * reading.stride;
    }
    *at = (size_t)(end - source->bytes);
    return true;
}
