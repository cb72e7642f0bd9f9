// stl_ascii.c: reads ASCII STL: solids become named parts; each facet has three separate vertices.
//
//  solid NAME
//    facet normal NX NY NZ
//      outer loop
//        vertex X Y Z      three of them
//      endloop
//    endfacet
//  endsolid NAME
//
// Keywords may be in upper or lower case, and line breaks may occur between any words, because programs differ. A name
// extends to the end of the line. The facets' normals are ignored, because the corners determine the normals and some
// programs write nan.
#include "stl.h"
#include "fail.h"
#include "number.h"
#include "origin.h"
#include "text_cursor.h"

#include <float.h>
#include <string.h>

struct stl_ascii_parser {
    const struct import_source *source;
    struct lam_scene *scene;
    const uint8_t *start, *at, *end;
    float *positions; // 3 per corner
    double *exact;    // positions in the second pass, for models far from zero; NULL in the first pass
    float minimum[3], maximum[3];
    lam_part *parts;
    uint32_t part_count;
    uint32_t facets;
    const uint8_t *solid; // the statement that began the current solid, or NULL
    // The number of solids without "endsolid". For the first such solid: the position of the statement "solid", and the
    // position at which "endsolid" was expected.
    uint32_t unclosed;
    const uint8_t *first_unclosed, *end_expected;
    const uint8_t *remark; // the first line after a solid that does not begin another solid, or NULL
};

static bool fail_at(const struct stl_ascii_parser *reader, lam_error *error, const char *expected)
{
    char found[TEXT_FOUND_SIZE];
    return fail_line(error, reader->source, text_line(reader->source->bytes, reader->at),
                     "facet %u: found %s, expected %s", reader->facets + 1, text_found(reader->at, reader->end, found),
                     expected);
}

static bool next_is(struct stl_ascii_parser *reader, const char *word)
{
    reader->at = text_skip_white(reader->at, reader->end);
    return text_is_word(reader->at, reader->end, word);
}

// Skips the next word if it is `word`. Returns whether the next word was skipped.
static bool accept_word(struct stl_ascii_parser *reader, const char *word)
{
    if (!next_is(reader, word))
        return false;
    reader->at = text_skip_word(reader->at, reader->end);
    return true;
}

static bool expect(struct stl_ascii_parser *reader, const char *word, lam_error *error)
{
    if (accept_word(reader, word))
        return true;
    char quoted[16] = "\"";
    size_t length = 1;
    while (*word && length < sizeof quoted - 2)
        quoted[length++] = *word++;
    quoted[length] = '"';
    return fail_at(reader, error, quoted);
}

static bool read_corner(struct stl_ascii_parser *reader, size_t corner, lam_error *error)
{
    for (int axis = 0; axis < 3; axis++) {
        reader->at = text_skip_white(reader->at, reader->end);
        float value = 0.0f;
        double exact = 0.0;
        const uint8_t *next = reader->exact ? number_double(reader->at, reader->end, &exact)
                                            : number_float(reader->at, reader->end, &value);
        if (!next || (next < reader->end && !text_white(*next)))
            return fail_at(reader, error, "a number");
        // scene_repair leaves out facets whose positions do not fit into floats.
        if (reader->exact) {
            bool fits = exact >= -(double)FLT_MAX && exact <= (double)FLT_MAX;
            reader->exact[3 * corner + (size_t)axis] = fits ? exact : __builtin_nan("");
        } else {
            if (value < reader->minimum[axis] && value >= -FLT_MAX)
                reader->minimum[axis] = value;
            if (value > reader->maximum[axis] && value <= FLT_MAX)
                reader->maximum[axis] = value;
            reader->positions[3 * corner + (size_t)axis] = value;
        }
        reader->at = next;
    }
    return true;
}

static bool read_facet(struct stl_ascii_parser *reader, lam_error *error)
{
    if (accept_word(reader, "normal")) {
        for (int i = 0; i < 3 && !next_is(reader, "outer"); i++)
            reader->at = text_skip_word(reader->at, reader->end);
    }
    if (!expect(reader, "outer", error))
        return false;
    if (!expect(reader, "loop", error))
        return false;
    for (size_t c = 0; c < 3; c++) {
        if (!expect(reader, "vertex", error) || !read_corner(reader, 3 * (size_t)reader->facets + c, error))
            return false;
    }
    if (!expect(reader, "endloop", error) || !expect(reader, "endfacet", error))
        return false;
    reader->facets++;
    return true;
}

