// test_glsl_driver.c: a driver compiles and links the shaders, and the sizes of their blocks equal the sizes of
// glsl_pack_….
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "context.h"
#include "glsl_combinations.h"
#include "glsl_declarations.h"

// All choices take minutes (LAMBENT_EVERY_SHADER=1), so the test uses every STEP-th; glslangValidator compiles more of
// them (test_glsl.c). The step is a prime, so that it covers every loop of glsl_combinations. One build uses a smaller
// step.
#ifdef EVERY_TEXT
enum { STEP = 37 };
#else
enum { STEP = 149 };
#endif

struct driver {
    struct gl_context context;
    enum glsl_version version;
    int step, count, linked;
};

static GLuint compile(const struct gl *gl, GLenum kind, const char *text)
{
    GLuint shader = gl->CreateShader(kind);
    GLint ok = 0;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[1024] = "";
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
        print_error("%s\n%s\n", text, log);
        fail_msg("the driver does not compile a %s shader", kind == GL_VERTEX_SHADER ? "vertex" : "fragment");
    }
    return shader;
}

// The driver's block has the size that glsl_pack_… writes.
static void check_block(const struct gl *gl, GLuint program, const char *block, size_t bytes)
{
    GLuint index = gl->GetUniformBlockIndex(program, block);
    GLint size = 0;
    if (index == GL_INVALID_INDEX) // the program does not read the block
        return;
    gl->GetActiveUniformBlockiv(program, index, GL_UNIFORM_BLOCK_DATA_SIZE, &size);
    if ((size_t)size != bytes)
        fail_msg("block %s: the driver expects %d bytes, lambent writes %zu", block, size, bytes);
}

static void check_blocks(const struct gl *gl, GLuint program, const struct glsl_choices *c, const struct glsl_stage *f)
{
    if (c->storage != GLSL_BLOCK || f->unlit || f->output_vector || !f->lit)
        return;
    check_block(gl, program, "Lights", glsl_lights_bytes(c));
    check_block(gl, program, "Products", glsl_products_bytes(c));
    check_block(gl, program, "BackProducts", glsl_products_bytes(c));
    check_block(gl, program, "Materials",
                (size_t)glsl_material_layout(false, c->field_layers).size * sizeof(float) * (f->back_material ? 2 : 1));
}

static void link_pair(void *user, const struct glsl_choices *choices)
{
    struct driver *driver = user;
    if (choices->version != driver->version || driver->count++ % driver->step)
        return;
    const struct gl *gl = &driver->context.gl;
    struct glsl_text text;
    lam_error error = {0};
    if (!glsl_make(choices, &text, &error))
        fail_msg("%s", error.text);
    GLuint program = gl->CreateProgram(), vertex = compile(gl, GL_VERTEX_SHADER, text.vertex),
           fragment = compile(gl, GL_FRAGMENT_SHADER, text.fragment);
    GLint ok = 0;
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok) {
        char log[1024] = "";
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
        print_error("%s\n%s\n%s\n", text.vertex, text.fragment, log);
        fail_msg("the driver does not link a pair");
    }
    struct glsl_stage facts = glsl_stage_of(choices);
    check_blocks(gl, program, choices, &facts);
    if (gl->GetUniformLocation(program, "model_view_projection") < 0)
        fail_msg("the program has no uniform model_view_projection");
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    gl->DeleteProgram(program);
    glsl_free(&text);
    driver->linked++;
}

static void test_version(enum glsl_version version, enum gl_profile profile)
{
    struct driver *driver = calloc(1, sizeof *driver);
    struct gl_previous_context previous;
    lam_error error = {0};
    assert_non_null(driver);
    driver->version = version;
    driver->step = getenv("LAMBENT_EVERY_SHADER") ? 1 : STEP;
    if (!gl_context_make(&driver->context, NULL, NULL, profile, false, &error)) {
        print_message("%s\n", error.text);
        free(driver);
        skip();
    }
    assert_true(gl_context_enter(&driver->context, &previous, &error));
    glsl_combinations(link_pair, driver);
    print_message("%d pairs linked by %s\n", driver->linked, driver->context.renderer);
    assert_true(driver->linked > 5);
    gl_context_leave(&driver->context, &previous);
    gl_context_free(&driver->context);
    free(driver);
}

static void test_120(void **state)
{
    (void)state;
    test_version(GLSL_120, GL_PROFILE_COMPATIBILITY);
}

static void test_330(void **state)
{
    (void)state;
    test_version(GLSL_330, GL_PROFILE_CORE);
}

static void test_300_es(void **state)
{
    (void)state;
    test_version(GLSL_300_ES, GL_PROFILE_ES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_120),
        cmocka_unit_test(test_330),
        cmocka_unit_test(test_300_es),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
