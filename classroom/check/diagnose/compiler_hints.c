// compiler_hints.c: explains a compiler's messages with the help of the shader's source.
#include "diagnostics.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "fail.h"
#include "spelling.h"

#define COUNT(list) (int)(sizeof(list) / sizeof *(list))

static const char *const types[] = {"float", "int",       "bool",        "vec2",      "vec3",  "vec4",  "ivec2",
                                    "ivec3", "ivec4",     "bvec2",       "bvec3",     "bvec4", "mat2",  "mat3",
                                    "mat4",  "sampler2D", "samplerCube", "sampler3D", "uint",  "uvec2", "uvec3",
                                    "uvec4", "void",      "double",      "dvec3"};

static const char *const built_ins[] = {"gl_Position",
                                        "gl_FragColor",
                                        "gl_FragCoord",
                                        "gl_FrontFacing",
                                        "gl_Vertex",
                                        "gl_Normal",
                                        "gl_Color",
                                        "gl_NormalMatrix",
                                        "gl_ModelViewMatrix",
                                        "gl_ModelViewProjectionMatrix",
                                        "gl_ProjectionMatrix",
                                        "gl_PointSize",
                                        "gl_MultiTexCoord0",
                                        "gl_FrontColor",
                                        "gl_BackColor",
                                        "gl_TexCoord",
                                        "gl_VertexID",
                                        "gl_FragDepth",
                                        "gl_FragData",
                                        "gl_LightSource",
                                        "gl_FrontMaterial",
                                        "gl_PointCoord",
                                        "gl_InstanceID",
                                        "gl_ClipDistance",
                                        "gl_PrimitiveID",
                                        "gl_LightModel",
                                        "gl_FrontLightProduct",
                                        "gl_FrontLightModelProduct",
                                        "gl_ModelViewMatrixInverseTranspose"};

static const char *const functions[] = {"normalize", "dot",         "cross",     "max",     "min",    "pow",
                                        "reflect",   "length",      "distance",  "clamp",   "mix",    "abs",
                                        "sqrt",      "inversesqrt", "transpose", "inverse", "texture"};

// Reserved words of GLSL that look like ordinary names (GLSL 1.20, section 3.6).
static const char *const reserved[] = {
    "half",     "fixed",         "input",     "output", "double",   "hvec2",     "hvec3",    "hvec4",
    "fvec3",    "sampler3DRect", "long",      "short",  "this",     "class",     "template", "inline",
    "noinline", "public",        "static",    "extern", "external", "interface", "unsigned", "superp",
    "filter",   "common",        "partition", "active", "cast",     "namespace", "using",    "packed",
    "union",    "enum",          "typedef",   "goto",   "asm",      "sizeof"};

static bool in_list(const char *word, const char *const *list, int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(word, list[i]) == 0)
            return true;
    return false;
}

// Functions that were added after GLSL 1.10 and GLSL ES 1.00.
static const struct {
    const char *name;
    int version, es_version;
    const char *otherwise; // the advice, or NULL
} young_functions[] = {
    {"inverse", 140, 300, "pass the inverse transpose as a uniform"},
    {"transpose", 120, 300, NULL},
    {"outerProduct", 120, 300, NULL},
    {"determinant", 150, 300, NULL},
    {"texture", 130, 300, "write texture2D"},
    {"textureLod", 130, 300, NULL},
    {"texelFetch", 130, 300, NULL},
    {"round", 130, 300, "write floor(x + 0.5)"},
    {"trunc", 130, 300, NULL},
    {"isnan", 130, 300, "write x != x"},
    {"isinf", 130, 300, NULL},
    {"sinh", 130, 300, NULL},
    {"cosh", 130, 300, NULL},
    {"tanh", 130, 300, NULL},
    {"fma", 400, 320, "write a * b + c"},
};

// Returns whether a shader is for OpenGL ES. Without a version line, a precision statement implies WebGL.
static bool is_es(const struct declarations *d)
{
    return strcmp(d->profile, "es") == 0 || d->version == 100 || (!d->version && declarations_uses(d, "precision"));
}

// Explains that a function is missing in the shader's version of GLSL. Returns false if `name` is not a function of a
// later version.
static bool hint_young_function(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                                int line, const char *name)
{
    for (int i = 0; i < COUNT(young_functions); i++) {
        bool es = is_es(d);
        int needed = es ? young_functions[i].es_version : young_functions[i].version;
        int version = d->version ? d->version : es ? 100 : 110;
        if (strcmp(young_functions[i].name, name) != 0 || version >= needed)
            continue;
        const char *otherwise = young_functions[i].otherwise;
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, line,
                        "%s() needs GLSL %s%d%s, and this shader is GLSL %s%d: write `#version %d%s` in the first "
                        "line%s%s",
                        name, es ? "ES " : "", needed, es ? "" : " (in WebGL 300 es)", es ? "ES " : "", version, needed,
                        es ? " es" : "", otherwise ? ", or " : "", otherwise ? otherwise : "");
        return true;
    }
    return false;
}

