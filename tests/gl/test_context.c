// test_context.c: OpenGL at run time: contexts of each profile, restoring the caller's context, and the errors for a
// missing library, function or device.
#include "context.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// Skips the test if this machine has no OpenGL.
static void make_or_skip(struct gl_context *context, enum gl_profile profile, bool debug)
{
    lam_error error = {0};
    if (gl_context_make(context, NULL, NULL, profile, debug, &error))
        return;
    print_message("%s\n", error.text);
    skip();
}

static void test_profiles(void **state)
{
    (void)state;
    for (int profile = 0; profile < GL_PROFILE_COUNT; profile++) {
        struct gl_context context;
        make_or_skip(&context, (enum gl_profile)profile, false);
        print_message("%s: %s\n", context.renderer, context.driver);
        assert_int_equal(context.es, profile == GL_PROFILE_ES);
        assert_true(context.major >= 3 || profile == GL_PROFILE_COMPATIBILITY);
        assert_true(context.egl.GetCurrentContext() == EGL_NO_CONTEXT);
        struct gl_previous_context previous;
        lam_error error = {0};
        assert_true(gl_context_enter(&context, &previous, &error));
        assert_true(context.egl.GetCurrentContext() == context.context);
        // Only a compatibility profile has matrix stacks.
        while (context.gl.GetError() != GL_NO_ERROR)
            ;
        if (profile != GL_PROFILE_ES) {
            context.gl.MatrixMode(GL_MODELVIEW);
            assert_int_equal(context.gl.GetError() == GL_NO_ERROR, profile == GL_PROFILE_COMPATIBILITY);
        }
        gl_context_leave(&context, &previous);
        assert_true(context.egl.GetCurrentContext() == EGL_NO_CONTEXT);
        gl_context_free(&context);
    }
}

// A current context stays current while another is made, used and freed.
static void test_nested(void **state)
{
    (void)state;
    struct gl_context outer, inner;
    struct gl_previous_context before, between;
    lam_error error = {0};
    make_or_skip(&outer, GL_PROFILE_ES, false);
    assert_true(gl_context_enter(&outer, &before, &error));
    assert_true(gl_context_make(&inner, NULL, NULL, GL_PROFILE_CORE, false, &error));
    assert_true(outer.egl.GetCurrentContext() == outer.context);
    assert_int_equal(outer.egl.QueryAPI(), EGL_OPENGL_ES_API);
    assert_true(gl_context_enter(&inner, &between, &error));
    gl_context_leave(&inner, &between);
    gl_context_free(&inner);
    assert_true(outer.egl.GetCurrentContext() == outer.context);
    assert_string_equal((const char *)outer.gl.GetString(GL_RENDERER), outer.renderer);
    gl_context_leave(&outer, &before);
    gl_context_free(&outer);
}

static void test_debug_messages(void **state)
{
    (void)state;
    struct gl_context context;
    struct gl_previous_context previous;
    lam_error error = {0};
    make_or_skip(&context, GL_PROFILE_CORE, true);
    assert_true(gl_context_enter(&context, &previous, &error));
    assert_true(gl_messages_clean(&context, "nothing", &error));
    context.gl.Enable(0x1234);
    assert_int_equal(context.messages.errors, 1);
    assert_false(gl_messages_clean(&context, "the test", &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    assert_non_null(strstr(error.text, "the test: the driver reports 1 errors"));
    gl_context_leave(&context, &previous);
    gl_context_free(&context);
}

static void test_missing(void **state)
{
    (void)state;
    struct gl_context context;
    lam_error error = {0};
    assert_false(gl_context_make(&context, "libNoSuchEGL.so.1", NULL, GL_PROFILE_CORE, false, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    assert_non_null(strstr(error.text, "libNoSuchEGL.so.1"));
    assert_non_null(strstr(error.text, "apt install libegl1"));
    // A library other than EGL.
    assert_false(gl_context_make(&context, "libc.so.6", NULL, GL_PROFILE_CORE, false, &error));
    assert_non_null(strstr(error.text, "lacks the function eglBindAPI"));
    lam_gl_params params = {.library = "libNoSuchEGL.so.1"};
    lam_gl_device device;
    assert_int_equal(lam_gl_devices(&params, &device, 1, &error), -1);
    assert_non_null(strstr(error.text, "libNoSuchEGL.so.1"));
}

static void test_devices(void **state)
{
    (void)state;
    lam_gl_device list[64];
    lam_error error = {0};
    int count = lam_gl_devices(NULL, list, 64, &error);
    if (count < 0) {
        print_message("%s\n", error.text);
        skip();
    }
    assert_true(count > 0);
    bool software = false;
    int usable = 0;
    for (int i = 0; i < count; i++) {
        assert_int_equal(list[i].number, i);
        assert_true(list[i].usable ? list[i].name[0] && list[i].versions[0] && !list[i].reason[0]
                                   : list[i].reason[0] != 0);
        usable += list[i].usable;
        assert_true(list[i].software || !software || !list[i].usable); // hardware comes first
        software |= list[i].software;
    }
    struct gl_context context;
    assert_false(gl_context_make(&context, NULL, "99", GL_PROFILE_CORE, false, &error));
    assert_non_null(strstr(error.text, "there is no device 99, expected 0 to"));
    assert_false(gl_context_make(&context, NULL, "voodoo", GL_PROFILE_CORE, false, &error));
    assert_true(!usable || strstr(error.text, "no usable device has 'voodoo' in its name"));
    for (int i = 0; i < count; i++)
        if (strstr(list[i].versions, "OpenGL 3.3")) {
            char number[8];
            snprintf(number, sizeof number, "%d", i);
            assert_true(gl_context_make(&context, NULL, number, GL_PROFILE_CORE, false, &error));
            assert_string_equal(context.renderer, list[i].name);
            gl_context_free(&context);
        }
}

static lam_gl_function nothing(void *user, const char *name)
{
    (void)user, (void)name;
    return NULL;
}

static void test_caller_without(void **state)
{
    (void)state;
    struct gl_context context;
    lam_error error = {0};
    assert_false(gl_context_adopt(&context, nothing, NULL, false, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    assert_non_null(strstr(error.text, "lacks the function glActiveTexture"));
    gl_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_profiles), cmocka_unit_test(test_nested),  cmocka_unit_test(test_debug_messages),
        cmocka_unit_test(test_missing),  cmocka_unit_test(test_devices), cmocka_unit_test(test_caller_without),
    };
    return cmocka_run_group_tests_name("gl-context", tests, NULL, NULL);
}
