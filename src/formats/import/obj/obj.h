// obj.h: internals of the OBJ importer.
//
//   obj.c                      recognises the format, runs the passes
//   obj_scan.c                 pass one: chunks and their element counts
//   obj_parse.c, obj_line(s).c pass two: vertices and faces
//   obj_faces.c                completes normals and texture coordinates
//   obj_groups.c               statements between the faces: named parts, materials, smoothing groups
//   obj_strokes.c              lines and points
//   obj_libraries.c, mtl.c     material files
//   obj_mesh.c                 the scene's mesh
//   obj_stream.c               large files on disk: one pass, chunk by chunk
//
// The file is split at line endings into chunks of about OBJ_CHUNK bytes, and each pass processes the chunks in
// parallel. Pass one counts the elements of each chunk. The prefix sums of the counts are the first indices of each
// chunk in the arrays, so pass two can write each number to its final position. The result does not depend on the
// number of threads.
#ifndef OBJ_H
#define OBJ_H

#include "importer.h"
#include "mesh_build.h"
#include "mtl.h"

#include <string.h>

enum {
    OBJ_CHUNK = THRESHOLD(256 << 10, 1 << 10), // bytes: about a hundred microseconds of work
    OBJ_MISSING = UINT32_MAX,                  // a corner without this attribute
    OBJ_LIBRARIES_MAX = 256,                   // the maximum number of material files that are opened
};

// Kinds of statements.
enum obj_kind {
    OBJ_EMPTY, // nothing, or a comment
    OBJ_POSITION,
    OBJ_TEXCOORD,
    OBJ_NORMAL,
    OBJ_FACE,
    OBJ_OTHER, // recorded for obj_groups.c
};

struct obj_counts {
    uint64_t positions, texcoords, normals;
    uint64_t triangles, polygons; // `polygons` counts the faces with more than three corners
    uint64_t others;              // number of statements of kind OBJ_OTHER
};

struct obj_chunk {
    const uint8_t *begin, *end; // complete lines
    // The number of elements of each kind in this chunk. While obj_stream.c parses the chunk, these numbers are the
    // capacities of the chunk's arrays instead.
    struct obj_counts counts;
    struct obj_counts before; // elements in all previous chunks
    // Pass one: whether a vertex has a colour, and whether the text contains a '/'.
    bool colors, slashes;
    // Pass two. Bounding box of the positions; low > high if there are no positions.
    float low[3], high[3];
    double low_exact[3], high_exact[3]; // the same bounds as doubles, set only if an origin is needed
    // Whether some corners have (…_used), and whether some corners lack (…_missing), a texture coordinate or a normal.
    bool texcoord_used, texcoord_missing, normal_used, normal_missing;
    // Whether a corner refers to a texture coordinate or a normal although the file contains none.
    bool texcoord_unknown, normal_unknown;
    uint64_t short_faces;                              // the number of faces with one or two corners
    uint64_t nonfinite_numbers;                        // texture coordinates that are not finite
    const uint8_t *first_short_face, *first_nonfinite; // the first face with one or two corners, and the first texture
                                                       // coordinate that is not finite
};

// A statement of OBJ_OTHER, and the numbers of triangles, positions and texture coordinates before it.
struct obj_statement {
    const uint8_t *at;
    size_t offset; // in the file, if the text is not in memory
    uint32_t triangle;
    uint32_t positions, texcoords;
};

// Lines or points: two corners for each line, one for each point.
struct obj_strokes {
    uint32_t *positions, *texcoords; // one per corner, or OBJ_MISSING
    size_t corners;
    bool textured; // a corner has a texture coordinate
    size_t empty;  // number of statements without corners
    lam_part *parts;
    uint32_t part_count;
};

// The material files named so far.
struct obj_libraries {
    struct name_table tried; // keys: confined names; values: 1 read, 0 missing
    bool named, missing;     // `named`: the file refers to a library; `missing`: a library could not be opened or was
                             // skipped
    bool left_out;           // the file refers to more than OBJ_LIBRARIES_MAX libraries
};

struct obj {
    const struct import_source *source;
    struct lam_scene *scene;
    struct arena memory; // freed after the load
    const uint8_t *begin, *end;

    struct obj_chunk *chunks;
    size_t chunk_count;
    struct obj_counts total;
    bool colors_present;
    bool streamed; // obj_stream.c: only the statements are in memory

    float *positions, *texcoords, *normals, *colors; // colors: RGBA
    uint32_t *indices, *texcoord_indices, *normal_indices;
    struct mesh_polygon *polygons;
    struct obj_statement *statements;
    uint32_t *smoothing_groups;
    const uint8_t *inner_edges; // same as lam_mesh.inner_edges; NULL if not requested or there are no polygons
    lam_part *parts;
    uint32_t part_count;
    const char *object_name;       // the object's name if the file contains exactly one object; otherwise NULL
    struct obj_strokes strokes[2]; // points, lines

    bool is_cloud; // all vertices are points, because the file contains no faces, lines or points

    double origin[3];
    bool has_origin;

    struct mtl_set materials;
    struct obj_libraries libraries;
};

