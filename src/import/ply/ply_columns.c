// ply_columns.c: converts columns of a PLY table to normals, tangents, texture coordinates and colours, in parallel
// chunks.
#include "parallel_rows.h"
#include "srgb.h"
#include "linear.h"
#include "ply_load.h"

#include <float.h>

void ply_copy_column(const struct ply_table *table, int property, size_t first, size_t last, float divisor, float *out,
                     size_t step)
{
    const uint8_t *at = table->rows + first * table->stride + table->offsets[property];
    size_t stride = table->stride;
    bool swapped = table->swapped;
#define COLUMN(LOAD)                                                                                                   \
    for (size_t row = first; row < last; row++, at += stride, out += step)                                             \
        *out = (float)(LOAD) / divisor;                                                                                \
    break
    switch (table->types[property]) {
    case PLY_I8:
        COLUMN((int8_t)*at);
    case PLY_U8:
        COLUMN(*at);
    case PLY_I16:
        COLUMN((int16_t)ply_load_16(at, swapped));
    case PLY_U16:
        COLUMN(ply_load_16(at, swapped));
    case PLY_I32:
        COLUMN((int32_t)ply_load_32(at, swapped));
    case PLY_U32:
        COLUMN(ply_load_32(at, swapped));
    case PLY_F64:
        COLUMN(ply_load_f64(at, swapped));
    default:
        COLUMN(ply_load_f32(at, swapped));
    }
#undef COLUMN
}

bool ply_contiguous(const struct ply_table *table, const int *properties, int count)
{
    for (int i = 0; i < count; i++) {
        if (properties[i] < 0 || table->types[properties[i]] != PLY_F32 || table->swapped ||
            table->offsets[properties[i]] != table->offsets[properties[0]] + 4 * (uint32_t)i)
            return false;
    }
    return true;
}

bool ply_find_all(const struct ply_table *table, const char *const *names, int count, int *properties)
{
    bool all = true;
    for (int i = 0; i < count; i++) {
        properties[i] = ply_find(table->element, false, names[i]);
        all &= properties[i] >= 0;
    }
    return all;
}

enum kind { NORMALS, TANGENTS, TEXCOORDS, COLORS, COLORS_RAW };

struct vectors {
    const struct ply_table *table;
    enum kind kind;
    int properties[4]; // −1 means the constant 1
    float divisors[4];
    int width; // numbers per vector
    bool contiguous;
    float *out;
};

static void clean_vector(const struct vectors *vectors, float *v)
{
    if (vectors->kind == COLORS || vectors->kind == COLORS_RAW) {
        for (int c = 0; c < 4; c++) {
            v[c] = v[c] >= 0.0f ? (v[c] <= FLT_MAX ? v[c] : FLT_MAX) : 0.0f; // NaN becomes 0
            if (c == 3)
                v[c] = v[c] < 1.0f ? v[c] : 1.0f;
            else if (vectors->kind == COLORS && v[c] <= 1.0f) // sRGB is not defined above 1, so the value is linear
                v[c] = (float)srgb_linear((double)v[c]);
        }
        return;
    }
    int numbers = vectors->kind == TEXCOORDS ? 2 : 3;
    bool good = true;
    for (int c = 0; c < numbers; c++)
        good &= v[c] >= -FLT_MAX && v[c] <= FLT_MAX;
    if (!good)
        memset(v, 0, (size_t)numbers * sizeof *v);
    if (vectors->kind == TANGENTS) {
        lam_vec3 unit = v3_unit(v3((double)v[0], (double)v[1], (double)v[2]));
        v[0] = (float)unit.x;
        v[1] = (float)unit.y;
        v[2] = (float)unit.z;
    }
}

static bool vector_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    const struct vectors *vectors = user;
    const struct ply_table *table = vectors->table;
    size_t first, last, width = (size_t)vectors->width;
    parallel_rows_range(table->count, index, &first, &last);
    float *out = vectors->out + width * first;
    if (vectors->contiguous) {
        const uint8_t *at = table->rows + first * table->stride + table->offsets[vectors->properties[0]];
        for (size_t row = first; row < last; row++, at += table->stride, out += width)
            memcpy(out, at, width * sizeof(float));
    } else {
        for (size_t c = 0; c < width; c++) {
            if (vectors->properties[c] >= 0) {
                ply_copy_column(table, vectors->properties[c], first, last, vectors->divisors[c], out + c, width);
                continue;
            }
            for (size_t row = first; row < last; row++)
                vectors->out[width * row + c] = 1.0f;
        }
    }
    for (size_t row = first; row < last; row++)
        clean_vector(vectors, vectors->out + width * row);
    return true;
}

