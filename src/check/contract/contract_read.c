// contract_read.c: reads a contract from its JSON file.
#include "contract.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "json_parse.h"
#include "json_reader.h"
#include "spelling.h"

struct reader {
    struct json_reader json;
    struct arena *arena;
    struct contract *contract;
    struct contract_name *names; // contract->names while it is read
    int name_count;
};

static bool no_memory(const struct reader *r) { return fail_memory(r->json.error, 1); }

static const struct json_choice space_words[] = {
    {"eye", LAM_FRAME_CAMERA}, {"world", LAM_FRAME_WORLD}, {"object", LAM_FRAME_OBJECT}, {NULL, 0}};

// --- words and names

static const struct {
    const char *name;
    unsigned type;
} types[] = {{"float", TYPE_SCALAR}, {"int", TYPE_SCALAR},  {"bool", TYPE_SCALAR},
             {"vec2", TYPE_VEC2},    {"vec3", TYPE_VECTOR}, {"vec4", TYPE_VECTOR},
             {"mat3", TYPE_MATRIX},  {"mat4", TYPE_MATRIX}, {"sampler2D", TYPE_SAMPLER}};
enum { TYPES = sizeof types / sizeof *types };

// A name of GLSL: identifiers joined by dots; "[]" after the first one makes it a list.
static bool is_name(const char *text, bool plain)
{
    for (bool first = true;; first = false) {
        if (!isalpha((unsigned char)*text) && *text != '_')
            return false;
        while (isalnum((unsigned char)*text) || *text == '_')
            text++;
        if (first && !plain && strncmp(text, "[]", 2) == 0)
            text += 2;
        if (!*text)
            return true;
        if (plain || *text++ != '.')
            return false;
    }
}

static bool check_name(const struct reader *r, const struct place *place, const char *name, bool plain)
{
    return (strlen(name) < 64 && is_name(name, plain)) ||
           json_fail(&r->json, place, "found \"%.40s\", expected a name of GLSL%s", name,
                     plain ? "" : " such as \"color\", \"light.color\" or \"lights[].color\"");
}

// A list of texts, joined by `between`. Each is checked where it must be a name.
static bool read_list(struct reader *r, const struct place *place, const json_t *list, const char *between,
                      bool of_names, bool plain, const char **out)
{
    if (!json_is_array(list))
        return json_unexpected(&r->json, place, list, "a list of texts");
    size_t length = 1;
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *item = json_array_get(list, i);
        if (!json_is_string(item) || !json_string_length(item))
            return json_unexpected(&r->json, ELEMENT_OF(place, i), item, "a text that is not empty");
        if (of_names && !check_name(r, ELEMENT_OF(place, i), json_string_value(item), plain))
            return false;
        length += json_string_length(item) + strlen(between);
    }
    char *text = arena_alloc_zeroed(r->arena, length);
    if (!text)
        return no_memory(r);
    for (size_t i = 0; i < json_array_size(list); i++) {
        strcat(text, i ? between : "");
        strcat(text, json_string_value(json_array_get(list, i)));
    }
    *out = *text ? text : NULL;
    return true;
}

// --- attributes and uniforms

static bool read_role(struct reader *r, const struct place *place, const json_t *value, bool attribute,
                      const struct role **out)
{
    unsigned use = attribute ? ROLE_ATTRIBUTE : ROLE_UNIFORM;
    const char *words[64] = {NULL};
    int count = 0;
    const char *found = json_is_string(value) ? json_string_value(value) : "";
    for (int i = 0; i < role_count && count < 64; i++) {
        if (!(roles[i].uses & use))
            continue;
        if (strcmp(roles[i].name, found) == 0) {
            *out = &roles[i];
            return true;
        }
        words[count++] = roles[i].name;
    }
    const char *nearest = strlen(found) <= 40 ? nearest_word(found, words, count) : NULL;
    char expected[120];
    snprintf(expected, sizeof expected, "a role of %s%s%s%s", attribute ? "attributes" : "uniforms",
             nearest ? "; did you mean '" : ", such as light_position", nearest ? nearest : "", nearest ? "'?" : "");
    if (value)
        return json_unexpected(&r->json, KEY_OF(place, "role"), value, expected);
    return json_fail(&r->json, place, "the key 'role' is missing, expected %s", expected);
}

