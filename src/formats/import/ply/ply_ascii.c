// ply_ascii.c: converts the rows of one element of an ASCII PLY to a table of binary rows.
//
// Numbers are separated by white space, and a row may continue on the next line. A row ends at the end of the line that
// contains its last number; further numbers on that line are ignored. A serial pass first finds the start of each chunk
// of rows and the lengths of the lists in the chunk. The chunks are then read in parallel.
#include "fail.h"
#include "number.h"
#include "ply_rows.h"
#include "text_cursor.h"

#include <stdio.h>
#include <string.h>

static bool fail_number(const struct ply_reader *reader, size_t row, int property, const uint8_t *at,
                        const char *expected, lam_error *error)
{
    if (!error)
        return false;
    char found[TEXT_FOUND_SIZE], shown[2][SHOWN_NAME_SIZE];
    return fail_line(error, reader->source, text_line(reader->source->bytes, at),
                     "%s %zu of %llu: found %s as %s, expected %s", shown_name(reader->element->name, shown[0]),
                     row + 1, (unsigned long long)reader->element->count, text_found(at, reader->end, found),
                     shown_name(reader->element->properties[property].name, shown[1]), expected);
}

// Reads a word as an integer. Returns NULL if the word is not an integer.
static const uint8_t *read_integer(const struct ply_reader *reader, const uint8_t *at, int64_t *value)
{
    const uint8_t *next = number_int(at, reader->end, value);
    return next && (next == reader->end || text_white(*next)) ? next : NULL;
}

// Reads one scalar and writes it in binary. Returns NULL on error.
static const uint8_t *read_scalar(const struct ply_reader *reader, size_t row, int property, const uint8_t *at,
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
    enum ply_type type = reader->table->types[property];
    const uint8_t *next;
    if (type == PLY_F32 || type == PLY_F64) {
        float narrow = 0.0f;
        double wide = 0.0;
        next = type == PLY_F32 ? number_float(at, reader->end, &narrow) : number_double(at, reader->end, &wide);
        if (!next || (next < reader->end && !text_white(*next)))
            return fail_number(reader, row, property, at, "a number", error), NULL;
        memcpy(out, type == PLY_F32 ? (const void *)&narrow : &wide, ply_type_size(type));
        return next;
    }
    int64_t value = 0;
    next = read_integer(reader, at, &value);
    if (!next || value < ranges[type].min || value > ranges[type].max)
        return fail_number(reader, row, property, at, ranges[type].expected, error), NULL;
    // The conversions keep the low bytes of the two's complement.
    uint8_t value8 = (uint8_t)value;
    uint16_t value16 = (uint16_t)value;
    uint32_t value32 = (uint32_t)value;
    size_t size = ply_type_size(type);
    memcpy(out, size == 1 ? (const void *)&value8 : size == 2 ? (const void *)&value16 : &value32, size);
    return next;
}

static const uint8_t *read_item(const struct ply_reader *reader, size_t row, const uint8_t *at, uint32_t *item,
                                lam_error *error)
{
    int64_t value = 0;
    const uint8_t *next = read_integer(reader, at, &value);
    if (next && value == -1 && reader->request->restarts) {
        *item = PLY_RESTART;
    } else if (!next || value < 0 || value >= (int64_t)reader->request->item_limit) {
        char expected[48];
        snprintf(expected, sizeof expected, "an index from 0 to %u", reader->request->item_limit - 1);
        fail_number(reader, row, reader->request->list, at, expected, error);
        return NULL;
    } else {
        *item = (uint32_t)value;
    }
    return next;
}

// Returns the first word on the rest of the line, or NULL if there is none.
static const uint8_t *rest_of_line(const uint8_t *at, const uint8_t *end)
{
    while (at < end && text_white(*at) && *at != '\n' && *at != '\r')
        at++;
    return at < end && !text_white(*at) ? at : NULL;
}

static bool fail_rest(const struct ply_reader *reader, size_t row, const uint8_t *rest, lam_error *error)
{
    const struct ply_element *element = reader->element;
    char found[TEXT_FOUND_SIZE], shown[2][SHOWN_NAME_SIZE];
    return fail_line(error, reader->source, text_line(reader->source->bytes, rest),
                     "%s %zu of %llu: found %s after %s, its last property, expected the end of the line",
                     shown_name(element->name, shown[0]), row + 1, (unsigned long long)element->count,
                     text_found(rest, reader->end, found),
                     shown_name(element->properties[element->property_count - 1].name, shown[1]));
}