// Reads vectors whose first `numbers` components are properties; the others are 1.
static bool read_vectors(const struct import_source *source, struct vectors *vectors, int numbers, struct arena *arena,
                         const float **out, lam_error *error)
{
    size_t bytes = vectors->table->count * (size_t)vectors->width * sizeof(float);
    bool whole = true;
    for (int i = 0; i < 4; i++) {
        if (i >= numbers)
            vectors->properties[i] = -1;
        if (vectors->divisors[i] == 0.0f)
            vectors->divisors[i] = 1.0f;
        whole &= vectors->divisors[i] == 1.0f;
    }
    vectors->contiguous = whole && ply_contiguous(vectors->table, vectors->properties, vectors->width);
    vectors->out = arena_alloc(arena, bytes);
    if (!vectors->out)
        return call_memory_error(source->call, bytes, error);
    *out = vectors->out;
    return parallel_rows_run(source, parallel_rows_count(vectors->table->count), vector_chunk, vectors, error);
}

bool ply_normals(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                 const float **out, lam_error *error)
{
    static const char *const names[] = {"nx", "ny", "nz"};
    struct vectors vectors = {.table = table, .kind = NORMALS, .width = 3};
    return !ply_find_all(table, names, 3, vectors.properties) || read_vectors(source, &vectors, 3, arena, out, error);
}

bool ply_tangents(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                  const float **out, lam_error *error)
{
    static const char *const names[] = {"tx", "ty", "tz"};
    struct vectors vectors = {.table = table, .kind = TANGENTS, .width = 4};
    return !ply_find_all(table, names, 3, vectors.properties) || read_vectors(source, &vectors, 3, arena, out, error);
}

// Returns the divisor that maps 8- and 16-bit integers to 0…1.
static float divisor_of(enum ply_type type)
{
    static const float divisors[PLY_TYPE_COUNT] = {
        [PLY_I8] = 127.0f, [PLY_U8] = 255.0f, [PLY_I16] = 32767.0f, [PLY_U16] = 65535.0f};
    return divisors[type] > 0.0f ? divisors[type] : 1.0f;
}

bool ply_texcoords(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                   const float **out, lam_error *error)
{
    static const char *const names[][2] = {
        {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct vectors vectors = {.table = table, .kind = TEXCOORDS, .width = 2};
        if (!ply_find_all(table, names[i], 2, vectors.properties))
            continue;
        for (int c = 0; c < 2; c++)
            vectors.divisors[c] = divisor_of(table->types[vectors.properties[c]]);
        return read_vectors(source, &vectors, 2, arena, out, error);
    }
    return true;
}

struct bytes {
    const struct ply_table *table;
    int properties[4];
    uint8_t *out;
};

static bool byte_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    const struct bytes *bytes = user;
    const struct ply_table *table = bytes->table;
    size_t first, last;
    parallel_rows_range(table->count, index, &first, &last);
    uint32_t red = table->offsets[bytes->properties[0]], green = table->offsets[bytes->properties[1]];
    uint32_t blue = table->offsets[bytes->properties[2]];
    bool has_alpha = bytes->properties[3] >= 0;
    uint32_t alpha = has_alpha ? table->offsets[bytes->properties[3]] : 0;
    const uint8_t *row = table->rows + first * table->stride;
    uint8_t *out = bytes->out + 4 * first;
    for (size_t i = first; i < last; i++, row += table->stride, out += 4) {
        out[0] = row[red];
        out[1] = row[green];
        out[2] = row[blue];
        out[3] = has_alpha ? row[alpha] : 255;
    }
    return true;
}

bool ply_find_colors(const struct ply_table *table, int properties[4])
{
    static const char *const names[][4] = {{"red", "green", "blue", "alpha"},
                                           {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
                                           {"r", "g", "b", "a"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        properties[3] = ply_find(table->element, false, names[i][3]);
        if (ply_find_all(table, names[i], 3, properties))
            return true;
    }
    return false;
}

bool ply_colors(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                const void **out, lam_colors_format *format, lam_error *error)
{
    bool raw = source->params->color == LAM_COLOR_RAW;
    int found[4];
    if (!ply_find_colors(table, found))
        return true;
    int numbers = found[3] < 0 ? 3 : 4;
    bool all_bytes = true;
    for (int c = 0; c < numbers; c++)
        all_bytes &= table->types[found[c]] == PLY_U8;
    if (all_bytes) {
        struct bytes bytes = {.table = table, .out = arena_array(arena, table->count, 4)};
        memcpy(bytes.properties, found, sizeof found);
        if (!bytes.out)
            return call_memory_error(source->call, 4 * table->count, error);
        *out = bytes.out;
        *format = raw ? LAM_COLORS_LINEAR8 : LAM_COLORS_SRGB8;
        return parallel_rows_run(source, parallel_rows_count(table->count), byte_chunk, &bytes, error);
    }

    struct vectors vectors = {.table = table, .kind = raw ? COLORS_RAW : COLORS, .width = 4};
    memcpy(vectors.properties, found, sizeof found);
    for (int c = 0; c < numbers; c++) {
        enum ply_type type = table->types[found[c]];
        // For colours of type int or uint, programs use 0…255.
        vectors.divisors[c] = type == PLY_I32 || type == PLY_U32 ? 255.0f : divisor_of(type);
    }
    const float *floats = NULL;
    if (!read_vectors(source, &vectors, numbers, arena, &floats, error))
        return false;
    *out = floats;
    *format = LAM_COLORS_LINEAR_F32;
    return true;
}
