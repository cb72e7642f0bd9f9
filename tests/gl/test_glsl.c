// test_glsl.c: the reference compiler (glslangValidator) accepts the shaders of every combination of choices and links them
// in pairs; a shader contains no code that its choices do not need.
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "glsl.h"
#include "glsl_combinations.h"
#include "glsl_text.h"

static bool has(const char *text, const char *word) { return strstr(text, word) != NULL; }

static struct glsl_text make(const struct glsl_choices *choices)
{
    struct glsl_text text;
    lam_error error = {0};
    if (!glsl_make(choices, &text, &error))
        fail_msg("%s", error.text);
    return text;
}

static void test_only_needed_code(void **state)
{
    (void)state;
    struct glsl_choices c = {.version = GLSL_330,
                             .storage = GLSL_BLOCK,
                             .stage = LAM_STAGE_FRAGMENT,
                             .reflection = LAM_REFLECTION_PHONG,
                             .light_count = 2,
                             .group_count = 1,
                             .groups = {{0, 1, 2}}};
    struct glsl_text text = make(&c);
    assert_true(has(text.fragment, "lobe_sample phong_lobe(surface s, vec3 l)"));
    assert_true(has(text.fragment, "// Phong (1975)"));
    assert_false(has(text.fragment, "blinn_phong"));
    assert_false(has(text.fragment, "kajiya"));
    assert_false(has(text.fragment, "struct hemisphere"));
    assert_true(has(text.fragment, "LIGHT_POINT, FALLOFF_DISTANCE"));
    assert_false(has(text.vertex, "phong"));
    // The dialect's words have been replaced.
    assert_false(has(text.fragment, "STRUCT"));
    assert_false(has(text.fragment, "FN "));
    assert_false(has(text.fragment, "num_of"));
    glsl_free(&text);
    c.stage = LAM_STAGE_VERTEX;
    c.shading = LAM_SHADING_FLAT;
    text = make(&c);
    assert_true(has(text.vertex, "flat out vec4 front_light"));
    assert_true(has(text.vertex, "lobe_sample phong_lobe("));
    assert_false(has(text.fragment, "lobe_value"));
    glsl_free(&text);
    c.version = GLSL_120;
    c.storage = GLSL_ARRAY;
    text = make(&c);
    assert_true(has(text.vertex, "attribute vec3 provoking_position"));
    assert_false(has(text.vertex, "flat out"));
    assert_false(has(text.vertex, "layout"));
    assert_true(has(text.vertex, "uniform Light lights[2]"));
    glsl_free(&text);
}

