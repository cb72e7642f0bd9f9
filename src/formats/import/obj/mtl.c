// mtl.c: reads MTL, the material files of OBJ. docs/formats.md documents each statement.
#include "mtl.h"

#include "fields.h"
#include "srgb.h"
#include "number.h"
#include "shown_name.h"
#include "text_cursor.h"

#include <lambent/material.h>

#include <string.h>
#include <strings.h>

// The state while a file is read.
struct mtl_parser {
    struct mtl_set *set;
    struct lam_scene *scene;
    const char *name; // the file's name, for messages
    const uint8_t *begin, *end;
    // Line number cache (line_of): `line` is the line number of `counted_to`.
    const uint8_t *counted_to;
    size_t line;
    bool raw; // colours are not converted
    // The current material, and the statements that were read for it.
    lam_material material;
    bool open, ka, kd, d;
    const uint8_t *opacity, *exponent; // the statement d or Tr, and the statement Ns; NULL if missing
    // The first occurrence of each problem that is reported once per file: unknown statements, and statements before
    // the first newmtl.
    const uint8_t *unknown, *stray, *wide; // `wide` is the first highlight with the exponent 0
    size_t unknown_count, stray_count, wide_count;
};

// Returns the line number of `at`, for warnings. Counting continues from the previous call, so that many warnings need
// only one pass over the file.
static size_t line_of(struct mtl_parser *reader, const uint8_t *at)
{
    if (at < reader->counted_to || !reader->counted_to) {
        reader->counted_to = reader->begin;
        reader->line = 1;
    }
    reader->line += text_line(reader->counted_to, at) - 1;
    reader->counted_to = at;
    return reader->line;
}

// Reads up to `max` numbers and returns their count, or −1 with a warning if there are fewer than `min`.
static int read_numbers(struct mtl_parser *reader, const uint8_t *at, const uint8_t *end, float *to, int min, int max)
{
    int count = 0;
    while (count < max) {
        at = text_skip_white(at, end);
        const uint8_t *next = number_float(at, end, &to[count]);
        if (!next || (next < end && !text_white(*next)))
            break;
        count++;
        at = next;
    }
    if (count >= min)
        return count;
    char found[TEXT_FOUND_SIZE];
    scene_warn(reader->scene, "%s:%zu: found %s, expected a number; the statement is ignored", reader->name,
               line_of(reader, at), at < end ? text_found(at, end, found) : "the end of the line");
    return -1;
}

// Clamps a number to a range, and warns if the number is outside this range.
static float within(struct mtl_parser *reader, const uint8_t *at, float x, float low, float high, const char *what)
{
    if (x >= low && x <= high)
        return x;
    float to = x > high ? high : low; // NaN becomes the lower limit
    scene_warn(reader->scene, "%s:%zu: %s %g is out of range, %g is used", reader->name, line_of(reader, at), what,
               (double)x, (double)to);
    return to;
}

// Returns a channel as linear light. Values of 1 or more are not changed, because the sRGB curve ends at 1.
static float linear(const struct mtl_parser *reader, float c)
{
    return reader->raw || c >= 1 ? c : (float)srgb_linear((double)c);
}

// Reads K… r [g b]; a single number sets all three channels. Warns and returns false if the statement must be ignored.
static bool read_color(struct mtl_parser *reader, const uint8_t *at, const uint8_t *end, const char *what, lam_rgb *out)
{
    at = text_skip_white(at, end);
    if (text_is_word(at, end, "spectral") || text_is_word(at, end, "xyz")) {
        scene_warn(reader->scene, "%s:%zu: %s as a %s is not supported, expected r g b", reader->name,
                   line_of(reader, at), what, text_is_word(at, end, "xyz") ? "CIE XYZ colour" : "spectral curve");
        return false;
    }
    float c[3];
    int count = read_numbers(reader, at, end, c, 1, 3);
    if (count < 1)
        return false;
    if (count < 3)
        c[1] = c[2] = c[0];
    for (int i = 0; i < 3; i++)
        c[i] = within(reader, at, c[i], 0, 1e6f, what);
    *out = (lam_rgb){linear(reader, c[0]), linear(reader, c[1]), linear(reader, c[2])};
    return true;
}

