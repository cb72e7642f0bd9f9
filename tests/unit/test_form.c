// test_form.c: the form of a model depends on its surface, not on the order, the number or the copies of its triangles.
#include "test.h"
#include "loading.h"
#include "scene_internal.h"

enum { TRIANGLES_MAX = 1 << 17, SIDE = 61 };

// Triangles without shared vertices: nine numbers each.
struct soup {
    float *corners;
    uint32_t count;
};

static struct soup made(uint32_t count)
{
    struct soup soup = {malloc((size_t)count * 9 * sizeof(float)), 0};
    assert_non_null(soup.corners);
    return soup;
}

static void add(struct soup *soup, const float *a, const float *b, const float *c)
{
    float *to = soup->corners + 9 * (size_t)soup->count++;
    memcpy(to, a, 3 * sizeof *to);
    memcpy(to + 3, b, 3 * sizeof *to);
    memcpy(to + 6, c, 3 * sizeof *to);
}

// A square grid of `n` by `n` points that `point` places.
static struct soup grid(int n, void (*point)(int i, int j, int n, float p[3]))
{
    struct soup soup = made((uint32_t)(2 * n * n));
    for (int i = 0; i + 1 < n; i++)
        for (int j = 0; j + 1 < n; j++) {
            float p[4][3];
            for (int k = 0; k < 4; k++)
                point(i + (k & 1), j + (k >> 1), n, p[k]);
            add(&soup, p[0], p[2], p[3]);
            add(&soup, p[0], p[3], p[1]);
        }
    return soup;
}

static void bumpy_ball(int i, int j, int n, float p[3])
{
    double u = 6.283185307179586 * i / (n - 1), v = 3.141592653589793 * j / (n - 1),
           r = 1 + 0.05 * sin(9 * u) * sin(7 * v);
    p[0] = (float)(r * sin(v) * cos(u));
    p[1] = (float)(r * cos(v));
    p[2] = (float)(-r * sin(v) * sin(u));
}

static void hills(int i, int j, int n, float p[3])
{
    p[0] = (float)i;
    p[1] = (float)(0.04 * n * (sin(0.31 * i + 0.2 * j) + cos(0.23 * j) + 0.3 * sin(1.7 * i) * cos(1.3 * j)));
    p[2] = (float)j;
}

