// ply.h: what the parts of the PLY reader share.
//
//   ply_header.c   the header: which elements with which properties
//   ply_binary.c   ┐ one element's rows, of either kind of body, as a table: scalars at a fixed stride, and
//   the items of ply_ascii.c    ┘ one list (a face's corners) apart, already checked ply_positions.c,
//   ply_columns.c   columns of a table as positions; as vectors and colours ply_faces.c    faces and strips
//   to triangles ply.c          the whole in order
#ifndef PLY_H
#define PLY_H

#include "importer.h"

enum ply_type { PLY_I8, PLY_U8, PLY_I16, PLY_U16, PLY_I32, PLY_U32, PLY_F32, PLY_F64, PLY_TYPE_COUNT };
enum ply_format { PLY_ASCII, PLY_LITTLE, PLY_BIG };

struct ply_property {
    const char *name;
    enum ply_type type; // of the items, for a list
    bool list;
    enum ply_type count_type; // of a list
};

struct ply_element {
    const char *name;
    uint64_t count;
    size_t line; // in the header
    const struct ply_property *properties;
    int property_count;
    int list_count;      // properties that are lists
    size_t scalar_bytes; // a binary row without its lists
    size_t min_bytes;    // a binary row with its lists empty
};

struct ply_header {
    enum ply_format format;
    const struct ply_element *elements;
    int element_count;
    size_t body; // offset of the first byte behind the header
};

// Reads the header into `arena`.
bool ply_read_header(const struct import_source *source, struct arena *arena, struct ply_header *header,
                     lam_error *error);

size_t ply_type_size(enum ply_type type);
const char *ply_type_name(enum ply_type type);
static inline bool ply_type_is_integer(enum ply_type type) { return type < PLY_F32; }

// Index of a property of that name, list or scalar; −1: none.
int ply_find(const struct ply_element *element, bool list, const char *name);

// What x, y and z become. An ASCII file's type says little about its decimals, so there they are read as
// floats and, where the model turns out to lie far from zero, once more as doubles.
enum ply_positions_as { PLY_AS_DECLARED, PLY_AS_FLOAT, PLY_AS_DOUBLE };

// An element's rows in memory.
struct ply_table {
    const struct ply_element *element;
    size_t count;
    const uint8_t *rows; // count · stride bytes; NULL where nothing was asked for
    size_t stride;
    bool swapped;               // numbers lie in the other byte order than the machine's
    const uint32_t *offsets;    // in a row, for each scalar property
    const enum ply_type *types; // for each property, as it lies in `rows`
    enum ply_positions_as positions;
    // The list that was asked for: row r has items[starts[r]] … items[starts[r + 1] − 1]; `starts` NULL:
    // three each.
    const uint32_t *items;
    const uint32_t *starts;
};

// What to take from an element.
struct ply_request {
    bool scalars;
    int list;            // property; −1: none
    uint32_t item_limit; // each item is to be below it
    bool restarts;       // item −1 is allowed, and becomes PLY_RESTART
    enum ply_positions_as positions;
};
#define PLY_RESTART UINT32_MAX

// Read the element that begins at offset *at of the file, or skip it (`table` NULL), and move *at behind it.
// What is made comes from `keep` (list items) and `scratch` (the rest); tables may point into the file.
bool ply_read_binary(const struct import_source *source, const struct ply_header *header,
                     const struct ply_element *element, const struct ply_request *request, struct arena *keep,
                     struct arena *scratch, size_t *at, struct ply_table *table, lam_error *error);
bool ply_read_ascii(const struct import_source *source, const struct ply_element *element,
                    const struct ply_request *request, struct arena *keep, struct arena *scratch, size_t *at,
                    struct ply_table *table, lam_error *error);

// What both kinds of body share. Sets offsets, types and stride for rows without their lists.
bool ply_plan_rows(const struct import_source *source, const struct ply_request *request, struct arena *scratch,
                   struct ply_table *table, lam_error *error);
// The file ends before the element's row `row`, counted from 0, is whole.
bool ply_fail_short(const struct import_source *source, const struct ply_element *element, uint64_t row,
                    lam_error *error);
// More than 32-bit numbers can tell apart: LAM_LIMIT.
bool ply_fail_too_many(const struct import_source *source, const struct ply_element *element, lam_error *error);

// Indices of the scalar properties of these names (−1: none); whether all are there.
bool ply_find_all(const struct ply_table *table, const char *const *names, int count, int *properties);
// Whether the properties lie side by side as floats of this machine, so that rows can be copied whole.
bool ply_side_by_side(const struct ply_table *table, const int *properties, int count);
// Likewise red, green, blue and alpha, by any of their usual names; whether the first three are there.
bool ply_find_colors(const struct ply_table *table, int properties[4]);
// A scalar property of rows [first, last) as floats, each divided by `divisor`, to every `step`-th of `out`.
void ply_copy_column(const struct ply_table *table, int property, size_t first, size_t last, float divisor, float *out,
                     size_t step);

// Positions: origin, positions (from `arena`) and vertex_count of the mesh. *far_out: the table holds an
// ASCII file's numbers as floats, and they are to be read once more as doubles; nothing else is done then.
bool ply_positions(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                   lam_mesh *mesh, bool *far_out, lam_error *error);

// Other columns, from `arena`; NULL columns (*out) where the element has none such; false only for an error.
// Numbers that are not finite become 0.
bool ply_normals(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                 const float **out, lam_error *error);
bool ply_tangents(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                  const float **out, lam_error *error);
bool ply_texcoords(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                   const float **out, lam_error *error);
bool ply_colors(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                const void **out, lam_colors_format *format, lam_error *error);

// Triangles of the mesh, whose positions are there: indices and triangle_count; from faces, with their own
// colours and normals where the vertices have none, or from strips.
bool ply_faces(const struct import_source *source, const struct ply_table *faces, struct lam_scene *scene,
               lam_mesh *mesh, lam_error *error);
bool ply_strips(const struct import_source *source, const struct ply_table *strips, struct lam_scene *scene,
                lam_mesh *mesh, lam_error *error);

// ply_stream.c: the importer's load_parts.
bool ply_load_parts(const struct import_source *source, const struct file_parts *file, struct lam_scene *scene);

#endif
