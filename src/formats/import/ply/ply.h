// ply.h: internals of the PLY importer.
//
//  ply.c            reads the elements in order and builds the mesh
//  ply_header.c     the header: elements and their properties
//  ply_binary.c     rows of an element of a binary file, as a ply_table
//  ply_ascii.c      rows of an element of an ASCII file, as a ply_table
//  ply_positions.c  positions from the columns of a table
//  ply_columns.c    normals, tangents, texture coordinates and colours from the columns of a table
//  ply_faces.c      triangles from faces and strips
//  ply_edges.c      lines from edges
//
// Rows of equal size stay in the file. Each pass reads these rows in chunks (parallel_rows_read), so that a large file
// need not be in memory. Rows of a text file, and rows with lists of several lengths, are converted to rows in memory.
//
#ifndef PLY_H
#define PLY_H

#include "parallel_rows.h"

enum ply_type { PLY_I8, PLY_U8, PLY_I16, PLY_U16, PLY_I32, PLY_U32, PLY_F32, PLY_F64, PLY_TYPE_COUNT };
enum ply_format { PLY_ASCII, PLY_LITTLE, PLY_BIG };

struct ply_property {
    const char *name;
    enum ply_type type; // for a list, the type of the items
    bool list;
    enum ply_type count_type; // the type of a list's count
    bool used;                // warn_unused in ply.c names the others
};

struct ply_element {
    const char *name;
    uint64_t count;
    size_t line; // line in the header
    struct ply_property *properties;
    int property_count;
    int list_count;      // number of properties that are lists
    size_t scalar_bytes; // size in bytes of a binary row without its lists
    size_t min_bytes;    // size in bytes of a binary row whose lists are empty
};

struct ply_header {
    enum ply_format format;
    const struct ply_element *elements;
    int element_count;
    size_t body;           // offset of the first byte after the header
    const char **textures; // the names of pictures in comments, "TextureFile NAME"
    int texture_count;
    // The number of unknown lines, and the line number and the first word of the first unknown line.
    size_t unknown_count, unknown_line;
    const uint8_t *unknown;
};

// Warns of unknown lines, such as the "Created by …" that Blender once wrote without "comment".
void ply_warn_header(const struct import_source *source, struct lam_scene *scene, const struct ply_header *header);

// Reads the header into `arena`.
bool ply_read_header(const struct import_source *source, struct arena *arena, struct ply_header *header,
                     lam_error *error);

// Returns the size in bytes of a number. Each hexadecimal digit of the constant is the size of one type.
static inline size_t ply_type_size(enum ply_type type) { return 0x84442211 >> 4 * type & 15; }
static inline bool ply_type_is_integer(enum ply_type type) { return type < PLY_F32; }

// Returns the index of a property with this name, list or scalar, or −1 if there is none.
int ply_find(const struct ply_element *element, bool list, const char *name);

// The type of x, y and z in a table. In an ASCII file, numbers may have more decimals than the declared types can
// store. Positions are therefore read as floats, and again as doubles if the model is far from zero.
enum ply_positions_as { PLY_AS_DECLARED, PLY_AS_FLOAT, PLY_AS_DOUBLE };

// An element's rows.
struct ply_table {
    const struct ply_element *element;
    struct row_bytes rows;      // the scalars, if they were requested
    bool swapped;               // the byte order differs from the machine's
    const uint32_t *offsets;    // the offset of each scalar property in a row
    const enum ply_type *types; // the type of each property in `rows`
    enum ply_positions_as positions;
    // The requested list, with checked indices. The items of row r begin at items[starts[r]], or at items[3 r] if
    // `starts` is NULL. Each row of n corners reserves 3 (n − 2) items for its triangles. The first n of these items
    // contain the corners. Rows of fewer than three corners reserve no items.
    uint32_t *items;
    const uint32_t *starts; // one more element than the table has rows
    // The requested list of texture coordinates: two numbers for each item above, with the same layout. 0 if missing.
    float *wedges;
    size_t odd_wedges; // rows with items whose list has another length; accessed atomically
    bool all_used;     // true if every number below the request's item_limit certainly occurs as an item
};