static bool is_black(lam_rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }

// A map multiplies a colour, which is white by default. Exporters write a black diffuse colour beside a map by mistake.
static void whiten_mapped(struct mtl_parser *reader, lam_material *m)
{
    char shown[SHOWN_NAME_SIZE];
    if (!m->map_names[LAM_MAP_DIFFUSE] ||
        (reader->kd && !is_black((lam_rgb){m->diffuse.r, m->diffuse.g, m->diffuse.b})))
        return;
    m->diffuse.r = m->diffuse.g = m->diffuse.b = 1;
    if (reader->kd)
        scene_warn(reader->scene, "%s: material '%s' has a black Kd and a map_Kd; it is drawn with Kd 1 1 1",
                   reader->name, shown_name(m->name, shown));
}

// If all colours of a material are black, replaces its ambient and diffuse colours by the neutral grey, with a warning,
// because exporters write such materials by mistake.
static void replace_black(struct mtl_parser *reader, lam_material *m)
{
    lam_rgb kd = {m->diffuse.r, m->diffuse.g, m->diffuse.b};
    if (!reader->kd || !is_black(kd) || !is_black(m->ambient) || !is_black(m->specular) || !is_black(m->emission))
        return;
    lam_material neutral = lam_material_default();
    m->ambient = neutral.ambient;
    m->diffuse = (lam_rgba){neutral.diffuse.r, neutral.diffuse.g, neutral.diffuse.b, m->diffuse.a};
    char shown[SHOWN_NAME_SIZE];
    scene_warn(reader->scene, "%s: material '%s' is black in every colour; it is drawn in neutral grey", reader->name,
               shown_name(m->name, shown));
}

static void note_clear(struct mtl_parser *reader)
{
    char shown[SHOWN_NAME_SIZE];
    // only the first warning needs the statement's line
    size_t line = reader->scene->clear_materials ? 0 : text_line(reader->begin, reader->opacity);
    scene_note_clear(reader->scene, "%s:%zu: material '%s' is fully transparent (%s)", reader->name, line,
                     shown_name(reader->material.name, shown), reader->d ? "d 0" : "Tr 1");
}

// With the exponent 0, the highlight covers the whole lit area. MeshLab writes Ks 1 1 1 and Ns 0 for materials without
// a highlight.
static void remove_wide_highlight(struct mtl_parser *reader, lam_material *m)
{
    if (!reader->exponent || m->shininess > 0 || is_black(m->specular))
        return;
    m->specular = (lam_rgb){0, 0, 0};
    if (reader->wide_count++ == 0)
        reader->wide = reader->exponent;
}

// Completes the current material and adds it to the scene.
static bool close_material(struct mtl_parser *reader, lam_error *error)
{
    if (!reader->open)
        return true;
    lam_material *m = &reader->material;
    whiten_mapped(reader, m);
    replace_black(reader, m);
    if (!reader->ka)
        m->ambient = (lam_rgb){m->diffuse.r, m->diffuse.g, m->diffuse.b};
    if (m->illum == 0) { // unlit: the surface emits its colour
        m->emission =
            (lam_rgb){m->emission.r + m->diffuse.r, m->emission.g + m->diffuse.g, m->emission.b + m->diffuse.b};
        m->diffuse.r = m->diffuse.g = m->diffuse.b = 0;
        m->ambient = (lam_rgb){0, 0, 0};
    }
    if (m->illum == 0 || m->illum == 1)
        m->specular = (lam_rgb){0, 0, 0};
    remove_wide_highlight(reader, m);
    if (m->diffuse.a == 0)
        note_clear(reader);
    int index = scene_adopt_material(reader->scene, m, error);
    if (index < 0)
        return false;
    reader->open = false;
    return name_table_add(&reader->set->by_name, m->name, index) ||
           call_memory_error(reader->scene->arena.call, reader->set->by_name.capacity * sizeof(struct name_entry),
                             error);
}

