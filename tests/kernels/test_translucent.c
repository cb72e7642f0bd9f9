// test_translucent.c: compares translucent surfaces with a reference that sorts and blends every sample's fragments in
// double, for every instruction set and several thread counts.
//
// The camera is orthographic and maps one unit to one pixel, so that a corner at a multiple of 1/256 is snapped to
// itself. Colours are painted unlit. The reference follows only docs/lighting.md. The file has more than 600 lines
// because it contains the reference in double and every path that is compared with it.

#include "test.h"
#include "exact_cover.h"

enum { SIZE = 96, SAMPLES_MAX = 16 };

// Triangles with one colour each. `opaque` triangles are drawn as a separate object whose colours have no alpha below
// 1.
struct soup {
    int count;
    double (*corners)[3][3]; // x, y (pixels, y down), z (larger is nearer)
    float (*colors)[4];
    bool *opaque;
};

static struct soup soup_make(int count)
{
    struct soup soup = {count, calloc((size_t)count, sizeof *soup.corners), calloc((size_t)count, sizeof *soup.colors),
                        calloc((size_t)count, sizeof *soup.opaque)};
    return soup;
}

static void soup_free(struct soup *soup)
{
    free(soup->corners);
    free(soup->colors);
    free(soup->opaque);
}

static uint64_t seed;

static double random_between(double low, double high)
{
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * ((double)(seed >> 33) / 2147483648.0);
}

static double on_grid(double x) { return floor(x * 256 + 0.5) / 256; }

static lam_material white(void)
{
    lam_material material = lam_material_default();
    material.diffuse = (lam_rgba){1, 1, 1, 1};
    return material;
}

// Adds the triangles of one kind, in the given order, as one object.
static void add_object(lam_scene *scene, const struct soup *soup, const int *order, bool opaque)
{
    float *positions = malloc((size_t)soup->count * 9 * sizeof *positions);
    float *colors = malloc((size_t)soup->count * 4 * sizeof *colors);
    uint32_t n = 0;
    for (int i = 0; i < soup->count; i++) {
        int t = order ? order[i] : i;
        if (soup->opaque[t] != opaque)
            continue;
        for (int k = 0; k < 3; k++) {
            positions[9 * n + 3 * (uint32_t)k] = (float)soup->corners[t][k][0];
            positions[9 * n + 3 * (uint32_t)k + 1] = (float)(SIZE - soup->corners[t][k][1]);
            positions[9 * n + 3 * (uint32_t)k + 2] = (float)soup->corners[t][k][2];
        }
        memcpy(colors + 4 * n++, soup->colors[t], sizeof soup->colors[t]);
    }
    lam_mesh mesh = {.positions = positions,
                     .vertex_count = n * 3,
                     .triangle_count = n,
                     .colors = colors,
                     .color_count = n,
                     .colors_format = LAM_COLORS_LINEAR_F32,
                     .colors_rate = LAM_PER_TRIANGLE};
    lam_error error = {0};
    lam_material material = white();
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    object.material = lam_scene_add_material(scene, &material, &error);
    if (lam_scene_add_object(scene, &object, &error) < 0)
        fail_msg("%s", error.text);
    free(positions);
    free(colors);
}

static lam_scene *scene_of(const struct soup *soup, const int *order)
{
    lam_scene *scene = lam_scene_make(NULL);
    add_object(scene, soup, order, false);
    add_object(scene, soup, order, true);
    return scene;
}

static lam_camera camera(void)
{
    return (lam_camera){.eye = {SIZE / 2, SIZE / 2, 100},
                        .target = {SIZE / 2, SIZE / 2, 0},
                        .up = {0, 1, 0},
                        .ortho_half_height = SIZE / 2,
                        .near_plane = 1,
                        .far_plane = 199};
}

struct way {
    lam_isa isa;
    int threads;
    lam_draw_params params;
    lam_pixel_format format;
};

// Draws a scene and returns the number of lit points.
static uint64_t draw_seen(const lam_scene *scene, const lam_camera *seen, const struct way *way, void *out)
{
    lam_error error = {0};
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = way->threads, .isa = way->isa}, &error);
    lam_image image = {0};
    if (!device || !lam_image_make(&image, SIZE, SIZE, way->format, &error) ||
        !lam_draw(device, scene, seen, &way->params, &image, NULL, &error))
        fail_msg("%s", error.text);
    memcpy(out, image.pixels, (size_t)SIZE * SIZE * (way->format == LAM_RGBA8 ? 4 : 16));
    lam_frame_report report;
    lam_device_report(device, &report);
    lam_image_free(&image);
    lam_device_free(device);
    return report.points_lit;
}

