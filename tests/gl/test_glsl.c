// test_glsl.c: the texts of every combination of choices are accepted by the reference compiler
// (glslangValidator), vertex and fragment text fit each other, and what the choices do not need is not in
// them.
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "glsl.h"
#include "glsl_combinations.h"
#include "template.h"

static bool has(const char *text, const char *word) { return strstr(text, word) != NULL; }

static struct glsl_text make(const struct glsl_choices *choices)
{
    struct glsl_text text;
    lam_error error = {0};
    if (!glsl_make(choices, &text, &error))
        fail_msg("%s", error.text);
    return text;
}

static void test_only_what_is_needed(void **state)
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
    assert_true(has(text.fragment, "answer phong_lobe(surface s, vec3 l)"));
    assert_true(has(text.fragment, "// Phong (1975)"));
    assert_false(has(text.fragment, "blinn_phong"));
    assert_false(has(text.fragment, "kajiya"));
    assert_false(has(text.fragment, "struct hemisphere"));
    assert_true(has(text.fragment, "LIGHT_POINT, FALLOFF_DISTANCE"));
    assert_false(has(text.vertex, "phong"));
    // The dialect's words have become GLSL's.
    assert_false(has(text.fragment, "STRUCT"));
    assert_false(has(text.fragment, "FN "));
    assert_false(has(text.fragment, "num_of"));
    glsl_free(&text);
    c.stage = LAM_STAGE_VERTEX;
    c.shading = LAM_SHADING_FLAT;
    text = make(&c);
    assert_true(has(text.vertex, "flat out vec4 front_light"));
    assert_true(has(text.vertex, "answer phong_lobe("));
    assert_false(has(text.fragment, "reflected"));
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

static void test_what_does_not_go_together(void **state)
{
    (void)state;
    struct glsl_choices right = {
        .version = GLSL_120, .stage = LAM_STAGE_FRAGMENT, .reflection = LAM_REFLECTION_PHONG};
    struct glsl_text text = make(&right);
    glsl_free(&text);
    struct glsl_choices wrong[5] = {right, right, right, right, right};
    wrong[0].storage = GLSL_BLOCK;
    wrong[1].storage = GLSL_TEXTURE;
    wrong[2].environment = GLSL_FACES;
    wrong[3].stage = LAM_STAGE_VERTEX;
    wrong[4].shading = LAM_SHADING_GOURAUD;
    for (int i = 0; i < 5; i++) {
        lam_error error = {0};
        assert_false(glsl_make(&wrong[i], &text, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_true(strlen(error.text) > 20);
        assert_null(text.vertex);
    }
}

static void test_templates_refuse_what_they_do_not_know(void **state)
{
    (void)state;
    const struct template_flag flags[] = {
        {"on", true}, {"off", false}, {"back_material", true}, {NULL, false}};
    const struct template_value values[] = {{"five", "5"}, {NULL, NULL}};
    const struct template_words words = {flags, values};
    static const char *const wrong[] = {"//@if what\n//@end\n", "a @six@ b\n", "//@if on\n",
                                        "//@unless on\n//@end\n"};
    for (int i = 0; i < 4; i++) {
        struct text text = {0};
        template_add(&text, wrong[i], &words);
        assert_true(text.failed);
        free(text.bytes);
    }
    struct text text = {0};
    template_add(&text,
                 "//@if off\na\n//@elif on\nb @five@ $(x[i]).y\n//@else\nc\n//@end\n//@if !off\nd\n//@end\n",
                 &words);
    assert_false(text.failed);
    assert_string_equal(text.bytes, "b 5 (front ? x[i] : back_x[i]).y\nd\n");
    free(text.bytes);
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

struct writing {
    const char *folder;
    int count;
};

static void write_pair(void *user, const struct glsl_choices *choices)
{
    struct writing *writing = user;
    struct glsl_text text = make(choices);
    write_file(writing->folder, writing->count, "vert", text.vertex);
    write_file(writing->folder, writing->count, "frag", text.fragment);
    writing->count++;
    glsl_free(&text);
}

static void test_reference_compiler_accepts(void **state)
{
    (void)state;
    if (system("glslangValidator --version > /dev/null 2>&1") != 0) {
        print_message(
            "glslangValidator (package glslang-tools) is not installed: the shaders were not checked\n");
        skip();
    }
    char folder[] = "/tmp/lambent-glsl-XXXXXX";
    assert_non_null(mkdtemp(folder));
    struct writing writing = {.folder = folder};
    int count = glsl_combinations(write_pair, &writing);
    assert_int_equal(writing.count, count);
    assert_true(count > 500);
    char command[512];
    // All in one process; then in pairs, whether what one hands on is what the other takes.
    snprintf(command, sizeof command, "cd %s && glslangValidator *.vert *.frag > log 2>&1", folder);
    int refused = system(command);
    if (refused)
        (void)!system("grep -l ERROR /dev/null; true");
    snprintf(command, sizeof command, "grep -B2 ERROR %s/log | head -20 >&2", folder);
    if (refused)
        (void)!system(command);
    snprintf(command, sizeof command,
             "cd %s && for v in *[05]0.vert; do glslangValidator -l $v ${v%%vert}frag > pair 2>&1 || { echo "
             "$v; cat pair; exit 1; }; done >&2",
             folder);
    int unfit = refused ? 1 : system(command);
    // The check must be able to fail.
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
        cmocka_unit_test(test_only_what_is_needed),
        cmocka_unit_test(test_what_does_not_go_together),
        cmocka_unit_test(test_templates_refuse_what_they_do_not_know),
        cmocka_unit_test(test_reference_compiler_accepts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