static bool read_type(struct reader *r, const struct place *place, const json_t *value, const struct role *role,
                      const char **out)
{
    const char *found = json_is_string(value) ? json_string_value(value) : "";
    char fitting[100] = "";
    for (int i = 0; i < TYPES; i++) {
        if (!(types[i].type & role->types))
            continue;
        if (strcmp(types[i].name, found) == 0) {
            *out = types[i].name;
            return true;
        }
        size_t used = strlen(fitting);
        snprintf(fitting + used, sizeof fitting - used, "%s%s", used ? ", " : "", types[i].name);
    }
    if (!value)
        return json_fail(&r->json, place, "the key 'type' is missing, expected %s", fitting);
    char expected[160];
    snprintf(expected, sizeof expected, "a type that fits the role %s: %s", role->name, fitting);
    return json_unexpected(&r->json, KEY_OF(place, "type"), value, expected);
}

// The group of a light's name: what stands before its last dot.
static bool find_group(struct reader *r, const struct place *place, const char *name, int *group)
{
    struct contract *c = r->contract;
    const char *dot = strrchr(name, '.');
    size_t length = dot ? (size_t)(dot - name) : 0;
    for (int i = 0; i < c->group_count; i++)
        if (strlen(c->groups[i]) == length && strncmp(c->groups[i], name, length) == 0) {
            *group = i;
            return true;
        }
    if (c->group_count == MAX_LIGHT_GROUPS)
        return json_fail(&r->json, place, "found lights in more than %d structs and lists", MAX_LIGHT_GROUPS);
    *group = c->group_count;
    c->groups[c->group_count] = arena_string_of(r->arena, name, length);
    return c->groups[c->group_count++] || no_memory(r);
}

static bool is_taken(const struct reader *r, const char *name, bool attribute)
{
    size_t length = strlen(name);
    for (int i = 0; i < r->name_count; i++) {
        const struct contract_name *n = &r->names[i];
        if (n->attribute == attribute && strcmp(n->name, name) == 0)
            return true;
        for (const char *at = n->attribute == attribute ? n->synonyms : NULL; at && (at = strstr(at, name));
             at += length)
            if ((at == n->synonyms || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0))
                return true;
    }
    return false;
}

static bool read_name(struct reader *r, const struct place *place, const char *name, const json_t *value,
                      bool attribute)
{
    static const char *const keys[] = {"role", "type", "space", "also", "meaning", NULL};
    const struct role *role = NULL;
    int space = r->contract->space;
    struct contract_name row = {.attribute = attribute, .group = -1};
    if (!check_name(r, place, name, attribute) || !json_check_keys(&r->json, place, value, keys) ||
        !read_role(r, place, json_object_get(value, "role"), attribute, &role) ||
        !read_type(r, place, json_object_get(value, "type"), role, &row.type) ||
        !json_take_word(&r->json, place, value, "space", space_words, &space))
        return false;
    if (json_object_get(value, "space") && !(role->uses & ROLE_IN_SPACE))
        return json_fail(&r->json, KEY_OF(place, "space"), "the role %s has no space", role->name);
    const json_t *also = json_object_get(value, "also");
    if (also && !read_list(r, KEY_OF(place, "also"), also, " ", true, attribute, &row.synonyms))
        return false;
    const char *meaning = role->meaning;
    if (!json_take_text(&r->json, place, value, "meaning", &meaning))
        return false;
    if (is_taken(r, name, attribute))
        return json_fail(&r->json, place, "this name has a role already");
    for (size_t i = 0; i < json_array_size(also); i++)
        if (is_taken(r, json_string_value(json_array_get(also, i)), attribute))
            return json_fail(&r->json, ELEMENT_OF(KEY_OF(place, "also"), i), "'%s' has a role already",
                             json_string_value(json_array_get(also, i)));
    if (role->uses & ROLE_LIGHT && !find_group(r, place, name, &row.group))
        return false;
    row.semantic = role->semantic;
    row.space = (lam_light_frame)space;
    row.name = arena_string(r->arena, name);
    row.meaning = arena_string(r->arena, meaning);
    if (!row.name || !row.meaning)
        return no_memory(r);
    r->names[r->name_count++] = row;
    return true;
}

static bool read_names(struct reader *r, const json_t *root)
{
    static const char *const kinds[] = {"attributes", "uniforms"};
    size_t count = 1;
    for (int k = 0; k < 2; k++) {
        const json_t *list = json_object_get(root, kinds[k]);
        if (list && !json_is_object(list))
            return json_unexpected(&r->json, KEY_OF(NULL, kinds[k]), list, "an object, { … }");
        count += json_object_size(list);
    }
    r->names = arena_alloc_zeroed(r->arena, count * sizeof *r->names);
    if (!r->names)
        return no_memory(r);
    r->contract->names = r->names;
    for (int k = 0; k < 2; k++) {
        const char *name;
        json_t *value;
        json_object_foreach(json_object_get(root, kinds[k]), name, value)
        {
            if (!read_name(r, KEY_OF(KEY_OF(NULL, kinds[k]), name), name, value, k == 0))
                return false;
        }
    }
    return true;
}

