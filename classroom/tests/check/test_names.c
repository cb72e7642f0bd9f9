// test_names.c: tests which name is suggested for another, and which names a statement of a shader can use.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "name_similarity.h"
#include "diagnostics.h"

// The candidates are separated by blanks. `expected` is "" for none.
static void nearest(const char *name, const char *candidates, const char *expected)
{
    char text[200];
    const char *words[20] = {NULL};
    int count = 0;
    strcpy(text, candidates);
    for (char *word = strtok(text, " "); word; word = strtok(NULL, " "))
        words[count++] = word;
    const char *found = name_nearest(name, words, count);
    if (strcmp(found ? found : "", expected) != 0)
        fail_msg("'%s' among '%s': found '%s', expected '%s'", name, candidates, found ? found : "", expected);
}

static void test_spelling(void **state)
{
    (void)state;
    nearest("shinines", "ambient_product shininess projection", "shininess");
    nearest("Shininess", "shininess", "shininess");
    nearest("light_Position", "lightPosition light_direction", "lightPosition");
    nearest("difuse_product", "ambient_product diffuse_product specular_product", "diffuse_product");
    nearest("modelveiw", "projection modelView", "modelView");
}

static void test_sound(void **state)
{
    (void)state;
    nearest("colour", "normal color", "color");
    nearest("normalise", "length normalize", "normalize");
    nearest("fong", "blinn phong", "phong");
    nearest("ambeint", "diffuse ambient", "ambient");
}

static void test_role(void **state)
{
    (void)state;
    nearest("eye_position", "light_position eye_point ambient", "eye_point");
    nearest("cameraPos", "lightPos eye_position", "eye_position");
    nearest("normal", "vNormal aPosition", "vNormal");
    nearest("lightDir", "eyeDir light_direction", "light_direction");
    nearest("material_specular", "reflect_specular reflect_diffuse", "reflect_specular");
    nearest("NormalMatrix", "modelMatrix normal_mat", "normal_mat");
}

// A wrong suggestion is worse than none.
static void test_none(void **state)
{
    (void)state;
    nearest("light_position", "eye_position", "");
    nearest("ambient_product", "diffuse_product specular_product", "");
    nearest("model_matrix", "normal_matrix", "");
    nearest("light_direction", "light_position", "");
    nearest("viewPos", "view", "");
    nearest("m", "n l v", "");
    nearest("diffuse", "diffuse_product", "");
    nearest("attenuation_linear", "attenuation_quadratic", "");
    nearest("x", "", "");
}

static const char shader[] = "uniform vec3 eye_point;\n"
                             "uniform float a, b;\n"
                             "float square(float x) { float y = x; return x * y; }\n"
                             "struct Light { vec3 place; } light;\n"
                             "float half_of(float z);\n"
                             "void main() {\n"
                             "    vec3 n, m = vec3(0.0);\n"
                             "    for (int i = 0; i < 3; i++) { float inner = a; }\n"
                             "    vec3 l = at_this_place;\n"
                             "    float later = 0.0;\n"
                             "}\n";

static void visible(const char *word, bool functions, const char *expected)
{
    struct declarations d;
    struct visible_names names;
    char found[300] = "";
    assert_true(declarations_read(&d, shader, false, NULL));
    int at = 0;
    while (at < d.word_count && strcmp(d.words[at].text, word) != 0)
        at++;
    assert_true(at < d.word_count);
    visible_names_at(&d, at, functions, &names);
    for (int i = 0; i < names.count; i++) {
        strcat(found, i ? " " : "");
        strcat(found, names.names[i]);
    }
    assert_string_equal(found, expected);
    declarations_free(&d);
}

static void test_visible(void **state)
{
    (void)state;
    visible("at_this_place", false, "eye_point a b light n m i");
    visible("at_this_place", true, "square half_of");
    visible("y", false, "eye_point a b x");
    visible("return", false, "eye_point a b x y");
    visible("later", false, "eye_point a b light n m i l");
    visible("place", false, "eye_point a b");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_spelling), cmocka_unit_test(test_sound),   cmocka_unit_test(test_role),
        cmocka_unit_test(test_none),     cmocka_unit_test(test_visible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
