// material_words.c: parses descriptions of materials.
#include <lambent/words.h>

#include <string.h>
#include <strings.h>

#include "fail.h"
#include "fields.h"
#include "spelling.h"
#include "word_values.h"

// A number identifies each key. The first numbers are the indices of the fields in the table of lam_material_field. The
// next numbers are the factors of the fields, then the shorthands. The factors of colours are named ka, kd, ks and kr.
enum { MATERIAL_COLOR = 2 * LAM_FIELDS_MAX, MATERIAL_SPECULAR_COLOR, MATERIAL_KEYS };
_Static_assert((int)MATERIAL_KEYS <= (int)WORD_KEYS_MAX, "the lists of word_key_of");

// Names of materials that are not in the table of classic materials, and the descriptions that define them.
static const struct {
    const char *name, *words;
} others[] = {{"glass", "white,roughness=0,transmission=1"}};

enum { OTHERS = sizeof others / sizeof *others };

struct parser {
    lam_material_id id; // a named material, or LAM_MATERIAL_COUNT if the text contains no name
    const char *words;  // the description of one of `others`, or NULL
    bool given[MATERIAL_KEYS];
    bool ambient_is_diffuse; // whether the text contains ambient=diffuse
    double numbers[MATERIAL_KEYS][4];
};

static bool given(const struct parser *parser, int key) { return parser->given[key]; }

static bool is_color(const lam_field *field) { return field->type == LAM_FIELD_RGB || field->type == LAM_FIELD_RGBA; }

// Returns whether a field is a colour that scales light. Such fields have a symbol; the emission has no symbol.
static bool is_share(const lam_field *field) { return is_color(field) && field->symbol; }

static int factor_of(int field) { return LAM_FIELDS_MAX + field; }

// Returns the name of a key, or NULL if there is no such key.
static const char *key_name(int key)
{
    if (key >= MATERIAL_COLOR)
        return key == MATERIAL_COLOR ? "color" : "specular_color";
    const lam_field *field = lam_material_field(key % LAM_FIELDS_MAX);
    if (key < LAM_FIELDS_MAX || !field)
        return field ? field->key : NULL;
    return is_share(field) ? field->symbol : NULL;
}

const char *lam_material_key(int index)
{
    for (int key = 0; key < MATERIAL_KEYS; key++)
        if (key_name(key) && index-- == 0)
            return key_name(key);
    return NULL;
}

// Returns whether a key is a flag. The value of a flag may be omitted.
static bool is_flag(const char *name, size_t length)
{
    for (int i = 0; lam_material_field(i); i++) {
        const lam_field *field = lam_material_field(i);
        if (field->type == LAM_FIELD_FLAG && strlen(field->key) == length && memcmp(field->key, name, length) == 0)
            return true;
    }
    return false;
}

static bool read_pair(char *pair, lam_color_mode mode, struct parser *parser, lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value && !is_flag(pair, strlen(pair)))
        return fail(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value, such as shininess=50", pair);
    if (value)
        *value++ = 0;
    int key = word_key_of(pair, MATERIAL_KEYS, key_name, error);
    if (key < 0)
        return false;
    if (given(parser, key))
        return fail(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    parser->given[key] = true;
    if (value && strcmp(pair, "ambient") == 0 && strcmp(value, "diffuse") == 0) {
        parser->given[key] = false;
        parser->ambient_is_diffuse = true;
        return true;
    }
    if (key < LAM_FIELDS_MAX)
        return word_field(lam_material_field(key), value ? value : "yes", mode, parser->numbers[key], error);
    if (key < MATERIAL_COLOR)
        return word_number_of(pair, value, 0, 1e30, parser->numbers[key], error);
    const lam_field color = {.key = pair, .type = LAM_FIELD_RGB};
    return word_field(&color, value, mode, parser->numbers[key], error);
}

// Detects a colour without a key: #rrggbb, r/g/b or a name. A single number is not treated as a colour, because the
// number is more likely a value whose key was forgotten.
static bool is_color_alone(const char *word, lam_color_mode mode)
{
    lam_rgba color;
    bool digit = (*word >= '0' && *word <= '9') || *word == '.';
    return *word == '#' || strchr(word, '/') || (!digit && lam_color_parse(word, mode, &color, NULL));
}

static bool read_color_alone(const char *word, lam_color_mode mode, struct parser *parser, lam_error *error)
{
    static const lam_field color = {.key = "color", .type = LAM_FIELD_RGB};
    parser->given[MATERIAL_COLOR] = true;
    return word_field(&color, word, mode, parser->numbers[MATERIAL_COLOR], error);
}

static bool unknown_material(const char *name, lam_error *error)
{
    struct spelling spelling = spelling_of(name);
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++)
        spelling_try(&spelling, lam_material_name((lam_material_id)i));
    for (int i = 0; i < OTHERS; i++)
        spelling_try(&spelling, others[i].name);
    for (int i = 0; lam_color_name(i); i++)
        spelling_try(&spelling, lam_color_name(i));
    const char *nearest = spelling.nearest;
    return fail(error, LAM_BAD_ARGUMENT, "unknown material '%.60s'%s%s%s", name, nearest ? "; did you mean '" : "",
                nearest ? nearest : "",
                nearest ? "'?" : "; expected a name of `lambent materials`, a colour or key=value");
}

