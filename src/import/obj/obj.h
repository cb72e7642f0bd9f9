// obj.h: the inside of the OBJ importer: obj.c leads, obj_scan.c counts, obj_parse.c and obj_lines.c read
// numbers, obj_faces.c cuts polygons and completes normals, obj_groups.c makes named parts of the statements
// in between.
//
// The file is cut at line ends into chunks of a fixed size, and each pass goes over all chunks in parallel.
// Pass one counts what each chunk holds; sums over the chunks then say where its vertices and triangles go,
// so that pass two writes every number straight into its place. Nothing depends on the number of threads.
// Large files that are on disk take one pass over pieces of them (obj_stream.c).
#ifndef OBJ_H
#define OBJ_H

#include "importer.h"
#include "mtl.h"

enum {
    OBJ_CHUNK = 256 << 10,    // bytes: some hundred microseconds of work
    OBJ_MISSING = UINT32_MAX, // a corner without this attribute
    OBJ_POLYGONS_A_PIECE = 1024,
};

// What a statement is, by its first word.
enum obj_kind {
    OBJ_EMPTY, // nothing, or a comment
    OBJ_POSITION,
    OBJ_TEXCOORD,
    OBJ_NORMAL,
    OBJ_FACE,
    OBJ_OTHER, // looked at one by one, later
};

struct obj_counts {
    uint64_t positions, texcoords, normals;
    uint64_t triangles, polygons; // polygons: faces of more than three corners
    uint64_t others;              // statements of OBJ_OTHER
};

struct obj_chunk {
    const uint8_t *begin, *end;      // whole lines
    struct obj_counts holds, before; // read in pieces: room for what it holds; what it did hold, when parsed
    bool colors, slashes;            // pass one: some vertex has a colour; some '/' is there
    // Pass two:
    float low[3], high[3];              // box of the positions; low > high where there are none
    double low_exact[3], high_exact[3]; // the same in double, where an origin is needed
    float brightest;                    // the largest colour channel
    bool texcoord_used, texcoord_missing, normal_used, normal_missing; // by some corner
    bool texcoord_unknown, normal_unknown;                             // named although the file has none at all
    uint64_t short_faces;                                              // of one or two corners
    uint64_t odd_numbers;                   // normals and texture coordinates that are not finite
    const uint8_t *short_face, *odd_number; // the first ones
};

// A face of more than three corners: `count` of them stand at the begin of its triangles' places.
struct obj_polygon {
    uint32_t first_triangle, count;
};

// A statement of OBJ_OTHER and how many triangles stand before it.
struct obj_statement {
    const uint8_t *at;
    uint32_t triangle;
};

struct obj {
    const struct import_source *source;
    struct lam_scene *scene;
    struct arena memory; // what goes at the end of the load
    const uint8_t *begin, *end;

    struct obj_chunk *chunks;
    size_t chunk_count;
    struct obj_counts total;
    bool colors_present;
    bool in_pieces;   // of the text only the chunk at hand is there: nothing is known of what stands above it
    bool line_missed; // then: somebody wanted to know a line's number

    float *positions, *texcoords, *normals, *colors; // colors: 4 a vertex
    uint32_t *indices, *texcoord_indices, *normal_indices;
    struct obj_polygon *polygons;
    struct obj_statement *statements;
    uint32_t *smoothing_groups;
    lam_part *parts;
    uint32_t part_count;
    const char *object_name; // where the file has just one

    double origin[3];
    bool has_origin;
    float color_scale; // 1/255 where colours go beyond 1

    struct mtl_set materials;
};

// obj_scan.c Where a logical line ends: behind its '\n', or at `end`. A backslash before the '\n' continues it.
const uint8_t *obj_line_after(const uint8_t *at, const uint8_t *end);
// The next word of the statement, or its end: at '\n' or `end`. Steps over white space, continued lines and a comment.
const uint8_t *obj_next_slowly(const uint8_t *at, const uint8_t *end);
bool obj_cut(struct obj *obj, size_t chunk_bytes, lam_error *error);
bool obj_scan(struct obj *obj, lam_error *error); // pass one, and the sums