static void test_exclusive_choices(void **state)
{
    (void)state;
    struct glsl_choices valid = {.version = GLSL_120, .stage = LAM_STAGE_FRAGMENT, .reflection = LAM_REFLECTION_PHONG};
    struct glsl_text text = make(&valid);
    glsl_free(&text);
    struct glsl_choices invalid[5] = {valid, valid, valid, valid, valid};
    invalid[0].storage = GLSL_BLOCK;
    invalid[1].storage = GLSL_TEXTURE;
    invalid[2].environment = GLSL_FACES;
    invalid[3].stage = LAM_STAGE_VERTEX;
    invalid[4].shading = LAM_SHADING_GOURAUD;
    for (int i = 0; i < 5; i++) {
        lam_error error = {0};
        assert_false(glsl_make(&invalid[i], &text, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_true(strlen(error.text) > 20);
        assert_null(text.vertex);
    }
}

// The text does not contain branches with a known condition, and members that are then never read.
static void test_unread_members_are_removed(void **state)
{
    (void)state;
    struct glsl_choices c = {.version = GLSL_120,
                             .storage = GLSL_ARRAY,
                             .stage = LAM_STAGE_FRAGMENT,
                             .reflection = LAM_REFLECTION_BLINN_PHONG,
                             .products = true,
                             .light_count = 2,
                             .group_count = 1,
                             .groups = {{1, 0, 2}}};
    static const char *const of_others[] = {"spot_at",   "attenuation_at", "LIGHT_POINT", "cos_cutoff",   "distance;",
                                            ".xyz(vec4", "vec3 t;",        "if (kind",    "inverse_range"};
    struct glsl_text text = make(&c);
    const char *sun = strstr(text.fragment, "struct Light");
    assert_non_null(sun);
    assert_null(strstr(sun, "vec4 position"));
    for (size_t i = 0; i < sizeof of_others / sizeof *of_others; i++)
        if (has(text.fragment, of_others[i]))
            fail_msg("'%s' is in a text for directional lights alone", of_others[i]);
    assert_true(has(text.fragment, "t.l = negate3(light.direction);"));
    assert_false(has(text.fragment, "float shininess = shininess"));
    glsl_free(&text);
    c.groups[0] = (struct glsl_group){0, 0, 1};
    c.groups[1] = (struct glsl_group){2, 1, 1};
    c.group_count = 2;
    text = make(&c); // a point without attenuation, and a spot with a cutoff and attenuation
    assert_true(has(text.fragment, "if (kind >= LIGHT_SPOT_CUTOFF) {"));
    assert_true(has(text.fragment, "if (falloff != FALLOFF_NONE) {"));
    assert_true(has(text.fragment, "light.cos_cutoff = cone.x;"));
    assert_false(has(text.fragment, "LIGHT_SPOT_CONES"));
    assert_false(has(text.fragment, "inverse_width"));
    assert_false(has(text.fragment, "inverse_range"));
    glsl_free(&text);
}

// The opacity of both sides is compared with their cutoffs before it becomes 1.
static void test_masks_of_two_materials(void **state)
{
    (void)state;
    struct glsl_choices c = {.version = GLSL_330,
                             .storage = GLSL_BLOCK,
                             .stage = LAM_STAGE_FRAGMENT,
                             .reflection = LAM_REFLECTION_LAMBERT,
                             .two_sided = true,
                             .back_material = true,
                             .alpha = {LAM_ALPHA_MASK, LAM_ALPHA_MASK}};
    struct glsl_text text = make(&c);
    const char *front = strstr(text.fragment, "if (gl_FrontFacing && !(light.a >= alpha_cutoff))"),
               *back = strstr(text.fragment, "if (!gl_FrontFacing && !(light.a >= back_alpha_cutoff))"),
               *opaque = strstr(text.fragment, "light.a = 1.0;");
    assert_true(front && back && opaque && front < back && back < opaque);
    glsl_free(&text);
}

static void check_branches(const char *source, const char *expected)
{
    static const struct constant constants[] = {{"a == 1", "true"}, {"b == 2", "false"}, {"on", "true"},
                                                {"off", "false"},   {"FIVE", "5"},       {"LINES", "    x;\n    y;\n"},
                                                {NULL, NULL}};
    struct text text = {0};
    specialize_branches(&text, source, constants);
    assert_false(text.failed);
    assert_string_equal(text.bytes, expected);
    free(text.bytes);
}

static void test_branches(void **state)
{
    (void)state;
    check_branches("{\n    if (a == 1) {\n        x();\n        if (b == 2) {\n            y();\n       "
                   " }\n    } else {\n"
                   "        z();\n    }\n    if (b == 2) {\n        u();\n    } else {\n        v();\n  "
                   "  }\n    if (c) {\n"
                   "        w();\n    }\n}\n",
                   "{\n    x();\n    v();\n    if (c) {\n        w();\n    }\n}\n");
    check_branches(
        "if (off) {\n    a;\n} else if (!on) {\n    b;\n} else if (on && !off) {\n    c;\n} else {\n    d;\n}\ne;\n",
        "c;\ne;\n");
    check_branches("if (c && on) {\n    LINES;\n}\n", "if (c) {\n    x;\n    y;\n}\n");
    check_branches("if ((off || c) && !(d >= FIVE)) { // FIVE\n", "if (c && !(d >= 5)) { // FIVE\n");
    check_branches("    vec3 x = (on ? a[i] : b).xyz + (off ? a : b + c); // on ? a : b\n",
                   "    vec3 x = a[i].xyz + (b + c); // on ? a : b\n");
    check_branches("    return f(on ? off ? a : b : c, d ? on ? e : f : g) * (d ? FIVE : s.FIVE);\n",
                   "    return f(b, d ? e : g) * (d ? 5 : s.FIVE);\n");
}

static void test_unread(void **state)
{
    (void)state;
    char of[] = "struct s\n{\n    int used;\n    int chain;\n    int other; // .other\n};\n",
         by[] = "int f(s a, t b)\n{\n    a.used = 1;\n    a.chain = a.other;\n    a.other = 2;\n    b.chain = 3;\n"
                "    return a.used + b.chain;\n}\n";
    const struct source_span spans[] = {{of, of, of + strlen(of), false}, {by, by, by + strlen(by), false}};
    assert_true(specialize_unread(spans, 2)); // chain, then the member that only chain read
    assert_true(specialize_unread(spans, 2) || !strstr(of, "other;"));
    assert_false(specialize_unread(spans, 2));
    assert_non_null(strstr(of, "int used;"));
    assert_null(strstr(of, "int chain;"));
    assert_null(strstr(of, "int other;"));
    assert_null(strstr(by, "a.chain"));
    assert_null(strstr(by, "a.other"));
    assert_non_null(strstr(by, "    a.used = 1;\n"));
    assert_non_null(strstr(by, "    b.chain = 3;\n")); // from another struct
    assert_non_null(strstr(by, "a.used + b.chain"));
}

// Copies a text without the erased parts.
static const char *remaining(char *to, const char *from)
{
    char *at = to;
    for (; *from; from++)
        if (*from != SPECIALIZE_ERASED)
            *at++ = *from;
    *at = 0;
    return to;
}

static void test_unread_parameters(void **state)
{
    (void)state;
    char f[] = "// `b` is not read.\n// `c` is.\nint f(int a, int b, out int d, int c)\n{\n    int e = a;\n    d = "
               "2;\n    return c;\n}\n",
         g[] = "void g(int q)\n{\n    int r = 1; // r\n    int s = 2;\n    if (q) {\n        r = r + 1;\n    }\n"
               "    x = f(1, h(s, 2),\n          s, q);\n}\n",
         rest[512];
    char *of_f = strstr(f, "int f");
    const struct source_span spans[] = {{f, of_f, f + strlen(f), true}, {g, g, g + strlen(g), true}};
    while (specialize_unread(spans, 2))
        ;
    assert_string_equal(remaining(rest, f), "// `c` is.\nint f(out int d, int c)\n{\n    d = 2;\n    return c;\n}\n");
    assert_string_equal(remaining(rest, g), "void g(int q)\n{\n    int s = 2;\n    x = f(s, q);\n}\n");
}

static void write_file(const char *folder, int number, const char *ending, const char *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%05d.%s", folder, number, ending);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
    for (const char *c = text; *c; c++)
        if (*c & 0x80)
            fail_msg("%s: a byte that is not ASCII", path);
}

// Compiles each different text once. All choices take minutes (LAMBENT_EVERY_SHADER=1, in `make test-long`), so the
// test makes every n-th, with a prime n that covers every loop of glsl_combinations; one in PAIR_SHARE of these is
// linked as a pair. The texts do not depend on this program's compiler, so only one build uses a smaller step.
#ifdef EVERY_TEXT
enum { STEP = 31 };
#else
enum { STEP = 61 };
#endif
enum { PAIR_SHARE = 13 };
enum { TABLE = 1 << 16 };

struct writing {
    const char *folder;
    int count, texts, pairs;
    int step;
    uint64_t seen[TABLE];
};

static bool is_new(struct writing *writing, const char *text)
{
    uint64_t hash = 14695981039346656037u; // FNV-1a
    for (const char *c = text; *c; c++)
        hash = (hash ^ (unsigned char)*c) * 1099511628211u;
    size_t at = hash % TABLE;
    while (writing->seen[at] && writing->seen[at] != hash)
        at = (at + 1) % TABLE;
    bool found = writing->seen[at] == hash;
    writing->seen[at] = hash;
    return !found;
}

static void write_pair(void *user, const struct glsl_choices *choices)
{
    struct writing *writing = user;
    if (writing->count++ % writing->step)
        return;
    struct glsl_text text = make(choices);
    bool is_pair = (writing->count / writing->step) % PAIR_SHARE == 0;
    char folder[80];
    snprintf(folder, sizeof folder, "%s/%s", writing->folder, is_pair ? "pairs" : "single");
    bool vertex = is_new(writing, text.vertex), fragment = is_new(writing, text.fragment);
    writing->texts += vertex;
    if (vertex || is_pair)
        write_file(folder, writing->count, "vert", text.vertex);
    writing->texts += fragment;
    if (fragment || is_pair)
        write_file(folder, writing->count, "frag", text.fragment);
    writing->pairs += is_pair;
    glsl_free(&text);
}

static void test_reference_compiler_accepts(void **state)
{
    (void)state;
    if (system("glslangValidator --version > /dev/null 2>&1") != 0) {
        print_message("glslangValidator (package glslang-tools) is not installed: the shaders were not checked\n");
        skip();
    }
    char folder[] = "/tmp/lambent-glsl-XXXXXX";
    char command[512];
    assert_non_null(mkdtemp(folder));
    snprintf(command, sizeof command, "mkdir %s/single %s/pairs", folder, folder);
    assert_int_equal(system(command), 0);
    struct writing *writing = calloc(1, sizeof *writing);
    assert_non_null(writing);
    writing->folder = folder;
    writing->step = getenv("LAMBENT_EVERY_SHADER") ? 1 : STEP;
    int count = glsl_combinations(write_pair, writing);
    assert_int_equal(writing->count, count);
    assert_true(count > 500);
    assert_true(writing->texts > count / writing->step / 4 && writing->texts < TABLE / 2);
    assert_true(writing->pairs > count / writing->step / PAIR_SHARE / 2);
    print_message("%d choices, %d texts, %d pairs\n", count, writing->texts, writing->pairs);
    free(writing);
    // Compiles all texts in one process, then vertex and fragment shaders in pairs, which checks their interface.
    snprintf(command, sizeof command, "cd %s/single && glslangValidator *.vert *.frag > ../log 2>&1", folder);
    int refused = system(command);
    snprintf(command, sizeof command, "grep -B2 ERROR %s/log | head -20 >&2", folder);
    if (refused)
        (void)!system(command);
    snprintf(command, sizeof command,
             "cd %s/pairs && for v in *.vert; do glslangValidator -l $v ${v%%vert}frag > pair 2>&1 || { echo "
             "$v; cat pair; exit 1; }; done >&2",
             folder);
    int unfit = system(command);
    // The reference compiler rejects an invalid shader.
    write_file(folder, 99999, "frag", "#version 120\nvoid main() { gl_FragColor = vec4(no_such_word); }\n");
    snprintf(command, sizeof command, "cd %s && glslangValidator 99999.frag > /dev/null 2>&1", folder);
    int accepted = system(command) == 0;
    if (refused || unfit) {
        print_error("the shaders are kept in %s\n", folder);
    } else {
        snprintf(command, sizeof command, "rm -r %s", folder);
        (void)!system(command);
    }
    assert_int_equal(refused, 0);
    assert_int_equal(unfit, 0);
    assert_int_equal(accepted, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_only_needed_code),       cmocka_unit_test(test_unread_members_are_removed),
        cmocka_unit_test(test_masks_of_two_materials), cmocka_unit_test(test_branches),
        cmocka_unit_test(test_exclusive_choices),      cmocka_unit_test(test_unread),
        cmocka_unit_test(test_unread_parameters),      cmocka_unit_test(test_reference_compiler_accepts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
