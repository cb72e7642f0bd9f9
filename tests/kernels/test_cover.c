// test_cover.c: compares coverage and depth with a pixel-by-pixel reference in 64-bit integers and double, for every
// instruction set.
//
// The camera is orthographic and maps one unit to one pixel, so that a corner at a multiple of 1/256 is snapped to
// itself.

#include "test.h"
#include "exact_cover.h"

enum { SIZE = 128 };

struct soup {
    int count;
    double *corners; // x, y (pixels, y down), z (larger is nearer) of three corners each
};

static uint64_t seed;

static uint32_t random_bits(void)
{
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(seed >> 33);
}

static double random_between(double low, double high) { return low + (high - low) * (random_bits() / 2147483648.0); }

static double on_grid(double x) { return floor(x * 256 + 0.5) / 256; }

static lam_scene *scene_of(const struct soup *soup, lam_cull cull)
{
    float *positions = malloc((size_t)soup->count * 9 * sizeof *positions);
    float *colors = malloc((size_t)soup->count * 4 * sizeof *colors);
    for (int i = 0; i < soup->count * 3; i++) {
        positions[3 * i] = (float)soup->corners[3 * i];
        positions[3 * i + 1] = (float)(SIZE - soup->corners[3 * i + 1]);
        positions[3 * i + 2] = (float)soup->corners[3 * i + 2];
    }
    for (int i = 0; i < soup->count; i++) {
        float color[4] = {(float)(i + 1), 0, 0, 1};
        memcpy(colors + 4 * i, color, sizeof color);
    }
    lam_mesh mesh = {.positions = positions,
                     .vertex_count = (uint32_t)soup->count * 3,
                     .triangle_count = (uint32_t)soup->count,
                     .colors = colors,
                     .color_count = (uint32_t)soup->count,
                     .colors_format = LAM_COLORS_LINEAR_F32,
                     .colors_rate = LAM_PER_TRIANGLE};
    lam_scene *scene = lam_scene_make(NULL);
    lam_error error = {0};
    lam_material white = lam_material_default();
    white.diffuse = (lam_rgba){1, 1, 1, 1};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    object.material = lam_scene_add_material(scene, &white, &error);
    object.cull = cull;
    if (lam_scene_add_object(scene, &object, &error) < 0)
        fail_msg("%s", error.text);
    free(positions);
    free(colors);
    return scene;
}

// The number of the triangle visible in each pixel, 0 for none.
static void draw(const lam_scene *scene, lam_isa isa, int samples, float out[SIZE * SIZE])
{
    lam_error error = {0};
    AUTO_DEVICE device = lam_device_cpu(&(lam_cpu_params){.threads = 2, .isa = isa}, &error);
    lam_camera camera = {.eye = {SIZE / 2, SIZE / 2, 100},
                         .target = {SIZE / 2, SIZE / 2, 0},
                         .up = {0, 1, 0},
                         .ortho_half_height = SIZE / 2,
                         .near_plane = 1,
                         .far_plane = 199};
    lam_draw_params params = {.samples = samples, .reflection = LAM_REFLECTION_NONE};
    AUTO_IMAGE image = {0};
    if (!device || !lam_image_make(&image, SIZE, SIZE, LAM_RGBA32F, &error) ||
        !lam_draw(device, scene, &camera, &params, &image, NULL, &error))
        fail_msg("%s", error.text);
    for (int i = 0; i < SIZE * SIZE; i++)
        out[i] = ((float *)image.pixels)[4 * i];
}

// The expected pixel: a triangle's number, 0 for none, and whether the second triangle is too close to decide in
// floats.
struct reference {
    int number[SIZE * SIZE];
    bool close[SIZE * SIZE];
};

static void refer(const struct soup *soup, struct reference *reference)
{
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            int64_t p[2] = {x * 256 + 128, y * 256 + 128};
            double nearest = -1e300, second = -1e300;
            int number = 0;
            for (int i = 0; i < soup->count; i++) {
                double depth;
                if (!exact_cover(soup->corners + 9 * i, p, &depth))
                    continue;
                if (depth > nearest) {
                    second = nearest;
                    nearest = depth;
                    number = i + 1;
                } else if (depth > second) {
                    second = depth;
                }
            }
            reference->number[y * SIZE + x] = number;
            reference->close[y * SIZE + x] = number && nearest - second < 1e-3;
        }
}

static void compare(const struct reference *reference, lam_isa isa, const float *drawn)
{
    int covered = 0, wrong = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        int number = reference->number[i];
        covered += number != 0;
        wrong += (drawn[i] != 0) != (number != 0) || (!reference->close[i] && drawn[i] != (float)number);
    }
    assert_true(covered > 0);
    if (wrong)
        fail_msg("%s: %d of %d covered pixels differ from the reference", lam_isa_name(isa), wrong, covered);
}

