// test_painter.c: tests checks drawn by the caller's painters: one that compiles only OpenGL ES, like a page's WebGL 2,
// one with bytes instead of floats, one from a newer header, and one whose place cannot be woken. TEST_SHADERS is this
// folder.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "draw_request.h"

#ifndef TEST_SHADERS
#define TEST_SHADERS "classroom/tests/check"
#endif

static char *read_text(const char *name, const char *ending)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.%s", TEST_SHADERS, name, ending);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char *text = calloc(1, 65536);
    assert_non_null(text);
    size_t size = fread(text, 1, 65535, file);
    fclose(file);
    assert_true(size > 0 && size < 65535);
    return text;
}

// OpenGL as a painter of the caller, without the gl_ of desktop OpenGL.
static lam_check_painter es_painter(void)
{
    lam_check_painter painter = gl_painter(NULL);
    painter.es_only = true;
    return painter;
}

static void skip_without_gl(void)
{
    lam_check_painter painter = es_painter();
    char renderer[128];
    lam_error error = {0};
    void *place = painter.open(painter.user, LAM_CHECK_LANGUAGE_ES, 32, renderer, &error);
    if (!place) {
        print_message("skipped: %s\n", error.text);
        skip();
    }
    painter.close(place);
}

static lam_check_report run(const lam_check_painter *painter, const char *vertex, const char *fragment)
{
    lam_check_params params = {.vertex = vertex, .fragment = fragment, .fragment_name = "a.frag", .painter = painter};
    lam_check_report report;
    lam_error error = {0};
    if (!lam_check_run(&params, &report, &error))
        fail_msg("%s", error.text);
    return report;
}

// Every contract's program, most of them in desktop GLSL 1.20 to 3.30, one with OpenGL's built-in inputs.
static const char *const programs[] = {"angel",
                                       "angel-vertex",
                                       "gltf",
                                       "lambent",
                                       "learnopengl",
                                       "learnopengl-lights",
                                       "learnopengl-materials",
                                       "learnopengl-pbr",
                                       "learnopengl-spot",
                                       "mdn",
                                       "nyu",
                                       "oregon",
                                       "pittsburgh",
                                       "pittsburgh-helpers",
                                       "pittsburgh-vertex",
                                       "threejs",
                                       "threejs-pbr",
                                       "threejs-raw"};

static void right_programs_pass_as_es(void **state)
{
    (void)state;
    skip_without_gl();
    lam_check_painter painter = es_painter();
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++) {
        char *vertex = read_text(programs[i], "vert"), *fragment = read_text(programs[i], "frag");
        lam_check_report report = run(&painter, vertex, fragment);
        if (report.verdict != LAM_CHECK_PASSES)
            fail_msg("%s %s: %s", programs[i], lam_check_verdict_name(report.verdict),
                     report.diagnostic_count ? report.diagnostics[0].text : "");
        assert_true(report.scene_count > 0);
        lam_check_report_free(&report);
        free(vertex);
        free(fragment);
    }
}

static void a_mistake_has_its_name_as_es(void **state)
{
    (void)state;
    skip_without_gl();
    lam_check_painter painter = es_painter();
    char *vertex = read_text("oregon", "vert"), *fragment = read_text("oregon-no-gate", "frag");
    lam_check_report report = run(&painter, vertex, fragment);
    assert_int_equal(report.verdict, LAM_CHECK_DIFFERS);
    assert_int_equal(report.finding_count, 1);
    assert_string_equal(report.findings[0].mistake, "no-gate");
    assert_true(report.findings[0].certain);
    lam_check_report_free(&report);
    free(vertex);
    free(fragment);
}