static void draw(const lam_scene *scene, const struct way *way, void *out)
{
    lam_camera seen = camera();
    draw_seen(scene, &seen, way, out);
}

// --- the reference

struct hit {
    double depth;
    int triangle;
};

// Farthest first; among equal depths the later one first, so that the first stays in front. Translucent fragments
// precede opaque ones.
static int farther(const void *a, const void *b)
{
    const struct hit *x = a, *y = b;
    if (x->depth != y->depth)
        return x->depth < y->depth ? -1 : 1;
    return x->triangle > y->triangle ? -1 : 1;
}

struct reference {
    double pixel[SIZE * SIZE][4]; // premultiplied
    bool close[SIZE * SIZE];      // an order that floats cannot distinguish
};

static void refer(const struct soup *soup, int samples, lam_rgba background, struct reference *out)
{
    // Direct3D's standard patterns, in 1/16 pixel, by number of samples.
    static const int where[17][SAMPLES_MAX][2] = {
        [1] = {{0, 0}},
        [2] = {{4, 4}, {-4, -4}},
        [4] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}},
        [8] = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}},
        [16] = {{1, 1},
                {-1, -3},
                {-3, 2},
                {4, -1},
                {-5, -2},
                {2, 5},
                {5, 3},
                {3, -5},
                {-2, 6},
                {0, -7},
                {-4, -6},
                {-6, 4},
                {-8, 0},
                {7, -4},
                {6, 7},
                {-7, -8}},
    };
    struct hit *hits = malloc((size_t)soup->count * sizeof *hits);
    for (int i = 0; i < SIZE * SIZE; i++) {
        double *pixel = out->pixel[i];
        out->close[i] = false;
        pixel[0] = pixel[1] = pixel[2] = pixel[3] = 0;
        for (int s = 0; s < samples; s++) {
            const int *at = where[samples][s];
            int64_t p[2] = {i % SIZE * 256 + 128 + 16 * at[0], i / SIZE * 256 + 128 + 16 * at[1]};
            int n = 0;
            for (int t = 0; t < soup->count; t++)
                if (exact_cover(&soup->corners[t][0][0], p, &hits[n].depth))
                    hits[n++].triangle = t;
            qsort(hits, (size_t)n, sizeof *hits, farther);
            double sum[4] = {0, 0, 0, 0};
            for (int h = 0; h < n; h++) {
                const float *color = soup->colors[hits[h].triangle];
                double a = (double)color[3];
                out->close[i] |=
                    h > 0 && hits[h].depth != hits[h - 1].depth && hits[h].depth - hits[h - 1].depth < 2e-4;
                for (int c = 0; c < 3; c++)
                    sum[c] = (double)color[c] * a + sum[c] * (1 - a);
                sum[3] = a + sum[3] * (1 - a);
            }
            for (int c = 0; c < 4; c++)
                pixel[c] += sum[c] / samples;
        }
        const float *back = &background.r;
        double left = (1 - pixel[3]) * (double)back[3];
        for (int c = 0; c < 3; c++)
            pixel[c] += left * (double)back[c];
        pixel[3] += left;
    }
    free(hits);
}

static void compare(const struct reference *reference, const float *drawn, double tolerance)
{
    int covered = 0, close = 0;
    double worst = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        covered += reference->pixel[i][3] > 0;
        close += reference->close[i];
        for (int c = 0; c < 4 && !reference->close[i]; c++) {
            double apart = fabs((double)drawn[4 * i + c] - reference->pixel[i][c]);
            if (!(apart <= tolerance))
                fail_msg("pixel %d,%d channel %d is %.7f, expected %.7f", i % SIZE, i / SIZE, c,
                         (double)drawn[4 * i + c], reference->pixel[i][c]);
            worst = apart > worst ? apart : worst;
        }
    }
    assert_true(covered > 50);
    assert_true(close * 20 < covered);
    print_message("%d pixels, %d too close to call, worst %.2g\n", covered, close, worst);
}