static bool read_built_ins(struct reader *r, const json_t *root)
{
    const json_t *list = json_object_get(root, "built_ins");
    size_t count = json_array_size(list);
    const char **words = arena_alloc_zeroed(r->arena, (count + 1) * sizeof *words), *all = NULL;
    if (!words)
        return no_memory(r);
    r->contract->built_ins = words;
    if (list && !read_list(r, KEY_OF(NULL, "built_ins"), list, " ", true, true, &all))
        return false;
    for (size_t i = 0; i < count; i++)
        if (!(words[i] = arena_string(r->arena, json_string_value(json_array_get(list, i)))))
            return no_memory(r);
    return true;
}

// --- varyings

static bool read_varyings(struct reader *r, const json_t *root)
{
    static const struct {
        const char *name;
        enum varying_semantic semantic;
        bool in_space; // may be written with a space: object_position
    } words[] = {{"normal", VARYING_NORMAL, true},      {"position", VARYING_POSITION, true},
                 {"to_light", VARYING_LIGHT, true},     {"to_eye", VARYING_EYE, true},
                 {"distance", VARYING_DISTANCE, false}, {"texture_coordinate", VARYING_TEXCOORD, false}};
    const json_t *object = json_object_get(root, "varyings");
    const struct place *place = KEY_OF(NULL, "varyings");
    if (object && !json_is_object(object))
        return json_unexpected(&r->json, place, object, "an object, { … }");
    struct contract_varying *rows = arena_alloc_zeroed(r->arena, (json_object_size(object) + 1) * sizeof *rows);
    if (!rows)
        return no_memory(r);
    r->contract->varyings = rows;
    const char *key;
    json_t *list;
    json_object_foreach((json_t *)(uintptr_t)object, key, list)
    {
        int space = r->contract->space;
        const char *word = key;
        for (int i = 0; space_words[i].name; i++) {
            size_t length = strlen(space_words[i].name);
            if (strncmp(key, space_words[i].name, length) == 0 && key[length] == '_') {
                space = space_words[i].value;
                word = key + length + 1;
            }
        }
        if (space == LAM_FRAME_OBJECT && strncmp(word, "to_", 3) == 0)
            return json_fail(&r->json, KEY_OF(place, key), "unknown key; %s in object space is not known", word);
        size_t i = 0;
        while (i < sizeof words / sizeof *words &&
               (strcmp(words[i].name, word) != 0 || (word != key && !words[i].in_space)))
            i++;
        if (i == sizeof words / sizeof *words)
            return json_fail(&r->json, KEY_OF(place, key),
                             "unknown key; expected normal, position, to_light or to_eye, also after object_, world_ "
                             "or eye_, distance or texture_coordinate");
        rows->semantic = words[i].semantic;
        rows->space = (lam_light_frame)space;
        if (!read_list(r, KEY_OF(place, key), list, " ", true, true, &rows->names))
            return false;
        rows += rows->names != NULL;
    }
    return true;
}

// --- values of what is not declared

static bool read_color(struct reader *r, const struct place *place, const json_t *object, const char *key,
                       const char *word, enum color_source source, struct default_color *out)
{
    const json_t *value = json_object_get(object, key);
    double v[3];
    if (!value)
        return true;
    if (json_is_string(value)) {
        if (!word || strcmp(json_string_value(value), word) != 0) {
            char expected[80];
            snprintf(expected, sizeof expected, "%s%s%sa list of 3 numbers", word ? "\"" : "", word ? word : "",
                     word ? "\" or " : "");
            return json_unexpected(&r->json, KEY_OF(place, key), value, expected);
        }
        out->source = source;
        return true;
    }
    if (!json_numbers_of(&r->json, KEY_OF(place, key), value, 3, 3, v, NULL))
        return false;
    *out = (struct default_color){COLOR_GIVEN, {(float)v[0], (float)v[1], (float)v[2]}};
    return true;
}

static bool read_number(struct reader *r, const struct place *place, const json_t *object, const char *key,
                        struct default_number *out)
{
    double value = 0;
    if (!json_take_number(&r->json, place, object, key, 0, 1e6, &value))
        return false;
    if (json_object_get(object, key))
        *out = (struct default_number){true, (float)value};
    return true;
}