static bool is_identifier(const struct declarations *d, int i)
{
    static const char *const words[] = {"return",  "else",      "do",        "in",      "out",  "inout",
                                        "uniform", "attribute", "const",     "varying", "flat", "highp",
                                        "lowp",    "mediump",   "precision", "struct"};
    return i >= 0 && word_is_name(d->words[i].text) && !in_list(d->words[i].text, words, COUNT(words));
}

// Returns the name that the author probably meant by the undeclared `name` at word `at`: a variable or, before a
// parenthesis, a function that is declared above. Returns NULL if there is none.
static const char *nearest_declared(const struct declarations *d, const char *name, int at)
{
    enum { MAX_NAMES = 256 };
    const char *names[MAX_NAMES], *near;
    const bool called = word_is(d, at + 1, "(");
    int count = 0, begin = at < d->word_count ? at : d->word_count - 1;
    while (begin > 0 && !strchr(";{}", d->words[begin].text[0]))
        begin--;
    for (int i = 1; i < begin && count < MAX_NAMES; i++) {
        const bool typed = is_identifier(d, i - 1) || word_is(d, i - 1, "}") || word_is(d, i - 1, ",");
        if (typed && is_identifier(d, i) && word_is(d, i + 1, "(") == called)
            names[count++] = d->words[i].text;
    }
    near = name_nearest(name, names, count);
    return near || !called ? near : name_nearest(name, functions, COUNT(functions));
}

// Extracts `name' or 'name' from a message.
static bool quoted_name(const char *words, char name[64])
{
    const char *open = strpbrk(words, "`'\"");
    size_t length = open ? strspn(open + 1, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") : 0;
    if (length == 0 || length > 63)
        return false;
    snprintf(name, 64, "%.*s", (int)length, open + 1);
    return true;
}

// Finds the word `name` on a line or, if it does not occur there, the line's first word.
static int find_on_line(const struct declarations *d, int line, const char *name)
{
    int first = -1;
    for (int i = 0; i < d->word_count; i++) {
        if (d->words[i].line == line && strcmp(d->words[i].text, name) == 0)
            return i;
        if (first < 0 && d->words[i].line >= line)
            first = i;
    }
    return line > 0 && first >= 0 ? first : d->word_count;
}

static int first_on_line(const struct declarations *d, int line)
{
    for (int i = 0; i < d->word_count; i++)
        if (d->words[i].line >= line)
            return i;
    return d->word_count;
}

// Explains a member that does not exist in any struct of the shader: lights[0].postion.
static void hint_member(struct diagnostics *diagnostics, const struct declarations *d, const char *file, int line,
                        const char *name)
{
    const char *members[64] = {NULL};
    int count = 0;
    for (int i = 0; i < d->count && count < 64; i++) {
        const char *dot = strrchr(d->items[i].name, '.');
        if (dot)
            members[count++] = dot + 1;
    }
    const char *near = name_nearest(name, members, count);
    if (near)
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, line,
                        "there is no member '%s'; did you mean '%s'?", name, near);
}

void compiler_hints_for_message(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                                int line, const char *message)
{
    char name[64];
    if ((strstr(message, "undeclared") || strstr(message, "no function") || strstr(message, "undefined")) &&
        quoted_name(message, name) && strncmp(name, "gl_", 3) != 0) {
        bool called = strstr(message, "function") != NULL;
        if (called && hint_young_function(diagnostics, d, file, line, name))
            return;
        const int at = find_on_line(d, line, name);
        // `name = …;` at the beginning of a statement lacks a type.
        const bool untyped = word_is(d, at + 1, "=") && (word_is(d, at - 1, ";") || word_is(d, at - 1, "{"));
        const char *near = untyped ? NULL : nearest_declared(d, name, at);
        if (near && called)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, line,
                            "there is no function '%s'; did you mean '%s'?", name, near);
        else if (near)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, line,
                            "'%s' is not declared, but '%s' is: use one name", name, near);
        else if (called)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, line,
                            "there is no function '%s': define it above its first use", name);
        else
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, line,
                            "'%s' is not declared: give it a type at its first use", name);
    }
    if (strstr(message, "include") && strchr(message, '<'))
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, line,
                        "GLSL has no #include: three.js replaces it with its own code, which the check does not have; "
                        "write this code yourself");
    if (strstr(message, " field ") && quoted_name(message, name))
        hint_member(diagnostics, d, file, line, name);
    if (strstr(message, "no matching function") && (strstr(message, "(int") || strstr(message, ", int")))
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, line,
                        "an integer is used in place of a float: write 0.0 for 0, 2.0 for 2");
    if (strstr(message, "syntax error") && line > 0) {
        int at = first_on_line(d, line);
        if (at > 0 && at < d->word_count) {
            const char *before = d->words[at - 1].text;
            if (d->words[at - 1].line < line &&
                (word_is_name(before) || isdigit((unsigned char)before[0]) || strchr(")]", before[0])))
                diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->words[at - 1].line,
                                "is a ';' missing in line %d after '%s'?", d->words[at - 1].line, before);
        }
    }
}