// Draws in every way; all pictures have the same bytes, and equal the reference's picture.
static void check(const struct soup *soup, const int *order, int samples, lam_rgba background, double tolerance)
{
    static float first[SIZE * SIZE * 4], other[SIZE * SIZE * 4];
    static struct reference reference;
    lam_scene *scene = scene_of(soup, order);
    struct way way = {.isa = LAM_ISA_SCALAR,
                      .threads = 1,
                      .format = LAM_RGBA32F,
                      .params = {.samples = samples, .reflection = LAM_REFLECTION_NONE, .background = background}};
    draw(scene, &way, first);
    static const int threads[] = {1, 2, 5};
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++)
        for (int t = 0; t < 3 && lam_isa_usable((lam_isa)isa); t++) {
            way.isa = (lam_isa)isa;
            way.threads = threads[t];
            draw(scene, &way, other);
            if (memcmp(first, other, sizeof first) != 0)
                fail_msg("%s with %d threads is not what plain with one is", lam_isa_name((lam_isa)isa), threads[t]);
        }
    lam_scene_free(scene);
    refer(soup, samples, background, &reference);
    compare(&reference, first, tolerance);
}

// --- random triangles

// Overlapping triangles of all sizes; every fifth is opaque, some are fully transparent or have an alpha of 1.
static struct soup random_soup(int count, double opaque_share)
{
    struct soup soup = soup_make(count);
    for (int i = 0; i < count; i++) {
        double x = random_between(0, SIZE), y = random_between(0, SIZE), size = i % 7 ? 30 : 150;
        for (int k = 0; k < 3; k++) {
            soup.corners[i][k][0] = on_grid(x + random_between(-size, size));
            soup.corners[i][k][1] = on_grid(y + random_between(-size, size));
            soup.corners[i][k][2] = on_grid(random_between(-50, 50));
        }
        for (int c = 0; c < 3; c++)
            soup.colors[i][c] = (float)random_between(0, 1.5);
        soup.opaque[i] = random_between(0, 1) < opaque_share;
        soup.colors[i][3] = soup.opaque[i] || i % 11 == 0 ? 1 : i % 13 == 0 ? 0 : (float)random_between(0, 1);
    }
    return soup;
}

TEST(test_random)
{
    static const lam_rgba backgrounds[] = {{0, 0, 0, 0}, {0.2f, 0.4f, 0.8f, 1}, {1, 0.5f, 0.25f, 0.5f}};
    static const int samples[] = {1, 4, 1, 4, 2, 4, 8, 16};
    for (int i = 0; i < 8; i++) {
        seed = (uint64_t)i + 1;
        struct soup soup = random_soup(i < 3 ? 120 : 50, i % 2 ? 0.2 : 0);
        check(&soup, NULL, samples[i], backgrounds[i % 3], 1e-5);
        soup_free(&soup);
    }
}

// Triangles of one colour look the same under every shading method, even if a tile has more points to light than fit at
// once.
TEST(test_methods)
{
    static float drawn[3][SIZE * SIZE * 4];
    seed = 10;
    struct soup soup = random_soup(300, 0.02);
    AUTO_SCENE scene = scene_of(&soup, NULL);
    uint64_t lit = 0;
    for (int shading = LAM_SHADING_PHONG; shading <= LAM_SHADING_FLAT; shading++) {
        struct way way = {.threads = 2,
                          .format = LAM_RGBA32F,
                          .params = {.samples = 1, .shading = (lam_shading)shading, .reflection = LAM_REFLECTION_NONE}};
        lam_camera seen = camera();
        uint64_t points = draw_seen(scene, &seen, &way, drawn[shading]);
        lit = shading == LAM_SHADING_PHONG ? points : lit;
        for (int i = 0; i < SIZE * SIZE * 4; i++)
            assert_true(fabsf(drawn[shading][i] - drawn[0][i]) < 1e-5f);
    }
    assert_true(lit > 4 * SIZE * SIZE); // layers indeed
    soup_free(&soup);
}

