// test_names.c: tests which name is suggested for another.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "contract.h"

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
    nearest("colour", "normal color", "color");
    nearest("normalise", "length normalize", "normalize");
    nearest("eye_position", "light_position eye_point ambient", "eye_point");
}

// A wrong suggestion is worse than none.
static void test_none(void **state)
{
    (void)state;
    nearest("light_position", "eye_position", "");
    nearest("ambient_product", "diffuse_product specular_product", "");
    nearest("viewPos", "view", "");
    nearest("m", "n l v", "");
    nearest("x", "", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_spelling), cmocka_unit_test(test_none)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
