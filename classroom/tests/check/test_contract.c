// test_contract.c: contract files: built-in contracts, every error with its position, and failed allocations.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "prefix.h"

#include <lambent/light.h>

#define GOOD                                                                                                           \
    "{\"contract\": 1, \"name\": \"mine\", \"space\": \"world\", \"attributes\": {\"pos\": {\"role\": \"position\", "  \
    "\"type\": \"vec3\"}}, \"uniforms\": {"
#define LIGHT "\"lamp.place\": {\"role\": \"light_position\", \"type\": \"vec3\", \"also\": [\"lampPlace\"]}"
#define END   "}}"

static lam_check_contract *read_text(const char *text, lam_error *error)
{
    return lam_check_contract_read(text, strlen(text), "my.json", error);
}

static void test_shipped(void **state)
{
    (void)state;
    lam_error error = {0};
    int count = 0;
    lam_check_name row;
    for (; lam_check_contract_shipped(count); count++) {
        const char *name = lam_check_contract_shipped(count), *text = lam_check_contract_text(name);
        lam_check_contract *contract = lam_check_contract_read(text, strlen(text), name, &error);
        if (!contract)
            fail_msg("%s", error.text);
        assert_string_equal(lam_check_contract_name(contract), name);
        assert_true(lam_check_contract_title(contract)[0]);
        for (int i = 0; lam_check_contract_row(contract, i, &row); i++)
            assert_true(row.name[0] && row.type[0] && row.role[0] && row.meaning[0]);
        lam_check_contract_free(contract);
    }
    assert_true(count >= 4);
    assert_null(lam_check_contract_text("nobody's"));
    assert_null(lam_check_contract_text(NULL));
}

static void test_read(void **state)
{
    (void)state;
    lam_error error = {0};
    lam_check_contract *mine =
        read_text(GOOD LIGHT
                  ", \"lamp.tint\": {\"role\": \"light_color\", \"type\": \"vec3\"}, \"eye\": {\"role\": "
                  "\"eye_position\", \"type\": \"vec3\", \"space\": \"eye\"}}, \"terms\": [\"diffuse\"], \"varyings\": "
                  "{\"object_position\": [\"p\", \"q\"]}, \"undeclared\": {\"light_specular\": \"light\", "
                  "\"shininess\": 9, \"attenuation\": [1, 0, 2], \"ambient_color\": [0, 0.5, 1]}}",
                  &error);
    if (!mine)
        fail_msg("%s", error.text);
    const struct contract *c = &mine->contract;
    assert_int_equal(c->space, LAM_FRAME_WORLD);
    assert_int_equal(c->light_frame, LAM_FRAME_WORLD);
    assert_int_equal(c->terms, TERM_DIFFUSE);
    assert_int_equal(c->group_count, 1);
    assert_string_equal(c->groups[0], "lamp");
    assert_int_equal(c->supports, NEED_POINT | NEED_ATTENUATION);
    assert_int_equal(contract_find(c, "lampPlace", false, NULL)->semantic, SEMANTIC_LIGHT_POSITION);
    assert_int_equal(contract_find(c, "eye", false, NULL)->space, LAM_FRAME_CAMERA);
    assert_null(contract_find(c, "pos", false, NULL));
    assert_int_equal(contract_varying(c, "q")->space, LAM_FRAME_OBJECT);
    assert_true(c->defaults.shininess.given && c->defaults.shininess.value == 9);
    assert_int_equal(c->defaults.light_specular.source, COLOR_OF_LIGHT);
    assert_int_equal(c->defaults.ambient_color.source, COLOR_GIVEN);
    assert_int_equal(c->defaults.light_color.source, COLOR_OF_SCENE);
    lam_check_contract_free(mine);
}