// Sets the first three channels of a colour and keeps its alpha.
static void set_color(const lam_field *field, lam_material *m, const double color[4], double factor)
{
    double numbers[4];
    lam_field_get(field, m, numbers);
    for (int i = 0; i < 3; i++)
        numbers[i] = color[i] * factor;
    lam_field_set(field, m, numbers);
}

static void set_factor(const struct parser *parser, int index, lam_material *m)
{
    static const double white[4] = {1, 1, 1, 1};
    const lam_field *field = lam_material_field(index);
    double color[4];
    lam_field_get(field, m, color);
    const double *from = color;
    if (field->standard[0] == 0 &&
        !given(parser, index)) // multiplies white, because a factor would have no effect on a default of black
        from = given(parser, MATERIAL_SPECULAR_COLOR) ? parser->numbers[MATERIAL_SPECULAR_COLOR] : white;
    set_color(field, m, from, parser->numbers[factor_of(index)][0]);
}

static lam_material apply(const struct parser *parser, lam_color_mode mode, lam_material m)
{
    if (parser->id != LAM_MATERIAL_COUNT)
        m = lam_material_named(parser->id, mode);
    if (parser->words) {
        m = lam_material_default();
        lam_material_parse(parser->words, mode, &m, NULL);
    }
    const double *color = parser->numbers[MATERIAL_COLOR], *specular = parser->numbers[MATERIAL_SPECULAR_COLOR];
    if (given(parser, MATERIAL_COLOR)) {
        m.ambient = (lam_rgb){(float)color[0], (float)color[1], (float)color[2]};
        m.diffuse = (lam_rgba){m.ambient.r, m.ambient.g, m.ambient.b, m.diffuse.a};
    }
    if (given(parser, MATERIAL_SPECULAR_COLOR))
        m.specular = (lam_rgb){(float)specular[0], (float)specular[1], (float)specular[2]};
    for (int i = 0; lam_material_field(i); i++)
        if (given(parser, i)) {
            material_note_written(&m, i);
            word_set_field(lam_material_field(i), &m, parser->numbers[i]);
            if (strcmp(lam_material_field(i)->key, "opacity") == 0 && m.alpha_mode == LAM_ALPHA_OPAQUE)
                m.alpha_mode = LAM_ALPHA_BLEND; // an opaque material would ignore the alpha
        }
    for (int i = 0; lam_material_field(i); i++)
        if (given(parser, factor_of(i)))
            set_factor(parser, i, &m);
    if (parser->ambient_is_diffuse)
        m.ambient = (lam_rgb){m.diffuse.r, m.diffuse.g, m.diffuse.b};
    return m;
}

bool lam_material_parse(const char *text, lam_color_mode mode, lam_material *material, lam_error *error)
{
    struct parser parser = {.id = LAM_MATERIAL_COUNT};
    char copy[WORDS_MAX], *rest = copy;
    if (!text || !material)
        return fail(error, LAM_BAD_ARGUMENT, "lam_material_parse: %s is NULL", text ? "material" : "text");
    if (!word_copy(text, copy, error))
        return false;
    if (!*rest)
        return fail(error, LAM_BAD_ARGUMENT, "the value is empty, expected a material's name or key=value");
    size_t first = strcspn(rest, ",");
    if (!memchr(rest, '=', first) && !is_flag(rest, first)) {
        char *name = strsep(&rest, ",");
        parser.id = lam_material_find(name);
        for (int i = 0; i < OTHERS; i++)
            parser.words = strcasecmp(others[i].name, name) == 0 ? others[i].words : parser.words;
        bool known = parser.id != LAM_MATERIAL_COUNT || parser.words;
        if (!known && !is_color_alone(name, mode))
            return unknown_material(name, error);
        if (!known && !read_color_alone(name, mode, &parser, error))
            return false;
    }
    for (char *pair; (pair = strsep(&rest, ",")) != NULL;)
        if (!read_pair(pair, mode, &parser, error))
            return false;
    *material = apply(&parser, mode, *material);
    return true;
}
