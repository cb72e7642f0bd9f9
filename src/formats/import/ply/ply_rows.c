// ply_rows.c: functions shared by the readers of ASCII and binary rows.
#include "ply_rows.h"

#include "fail.h"
#include "ply_load.h"
#include "shown_name.h"

bool ply_fail_truncated(const struct import_source *source, const struct ply_element *element, uint64_t row, bool exact,
                        lam_error *error)
{
    char shown[SHOWN_NAME_SIZE];
    return fail(error, LAM_CANNOT_READ,
                "%s: the file is truncated: its header declares %llu rows of element \"%s\", found %s%llu in %zu bytes",
                source->name, (unsigned long long)element->count, shown_name(element->name, shown),
                exact || !row ? "" : "at most ", (unsigned long long)row, source->parts.size);
}

bool ply_fail_too_many(const struct import_source *source, const struct ply_element *element, lam_error *error)
{
    char shown[SHOWN_NAME_SIZE];
    return fail(error, LAM_LIMIT, "%s: element \"%s\" has too many rows or list items, expected at most %u",
                source->name, shown_name(element->name, shown), UINT32_MAX - 1);
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
    table->rows.stride = 0;
    for (size_t i = 0; i < count; i++) {
        const struct ply_property *property = &element->properties[i];
        bool position = !property->list && property->name[0] >= 'x' && property->name[0] <= 'z' && !property->name[1];
        types[i] = property->type;
        if (position && request->positions != PLY_AS_DECLARED)
            types[i] = request->positions == PLY_AS_FLOAT ? PLY_F32 : PLY_F64;
        offsets[i] = (uint32_t)table->rows.stride;
        table->rows.stride += property->list ? 0 : ply_type_size(types[i]);
    }
    table->offsets = offsets;
    table->types = types;
    table->positions = request->positions;
    return true;
}

bool ply_start_rows(struct ply_reader *reader, struct arena *scratch, lam_error *error)
{
    struct call_control *call = reader->source->call;
    size_t count = reader->table->rows.count, chunks = parallel_rows_count(count);
    reader->chunks = arena_array(scratch, chunks, sizeof *reader->chunks);
    if (!reader->chunks)
        return call_memory_error(call, chunks * sizeof *reader->chunks, error);
    if (reader->request->list >= 0) {
        reader->starts = arena_array(scratch, count + 1, sizeof *reader->starts);
        if (!reader->starts)
            return call_memory_error(call, count * sizeof *reader->starts, error);
    }
    return true;
}

bool ply_index_chunk(struct ply_reader *reader, size_t row, const uint8_t *at, lam_error *error)
{
    if (reader->chunks)
        reader->chunks[row / PARALLEL_ROWS] = at;
    return call_should_continue(reader->source->call) || call_error(reader->source->call, error);
}

bool ply_read_rows(struct ply_reader *reader, parallel_rows_task *read_chunk, struct arena *keep, struct arena *scratch,
                   lam_error *error)
{
    struct ply_table *table = reader->table;
    struct call_control *call = reader->source->call;
    size_t count = table->rows.count;
    if (reader->request->list >= 0) {
        size_t total = (size_t)reader->total;
        reader->starts[count] = (uint32_t)total;
        reader->items = arena_array(reader->request->restarts ? scratch : keep, total, sizeof *reader->items);
        if (!reader->items)
            return call_memory_error(call, total * sizeof *reader->items, error);
    }
    if (reader->request->wedges) {
        table->wedges = reader->wedges = arena_alloc_zeroed(keep, 2 * (size_t)reader->total * sizeof(float));
        if (!reader->wedges)
            return call_memory_error(call, 2 * (size_t)reader->total * sizeof(float), error);
    }
    if (reader->request->scalars) {
        table->rows.memory = reader->rows = arena_array(scratch, count, table->rows.stride);
        if (!reader->rows)
            return call_memory_error(call, count * table->rows.stride, error);
    }
    if (!parallel_rows_run(reader->source, parallel_rows_count(count), read_chunk, reader, error))
        return false;
    table->items = reader->items;
    table->starts = reader->has_other_counts || reader->request->restarts ? reader->starts : NULL;
    return true;
}
