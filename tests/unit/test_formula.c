// test_formula.c: surfaces given as text: functions compared with libm, derivatives compared with differences, meshes,
// errors; and model files of saved meshes.

#include "test.h"
#include "elementary.h"
#include "formula.h"

#include <lambent/scene.h>

static uint64_t state = 1;
static double random_between(double a, double b)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return a + (b - a) * (double)(state >> 11) * 0x1p-53;
}

static void check_near(const char *what, double x, double found, double expected, double most)
{
    if (fabs(found - expected) > most * fabs(expected))
        fail_msg("%s(%.17g) is %.17g, expected %.17g", what, x, found, expected);
}

TEST(functions_match_libm)
{
    for (int i = 0; i < 200000; i++) {
        double x = random_between(-40, 40), y = random_between(-700, 700), p = exp(random_between(-600, 600));
        double unit = random_between(-1, 1), b = random_between(-60, 60), a = exp(random_between(-10, 10));
        check_near("exp", y, math_exp(y), exp(y), 1e-15);
        check_near("log", p, math_log(p), log(p), 1e-15);
        check_near("log", 1 + unit / 8, math_log(1 + unit / 8), log(1 + unit / 8), 1e-15);
        check_near("pow", b, math_pow(a, b), pow(a, b), 1e-14);
        check_near("sinh", x, math_sinh(x), sinh(x), 2e-15);
        check_near("sinh", unit, math_sinh(unit), sinh(unit), 2e-15);
        check_near("cosh", x, math_cosh(x), cosh(x), 2e-15);
        check_near("tanh", unit, math_tanh(unit), tanh(unit), 2e-15);
        check_near("tanh", x, math_tanh(x), tanh(x), 2e-15);
        check_near("asin", unit, math_asin(unit), asin(unit), 1e-15);
        check_near("atan", x, math_atan(x), atan(x), 1e-15);
        assert_true(math_floor(x) == floor(x));
    }
    assert_true(math_pow(-2, 3) == -8 && math_pow(-2, 2) == 4 && isnan(math_pow(-2, 0.5)) && math_pow(0, 0) == 1);
    assert_true(math_pow(0, -1) == INFINITY && math_pow(2, 10) == 1024 && math_pow(2, -1074) == 0x1p-1074);
    assert_true(math_exp(-800) == 0 && math_exp(800) == INFINITY && math_log(0) == -INFINITY && isnan(math_log(-1)));
    assert_true(isnan(math_exp(NAN)) && isnan(math_pow(NAN, 2)) && isnan(math_tanh(NAN)) && isnan(math_asin(1.5)));
}

// The value of an expression.
static double value_of(const char *expression, double u, double v)
{
    char text[400];
    struct arena arena;
    struct formula formula;
    lam_surface_point point;
    lam_error error = {0};
    arena_start(&arena, NULL);
    snprintf(text, sizeof text, "x=%s; y=0; z=0", expression);
    if (!formula_parse(text, false, &arena, &formula, &error) || !formula_finish(&formula, &arena, &error))
        fail_msg("%s: %s", expression, error.text);
    formula_evaluate(&formula, u, v, &point);
    arena_free(&arena);
    return point.p.x;
}