// `exact`: floats distinguish all depths, or the depths are equal.
static void check(struct soup *soup, bool exact)
{
    static float drawn[SIZE * SIZE];
    static struct reference reference;
    refer(soup, &reference);
    if (exact)
        memset(reference.close, 0, sizeof reference.close);
    AUTO_SCENE scene = scene_of(soup, LAM_CULL_NONE);
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++)
        if (lam_isa_usable((lam_isa)isa)) {
            draw(scene, (lam_isa)isa, 1, drawn);
            compare(&reference, (lam_isa)isa, drawn);
        }
    free(soup->corners);
}

// Random triangles of one size, anywhere around the picture.
static struct soup random_soup(int count, double size)
{
    struct soup soup = {count, malloc((size_t)count * 9 * sizeof(double))};
    for (int i = 0; i < count; i++) {
        double x = random_between(-size / 2, SIZE + size / 2), y = random_between(-size / 2, SIZE + size / 2);
        for (int k = 0; k < 3; k++) {
            soup.corners[9 * i + 3 * k] = on_grid(x + random_between(-size, size));
            soup.corners[9 * i + 3 * k + 1] = on_grid(y + random_between(-size, size));
            soup.corners[9 * i + 3 * k + 2] = on_grid(random_between(-50, 50));
        }
    }
    return soup;
}

TEST(test_small)
{
    seed = 1;
    struct soup soup = random_soup(2000, 2);
    check(&soup, false);
}

TEST(test_medium)
{
    seed = 2;
    struct soup soup = random_soup(300, 25);
    check(&soup, false);
}

TEST(test_large)
{
    seed = 3;
    struct soup soup = random_soup(60, 300);
    check(&soup, false);
}

TEST(test_huge)
{
    seed = 4;
    struct soup soup = random_soup(40, 8000); // still within the guard band, so exact
    check(&soup, false);
}

// Corners on pixel centres and edges through them: the rule decides every pixel.
TEST(test_on_centres)
{
    seed = 5;
    struct soup soup = random_soup(400, 12);
    for (int i = 0; i < soup.count * 9; i++)
        if (i % 3 != 2)
            soup.corners[i] = floor(soup.corners[i]) + 0.5;
    check(&soup, false);
}

// Back faces of all sizes in front of, inside and behind a wall of front faces with holes. Those behind it are dropped
// early, and only those. At equal depths the lower number is visible, with either side.
TEST(test_backs)
{
    seed = 8;
    enum { CELL = 4, ACROSS = SIZE / CELL, BACKS = 3000 };
    static const double halves[2][3][2] = {{{0, 0}, {0, 1}, {1, 1}}, {{0, 0}, {1, 1}, {1, 0}}};
    struct soup soup = {0, malloc((2 * ACROSS * ACROSS + BACKS) * 9 * sizeof(double))};
    double *c = soup.corners;
    for (int i = 0; i < BACKS; i++) {
        if (i == BACKS / 2) // the wall, in the middle of the numbers
            for (int n = 0; n < 2 * ACROSS * ACROSS; n++) {
                if (random_bits() % 50 == 0)
                    continue;
                for (int k = 0; k < 3; k++) {
                    *c++ = (n / 2 % ACROSS + halves[n % 2][k][0]) * CELL;
                    *c++ = (n / 2 / ACROSS + halves[n % 2][k][1]) * CELL;
                    *c++ = 0;
                }
            }
        double size = random_between(1, i % 10 ? 6 : 60), depth = ((int)(random_bits() % 9) - 7) / 64.0;
        double x = random_between(-size, SIZE), y = random_between(-size, SIZE);
        static const double places[3][2] = {{0, 0}, {1, 0}, {0.3, 1}};
        for (int k = 0; k < 3; k++) {
            *c++ = on_grid(x + size * places[k][0]);
            *c++ = on_grid(y + size * places[k][1]);
            *c++ = depth;
        }
    }
    soup.count = (int)((c - soup.corners) / 9);
    check(&soup, true);
}