// Runs the serial pass: finds the start of each chunk and of each row's list, and sets *at to the end of the last row.
static bool index_rows(struct ply_reader *reader, const uint8_t **at, lam_error *error)
{
    const struct ply_element *element = reader->element;
    const uint8_t *word = reader->first, *end = reader->end;
    for (size_t row = 0; row < element->count && element->property_count > 0; row++) {
        reader->indexed = row;
        if (!ply_index_row(reader, row, word, error))
            return false;
        for (int i = 0; i < element->property_count; i++) {
            word = text_skip_white(word, end);
            if (word == end)
                return ply_fail_truncated(reader->source, element, row, true, error);
            const uint8_t *next = text_skip_word(word, end);
            if (element->properties[i].list) {
                int64_t items = 0;
                if (!read_integer(reader, word, &items) || items < 0)
                    return fail_number(reader, row, i, word, "the number of items", error);
                if (items > (end - next) / 2) // each item needs at least two bytes
                    return ply_fail_truncated(reader->source, element, row, true, error);
                for (int64_t item = 0; item < items; item++) {
                    next = text_skip_white(next, end);
                    if (next == end)
                        return ply_fail_truncated(reader->source, element, row, true, error);
                    next = text_skip_word(next, end);
                }
                if (i == reader->request->list)
                    ply_count_items(reader, items);
            }
            word = next;
        }
        const uint8_t *rest = rest_of_line(word, end);
        if (rest)
            return fail_rest(reader, row, rest, error);
        if (reader->total >= UINT32_MAX)
            return ply_fail_too_many(reader->source, element, error);
    }
    *at = word;
    return true;
}

// Reads a row and returns its end, or NULL on error. If `scalars` and `items` are NULL, the numbers are only checked.
static const uint8_t *read_row(const struct ply_reader *reader, size_t row, const uint8_t *at, uint8_t *scalars,
                               uint32_t *items, lam_error *error)
{
    const struct ply_element *element = reader->element;
    const uint8_t *end = reader->end;
    uint8_t unused[8];
    uint32_t unused_item; // also set for a row without triangles
    for (int i = 0; at && i < element->property_count; i++) {
        at = text_skip_white(at, end);
        if (!element->properties[i].list) {
            at = !reader->request->scalars
                     ? text_skip_word(at, end)
                     : read_scalar(reader, row, i, at, scalars ? scalars + reader->table->offsets[i] : unused, error);
            continue;
        }
        int64_t count = 0;
        at = read_integer(reader, at, &count); // index_rows has checked the count
        bool kept = items && count >= 3;
        for (int64_t item = 0; at && item < count; item++) {
            at = text_skip_white(at, end);
            if (&element->properties[i] == reader->request->wedges && reader->wedges) {
                float number = 0;
                if (!number_float(at, end, &number))
                    return fail_number(reader, row, i, at, "a number", error), NULL;
                ply_put_wedge(reader, row, (size_t)item, (size_t)count, number);
            }
            at = i != reader->request->list ? text_skip_word(at, end)
                                            : read_item(reader, row, at, kept ? &items[item] : &unused_item, error);
        }
    }
    return at;
}

static bool read_chunk(void *user, size_t index, lam_error *error)
{
    const struct ply_reader *reader = user;
    size_t first, last;
    if (reader->element->property_count == 0)
        return true; // rows without properties have no text
    parallel_rows_range(reader->table->rows.count, index, &first, &last);
    const uint8_t *at = reader->chunks[index];
    for (size_t row = first; at && row < last; row++)
        at = read_row(reader, row, at, reader->rows ? reader->rows + row * reader->table->rows.stride : NULL,
                      reader->items ? reader->items + reader->starts[row] : NULL, error);
    return at != NULL;
}

// Call this function after an error of index_rows. If an earlier row contains an invalid number, this function reports
// the earlier error instead.
static void check_rows_before(const struct ply_reader *reader, lam_error *error)
{
    const uint8_t *at = reader->first;
    if (error && error->code == LAM_CANNOT_READ)
        for (size_t row = 0; at && row < reader->indexed; row++)
            at = read_row(reader, row, at, NULL, NULL, error);
}

static bool read_rows(struct ply_reader *reader, struct arena *keep, struct arena *scratch, const uint8_t **at,
                      lam_error *error)
{
    if (!ply_plan_rows(reader->source, reader->request, scratch, reader->table, error) ||
        !ply_start_rows(reader, scratch, error))
        return false;
    if (!index_rows(reader, at, error)) {
        check_rows_before(reader, error);
        return false;
    }
    return ply_read_rows(reader, read_chunk, keep, scratch, error);
}

bool ply_read_ascii(const struct import_source *source, const struct ply_element *element,
                    const struct ply_request *request, size_t *at, struct ply_table *table, lam_error *error)
{
    // Check the file's size before any allocation: each number needs at least two bytes (a digit and white space). Only
    // the last number may lack the white space.
    uint64_t left = (uint64_t)(source->size - *at) + 1, row_bytes = 2 * (uint64_t)element->property_count;
    if (row_bytes > 0 && element->count > left / row_bytes)
        return ply_fail_truncated(source, element, left / row_bytes, false, error);

    static const struct ply_request nothing = {.list = -1};
    struct ply_reader reader = {.source = source, .element = element, .request = table ? request : &nothing};
    reader.table = table;
    reader.first = source->bytes + *at;
    reader.end = source->bytes + source->size;
    const uint8_t *end = reader.first;
    if (table) {
        *table = (struct ply_table){.element = element, .rows.count = (size_t)element->count};
        if (!read_rows(&reader, request->keep, request->scratch, &end, error))
            return false;
    } else if (!index_rows(&reader, &end, error)) {
        return false;
    }
    *at = (size_t)(end - source->bytes);
    return true;
}