static bool start_material(struct mtl_parser *reader, const uint8_t *at, const uint8_t *end, lam_error *error)
{
    end = text_name_end(at, end);
    if (!close_material(reader, error))
        return false;
    reader->material = lam_material_default();
    reader->material.name = text_name(&reader->scene->arena, at, (size_t)(end - at));
    if (!reader->material.name)
        return call_memory_error(reader->scene->arena.call, (size_t)(end - at), error);
    reader->material.illum = -1;
    reader->material.specular = (lam_rgb){0, 0, 0}; // a material without Ks has no highlight
    reader->open = true;
    reader->ka = reader->kd = reader->d = false;
    reader->opacity = reader->exponent = NULL;
    return true;
}

// Skips a map's options and returns the start of its file name, which may contain spaces. Options after a file name end
// at `end`: their last word may be a number.
static const uint8_t *skip_options(const uint8_t *at, const uint8_t *end, bool after_name)
{
    static const struct {
        const char *word;
        int min, max; // the number of arguments; optional arguments must be numbers
    } options[] = {
        {"-blendu", 1, 1}, {"-blendv", 1, 1},     {"-boost", 1, 1},   {"-bm", 1, 1},   {"-cc", 1, 1},
        {"-clamp", 1, 1},  {"-colorspace", 1, 1}, {"-imfchan", 1, 1}, {"-mm", 2, 2},   {"-o", 1, 3},
        {"-s", 1, 3},      {"-t", 1, 3},          {"-texres", 1, 1},  {"-type", 1, 1},
    };
    for (;;) {
        int option = -1;
        for (int i = 0; i < (int)(sizeof options / sizeof *options); i++) {
            if (text_is_word(at, end, options[i].word))
                option = i;
        }
        if (option < 0)
            return at;
        const uint8_t *begin = at;
        int count = 0;
        at = text_skip_white(text_skip_word(at, end), end);
        for (float unused; count < options[option].max && at < end; count++) {
            const uint8_t *word = text_skip_word(at, end);
            bool is_number = number_float(at, end, &unused) == word;
            // The last word is the file name, even if it is a number.
            if (count >= options[option].min && (!is_number || (!after_name && text_skip_white(word, end) == end)))
                break;
            if (after_name && !is_number && memchr(at, '.', (size_t)(word - at)))
                return begin; // a file name that contains " -"
            at = text_skip_white(word, end);
        }
        if (after_name && count < options[option].min)
            return begin;
    }
}

// Returns the end of a map's file name: the first white space that only options follow.
static const uint8_t *name_end(const uint8_t *name, const uint8_t *end)
{
    for (const uint8_t *at = text_skip_word(name, end); at < end; at = text_skip_word(at, end)) {
        const uint8_t *stop = at;
        at = text_skip_white(at, end);
        if (*at == '-' && skip_options(at, end, true) == end)
            return stop;
    }
    return end;
}

static bool read_map(struct mtl_parser *reader, enum lam_map map, const uint8_t *at, const uint8_t *end,
                     lam_error *error)
{
    end = text_name_end(at, end);
    const uint8_t *name = skip_options(at, end, false), *after = name_end(name, end);
    if (name == end) { // exporters write an empty map statement for "none"
        if (at < end)
            scene_warn(reader->scene, "%s:%zu: found options without a file name; the statement is ignored",
                       reader->name, line_of(reader, at));
        return true;
    }
    struct arena *arena = &reader->scene->arena;
    // the options before and after the name
    size_t length = (size_t)(text_name_end(at, name) - at), name_length = (size_t)(after - name);
    after = length ? after : text_skip_white(after, end);
    size_t more = (size_t)(end - after);
    uint8_t *options = arena_alloc(arena, length + more);
    for (size_t i = 0; options && i < length + more; i++) {
        uint8_t c = i < length ? at[i] : after[i - length];
        options[i] = text_white(c) ? ' ' : c;
    }
    reader->material.map_names[map] = text_name(arena, name, name_length);
    reader->material.map_options[map] = options && length + more ? text_name(arena, options, length + more) : NULL;
    reader->set->other_maps += map == LAM_MAP_DISPLACEMENT;
    reader->set->reflection_maps += map == LAM_MAP_REFLECTION;
    return (reader->material.map_names[map] && (length + more == 0 || reader->material.map_options[map])) ||
           call_memory_error(arena->call, (size_t)(end - at), error);
}

