// infer.c: infers the role of each input of two shaders.
#include "prefix.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include <jansson.h>

enum { MAX_CHAIN = 8, MAX_DEPTH = 8, MAX_SPACES = 4 };
// The time grows with the product of these numbers. Real shaders stay far below these limits.
enum { MAX_TEXT = 30000, MAX_DECLARED = 500, MAX_STEPS = 100000 };

struct inference {
    const struct declarations *vertex, *fragment;
    // the matrices that transform the position to gl_Position; the last applied matrix is first
    const char *chain[MAX_CHAIN];
    int chain_count, steps;
    const char *position; // the attribute that determines gl_Position
    bool has_model, has_model_view, has_eye, has_light, has_normal_matrix;
    json_t *attributes, *uniforms, *undeclared;
    const char *space, *light_space; // eye, world, object
    bool guessed;                    // a role was guessed by elimination
    bool engine;                     // whether an engine sets the values of its own names
    bool all;                        // inputs with unknown roles have the role `zero`
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

// Removes parts without meaning from a name: u_, a leading u before a capital letter, Matrix, Mat.
static void core_of(const char *name, char out[64])
{
    size_t length = 0;
    if (name[0] == 'u' && (name[1] == '_' || isupper((unsigned char)name[1])))
        name++;
    for (; *name && length < 63; name++)
        if (*name != '_')
            out[length++] = (char)tolower((unsigned char)*name);
    out[length] = 0;
    char *matrix = strstr(out, "mat");
    if (matrix && matrix != out)
        *matrix = 0;
}

// --- the computation of gl_Position

static const struct declaration *uniform_of(const struct declarations *d, const char *name)
{
    return declarations_find(d, DECLARED_UNIFORM, name);
}

// Returns the index of the word after `name =` in the last assignment before word `before`, or −1 if there is none.
static int assignment_of(const struct declarations *d, const char *name, int before)
{
    for (int i = before - 2; i >= 0; i--)
        if (word_is(d, i, name) && !d->words[i].is_member && d->words[i].depth > 0 && word_is(d, i + 1, "=") &&
            !word_is(d, i + 2, "="))
            return i + 2;
    return -1;
}

// Collects the matrices and the attribute of the expression at word `at`, following local variables.
static void follow(struct inference *f, int at, int depth)
{
    const struct declarations *d = f->vertex;
    for (int i = at; i < d->word_count && !word_is(d, i, ";") && f->steps++ < MAX_STEPS; i++) {
        const char *word = d->words[i].text;
        if (d->words[i].is_member || !word_is_name(word))
            continue;
        const struct declaration *uniform = uniform_of(d, word);
        if (uniform && strncmp(uniform->type, "mat4", 4) == 0 && f->chain_count < MAX_CHAIN)
            f->chain[f->chain_count++] = uniform->name;
        const struct declaration *input = declarations_find(d, DECLARED_INPUT, word);
        if (input && strncmp(input->type, "vec", 3) == 0 &&
            (!f->position || (!has(f->position, "pos vert coord") && has(word, "pos vert coord"))))
            f->position = input->name;
        int next = uniform || input || depth == 0 ? -1 : assignment_of(d, word, at);
        if (next >= 0)
            follow(f, next, depth - 1);
    }
}

// --- roles

static void give(json_t *to, const char *name, const char *role, const char *type, const char *space)
{
    json_t *row = json_pack("{s:s, s:s}", "role", role, "type", type);
    if (space)
        json_object_set_new(row, "space", json_string(space));
    json_object_set_new(to, name, row);
}

static bool cannot(struct inference *f, const char *format, const char *name, const char *type)
{
    if (!f->reason[0])
        snprintf(f->reason, f->capacity, format, name, type);
    return false;
}

static bool in_chain(const struct inference *f, const char *name, int *index)
{
    for (*index = 0; *index < f->chain_count; ++*index)
        if (strcmp(f->chain[*index], name) == 0)
            return true;
    return false;
}

// Returns the role of a matrix in the computation of gl_Position.
static const char *role_in_chain(const struct inference *f, int index)
{
    const char *first = f->chain[0];
    switch (f->chain_count) {
    case 1:
        return "model_view_projection";
    case 2:
        if ((has(first, "proj") && has(first, "view cam")) || has(first, "vp pv"))
            return index ? "model" : "view_projection";
        return index ? "model_view" : "projection";
    case 3:
        return index == 0 ? "projection" : index == 1 ? "view" : "model";
    default:
        return NULL;
    }
}

static bool find_matrix(struct inference *f, const struct declaration *item)
{
    char core[64];
    int index;
    const char *name = last_part(item->name), *role = NULL;
    core_of(name, core);
    if (in_chain(f, item->name, &index))
        role = role_in_chain(f, index);
    else if (strncmp(item->type, "mat3", 4) == 0 ||
             has(core, "norm invtrans inversetrans invertrans transposeinv transinv") || strcmp(core, "n") == 0 ||
             strcmp(core, "nm") == 0)
        role = "normal_matrix";
    else if (has(core, "inv shadow light bone tex bias prev"))
        role = NULL;
    else if (has(core, "mvp worldviewproj modelviewproj"))
        role = "model_view_projection";
    else if (has(core, "modelview worldview") || strcmp(core, "mv") == 0)
        role = "model_view";
    else if (has(core, "viewproj projview") || strcmp(core, "vp") == 0 || strcmp(core, "pv") == 0)
        role = "view_projection";
    else if (has(core, "proj persp") || strcmp(core, "p") == 0)
        role = "projection";
    else if (has(core, "view cam look") || strcmp(core, "v") == 0)
        role = "view";
    else if (has(core, "model world object trans") || strcmp(core, "m") == 0)
        role = "model";
    if (!role)
        return cannot(f, "the check does not know the role of the matrix '%s' (%s)", item->name, item->type);
    f->has_model = f->has_model || strcmp(role, "model") == 0;
    f->has_model_view = f->has_model_view || strcmp(role, "model_view") == 0;
    f->has_normal_matrix = f->has_normal_matrix || strcmp(role, "normal_matrix") == 0;
    give(f->uniforms, item->name, role, item->type, strcmp(role, "normal_matrix") == 0 ? f->space : NULL);
    return true;
}

// How a shader uses a vector. A shader uses a point in a difference, and a direction alone.
enum { USED_IN_DIFFERENCE = 1, USED_ALONE = 2 };
static unsigned uses_of(const struct declarations *d, const char *name)
{
    const char *last = last_part(name);
    unsigned uses = 0;
    for (int i = 0; i < d->word_count; i++) {
        if (!word_is(d, i, last) || d->words[i].is_member != (last != name))
            continue;
        int first = i, after = i + 1;
        while (first > 1 && (d->words[first].is_member || word_is(d, first, ".") || word_is(d, first, "]"))) {
            if (word_is(d, first, "]"))
                while (first > 1 && !word_is(d, first, "["))
                    first--;
            first--;
        }
        if (word_is(d, after, "["))
            while (after < d->word_count && !word_is(d, after++, "]"))
                continue;
        if (word_is(d, after, ".") && has(d->words[after + 1].text, "xyz"))
            after += 2;
        while (word_is(d, first - 1, "(") && word_is(d, after, ")") &&
               (word_is(d, first - 2, "vec3") || word_is(d, first - 2, "vec4"))) {
            first -= 2;
            after++;
        }
        bool binary = !(word_is(d, first - 2, "(") || word_is(d, first - 2, "=") || word_is(d, first - 2, ",") ||
                        word_is(d, first - 2, "return"));
        if ((word_is(d, first - 1, "-") && binary) || word_is(d, after, "-"))
            uses |= USED_IN_DIFFERENCE;
        first -= word_is(d, first - 1, "-");
        if (word_is(d, first - 1, "(") && word_is(d, after, ")") && word_is(d, first - 2, "normalize"))
            uses |= USED_ALONE;
    }
    return uses;
}

static bool reads_w(const struct inference *f, const char *name)
{
    const struct declarations *sides[] = {f->vertex, f->fragment};
    const char *last = last_part(name);
    for (int s = 0; s < 2; s++)
        for (int i = 0; i + 3 < sides[s]->word_count; i++)
            if (word_is(sides[s], i, last) && word_is(sides[s], i + 1, ".") && word_is(sides[s], i + 2, "w") &&
                (word_is(sides[s], i + 3, "=") || word_is(sides[s], i + 3, ">") || word_is(sides[s], i + 3, "<")))
                return true;
    return false;
}

// Returns whether `-name` occurs, which means that the vector points away from the light.
static bool is_negated(const struct inference *f, const char *name)
{
    const struct declarations *sides[] = {f->vertex, f->fragment};
    const char *last = last_part(name);
    for (int s = 0; s < 2; s++)
        for (int i = 1; i < sides[s]->word_count; i++) {
            int first = i;
            while (first > 1 && (sides[s]->words[first].is_member || word_is(sides[s], first, ".") ||
                                 word_is(sides[s], first, "]"))) {
                if (word_is(sides[s], first, "]"))
                    while (first > 1 && !word_is(sides[s], first, "["))
                        first--;
                first--;
            }
            if (word_is(sides[s], i, last) && word_is(sides[s], first - 1, "-") &&
                (word_is(sides[s], first - 2, "(") || word_is(sides[s], first - 2, "=") ||
                 word_is(sides[s], first - 2, ",")))
                return true;
        }
    return false;
}

static bool find_vector(struct inference *f, const struct declaration *item)
{
    const char *name = item->name, *last = last_part(name);
    bool light = has(name, "light lamp sun spot");
    bool paint = has(last, "color colour ambient diffuse specular intens albedo emis material product attenuation") ||
                 has(last, "amb dif spec refl");
    unsigned uses = paint ? 0 : uses_of(f->vertex, name) | uses_of(f->fragment, name);
    bool geometric = uses != 0;
    if (!paint && uses && has(last, "half"))
        return cannot(f, "the half vector '%s' (%s) belongs to a distant viewer, which the check does not support",
                      name, item->type);
    if (!paint && has(last, "eye cam view") && !light && !has(last, "dir")) {
        f->has_eye = true;
        give(f->uniforms, name, "eye_position", item->type, f->space);
    } else if (!paint && light && (has(last, "dir normal axis target") || uses == USED_ALONE)) {
        f->has_light = true;
        give(f->uniforms, name, is_negated(f, name) ? "light_travel" : "light_direction", "vec3", f->light_space);
    } else if (!paint && (has(last, "pos loc coord place") || geometric) && (light || geometric)) {
        f->has_light = true;
        give(f->uniforms, name, "light_position", reads_w(f, name) ? item->type : "vec3", f->light_space);
    } else {
        f->guessed = f->guessed || !(paint || has(name, "ka kd ks la ld ls light"));
        bool vertex_only = !declarations_find(f->fragment, DECLARED_UNIFORM, name) && f->guessed && !paint;
        give(f->uniforms, name, vertex_only ? "zero" : "factor", item->type, NULL);
    }
    return true;
}

// Returns whether a name is inside the second argument of pow().
static bool is_exponent(const struct declarations *d, const char *name)
{
    for (int i = 0; i + 1 < d->word_count; i++) {
        if (!word_is(d, i, "pow") || !word_is(d, i + 1, "("))
            continue;
        int depth = 0;
        bool second = false;
        for (int k = i + 1; k < d->word_count; k++) {
            depth += word_is(d, k, "(") - word_is(d, k, ")");
            if (depth == 0)
                break;
            second = second || (depth == 1 && word_is(d, k, ","));
            if (second && word_is(d, k, name))
                return true;
        }
    }
    return false;
}

static bool find_number(struct inference *f, const struct declaration *item)
{
    const char *name = item->name, *last = last_part(name), *role = "factor";
    bool whole = strcmp(item->type, "float") != 0, light = has(name, "light lamp spot");
    if (whole && (has(last, "count num") || strcmp(last, "lights") == 0))
        role = "light_count";
    else if (whole && has(last, "type kind"))
        role = light ? "light_kind" : "zero";
    else if (whole)
        role = has(last, "enable on light") ? "one" : "zero";
    else if (has(name, "spot") && has(last, "exp"))
        role = "spot_exponent";
    else if (has(last, "shin gloss hard exponent power") || is_exponent(f->vertex, last) ||
             is_exponent(f->fragment, last))
        role = "shininess";
    else if (has(last, "quadr"))
        role = "attenuation_quadratic";
    else if (has(last, "linear"))
        role = "attenuation_linear";
    else if (has(last, "constant"))
        role = "attenuation_constant";
    else if (has(last, "cutoff limit angle cos"))
        role = has(last, "outer")   ? "outer_cosine"
               : has(last, "inner") ? "cutoff_cosine"
               : light              ? "cutoff_cosine"
                                    : NULL;
    else if (has(last, "time"))
        role = "zero";
    else if (has(last, "alpha opac transp"))
        role = "one";
    else if (has(last, "metal rough atten range radius falloff gamma expos near far"))
        role = NULL;
    if (!role)
        return cannot(f, "the check does not know the purpose of '%s' (%s)", name, item->type);
    give(f->uniforms, name, role, item->type, NULL);
    return true;
}

static bool find_role(struct inference *f, const struct declaration *item)
{
    const char *last = last_part(item->name);
    const struct declarations *sides[] = {f->vertex, f->fragment};
    bool used = false;
    for (int s = 0; s < 2; s++) {
        used = used || (last == item->name && declarations_uses(sides[s], last));
        for (int i = 0; !used && last != item->name && i < sides[s]->word_count; i++)
            used = sides[s]->words[i].is_member && word_is(sides[s], i, last);
    }
    if (json_object_get(f->uniforms, item->name))
        return true;
    if (!used || strcmp(item->type, "uint") == 0) { // unused, but a driver may still report the attribute
        give(f->uniforms, item->name, "zero", strcmp(item->type, "uint") == 0 ? "int" : item->type, NULL);
        return true;
    }
    if (strncmp(item->type, "mat", 3) == 0)
        return find_matrix(f, item);
    if (strcmp(item->type, "vec3") == 0 || strcmp(item->type, "vec4") == 0)
        return find_vector(f, item);
    if (strcmp(item->type, "float") == 0 || strcmp(item->type, "int") == 0 || strcmp(item->type, "bool") == 0)
        return find_number(f, item);
    if (strcmp(item->type, "sampler2D") == 0 &&
        !has(last, "norm bump height depth shadow env sky lut brdf noise pos buffer irrad")) {
        give(f->uniforms, item->name, "factor", "sampler2D", NULL);
        return true;
    }
    return cannot(f, "the shader reads '%s' (%s), which the check cannot draw", item->name, item->type);
}

static bool find_uniform(struct inference *f, const struct declaration *item)
{
    char padded[70];
    snprintf(padded, sizeof padded, " %.64s ", item->type);
    if (find_role(f, item))
        return true;
    if (f->all && strstr(" float int bool vec2 vec3 vec4 mat3 mat4 sampler2D ", padded))
        give(f->uniforms, item->name, "zero", item->type, NULL);
    return f->all;
}

static void find_attributes(struct inference *f)
{
    const struct declarations *d = f->vertex;
    const char *normal = NULL;
    for (int i = 0; i < d->count; i++)
        if (d->items[i].kind == DECLARED_INPUT && strncmp(d->items[i].type, "vec", 3) == 0 &&
            has(d->items[i].name, "norm") && (!normal || has(normal, "bump")))
            normal = d->items[i].name;
    for (int i = 0; i < d->count; i++) {
        const struct declaration *item = &d->items[i];
        bool vector = strcmp(item->type, "vec3") == 0 || strcmp(item->type, "vec4") == 0;
        if (item->kind != DECLARED_INPUT || json_object_get(f->attributes, item->name))
            continue;
        const char *role = f->position && strcmp(item->name, f->position) == 0 ? "position"
                           : normal && strcmp(item->name, normal) == 0         ? "normal"
                           : vector && has(item->name, "bitan binorm")         ? "bitangent"
                           : vector && has(item->name, "tang")                 ? "tangent"
                           : vector && has(item->name, "col")                  ? "factor"
                                                                               : "zero";
        give(f->attributes, item->name, role, item->type, NULL);
    }
}

// --- numbers in the source

// Finds the `number`-th variable that is a light's position or direction and is set to three numbers in the source.
// Returns false if there is none.
static bool find_vector_of_light(const struct declarations *d, int number, const char **name, double v[3])
{
    for (int i = 0; i + 2 < d->word_count; i++) {
        if (!has(d->words[i].text, "light lamp sun") || has(d->words[i].text, "color colour amb dif spec intens") ||
            !word_is(d, i + 1, "="))
            continue;
        int at = i + 2, count = 0;
        while (at < i + 8 &&
               (word_is(d, at, "normalize") || word_is(d, at, "vec3") || word_is(d, at, "vec4") || word_is(d, at, "(")))
            at++;
        while (count < 3 && word_take_number(d, &at, &v[count])) {
            count++;
            at += word_is(d, at, ",");
        }
        if (count == 3 && number-- == 0) {
            *name = d->words[i].text;
            return true;
        }
    }
    return false;
}

// Adds a light whose position or direction is a constant. `guess` selects the constant, and *left receives the rest of
// the guess, which selects the spaces.
static bool find_light_in_text(struct inference *f, int guess, int *left)
{
    double v[3];
    const char *name;
    bool direction = false;
    if (!find_vector_of_light(f->fragment, 0, &name, v) && !find_vector_of_light(f->vertex, 0, &name, v))
        return cannot(f, "the check finds no %s of a light, neither an input nor numbers%s", "position or direction",
                      "");
    double second[3];
    const char *other;
    f->guessed = f->guessed || find_vector_of_light(f->fragment, 1, &other, second);
    if (has(name, "pos loc place"))
        *left = guess;
    else if (has(name, "dir"))
        direction = true, *left = guess;
    else
        direction = guess % 2 == 0, *left = guess / 2;
    json_object_set_new(f->undeclared, direction ? "light_direction" : "light_position",
                        json_pack("[f, f, f]", v[0], v[1], v[2]));
    return true;
}

// --- complete contracts

// Lists the possible pairs of the space in which lighting is computed and the space of the light, the likeliest first.
static int find_spaces(const struct inference *f, const char *out[MAX_SPACES][2])
{
    int count = 0;
    const bool built_in = !f->chain_count;
#define SPACES(lit, light) (out[count][0] = (lit), out[count++][1] = (light))
    if (f->has_eye && (f->has_model || f->engine)) { // in eye space the eye is at 0, so no input contains its position
        SPACES("world", "world");
        SPACES("world", "object");
    } else if (f->has_eye) {
        SPACES("object", "object");
    } else if (f->has_model && !f->has_model_view) {
        SPACES("world", "world");
        SPACES("eye", "world");
        SPACES("eye", "eye");
    } else if (f->has_model_view || built_in) {
        SPACES("eye", "eye");
        SPACES("eye", "world");
        if (f->has_model)
            SPACES("world", "world");
        else
            SPACES("eye", "object");
    } else {
        SPACES("object", "object");
    }
#undef SPACES
    return count;
}

static bool find_roles(struct inference *f)
{
    const struct declarations *sides[] = {f->vertex, f->fragment};
    json_object_clear(f->uniforms);
    f->has_light = f->has_eye = false;
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++)
            if (sides[s]->items[i].kind == DECLARED_UNIFORM && !find_uniform(f, &sides[s]->items[i]))
                return false;
    return true;
}

