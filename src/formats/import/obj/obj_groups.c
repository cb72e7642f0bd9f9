// obj_groups.c: reads the statements between vertices and faces of an OBJ file, in file order: object, group, material,
// smoothing group, material files, lines and points, and elements that are not drawn.
//
// A part is a range of triangles with the same object, group and material. The part's name is "object/group", or only
// one of these two names if the other is missing. A new object ends the group.
#include "obj.h"

#include "mtl_maps.h"

#include "fail.h"
#include "number.h"
#include "shown_name.h"
#include "srgb.h"
#include "text_cursor.h"

#include <string.h>

enum statement {
    OBJECT,
    GROUP,
    MATERIAL,
    LIBRARY,
    SMOOTHING,
    LINES,
    POINTS,
    FREE_FORM, // curves and surfaces with their points and parameters
    IGNORED,   // known statements without effect
    MRGB,      // vertex colours of ZBrush
    UNKNOWN,
    STATEMENTS,
};

static const struct {
    const char *word;
    enum statement statement;
} keywords[] = {
    {"o", OBJECT},           {"g", GROUP},           {"usemtl", MATERIAL}, {"mtllib", LIBRARY},
    {"s", SMOOTHING},        {"l", LINES},           {"p", POINTS},        {"vp", FREE_FORM},
    {"cstype", FREE_FORM},   {"deg", FREE_FORM},     {"bmat", FREE_FORM},  {"step", FREE_FORM},
    {"curv", FREE_FORM},     {"curv2", FREE_FORM},   {"surf", FREE_FORM},  {"parm", FREE_FORM},
    {"trim", FREE_FORM},     {"hole", FREE_FORM},    {"scrv", FREE_FORM},  {"sp", FREE_FORM},
    {"end", FREE_FORM},      {"con", FREE_FORM},     {"ctech", FREE_FORM}, {"stech", FREE_FORM},
    {"bzp", FREE_FORM},      {"bsp", FREE_FORM},     {"cdc", FREE_FORM},   {"cdp", FREE_FORM},
    {"res", FREE_FORM},      {"mg", IGNORED},        {"bevel", IGNORED},   {"c_interp", IGNORED},
    {"d_interp", IGNORED},   {"lod", IGNORED},       {"maplib", IGNORED},  {"usemap", IGNORED},
    {"shadow_obj", IGNORED}, {"trace_obj", IGNORED}, {"#mrgb", MRGB},
};

// The object and group of the last part that consists of lines or of points.
struct stroke_part {
    const char *object, *group;
};

// The state after the statements read so far.
struct state {
    struct obj *obj;
    const char *object, *group;
    int32_t material;
    const char *part_object, *part_group; // names of the last part
    const char *part_name;                // "object/group"
    uint32_t smoothing, smoothing_from;   // the smoothing group, and its first triangle
    uint32_t objects;
    const uint8_t *broken_colors;     // the first text in a statement MRGB that is no colour of a vertex, or NULL
    size_t colors;                    // the number of channels of vertices that MRGB has set
    struct stroke_part strokes[2];    // the parts of points and of lines
    size_t counts[STATEMENTS];        // number of statements of each kind
    const uint8_t *first[STATEMENTS]; // first statement of each kind
    size_t unknown_materials;
    const char *unknown_material; // the name of the first unknown material
    const uint8_t *unknown_material_at;
};

static bool no_memory(const struct state *state, size_t bytes, lam_error *error)
{
    return call_memory_error(state->obj->source->call, bytes, error);
}

static enum statement statement_of(const uint8_t *at, const uint8_t *end)
{
    for (size_t i = 0; i < sizeof keywords / sizeof *keywords; i++) {
        if (text_is_word(at, end, keywords[i].word))
            return keywords[i].statement;
    }
    return UNKNOWN;
}

// Reads the rest of a statement as a trimmed name; lines joined by a backslash are separated by spaces. *out is NULL
// for an empty name.
static bool read_name(struct state *state, const uint8_t *at, const char **out, lam_error *error)
{
    const uint8_t *end = obj_next_line(at, state->obj->end);
    at = text_skip_word(at, end);
    at = text_skip_white(at, end);
    end = text_name_end(at, end);
    *out = NULL;
    if (at == end)
        return true;
    char *name = text_name(&state->obj->scene->arena, at, (size_t)(end - at));
    if (!name)
        return no_memory(state, (size_t)(end - at), error);
    // text_name has converted line continuations, "\\\n", to "\\?"; this loop replaces both characters by spaces.
    for (const uint8_t *c = at; c < end; c++) {
        if (*c == '\n') {
            for (char *back = name + (c - at); back >= name && (*back == '?' || *back == '\\'); back--)
                *back = ' ';
        }
    }
    *out = name;
    return true;
}