// The data that a caller requests from an element.
struct ply_request {
    bool scalars;
    int list;                          // index of the property, or −1
    const struct ply_property *wedges; // a list of two texture coordinates per item, or NULL
    uint32_t item_limit;               // items must be below this limit
    bool restarts;                     // a strip: item −1 is valid and becomes PLY_RESTART
    enum ply_positions_as positions;
    struct arena *keep, *scratch; // `keep` is for items, except of strips; `scratch` is for everything else
};
#define PLY_RESTART UINT32_MAX

// These functions read the element at offset *at of the file, or skip it if `table` is NULL. They set *at to the byte
// after the element.
bool ply_read_binary(const struct import_source *source, const struct ply_header *header,
                     const struct ply_element *element, const struct ply_request *request, size_t *at,
                     struct ply_table *table, lam_error *error);
bool ply_read_ascii(const struct import_source *source, const struct ply_element *element,
                    const struct ply_request *request, size_t *at, struct ply_table *table, lam_error *error);

// ply_rows.c. Sets offsets, types and stride for rows without their lists.
bool ply_plan_rows(const struct import_source *source, const struct ply_request *request, struct arena *scratch,
                   struct ply_table *table, lam_error *error);
// Reports that the file ends within a row of the element. `row` counts from 0; if it is not `exact`, it is an upper bound.
bool ply_fail_truncated(const struct import_source *source, const struct ply_element *element, uint64_t row, bool exact,
                        lam_error *error);
// Fails with LAM_LIMIT, because the file contains more elements than 32-bit indices can address.
bool ply_fail_too_many(const struct import_source *source, const struct ply_element *element, lam_error *error);

// Finds the scalar properties with these names (−1 if missing). Returns whether all exist, and marks them as used.
bool ply_find_all(const struct ply_table *table, const char *const *names, int count, int *properties);
// Returns whether the properties are adjacent floats in the machine's byte order, so that memcpy can copy them.
bool ply_contiguous(const struct ply_table *table, const int *properties, int count);
// Finds red, green, blue and alpha by any of their usual names. Returns whether red, green and blue exist.
bool ply_find_colors(const struct ply_table *table, int properties[4]);
// Copies a scalar property of `count` rows as floats, divided by `divisor`, to every `step`-th element of `out`.
void ply_copy_column(const struct ply_table *table, int property, const uint8_t *rows, size_t count, float divisor,
                     float *out, size_t step);

// Sets origin, positions (from `arena`) and vertex_count of the mesh. Sets *needs_doubles if the table stores an ASCII
// file's positions as floats and floats are not precise enough. The caller must then read the positions again as
// doubles.
bool ply_positions(const struct import_source *source, const struct ply_table *table, struct arena *arena,
                   lam_mesh *mesh, bool *needs_doubles, lam_error *error);

// All attributes except positions. A pointer is NULL if the element does not have this attribute.
enum { PLY_NORMALS = 1, PLY_TANGENTS = 2, PLY_TEXCOORDS = 4, PLY_COLORS = 8, PLY_ALL = 15, PLY_TEXNUMBERS = 16 };
struct ply_attributes {
    const float *normals, *tangents, *texcoords, *texnumbers;
    const void *colors;
    lam_colors_format colors_format;
};
// Reads the wanted attributes in one pass into arrays from `arena`. Tangents that are not finite become 0. Warns in
// `scene` if the range of colours is not the usual one of their type.
bool ply_read_attributes(const struct import_source *source, struct lam_scene *scene, const struct ply_table *table,
                         unsigned wanted, struct arena *arena, struct ply_attributes *out, lam_error *error);
// Sets texture coordinates that are not finite to 0, with one warning.
void ply_clear_texcoords(struct lam_scene *scene, const char *name, float *texcoords, size_t count);

// Sets indices and triangle_count of a mesh with positions, from faces or from strips. Colours and normals of the faces
// are used if the vertices have none. The faces' numbers of textures (texnumber) become parts: the scene's materials with
// an index below `textures` have these textures.
bool ply_faces(const struct import_source *source, const struct ply_table *faces, int textures, struct lam_scene *scene,
               lam_mesh *mesh, lam_error *error);
bool ply_strips(const struct import_source *source, const struct ply_table *strips, struct lam_scene *scene,
                lam_mesh *mesh, lam_error *error);

// Sets indices and line_count. Colours of the edges are used if the vertices have none.
bool ply_edges(const struct import_source *source, const struct ply_table *edges, struct lam_scene *scene,
               lam_mesh *mesh, lam_error *error);

#endif
