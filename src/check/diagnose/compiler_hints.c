// compiler_hints.c: rules that turn a compiler's message, or the text itself, into a sentence that helps.
#include "compiler_hints.h"

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

// Reserved by GLSL though they look like plain names (1.20, 3.6).
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

static bool is_name(const char *w) { return isalpha((unsigned char)w[0]) || w[0] == '_'; }

// Of all names that the text declares or assigns, the nearest to one that it does not.
static const char *nearest_declared(const struct declarations *d, const char *name)
{
    const char *words[256];
    int count = 0;
    for (int i = 0; i < d->count && count < 128; i++)
        words[count++] = d->items[i].name;
    for (int i = 1; i < d->word_count && count < 256; i++) // vec3 name, float name …
        if (in_list(d->words[i - 1].text, types, COUNT(types)) && is_name(d->words[i].text) &&
            strcmp(d->words[i].text, name) != 0)
            words[count++] = d->words[i].text;
    for (int i = 0; i < count; i++) // the same but for case: eye_Position
        if (strcasecmp(words[i], name) == 0)
            return words[i];
    const char *near = nearest_word(name, words, count);
    if (near)
        return near;
    for (int i = 0; i < count; i++) { // the same first word: eye_point, eye_position
        size_t stem = strcspn(name, "_");
        if (name[stem] && strncmp(words[i], name, stem + 1) == 0)
            return words[i];
    }
    return nearest_word(name, functions, COUNT(functions));
}

// `name' or 'name' in a message.
static bool quoted_name(const char *words, char name[64])
{
    const char *open = strpbrk(words, "`'\"");
    size_t length = open ? strspn(open + 1, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") : 0;
    if (length == 0 || length > 63)
        return false;
    snprintf(name, 64, "%.*s", (int)length, open + 1);
    return true;
}

static int first_on_line(const struct declarations *d, int line)
{
    for (int i = 0; i < d->word_count; i++)
        if (d->words[i].line >= line)
            return i;
    return d->word_count;
}

void compiler_hints_of_message(struct diagnostics *notes, const struct declarations *d, const char *file, int line,
                               const char *words)
{
    char name[64];
    if ((strstr(words, "undeclared") || strstr(words, "no function") || strstr(words, "undefined")) &&
        quoted_name(words, name) && strncmp(name, "gl_", 3) != 0) {
        const char *near = nearest_declared(d, name);
        if (near)
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, line,
                            "'%s' is declared nowhere; '%s' is. Is it meant? One name each", name, near);
        else
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, line,
                            "'%s' is declared nowhere: give it a type where it is first used", name);
    }
    if (strstr(words, "no matching function") && (strstr(words, "int") || strstr(words, "(float, int)")))
        diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, line,
                        "a whole number stands where a float is expected: write 0.0 for 0, 2.0 for 2");
    if (strstr(words, "syntax error") && line > 0) {
        int at = first_on_line(d, line);
        if (at > 0 && at < d->word_count) {
            const char *before = d->words[at - 1].text;
            if (d->words[at - 1].line < line &&
                (is_name(before) || isdigit((unsigned char)before[0]) || strchr(")]", before[0])))
                diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, d->words[at - 1].line,
                                "does line %d lack its ';' after '%s'?", d->words[at - 1].line, before);
        }
    }
}

static void hint_main(struct diagnostics *notes, const struct declarations *d, const char *file)
{
    for (int i = 0; i + 1 < d->word_count; i++)
        if (strcmp(d->words[i].text, "main") == 0 && strcmp(d->words[i + 1].text, "(") == 0 && d->words[i].depth == 0 &&
            (i == 0 || strcmp(d->words[i - 1].text, "void") != 0))
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, d->words[i].line,
                            "write `void main()`: a function needs its type");
}

static void hint_built_ins(struct diagnostics *notes, const struct declarations *d, const char *file)
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
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, d->words[i].line, "'%s' is written %s", w, meant);
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
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, d->words[i].line,
                            "%s exists only in old GLSL: write `#version %d compatibility` in the first line, or "
                            "declare one's own",
                            w, d->version);
    }
}

static void hint_reserved(struct diagnostics *notes, const struct declarations *d, const char *file)
{
    for (int i = 1; i < d->word_count; i++)
        if (in_list(d->words[i].text, reserved, COUNT(reserved)) && in_list(d->words[i - 1].text, types, COUNT(types)))
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, d->words[i].line,
                            "'%s' is a reserved word of GLSL; take another name (for the half vector: H or halfway)",
                            d->words[i].text);
}

static bool is_struct(const struct declarations *d, const char *name)
{
    for (int i = 0; i + 1 < d->word_count; i++)
        if (strcmp(d->words[i].text, "struct") == 0 && strcmp(d->words[i + 1].text, name) == 0)
            return true;
    return false;
}