static bool read_defaults(struct reader *r, const json_t *root)
{
    static const char *const keys[] = {"ambient_color",    "diffuse_color",
                                       "specular_color",   "ambient_strength",
                                       "diffuse_strength", "specular_strength",
                                       "shininess",        "light_color",
                                       "light_specular",   "light_ambient",
                                       "light_direction",  "attenuation",
                                       "spot_exponent",    NULL};
    const json_t *object = json_object_get(root, "undeclared");
    const struct place *place = KEY_OF(NULL, "undeclared");
    struct contract_defaults *d = &r->contract->defaults;
    if (!object)
        return true;
    if (!json_check_keys(&r->json, place, object, keys) ||
        !read_color(r, place, object, "ambient_color", "diffuse", COLOR_OF_DIFFUSE, &d->ambient_color) ||
        !read_color(r, place, object, "diffuse_color", NULL, 0, &d->diffuse_color) ||
        !read_color(r, place, object, "specular_color", "diffuse", COLOR_OF_DIFFUSE, &d->specular_color) ||
        !read_color(r, place, object, "light_color", NULL, 0, &d->light_color) ||
        !read_color(r, place, object, "light_specular", "light", COLOR_OF_LIGHT, &d->light_specular) ||
        !read_color(r, place, object, "light_ambient", "light", COLOR_OF_LIGHT, &d->light_ambient) ||
        !read_number(r, place, object, "ambient_strength", &d->ambient_strength) ||
        !read_number(r, place, object, "diffuse_strength", &d->diffuse_strength) ||
        !read_number(r, place, object, "specular_strength", &d->specular_strength) ||
        !read_number(r, place, object, "shininess", &d->shininess) ||
        !read_number(r, place, object, "spot_exponent", &d->spot_exponent))
        return false;
    double v[3];
    const json_t *list = json_object_get(object, "attenuation");
    if (list) {
        if (!json_numbers_of(&r->json, KEY_OF(place, "attenuation"), list, 3, 3, v, NULL))
            return false;
        if (v[0] < 0 || v[1] < 0 || v[2] < 0 || v[0] + v[1] + v[2] <= 0)
            return json_fail(&r->json, KEY_OF(place, "attenuation"),
                             "found %g, %g, %g, expected numbers of at least 0, not all of them 0", v[0], v[1], v[2]);
        d->has_attenuation = true;
        for (int i = 0; i < 3; i++)
            d->attenuation[i] = (float)v[i];
    }
    list = json_object_get(object, "light_direction");
    if (list) {
        if (!json_numbers_of(&r->json, KEY_OF(place, "light_direction"), list, 3, 3, v, NULL))
            return false;
        if (v[0] == 0 && v[1] == 0 && v[2] == 0)
            return json_fail(&r->json, KEY_OF(place, "light_direction"), "found 0, 0, 0, expected a direction");
        d->has_direction = true;
        d->direction = (lam_vec3){v[0], v[1], v[2]};
    }
    return true;
}

// --- constants and the prefix

static bool read_constants(struct reader *r, const json_t *root)
{
    const json_t *object = json_object_get(root, "constants");
    const struct place *place = KEY_OF(NULL, "constants");
    if (object && !json_is_object(object))
        return json_unexpected(&r->json, place, object, "an object, { … }");
    struct contract_constant *rows = arena_alloc_zeroed(r->arena, (json_object_size(object) + 1) * sizeof *rows);
    if (!rows)
        return no_memory(r);
    r->contract->constants = rows;
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)(uintptr_t)object, name, value)
    {
        char known[300] = "";
        const char *found = json_is_string(value) ? json_string_value(value) : "";
        for (int i = 0; i < role_count && !rows->name; i++)
            if (roles[i].uses & ROLE_CONSTANT) {
                size_t used = strlen(known);
                snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", roles[i].name);
                if (strcmp(roles[i].name, found) == 0) {
                    rows->semantic = roles[i].semantic;
                    rows->name = arena_string(r->arena, name);
                }
            }
        if (!rows->semantic)
            return json_unexpected(&r->json, KEY_OF(place, name), value, known);
        if (!check_name(r, KEY_OF(place, name), name, true))
            return false;
        if (!rows->name)
            return no_memory(r);
        rows++;
    }
    return true;
}

