// ply_columns.c: converts columns of a PLY table to normals, tangents, texture coordinates and colours, in parallel
// chunks.
#include "mesh_build.h"
#include "parallel_rows.h"
#include "linear.h"
#include "ply_load.h"

#include <math.h>

void ply_copy_column(const struct ply_table *table, int property, const uint8_t *rows, size_t count, float divisor,
                     float *out, size_t step)
{
    const uint8_t *at = rows + table->offsets[property];
    size_t stride = table->rows.stride;
    bool swapped = table->swapped;
#define COLUMN(LOAD)                                                                                                   \
    for (size_t row = 0; row < count; row++, at += stride, out += step)                                                \
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
    for (int i = 0; all && i < count; i++)
        table->element->properties[properties[i]].used = true;
    return all;
}

enum kind { NORMALS, TANGENTS, TEXCOORDS, TEXNUMBERS, COLORS, COLORS_BYTES, COLORS_PACKED, COLORS_SPLAT, KINDS };

// An array of vectors to fill.
struct column {
    enum kind kind;
    int properties[4]; // −1 means the constant 1
    float divisors[4];
    int width; // numbers per vector
    bool contiguous;
    void *out; // floats, or bytes for COLORS_BYTES and COLORS_PACKED
};

// The columns that one pass fills.
struct columns {
    const struct import_source *source;
    const struct ply_table *table;
    struct arena *arena;
    struct column columns[KINDS];
    int count;
    struct color_range ranges[2];
};

static void clean_vector(enum kind kind, float *v)
{
    for (int c = 0; kind >= COLORS && c < 4; c++) {
        // The base colour of a Gaussian splat: the constant spherical harmonic is √(1/4π). It may be negative.
        float value = kind == COLORS_SPLAT && c < 3 ? 0.5f + 0.2820948f * v[c] : v[c];
        v[c] = value >= 0.0f                          ? value
               : value < 0.0f && kind == COLORS_SPLAT ? 0.0f
                                                      : NAN; // mesh_convert_colors counts it
    }
    if (kind == TANGENTS) {
        if (!((v[0] - v[0]) + (v[1] - v[1]) + (v[2] - v[2]) == 0))
            memset(v, 0, 3 * sizeof *v);
        lam_vec3 unit = v3_unit(v3((double)v[0], (double)v[1], (double)v[2]));
        v[0] = (float)unit.x;
        v[1] = (float)unit.y;
        v[2] = (float)unit.z;
    }
}

static void fill_vectors(const struct ply_table *table, const struct column *column, const uint8_t *rows, size_t count,
                         float *out)
{
    size_t width = (size_t)column->width;
    if (column->contiguous) {
        const uint8_t *at = rows + table->offsets[column->properties[0]];
        for (size_t i = 0; i < count; i++, at += table->rows.stride)
            memcpy(out + width * i, at, width * sizeof(float));
    }
    for (size_t c = 0; !column->contiguous && c < width; c++) {
        if (column->properties[c] >= 0)
            ply_copy_column(table, column->properties[c], rows, count, column->divisors[c], out + c, width);
        else
            for (size_t i = 0; i < count; i++)
                out[width * i + c] = 1.0f;
    }
    for (size_t i = 0; i < count; i++)
        clean_vector(column->kind, out + width * i);
}

static void fill_bytes(const struct ply_table *table, const struct column *column, const uint8_t *rows, size_t count,
                       uint8_t *out)
{
    uint32_t offsets[4] = {0};
    bool has_alpha = column->properties[3] >= 0;
    for (int c = 0; c < 3 + has_alpha; c++)
        offsets[c] = table->offsets[column->properties[c]];
    for (size_t i = 0; i < count; i++, rows += table->rows.stride, out += 4) {
        out[0] = rows[offsets[0]];
        out[1] = rows[offsets[1]];
        out[2] = rows[offsets[2]];
        out[3] = has_alpha ? rows[offsets[3]] : 255;
    }
}