// An engine's prefix completes texts that declare none of its names, and line numbers refer to the texts.
static void test_prefix(void **state)
{
    (void)state;
    lam_error error = {0};
    lam_check_contract *mine = read_text(
        GOOD LIGHT "}, \"prefix\": {\"vertex\": [\"#version 300 es\", \"in vec3 pos;\"], \"fragment\": [\"#version 300 "
                   "es\", \"out vec4 o;\"]}}",
        &error);
    if (!mine)
        fail_msg("%s", error.text);
    static const struct {
        const char *vertex, *fragment;
        bool completed;
    } cases[] = {{"void main() {}", "uniform float a;", true},
                 {NULL, "uniform float a;", true},
                 {"#version 120\nvoid main() {}", "uniform float a;", false},
                 {"attribute vec3 pos;\nvoid main() {}", "uniform float a;", false},
                 {"void main() {}", "out vec4 o;", false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct program_texts program = {.own = {.vertex = cases[i].vertex, .fragment = cases[i].fragment},
                                        .read = prefix_read};
        assert_true(prefix_read(NULL, &program.own, &error));
        const struct complete_texts *texts = prefix_texts(&program, &mine->contract, &error);
        assert_non_null(texts);
        assert_int_equal(texts->fragment != cases[i].fragment, cases[i].completed);
        assert_int_equal(texts->sides[1].version, cases[i].completed ? 300 : 0);
        const struct declaration *a = declarations_find(&texts->sides[1], DECLARED_UNIFORM, "a");
        assert_int_equal(a ? a->line : 1, 1);
        prefix_free(&program.own);
        prefix_free(&program.completed);
    }
    lam_check_contract_free(mine);
}

static void bad(const char *text, const char *expected)
{
    lam_error error = {0};
    lam_check_contract *contract = read_text(text, &error);
    if (contract)
        fail_msg("read: %s", text);
    assert_int_equal(error.code, LAM_CANNOT_READ);
    if (strncmp(error.text, expected, strlen(expected)) != 0)
        fail_msg("found    %s\nexpected %s", error.text, expected);
}

static void test_errors(void **state)
{
    (void)state;
    bad("{", "my.json:1: ");
    bad("[]", "my.json: found a list of 0, expected an object");
    bad("{\"name\": \"x\"}", "my.json: the key 'contract' is missing");
    bad("{\"contract\": 2, \"name\": \"x\"}", "my.json:1: contract: found 2, expected 1");
    bad("{\"contract\": 1}", "my.json: the key 'name' is missing");
    bad("{\"contract\": 1, \"nam\": \"x\"}", "my.json:1: nam: unknown key; did you mean 'name'?");
    bad("{\"contract\": 1, \"name\": \"x\", \"space\": \"clip\"}",
        "my.json:1: space: found \"clip\", expected eye, world or object");
    bad(GOOD LIGHT "}, \"maps\": {\"colors\": \"gama\"}}",
        "my.json:1: maps.colors: found \"gama\", expected linear or gamma; did you mean 'gamma'?");
    bad(GOOD LIGHT "}, \"maps\": {\"v\": \"left\"}}", "my.json:1: maps.v: found \"left\", expected up or down");
    bad(GOOD LIGHT ", \"bumps\": {\"role\": \"normal_map\", \"type\": \"vec3\"}}}",
        "my.json:1: uniforms.bumps.type: found \"vec3\", expected a type that fits the role normal_map: sampler2D");
    bad(GOOD LIGHT "}, \"physical\": {\"masking\": \"smth\"}}",
        "my.json:1: physical.masking: found \"smth\", expected smith or schlick; did you mean 'smith'?");
    bad(GOOD LIGHT "}, \"highlight\": \"metallic-roughness\"}",
        "my.json:1: uniforms: found no name with the role metallic or roughness; the highlight metallic-roughness "
        "needs one of these roles");
    bad("{\"contract\": 1, \"name\": \"x\", \"highlight\": \"fong\"}",
        "my.json:1: highlight: found \"fong\", expected phong, blinn-phong, metallic-roughness, toon or gooch; did you "
        "mean "
        "'phong'?");
    bad("{\"contract\": 1, \"name\": \"x\", \"terms\": []}", "my.json:1: terms: found a list of 0, expected a list of");
    bad("{\"contract\": 1, \"name\": \"x\", \"terms\": [\"shiny\"]}", "my.json:1: terms[0]: found \"shiny\", expected");
    bad(GOOD END, "my.json:1: uniforms: found no light: expected a name with the role light_position");
    bad("{\"contract\": 1, \"name\": \"x\", \"uniforms\": {" LIGHT END,
        "my.json:1: attributes: found no name with the role position");
    bad(GOOD "\"a\": {\"role\": \"light_positon\", \"type\": \"vec3\"}" END,
        "my.json:1: uniforms.a.role: found \"light_positon\", expected a role of uniforms; did you mean "
        "'light_position'?");
    bad(GOOD "\"a\": {\"type\": \"vec3\"}" END, "my.json:1: uniforms.a: the key 'role' is missing");
    bad(GOOD "\"a\": {\"role\": \"shininess\"}" END,
        "my.json:1: uniforms.a: the key 'type' is missing, expected float, int, bool");
    bad(GOOD "\"a\": {\"role\": \"model\", \"type\": \"vec3\"}" END,
        "my.json:1: uniforms.a.type: found \"vec3\", expected a type that fits the role model: mat3, mat4");
    bad(GOOD "\"a b\": {\"role\": \"model\", \"type\": \"mat4\"}" END,
        "my.json:1: uniforms.a b: found \"a b\", expected a name of GLSL");
    bad(GOOD "\"a.\": {\"role\": \"model\", \"type\": \"mat4\"}" END,
        "my.json:1: uniforms.a.: found \"a.\", expected a name of GLSL");
    bad(GOOD "\"a\": {\"role\": \"model\", \"type\": \"mat4\", \"space\": \"eye\"}" END,
        "my.json:1: uniforms.a.space: the role model has no space");
    bad(GOOD LIGHT ", \"lampPlace\": {\"role\": \"light_position\", \"type\": \"vec3\"}" END,
        "my.json:1: uniforms.lampPlace: this name already has a role");
    bad(GOOD LIGHT ", \"a\": {\"role\": \"model\", \"type\": \"mat4\", \"also\": [\"b\", \"lamp.place\"]}" END,
        "my.json:1: uniforms.a.also[1]: 'lamp.place' has a role already");
    bad(GOOD LIGHT ", \"a\": {\"role\": \"normal\", \"type\": \"vec3\"}" END,
        "my.json:1: uniforms.a.role: found \"normal\", expected a role of uniforms");
    bad(GOOD LIGHT "}, \"varyings\": {\"normals\": []}}",
        "my.json:1: varyings.normals: unknown key; expected normal, position");
    bad(GOOD LIGHT "}, \"varyings\": {\"normal\": [1]}}", "my.json:1: varyings.normal[0]: found 1, expected a string");
    bad(GOOD LIGHT "}, \"undeclared\": {\"shininess\": -1}}",
        "my.json:1: undeclared.shininess: found -1, expected a number");
    bad(GOOD LIGHT "}, \"undeclared\": {\"light_color\": \"light\"}}",
        "my.json:1: undeclared.light_color: found \"light\", expected a list of 3 numbers");
    bad(GOOD LIGHT "}, \"undeclared\": {\"light_ambient\": \"sun\"}}",
        "my.json:1: undeclared.light_ambient: found \"sun\", expected \"light\" or a list of 3 numbers");
    bad(GOOD LIGHT "}, \"undeclared\": {\"attenuation\": [0, 0, 0]}}",
        "my.json:1: undeclared.attenuation: found 0, 0, 0");
    bad(GOOD LIGHT "}, \"undeclared\": {\"light_direction\": [0, 0, 0]}}",
        "my.json:1: undeclared.light_direction: found 0, 0, 0");
    bad(GOOD LIGHT "}, \"constants\": {\"k\": \"model\"}}",
        "my.json:1: constants.k: found \"model\", expected ambient_strength, diffuse_strength, specular_strength");
    bad(GOOD LIGHT "}, \"constants\": {\"a b\": \"shininess\"}}",
        "my.json:1: constants.a b: found \"a b\", expected a name");
    bad(GOOD LIGHT "}, \"prefix\": {\"vertex\": []}}", "my.json:1: prefix: the key 'fragment' is missing");
    bad(GOOD LIGHT "}, \"prefix\": {\"vertex\": [], \"fragment\": [1]}}",
        "my.json:1: prefix.fragment[0]: found 1, expected");
    bad(GOOD LIGHT "}, \"outputs\": [\"a.b\"]}", "my.json:1: outputs[0]: found \"a.b\", expected a name of GLSL");
    bad(GOOD LIGHT "}, \"varyings\": {\"object_to_eye\": [\"e\"]}}", "my.json:1: varyings.object_to_eye: unknown key");
    bad(GOOD LIGHT "}, \"built_ins\": \"gl_Vertex\"}",
        "my.json:1: built_ins: found \"gl_Vertex\", expected a list of strings");
}

// Every truncated file is refused, and every failed allocation is reported without a leak.
static void test_damage(void **state)
{
    (void)state;
    const char *text = lam_check_contract_text("nyu");
    size_t size = strlen(text);
    lam_error error;
    for (size_t cut = 0; cut + 2 < size; cut += 7)
        assert_null(lam_check_contract_read(text, cut, "cut", &error));
    bool failed = true;
    for (long countdown = 0; failed; countdown++) {
        error = (lam_error){0};
        arena_fail_after(countdown);
        lam_check_contract *contract = lam_check_contract_read(text, size, "nyu", &error);
        arena_fail_after(-1);
        failed = contract == NULL;
        if (failed)
            assert_int_equal(error.code, LAM_MACHINE);
        lam_check_contract_free(contract);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_shipped), cmocka_unit_test(test_read),
                                       cmocka_unit_test(test_prefix), cmocka_unit_test(test_errors),
                                       cmocka_unit_test(test_damage)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