// One chunk while it is read.
struct obj_reader {
    struct obj *obj;
    struct obj_chunk *chunk;
    const uint8_t *end;      // of the file
    struct obj_counts at;    // where the next of each kind goes
    struct obj_counts limit; // where this chunk's places end
    float low[4], high[4];   // box of the positions; the fourth is spare
    lam_error *error;
};

// obj_lines.c, compiled for several instruction sets: reads lines up to the first that is continued. Returns
// the place behind them, at most `end`, where a line begins; NULL: something is wrong.
typedef const uint8_t *obj_lines_reader(struct obj_reader *reader, const uint8_t *line, const uint8_t *end);
obj_lines_reader obj_read_lines_scalar, obj_read_lines_avx512;

// obj_line.c Any line: returns the place behind it, which is behind a later line's end where it is
// continued; NULL: wrong.
const uint8_t *obj_read_line(struct obj_reader *reader, const uint8_t *at);
// obj_parse.c
bool obj_parse(struct obj *obj, lam_error *error); // pass two
// One chunk: from before on, at most what it holds. `error` may be NULL.
bool obj_parse_chunk(struct obj *obj, struct obj_chunk *chunk, lam_error *error);
bool obj_find_origin(struct obj *obj, lam_error *error); // reads positions again where they lie far from zero
bool obj_convert_colors(struct obj *obj, lam_error *error);

// obj_faces.c
bool obj_cut_polygons(struct obj *obj, lam_error *error);
bool obj_complete_texcoords(struct obj *obj, lam_error *error);
bool obj_complete_normals(struct obj *obj, lam_error *error);

// obj_groups.c
bool obj_read_statements(struct obj *obj, lam_error *error);

// obj_stream.c: the importer's load_parts.
bool obj_load_large(const struct import_source *source, const struct file_parts *file, struct lam_scene *scene);

// obj_mesh.c: completes the mesh once positions and faces are read.
bool obj_complete(struct obj *obj, lam_error *error);

// For tests: loads with chunks of that many bytes.
bool obj_load_chunked(const struct import_source *source, struct lam_scene *scene, size_t chunk_bytes,
                      lam_error *error);

// Line number of a place in the file; 0, and noted, where the file is read in pieces.
size_t obj_line(struct obj *obj, const uint8_t *at);

static inline bool obj_white(uint8_t c) { return c <= ' ' && c != '\n' && c != 0; }

static inline const uint8_t *obj_next(const uint8_t *at, const uint8_t *end)
{
    while (obj_white(*at)) // the zero behind the file's end stops it
        at++;
    // Digits, signs and '.' lie above '#'.
    return *at > '#' && *at != '\\' ? at : obj_next_slowly(at, end);
}

// Whether obj_next found the statement's end.
static inline bool obj_over(const uint8_t *at, const uint8_t *end) { return *at == '\n' || at >= end; }

// Whether a word ends here.
static inline bool obj_word_over(const uint8_t *at)
{
    return *at <= ' ' || (*at == '\\' && (at[1] == '\n' || (at[1] == '\r' && at[2] == '\n')));
}

static inline enum obj_kind obj_kind_of(const uint8_t *at)
{
    if (*at == 'v') {
        if (at[1] <= ' ')
            return OBJ_POSITION;
        if (at[2] <= ' ')
            return at[1] == 't' ? OBJ_TEXCOORD : at[1] == 'n' ? OBJ_NORMAL : OBJ_OTHER;
        return OBJ_OTHER;
    }
    if (*at == 'f' && at[1] <= ' ')
        return OBJ_FACE;
    return *at == '\n' || *at == '#' || *at == 0 ? OBJ_EMPTY : OBJ_OTHER;
}

// Behind the statement: steps over words that mean nothing to us.
static inline const uint8_t *obj_finish_line(const uint8_t *at, const uint8_t *end)
{
    while (!obj_over(at, end)) {
        while (at < end && !obj_word_over(at))
            at++;
        const uint8_t *next = obj_next(at, end);
        at = next == at && !obj_over(at, end) ? at + 1 : next; // a zero byte
    }
    return at < end ? at + 1 : end;
}

#endif
