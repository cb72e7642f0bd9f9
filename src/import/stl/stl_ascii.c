// stl_ascii.c: ASCII STL: solids become named parts, facets three corners each.
//
//   solid NAME
//     facet normal NX NY NZ
//       outer loop
//         vertex X Y Z      three of them
//       endloop
//     endfacet
//   endsolid NAME
// Keywords are taken in any case and lines broken anywhere, for writers differ; a name ends with its line.
// The facets' normals are not read: they follow from the corners, and some programs write nan there.
#include "stl.h"
#include "fail.h"
#include "number.h"
#include "origin.h"
#include "text_cursor.h"

#include <float.h>
#include <string.h>

struct reading {
    const struct import_source *source;
    struct lam_scene *scene;
    const uint8_t *start, *at, *end;
    float *positions; // 3 a corner
    double *exact;    // likewise, the second pass for a part far from zero; NULL in the first
    bool far_out;     // first pass: a number was beyond a float's range
    float minimum[3], maximum[3];
    lam_part *parts;
    uint32_t part_count;
    uint32_t facets;
};

static bool fail_at(const struct reading *reading, lam_error *error, const char *expected)
{
    char found[TEXT_FOUND_SIZE];
    return fail_line(error, reading->source, text_line(reading->source->bytes, reading->at),
                     "facet %u: found %s, expected %s", reading->facets + 1,
                     text_found(reading->at, reading->end, found), expected);
}

static bool next_is(struct reading *reading, const char *word)
{
    reading->at = text_skip_white(reading->at, reading->end);
    return text_is_word(reading->at, reading->end, word);
}

// Goes past the next word if it is this one.
static bool take(struct reading *reading, const char *word)
{
    if (!next_is(reading, word))
        return false;
    reading->at = text_skip_word(reading->at, reading->end);
    return true;
}

static bool expect(struct reading *reading, const char *word, lam_error *error)
{
    if (take(reading, word))
        return true;
    char quoted[16] = "\"";
    size_t length = 1;
    while (*word && length < sizeof quoted - 2)
        quoted[length++] = *word++;
    quoted[length] = '"';
    return fail_at(reading, error, quoted);
}

static bool read_corner(struct reading *reading, size_t corner, lam_error *error)
{
    for (int axis = 0; axis < 3; axis++) {
        reading->at = text_skip_white(reading->at, reading->end);
        float value = 0.0f;
        double exact = 0.0;
        const uint8_t *next = reading->exact ? number_double(reading->at, reading->end, &exact)
                                             : number_float(reading->at, reading->end, &value);
        if (!next || (next < reading->end && !text_white(*next)))
            return fail_at(reading, error, "a number");
        if (reading->exact) {
            if (!(exact >= -DBL_MAX && exact <= DBL_MAX))
                return fail_at(reading, error, "a finite number");
            reading->exact[3 * corner + (size_t)axis] = exact;
        } else {
            if (!(value >= -FLT_MAX && value <= FLT_MAX))
                reading->far_out = true; // the second pass has the range of doubles, and knows what is wrong
            if (value < reading->minimum[axis])
                reading->minimum[axis] = value;
            if (value > reading->maximum[axis])
                reading->maximum[axis] = value;
            reading->positions[3 * corner + (size_t)axis] = value;
        }
        reading->at = next;
    }
    return true;
}

static bool read_facet(struct reading *reading, lam_error *error)
{
    if (take(reading, "normal")) {
        for (int i = 0; i < 3 && !next_is(reading, "outer"); i++)
            reading->at = text_skip_word(reading->at, reading->end);
    }
    if (!expect(reading, "outer", error))
        return false;
    if (!expect(reading, "loop", error))
        return false;
    for (size_t c = 0; c < 3; c++) {
        if (!expect(reading, "vertex", error) || !read_corner(reading, 3 * (size_t)reading->facets + c, error))
            return false;
    }
    if (!expect(reading, "endloop", error) || !expect(reading, "endfacet", error))
        return false;
    reading->facets++;
    return true;
}

// The rest of the line, without white space around it: a solid's name. It ends before "facet normal" too, for
// files written as one line.
static void take_name(struct reading *reading, const uint8_t **name, size_t *length)
{
    const uint8_t *line_end = text_line_end(reading->at, reading->end);
    const uint8_t *at = text_skip_white(reading->at, line_end), *stop = at;
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
    reading->at = at;
}

static bool begin_part(struct reading *reading, const uint8_t *name, size_t length, lam_error *error)
{
    if (reading->part_count > 0 && reading->parts[reading->part_count - 1].first_triangle == reading->facets)
        reading->part_count--; // a solid without facets
    lam_part *part = &reading->parts[reading->part_count++];
    *part = (lam_part){.first_triangle = reading->facets, .material = -1};
    if (length == 0)
        return true;
    part->name = text_name(&reading->scene->arena, name, length);
    return part->name || call_memory_error(reading->source->call, length, error);
}

