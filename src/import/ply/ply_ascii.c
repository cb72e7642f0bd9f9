// ply_ascii.c: the rows of one element of an ASCII PLY, as if they had been binary.
//
// Numbers are separated by white space of any kind, so a row need not be a line. A first walk finds where
// each piece of rows begins and how long its lists are; then the pieces are read in parallel.
#include "parallel_rows.h"
#include "fail.h"
#include "number.h"
#include "ply.h"
#include "text_cursor.h"

#include <stdio.h>
#include <string.h>

struct reading {
    const struct import_source *source;
    const struct ply_element *element;
    const struct ply_request *request;
    struct ply_table *table;
    const uint8_t *first, *end; // where the rows begin; the file's end
    const uint8_t **pieces;     // where each piece begins
    uint32_t *items, *starts;   // of the list that was asked for
    uint8_t *rows;              // scalars; NULL: not wanted
};

static bool fail_number(const struct reading *reading, size_t row, int property, const uint8_t *at,
                        const char *expected, lam_error *error)
{
    if (!error)
        return false;
    char found[TEXT_FOUND_SIZE];
    return fail_line(error, reading->source, text_line(reading->source->bytes, at),
                     "%s %zu of %llu: found %s as %s, expected %s", reading->element->name, row + 1,
                     (unsigned long long)reading->element->count, text_found(at, reading->end, found),
                     reading->element->properties[property].name, expected);
}

// Reads a whole number that fills its word; NULL: there is none.
static const uint8_t *read_integer(const struct reading *reading, const uint8_t *at, int64_t *value)
{
    const uint8_t *next = number_int(at, reading->end, value);
    return next && (next == reading->end || text_white(*next)) ? next : NULL;
}

// Reads one scalar as it would lie in a binary file; NULL for an error, which is then filled.
static const uint8_t *read_scalar(const struct reading *reading, size_t row, int property, const uint8_t *at,
                                  uint8_t *out, lam_error *error)
{
    static const struct {
        int64_t min, max;
        const char *expected;
    } ranges[] = {
        [PLY_I8] = {-128, 127, "a whole number from -128 to 127"},
        [PLY_U8] = {0, 255, "a whole number from 0 to 255"},
        [PLY_I16] = {-32768, 32767, "a whole number from -32768 to 32767"},
        [PLY_U16] = {0, 65535, "a whole number from 0 to 65535"},
        [PLY_I32] = {INT32_MIN, INT32_MAX, "a whole number from -2147483648 to 2147483647"},
        [PLY_U32] = {0, UINT32_MAX, "a whole number from 0 to 4294967295"},
    };
    enum ply_type type = reading->table->types[property];
    const uint8_t *next;
    if (type == PLY_F32 || type == PLY_F64) {
        float narrow = 0.0f;
        double wide = 0.0;
        next = type == PLY_F32 ? number_float(at, reading->end, &narrow) : number_double(at, reading->end, &wide);
        if (!next || (next < reading->end && !text_white(*next))) {
            fail_number(reading, row, property, at, "a number", error);
            return NULL;
        }
        memcpy(out, type == PLY_F32 ? (const void *)&narrow : &wide, ply_type_size(type));
        return next;
    }
    int64_t value = 0;
    next = read_integer(reading, at, &value);
    if (!next || value < ranges[type].min || value > ranges[type].max) {
        fail_number(reading, row, property, at, ranges[type].expected, error);
        return NULL;
    }
    // Two's complement, cut to the type's size.
    uint8_t value8 = (uint8_t)value;
    uint16_t value16 = (uint16_t)value;
    uint32_t value32 = (uint32_t)value;
    size_t size = ply_type_size(type);
    memcpy(out, size == 1 ? (const void *)&value8 : size == 2 ? (const void *)&value16 : &value32, size);
    return next;
}

static const uint8_t *read_item(const struct reading *reading, size_t row, const uint8_t *at, uint32_t *item,
                                lam_error *error)
{
    int64_t value = 0;
    const uint8_t *next = read_integer(reading, at, &value);
    if (next && value == -1 && reading->request->restarts) {
        *item = PLY_RESTART;
    } else if (!next || value < 0 || value >= (int64_t)reading->request->item_limit) {
        char expected[48];
        snprintf(expected, sizeof expected, "an index from 0 to %u", reading->request->item_limit - 1);
        fail_number(reading, row, reading->request->list, at, expected, error);
        return NULL;
    } else {
        *item = (uint32_t)value;
    }
    return next;
}