// obj_scan.c. Returns the start of the next logical line, or `end`. A backslash before '\n' continues a line.
const uint8_t *obj_next_line(const uint8_t *at, const uint8_t *end);
// Returns the next word of the statement, or the end of the statement ('\n' or `end`). Skips white space, line
// continuations and a comment.
const uint8_t *obj_next_word_slow(const uint8_t *at, const uint8_t *end);
bool obj_split(struct obj *obj, size_t chunk_bytes, lam_error *error);
bool obj_scan(struct obj *obj, lam_error *error); // pass one

// The state while a chunk is read.
struct obj_reader {
    struct obj *obj;
    struct obj_chunk *chunk;
    const uint8_t *end;      // the end of the file
    struct obj_counts next;  // index of the next element of each kind
    struct obj_counts limit; // end of the chunk's index ranges
    float low[4], high[4];   // bounding box of the positions; the fourth component is unused
    lam_error *error;
};

// obj_lines.c: reads lines up to the first line with a continuation. Returns the start of the next line, at most `end`,
// or NULL on error.
const uint8_t *obj_read_lines(struct obj_reader *reader, const uint8_t *line, const uint8_t *end);

// obj_line.c. Reads one logical line of any kind. Returns the start of the next line, or NULL on error.
const uint8_t *obj_read_line(struct obj_reader *reader, const uint8_t *at);
// obj_parse.c
bool obj_parse(struct obj *obj, lam_error *error); // pass two
// Parses one chunk. chunk->before and chunk->counts determine the index ranges of the chunk's elements. `error` may be
// NULL.
bool obj_parse_chunk(struct obj *obj, struct obj_chunk *chunk, lam_error *error);
// Chooses the origin. Reads the positions again as doubles if they are far from zero.
bool obj_find_origin(struct obj *obj, lam_error *error);

// obj_faces.c
bool obj_complete_texcoords(struct obj *obj, lam_error *error);
void obj_complete_normals(struct obj *obj);

// obj_groups.c
bool obj_read_statements(struct obj *obj, lam_error *error);

// obj_strokes.c. obj_strokes_corners returns the number of corners of an l statement if `lines` is true, otherwise of a
// p statement. obj_strokes_reserve allocates the arrays of corners and parts, obj_strokes_read reads one statement, and
// obj_strokes_add adds both meshes to the scene. `texcoords` are the texture coordinates of the file.
size_t obj_strokes_corners(const struct obj *obj, const uint8_t *at, bool lines);
bool obj_strokes_reserve(struct obj *obj, bool lines, size_t corners, size_t parts, lam_error *error);
bool obj_strokes_read(struct obj *obj, const struct obj_statement *statement, bool lines, lam_error *error);
bool obj_strokes_add(struct obj *obj, const float *texcoords, lam_error *error);

// obj_libraries.c. Reads the files of a mtllib statement at `at`: one name, possibly with spaces, or several names. If
// a file cannot be opened, the function warns and continues.
bool obj_read_libraries(struct obj *obj, const char *names, const uint8_t *at, lam_error *error);

// obj_stream.c. Reads the file in parts: all arrays, and the statements. Returns false if the whole text must be read.
bool obj_read_stream(struct obj *obj);

// obj_mesh.c: builds the mesh after positions and faces are read.
bool obj_complete(struct obj *obj, lam_error *error);

// Loads with chunks of `chunk_bytes`, for tests.
bool obj_load_chunked(const struct import_source *source, struct lam_scene *scene, size_t chunk_bytes,
                      lam_error *error);

// Returns the number of the line at `at`, which is in a statement if only the statements are in memory.
size_t obj_line_number(const struct obj *obj, const uint8_t *at);

// Returns whether a position is finite. scene_repair leaves out the faces of other positions.
static inline bool obj_finite(const float p[3]) { return (p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]) == 0; }

static inline bool obj_white(uint8_t c) { return c <= ' ' && c != '\n' && c != 0; }

static inline const uint8_t *obj_next_word(const uint8_t *at, const uint8_t *end)
{
    while (obj_white(*at)) // stops at the zero padding after the file
        at++;
    // In ASCII, digits, '-' and '.' have higher codes than '#', so most words take the fast path.
    return *at > '#' && *at != '\\' ? at : obj_next_word_slow(at, end);
}

// Returns whether the statement ends at `at`, after obj_next_word.
static inline bool obj_at_line_end(const uint8_t *at, const uint8_t *end) { return *at == '\n' || at >= end; }

// Returns whether a word ends at `at`.
static inline bool obj_at_word_end(const uint8_t *at)
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
    if (*at == '#' && memcmp(at, "#MRGB ", 6) != 0)
        return OBJ_EMPTY;
    return *at == '\n' || *at == 0 ? OBJ_EMPTY : OBJ_OTHER;
}

// Skips the rest of the statement and returns the start of the next line.
static inline const uint8_t *obj_skip_line(const uint8_t *at, const uint8_t *end)
{
    while (!obj_at_line_end(at, end)) {
        while (at < end && !obj_at_word_end(at))
            at++;
        const uint8_t *next = obj_next_word(at, end);
        at = next == at && !obj_at_line_end(at, end) ? at + 1 : next; // skips a zero byte
    }
    return at < end ? at + 1 : end;
}

#endif