static bool infer(struct inference *f, int guess)
{
    const char *spaces[MAX_SPACES][2];
    bool fixed = declarations_uses(f->vertex, "ftransform") || declarations_uses(f->vertex, "gl_Vertex");
    if (f->vertex->word_count > MAX_TEXT || f->fragment->word_count > MAX_WORDS || f->vertex->count > MAX_DECLARED ||
        f->fragment->count > MAX_DECLARED)
        return cannot(f, "the %s are longer than the limit of the check%s", "texts", "");
    for (int i = 0; i + 1 < f->vertex->word_count; i++)
        if (word_is(f->vertex, i, "gl_Position") && word_is(f->vertex, i + 1, "="))
            follow(f, i + 2, MAX_DEPTH);
    if (!f->position && !fixed)
        return cannot(f, "the check finds no %s that reaches gl_Position%s", "attribute", "");
    if (f->chain_count > 3)
        return cannot(f, "more than three matrices lead to %s%s", "gl_Position", "");
    for (int i = 0; i < f->fragment->count; i++) {
        const struct declaration *item = &f->fragment->items[i];
        if (item->kind == DECLARED_INPUT && declarations_uses(f->fragment, item->name) &&
            !declarations_find(f->vertex, DECLARED_OUTPUT, item->name))
            return cannot(f, "the vertex shader does not write '%s' (%s): another stage is between them", item->name,
                          item->type);
    }
    find_attributes(f);
    f->space = f->light_space = "eye";
    if (!find_roles(f))
        return false;
    int left = guess;
    if (!f->has_light && !find_light_in_text(f, guess, &left)) {
        if (!f->all)
            return false;
        json_object_set_new(f->undeclared, "light_position", json_pack("[i, i, i]", 1, 2, 3));
    }
    if (left >= find_spaces(f, spaces))
        return false;
    f->space = spaces[left][0];
    f->light_space = spaces[left][1];
    json_object_set_new(f->undeclared, "light_space", json_string(f->light_space));
    json_object_set_new(f->undeclared, "attenuation", json_pack("[i, i, i]", 1, 0, 0));
    json_object_set_new(f->undeclared, "spot_exponent", json_integer(0));
    return find_roles(f);
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
                     const struct contract *engine, int guess, bool all, char *reason, size_t capacity)
{
    struct inference f = {.vertex = vertex, .fragment = fragment, .reason = reason, .capacity = capacity, .all = all};
    char *text = NULL;
    reason[0] = 0;
    f.engine = engine != NULL;
    f.attributes = json_object();
    f.uniforms = json_object();
    f.undeclared = json_object();
    if (infer(&f, guess)) {
        json_t *root =
            json_pack("{s:i, s:s, s:s, s:s, s:s, s:O, s:O, s:O}", "contract", 1, "name", "inferred", "title",
                      f.guessed ? "inferred from the shaders, partly by elimination" : "inferred from the shaders",
                      "space", f.space, "strengths", "any", "attributes", f.attributes, "uniforms", f.uniforms,
                      "undeclared", f.undeclared);
        json_object_set_new(root, "constants",
                            json_pack("{s:s, s:s, s:s}", "constant", "attenuation_constant", "linear",
                                      "attenuation_linear", "quadratic", "attenuation_quadratic"));
        if (declarations_uses(vertex, "gl_Vertex") || declarations_uses(vertex, "ftransform"))
            json_object_set_new(root, "built_ins", json_pack("[s]", "gl_Vertex"));
        if (engine)
            json_object_set_new(root, "prefix",
                                json_pack("{s:o, s:o}", "vertex", lines_of(engine->prefix_vertex), "fragment",
                                          lines_of(engine->prefix_fragment)));
        text = json_dumps(root, JSON_INDENT(2));
        json_decref(root);
    }
    json_decref(f.attributes);
    json_decref(f.uniforms);
    json_decref(f.undeclared);
    return text;
}