// A plate of many unequal triangles: a fan of slivers on the top, two triangles elsewhere.
static struct soup plate(void)
{
    struct soup soup = made(4000);
    const float p[8][3] = {{0, 0, 0},    {9, 0, 0},    {9, 0, 5},    {0, 0, 5},
                           {0, 0.2f, 0}, {9, 0.2f, 0}, {9, 0.2f, 5}, {0, 0.2f, 5}};
    static const int faces[][4] = {{0, 1, 2, 3}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
    for (int i = 0; i < 5; i++) {
        add(&soup, p[faces[i][0]], p[faces[i][1]], p[faces[i][2]]);
        add(&soup, p[faces[i][0]], p[faces[i][2]], p[faces[i][3]]);
    }
    for (int i = 0; i < 1500; i++) {
        const float a[3] = {9.0f * (float)i / 1500, 0.2f, 5}, b[3] = {9.0f * (float)(i + 1) / 1500, 0.2f, 5};
        add(&soup, p[4], a, b);
    }
    add(&soup, p[4], p[6], p[5]);
    return soup;
}

static uint32_t next_random(uint32_t *state) { return *state = *state * 1664525u + 1013904223u; }

// Changes that leave the surface as it is.
enum change { NOTHING, SHUFFLED, DOUBLED, DIVIDED, DIVIDED_TWICE, SPLIT_AT_CENTRES, TURNED, CHANGES };

static struct soup changed(const struct soup *from, enum change change)
{
    uint32_t state = 7, times = change == DOUBLED ? 2 : change == DIVIDED ? 4 : change == DIVIDED_TWICE ? 16 : 3;
    struct soup soup = made(from->count * times);
    for (uint32_t i = 0; i < from->count; i++) {
        const float *a = from->corners + 9 * (size_t)i, *b = a + 3, *c = a + 6;
        float m[4][3];
        for (int k = 0; k < 3; k++) {
            m[0][k] = 0.5f * (a[k] + b[k]);
            m[1][k] = 0.5f * (b[k] + c[k]);
            m[2][k] = 0.5f * (c[k] + a[k]);
            m[3][k] = (a[k] + b[k] + c[k]) / 3;
        }
        if (change == DIVIDED || change == DIVIDED_TWICE) {
            add(&soup, a, m[0], m[2]);
            add(&soup, m[0], b, m[1]);
            add(&soup, m[2], m[1], c);
            add(&soup, m[0], m[1], m[2]);
        } else if (change == SPLIT_AT_CENTRES) {
            add(&soup, a, b, m[3]);
            add(&soup, b, c, m[3]);
            add(&soup, c, a, m[3]);
        } else if (change == DOUBLED) {
            add(&soup, a, b, c);
            add(&soup, a, b, c);
        } else { // also another first corner
            add(&soup, b, c, a);
        }
    }
    for (uint32_t i = soup.count; change == SHUFFLED && i > 1; i--) {
        float kept[9], *x = soup.corners + 9 * (size_t)(i - 1),
                       *y = soup.corners + 9 * (size_t)(next_random(&state) % i);
        memcpy(kept, x, sizeof kept);
        memcpy(x, y, sizeof kept);
        memcpy(y, kept, sizeof kept);
    }
    if (change == DIVIDED_TWICE) {
        struct soup twice = changed(&soup, DIVIDED);
        free(soup.corners);
        return twice;
    }
    return soup;
}

static lam_scene *scene_with(const struct soup *soup, enum change change)
{
    lam_scene *scene = lam_scene_make(NULL);
    const uint32_t half = change == TURNED ? soup->count / 2 : soup->count; // also two objects instead of one
    for (uint32_t first = 0; first < soup->count; first += half) {
        const uint32_t count = soup->count - first < half ? soup->count - first : half;
        lam_object object = lam_object_default();
        object.mesh = lam_scene_add_mesh(scene,
                                         &(lam_mesh){.positions = soup->corners + 9 * (size_t)first,
                                                     .vertex_count = 3 * count,
                                                     .triangle_count = count},
                                         NULL);
        assert_true(lam_scene_add_object(scene, &object, NULL) >= 0);
    }
    if (change == TURNED)
        assert_true(lam_scene_rotate(scene, (lam_vec3){1, 2, 3}, (lam_vec3){0, 1, 0}, 0.7, NULL));
    return scene;
}

TEST(forms_depend_on_surfaces)
{
    struct {
        const char *name;
        struct soup soup;
        enum scene_form form;
        bool fine;
    } rows[] = {
        {"plate", plate(), FORM_FLAT, false},
        {"coarse ball", grid(11, bumpy_ball), FORM_FLAT, false},
        {"ball", grid(SIDE, bumpy_ball), FORM_CURVED, true},
        {"hills", grid(SIDE, hills), FORM_TERRAIN, true},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct surface_facts plain = {.detail = 0};
        for (int change = 0; change < CHANGES; change++) {
            struct soup soup = changed(&rows[i].soup, (enum change)change);
            AUTO_SCENE scene = scene_with(&soup, (enum change)change);
            const struct surface_facts facts = surface_facts(scene, NULL);
            if (change == NOTHING)
                plain = facts;
            // Rounding of new vertices moves a few points to other planes. The order and copies change nothing.
            const double tolerance =
                change == DIVIDED || change == DIVIDED_TWICE || change == SPLIT_AT_CENTRES ? 0.01 : 0;
            if (scene_form(scene) != rows[i].form || scene_is_fine(scene) != rows[i].fine ||
                !(fabs(facts.facing.y - plain.facing.y) <= tolerance) ||
                !(fabs(facts.fullest - plain.fullest) <= tolerance) ||
                !(fabs(facts.detail - plain.detail) <= tolerance))
                fail_msg(
                    "%s, change %d: form %d, fine %d, facing %.9g, fullest %.9g, detail %.9g; facing %.9g, fullest "
                    "%.9g, detail %.9g without it",
                    rows[i].name, change, (int)scene_form(scene), scene_is_fine(scene), facts.facing.y, facts.fullest,
                    facts.detail, plain.facing.y, plain.fullest, plain.detail);
            free(soup.corners);
        }
        free(rows[i].soup.corners);
    }
}

// Threads, hidden objects and new transforms: the kept result is replaced when it no longer applies.
TEST(kept_results_follow_the_scene)
{
    struct soup ball = grid(181, bumpy_ball), flat = plate(); // more triangles than one task
    AUTO_SCENE scene = scene_with(&ball, NOTHING);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(
        scene, &(lam_mesh){.positions = flat.corners, .vertex_count = 3 * flat.count, .triangle_count = flat.count},
        NULL);
    assert_int_equal(scene_form(scene), FORM_CURVED);
    assert_int_equal(lam_scene_add_object(scene, &object, NULL), 1);
    assert_int_equal(scene_form(scene), FORM_FLAT);
    struct pool *pool = pool_make(3);
    const struct surface_facts one = surface_facts(scene, NULL), three = surface_facts(scene, pool);
    assert_memory_equal(&one, &three, sizeof one);
    pool_free(pool);
    assert_true(lam_scene_hide_object(scene, 1, true, NULL));
    assert_int_equal(scene_form(scene), FORM_CURVED);
    free(ball.corners);
    free(flat.corners);
}
