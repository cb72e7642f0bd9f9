// shader_es.c: converts desktop GLSL to GLSL ES 3.00, line by line.
#include "draw_request.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

// OpenGL's built-in inputs. In the source, `gl_` becomes `fixed_`, and this declaration is added.
static const struct built_in {
    struct contract_name row;
    const char *declaration;
} built_ins[] = {
    {{.name = "fixed_Vertex", .type = "vec4", .semantic = SEMANTIC_POSITION, .group = -1}, "in vec4 fixed_Vertex;"},
    {{.name = "fixed_Normal", .type = "vec3", .semantic = SEMANTIC_NORMAL, .group = -1}, "in vec3 fixed_Normal;"},
    {{.name = "fixed_ModelViewMatrix",
      .type = "mat4",
      .semantic = SEMANTIC_MODEL_VIEW,
      .space = LAM_FRAME_CAMERA,
      .group = -1},
     "uniform mat4 fixed_ModelViewMatrix;"},
    {{.name = "fixed_ProjectionMatrix", .type = "mat4", .semantic = SEMANTIC_PROJECTION, .group = -1},
     "uniform mat4 fixed_ProjectionMatrix;"},
    {{.name = "fixed_ModelViewProjectionMatrix",
      .type = "mat4",
      .semantic = SEMANTIC_MODEL_VIEW_PROJECTION,
      .group = -1},
     "uniform mat4 fixed_ModelViewProjectionMatrix;"},
    {{.name = "fixed_NormalMatrix",
      .type = "mat3",
      .semantic = SEMANTIC_NORMAL_MATRIX,
      .space = LAM_FRAME_CAMERA,
      .group = -1},
     "uniform mat3 fixed_NormalMatrix;"},
};
enum { BUILT_INS = sizeof built_ins / sizeof *built_ins };
static const char prefix[] = "fixed_";
enum { PREFIX = sizeof prefix - 1 };

const struct contract_name *shader_dialect_built_in(const char *name)
{
    for (int i = 0; i < BUILT_INS; i++)
        if (strcmp(built_ins[i].row.name, name) == 0)
            return &built_ins[i].row;
    return NULL;
}

// Keywords of older versions, and their replacements in the two stages of ES 3.00. If the keyword occurs, `declaration`
// is added (may be NULL).
static const struct old_word {
    const char *old, *vertex, *fragment, *declaration;
} words[] = {
    {"attribute", "in", "attribute", NULL},
    {"varying", "out", "in", NULL},
    {"texture2D", "texture", "texture", NULL},
    {"gl_FragColor", "gl_FragColor", "fixed_FragColor", "out vec4 fixed_FragColor;"},
    {"gl_MultiTexCoord0", "fixed_MultiTexCoord0", "gl_MultiTexCoord0",
     "const vec4 fixed_MultiTexCoord0 = vec4(0.0, 0.0, 0.0, 1.0);"},
    {"ftransform", "fixed_transform", "ftransform",
     "vec4 fixed_transform() { return fixed_ModelViewProjectionMatrix * fixed_Vertex; }"},
};
enum { WORDS = sizeof words / sizeof *words };

struct rewriting {
    char *out;
    size_t at, capacity;
    bool vertex;
    bool uses_built_in[BUILT_INS], uses_word[WORDS];
};

static void put(struct rewriting *r, const char *text, size_t length)
{
    if (r->out && r->at + length < r->capacity)
        memcpy(r->out + r->at, text, length);
    r->at += length;
}

static bool is(const char *word, size_t length, const char *name)
{
    return strlen(name) == length && strncmp(word, name, length) == 0;
}

static void put_word(struct rewriting *r, const char *word, size_t length)
{
    for (int i = 0; i < WORDS; i++)
        if (is(word, length, words[i].old)) {
            const char *new = r->vertex ? words[i].vertex : words[i].fragment;
            r->uses_word[i] = strncmp(new, prefix, PREFIX) == 0;
            put(r, new, strlen(new));
            return;
        }
    for (int i = 0; i < BUILT_INS; i++)
        if (length > 3 && strncmp(word, "gl_", 3) == 0 && is(word + 3, length - 3, built_ins[i].row.name + PREFIX)) {
            r->uses_built_in[i] = true;
            put(r, prefix, PREFIX);
            put(r, word + 3, length - 3);
            return;
        }
    put(r, word, length);
}

static bool is_letter(char c) { return isalnum((unsigned char)c) || c == '_'; }

// Writes the source without its version line, with the keywords of ES 3.00.
static void put_body(struct rewriting *r, const char *text)
{
    bool begins = true; // whether the position is at the start of a line
    for (const char *c = text; *c;) {
        const char *hash = c + strspn(c, " \t");
        if (begins && *hash == '#' && strncmp(hash + 1 + strspn(hash + 1, " \t"), "version", 7) == 0) {
            c = hash + strcspn(hash, "\n");
            continue;
        }
        begins = *c == '\n';
        if (!is_letter(*c)) {
            put(r, c++, 1);
            continue;
        }
        const char *word = c;
        while (is_letter(*c))
            c++;
        put_word(r, word, (size_t)(c - word));
    }
}

// Attributes are declared in the vertex shader; both stages may read the matrices.
static void put_declarations(struct rewriting *r)
{
    static const int of_transform[] = {0, 4}; // fixed_Vertex, fixed_ModelViewProjectionMatrix
    for (size_t i = 0; r->uses_word[WORDS - 1] && i < sizeof of_transform / sizeof *of_transform; i++)
        r->uses_built_in[of_transform[i]] = true;
    for (int i = 0; i < BUILT_INS; i++)
        if (r->uses_built_in[i]) {
            put(r, built_ins[i].declaration, strlen(built_ins[i].declaration));
            put(r, "\n", 1);
        }
    for (int i = 0; i < WORDS; i++)
        if (r->uses_word[i]) {
            put(r, words[i].declaration, strlen(words[i].declaration));
            put(r, "\n", 1);
        }
}

static void put_all(struct rewriting *r, const char *text)
{
    static const char head[] = "#version 300 es\nprecision highp float;\nprecision highp int;\n";
    r->at = 0;
    put(r, head, sizeof head - 1);
    put_declarations(r);
    put(r, "#line 1\n", 8);
    put_body(r, text);
}

char *shader_dialect_es(const char *text, bool is_vertex, lam_error *error)
{
    struct rewriting r = {.vertex = is_vertex};
    put_body(&r, text); // the first pass only determines the necessary declarations
    put_all(&r, text);
    r.capacity = r.at + 1;
    r.out = malloc(r.capacity);
    if (!r.out)
        return fail_memory(error, r.capacity), NULL;
    put_all(&r, text);
    r.out[r.at] = 0;
    return r.out;
}

void shader_dialect_restore(char *log)
{
    char *to = log;
    for (const char *from = log; *from;)
        if (strncmp(from, prefix, PREFIX) == 0) {
            *to++ = 'g';
            *to++ = 'l';
            *to++ = '_';
            from += PREFIX;
        } else {
            *to++ = *from++;
        }
    *to = 0;
}
