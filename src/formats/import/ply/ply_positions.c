// ply_positions.c: copies the positions of a PLY table: floats unchanged, doubles relative to an origin.
#include "parallel_rows.h"
#include "fail.h"
#include "origin.h"
#include "ply_load.h"

#include <float.h>

struct positions {
    const struct import_source *source;
    const struct ply_table *table;
    int properties[3];
    bool contiguous; // ply_contiguous
    float *out;
    struct box {
        double minimum[3], maximum[3];
    } *boxes; // one box per chunk
    double origin[3];
};

static double position_at(const struct positions *positions, const uint8_t *row, int axis)
{
    const struct ply_table *table = positions->table;
    int property = positions->properties[axis];
    return ply_load_double(row + table->offsets[property], table->types[property], table->swapped);
}

// scene_repair leaves out the faces of vertices that do not fit into floats.
static bool fits_float(double value) { return value >= -(double)FLT_MAX && value <= (double)FLT_MAX; }

// Copies floats, and integers that floats represent exactly.
static bool copy_chunk(void *user, size_t index, const uint8_t *rows, lam_error *error)
{
    const struct positions *positions = user;
    const struct ply_table *table = positions->table;
    size_t first, last;
    parallel_rows_range(table->rows.count, index, &first, &last);
    float *out = positions->out + 3 * first;
    size_t stride = table->rows.stride;
    (void)error;
    if (positions->contiguous && stride == 3 * sizeof(float)) {
        memcpy(out, rows, (last - first) * stride);
    } else if (positions->contiguous) {
        const uint8_t *at = rows + table->offsets[positions->properties[0]];
        for (size_t row = first; row < last; row++, at += stride, out += 3)
            memcpy(out, at, 3 * sizeof(float));
    } else {
        for (int axis = 0; axis < 3; axis++)
            ply_copy_column(table, positions->properties[axis], rows, last - first, 1.0f, out + axis, 3);
    }
    // only for an ASCII file; choose_origin needs the boxes
    for (int axis = 0; positions->boxes && axis < 3; axis++) {
        float minimum = FLT_MAX, maximum = -FLT_MAX;
        for (size_t row = first; row < last; row++) {
            float value = positions->out[3 * row + (size_t)axis];
            minimum = value < minimum && value >= -FLT_MAX ? value : minimum;
            maximum = value > maximum && value <= FLT_MAX ? value : maximum;
        }
        positions->boxes[index].minimum[axis] = (double)minimum;
        positions->boxes[index].maximum[axis] = (double)maximum;
    }
    return true;
}

// Doubles and 32-bit integers need two passes. The first pass computes their bounding box, which determines the origin.
// The second pass rounds the positions to floats.
static bool measure_chunk(void *user, size_t index, const uint8_t *at, lam_error *error)
{
    const struct positions *positions = user;
    size_t first, last;
    parallel_rows_range(positions->table->rows.count, index, &first, &last);
    struct box box = {{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}};
    (void)error;
    for (size_t row = first; row < last; row++, at += positions->table->rows.stride) {
        for (int axis = 0; axis < 3; axis++) {
            double value = position_at(positions, at, axis);
            bool fits = fits_float(value);
            box.minimum[axis] = fits && value < box.minimum[axis] ? value : box.minimum[axis];
            box.maximum[axis] = fits && value > box.maximum[axis] ? value : box.maximum[axis];
        }
    }
    positions->boxes[index] = box;
    return true;
}

static bool round_chunk(void *user, size_t index, const uint8_t *at, lam_error *error)
{
    const struct positions *positions = user;
    size_t first, last;
    (void)error;
    parallel_rows_range(positions->table->rows.count, index, &first, &last);
    for (size_t row = first; row < last; row++, at += positions->table->rows.stride) {
        for (int axis = 0; axis < 3; axis++) {
            double value = position_at(positions, at, axis) - positions->origin[axis];
            positions->out[3 * row + (size_t)axis] = fits_float(value) ? (float)value : __builtin_nanf("");
        }
    }
    return true;
}

// Merges the chunks' boxes and chooses the origin. Returns true if the positions must be read as doubles, because
// floats are too imprecise.
static bool choose_origin(struct positions *positions, size_t chunks)
{
    struct box all = positions->boxes[0];
    for (size_t i = 1; i < chunks; i++) {
        const struct box *box = &positions->boxes[i];
        for (int axis = 0; axis < 3; axis++) {
            if (box->minimum[axis] < all.minimum[axis])
                all.minimum[axis] = box->minimum[axis];
            if (box->maximum[axis] > all.maximum[axis])
                all.maximum[axis] = box->maximum[axis];
        }
    }
    return origin_choose(all.minimum, all.maximum, positions->origin);
}

bool ply_positions(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                   lam_mesh *mesh, bool *needs_doubles, lam_error *error)
{
    static const char *const names[] = {"x", "y", "z"};
    struct positions positions = {.source = source, .table = table};
    *needs_doubles = false;
    if (!ply_find_all(table, names, 3, positions.properties)) {
        int missing = positions.properties[0] < 0 ? 0 : positions.properties[1] < 0 ? 1 : 2;
        return fail_line(error, source, table->element->line, "element vertex has no property %s, expected x, y and z",
                         names[missing]);
    }
    size_t count = table->rows.count, chunks = parallel_rows_count(count);
    if (count > UINT32_MAX - 1)
        return ply_fail_too_many(source, table->element, error);
    bool exact = false;
    for (int axis = 0; axis < 3; axis++) {
        enum ply_type type = table->types[positions.properties[axis]];
        exact |= type == PLY_I32 || type == PLY_U32 || type == PLY_F64;
    }
    positions.contiguous = ply_contiguous(table, positions.properties, 3);
    positions.out = arena_array(arena, count, 3 * sizeof(float));
    if (!positions.out)
        return call_memory_error(source->call, count * 3 * sizeof(float), error);

    struct arena scratch;
    arena_start(&scratch, source->call);
    bool done = true;
    if (exact || table->positions == PLY_AS_FLOAT) {
        positions.boxes = arena_array(&scratch, chunks, sizeof *positions.boxes);
        done = positions.boxes || call_memory_error(source->call, chunks * sizeof *positions.boxes, error);
    }
    if (exact) {
        done = done && parallel_rows_read(source, &table->rows, measure_chunk, &positions, error);
        if (done && chunks > 0)
            choose_origin(&positions, chunks);
        done = done && parallel_rows_read(source, &table->rows, round_chunk, &positions, error);
    } else {
        done = done && parallel_rows_read(source, &table->rows, copy_chunk, &positions, error);
        *needs_doubles = done && positions.boxes && chunks > 0 && choose_origin(&positions, chunks);
    }
    arena_free(&scratch);
    memcpy(mesh->origin, positions.origin, sizeof mesh->origin);
    mesh->positions = positions.out;
    mesh->vertex_count = (uint32_t)count;
    return done;
}
