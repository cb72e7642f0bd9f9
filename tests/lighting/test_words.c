// test_words.c: the dialect of src/core/lighting contains only the listed words, each of which means the same in C and
// exists in GLSL, and the reference compiler (glslangValidator) accepts the whole text as GLSL 120, 330 and 300 es.

#include "test.h"

#include <ctype.h>

#define LANES 1
#include "lighting.h"

static const char *const equation_files[] = {"surface.h", "lobes.h", "light_kinds.h", "lights.h", "sum.h", "point.h"};
enum { EQUATION_FILES = sizeof equation_files / sizeof *equation_files };

struct word {
    const char *name, *use;
};

static const struct word words[] = {
#define WORD(name, use, truth) {#name, #use},
#include "words.h"
#undef WORD
};
enum { WORDS = sizeof words / sizeof *words };

static int same(vec3 a, float x, float y, float z) { return a.x == x && a.y == y && a.z == z; }
static int near(float a, float b) { return fabsf(a - b) <= 1e-6f * fabsf(b); }

TEST(test_meaning_in_c)
{
#define WORD(name, use, truth)                                                                                         \
    if (!(truth))                                                                                                      \
        fail_msg("in C the word %s does not mean: %s", #name, #truth);
#include "words.h"
#undef WORD
}

// A file of src/core/lighting as GLSL sees it; the caller frees it.
static char *read_text(const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", LIGHTING_FOLDER, name);
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot open %s", path);
    char *text = calloc(1, 1 << 17);
    assert_non_null(text);
    size_t size = fread(text, 1, (1 << 17) - 1, file);
    fclose(file);
    assert_true(size > 100 && size < (1 << 17) - 1);
    char *once = strstr(text, "#pragma once\n"); // embed.py omits this line
    if (once)
        memset(once, ' ', strlen("#pragma once"));
    char *end = strstr(text, "// --- C only");
    if (end)
        *end = 0;
    return text;
}

// Comments become spaces.
static void blank_comments(char *text)
{
    for (char *c = strstr(text, "//"); c; c = strstr(c, "//"))
        while (*c && *c != '\n')
            *c++ = ' ';
    assert_null(strstr(text, "/*"));
}

static int is_name(char c) { return isalnum((unsigned char)c) || c == '_'; }

static int is_word(const char *name, size_t length)
{
    for (int i = 0; i < WORDS; i++)
        if (strlen(words[i].name) == length && memcmp(words[i].name, name, length) == 0)
            return 1;
    return 0;
}

// Functions that the equations define: "FN type name(" in any of the files.
static int is_equation(char *const texts[EQUATION_FILES], const char *name, size_t length)
{
    for (int i = 0; i < EQUATION_FILES; i++) {
        for (const char *at = strstr(texts[i], "FN "); at; at = strstr(at + 1, "FN ")) {
            const char *type = at + 3, *own = type + strcspn(type, " ") + 1;
            if (strcspn(own, "(") == length && memcmp(own, name, length) == 0)
                return 1;
        }
    }
    return 0;
}

// Features that the dialect excludes. Words that both languages use with different meanings (discard, texture…) are
// excluded by the list of words.
static const char *const forbidden[] = {"[",     "]",        "->",   "?",       "%",      "|",     "++",
                                        "--",    "#include", "#if",  "static",  "const ", "float", "double",
                                        "while", "switch",   "goto", "sampler", "sizeof", "inout"};

TEST(test_dialect_is_closed)
{
    char *texts[EQUATION_FILES];
    for (int i = 0; i < EQUATION_FILES; i++) {
        texts[i] = read_text(equation_files[i]);
        for (const char *c = texts[i]; *c; c++)
            if (*c & 0x80)
                fail_msg("%s: byte %d is not ASCII, which GLSL 120 and 330 ask for", equation_files[i],
                         (int)(c - texts[i]));
        blank_comments(texts[i]);
    }
    int calls = 0, literals = 0;
    for (int i = 0; i < EQUATION_FILES; i++) {
        for (unsigned k = 0; k < sizeof forbidden / sizeof *forbidden; k++)
            if (strstr(texts[i], forbidden[k]))
                fail_msg("%s uses %s, which is not in the dialect", equation_files[i], forbidden[k]);
        for (char *c = texts[i]; *c; c++) {
            if (is_name(*c) && (c == texts[i] || !is_name(c[-1]))) {
                size_t length = 1;
                while (is_name(c[length]))
                    length++;
                int is_number = isdigit((unsigned char)*c), after_point = c > texts[i] && c[-1] == '.';
                if (is_number && !after_point && c[length] == '.') { // 1.5f, 1.0e-6f
                    char *end;
                    strtod(c, &end);
                    literals++;
                    if (*end != 'f')
                        fail_msg("%s: literal %.12s has no f", equation_files[i], c);
                }
                size_t gap = strspn(c + length, " ");
                int is_keyword =
                    (length == 2 && memcmp(c, "if", 2) == 0) || (length == 3 && memcmp(c, "for", 3) == 0) ||
                    (length == 6 && memcmp(c, "STRUCT", 6) == 0) || (length == 6 && memcmp(c, "return", 6) == 0);
                if (c[length + gap] == '(' && !is_keyword && !is_number) {
                    calls++;
                    if (!is_word(c, length) && !is_equation(texts, c, length))
                        fail_msg("%s calls %.*s, which is no word and no equation", equation_files[i], (int)length, c);
                }
            }
        }
    }
    assert_true(calls > 100 && literals > 20);
    for (int i = 0; i < EQUATION_FILES; i++)
        free(texts[i]);
}

// Every function of prelude.glsl has a row in words.h.
TEST(test_glsl_words_are_listed)
{
    static const char *const types[] = {"\nfloat ", "\nvec3 ", "\nbool "};
    char *text = read_text("prelude.glsl");
    int found = 0;
    for (int t = 0; t < 3; t++) {
        for (const char *at = strstr(text, types[t]); at; at = strstr(at + 1, types[t])) {
            const char *name = at + strlen(types[t]);
            size_t length = strcspn(name, "(");
            if (!is_word(name, length))
                fail_msg("prelude.glsl defines %.*s, which words.h does not list", (int)length, name);
            found++;
        }
    }
    assert_true(found > 20);
    free(text);
}

// Writes a file of the equations, and replaces an #include by the file that it names, like embed.py.
static void write_text(FILE *file, const char *name)
{
    char *text = read_text(name), *at = text;
    for (char *include; (include = strstr(at, "#include \"")) != NULL;) {
        char *start = include + strlen("#include \""), *end = strchr(start, '"');
        fwrite(at, 1, (size_t)(include - at), file);
        *end = '\0';
        write_text(file, start);
        at = end + 1;
    }
    fputs(at, file);
    free(text);
}

// A main that uses every word, every lobe and, indirectly, every equation.
static void write_shader(FILE *file, const char *version)
{
    int old = strcmp(version, "120") == 0;
    fprintf(file, "#version %s\n", version);
    write_text(file, "prelude.glsl");
    for (int i = 0; i < EQUATION_FILES; i++)
        write_text(file, equation_files[i]);
    fputs("struct lobe_parameters {", file);
#define MEMBER(name, ...) fputs(" float " #name ";", file);
    LOBE_PARAMETERS(MEMBER)
#undef MEMBER
    fputs(" };\nuniform lobe_parameters m;\n"
          "uniform int kind, falloff, viewer;\nuniform float a, b;\nuniform vec3 p, q;\n"
          "uniform light_source light;\nuniform hemisphere dome;\n",
          file);
    fputs(old ? "#define result gl_FragColor\n" : "out vec4 result;\n", file);
    fputs("void main()\n{\n    float sum = 0.0;\n", file);
    for (int i = 0; i < WORDS; i++)
        fprintf(file, "    sum += %s;\n", words[i].use);
    fputs("    surface s = surface_at(p, q, p, viewer);\n"
          "    terms t = start_terms(p, q);\n"
          "    t = add_hemisphere(t, s, dome);\n"
          "    light_sample way = toward_light(s.p, light, kind, falloff);\n"
          "    vec3 l = way.l;\n",
          file);
#define LOBE(NAME, call, ...) fputs("    t = add_reflected(t, light, way, reflected_of(" #call ", a));\n", file);
    LOBES(LOBE)
#undef LOBE
    fputs("    t = add_arriving_ambient(t, p, way);\n"
          "    t = add_environment(tint_terms(t, q), p, mirror3(s.v, s.n));\n"
          "    vec3 colour = add3(sum_terms(t), add3(sum_terms(unlit_terms(p)), halfway3(p, q)));\n"
          "    result = vec4(colour, sum);\n}\n",
          file);
}

TEST(test_glsl_is_accepted)
{
    if (system("glslangValidator --version > /dev/null 2>&1") != 0) {
        print_message("glslangValidator (package glslang-tools) is not installed: the GLSL text was not checked\n");
        skip();
    }
    static const char *const versions[] = {"330 core", "300 es", "120"};
    char folder[] = "/tmp/lambent-words-XXXXXX";
    assert_non_null(mkdtemp(folder));
    int refused = 0;
    for (int i = 0; i < 3; i++) {
        char path[64], command[128];
        snprintf(path, sizeof path, "%s/words.frag", folder);
        snprintf(command, sizeof command, "glslangValidator %s", path);
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        write_shader(file, versions[i]);
        assert_int_equal(fclose(file), 0);
        if (system(command) != 0) {
            print_error("GLSL %s was refused\n", versions[i]);
            refused++;
        }
        // The check itself must be able to fail: the same text with one unknown word added.
        file = fopen(path, "a");
        assert_non_null(file);
        fputs("float broken() { return no_such_word(1.0); }\n", file);
        assert_int_equal(fclose(file), 0);
        strcat(command, " > /dev/null");
        refused += system(command) == 0;
        remove(path);
    }
    rmdir(folder);
    assert_int_equal(refused, 0);
}