// The picture does not depend on the order of the triangles: only depth decides.
TEST(test_order)
{
    enum { COUNT = 80 };
    static float first[SIZE * SIZE * 4], other[SIZE * SIZE * 4];
    seed = 20;
    struct soup soup = random_soup(COUNT, 0.1);
    struct way way = {.threads = 2, .format = LAM_RGBA32F, .params = {.reflection = LAM_REFLECTION_NONE}};
    int order[COUNT];
    for (int i = 0; i < COUNT; i++)
        order[i] = i;
    for (int round = 0; round < 5; round++) {
        lam_scene *scene = scene_of(&soup, order);
        draw(scene, &way, round ? other : first);
        lam_scene_free(scene);
        assert_true(round == 0 || memcmp(first, other, sizeof first) == 0);
        for (int i = COUNT - 1; i > 0; i--) {
            int j = (int)random_between(0, i + 1), swap = order[i];
            order[i] = order[j];
            order[j] = swap;
        }
    }
    soup_free(&soup);
}

// --- arrangements that no order of triangles can draw

static void set(struct soup *soup, int i, const double corners[3][3], const float color[4], bool opaque)
{
    memcpy(soup->corners[i], corners, sizeof soup->corners[i]);
    memcpy(soup->colors[i], color, sizeof soup->colors[i]);
    soup->opaque[i] = opaque;
}

// Two squares that intersect along a diagonal, and an opaque one through both.
TEST(test_intersecting)
{
    static const float colors[3][4] = {{1, 0, 0, 0.5f}, {0, 1, 0, 0.7f}, {0, 0, 1, 1}};
    struct soup soup = soup_make(6);
    for (int i = 0; i < 3; i++) {
        double slope = i == 0 ? 0.4 : i == 1 ? -0.5 : 0.05;
        double z[2] = {-slope * 40, slope * 40};
        double first[3][3] = {{8, 8, z[0]}, {88, 8, z[1]}, {88, 88, z[1]}};
        double second[3][3] = {{8, 8, z[0]}, {88, 88, z[1]}, {8, 88, z[0]}};
        set(&soup, 2 * i, first, colors[i], i == 2);
        set(&soup, 2 * i + 1, second, colors[i], i == 2);
    }
    for (int samples = 1; samples <= 4; samples += 3)
        check(&soup, NULL, samples, (lam_rgba){0, 0, 0, 0}, 1e-5);
    soup_free(&soup);
}

// Three long triangles, each in front of the next one and behind the one before.
TEST(test_cyclic)
{
    static const float colors[3][4] = {{1, 0.2f, 0, 0.6f}, {0, 1, 0.1f, 0.4f}, {0.3f, 0, 1, 0.8f}};
    struct soup soup = soup_make(3);
    for (int i = 0; i < 3; i++) {
        double turn = 2 * 3.14159265358979 / 3 * i, c = cos(turn), s = sin(turn);
        double flat[3][3] = {{-44, -22, 12}, {44, -16, -12}, {-44, -2, 12}}, turned[3][3];
        for (int k = 0; k < 3; k++) {
            turned[k][0] = on_grid(48 + c * flat[k][0] - s * flat[k][1]);
            turned[k][1] = on_grid(48 + s * flat[k][0] + c * flat[k][1]);
            turned[k][2] = flat[k][2];
        }
        set(&soup, i, turned, colors[i], false);
    }
    for (int samples = 1; samples <= 4; samples += 3)
        check(&soup, NULL, samples, (lam_rgba){0.1f, 0.1f, 0.1f, 0.75f}, 1e-5);
    soup_free(&soup);
}

// At the same depth, the first triangle is in front, as among opaque triangles.
TEST(test_equal_depth)
{
    struct soup soup = soup_make(12);
    for (int i = 0; i < 12; i++) {
        double corners[3][3] = {{4 + i, 4, 0}, {92 - i, 10, 0}, {20, 90 - 2 * i, 0}};
        float color[4] = {i % 3 == 0, i % 3 == 1, i % 3 == 2, 0.3f};
        set(&soup, i, corners, color, false);
    }
    check(&soup, NULL, 4, (lam_rgba){0, 0, 0, 0}, 1e-5);
    soup_free(&soup);
}

// --- bounds