static void hint_main(struct diagnostics *diagnostics, const struct declarations *d, const char *file)
{
    for (int i = 0; i + 1 < d->word_count; i++)
        if (strcmp(d->words[i].text, "main") == 0 && strcmp(d->words[i + 1].text, "(") == 0 && d->words[i].depth == 0 &&
            (i == 0 || strcmp(d->words[i - 1].text, "void") != 0))
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->words[i].line,
                            "write `void main()`: a function needs a return type");
}

static void hint_built_ins(struct diagnostics *diagnostics, const struct declarations *d, const char *file)
{
    for (int i = 0; i < d->word_count; i++) {
        const char *w = d->words[i].text;
        if (strncasecmp(w, "gl_", 3) != 0 || in_list(w, built_ins, COUNT(built_ins)))
            continue;
        const char *meant = NULL;
        for (int k = 0; k < COUNT(built_ins); k++)
            if (strcasecmp(built_ins[k], w) == 0)
                meant = built_ins[k];
        if (!meant)
            meant = nearest_word(w, built_ins, COUNT(built_ins));
        if (meant)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->words[i].line, "'%s' should be %s", w,
                            meant);
    }
    bool core = d->version >= 150 && strcmp(d->profile, "compatibility") != 0;
    if (!core)
        return;
    for (int i = 0; i < d->word_count; i++) {
        const char *w = d->words[i].text;
        if (in_list(w,
                    (const char *const[]){"gl_Vertex", "gl_Normal", "gl_NormalMatrix", "gl_ModelViewMatrix",
                                          "gl_ModelViewProjectionMatrix", "gl_ProjectionMatrix", "gl_FragColor"},
                    7))
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->words[i].line,
                            "%s exists only in old GLSL: write `#version %d compatibility` in the first line, or "
                            "declare a name of your own",
                            w, d->version);
    }
}

static void hint_reserved(struct diagnostics *diagnostics, const struct declarations *d, const char *file)
{
    for (int i = 1; i < d->word_count; i++)
        if (in_list(d->words[i].text, reserved, COUNT(reserved)) && in_list(d->words[i - 1].text, types, COUNT(types)))
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->words[i].line,
                            "'%s' is a reserved word of GLSL: use another name (for the half vector: H or halfway)",
                            d->words[i].text);
}

static bool is_struct(const struct declarations *d, const char *name)
{
    for (int i = 0; i + 1 < d->word_count; i++)
        if (strcmp(d->words[i].text, "struct") == 0 && strcmp(d->words[i + 1].text, name) == 0)
            return true;
    return false;
}

static void hint_types(struct diagnostics *diagnostics, const struct declarations *d, const char *file)
{
    for (int i = 0; i < d->count; i++) {
        const struct declaration *item = &d->items[i];
        if (item->in_block || in_list(item->type, types, COUNT(types)) || is_struct(d, item->type) ||
            strchr(item->name, '.'))
            continue;
        const char *near = nearest_word(item->type, types, COUNT(types));
        size_t known = strlen(item->type);
        if (known > 0 && in_list(item->type, (const char *const[]){"in", "out", "uniform"}, 3))
            continue;
        // In `vec3v Ns`, the author typed the space one letter too late.
        char shorter[32];
        snprintf(shorter, sizeof shorter, "%.*s", (int)known - 1, item->type);
        if (in_list(shorter, types, COUNT(types)))
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, item->line,
                            "'%s %s' is not a declaration; did you mean `%s %c%s`?", item->type, item->name, shorter,
                            item->type[known - 1], item->name);
        else if (near)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, item->line,
                            "'%s' is not a type; did you mean %s?", item->type, near);
    }
}

static void hint_version(struct diagnostics *diagnostics, const struct declarations *d, const char *file, bool vertex)
{
    if (d->version >= 130)
        return;
    for (int i = 0; i < d->word_count; i++)
        if (d->words[i].depth == 0 &&
            (strcmp(d->words[i].text, "in") == 0 || strcmp(d->words[i].text, "out") == 0 ||
             strcmp(d->words[i].text, "flat") == 0) &&
            (i == 0 || strchr(";})", d->words[i - 1].text[0]))) {
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->words[i].line,
                            "'%s' needs GLSL 1.30 or later: write `#version 330 compatibility` in the first line, "
                            "or %s here",
                            d->words[i].text, strcmp(d->words[i].text, "in") == 0 && vertex ? "attribute" : "varying");
            return;
        }
}

