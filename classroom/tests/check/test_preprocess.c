// test_preprocess.c: tests the words that the preprocessor returns for a shader, and its declarations.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "declarations.h"

// The words of a text, separated by blanks.
static void leaves(const char *text, const char *expected)
{
    struct declarations d = {0};
    char found[1000] = "";
    assert_true(preprocess(&d, text));
    for (int i = 0; i < d.word_count && strlen(found) < 900; i++)
        snprintf(found + strlen(found), sizeof found - strlen(found), "%s%s", i ? " " : "", d.words[i].text);
    if (strcmp(found, expected) != 0)
        fail_msg("%s\n  found    %s\n  expected %s", text, found, expected);
    declarations_free(&d);
}

static void test_words(void **state)
{
    (void)state;
    leaves("", "");
    leaves("a+=1.5e-3*b.xy;// c\n/* d\n */e", "a + = 1.5e-3 * b . xy ; e");
    leaves("a // b \\\n c\nd", "a d");
    leaves("\xef\xbb\xbf#version 120\r\na\\\r\nb", "a b");
    leaves("a /* never closed", "a");
}

static void test_macros(void **state)
{
    (void)state;
    leaves("#define N 3\nx[N] N", "x [ 3 ] N"); // a number's name is more informative, except for the size of an array
    leaves("#define F(a, b) a + b\nF(1, (2, 3)) F", "1 + ( 2 , 3 ) F");
    leaves("#define F (a)\nF(1)", "( a ) ( 1 )");
    leaves("#define A B\n#define B A c\nA B", "A c B c");
    leaves("#define TWICE(x) x \\\n x\nTWICE(TWICE(y))", "y y y y");
    leaves("#define A b\n#undef A\nA", "A");
    leaves("#define EMPTY\nEMPTY a EMPTY", "a");
    leaves("#define F(x) x\nF(\n a\n)", "a");
    leaves("#define F(x) x\nF(a", "F ( a");
    leaves("#define\n#define 3 4\n#undef\na", "a");
}

static void test_branches(void **state)
{
    (void)state;
    leaves("#if 0\na\n#elif 1\nb\n#else\nc\n#endif\nd", "b d");
    leaves("#ifdef GL_ES\nprecision\n#else\ndesktop\n#endif", "desktop");
    leaves("#version 100\n#ifdef GL_ES\nprecision\n#endif", "precision");
    leaves("#version 300 es\n#if defined(GL_ES) && __VERSION__ >= 300\na\n#endif", "a");
    leaves("#define A 2\n#if A * 3 - 1 == 5 && !defined B || 0\na\n#endif", "a");
    leaves("#if (1 + 2) * 3 != 9\na\n#else\nb\n#endif", "b");
    leaves("#if 0\n#if 1\na\n#endif\n#define C c\n#else\nb\n#endif\nC", "b C");
    leaves("#if 1 / 0\na\n#endif\n#else\n#endif\n#endif\nb", "b");
    leaves("#ifndef B\na\n#if 1\nb", "a b");
}

static void test_lines(void **state)
{
    (void)state;
    struct declarations d = {0};
    assert_true(preprocess(&d, "#version 330 core\n#define X a \\\n b\n\nX { c }\n"));
    assert_int_equal(d.version, 330);
    assert_string_equal(d.profile, "core");
    assert_int_equal(d.word_count, 5);
    for (int i = 0; i < 5; i++)
        assert_int_equal(d.words[i].line, 5);
    assert_int_equal(d.words[3].depth, 1);
    declarations_free(&d);
}

// A text of 1 kB whose macros expand to 10^30 words, or endlessly to nothing: both end.
static void test_bombs(void **state)
{
    (void)state;
    static const char *const seeds[] = {"x", ""};
    for (int s = 0; s < 2; s++) {
        char text[4000];
        int at = snprintf(text, sizeof text, "#define A0 %s\n", seeds[s]);
        for (int i = 1; i <= 30; i++)
            at += snprintf(text + at, sizeof text - (size_t)at, "#define A%d A%d A%d A%d A%d A%d A%d A%d A%d A%d A%d\n",
                           i, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1);
        snprintf(text + at, sizeof text - (size_t)at, "A30");
        struct declarations d = {0};
        assert_true(preprocess(&d, text));
        assert_true(d.cut && d.word_count <= MAX_WORDS);
        declarations_free(&d);
    }
}

static void declares(const char *text, const char *name, const char *type, int count)
{
    struct declarations d;
    lam_error error = {0};
    assert_true(declarations_read(&d, text, false, &error));
    const struct declaration *found = declarations_find(&d, DECLARED_UNIFORM, name);
    if (!found || strcmp(found->type, type) != 0 || found->count != count)
        fail_msg("%s\n  '%s': found %s[%d], expected %s[%d]", text, name, found ? found->type : "nothing",
                 found ? found->count : 0, type, count);
    declarations_free(&d);
}

static void test_declarations(void **state)
{
    (void)state;
    declares("#define DIF diffuse_product\nuniform vec4 A, DIF;", "diffuse_product", "vec4", 0);
    declares("#define N 4\nstruct L { vec3 p; }; uniform L l[N];", "l[].p", "vec3", 4);
    declares("const int N = 5; uniform vec3 l[N];", "l", "vec3", 5);
    declares("uniform vec3 l[2 + 1];", "l", "vec3", -1);
    declares("uniform struct { vec4 a; float b; } m; uniform struct { vec3 c; } o;", "o.c", "vec3", 0);
    declares("uniform struct { vec4 a; float b; } m;", "m.b", "float", 0);
    declares("#define U(t, n) uniform t n;\nU(vec4, a)\nU(mat3, b)", "b", "mat3", 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_words), cmocka_unit_test(test_macros), cmocka_unit_test(test_branches),
        cmocka_unit_test(test_lines), cmocka_unit_test(test_bombs),  cmocka_unit_test(test_declarations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