// ES 3.00 does not support blocks of varyings: features that the languages do not share are refused with the compiler's
// message.
static void blocks_of_varyings_are_refused_as_es(void **state)
{
    (void)state;
    skip_without_gl();
    lam_check_painter painter = es_painter();
    char *vertex = read_text("pittsburgh-blocks", "vert"), *fragment = read_text("pittsburgh-blocks", "frag");
    lam_check_report report = run(&painter, vertex, fragment);
    assert_int_equal(report.verdict, LAM_CHECK_REFUSED);
    assert_true(report.diagnostic_count > 0);
    lam_check_report_free(&report);
    painter = gl_painter(NULL);
    report = run(&painter, vertex, fragment);
    assert_int_equal(report.verdict, LAM_CHECK_PASSES);
    lam_check_report_free(&report);
    free(vertex);
    free(fragment);
}

// --- a painter with bytes

static int open_size; // the size of the place opened last; a check draws in no other

static void *open_bytes(void *user, lam_check_language language, int size, char renderer[128], lam_error *error)
{
    open_size = size;
    return gl_painter(NULL).open(user, language, size, renderer, error);
}

static bool draw_bytes(void *place, const lam_check_drawing *drawing, float *pixels, lam_error *error)
{
    lam_check_painter floats = gl_painter(NULL);
    if (!floats.draw(place, drawing, pixels, error))
        return false;
    for (size_t i = 0; i < 4 * (size_t)open_size * (size_t)open_size; i++) {
        float x = pixels[i] < 0 ? 0 : pixels[i] > 1 ? 1 : pixels[i];
        pixels[i] = (float)(int)(x * 255 + 0.5F) / 255;
    }
    return true;
}

static void bytes_give_the_same_verdicts(void **state)
{
    (void)state;
    skip_without_gl();
    lam_check_painter painter = es_painter();
    painter.open = open_bytes;
    painter.draw = draw_bytes;
    static const char *const some[] = {"angel", "lambent", "learnopengl", "oregon", "pittsburgh"};
    for (size_t i = 0; i < sizeof some / sizeof *some; i++) {
        char *vertex = read_text(some[i], "vert"), *fragment = read_text(some[i], "frag");
        lam_check_report report = run(&painter, vertex, fragment);
        if (report.verdict != LAM_CHECK_PASSES)
            fail_msg("%s %s", some[i], lam_check_verdict_name(report.verdict));
        lam_check_report_free(&report);
        free(vertex);
        free(fragment);
    }
}

// --- messages

static void a_refused_text_keeps_its_lines_and_names(void **state)
{
    (void)state;
    skip_without_gl();
    lam_check_painter painter = es_painter();
    char *fragment = read_text("oregon", "frag");
    static const char vertex[] = "#version 120\n"
                                 "varying vec3 vNs, vLs, vEs;\n"
                                 "void main()\n"
                                 "{\n"
                                 "    vNs = gl_Normal.xyzw;\n"
                                 "    gl_Position = ftransform();\n"
                                 "}\n";
    lam_check_report report = run(&painter, vertex, fragment);
    assert_int_equal(report.verdict, LAM_CHECK_REFUSED);
    bool found = false;
    for (int i = 0; i < report.diagnostic_count; i++) {
        found = found || report.diagnostics[i].line == 5;
        assert_null(strstr(report.diagnostics[i].text, "fixed_"));
    }
    assert_true(found);
    lam_check_report_free(&report);
    free(fragment);
}