// Unpacks the colours of the Point Cloud Library, 0xAARRGGBB, in an integer or in the bits of a float.
static void fill_packed(const struct ply_table *table, const struct column *column, const uint8_t *rows, size_t count,
                        uint8_t *out)
{
    int property = column->properties[0];
    enum ply_type type = table->types[property];
    for (size_t i = 0; i < count; i++, rows += table->rows.stride, out += 4) {
        const uint8_t *at = rows + table->offsets[property];
        float number = type == PLY_F64 ? (float)ply_load_f64(at, table->swapped) : 0;
        uint32_t bits = type == PLY_F32 ? ply_load_32(at, table->swapped) : 0;
        if (type == PLY_F64)
            memcpy(&bits, &number, sizeof bits);
        else if (type != PLY_F32)
            bits = (uint32_t)ply_load_integer(at, type, table->swapped);
        for (int c = 0; c < 4; c++)
            out[c] = (uint8_t)(c < 3 ? bits >> (16 - 8 * c) : bits >> 24 | (column->properties[1] < 0 ? 255 : 0));
    }
}

static bool columns_chunk(void *user, size_t index, const uint8_t *rows, lam_error *error)
{
    (void)error;
    const struct columns *columns = user;
    size_t first, last;
    parallel_rows_range(columns->table->rows.count, index, &first, &last);
    for (int i = 0; i < columns->count; i++) {
        const struct column *column = &columns->columns[i];
        size_t at = (size_t)column->width * first;
        if (column->kind == COLORS_BYTES)
            fill_bytes(columns->table, column, rows, last - first, (uint8_t *)column->out + at);
        else if (column->kind == COLORS_PACKED)
            fill_packed(columns->table, column, rows, last - first, (uint8_t *)column->out + at);
        else
            fill_vectors(columns->table, column, rows, last - first, (float *)column->out + at);
    }
    return true;
}

// Adds a column whose first `numbers` components are properties; the others are 1. Returns the array of the column, or
// NULL if memory runs out.
static void *add_column(struct columns *columns, struct column column, int numbers, lam_error *error)
{
    const struct ply_table *table = columns->table;
    size_t bytes = table->rows.count * (size_t)column.width *
                   (column.kind == COLORS_BYTES || column.kind == COLORS_PACKED ? 1 : sizeof(float));
    bool whole = true;
    for (int i = 0; i < 4; i++) {
        if (i >= numbers)
            column.properties[i] = -1;
        if (column.divisors[i] == 0.0f)
            column.divisors[i] = 1.0f;
        whole &= column.divisors[i] == 1.0f;
    }
    column.contiguous = whole && ply_contiguous(table, column.properties, column.width);
    column.out = arena_alloc(columns->arena, bytes);
    if (!column.out)
        call_memory_error(columns->source->call, bytes, error);
    columns->columns[columns->count++] = column;
    return column.out;
}

// Returns the divisor that maps 8- and 16-bit integers to 0…1.
static float divisor_of(enum ply_type type)
{
    static const float divisors[PLY_TYPE_COUNT] = {
        [PLY_I8] = 127.0f, [PLY_U8] = 255.0f, [PLY_I16] = 32767.0f, [PLY_U16] = 65535.0f};
    return divisors[type] > 0.0f ? divisors[type] : 1.0f;
}