// Reads a solid's name: the rest of the line, trimmed. In files that consist of a single line, the name ends before
// "facet normal".
static void read_name(struct stl_ascii_parser *reader, const uint8_t **name, size_t *length)
{
    const uint8_t *line_end = text_line_end(reader->at, reader->end);
    const uint8_t *at = text_skip_white(reader->at, line_end), *stop = at;
    *name = at;
    while (at < line_end) {
        const uint8_t *word_end = text_skip_word(at, line_end);
        const uint8_t *next = text_skip_white(word_end, line_end);
        if (text_is_word(at, line_end, "facet") && text_is_word(next, line_end, "normal"))
            break;
        stop = word_end;
        at = next;
    }
    *length = (size_t)(stop - *name);
    reader->at = at;
}

static bool begin_part(struct stl_ascii_parser *reader, const uint8_t *name, size_t length, lam_error *error)
{
    if (reader->part_count > 0 && reader->parts[reader->part_count - 1].first_triangle == reader->facets)
        reader->part_count--; // drops a solid without facets
    lam_part *part = &reader->parts[reader->part_count++];
    *part = (lam_part){.first_triangle = reader->facets, .material = -1};
    if (length == 0)
        return true;
    part->name = text_name(&reader->scene->arena, name, length);
    return part->name || call_memory_error(reader->source->call, length, error);
}

// Opens a solid at `at` (NULL means there is no statement). If the previous solid is still open, its "endsolid" is
// missing.
static void open_solid(struct stl_ascii_parser *reader, const uint8_t *at)
{
    if (reader->solid && reader->unclosed++ == 0) {
        reader->first_unclosed = reader->solid;
        reader->end_expected = reader->at;
    }
    reader->solid = at;
}

static void warn_unclosed(const struct stl_ascii_parser *reader)
{
    const struct import_source *source = reader->source;
    char found[TEXT_FOUND_SIZE];
    if (!reader->unclosed)
        return;
    scene_warn(reader->scene, "%s:%zu: found %s, expected \"endsolid\" for the solid in line %zu%s%s", source->name,
               text_line(source->bytes, reader->end_expected), text_found(reader->end_expected, reader->end, found),
               text_line(source->bytes, reader->first_unclosed),
               reader->end_expected == reader->end ? "; the file may be cut short" : "",
               reader->unclosed > 1 ? ", the first of several solids without \"endsolid\"" : "");
}

static bool read_all(struct stl_ascii_parser *reader, lam_error *error)
{
    enum { CHECK_INTERVAL = 1024 }; // the number of facets between two checks whether the call must stop
    reader->at = reader->start;
    reader->facets = reader->part_count = reader->unclosed = 0;
    reader->solid = NULL;
    bool inside = false;
    for (;;) {
        const uint8_t *name;
        size_t length;
        if (accept_word(reader, "facet")) {
            if (!inside && !begin_part(reader, NULL, 0, error))
                return false;
            inside = true;
            if (!read_facet(reader, error))
                return false;
            if (reader->facets % CHECK_INTERVAL == 0 && !call_should_continue(reader->source->call))
                return call_error(reader->source->call, error);
        } else if (next_is(reader, "solid")) {
            open_solid(reader, reader->at);
            accept_word(reader, "solid");
            read_name(reader, &name, &length);
            if (!begin_part(reader, name, length, error))
                return false;
            inside = true;
        } else if (accept_word(reader, "endsolid")) {
            read_name(reader, &name, &length);
            reader->solid = NULL;
            inside = false;
        } else if (reader->at == reader->end) {
            open_solid(reader, NULL);
            break;
        } else if (!inside && reader->part_count > 0) { // a remark after a solid
            reader->remark = reader->remark ? reader->remark : reader->at;
            reader->at = text_line_end(reader->at, reader->end);
        } else {
            return fail_at(reader, error, "\"facet\", \"endsolid\" or \"solid\"");
        }
    }
    if (reader->part_count > 0 && reader->parts[reader->part_count - 1].first_triangle == reader->facets)
        reader->part_count--;
    for (uint32_t i = 0; i < reader->part_count; i++) {
        uint32_t next = i + 1 < reader->part_count ? reader->parts[i + 1].first_triangle : reader->facets;
        reader->parts[i].triangle_count = next - reader->parts[i].first_triangle;
    }
    return true;
}