// Far more fragments than fit into a thread's memory: the tile is drawn in parts, down to few pixels, and the picture
// is the same.
TEST(test_many_layers)
{
    struct soup soup = soup_make(3000);
    seed = 30;
    for (int i = 0; i < soup.count; i++) {
        double z = on_grid(random_between(-50, 50)), tilt = on_grid(random_between(-3, 3));
        double corners[3][3] = {{34, 40, z}, {47 + i % 5, 44, z + tilt}, {40, 55 + i % 3, z - tilt}};
        float color[4] = {(float)random_between(0, 1), (float)random_between(0, 1), (float)random_between(0, 1),
                          i % 100 ? 0.002f : 0.3f};
        set(&soup, i, corners, color, false);
    }
    static float first[SIZE * SIZE * 4], other[SIZE * SIZE * 4];
    static struct reference reference;
    AUTO_SCENE scene = scene_of(&soup, NULL);
    struct way way = {.isa = LAM_ISA_SCALAR,
                      .threads = 1,
                      .format = LAM_RGBA32F,
                      .params = {.samples = 4, .reflection = LAM_REFLECTION_NONE}};
    draw(scene, &way, first);
    for (int isa = LAM_ISA_SSE4; isa < LAM_ISA_COUNT; isa++) {
        way.isa = (lam_isa)isa;
        way.threads = isa;
        if (!lam_isa_usable(way.isa))
            continue;
        draw(scene, &way, other);
        assert_memory_equal(first, other, sizeof first);
    }
    refer(&soup, 4, (lam_rgba){0, 0, 0, 0}, &reference);
    // So many layers are sometimes closer together than floats can distinguish; exchanging two of them changes a pixel
    // by less than the product of their alphas.
    for (int i = 0; i < SIZE * SIZE; i++)
        for (int c = 0; c < 4; c++)
            assert_true(fabs((double)first[4 * i + c] - reference.pixel[i][c]) < (reference.close[i] ? 1e-3 : 1e-5));
    assert_true(first[4 * (SIZE * 45 + 40) + 3] > 0.99f);
    soup_free(&soup);
}

// The maximum number of layers that can be sorted over one pixel, and one more.
TEST(test_limit)
{
    enum { MOST = 65536 };
    for (int count = MOST; count <= MOST + 1; count++) {
        struct soup soup = soup_make(count);
        for (int i = 0; i < count; i++) {
            double corners[3][3] = {{70, 70, 0}, {72, 70, 0}, {70, 72, 0}};
            float color[4] = {1, 1, 1, 1e-4f};
            set(&soup, i, corners, color, false);
        }
        AUTO_SCENE scene = scene_of(&soup, NULL);
        lam_error error = {0};
        AUTO_DEVICE device = lam_device_cpu(&(lam_cpu_params){.threads = 2}, &error);
        lam_camera seen = camera();
        AUTO_IMAGE image = {0};
        assert_true(lam_image_make(&image, SIZE, SIZE, LAM_RGBA32F, &error));
        lam_draw_params params = {.samples = 1, .reflection = LAM_REFLECTION_NONE};
        bool drawn = lam_draw(device, scene, &seen, &params, &image, NULL, &error);
        if (count == MOST) {
            assert_true(drawn);
            double expected = 1 - pow(1 - (double)1e-4f, MOST);
            assert_true(fabs((double)((float *)image.pixels)[4 * (SIZE * 70 + 70) + 3] - expected) < 1e-4);
        } else {
            assert_false(drawn);
            assert_int_equal(error.code, LAM_LIMIT);
            assert_non_null(strstr(error.text, "65536"));
            // The device still works for other frames.
            AUTO_SCENE empty = lam_scene_make(&error);
            assert_true(lam_draw(device, empty, &seen, &params, &image, NULL, &error));
        }
        soup_free(&soup);
    }
}

// The memory for layers is counted in the call's budget.
TEST(test_memory)
{
    seed = 40;
    struct soup soup = random_soup(20, 0);
    for (int opaque = 0; opaque < 2; opaque++) {
        for (int i = 0; i < soup.count; i++)
            soup.colors[i][3] = opaque ? 1 : 0.5f;
        AUTO_SCENE scene = scene_of(&soup, NULL);
        lam_error error = {0};
        AUTO_DEVICE device = lam_device_cpu(&(lam_cpu_params){.threads = 1}, &error);
        lam_camera seen = camera();
        AUTO_IMAGE image = {0};
        assert_true(lam_image_make(&image, SIZE, SIZE, LAM_RGBA32F, &error));
        lam_draw_params params = {.samples = 1, .reflection = LAM_REFLECTION_NONE};
        lam_control control = {.memory_limit_bytes = 4 << 20};
        bool drawn = lam_draw(device, scene, &seen, &params, &image, &control, &error);
        assert_int_equal(drawn, opaque);
        assert_true(drawn || error.code == LAM_LIMIT);
    }
    soup_free(&soup);
}