enum statement {
    NEWMTL,
    TR,
    ILLUM,
    MAP,                           // MAP + enum lam_map
    NOTHING = MAP + LAM_MAP_COUNT, // a known statement that the classic models do not support
    OTHER_MAP,
    UNKNOWN,
    FIELD, // FIELD + the index of the material's field that the statement sets
};

static const struct {
    const char *word;
    enum statement statement;
} words[] = {
    {"newmtl", NEWMTL},
    {"tr", TR},
    {"illum", ILLUM},
    {"map_ka", MAP + LAM_MAP_AMBIENT},
    {"map_kd", MAP + LAM_MAP_DIFFUSE},
    {"map_ks", MAP + LAM_MAP_SPECULAR},
    {"map_ke", MAP + LAM_MAP_EMISSION},
    {"map_ns", MAP + LAM_MAP_SHININESS},
    {"map_d", MAP + LAM_MAP_OPACITY},
    {"map_bump", MAP + LAM_MAP_BUMP},
    {"bump", MAP + LAM_MAP_BUMP},
    {"norm", MAP + LAM_MAP_NORMAL},
    {"map_norm", MAP + LAM_MAP_NORMAL},
    {"disp", MAP + LAM_MAP_DISPLACEMENT},
    {"map_disp", MAP + LAM_MAP_DISPLACEMENT},
    {"refl", MAP + LAM_MAP_REFLECTION},
    {"map_refl", MAP + LAM_MAP_REFLECTION},
    {"map_pm", MAP + LAM_MAP_METALLIC},
    {"map_pr", MAP + LAM_MAP_ROUGHNESS},
    // Statements for refraction, for the transmission filter, for the sharpness of reflections, and for physically
    // based materials.
    {"ni", NOTHING},
    {"tf", NOTHING},
    {"kt", NOTHING},
    {"km", NOTHING},
    {"kr", NOTHING},
    {"sharpness", NOTHING},
    {"ps", NOTHING},
    {"pc", NOTHING},
    {"pcr", NOTHING},
    {"aniso", NOTHING},
    {"anisor", NOTHING},
    {"map_aat", NOTHING},
};

static int statement_of(const uint8_t *at, const uint8_t *end)
{
    for (int i = 0; lam_material_field(i); i++) {
        const char *source = lam_material_field(i)->source;
        size_t length = (size_t)(text_skip_word(at, end) - at);
        if (source && strlen(source) == length && strncasecmp((const char *)at, source, length) == 0)
            return FIELD + i;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (text_is_word(at, end, words[i].word))
            return (int)words[i].statement;
    }
    bool map = end - at > 4 && strncasecmp((const char *)at, "map_", 4) == 0;
    return map || text_is_word(at, end, "decal") ? OTHER_MAP : UNKNOWN;
}

// Reads a colour or a number. The alpha of a colour is not read. A number is clamped to the range of the field.
static void read_material_field(struct mtl_parser *reader, int index, const uint8_t *at, const uint8_t *end)
{
    const lam_field *field = lam_material_field(index);
    lam_material *m = &reader->material;
    double numbers[4];
    if (lam_field_get(field, m, numbers) == 1) {
        float number, max = field->max < 1e6 ? (float)field->max : 1e6f;
        if (text_is_word(at, end, "-halo")) // an option of the statement d
            at = text_skip_white(text_skip_word(at, end), end);
        if (read_numbers(reader, at, end, &number, 1, 1) != 1)
            return;
        numbers[0] = (double)within(reader, at, number, (float)field->min, max, field->source);
    } else {
        lam_rgb color;
        if (!read_color(reader, at, end, field->source, &color))
            return;
        numbers[0] = (double)color.r, numbers[1] = (double)color.g, numbers[2] = (double)color.b;
    }
    lam_field_set(field, m, numbers);
    material_note_written(m, index);
    if (field->offset == offsetof(lam_material, ambient)) // Ka 1 1 1 is ignored, because exporters write it by default
        reader->ka = !(numbers[0] == 1 && numbers[1] == 1 && numbers[2] == 1);
    reader->kd |= field->offset == offsetof(lam_material, diffuse);
    reader->d |= field->offset == offsetof(lam_material, diffuse.a);
}