static void hint_types(struct diagnostics *notes, const struct declarations *d, const char *file)
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
        // vec3v Ns: the name's first letter has slipped to the type
        char shorter[32];
        snprintf(shorter, sizeof shorter, "%.*s", (int)known - 1, item->type);
        if (in_list(shorter, types, COUNT(types)))
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, item->line,
                            "'%s %s' is no declaration; is `%s %c%s` meant?", item->type, item->name, shorter,
                            item->type[known - 1], item->name);
        else if (near)
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, item->line, "'%s' is no type; is %s meant?", item->type,
                            near);
    }
}

static void hint_version(struct diagnostics *notes, const struct declarations *d, const char *file, bool vertex)
{
    if (d->version >= 130)
        return;
    for (int i = 0; i < d->word_count; i++)
        if (d->words[i].depth == 0 &&
            (strcmp(d->words[i].text, "in") == 0 || strcmp(d->words[i].text, "out") == 0 ||
             strcmp(d->words[i].text, "flat") == 0) &&
            (i == 0 || strchr(";})", d->words[i - 1].text[0]))) {
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, d->words[i].line,
                            "'%s' needs GLSL 1.30 or later: write `#version 330 compatibility` in the first line, "
                            "or %s here",
                            d->words[i].text, strcmp(d->words[i].text, "in") == 0 && vertex ? "attribute" : "varying");
            return;
        }
}

static void hint_globals(struct diagnostics *notes, const struct declarations *d, const char *file)
{
    if (strcmp(d->profile, "es") != 0)
        return;
    for (int i = 2; i + 1 < d->word_count; i++) // vec3 name = something with a uniform in it;
        if (d->words[i].depth == 0 && strcmp(d->words[i].text, "=") == 0 &&
            in_list(d->words[i - 2].text, types, COUNT(types)))
            for (int k = i + 1; k < d->word_count && strcmp(d->words[k].text, ";") != 0; k++)
                if (declarations_find(d, DECLARED_UNIFORM, d->words[k].text))
                    diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, d->words[i].line,
                                    "GLSL ES starts globals with constants only: give '%s' its value in main()",
                                    d->words[i - 1].text);
}

void compiler_hints_of_text(struct diagnostics *notes, const struct declarations *d, const char *file, bool vertex)
{
    hint_main(notes, d, file);
    hint_built_ins(notes, d, file);
    hint_reserved(notes, d, file);
    hint_types(notes, d, file);
    hint_version(notes, d, file, vertex);
    hint_globals(notes, d, file);
}

bool compiler_hints_of_output(struct diagnostics *notes, const struct declarations *d, const char *file)
{
    bool writes = declarations_use(d, "gl_FragColor") || declarations_use(d, "gl_FragData"), used = writes;
    for (int i = 0; i < d->count; i++) {
        const struct declaration *item = &d->items[i];
        if (item->kind != DECLARED_OUTPUT || item->in_block)
            continue;
        bool whole = strchr("iub", item->type[0]) != NULL;
        used |= declarations_use(d, item->name);
        writes |= declarations_use(d, item->name) && !whole;
        if (strcmp(item->type, "vec4") != 0)
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, item->line,
                            whole ? "the output '%s' is of type %s, and a picture holds floats: write out vec4 %s"
                                  : "the output '%s' is of type %s, which leaves channels undefined: write out vec4 %s",
                            item->name, item->type, item->name);
    }
    if (!used)
        diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, 0,
                        "it writes no colour, so that the pictures hold what there was: write %s",
                        d->version >= 150 ? "out vec4 color; and give color its value in main()"
                                          : "gl_FragColor = ...;");
    return writes;
}

void compiler_hints_of_link(struct diagnostics *notes, const struct shader_interface *r, const lam_check_params *params)
{
    for (int i = 0; i < r->fragment.count; i++) {
        const struct declaration *in = &r->fragment.items[i];
        if (in->kind != DECLARED_INPUT)
            continue;
        const struct declaration *out = declarations_find(&r->vertex, DECLARED_OUTPUT, in->name);
        if (out && strcmp(out->type, in->type) != 0)
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, params->fragment_name, in->line,
                            "'%s' is a %s here and a %s in the vertex shader, line %d", in->name, in->type, out->type,
                            out->line);
        if (out && out->flat != in->flat)
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, params->fragment_name, in->line,
                            "'%s' is flat in one shader and not in the other", in->name);
        if (out)
            continue;
        const char *words[64];
        int count = 0;
        for (int k = 0; k < r->vertex.count && count < 64; k++)
            if (r->vertex.items[k].kind == DECLARED_OUTPUT)
                words[count++] = r->vertex.items[k].name;
        const char *near = nearest_word(in->name, words, count);
        if (near)
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, params->fragment_name, in->line,
                            "the vertex shader writes no '%s'; the nearest that it writes is '%s'", in->name, near);
        else
            diagnostics_add(notes, LAM_CHECK_NOTE_HINT, params->fragment_name, in->line,
                            "the vertex shader writes no '%s'", in->name);
    }
}