// Walks over the rows: where each piece begins, how many items each row's list has. *at ends behind the last row.
static bool walk(struct reading *reading, bool *threes, const uint8_t **at, lam_error *error)
{
    const struct ply_element *element = reading->element;
    const uint8_t *word = reading->first, *end = reading->end;
    uint64_t total = 0;
    *threes = true;
    for (size_t row = 0; row < element->count && element->property_count > 0; row++) {
        if (row % PARALLEL_ROWS == 0) {
            if (reading->pieces)
                reading->pieces[row / PARALLEL_ROWS] = word;
            if (!call_should_continue(reading->source->call))
                return call_error(reading->source->call, error);
        }
        if (reading->starts)
            reading->starts[row] = (uint32_t)total;
        for (int i = 0; i < element->property_count; i++) {
            word = text_skip_white(word, end);
            if (word == end)
                return ply_fail_short(reading->source, element, row, error);
            const uint8_t *next = text_skip_word(word, end);
            if (element->properties[i].list) {
                int64_t items = 0;
                if (!read_integer(reading, word, &items) || items < 0)
                    return fail_number(reading, row, i, word, "the number of its items", error);
                if (items > (end - next) / 2) // each takes a space and a digit at least
                    return ply_fail_short(reading->source, element, row, error);
                for (int64_t item = 0; item < items; item++) {
                    next = text_skip_white(next, end);
                    if (next == end)
                        return ply_fail_short(reading->source, element, row, error);
                    next = text_skip_word(next, end);
                }
                if (i == reading->request->list) {
                    total += (uint64_t)items;
                    *threes &= items == 3;
                }
            }
            word = next;
        }
        if (total >= UINT32_MAX)
            return ply_fail_too_many(reading->source, element, error);
    }
    if (reading->starts)
        reading->starts[element->count] = (uint32_t)total;
    *at = word;
    return true;
}

static bool read_piece(void *user, size_t index, lam_error *error)
{
    const struct reading *reading = user;
    const struct ply_element *element = reading->element;
    size_t first, last;
    parallel_rows_range(reading->table->count, index, &first, &last);
    const uint8_t *at = reading->pieces[index], *end = reading->end;
    for (size_t row = first; row < last; row++) {
        for (int i = 0; i < element->property_count; i++) {
            at = text_skip_white(at, end);
            if (!element->properties[i].list) {
                if (!reading->rows) {
                    at = text_skip_word(at, end);
                    continue;
                }
                at = read_scalar(reading, row, i, at,
                                 reading->rows + row * reading->table->stride + reading->table->offsets[i], error);
                if (!at)
                    return false;
                continue;
            }
            int64_t count = 0;
            at = read_integer(reading, at, &count); // the walk has seen it
            for (int64_t item = 0; item < count; item++) {
                at = text_skip_white(at, end);
                if (i != reading->request->list)
                    at = text_skip_word(at, end);
                else if (!(at = read_item(reading, row, at, &reading->items[reading->starts[row] + item], error)))
                    return false;
            }
        }
    }
    return true;
}

static bool read_rows(struct reading *reading, struct arena *keep, struct arena *scratch, const uint8_t **at,
                      lam_error *error)
{
    struct ply_table *table = reading->table;
    const struct ply_request *request = reading->request;
    struct call_control *call = reading->source->call;
    size_t pieces = parallel_rows_count(table->count);
    if (!ply_plan_rows(reading->source, request, scratch, table, error))
        return false;
    reading->pieces = arena_array(scratch, pieces, sizeof *reading->pieces);
    if (!reading->pieces)
        return call_memory_error(call, pieces * sizeof *reading->pieces, error);
    if (request->list >= 0) {
        reading->starts = arena_array(scratch, table->count + 1, sizeof *reading->starts);
        if (!reading->starts)
            return call_memory_error(call, table->count * sizeof *reading->starts, error);
    }
    bool threes;
    if (!walk(reading, &threes, at, error))
        return false;
    threes = threes && !request->restarts;
    if (request->list >= 0) {
        size_t total = reading->starts[table->count];
        reading->items = arena_array(threes ? keep : scratch, total, sizeof *reading->items);
        if (!reading->items)
            return call_memory_error(call, total * sizeof *reading->items, error);
    }
    if (request->scalars) {
        reading->rows = arena_array(scratch, table->count, table->stride);
        if (!reading->rows)
            return call_memory_error(call, table->count * table->stride, error);
    }
    if (!parallel_rows_run(reading->source, pieces, read_piece, reading, error))
        return false;
    table->rows = reading->rows;
    table->items = reading->items;
    table->starts = threes ? NULL : reading->starts;
    return true;
}

bool ply_read_ascii(const struct import_source *source, const struct ply_element *element,
                    const struct ply_request *request, struct arena *keep, struct arena *scratch, size_t *at,
                    struct ply_table *table, lam_error *error)
{
    // Nothing is asked for before the bytes that it would come from are known to be there: a number takes
    // two, a digit and white space, which only the last one can lack.
    uint64_t left = (uint64_t)(source->size - *at) + 1, row_bytes = 2 * (uint64_t)element->property_count;
    if (row_bytes > 0 && element->count > left / row_bytes)
        return ply_fail_short(source, element, left / row_bytes, error);

    static const struct ply_request nothing = {.list = -1};
    struct reading reading = {.source = source, .element = element, .request = table ? request : &nothing};
    reading.table = table;
    reading.first = source->bytes + *at;
    reading.end = source->bytes + source->size;
    const uint8_t *end = reading.first;
    if (table) {
        *table = (struct ply_table){.element = element, .count = (size_t)element->count};
        if (!read_rows(&reading, keep, scratch, &end, error))
            return false;
    } else {
        bool threes;
        if (!walk(&reading, &threes, &end, error))
            return false;
    }
    *at = (size_t)(end - source->bytes);
    return true;
}
