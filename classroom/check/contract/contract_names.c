// contract_names.c: reads the attributes and uniforms of a contract.
#include "contract.h"
#include "prefix.h"

#include <stdio.h>
#include <string.h>

#include "spelling.h"

static const struct {
    const char *name;
    unsigned type;
} types[] = {{"float", TYPE_SCALAR}, {"int", TYPE_SCALAR},  {"bool", TYPE_SCALAR},
             {"vec2", TYPE_VEC2},    {"vec3", TYPE_VECTOR}, {"vec4", TYPE_VECTOR},
             {"mat3", TYPE_MATRIX},  {"mat4", TYPE_MATRIX}, {"sampler2D", TYPE_SAMPLER}};
enum { TYPES = sizeof types / sizeof *types };

static bool read_role(struct contract_reader *r, const struct place *place, const json_t *value, bool attribute,
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

static bool read_type(struct contract_reader *r, const struct place *place, const json_t *value,
                      const struct role *role, const char **out)
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

// Finds the group of a light's name: the text before its last dot.
static bool find_group(struct contract_reader *r, const struct place *place, const char *name, int *group)
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
    return c->groups[c->group_count++] || contract_no_memory(r);
}

// Returns the name that replaces a name of fixed-function state in rewritten sources: fixed_LightSource[].position.
static const char *fixed_state_name(struct arena *arena, const char *name)
{
    char text[80];
    snprintf(text, sizeof text, "fixed_%s", name + 3);
    return arena_string(arena, text);
}

static bool is_taken(const struct contract_reader *r, const char *name, bool attribute)
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

static bool read_name(struct contract_reader *r, const struct place *place, const char *name, const json_t *value,
                      bool attribute)
{
    static const char *const keys[] = {"role", "type", "space", "also", "meaning", "comment", NULL};
    const struct role *role = NULL;
    int space = r->contract->space;
    struct contract_name row = {.attribute = attribute, .group = -1};
    if (!contract_check_name(r, place, name, attribute) || !json_check_keys(&r->json, place, value, keys) ||
        !contract_check_comment(r, place, value) ||
        !read_role(r, place, json_object_get(value, "role"), attribute, &role) ||
        !read_type(r, place, json_object_get(value, "type"), role, &row.type) ||
        !json_take_word(&r->json, place, value, "space", contract_spaces, &space))
        return false;
    if (json_object_get(value, "space") && !(role->uses & ROLE_IN_SPACE))
        return json_fail(&r->json, KEY_OF(place, "space"), "the role %s has no space", role->name);
    const json_t *also = json_object_get(value, "also");
    if (also && !contract_read_list(r, KEY_OF(place, "also"), also, " ", true, attribute, &row.synonyms))
        return false;
    const char *meaning = role->meaning;
    if (!json_take_text(&r->json, place, value, "meaning", &meaning))
        return false;
    if (is_taken(r, name, attribute))
        return json_fail(&r->json, place, "this name already has a role");
    for (size_t i = 0; i < json_array_size(also); i++)
        if (is_taken(r, json_string_value(json_array_get(also, i)), attribute))
            return json_fail(&r->json, ELEMENT_OF(KEY_OF(place, "also"), i), "'%s' has a role already",
                             json_string_value(json_array_get(also, i)));
    const char *inner = fixed_state_has(name) ? fixed_state_name(r->arena, name) : name;
    if (!inner)
        return contract_no_memory(r);
    if (role->uses & ROLE_LIGHT && !find_group(r, place, inner, &row.group))
        return false;
    row.semantic = role->semantic;
    row.space = (lam_light_frame)space;
    r->contract->fixed_state = r->contract->fixed_state || fixed_state_has(name);
    row.name = arena_string(r->arena, inner);
    row.meaning = arena_string(r->arena, meaning);
    if (!row.name || !row.meaning)
        return contract_no_memory(r);
    r->names[r->name_count++] = row;
    return true;
}

static bool read_built_ins(struct contract_reader *r, const json_t *root)
{
    const json_t *list = json_object_get(root, "built_ins");
    size_t count = json_array_size(list);
    const char **words = arena_alloc_zeroed(r->arena, (count + 1) * sizeof *words), *all = NULL;
    if (!words)
        return contract_no_memory(r);
    r->contract->built_ins = words;
    if (list && !contract_read_list(r, KEY_OF(NULL, "built_ins"), list, " ", true, true, &all))
        return false;
    for (size_t i = 0; i < count; i++)
        if (!(words[i] = arena_string(r->arena, json_string_value(json_array_get(list, i)))))
            return contract_no_memory(r);
    return true;
}

bool contract_read_names(struct contract_reader *r, const json_t *root)
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
        return contract_no_memory(r);
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
    return read_built_ins(r, root);
}