// Reads the positions again, as doubles, and rounds them relative to an origin.
static bool read_doubles(struct stl_ascii_parser *reader, struct arena *scratch, double origin[3], lam_error *error)
{
    size_t numbers = 9 * (size_t)reader->facets;
    reader->exact = arena_array(scratch, numbers, sizeof(double));
    if (!reader->exact)
        return call_memory_error(reader->source->call, numbers * sizeof(double), error);
    if (!read_all(reader, error))
        return false;
    double minimum[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, maximum[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (size_t i = 0; i < numbers; i++) {
        double value = reader->exact[i];
        minimum[i % 3] = value < minimum[i % 3] ? value : minimum[i % 3];
        maximum[i % 3] = value > maximum[i % 3] ? value : maximum[i % 3];
    }
    origin_choose(minimum, maximum, origin);
    for (size_t i = 0; i < numbers; i++) {
        reader->positions[i] = (float)(reader->exact[i] - origin[i % 3]);
    }
    return true;
}

bool stl_load_ascii(const struct import_source *source, struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    struct stl_ascii_parser reader = {.source = source, .scene = scene, .start = source->bytes};
    reader.end = source->bytes + source->size;
    if (source->size >= 3 && memcmp(reader.start, "\xef\xbb\xbf", 3) == 0)
        reader.start += 3; // a byte order mark
    for (int axis = 0; axis < 3; axis++) {
        reader.minimum[axis] = FLT_MAX;
        reader.maximum[axis] = -FLT_MAX;
    }

    const uint8_t *zero = memchr(reader.start, 0, (size_t)(reader.end - reader.start));
    if (zero)
        return fail_line(error, source, text_line(source->bytes, zero), "found a zero byte, expected text");

    // These are upper bounds: each corner begins with the word "vertex", and each part after the first one follows
    // "solid" or "endsolid". Names may contain these words too.
    size_t corners = text_count_word(reader.start, reader.end, "vertex");
    size_t parts =
        1 + text_count_word(reader.start, reader.end, "solid") + text_count_word(reader.start, reader.end, "endsolid");
    if (!stl_check_count(source, corners / 3, error))
        return false;
    reader.positions = arena_array(&scene->arena, corners, 3 * sizeof(float));
    reader.parts = arena_array(&scene->arena, parts, sizeof(lam_part));
    if (!reader.positions || !reader.parts)
        return call_memory_error(source->call, corners * 3 * sizeof(float) + parts * sizeof(lam_part), error);
    if (!read_all(&reader, error))
        return false;
    if (reader.facets == 0)
        return true;
    warn_unclosed(&reader);
    char found[TEXT_FOUND_SIZE];
    if (reader.remark)
        scene_warn(scene,
                   "%s:%zu: found %s after \"endsolid\", expected \"solid\" or the end of the file; the line is "
                   "ignored",
                   source->name, text_line(source->bytes, reader.remark), text_found(reader.remark, reader.end, found));

    double minimum[3], maximum[3];
    for (int axis = 0; axis < 3; axis++) {
        minimum[axis] = (double)reader.minimum[axis];
        maximum[axis] = (double)reader.maximum[axis];
    }
    if (origin_choose(minimum, maximum, mesh->origin)) {
        struct arena scratch;
        arena_start(&scratch, source->call);
        bool done = read_doubles(&reader, &scratch, mesh->origin, error);
        arena_free(&scratch);
        if (!done)
            return false;
    }
    mesh->positions = reader.positions;
    mesh->vertex_count = 3 * reader.facets;
    mesh->triangle_count = reader.facets;
    if (reader.part_count > 1 || reader.parts[0].name) {
        mesh->parts = reader.parts;
        mesh->part_count = reader.part_count;
    }
    return true;
}
