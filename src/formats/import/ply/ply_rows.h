// ply_rows.h: reads the rows of one element, for ply_ascii.c and ply_binary.c. A serial pass finds the start of each
// chunk of rows and the lengths of the chunk's lists; then the chunks are read in parallel.
#ifndef PLY_ROWS_H
#define PLY_ROWS_H

#include "parallel_rows.h"
#include "ply.h"

struct ply_reader {
    const struct import_source *source;
    const struct ply_element *element;
    const struct ply_request *request;
    struct ply_table *table;
    const uint8_t *first;     // row 0, if it is in memory
    const uint8_t **chunks;   // start of each chunk
    uint32_t *items, *starts; // the contents of the requested list (ply_table)
    float *wedges;
    uint8_t *rows;         // scalars; NULL if not requested
    uint64_t total;        // items so far (ply_table.items)
    bool has_other_counts; // a row contains more or fewer than three items
    // ply_ascii.c
    const uint8_t *end; // the end of the file
    size_t indexed;     // number of rows that index_rows has read without error
    // ply_binary.c
    size_t offset; // the offset of row 0 in the file
    size_t list_offset;
    uint8_t *marks; // one byte per vertex (mesh_mark_vertices), or NULL if there are more vertices than items
    int mixed;      // atomic; set if a row contains more or fewer than the expected three items
};

// Allocates the arrays that the serial pass fills.
bool ply_start_rows(struct ply_reader *reader, struct arena *scratch, lam_error *error);

// Records the start of the chunk that begins with this row. Returns false if the call is cancelled or out of time.
bool ply_index_chunk(struct ply_reader *reader, size_t row, const uint8_t *at, lam_error *error);
// Records the start of a row in the serial pass. Returns false if the call is cancelled or out of time.
static inline bool ply_index_row(struct ply_reader *reader, size_t row, const uint8_t *at, lam_error *error)
{
    if (reader->starts)
        reader->starts[row] = (uint32_t)reader->total;
    return row % PARALLEL_ROWS != 0 || ply_index_chunk(reader, row, at, error);
}
// Records the length of a row's requested list in the serial pass.
static inline void ply_count_items(struct ply_reader *reader, int64_t items)
{
    reader->total += items < 3 ? 0 : 3 * ((uint64_t)items - 2);
    reader->has_other_counts |= items != 3;
}

// Stores number `index` of `count` in a row's list of texture coordinates. Numbers without a corner are ignored, and lists
// of another length than two numbers for each corner are counted.
static inline void ply_put_wedge(const struct ply_reader *reader, size_t row, size_t index, size_t count, float number)
{
    size_t start = reader->starts[row], room = reader->starts[row + 1] - start;
    size_t numbers = room ? 2 * (room / 3 + 2) : 0;
    if (index < numbers)
        reader->wedges[2 * start + index] = number;
    if (index == 0 && numbers && count != numbers)
        __atomic_add_fetch(&reader->table->odd_wedges, 1, __ATOMIC_RELAXED);
}

// Reads the rows after the serial pass and fills the table.
bool ply_read_rows(struct ply_reader *reader, parallel_rows_task *read_chunk, struct arena *keep, struct arena *scratch,
                   lam_error *error);

#endif