static bool read_all(struct reading *reading, lam_error *error)
{
    enum { LOOK = 1024 }; // facets between two looks at the watch
    reading->at = reading->start;
    reading->facets = reading->part_count = 0;
    bool inside = false;
    for (;;) {
        const uint8_t *name;
        size_t length;
        if (take(reading, "facet")) {
            if (!inside && !begin_part(reading, NULL, 0, error))
                return false;
            inside = true;
            if (!read_facet(reading, error))
                return false;
            if (reading->facets % LOOK == 0 && !call_should_continue(reading->source->call))
                return call_error(reading->source->call, error);
        } else if (take(reading, "solid")) {
            take_name(reading, &name, &length);
            if (!begin_part(reading, name, length, error))
                return false;
            inside = true;
        } else if (take(reading, "endsolid")) {
            take_name(reading, &name, &length);
            inside = false;
        } else if (reading->at == reading->end) {
            break;
        } else {
            return fail_at(reading, error, "\"facet\", \"endsolid\" or \"solid\"");
        }
    }
    if (reading->part_count > 0 && reading->parts[reading->part_count - 1].first_triangle == reading->facets)
        reading->part_count--;
    for (uint32_t i = 0; i < reading->part_count; i++) {
        uint32_t next = i + 1 < reading->part_count ? reading->parts[i + 1].first_triangle : reading->facets;
        reading->parts[i].triangle_count = next - reading->parts[i].first_triangle;
    }
    return true;
}

// Reads the numbers once more, as doubles, and rounds them relative to an origin.
static bool read_far_out(struct reading *reading, struct arena *scratch, double origin[3], lam_error *error)
{
    size_t numbers = 9 * (size_t)reading->facets;
    reading->exact = arena_array(scratch, numbers, sizeof(double));
    if (!reading->exact)
        return call_memory_error(reading->source->call, numbers * sizeof(double), error);
    if (!read_all(reading, error))
        return false;
    double minimum[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, maximum[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (size_t i = 0; i < numbers; i++) {
        double value = reading->exact[i];
        minimum[i % 3] = value < minimum[i % 3] ? value : minimum[i % 3];
        maximum[i % 3] = value > maximum[i % 3] ? value : maximum[i % 3];
    }
    origin_choose(minimum, maximum, origin);
    for (size_t i = 0; i < numbers; i++) {
        double relative = reading->exact[i] - origin[i % 3];
        if (!(relative >= -(double)FLT_MAX && relative <= (double)FLT_MAX))
            return fail(error, LAM_CANNOT_READ, "%s: facet %zu: corner %zu lies too far from the others for a float",
                        reading->source->name, i / 9 + 1, i % 9 / 3 + 1);
        reading->positions[i] = (float)relative;
    }
    return true;
}

bool stl_load_ascii(const struct import_source *source, struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    struct reading reading = {.source = source, .scene = scene, .start = source->bytes};
    reading.end = source->bytes + source->size;
    if (source->size >= 3 && memcmp(reading.start, "\xef\xbb\xbf", 3) == 0)
        reading.start += 3; // a byte order mark
    for (int axis = 0; axis < 3; axis++) {
        reading.minimum[axis] = FLT_MAX;
        reading.maximum[axis] = -FLT_MAX;
    }

    // Each corner takes the word "vertex" and each part begins behind one of these; names that hold such
    // words only make the room larger.
    size_t corners = text_count_word(reading.start, reading.end, "vertex");
    size_t parts = 1 + text_count_word(reading.start, reading.end, "solid") +
                   text_count_word(reading.start, reading.end, "endsolid");
    if (corners / 3 > STL_FACETS_MAX)
        return stl_fail_too_many(source, corners / 3, error);
    reading.positions = arena_array(&scene->arena, corners, 3 * sizeof(float));
    reading.parts = arena_array(&scene->arena, parts, sizeof(lam_part));
    if (!reading.positions || !reading.parts)
        return call_memory_error(source->call, corners * 3 * sizeof(float) + parts * sizeof(lam_part), error);
    if (!read_all(&reading, error))
        return false;
    if (reading.facets == 0)
        return true;

    double minimum[3], maximum[3];
    for (int axis = 0; axis < 3; axis++) {
        minimum[axis] = (double)reading.minimum[axis];
        maximum[axis] = (double)reading.maximum[axis];
    }
    if (reading.far_out || origin_choose(minimum, maximum, mesh->origin)) {
        struct arena scratch;
        arena_start(&scratch, source->call);
        bool done = read_far_out(&reading, &scratch, mesh->origin, error);
        arena_free(&scratch);
        if (!done)
            return false;
    }
    mesh->positions = reading.positions;
    mesh->vertex_count = 3 * reading.facets;
    mesh->triangle_count = reading.facets;
    if (reading.part_count > 1 || reading.parts[0].name) {
        mesh->parts = reading.parts;
        mesh->part_count = reading.part_count;
    }
    return true;
}
