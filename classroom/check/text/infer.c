// infer.c: makes a contract from the roles that a reading found, and from the words in the names of numbers.
#include "prefix.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include <jansson.h>

struct inference {
    const struct declarations *vertex, *fragment;
    const struct inferred_role *known;
    int known_count;
    bool has_light, has_position;
    json_t *attributes, *uniforms;
    char *reason;
    size_t capacity;
};

// --- words

// Returns whether a name contains one of the words, ignoring case and underscores. Blanks separate `words`.
static bool has(const char *name, const char *words)
{
    char plain[128];
    size_t length = 0;
    for (; *name && length + 1 < sizeof plain; name++)
        if (*name != '_')
            plain[length++] = (char)tolower((unsigned char)*name);
    plain[length] = 0;
    while (*words) {
        char word[32];
        size_t n = strcspn(words, " ");
        snprintf(word, sizeof word, "%.*s", (int)n, words);
        if (strstr(plain, word))
            return true;
        words += n + (words[n] == ' ');
    }
    return false;
}

static const char *last_part(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot ? dot + 1 : name;
}

static void give(json_t *to, const char *name, const char *role, const char *type, const char *space)
{
    json_t *row = json_pack("{s:s, s:s}", "role", role, "type", type);
    if (space)
        json_object_set_new(row, "space", json_string(space));
    json_object_set_new(to, name, row);
}

// Gives a role to a number. The verdict does not depend on it, but the pictures of the scenes look better.
static void find_number(struct inference *f, const struct declaration *item)
{
    const char *name = item->name, *last = last_part(name), *role = "factor";
    const bool whole = strcmp(item->type, "float") != 0;
    if (whole)
        role = has(last, "count num") ? "light_count" : has(last, "enable on light") ? "one" : "zero";
    else if (has(last, "shin gloss hard exponent power"))
        role = "shininess";
    else if (has(last, "quadr"))
        role = "attenuation_quadratic";
    else if (has(last, "linear"))
        role = "attenuation_linear";
    else if (has(last, "constant"))
        role = "attenuation_constant";
    else if (has(last, "outer"))
        role = "outer_cosine";
    else if (has(last, "cutoff inner"))
        role = "cutoff_cosine";
    give(f->uniforms, name, role, item->type, NULL);
}

static void find_role(struct inference *f, const struct declaration *item, json_t *to)
{
    static const char types[] = " float int bool vec2 vec3 vec4 mat3 mat4 sampler2D ";
    char padded[70];
    snprintf(padded, sizeof padded, " %.64s ", item->type);
    if (json_object_get(to, item->name))
        return;
    for (int i = 0; i < f->known_count; i++)
        if (strcmp(f->known[i].name, item->name) == 0) {
            give(to, item->name, f->known[i].role, item->type, f->known[i].space);
            f->has_light = f->has_light || strncmp(f->known[i].role, "light_", 6) == 0;
            return;
        }
    bool vector = strncmp(item->type, "vec", 3) == 0 || strcmp(item->type, "sampler2D") == 0;
    if (strcmp(item->type, "uint") == 0 || strncmp(item->type, "mat", 3) == 0 || strcmp(item->type, "vec2") == 0) {
        bool whole = strcmp(item->type, "uint") == 0;
        if (!whole && strncmp(item->type, "mat", 3) == 0 && !f->reason[0])
            snprintf(f->reason, f->capacity, "the check does not know the role of the matrix '%s' (%s)", item->name,
                     item->type);
        if (whole || strstr(types, padded))
            give(to, item->name, "zero", whole ? "int" : item->type, NULL);
    } else if (to == f->attributes) {
        // Without a reading, the names decide.
        bool position = !f->known_count && !f->has_position && !has(item->name, "norm tex col tan");
        f->has_position = f->has_position || position;
        give(to, item->name,
             position                                     ? "position"
             : !f->known_count && has(item->name, "norm") ? "normal"
             : vector && has(item->name, "col")           ? "factor"
                                                          : "zero",
             item->type, NULL);
    } else if (vector)
        give(to, item->name, "factor", item->type, NULL);
    else if (strstr(types, padded))
        find_number(f, item);
}

static json_t *lines_of(const char *text)
{
    json_t *list = json_array();
    for (; *text; text += strcspn(text, "\n"), text += *text == '\n')
        if (strcspn(text, "\n"))
            json_array_append_new(list, json_stringn(text, strcspn(text, "\n")));
    return list;
}

char *contract_infer(const struct declarations *vertex, const struct declarations *fragment,
                     const struct contract *engine, const struct inferred_role *known, int count, const char *space,
                     char *reason, size_t capacity)
{
    struct inference f = {.vertex = vertex,
                          .fragment = fragment,
                          .known = known,
                          .known_count = count,
                          .reason = reason,
                          .capacity = capacity};
    const struct declarations *sides[] = {vertex, fragment};
    f.attributes = json_object();
    f.uniforms = json_object();
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++)
            if (sides[s]->items[i].kind == DECLARED_UNIFORM || (s == 0 && sides[s]->items[i].kind == DECLARED_INPUT))
                find_role(&f, &sides[s]->items[i],
                          sides[s]->items[i].kind == DECLARED_UNIFORM ? f.uniforms : f.attributes);
    json_t *undeclared =
        json_pack("{s:[i,i,i], s:i, s:s}", "attenuation", 1, 0, 0, "spot_exponent", 0, "light_space", space);
    if (!f.has_light)
        json_object_set_new(undeclared, "light_position", json_pack("[i, i, i]", 1, 2, 3));
    json_t *root = json_pack("{s:i, s:s, s:s, s:s, s:s, s:o, s:o, s:o}", "contract", 1, "name", "inferred", "title",
                             "inferred from the shaders", "space", space, "strengths", "any", "attributes",
                             f.attributes, "uniforms", f.uniforms, "undeclared", undeclared);
    if (declarations_uses(vertex, "gl_Vertex") || declarations_uses(vertex, "ftransform"))
        json_object_set_new(root, "built_ins", json_pack("[s]", "gl_Vertex"));
    if (engine)
        json_object_set_new(root, "prefix",
                            json_pack("{s:o, s:o}", "vertex", lines_of(engine->prefix_vertex), "fragment",
                                      lines_of(engine->prefix_fragment)));
    char *text = json_dumps(root, JSON_INDENT(2));
    json_decref(root);
    return text;
}