static bool read_statement(struct mtl_parser *reader, const uint8_t *at, const uint8_t *end, lam_error *error)
{
    int statement = statement_of(at, end);
    const uint8_t *word = at;
    at = text_skip_white(text_skip_word(at, end), end);
    if (statement == NEWMTL)
        return start_material(reader, at, end, error);
    if (statement == UNKNOWN) {
        if (reader->unknown_count++ == 0)
            reader->unknown = word;
        return true;
    }
    if (!reader->open) {
        if (reader->stray_count++ == 0)
            reader->stray = word;
        return true;
    }
    lam_material *m = &reader->material;
    float number;
    if (statement >= FIELD) {
        const lam_field *field = lam_material_field(statement - FIELD);
        read_material_field(reader, statement - FIELD, at, end);
        if (field->offset == offsetof(lam_material, diffuse.a))
            reader->opacity = word;
        if (field->offset == offsetof(lam_material, shininess))
            reader->exponent = word;
        return true;
    }
    switch (statement) {
    case TR: // if both are present, in any order, d is used
        if (!reader->d && read_numbers(reader, at, end, &number, 1, 1) == 1) {
            m->diffuse.a = 1 - within(reader, at, number, 0, 1, "Tr");
            reader->opacity = word;
        }
        break;
    case ILLUM: {
        int64_t model;
        if (number_int(at, end, &model) && model >= 0 && model <= 10)
            m->illum = (int)model;
        else
            scene_warn(reader->scene, "%s:%zu: illum is not one of the models 0 to 10; it is ignored", reader->name,
                       line_of(reader, word));
        break;
    }
    case NOTHING:
        break;
    case OTHER_MAP:
        reader->set->other_maps += at < end;
        break;
    default:
        return read_map(reader, (enum lam_map)(statement - MAP), at, end, error);
    }
    return true;
}

bool mtl_read(struct mtl_set *set, const struct import_source *source, struct lam_scene *scene,
              const struct companion *library, lam_error *error)
{
    const struct file_bytes *file = &library->file;
    const char *name = library->shown;
    struct mtl_parser reader = {
        .set = set,
        .scene = scene,
        .name = name,
        .begin = file->data,
        .end = file->data + file->size,
        .raw = source->params->color == LAM_COLOR_RAW,
    };
    const uint8_t *at = reader.begin;
    if (file->size >= 3 && memcmp(at, "\xef\xbb\xbf", 3) == 0) // a byte order mark
        at += 3;
    for (size_t line = 0; at < reader.end; line++) {
        if (line % 4096 == 4095 && !call_should_continue(source->call))
            return call_error(source->call, error);
        const uint8_t *stop = text_line_end(at, reader.end), *last = stop;
        at = text_skip_white(at, stop);
        while (last > at && text_white(last[-1]))
            last--;
        if (at < last && *at != '#' && !read_statement(&reader, at, last, error))
            return false;
        at = stop < reader.end ? stop + 1 : stop;
    }
    char found[TEXT_FOUND_SIZE];
    const uint8_t *zero = memchr(reader.begin, 0, file->size);
    if (zero)
        scene_warn(scene, "%s:%zu: found a zero byte, expected text", name, text_line(reader.begin, zero));
    if (reader.unknown_count)
        scene_warn(scene, "%s:%zu: unknown statement %s%s", name, text_line(reader.begin, reader.unknown),
                   text_found(reader.unknown, reader.end, found), reader.unknown_count > 1 ? " and others" : "");
    if (reader.stray_count)
        scene_warn(scene, "%s:%zu: %s before the first newmtl is ignored", name, text_line(reader.begin, reader.stray),
                   text_found(reader.stray, reader.end, found));
    if (!close_material(&reader, error))
        return false;
    if (reader.wide_count)
        scene_warn(scene, "%s:%zu: with Ns 0 the highlight would cover all lit points; it is omitted%s", name,
                   text_line(reader.begin, reader.wide), reader.wide_count > 1 ? ", here and in other materials" : "");
    return true;
}