static bool same_name(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

// --- parts

// Sets *out to "object/group", or to only one of these two names if the other is missing.
static bool join_names(const struct state *state, const char *object, const char *group, const char **out,
                       lam_error *error)
{
    *out = object ? object : group;
    if (!object || !group)
        return true;
    size_t length = strlen(object), rest = strlen(group);
    char *name = arena_alloc(&state->obj->scene->arena, length + rest + 2);
    if (!name)
        return no_memory(state, length + rest, error);
    // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the text appended after it ends with zero
    memcpy(name, object, length);
    name[length] = '/';
    memcpy(name + length + 1, group, rest + 1);
    *out = name;
    return true;
}

// Assigns the state's object, group and material to the triangles from the end of the last part up to `triangle`.
static bool end_part(struct state *state, uint32_t triangle, lam_error *error)
{
    struct obj *obj = state->obj;
    lam_part *last = obj->part_count ? &obj->parts[obj->part_count - 1] : NULL;
    uint32_t from = last ? last->first_triangle + last->triangle_count : 0;
    if (triangle == from)
        return true;
    bool same = last && same_name(state->object, state->part_object) && same_name(state->group, state->part_group);
    if (same && last->material == state->material) {
        last->triangle_count += triangle - from;
        return true;
    }
    if (!same) {
        state->part_object = state->object;
        state->part_group = state->group;
        if (!join_names(state, state->object, state->group, &state->part_name, error))
            return false;
    }
    obj->parts[obj->part_count++] = (lam_part){.name = state->part_name,
                                               .first_triangle = from,
                                               .triangle_count = triangle - from,
                                               .material = state->material};
    return true;
}

// Reads lines or points. The lines or points extend the last part if that part has the state's object, group and
// material. Otherwise, they form a new part.
static bool read_strokes(struct state *state, const struct obj_statement *s, bool lines, lam_error *error)
{
    struct obj *obj = state->obj;
    struct obj_strokes *strokes = &obj->strokes[lines];
    struct stroke_part *of = &state->strokes[lines];
    size_t before = strokes->corners;
    if (!obj_strokes_read(obj, s, lines, error))
        return false;
    uint32_t first = (uint32_t)(lines ? before / 2 : before);
    uint32_t more = (uint32_t)(lines ? strokes->corners / 2 : strokes->corners) - first;
    if (!more)
        return true;
    lam_part *last = strokes->part_count ? &strokes->parts[strokes->part_count - 1] : NULL;
    if (last && last->material == state->material && same_name(of->object, state->object) &&
        same_name(of->group, state->group)) {
        last->triangle_count += more;
        return true;
    }
    lam_part *part = &strokes->parts[strokes->part_count++];
    *part = (lam_part){.first_triangle = first, .triangle_count = more, .material = state->material};
    *of = (struct stroke_part){state->object, state->group};
    return join_names(state, state->object, state->group, &part->name, error);
}

static void fill_smoothing(struct state *state, uint32_t triangle)
{
    if (state->obj->smoothing_groups) {
        for (uint32_t t = state->smoothing_from; t < triangle; t++)
            state->obj->smoothing_groups[t] = state->smoothing;
    }
    state->smoothing_from = triangle;
}

// --- materials

static bool read_libraries(struct state *state, const uint8_t *at, lam_error *error)
{
    const char *names;
    return read_name(state, at, &names, error) && (!names || obj_read_libraries(state->obj, names, at, error));
}

static bool use_material(struct state *state, const uint8_t *at, lam_error *error)
{
    const char *name;
    if (!read_name(state, at, &name, error))
        return false;
    state->material = name ? name_table_find(&state->obj->materials.by_name, name) : -1;
    if (name && state->material < 0) {
        if (state->unknown_materials++ == 0) {
            state->unknown_material = name;
            state->unknown_material_at = at;
        }
    }
    return true;
}

// --- the statements in order

// Returns the group of an "s" statement; 0 means off.
static uint32_t read_smoothing(const struct obj *obj, const uint8_t *at)
{
    const uint8_t *end = text_line_end(at, obj->end);
    int64_t group = 0;
    at = text_skip_white(text_skip_word(at, end), end);
    if (text_is_word(at, end, "on"))
        return 1;
    return number_int(at, end, &group) ? (uint32_t)group : 0; // 0 for "off" or a missing group
}

static bool has_mrgb(const uint8_t *at)
{
    char digits[9] = "";
    memcpy(digits, at, 8);
    return strspn(digits, "0123456789abcdefABCDEF") == 8;
}

// Reads colours of the next vertices: for each vertex eight hexadecimal digits, of a mask and of red, green and blue.
// Vertices without a colour are white.
static bool read_mrgb(struct state *state, const uint8_t *at, lam_error *error)
{
    struct obj *obj = state->obj;
    size_t numbers = 4 * (size_t)obj->total.positions;
    bool raw = obj->source->params->color == LAM_COLOR_RAW;
    if (obj->colors_present)
        return true; // the statements v contain colours
    if (!obj->colors && !(obj->colors = arena_array(&obj->scene->arena, numbers, sizeof(float))))
        return no_memory(state, numbers * sizeof(float), error);
    for (size_t i = state->colors; i < numbers && state->colors == 0; i++)
        obj->colors[i] = 1;
    at = text_skip_white(text_skip_word(at, obj->end), obj->end);
    while (has_mrgb(at) && state->colors < numbers) {
        float *color = obj->colors + state->colors;
        for (int i = 0; i < 3; i++) {
            int byte = number_hex_digit((char)at[2 + 2 * i]) * 16 + number_hex_digit((char)at[3 + 2 * i]);
            color[i] = (float)(raw ? byte / 255.0 : srgb_linear(byte / 255.0));
        }
        at += 8;
        state->colors += 4;
    }
    if (!obj_at_line_end(obj_next_word(at, obj->end), obj->end) && !state->broken_colors)
        state->broken_colors = at;
    return true;
}

static bool apply_statement(struct state *state, enum statement statement, const struct obj_statement *s,
                            lam_error *error)
{
    if (state->counts[statement]++ == 0)
        state->first[statement] = s->at;
    switch (statement) {
    case OBJECT:
        if (!end_part(state, s->triangle, error) || !read_name(state, s->at, &state->object, error))
            return false;
        state->group = NULL;
        if (state->objects++ == 0)
            state->obj->object_name = state->object;
        else if (!same_name(state->obj->object_name, state->object))
            state->obj->object_name = NULL;
        return true;
    case GROUP:
        return end_part(state, s->triangle, error) && read_name(state, s->at, &state->group, error);
    case MATERIAL:
        return end_part(state, s->triangle, error) && use_material(state, s->at, error);
    case SMOOTHING:
        fill_smoothing(state, s->triangle);
        state->smoothing = read_smoothing(state->obj, s->at);
        return true;
    case MRGB:
        return read_mrgb(state, s->at, error);
    case LINES:
    case POINTS:
        return read_strokes(state, s, statement == LINES, error);
    default:
        return true;
    }
}

static void warn_elements(struct state *state)
{
    struct obj *obj = state->obj;
    const char *name = obj->source->name;
    size_t free_form = state->counts[FREE_FORM];
    char found[TEXT_FOUND_SIZE];
    if (free_form)
        scene_warn(obj->scene,
                   "%s:%zu: free-form curves and surfaces are not drawn: %s is the first of %zu such statements", name,
                   obj_line_number(obj, state->first[FREE_FORM]), text_found(state->first[FREE_FORM], obj->end, found),
                   free_form);
    if (state->broken_colors)
        scene_warn(
            obj->scene,
            "%s:%zu: found %s in #MRGB, expected eight hexadecimal digits for each vertex; the rest of the line is "
            "ignored",
            name, obj_line_number(obj, state->broken_colors), text_found(state->broken_colors, obj->end, found));
    else if (obj->colors && !obj->colors_present && state->colors < 4 * obj->total.positions)
        scene_warn(obj->scene, "%s: #MRGB gives colours to %zu of %llu vertices; the others are white", name,
                   state->colors / 4, (unsigned long long)obj->total.positions);
    if (state->counts[UNKNOWN])
        scene_warn(obj->scene, "%s:%zu: unknown statement %s, the first of %zu that are ignored", name,
                   obj_line_number(obj, state->first[UNKNOWN]), text_found(state->first[UNKNOWN], obj->end, found),
                   state->counts[UNKNOWN]);
}

// Reports a file that contains only unsupported elements. load.c reports empty files.
static bool fail_without_faces(struct state *state, lam_error *error)
{
    struct obj *obj = state->obj;
    const char *name = obj->source->name;
    char found[TEXT_FOUND_SIZE];
    if (state->counts[FREE_FORM])
        return fail(
            error, LAM_UNSUPPORTED,
            "%s:%zu: contains no faces, only free-form curves and surfaces (%s), which this version cannot draw", name,
            obj_line_number(obj, state->first[FREE_FORM]), text_found(state->first[FREE_FORM], obj->end, found));
    if (state->counts[UNKNOWN])
        return fail(error, LAM_CANNOT_READ,
                    "%s:%zu: found %s, expected a statement of OBJ (v, f, …); the file contains nothing to draw", name,
                    obj_line_number(obj, state->first[UNKNOWN]), text_found(state->first[UNKNOWN], obj->end, found));
    return true;
}

static void warn_materials(struct state *state)
{
    struct obj *obj = state->obj;
    const char *name = obj->source->name;
    if (state->unknown_materials && !obj->libraries.missing) {
        size_t line = obj_line_number(obj, state->unknown_material_at);
        char shown[SHOWN_NAME_SIZE];
        shown_name(state->unknown_material, shown);
        if (!obj->libraries.named)
            scene_warn(obj->scene,
                       "%s:%zu: uses the material '%s' but names no material file; it is drawn in neutral grey", name,
                       line, shown);
        else if (state->unknown_materials == 1)
            scene_warn(obj->scene, "%s:%zu: no material file defines the material '%s'; it is drawn in neutral grey",
                       name, line, shown);
        else
            scene_warn(obj->scene,
                       "%s:%zu: no material file defines the material '%s', the first of %zu uses of undefined "
                       "materials, which are drawn in neutral grey",
                       name, line, shown, state->unknown_materials);
    }
    size_t maps = obj->materials.other_maps, reflections = obj->materials.reflection_maps;
    if (reflections)
        scene_warn(obj->scene,
                   "%s: %zu reflection map%s (refl) %s not drawn: materials mirror the scene's environment, which they "
                   "have in common",
                   name, reflections, reflections == 1 ? "" : "s", reflections == 1 ? "is" : "are");
    if (maps)
        scene_warn(obj->scene, "%s: %zu map%s of materials that this version does not draw", name, maps,
                   maps == 1 ? "" : "s");
}

bool obj_read_statements(struct obj *obj, lam_error *error)
{
    struct call_control *call = obj->source->call;
    struct state state = {.obj = obj, .material = -1};
    size_t count = (size_t)obj->total.others, parts = 1, corners[2] = {0, 0};
    bool smoothing = false;
    uint8_t *kinds = arena_alloc(&obj->memory, count);
    if (!kinds)
        return no_memory(&state, count, error);
    for (size_t i = 0; i < count; i++) {
        if (i % 4096 == 4095 && !call_should_continue(call))
            return call_error(call, error);
        kinds[i] = (uint8_t)statement_of(obj->statements[i].at, obj->end);
        parts += kinds[i] == OBJECT || kinds[i] == GROUP || kinds[i] == MATERIAL;
        if (kinds[i] == LINES || kinds[i] == POINTS)
            corners[kinds[i] == LINES] += obj_strokes_corners(obj, obj->statements[i].at, kinds[i] == LINES);
        // If all groups are off, the file defines no smoothing groups.
        smoothing |= kinds[i] == SMOOTHING && read_smoothing(obj, obj->statements[i].at) != 0;
        // All material files are read first, because some programs write mtllib after the first usemtl.
        if (kinds[i] == LIBRARY && !read_libraries(&state, obj->statements[i].at, error))
            return false;
    }

    uint32_t triangles = (uint32_t)obj->total.triangles;
    obj->parts = arena_array(&obj->scene->arena, parts, sizeof *obj->parts);
    if (!obj->parts)
        return no_memory(&state, parts * sizeof *obj->parts, error);
    for (int lines = 0; lines < 2; lines++)
        if (!obj_strokes_reserve(obj, lines, corners[lines], parts, error))
            return false;
    if (smoothing) {
        obj->smoothing_groups = arena_array(&obj->scene->arena, triangles, sizeof(uint32_t));
        if (!obj->smoothing_groups)
            return no_memory(&state, triangles * sizeof(uint32_t), error);
    }
    for (size_t i = 0; i < count; i++) {
        if (i % 4096 == 4095 && !call_should_continue(call))
            return call_error(call, error);
        if (!apply_statement(&state, (enum statement)kinds[i], &obj->statements[i], error))
            return false;
    }
    fill_smoothing(&state, triangles);
    if (!end_part(&state, triangles, error))
        return false;
    obj->is_cloud = triangles == 0 && !obj->strokes[0].corners && !obj->strokes[1].corners;
    if (obj->is_cloud && (!obj->total.positions || state.counts[FREE_FORM]))
        return fail_without_faces(&state, error);
    warn_elements(&state);
    warn_materials(&state);
    return mtl_maps_read(obj->source, obj->scene, &obj->materials, &obj->memory, error);
}