// A jittered grid of triangles covers every sample exactly once: alpha shows no holes at 1, 4 and 16 samples.
TEST(test_watertight)
{
    seed = 6;
    enum { CELLS = 37 };
    static double grid[CELLS + 1][CELLS + 1][2];
    double cell = (double)(SIZE + 20) / CELLS;
    for (int j = 0; j <= CELLS; j++)
        for (int i = 0; i <= CELLS; i++) {
            grid[j][i][0] = i * cell - 10 + random_between(-0.4, 0.4) * cell; // deliberately off the snapping grid
            grid[j][i][1] = j * cell - 10 + random_between(-0.4, 0.4) * cell;
        }
    struct soup soup = {2 * CELLS * CELLS, malloc(2 * CELLS * CELLS * 9 * sizeof(double))};
    double *c = soup.corners;
    for (int j = 0; j < CELLS; j++)
        for (int i = 0; i < CELLS; i++) {
            const double *q[4] = {grid[j][i], grid[j][i + 1], grid[j + 1][i + 1], grid[j + 1][i]};
            int corners[6] = {0, 1, 2, 0, 2, 3};
            for (int k = 0; k < 6; k++) {
                *c++ = q[corners[k]][0];
                *c++ = q[corners[k]][1];
                *c++ = 0;
            }
        }
    AUTO_SCENE scene = scene_of(&soup, LAM_CULL_NONE);
    static const int samples[] = {1, 4, 16};
    for (int s = 0; s < 3; s++) {
        lam_error error = {0};
        AUTO_DEVICE device = lam_device_cpu(NULL, &error);
        lam_camera camera = {.eye = {SIZE / 2, SIZE / 2, 100},
                             .target = {SIZE / 2, SIZE / 2, 0},
                             .up = {0, 1, 0},
                             .ortho_half_height = SIZE / 2,
                             .near_plane = 1,
                             .far_plane = 199};
        lam_draw_params params = {.samples = samples[s], .reflection = LAM_REFLECTION_NONE};
        AUTO_IMAGE image = {0};
        assert_true(lam_image_make(&image, SIZE, SIZE, LAM_RGBA32F, &error));
        assert_true(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
        // Inside the jittered border, everything is covered.
        for (int y = 8; y < SIZE - 8; y++)
            for (int x = 8; x < SIZE - 8; x++)
                assert_true(((float *)image.pixels)[4 * (y * SIZE + x) + 3] == 1.0f);
    }
    free(soup.corners);
}

// The winding (y up) distinguishes front and back; each culling mode keeps the other side.
TEST(test_culling)
{
    seed = 7;
    struct soup soup = random_soup(200, 30);
    static float all[SIZE * SIZE], front[SIZE * SIZE], back[SIZE * SIZE];
    const lam_cull culls[] = {LAM_CULL_NONE, LAM_CULL_BACK, LAM_CULL_FRONT};
    float *out[] = {all, front, back};
    for (int i = 0; i < 3; i++) {
        AUTO_SCENE scene = scene_of(&soup, culls[i]);
        draw(scene, LAM_ISA_AUTO, 1, out[i]);
    }
    for (int i = 0; i < SIZE * SIZE; i++) {
        for (int s = 1; s < 3; s++) {
            if (out[s][i] == 0)
                continue;
            const double *c = soup.corners + 9 * ((int)out[s][i] - 1);
            // Conventions: front when (x3−x2)(y1−y2) − (y3−y2)(x1−x2) > 0 with y up.
            double y[3] = {-c[1], -c[4], -c[7]};
            double sign = (c[6] - c[3]) * (y[0] - y[1]) - (y[2] - y[1]) * (c[0] - c[3]);
            assert_true(s == 1 ? sign > 0 : sign < 0);
        }
        assert_true(all[i] == front[i] || all[i] == back[i]);
    }
    free(soup.corners);
}

// A tetrahedron of any size up to 1e33, fitted into a picture of odd size: every instruction set draws the coverage of
// size 1. A larger one is refused, because products of coordinates leave the range of floats.
TEST(test_sizes)
{
    enum { WIDTH = 33, HEIGHT = 31 };
    static const float corners[4][3] = {{-1, -1, -1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
    static const uint32_t indices[12] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    static uint8_t first[WIDTH * HEIGHT * 4], pixels[WIDTH * HEIGHT * 4];
    for (int orthographic = 0; orthographic < 2; orthographic++)
        for (int power = 0; power <= 38; power++) {
            lam_error error = {0};
            float positions[4][3];
            for (int i = 0; i < 12; i++)
                positions[i / 3][i % 3] = corners[i / 3][i % 3] * (float)pow(10, power);
            lam_mesh mesh = {.positions = positions[0], .indices = indices, .vertex_count = 4, .triangle_count = 4};
            AUTO_SCENE scene = lam_scene_make(NULL);
            lam_object object = lam_object_default();
            object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
            if (object.mesh < 0 || lam_scene_add_object(scene, &object, &error) < 0)
                fail_msg("%s", error.text);
            lam_camera camera = lam_camera_fit(scene, WIDTH, HEIGHT, &(lam_view){.orthographic = orthographic});
            lam_draw_params params = {.samples = 1, .output = LAM_OUTPUT_COVERAGE};
            for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++) {
                if (!lam_isa_usable((lam_isa)isa))
                    continue;
                AUTO_DEVICE device = lam_device_cpu(&(lam_cpu_params){.threads = 1, .isa = (lam_isa)isa}, &error);
                lam_image image = {.width = WIDTH, .height = HEIGHT, .format = LAM_RGBA8, .pixels = pixels};
                bool drawn = device && lam_draw(device, scene, &camera, &params, &image, NULL, &error);
                if (power > 33) {
                    assert_true(device && !drawn && error.code == LAM_UNSUPPORTED);
                    continue;
                }
                if (!drawn)
                    fail_msg("%s", error.text);
                if (power == 0 && isa == LAM_ISA_SCALAR)
                    memcpy(first, pixels, sizeof first);
                assert_memory_equal(pixels, first, sizeof first);
            }
        }
    int covered = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        covered += first[4 * i] > 0;
    assert_in_range(covered, 200, 900);
}