TEST(precedence_is_the_usual_one)
{
    static const struct {
        const char *text;
        double value;
    } rows[] = {
        {"2+3*4", 14},     {"2^3^2", 512},      {"-2^2", -4},           {"2^-1", 0.5},         {"2*-3", -6},
        {"8/4/2", 1},      {"7-2-1", 4},        {"2(1+2)", 6},          {"2u^2", 18},          {"(1+2)*3", 9},
        {"2**3", 8},       {"min(3,1,2)", 1},   {"max(3,1,2)", 3},      {"mod(-1,3)", 2},      {"--3", 3},
        {"1e3", 1000},     {".5+.25", 0.75},    {"abs(-u)+sign(v)", 2}, {"cbrt(-8)", -2},      {"sqrt(16)", 4},
        {"hypot(3,4)", 5}, {"floor(-1.5)", -2}, {"2\xc2\xb7u", 6},      {"\xe2\x88\x92u", -3}, {"+u", 3},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        check_near(rows[i].text, 0, value_of(rows[i].text, 3, -1), rows[i].value, 1e-14);
    check_near("2pi", 0, value_of("2pi", 0, 0), 6.28318530717958648, 1e-16);
    check_near("pi", 0, value_of("\xcf\x80", 0, 0), 3.14159265358979324, 1e-16);
}

TEST(derivatives_match_differences)
{
    static const char *const rows[] = {
        "u^2*v^3",      "sin(u)*cos(v)",   "tan(u*v/4)",  "exp(u-v)",      "log(u+v^2)",        "u^v",
        "2^u",          "u^2.5",           "sqrt(u*u+v)", "asin(u/3)*v",   "acos(v/3)",         "atan(u*v)",
        "atan2(u,v)",   "sinh(u)/cosh(v)", "tanh(u*v)",   "abs(u-2v)",     "min(u,v^2)",        "max(u*v,1)",
        "mod(u+v,0.7)", "hypot(u,v)",      "cbrt(u+v)",   "(u+v)/(1+u*v)", "pow(u,3)-pow(v,u)", "1/u/v",
        "u^-2",         "sign(u)*v",       "-u*-v",       "exp(-u^2-v^2)", "sqrt(max(0,u-9))",  "floor(u)+u",
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct arena arena;
        struct formula formula;
        lam_error error = {0};
        char text[200];
        arena_start(&arena, NULL);
        snprintf(text, sizeof text, "x=%s; y=u; z=v", rows[i]);
        assert_true(formula_parse(text, false, &arena, &formula, &error) && formula_finish(&formula, &arena, &error));
        for (int k = 0; k < 50; k++) {
            double u = random_between(0.3, 1.9), v = random_between(0.35, 1.9), h = 1e-5;
            lam_surface_point at, a, b, c, d;
            formula_evaluate(&formula, u, v, &at);
            formula_evaluate(&formula, u - h, v, &a);
            formula_evaluate(&formula, u + h, v, &b);
            formula_evaluate(&formula, u, v - h, &c);
            formula_evaluate(&formula, u, v + h, &d);
            double du = (b.p.x - a.p.x) / (2 * h), dv = (d.p.x - c.p.x) / (2 * h);
            bool steps = fabs(b.p.x - 2 * at.p.x + a.p.x) > 1e-7 ||
                         fabs(d.p.x - 2 * at.p.x + c.p.x) > 1e-7; // a crease or a jump
            if (!steps &&
                (fabs(at.dp_du.x - du) > 1e-6 * (1 + fabs(du)) || fabs(at.dp_dv.x - dv) > 1e-6 * (1 + fabs(dv))))
                fail_msg("%s at %g, %g: %.12g and %.12g, expected %.12g and %.12g", rows[i], u, v, at.dp_du.x,
                         at.dp_dv.x, du, dv);
            assert_true(at.dp_du.y == 1 && at.dp_dv.y == 0 && at.dp_du.z == 0 && at.dp_dv.z == 1);
        }
        arena_free(&arena);
    }
}

static lam_scene *scene_of(const lam_formula *formula, lam_error *error)
{
    lam_scene *scene = lam_scene_make(NULL);
    if (lam_scene_add_formula(scene, formula, NULL, error) >= 0)
        return scene;
    lam_scene_free(scene);
    return NULL;
}

static void check_error(const char *text, const char *u, lam_code code, const char *says)
{
    lam_formula formula = {.text = text, .u = u};
    lam_error error = {0};
    lam_scene *scene = scene_of(&formula, &error);
    if (scene || error.code != code || !strstr(error.text, says))
        fail_msg("%s: found '%s' (%d), expected '%s'", text, error.text, (int)error.code, says);
}

TEST(errors_name_the_column)
{
    lam_code bad = LAM_BAD_ARGUMENT;
    check_error("", NULL, bad, "x is missing");
    check_error("x=u;y=v", NULL, bad, "z is missing");
    check_error("x=cos(u;y=v;z=0", NULL, bad, "column 8: found ';', expected an operator, ',' or ')'");
    check_error("x=u+;y=v;z=0", NULL, bad, "column 5: found ';', expected a number");
    check_error("x=sine(u);y=v;z=0", NULL, bad, "column 3: found 'sine'");
    check_error("x=cosh u;y=v;z=0", NULL, bad, "column 8: found 'u', expected '('");
    check_error("x=u v;y=v;z=0", NULL, bad, "column 5: found 'v', expected an operator");
    check_error("x=1/2pi;y=v;z=0", NULL, bad, "column 5: found '2', expected parentheses");
    check_error("x=atan2(u);y=v;z=0", NULL, bad, "column 3: atan2 has 1 argument, expected 2");
    check_error("x=sin(u,v);y=v;z=0", NULL, bad, "column 3: sin has 2 arguments, expected 1");
    check_error("x=u;x=v;z=0", NULL, bad, "column 5: found 'x', expected a new name");
    check_error("u=1", NULL, bad, "column 1: found 'u'");
    check_error("\xcf\x80=1", NULL, bad, "column 1");
    check_error("x=\xcf\x80+;y=v;z=0", NULL, bad, "column 5"); // characters, not bytes
    check_error("x=u)", NULL, bad, "column 4: found ')'");
    check_error("x=u;y=v;z=0", "0", bad, "range of u: found '0'");
    check_error("x=u;y=v;z=0", "0..u", bad, "range of u, column 4: expected a constant");
    check_error("x=u;y=v;z=0", "1..1", bad, "is empty");
    check_error("x=u;y=v;z=0", "0..(1", bad, "range of u, column 6: found the end");
    check_error("x=1/u;y=v;z=0", NULL, bad, "x is not a finite number at u = 0, v = 0");
    check_error("x=u;y=v;z=log(u-1)", NULL, bad, "z is not a finite number");
    check_error("x=u;y=u;z=u", NULL, bad, "make a line");
    check_error("x=1;y=2;z=3", NULL, bad, "constant");
    char deep[400] = "x=";
    memset(deep + 2, '(', 300);
    check_error(deep, NULL, LAM_LIMIT, "more than 64 levels");
    char *longest = calloc(1, 6000);
    memset(longest, ' ', 5000);
    check_error(longest, NULL, LAM_LIMIT, "5000 bytes");
    free(longest);
}

// Edges with one triangle, and Euler's number V - E + F, which show whether a surface is welded.
static int open_edges(const lam_mesh *mesh, int *euler)
{
    size_t n = 3 * (size_t)mesh->triangle_count, slots = 4 * n + 7;
    struct {
        uint64_t key;
        int count;
    } *table = calloc(slots, sizeof *table);
    int edges = 0, open = 0;
    for (size_t i = 0; i < n; i++) {
        uint64_t a = mesh->indices[i], b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
        uint64_t key = a < b ? (a << 32 | b) + 1 : (b << 32 | a) + 1;
        size_t slot = key * UINT64_C(0x9e3779b97f4a7c15) % slots;
        while (table[slot].key && table[slot].key != key)
            slot = (slot + 1) % slots;
        edges += !table[slot].key;
        table[slot].key = key;
        table[slot].count++;
    }
    for (size_t i = 0; i < slots; i++)
        open += table[i].count == 1;
    free(table);
    *euler = (int)mesh->vertex_count - edges + (int)mesh->triangle_count;
    return open;
}

TEST(seams_are_welded)
{
    static const struct {
        const char *name, *text, *u, *v;
        int open, euler; // open: edges at borders, with 32 × 16 segments
    } rows[] = {
        {"torus", "x=(2+cos(v))*cos(u); y=(2+cos(v))*sin(u); z=sin(v)", NULL, NULL, 0, 0},
        {"sphere", "x=sin(v)*cos(u); y=sin(v)*sin(u); z=cos(v)", NULL, "0..pi", 0, 2},
        {"sphere by columns", "x=sin(u)*cos(v); y=sin(u)*sin(v); z=cos(u)", "0..pi", NULL, 0, 2},
        {"strip", "x=cos(u); y=sin(u); z=v", NULL, "-1..1", 64, 0},
        {"moebius", "x=(1+v/2*cos(u/2))*cos(u); y=(1+v/2*cos(u/2))*sin(u); z=v/2*sin(u/2)", NULL, "-1..1", 64, 0},
        {"klein", "r=3+cos(u/2)*sin(v)-sin(u/2)*sin(2v); x=r*cos(u); y=r*sin(u); z=sin(u/2)*sin(v)+cos(u/2)*sin(2v)",
         NULL, NULL, 0, -1}, // its figure of eight crosses itself on the seam, where two vertices become one

        {"roof", "x=u; y=v; z=-abs(u)", "-1..1", "-1..1", 96, 1},
        {"octagon", "x=abs(cos(u))^0.5*sign(cos(u)); y=abs(sin(u))^0.5*sign(sin(u)); z=v", NULL, "0..1", 64, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_formula formula = {
            .text = rows[i].text, .u = rows[i].u, .v = rows[i].v, .u_segments = 32, .v_segments = 16};
        lam_error error = {0};
        AUTO_SCENE scene = scene_of(&formula, &error);
        if (!scene)
            fail_msg("%s: %s", rows[i].name, error.text);
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        int euler, open = open_edges(mesh, &euler);
        if (open != rows[i].open || euler != rows[i].euler)
            fail_msg("%s: %d open edges and Euler number %d, expected %d and %d", rows[i].name, open, euler,
                     rows[i].open, rows[i].euler);
        for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++) {
            const float *n = mesh->normals + 3 * (size_t)mesh->normal_indices[c];
            assert_float_equal(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-5);
        }
    }
}

TEST(normals_are_those_of_the_sphere)
{
    for (int flip = 0; flip < 2; flip++) {
        // u around and v downwards: the product of the derivatives points inward.
        lam_formula formula = {.text = "x=sin(v)*cos(u); y=sin(v)*sin(u); z=cos(v)", .v = "0..pi", .flip = flip};
        AUTO_SCENE scene = scene_of(&formula, NULL);
        const lam_mesh *m = lam_scene_mesh(scene, 0);
        double sign = flip ? 1 : -1;
        for (size_t c = 0; c < 3 * (size_t)m->triangle_count; c++) {
            const float *p = m->positions + 3 * (size_t)m->indices[c],
                        *n = m->normals + 3 * (size_t)m->normal_indices[c];
            for (int a = 0; a < 3; a++)
                assert_float_equal(n[a], sign * (double)p[a], 2e-6);
        }
        for (size_t t = 0; t < m->triangle_count; t++) {
            const float *p[3];
            for (size_t k = 0; k < 3; k++)
                p[k] = m->positions + 3 * (size_t)m->indices[3 * t + k];
            double det = (double)p[0][0] * ((double)p[1][1] * (double)p[2][2] - (double)p[1][2] * (double)p[2][1]) -
                         (double)p[0][1] * ((double)p[1][0] * (double)p[2][2] - (double)p[1][2] * (double)p[2][0]) +
                         (double)p[0][2] * ((double)p[1][0] * (double)p[2][1] - (double)p[1][1] * (double)p[2][0]);
            assert_true(sign * det > 0);
        }
    }
}

// Each side of a roof has one normal, also along the ridge, and so does each half of a double cone.
TEST(creases_keep_their_normals)
{
    lam_formula roof = {.text = "x=u; y=v; z=-abs(u)", .u = "-1..1", .v = "-1..1"};
    lam_scene *scene = scene_of(&roof, NULL);
    const lam_mesh *m = lam_scene_mesh(scene, 0);
    for (size_t c = 0; c < 3 * (size_t)m->triangle_count; c++) {
        const float *n = m->normals + 3 * (size_t)m->normal_indices[c];
        assert_float_equal(fabs((double)n[0]), sqrt(0.5), 1e-6);
        assert_float_equal(n[2], sqrt(0.5), 1e-6);
    }
    lam_scene_free(scene);
    lam_formula cone = {.text = "x=v*cos(u); y=v*sin(u); z=v", .v = "-1..1"};
    scene = scene_of(&cone, NULL);
    m = lam_scene_mesh(scene, 0);
    for (size_t t = 0; t < m->triangle_count; t++) {
        double z = 0;
        for (size_t k = 0; k < 3; k++)
            z += (double)m->positions[3 * (size_t)m->indices[3 * t + k] + 2];
        for (size_t k = 0; k < 3; k++) // ∂u × ∂v points down and out above, and up and in below: its z has the sign of
                                       // -v
            assert_float_equal(m->normals[3 * (size_t)m->normal_indices[3 * t + k] + 2], z > 0 ? -sqrt(0.5) : sqrt(0.5),
                               1e-3);
    }
    lam_scene_free(scene);
}

TEST(model_files_hold_the_mesh)
{
    static const char *const endings[] = {"obj", "stl", "ply"};
    lam_formula formula = {.text = "x=u; y=2v; z=3+u*v", .u = "0..1", .v = "0..1", .u_segments = 4, .v_segments = 3};
    AUTO_SCENE scene = scene_of(&formula, NULL);
    lam_error error = {0};
    for (int i = 0; i < 3; i++) {
        char path[] = "/tmp/lambent-mesh-XXXXXX.obj";
        memcpy(path + strlen(path) - 3, endings[i], 3);
        int file = mkstemps(path, 4);
        assert_true(file >= 0);
        close(file);
        assert_true(lam_mesh_save(lam_scene_mesh(scene, 0), path, LAM_UP_Z, &error));
        AUTO_SCENE read = lam_scene_load(path, NULL, NULL, &error);
        unlink(path);
        assert_non_null(read);
        const lam_mesh *a = lam_scene_mesh(scene, 0), *b = lam_scene_mesh(read, 0);
        assert_int_equal(a->triangle_count, b->triangle_count);
        for (size_t c = 0; c < 3 * (size_t)a->triangle_count; c++) {
            const float *p = a->positions + 3 * (size_t)a->indices[c];
            const float *q = b->positions + 3 * (size_t)(b->indices ? b->indices[c] : c);
            bool stl = i == 1; // z is up in it, and y in the others
            assert_true(p[0] == q[0] && p[1] == (stl ? q[1] : -q[2]) && p[2] == (stl ? q[2] : q[1]));
            if (stl)
                continue;
            const float *n = a->normals + 3 * (size_t)a->normal_indices[c];
            const float *o = b->normals + 3 * (size_t)(b->normal_indices ? b->normal_indices[c] : b->indices[c]);
            assert_float_equal(n[0], o[0], 1e-6);
            assert_float_equal(n[1], -o[2], 1e-6);
            assert_float_equal(n[2], o[1], 1e-6);
        }
    }
    assert_false(lam_mesh_save(lam_scene_mesh(scene, 0), "/tmp/x.fbx", LAM_UP_Z, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
}

// The gradient equals the differences, for each function of the language.
TEST(gradients_match_differences)
{
    static const char *const rows[] = {"x^2+y^2+z^2-1",
                                       "a=2; (sqrt(x^2+y^2)-a)^2+z^2-1",
                                       "x*y*z",
                                       "sin(x*y)-cos(z)",
                                       "x^y = z",
                                       "atan2(x,y)*z",
                                       "5",
                                       "b=x*z; exp(b)/b = hypot(y,z)"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct arena arena;
        struct formula formula;
        lam_error error = {0};
        arena_start(&arena, NULL);
        if (!formula_parse(rows[i], true, &arena, &formula, &error) || !formula_finish(&formula, &arena, &error))
            fail_msg("%s: %s", rows[i], error.text);
        for (int k = 0; k < 50; k++) {
            const double h = 1e-5;
            lam_vec3 p = {random_between(0.3, 1.9), random_between(0.3, 1.9), random_between(0.3, 1.9)};
            lam_vec3 found = formula_gradient(&formula, p);
            const double got[3] = {found.x, found.y, found.z};
            for (int a = 0; a < 3; a++) {
                lam_vec3 low = p, high = p;
                (&low.x)[a] -= h;
                (&high.x)[a] += h;
                double d = (formula_value(&formula, high) - formula_value(&formula, low)) / (2 * h);
                if (fabs(got[a] - d) > 1e-6 * (1 + fabs(d)))
                    fail_msg("%s by %c: %.12g, expected %.12g", rows[i], "xyz"[a], got[a], d);
            }
        }
        arena_free(&arena);
    }
}

// A sphere's surface is within the radius, its normals are its positions, and the box fits it, for any size and
// position.
TEST(implicit_surfaces_are_found)
{
    static const struct {
        const char *text, *x;
        bool flip;
        double radius, middle;
    } rows[] = {{"x^2+y^2+z^2-1", NULL, false, 1, 0},
                {"x^2+y^2+z^2 = 1", NULL, true, 1, 0},
                {"r=9; x^2+y^2+z^2-r^2", NULL, false, 9, 0}, // not closed in -4..4
                {"(x-40)^2+y^2+z^2 = 4", "30..50", false, 2, 40}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_formula formula = {
            .text = rows[i].text, .implicit = true, .x = rows[i].x, .flip = rows[i].flip, .u_segments = 24};
        lam_error error = {0};
        AUTO_SCENE scene = scene_of(&formula, &error);
        if (!scene)
            fail_msg("%s: %s", rows[i].text, error.text);
        const lam_mesh *m = lam_scene_mesh(scene, 0);
        const double r = rows[i].radius, sign = rows[i].flip ? -1 : 1;
        assert_true(m->triangle_count > (rows[i].x ? 30 : 500));
        for (uint32_t v = 0; v < m->vertex_count; v++) {
            const float *p = m->positions + 3 * (size_t)v, *n = m->normals + 3 * (size_t)v;
            double at[3];
            for (int k = 0; k < 3; k++)
                at[k] = (double)p[k] + m->origin[k] - (k == 0 ? rows[i].middle : 0);
            assert_true(fabs(sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]) / r - 1) < 1e-6);
            for (int k = 0; k < 3; k++)
                assert_true(fabs((double)n[k] - sign * at[k] / r) < 1e-5);
        }
        for (uint32_t t = 0; t < m->triangle_count; t++) { // counter-clockwise, seen from the side to which the normals
                                                           // point
            const float *a = m->positions + 3 * (size_t)m->indices[3 * t],
                        *b = m->positions + 3 * (size_t)m->indices[3 * t + 1],
                        *c = m->positions + 3 * (size_t)m->indices[3 * t + 2],
                        *n = m->normals + 3 * (size_t)m->indices[3 * t];
            float volume = 0;
            for (int k = 0; k < 3; k++) {
                int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
                volume += n[k] * ((b[k1] - a[k1]) * (c[k2] - a[k2]) - (b[k2] - a[k2]) * (c[k1] - a[k1]));
            }
            assert_true(volume >= 0);
        }
    }
    // A plane is infinite, so it is cut at the first cube. A given range cuts the surface, and is kept.
    lam_vec3 low, high;
    lam_formula plane = {.text = "z = x/2", .implicit = true, .y = "0..1", .u_segments = 8};
    lam_scene *scene = scene_of(&plane, NULL);
    lam_object object = lam_object_default();
    assert_true(lam_scene_add_object(scene, &object, NULL) == 0 && lam_scene_bounds(scene, &low, &high));
    assert_true(low.x == -4 && high.x == 4 && low.y == 0 && high.y == 1 && low.z == -2 && high.z == 2);
    lam_scene_free(scene);
    static const struct {
        const char *text, *x, *says;
        int u_segments, v_segments;
    } wrong[] = {{"x^2+u", NULL, "column 5: found 'u'", 0, 0},
                 {"(x^2+y^2)^2", NULL, "nowhere negative", 0, 0},
                 {"-1", NULL, "negative everywhere", 0, 0},
                 {"f=x", NULL, "expected an expression that is zero on the surface", 0, 0},
                 {"", NULL, "expected an expression that is zero on the surface", 0, 0},
                 {"x=1=2", NULL, "column 4: found '='", 0, 0},
                 {"x; y", NULL, "column 4: found 'y'", 0, 0},
                 {"a=1; a=2; x", NULL, "a new name", 0, 0},
                 {"x", "0..y", "range of x, column 4", 0, 0},
                 {"x", NULL, "expected 2 to 1024 cells", 1025, 0},
                 {"x", NULL, "a single number of segments", 8, 8}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        lam_formula formula = {.text = wrong[i].text,
                               .implicit = true,
                               .x = wrong[i].x,
                               .u_segments = wrong[i].u_segments,
                               .v_segments = wrong[i].v_segments};
        lam_error error = {0};
        assert_null(scene_of(&formula, &error));
        if (!strstr(error.text, wrong[i].says))
            fail_msg("%s: %s", wrong[i].text, error.text);
    }
    // The limits of a call end it during the evaluation, for expressions of any length.
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    lam_formula dense = {.text = "sin(x)", .implicit = true, .u_segments = 1024};
    lam_error error = {0};
    scene = lam_scene_make(NULL);
    assert_int_equal(lam_scene_add_formula(scene, &dense, &(lam_control){.cancel = &cancel}, &error), -1);
    assert_int_equal(error.code, LAM_CANCELLED);
    assert_int_equal(lam_scene_add_formula(scene, &dense, &(lam_control){.time_limit_s = 0.05}, &error), -1);
    assert_int_equal(error.code, LAM_LIMIT);
    lam_scene_free(scene);
}