static bool read_prefix(struct reader *r, const json_t *root)
{
    static const char *const keys[] = {"vertex", "fragment", NULL};
    const json_t *object = json_object_get(root, "prefix");
    const struct place *place = KEY_OF(NULL, "prefix");
    const char **texts[] = {&r->contract->prefix_vertex, &r->contract->prefix_fragment};
    if (!object)
        return true;
    if (!json_check_keys(&r->json, place, object, keys))
        return false;
    for (int i = 0; i < 2; i++) {
        const json_t *list = json_object_get(object, keys[i]);
        if (!list)
            return json_fail(&r->json, place, "the key '%s' is missing, expected a list of lines", keys[i]);
        if (!read_list(r, KEY_OF(place, keys[i]), list, "\n", false, false, texts[i]))
            return false;
    }
    return true;
}

// --- the whole

static bool read_terms(struct reader *r, const json_t *root)
{
    static const struct json_choice words[] = {
        {"ambient", TERM_AMBIENT}, {"diffuse", TERM_DIFFUSE}, {"specular", TERM_SPECULAR}, {NULL, 0}};
    const json_t *list = json_object_get(root, "terms");
    const struct place *place = KEY_OF(NULL, "terms");
    r->contract->terms = TERM_AMBIENT | TERM_DIFFUSE | TERM_SPECULAR;
    if (!list)
        return true;
    if (!json_is_array(list) || !json_array_size(list))
        return json_unexpected(&r->json, place, list, "a list of ambient, diffuse and specular");
    r->contract->terms = 0;
    for (size_t i = 0; i < json_array_size(list); i++) {
        int term = 0;
        if (!json_choice_of(&r->json, ELEMENT_OF(place, i), json_array_get(list, i), words, &term))
            return false;
        r->contract->terms |= (unsigned)term;
    }
    return true;
}

static bool has(const struct contract *c, enum uniform_semantic semantic)
{
    for (const struct contract_name *n = c->names; n->name; n++)
        if (n->semantic == semantic)
            return true;
    return false;
}

// What follows from the names.
static bool complete(struct reader *r, bool alpha, bool two_sided)
{
    struct contract *c = r->contract;
    const struct contract_defaults *d = &c->defaults;
    c->light_frame = c->space;
    for (const struct contract_name *n = c->names; n->name; n++) {
        bool placed = n->group >= 0 && role_of(n->semantic)->uses & ROLE_IN_SPACE;
        if (placed) {
            c->light_frame = n->space;
            break;
        }
    }
    bool position = has(c, SEMANTIC_LIGHT_POSITION) || has(c, SEMANTIC_LIGHT_X),
         direction = has(c, SEMANTIC_LIGHT_DIRECTION) || has(c, SEMANTIC_LIGHT_TRAVEL) || d->has_direction;
    c->has_attenuation = has(c, SEMANTIC_ATTENUATION) || has(c, SEMANTIC_ATTENUATION_CONSTANT) ||
                         has(c, SEMANTIC_ATTENUATION_LINEAR) || has(c, SEMANTIC_ATTENUATION_QUADRATIC) ||
                         (d->has_attenuation && (d->attenuation[1] > 0 || d->attenuation[2] > 0));
    c->material_strengths = has(c, SEMANTIC_KA) || has(c, SEMANTIC_KD) || has(c, SEMANTIC_KS);
    c->supports = (c->terms & TERM_AMBIENT ? NEED_AMBIENT : 0) | (c->has_attenuation ? NEED_ATTENUATION : 0) |
                  (position ? NEED_POINT : 0) | (direction ? NEED_DIRECTIONAL : 0) |
                  (has(c, SEMANTIC_CONE) || has(c, SEMANTIC_CUTOFF) ? NEED_SPOT : 0) | (alpha ? NEED_ALPHA : 0) |
                  (two_sided ? NEED_TWO_SIDES : 0) | (has(c, SEMANTIC_SHININESS) ? NEED_SHININESS : 0) |
                  (has(c, SEMANTIC_FLAT) ? NEED_FLAT : 0);
    for (const struct contract_name *n = c->names; n->name; n++) {
        if (n->semantic == SEMANTIC_LIGHT_POSITION && strcmp(n->type, "vec4") == 0)
            c->supports |= NEED_DIRECTIONAL; // w 0
        if (n->group >= 0 && strstr(n->name, "[]"))
            c->supports |= NEED_LIGHTS;
    }
    bool drawn = has(c, SEMANTIC_POSITION);
    for (const char *const *word = c->built_ins; *word; word++)
        drawn = drawn || strcmp(*word, "gl_Vertex") == 0;
    if (!drawn)
        return json_fail(&r->json, KEY_OF(NULL, "attributes"),
                         "found no name with the role position, and no gl_Vertex in built_ins");
    return position || direction ||
           json_fail(&r->json, KEY_OF(NULL, "uniforms"),
                     "found no light: expected a name with the role light_position, light_x, light_direction or "
                     "light_travel, or light_direction in undeclared");
}