// --- clipping, sides, sources of alpha

// A square across the view with given alphas at its corners.
static int add_square(lam_scene *scene, const float corners[4][3], const float alphas[4], lam_error *error)
{
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    float colors[4][4];
    for (int i = 0; i < 4; i++)
        memcpy(colors[i], (float[4]){0.25f, 0.5f, 1, alphas[i]}, sizeof colors[i]);
    lam_mesh mesh = {.positions = &corners[0][0],
                     .vertex_count = 4,
                     .indices = indices,
                     .triangle_count = 2,
                     .colors = colors,
                     .color_count = 4,
                     .colors_format = LAM_COLORS_LINEAR_F32};
    return lam_scene_add_mesh(scene, &mesh, error);
}

// A slanted ground that extends behind the eye is clipped into pieces whose seams cross the picture. Each sample still
// gets each triangle once, and a pixel on a seam is lit once.
TEST(test_clipped)
{
    static const float corners[4][3] = {{-30, 0, 30}, {30, -4, 26}, {22, 3, -30}, {-30, 0, -26}};
    static float drawn[2][SIZE * SIZE * 4];
    int covered = 0;
    seed = 70;
    for (int round = 0; round < 24; round++) {
        uint64_t lit[2];
        lam_camera seen = lam_camera_default();
        seen.eye = (lam_vec3){random_between(-9, 9), random_between(2, 5), random_between(-9, 9)};
        seen.target = (lam_vec3){random_between(-9, 9), -2, random_between(-9, 9)};
        seen.near_plane = random_between(1, 6); // cuts through the ground below the eye
        seen.far_plane = random_between(12, 40);
        for (int i = 0; i < 2; i++) {
            lam_error error = {0};
            AUTO_SCENE scene = lam_scene_make(&error);
            lam_material material = white();
            lam_object object = lam_object_default();
            float alpha = i ? 0.5f : 1;
            object.mesh = add_square(scene, corners, (float[4]){alpha, alpha, alpha, alpha}, &error);
            object.material = lam_scene_add_material(scene, &material, &error);
            assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
            struct way way = {.threads = 2, .format = LAM_RGBA32F, .params = {.reflection = LAM_REFLECTION_NONE}};
            lit[i] = draw_seen(scene, &seen, &way, drawn[i]);
        }
        for (int i = 0; i < SIZE * SIZE * 4; i++) {
            covered += drawn[0][i] == 1;
            assert_true(fabsf(drawn[1][i] - 0.5f * drawn[0][i]) < 1e-6f);
        }
        assert_int_equal(lit[0], lit[1]);
    }
    assert_true(covered > 24 * 2000);
}

// Alpha is the material's times the colour's, interpolated like colours in the shading method.
TEST(test_shading)
{
    static const float corners[4][3] = {{16, 16, 0}, {80, 16, 0}, {80, 80, 0}, {16, 80, 0}};
    static float drawn[SIZE * SIZE * 4];
    lam_error error = {0};
    AUTO_SCENE scene = lam_scene_make(&error);
    lam_material material = white();
    material.diffuse.a = 0.5f;
    lam_object object = lam_object_default();
    object.mesh = add_square(scene, corners, (float[4]){0, 1, 1, 0}, &error);
    object.material = lam_scene_add_material(scene, &material, &error);
    assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
    for (int shading = LAM_SHADING_PHONG; shading <= LAM_SHADING_FLAT; shading++) {
        draw(
            scene,
            &(struct way){.threads = 1,
                          .format = LAM_RGBA32F,
                          .params = {.samples = 1, .shading = (lam_shading)shading, .reflection = LAM_REFLECTION_NONE}},
            drawn);
        for (int y = 20; y < 76; y++)
            for (int x = 20; x < 76; x++) {
                // Flat: the last vertex's colour; the lower triangle (y up) ends in a corner with alpha 1, the upper
                // one in a corner with 0.
                bool lower = x - 16 > 79 - y, edge_pixel = abs((x - 16) - (79 - y)) < 2;
                double expected = 0.5 * (shading == LAM_SHADING_FLAT ? lower : (x + 0.5 - 16) / 64);
                const float *pixel = drawn + 4 * (y * SIZE + x);
                if (shading == LAM_SHADING_FLAT && edge_pixel)
                    continue;
                assert_true(fabs((double)pixel[3] - expected) < 1e-5);
                assert_true(fabs((double)pixel[2] - expected) < 1e-5 &&
                            fabs((double)pixel[0] - 0.25 * expected) < 1e-5);
            }
    }
}

