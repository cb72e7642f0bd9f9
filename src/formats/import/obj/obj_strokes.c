// obj_strokes.c: converts the statements `l` (lines: v or v/t for each vertex) and `p` (points) to separate meshes: one
// of lines and one of points.
#include "obj.h"

#include "fail.h"
#include "number.h"
#include "text_cursor.h"

// --- vertices of a statement

// One statement, and its context.
struct stroke_parser {
    struct obj *obj;
    const struct obj_statement *statement;
    const char *item; // "line", "point"
    lam_error *error;
};

static const uint8_t *fail_word(const struct stroke_parser *r, const uint8_t *at, const char *expected)
{
    char found[TEXT_FOUND_SIZE];
    struct obj *obj = r->obj;
    fail_line(r->error, obj->source, obj_line_number(obj, at), "found %s, expected %s",
              *at == '\n' ? "the end of the line" : text_found(at, obj->end, found), expected);
    return NULL;
}

// Reads an index: positive indices count from 1, and negative indices count backwards from `so_far`. Returns NULL on
// error.
static const uint8_t *read_index(const struct stroke_parser *r, const uint8_t *at, uint64_t total, uint64_t so_far,
                                 const char *name, uint32_t *out)
{
    struct obj *obj = r->obj;
    int64_t value;
    const uint8_t *next = number_int(at, obj->end, &value);
    if (!next)
        return fail_word(r, at, "the number of a vertex");
    uint64_t index = value > 0 ? (uint64_t)value - 1 : value < 0 ? so_far + (uint64_t)value : UINT64_MAX;
    if (index >= total) {
        size_t line = obj_line_number(obj, at);
        if (value == 0)
            fail_line(r->error, obj->source, line, "a %s names %s 0, expected an index from 1", r->item, name);
        else if (value > 0)
            fail_line(r->error, obj->source, line, "a %s names %s %lld, but the file has %llu", r->item, name,
                      (long long)value, (unsigned long long)total);
        else
            fail_line(r->error, obj->source, line, "a %s names %s %lld, counted back, but only %llu precede it",
                      r->item, name, (long long)value, (unsigned long long)so_far);
        return NULL;
    }
    *out = (uint32_t)index;
    return next;
}

// Reads the next vertex of a statement and returns the position after it. *found is false if there are no more
// vertices. Returns NULL on error.
static const uint8_t *read_vertex(const struct stroke_parser *r, const uint8_t *at, uint32_t *position,
                                  uint32_t *texcoord, bool *found)
{
    struct obj *obj = r->obj;
    *texcoord = OBJ_MISSING;
    at = obj_next_word(at, obj->end);
    *found = !obj_at_line_end(at, obj->end);
    if (!*found)
        return at;
    at = read_index(r, at, obj->total.positions, r->statement->positions, "vertex", position);
    if (at && *at == '/' && !obj_at_word_end(at + 1)) {
        bool known = obj->total.texcoords > 0; // otherwise the index is ignored, with a warning
        at = read_index(r, at + 1, known ? obj->total.texcoords : UINT64_MAX,
                        known ? r->statement->texcoords : r->statement->positions, "texture coordinate", texcoord);
        obj->chunks[0].texcoord_unknown |= !known;
        *texcoord = known ? *texcoord : OBJ_MISSING;
    } else if (at && *at == '/')
        at++;
    if (at && !obj_at_word_end(at))
        return fail_word(r, at, "a space between vertices (v or v/t)");
    return at;
}

// --- statements

size_t obj_strokes_corners(const struct obj *obj, const uint8_t *at, bool lines)
{
    size_t words = 0;
    for (at = obj_next_word(at + 1, obj->end); !obj_at_line_end(at, obj->end); at = obj_next_word(at, obj->end)) {
        words++;
        do // a zero byte is not a vertex; obj_strokes_read reports it
            at++;
        while (at < obj->end && !obj_at_word_end(at));
    }
    return !lines ? words : words < 2 ? 0 : 2 * (words - 1);
}