static bool read_root(struct reader *r, const json_t *root)
{
    static const char *const keys[] = {"contract",   "name",       "title",     "glsl",      "space",
                                       "terms",      "highlight",  "alpha",     "two_sided", "printed",
                                       "attributes", "uniforms",   "built_ins", "varyings",  "outputs",
                                       "constants",  "undeclared", "prefix",    NULL};
    static const struct json_choice highlights[] = {
        {"phong", LAM_REFLECTION_PHONG}, {"blinn-phong", LAM_REFLECTION_BLINN_PHONG}, {NULL, 0}};
    static const struct json_choice spaces[] = {{"eye", LAM_FRAME_CAMERA}, {"world", LAM_FRAME_WORLD}, {NULL, 0}};
    struct contract *c = r->contract;
    double version = 0;
    int highlight = LAM_REFLECTION_BLINN_PHONG, space = LAM_FRAME_CAMERA;
    const char *name = NULL, *title = NULL;
    bool alpha = false, two_sided = false;
    if (!json_check_keys(&r->json, NULL, root, keys))
        return false;
    if (!json_object_get(root, "contract"))
        return json_fail(&r->json, NULL, "the key 'contract' is missing: \"contract\": 1 marks a contract file");
    if (!json_take_number(&r->json, NULL, root, "contract", 1, 1, &version) ||
        !json_take_text(&r->json, NULL, root, "name", &name) ||
        !json_take_text(&r->json, NULL, root, "title", &title) ||
        !json_take_word(&r->json, NULL, root, "space", spaces, &space) ||
        !json_take_word(&r->json, NULL, root, "highlight", highlights, &highlight) ||
        !json_take_bool(&r->json, NULL, root, "alpha", &alpha) ||
        !json_take_bool(&r->json, NULL, root, "two_sided", &two_sided) ||
        !json_take_bool(&r->json, NULL, root, "printed", &c->printed))
        return false;
    if (!name)
        return json_fail(&r->json, NULL, "the key 'name' is missing, expected the contract's name for reports");
    c->name = arena_string(r->arena, name);
    c->title = arena_string(r->arena, title ? title : name);
    if (!c->name || !c->title)
        return no_memory(r);
    c->space = (lam_light_frame)space;
    c->reflection = (lam_reflection)highlight;
    const json_t *versions = json_object_get(root, "glsl");
    if (versions && !read_list(r, KEY_OF(NULL, "glsl"), versions, ", ", false, false, &c->versions))
        return false;
    c->versions = c->versions ? c->versions : "";
    const json_t *outputs = json_object_get(root, "outputs");
    if (outputs && !read_list(r, KEY_OF(NULL, "outputs"), outputs, " ", true, true, &c->outputs))
        return false;
    return read_terms(r, root) && read_names(r, root) && read_built_ins(r, root) && read_varyings(r, root) &&
           read_defaults(r, root) && read_constants(r, root) && read_prefix(r, root) && complete(r, alpha, two_sided);
}

lam_check_contract *lam_check_contract_read(const char *text, size_t size, const char *file, lam_error *error)
{
    lam_check_contract *out = calloc(1, sizeof *out);
    lam_error unused;
    if (!out) {
        fail_memory(error, sizeof *out);
        return NULL;
    }
    arena_start(&out->arena, NULL);
    struct reader r = {.json = {.file = file ? file : "contract", .error = error ? error : &unused},
                       .arena = &out->arena,
                       .contract = &out->contract};
    json_t *root = json_parse(text, size, r.json.file, NULL, r.json.error);
    bool ok = root && ((out->contract.text = arena_string_of(&out->arena, text, size)) || no_memory(&r));
    ok = ok && read_root(&r, root);
    uint64_t hash = 14695981039346656037u; // FNV-1a
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ (unsigned char)text[i]) * 1099511628211u;
    out->contract.hash = hash;
    json_decref(root);
    if (ok)
        return out;
    lam_check_contract_free(out);
    return NULL;
}

void lam_check_contract_free(lam_check_contract *contract)
{
    if (contract)
        arena_free(&contract->arena);
    free(contract);
}