// A back material has its own alpha, whichever side is translucent; culled sides are omitted.
TEST(test_sides)
{
    static const float turned[2][4][3] = {{{16, 16, 0}, {80, 16, 0}, {80, 80, 0}, {16, 80, 0}},
                                          {{16, 16, 0}, {16, 80, 0}, {80, 80, 0}, {80, 16, 0}}};
    static float drawn[SIZE * SIZE * 4];
    for (int i = 0; i < 8; i++) {
        bool back = i & 1, swapped = i & 2, culled = i & 4;
        lam_error error = {0};
        AUTO_SCENE scene = lam_scene_make(&error);
        lam_material clear = white(), solid = white();
        clear.diffuse = (lam_rgba){0, 1, 0, 0.25f};
        lam_object object = lam_object_default();
        object.mesh = add_square(scene, turned[back], (float[4]){1, 1, 1, 1}, &error);
        object.material = lam_scene_add_material(scene, swapped ? &clear : &solid, &error);
        object.back_material = lam_scene_add_material(scene, swapped ? &solid : &clear, &error);
        object.cull = culled ? LAM_CULL_BACK : LAM_CULL_NONE;
        assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
        draw(scene, &(struct way){.threads = 1, .format = LAM_RGBA32F, .params = {.reflection = LAM_REFLECTION_NONE}},
             drawn);
        float expected = culled && back ? 0 : back != swapped ? 0.25f : 1;
        assert_true(drawn[4 * (48 * SIZE + 48) + 3] == expected);
    }
}

// Colours that could be transparent but are not give the opaque picture, and an unused transparent colour changes
// nothing.
TEST(test_as_opaque)
{
    static float first[SIZE * SIZE * 4], other[SIZE * SIZE * 4];
    seed = 50;
    struct soup soup = random_soup(100, 1);
    struct way way = {.threads = 2, .format = LAM_RGBA32F, .params = {.reflection = LAM_REFLECTION_NONE}};
    lam_scene *scene = scene_of(&soup, NULL);
    draw(scene, &way, first);
    lam_scene_free(scene);
    for (int i = 0; i < soup.count; i++)
        soup.opaque[i] = false;
    double outside[3][3] = {{-90, -90, 0}, {-80, -90, 0}, {-90, -80, 0}};
    set(&soup, 0, outside, (float[4]){1, 1, 1, 0.5f}, false);
    scene = scene_of(&soup, NULL);
    draw(scene, &way, other);
    lam_scene_free(scene);
    soup.colors[0][3] = 1;
    soup.opaque[0] = true;
    for (int i = 1; i < soup.count; i++)
        soup.opaque[i] = true;
    scene = scene_of(&soup, NULL);
    draw(scene, &way, first);
    lam_scene_free(scene);
    for (int i = 0; i < SIZE * SIZE * 4; i++)
        assert_true(fabsf(first[i] - other[i]) < 1e-6f);
    soup_free(&soup);
}

// 8-bit pictures store the colour divided by alpha.
TEST(test_straight)
{
    static uint8_t drawn[SIZE * SIZE * 4];
    static struct reference reference;
    seed = 60;
    struct soup soup = random_soup(20, 0);
    for (int i = 0; i < soup.count; i++)
        for (int c = 0; c < 3; c++)
            soup.colors[i][c] *= 0.6f;
    AUTO_SCENE scene = scene_of(&soup, NULL);
    draw(scene,
         &(struct way){.threads = 2,
                       .format = LAM_RGBA8,
                       .params = {.samples = 4, .reflection = LAM_REFLECTION_NONE, .color = LAM_COLOR_RAW}},
         drawn);
    refer(&soup, 4, (lam_rgba){0, 0, 0, 0}, &reference);
    int seen = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double *p = reference.pixel[i];
        if (reference.close[i] || p[3] < 0.02)
            continue;
        for (int c = 0; c < 4; c++) {
            double expected = (c < 3 ? p[c] / p[3] : p[3]) * 255;
            assert_true(fabs((double)drawn[4 * i + c] - expected) <= 0.5 + 0.01);
        }
        seen += p[3] < 0.99;
    }
    assert_true(seen > 500);
    soup_free(&soup);
}