static bool add_texcoords(struct columns *columns, const float **out, lam_error *error)
{
    static const char *const names[][2] = {
        {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct column column = {.kind = TEXCOORDS, .width = 2};
        if (!ply_find_all(columns->table, names[i], 2, column.properties))
            continue;
        for (int c = 0; c < 2; c++)
            column.divisors[c] = divisor_of(columns->table->types[column.properties[c]]);
        return (*out = add_column(columns, column, 2, error)) != NULL;
    }
    return true;
}

bool ply_find_colors(const struct ply_table *table, int properties[4])
{
    static const char *const names[][4] = {{"red", "green", "blue", "alpha"},
                                           {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
                                           {"r", "g", "b", "a"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!ply_find_all(table, names[i], 3, properties))
            continue;
        ply_find_all(table, names[i] + 3, 1, properties + 3);
        return true;
    }
    return false;
}

// The usual end of the range of a colour. For colours of type int or uint, programs use the range 0…255.
static float usual_range(enum ply_type type) { return type == PLY_I32 || type == PLY_U32 ? 255.0f : divisor_of(type); }

// Finds a colour packed in one number of at least 32 bits.
static bool find_packed(const struct ply_table *table, const char *name, int *property)
{
    int found = ply_find(table->element, false, name);
    return found >= 0 && ply_type_size(table->types[found]) >= 4 && ply_find_all(table, &name, 1, property);
}

static bool add_colors(struct columns *columns, struct ply_attributes *out, lam_error *error)
{
    const struct ply_table *table = columns->table;
    static const char *const splat[] = {"f_dc_0", "f_dc_1", "f_dc_2"};
    bool raw = columns->source->params->color == LAM_COLOR_RAW, all_bytes = true;
    struct column column = {.kind = COLORS, .width = 4};
    int numbers = 3;
    if (ply_find_colors(table, column.properties)) {
        numbers = column.properties[3] < 0 ? 3 : 4;
        enum ply_type first = table->types[column.properties[0]];
        bool alike = first == table->types[column.properties[1]] && first == table->types[column.properties[2]];
        for (int c = 0; c < numbers; c++) {
            enum ply_type type = table->types[column.properties[c]];
            bool known = ply_type_size(type) == 1 || (c < 3 && !alike); // otherwise, the numbers show the range
            all_bytes &= type == PLY_U8;
            column.divisors[c] = known ? usual_range(type) : 1.0f;
            if (!known)
                columns->ranges[c == 3] =
                    (struct color_range){ply_type_is_integer(type) ? 255.0f : 1.0f, usual_range(type)};
        }
        column.kind = all_bytes ? COLORS_BYTES : COLORS;
    } else if (find_packed(table, "rgba", column.properties) || find_packed(table, "rgb", column.properties)) {
        numbers = ply_find(table->element, false, "rgba") < 0 ? 1 : 2; // the second number means alpha
        column.properties[1] = column.properties[0];
        column.kind = COLORS_PACKED;
    } else if (ply_find_all(table, splat, 3, column.properties)) {
        column.kind = COLORS_SPLAT;
        all_bytes = false;
    } else {
        return true;
    }
    out->colors_format = !all_bytes ? LAM_COLORS_LINEAR_F32 : raw ? LAM_COLORS_LINEAR8 : LAM_COLORS_SRGB8;
    return (out->colors = add_column(columns, column, numbers, error)) != NULL;
}

static bool add_directions(struct columns *columns, const char *const *names, struct column column, const float **out,
                           lam_error *error)
{
    return !ply_find_all(columns->table, names, 3, column.properties) ||
           (*out = add_column(columns, column, 3, error)) != NULL;
}

void ply_clear_texcoords(struct lam_scene *scene, const char *name, float *texcoords, size_t count)
{
    uint64_t bad = 0;
    for (float *st = texcoords; st < texcoords + 2 * count; st += 2)
        if (!((st[0] - st[0]) + (st[1] - st[1]) == 0)) {
            st[0] = st[1] = 0;
            bad++;
        }
    if (bad)
        scene_warn(scene, "%s: %llu texture coordinates are not finite and become 0", name, (unsigned long long)bad);
}

bool ply_read_attributes(const struct import_source *source, struct lam_scene *scene, const struct ply_table *table,
                         unsigned wanted, struct arena *arena, struct ply_attributes *out, lam_error *error)
{
    static const char *const normals[] = {"nx", "ny", "nz"}, *const tangents[] = {"tx", "ty", "tz"},
                             *const texnumber[] = {"texnumber"};
    struct columns columns = {.source = source, .table = table, .arena = arena};
    *out = (struct ply_attributes){0};
    if ((wanted & PLY_NORMALS &&
         !add_directions(&columns, normals, (struct column){.kind = NORMALS, .width = 3}, &out->normals, error)) ||
        (wanted & PLY_TANGENTS &&
         !add_directions(&columns, tangents, (struct column){.kind = TANGENTS, .width = 4}, &out->tangents, error)) ||
        (wanted & PLY_TEXCOORDS && !add_texcoords(&columns, &out->texcoords, error)) ||
        (wanted & PLY_COLORS && !add_colors(&columns, out, error)))
        return false;
    struct column numbers = {.kind = TEXNUMBERS, .width = 1};
    if (wanted & PLY_TEXNUMBERS && ply_find_all(table, texnumber, 1, numbers.properties) &&
        !(out->texnumbers = add_column(&columns, numbers, 1, error)))
        return false;
    if (columns.count > 0 && !parallel_rows_read(source, &table->rows, columns_chunk, &columns, error))
        return false;
    if (out->texcoords)
        ply_clear_texcoords(scene, source->name, (float *)(uintptr_t)out->texcoords, table->rows.count);
    return !out->colors || out->colors_format != LAM_COLORS_LINEAR_F32 ||
           mesh_convert_colors(source, scene, (float *)(uintptr_t)out->colors, table->rows.count, columns.ranges,
                               error);
}