bool obj_strokes_reserve(struct obj *obj, bool lines, size_t corners, size_t parts, lam_error *error)
{
    struct obj_strokes *s = &obj->strokes[lines];
    if (!corners)
        return true;
    if (corners > UINT32_MAX / 2)
        return fail(error, LAM_LIMIT, "%s: %zu %s, expected at most %u", obj->source->name, corners,
                    lines ? "ends of lines" : "points", UINT32_MAX / 2);
    s->positions = arena_array(&obj->scene->arena, corners, sizeof *s->positions);
    s->texcoords = arena_array(&obj->memory, corners, sizeof *s->texcoords);
    s->parts = arena_array(&obj->scene->arena, parts, sizeof *s->parts);
    return (s->positions && s->texcoords && s->parts) ||
           call_memory_error(obj->source->call, corners * 2 * sizeof *s->positions + parts * sizeof *s->parts, error);
}

static void add_corner(struct obj_strokes *s, uint32_t position, uint32_t texcoord)
{
    s->positions[s->corners] = position;
    s->texcoords[s->corners++] = texcoord;
    s->textured |= texcoord != OBJ_MISSING;
}

bool obj_strokes_read(struct obj *obj, const struct obj_statement *statement, bool lines, lam_error *error)
{
    struct stroke_parser r = {obj, statement, lines ? "line" : "point", error};
    struct obj_strokes *s = &obj->strokes[lines];
    const uint8_t *at = statement->at + 1;
    uint32_t previous[2] = {0, 0}, position, texcoord;
    bool found;
    for (size_t count = 0;; count++) {
        at = read_vertex(&r, at, &position, &texcoord, &found);
        if (!at)
            return false;
        if (!found) {
            s->empty += count < (lines ? 2u : 1u);
            return true;
        }
        if (lines && count)
            add_corner(s, previous[0], previous[1]);
        if (!lines || count)
            add_corner(s, position, texcoord);
        previous[0] = position;
        previous[1] = texcoord;
    }
}

// --- meshes

// Builds the texture coordinates of all corners. Corners without texture coordinates get (0, 0).
static bool take_texcoords(struct obj *obj, const struct obj_strokes *s, const float *texcoords, lam_mesh *mesh,
                           lam_error *error)
{
    float *out = arena_array(&obj->scene->arena, s->corners, 2 * sizeof *out);
    uint32_t *indices = arena_array(&obj->scene->arena, s->corners, sizeof *indices);
    if (!out || !indices)
        return call_memory_error(obj->source->call, s->corners * 3 * sizeof *out, error);
    for (size_t i = 0; i < s->corners; i++) {
        for (size_t k = 0; k < 2; k++)
            out[2 * i + k] = s->texcoords[i] == OBJ_MISSING ? 0 : texcoords[2 * (size_t)s->texcoords[i] + k];
        indices[i] = (uint32_t)i;
    }
    mesh->texcoords = out;
    mesh->texcoord_count = (uint32_t)s->corners;
    mesh->texcoord_indices = indices;
    return true;
}

static bool add_mesh(struct obj *obj, bool lines, const float *texcoords, lam_error *error)
{
    const struct obj_strokes *s = &obj->strokes[lines];
    lam_mesh mesh = {
        .name = lines ? "lines" : "points",
        .origin = {obj->origin[0], obj->origin[1], obj->origin[2]},
        .positions = obj->positions,
        .vertex_count = (uint32_t)obj->total.positions,
        .indices = s->positions,
        .colors = obj->colors,
        .color_count = obj->colors ? (uint32_t)obj->total.positions : 0,
        .colors_format = obj->colors ? LAM_COLORS_LINEAR_F32 : LAM_COLORS_NONE,
        .parts = s->parts,
        .part_count = s->part_count,
        .line_count = lines ? (uint32_t)(s->corners / 2) : 0,
        .point_count = lines ? 0 : (uint32_t)s->corners,
    };
    return (!s->textured || take_texcoords(obj, s, texcoords, &mesh, error)) &&
           mesh_add_object(obj->scene, &mesh, obj->object_name, error);
}

bool obj_strokes_add(struct obj *obj, const float *texcoords, lam_error *error)
{
    for (int lines = 1; lines >= 0; lines--) {
        const struct obj_strokes *s = &obj->strokes[lines];
        if (s->empty)
            scene_warn(obj->scene, "%s: %zu %s ignored", obj->source->name, s->empty,
                       lines ? "lines of fewer than two vertices are" : "points without a vertex are");
        if (!s->corners)
            continue;
        obj->scene->shared_arrays = true; // the meshes share positions and colours
        if (!add_mesh(obj, lines, texcoords, error))
            return false;
    }
    return true;
}