static void hint_globals(struct diagnostics *diagnostics, const struct declarations *d, const char *file)
{
    if (strcmp(d->profile, "es") != 0)
        return;
    for (int i = 2; i + 1 < d->word_count; i++) // finds `vec3 name = expression;` with a uniform in the expression
        if (d->words[i].depth == 0 && strcmp(d->words[i].text, "=") == 0 &&
            in_list(d->words[i - 2].text, types, COUNT(types)))
            for (int k = i + 1; k < d->word_count && strcmp(d->words[k].text, ";") != 0; k++)
                if (declarations_find(d, DECLARED_UNIFORM, d->words[k].text))
                    diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->words[i].line,
                                    "GLSL ES can initialise globals only with constants: assign '%s' in main()",
                                    d->words[i - 1].text);
}

void compiler_hints_for_text(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                             bool vertex)
{
    hint_main(diagnostics, d, file);
    hint_built_ins(diagnostics, d, file);
    hint_reserved(diagnostics, d, file);
    hint_types(diagnostics, d, file);
    hint_version(diagnostics, d, file, vertex);
    hint_globals(diagnostics, d, file);
}

void compiler_hints_for_unused(struct diagnostics *diagnostics, const struct declarations *d, const char *file)
{
    for (int i = 0; i < d->count; i++)
        if (d->items[i].kind == DECLARED_UNIFORM && !d->items[i].in_block && !strpbrk(d->items[i].name, ".[") &&
            !declarations_uses(d, d->items[i].name))
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->items[i].line,
                            "the shader declares the uniform '%.60s', but does not use it", d->items[i].name);
}

bool compiler_hints_for_output(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                               const char *output)
{
    bool writes = declarations_uses(d, "gl_FragColor") || declarations_uses(d, "gl_FragData"), used = writes;
    for (int i = 0; i < d->count; i++) {
        const struct declaration *item = &d->items[i];
        if (item->kind != DECLARED_OUTPUT || item->in_block)
            continue;
        bool whole = strchr("iub", item->type[0]) != NULL;
        used |= declarations_uses(d, item->name);
        writes |= declarations_uses(d, item->name) && !whole;
        if (strcmp(item->type, "vec4") != 0)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, item->line,
                            whole
                                ? "the output '%s' is of type %s, but a picture consists of floats: declare out vec4 %s"
                                : "the output '%s' is of type %s, which leaves channels undefined: declare out vec4 %s",
                            item->name, item->type, item->name);
    }
    int length = output ? (int)strcspn(output, " ") : 5;
    output = output ? output : "color";
    if (!used && d->version >= 150)
        diagnostics_add(
            diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, 0,
            "the shader writes no colour, so the pictures are undefined: write out vec4 %.*s; and assign %.*s "
            "in main()",
            length, output, length, output);
    else if (!used)
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, 0,
                        "the shader writes no colour, so the pictures are undefined: write gl_FragColor = ...;");
    return writes;
}

void compiler_hints_for_link(struct diagnostics *diagnostics, const struct shader_interface *r,
                             const lam_check_params *params)
{
    for (int i = 0; i < r->fragment.count; i++) {
        const struct declaration *in = &r->fragment.items[i];
        if (in->kind != DECLARED_INPUT)
            continue;
        const struct declaration *out = declarations_find(&r->vertex, DECLARED_OUTPUT, in->name);
        if (out && strcmp(out->type, in->type) != 0)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, params->fragment_name, in->line,
                            "'%s' is a %s here and a %s in the vertex shader, line %d", in->name, in->type, out->type,
                            out->line);
        if (out && out->flat != in->flat)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, params->fragment_name, in->line,
                            "'%s' is flat in one shader and not in the other", in->name);
        if (out)
            continue;
        const char *words[64] = {NULL};
        int count = 0;
        for (int k = 0; k < r->vertex.count && count < 64; k++) {
            const struct declaration *candidate = &r->vertex.items[k];
            if (candidate->kind == DECLARED_OUTPUT && !declarations_find(&r->fragment, DECLARED_INPUT, candidate->name))
                words[count++] = candidate->name;
        }
        const char *near = name_nearest(in->name, words, count);
        if (near)
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, params->fragment_name, in->line,
                            "the vertex shader writes no '%s'; did you mean '%s'?", in->name, near);
        else
            diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, params->fragment_name, in->line,
                            "the vertex shader writes no '%s'", in->name);
    }
}