static void a_painter_that_does_not_open_says_why(void **state)
{
    (void)state;
    lam_check_painter painter = {0};
    painter.reserved[0] = 1;
    char *fragment = read_text("angel", "frag");
    lam_check_params params = {.fragment = fragment, .painter = &painter};
    lam_check_report report;
    lam_error error = {0};
    assert_false(lam_check_run(&params, &report, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_non_null(strstr(error.text, "lam_check_painter"));
    free(fragment);
}

// --- idle places

static int opened, closed, compiled, forgotten;
static bool sleeps; // a place that cannot be woken

static void *open_counted(void *user, lam_check_language language, int size, char renderer[128], lam_error *error)
{
    void *place = gl_painter(NULL).open(user, language, size, renderer, error);
    opened += place != NULL;
    return place;
}

static void close_counted(void *place)
{
    closed++;
    gl_painter(NULL).close(place);
}

static bool wake_unless_asleep(void *place, lam_error *error)
{
    if (!sleeps)
        return gl_painter(NULL).wake(place, error);
    *error = (lam_error){.code = LAM_UNSUPPORTED, .text = "the place does not wake"};
    return false;
}

static bool compile_counted(void *place, const char *vertex, const char *fragment, lam_check_program *program,
                            lam_error *error)
{
    bool ok = gl_painter(NULL).compile(place, vertex, fragment, program, error);
    compiled += ok && program->program;
    return ok;
}

static void forget_counted(void *place, lam_check_program *program)
{
    forgotten += program->program != NULL;
    gl_painter(NULL).forget(place, program);
}

// A check that cannot wake a place, and a cache, free everything that they made.
static void a_place_that_does_not_wake_is_freed(void **state)
{
    (void)state;
    skip_without_gl();
    lam_check_painter painter = gl_painter(NULL);
    painter.open = open_counted;
    painter.close = close_counted;
    painter.wake = wake_unless_asleep;
    painter.compile = compile_counted;
    painter.forget = forget_counted;
    char *vertex = read_text("oregon", "vert"), *fragment = read_text("oregon-no-gate", "frag");
    lam_check_params params = {.vertex = vertex, .fragment = fragment, .painter = &painter};
    lam_check_report report;
    lam_error error = {0};
    params.cache = lam_check_cache_make(0, &error); // keeps places, but no pictures
    assert_non_null(params.cache);
    opened = closed = compiled = forgotten = 0;
    sleeps = false;
    assert_true(lam_check_run(&params, &report, &error));
    lam_check_report_free(&report);
    int kept = opened - closed;
    assert_true(kept > 0 && compiled > forgotten);
    sleeps = true;
    assert_false(lam_check_run(&params, &report, &error));
    assert_string_equal(error.text, "the place does not wake");
    assert_true(opened - closed < kept);
    sleeps = false;
    assert_true(lam_check_run(&params, &report, &error));
    lam_check_report_free(&report);
    assert_true(opened > closed);
    sleeps = true;
    lam_check_cache_free(params.cache);
    assert_int_equal(opened, closed);
    assert_int_equal(compiled, forgotten);
    free(vertex);
    free(fragment);
}

// The objects of two places have the same names, each in its own context.
static void a_place_at_rest_is_closed_beside_another(void **state)
{
    (void)state;
    skip_without_gl();
    enum { SIZE = 32 };
    static const char vertex[] = "#version 330 core\nin vec3 at;\nvoid main() { gl_Position = vec4(at, 1.0); }\n";
    static const char fragment[] = "#version 330 core\nout vec4 color;\nvoid main() { color = vec4(0.25); }\n";
    static const float corners[] = {-1, -1, 0, 3, -1, 0, -1, 3, 0}, others[12] = {0};
    static const uint16_t indices[] = {0, 1, 2};
    lam_check_mesh mesh = {.vertex_count = 3,
                           .index_count = 3,
                           .positions = corners,
                           .normals = others,
                           .tangents = others,
                           .indices = indices};
    lam_check_painter painter = gl_painter(NULL);
    lam_check_program made[2] = {{0}};
    void *places[2];
    char renderer[128];
    float pixels[SIZE * SIZE * 4];
    lam_error error = {0};
    for (int i = 0; i < 2; i++) {
        places[i] = painter.open(painter.user, LAM_CHECK_LANGUAGE_CORE, SIZE, renderer, &error);
        assert_non_null(places[i]);
        assert_true(painter.compile(places[i], vertex, fragment, &made[i], &error));
        assert_non_null(made[i].program);
        if (i == 0)
            painter.rest(places[i]);
    }
    painter.forget(places[0], &made[0]);
    painter.close(places[0]);
    lam_check_drawing drawing = {.program = &made[1], .mesh = &mesh, .position = 0, .normal = -1, .tangent = -1};
    assert_true(painter.draw(places[1], &drawing, pixels, &error));
    for (int i = 0; i < SIZE * SIZE * 4; i++)
        assert_true(pixels[i] == 0.25F);
    painter.forget(places[1], &made[1]);
    painter.close(places[1]);
}

// --- texts

// Drivers may compute with 16 bits unless the precision is highp. A sampler of OpenGL ES is lowp by default.
static void everything_has_full_precision(void **state)
{
    (void)state;
    static const char *const rows[][2] = {
        {"precision mediump float;\nuniform sampler2D a;\nlowp vec4 b;\n",
         "precision highp float; precision highp sampler2D;\nuniform sampler2D a;\nhighp vec4 b;\n"},
        {"mediump vec2 a;\nuniform sampler2D b; precision highp float;",
         "highp vec2 a;\nuniform sampler2D b; precision highp float; precision highp sampler2D;"},
        {"precision highp int; precision highp float;\nuniform sampler2D a;\n",
         "precision highp int; precision highp float; precision highp sampler2D;\nuniform sampler2D a;\n"},
        {"uniform mediump sampler2D a;\n", "uniform highp sampler2D a;\n"}, // no statement to follow
        {"precision lowp float;\n", "precision highp float;\n"},
        {"precision lowp float", "precision highp float"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_true(shader_dialect_lowers_precision(rows[i][0]));
        char *text = shader_dialect_highp(rows[i][0]);
        assert_non_null(text);
        assert_string_equal(text, rows[i][1]);
        free(text);
    }
    assert_false(shader_dialect_lowers_precision("precision highp float;\nvec4 precisions, sampler;\n"));
    assert_false(shader_dialect_lowers_precision("#version 330 core\nuniform sampler2D a;\n"));
}

static void desktop_texts_become_es(void **state)
{
    (void)state;
    lam_error error = {0};
    char *text = shader_dialect_es("#version 120\nattribute vec3 a;\nvarying vec3 n;\nvoid main() { n = gl_Normal; "
                                   "gl_Position = ftransform(); }\n",
                                   true, &error);
    assert_non_null(text);
    assert_string_equal(
        text,
        "#version 300 es\nprecision highp float;\nprecision highp int;\n"
        "in vec4 fixed_Vertex;\nin vec3 fixed_Normal;\nuniform mat4 fixed_ModelViewProjectionMatrix;\n"
        "vec4 fixed_transform() { return fixed_ModelViewProjectionMatrix * fixed_Vertex; }\n"
        "#line 1\n\nin vec3 a;\nout vec3 n;\nvoid main() { n = fixed_Normal; gl_Position = fixed_transform(); }\n");
    free(text);
    text = shader_dialect_es("varying vec3 n; // my_attribute\nvoid main() { gl_FragColor = vec4(n, 1.0); }\n", false,
                             &error);
    assert_non_null(text);
    assert_string_equal(text, "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                              "out vec4 fixed_FragColor;\n#line 1\n"
                              "in vec3 n; // my_attribute\nvoid main() { fixed_FragColor = vec4(n, 1.0); }\n");
    free(text);
    char log[] = "ERROR: 0:3: 'fixed_Normal' : fixed_FragColor";
    shader_dialect_restore(log);
    assert_string_equal(log, "ERROR: 0:3: 'gl_Normal' : gl_FragColor");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(right_programs_pass_as_es),
        cmocka_unit_test(a_mistake_has_its_name_as_es),
        cmocka_unit_test(blocks_of_varyings_are_refused_as_es),
        cmocka_unit_test(bytes_give_the_same_verdicts),
        cmocka_unit_test(a_refused_text_keeps_its_lines_and_names),
        cmocka_unit_test(a_painter_that_does_not_open_says_why),
        cmocka_unit_test(a_place_that_does_not_wake_is_freed),
        cmocka_unit_test(a_place_at_rest_is_closed_beside_another),
        cmocka_unit_test(everything_has_full_precision),
        cmocka_unit_test(desktop_texts_become_es),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
