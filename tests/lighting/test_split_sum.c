// test_split_sum.c: compares the environment's light on metallic-roughness materials with a split sum in double
// precision, implemented from docs/lighting/environment.md independently with libm: every part of it by quadrature of
// an environment given by a formula, a sky over a ground and three discs with soft edges.

#include "test.h"
#include "cpu_features.h"
#include "environment.h"
#include "environment_kernels.h"
#include "environment_scene.h"
#include "share.h"
#include "texture_map.h"

// --- the split sum in double

static void frame_around(const double n[3], double x[3], double y[3])
{
    double up[3] = {fabs(n[0]) < 0.6, fabs(n[0]) >= 0.6, 0};
    x[0] = up[1] * n[2] - up[2] * n[1];
    x[1] = up[2] * n[0] - up[0] * n[2];
    x[2] = up[0] * n[1] - up[1] * n[0];
    double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int i = 0; i < 3; i++)
        x[i] /= length;
    y[0] = n[1] * x[2] - n[2] * x[1];
    y[1] = n[2] * x[0] - n[0] * x[2];
    y[2] = n[0] * x[1] - n[1] * x[0];
}

// The mean of the light around an axis over rings: cosines and weights of the rings.
static void mean_around(const double axis[3], int rings, const double *cosine, const double *weight, double out[3])
{
    double x[3], y[3], total = 0;
    frame_around(axis, x, y);
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i < rings; i++) {
        double z = cosine[i], r = sqrt(fmax(0, 1 - z * z));
        for (int k = 0; k < rings; k++) {
            double angle = 2 * PI * (k + (i % 2) * 0.5) / rings, d[3], light[3];
            for (int j = 0; j < 3; j++)
                d[j] = x[j] * r * cos(angle) + y[j] * r * sin(angle) + axis[j] * z;
            radiance(d, light);
            for (int j = 0; j < 3; j++)
                out[j] += weight[i] * light[j];
            total += weight[i];
        }
    }
    for (int j = 0; j < 3; j++)
        out[j] /= total;
}

enum { RINGS = 130 };

// D(h) max(r.l, 0), from half vectors in which D(h) (h.n) is evenly dense, up to the point where l meets the horizon.
static void prefiltered(const double r[3], double roughness, double out[3])
{
    double alpha = roughness * roughness, square = alpha * alpha, cosine[RINGS], weight[RINGS];
    for (int i = 0; i < RINGS; i++) {
        double low = 1 - pow(1 - (double)i / RINGS, 2), high = 1 - pow(1 - (i + 1.0) / RINGS, 2);
        double u = (low + high) / 2 / (1 + square), h = (1 - u) / (1 + (square - 1) * u);
        cosine[i] = 2 * h - 1;
        weight[i] = (high - low) * cosine[i];
    }
    mean_around(r, RINGS, cosine, weight, out);
}

static void irradiance(const double n[3], double out[3])
{
    double cosine[RINGS], weight[RINGS];
    for (int i = 0; i < RINGS; i++) {
        cosine[i] = sqrt((i + 0.5) / RINGS);
        weight[i] = 1;
    }
    mean_around(n, RINGS, cosine, weight, out);
}

// The integrals of D V n.l and of the same times (1 - v.h)^5, over the half vectors h visible from v (Heitz 2018): G2 /
// G1 remains.
static void scale_and_bias(double n_dot_v, double roughness, double *scale, double *bias)
{
    enum { N = 64 };
    double alpha = roughness * roughness, square = alpha * alpha, v_x = sqrt(1 - n_dot_v * n_dot_v), sum[2] = {0};
    double s_x = alpha * v_x, length = sqrt(s_x * s_x + n_dot_v * n_dot_v), s_z = n_dot_v / length;
    s_x /= length;
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++) {
            // Rings are denser near the edge of the disc, where the slopes are beyond alpha.
            double rest = 1 - (i + 0.5) / N, r = sqrt(1 - pow(rest, 4)), angle = PI * (k + 0.5) / N,
                   side = r * sin(angle), lift = 0.5 * (1 + s_z);
            double a = (1 - lift) * sqrt(fmax(0, 1 - side * side)) + lift * r * cos(angle);
            double up = sqrt(fmax(0, 1 - a * a - side * side));
            double x = alpha * (up * s_x - a * s_z), y = alpha * side, z = fmax(a * s_x + up * s_z, 1e-9);
            double of_h = sqrt(x * x + y * y + z * z), v_h = fmax((x * v_x + z * n_dot_v) / of_h, 0);
            double l = 2 * v_h * z / of_h - n_dot_v;
            if (l <= 0)
                continue;
            double g_v = sqrt(n_dot_v * n_dot_v * (1 - square) + square), g_l = sqrt(l * l * (1 - square) + square);
            double share = 4 * pow(rest, 3) * l * (n_dot_v + g_v) / (l * g_v + n_dot_v * g_l);
            sum[0] += share;
            sum[1] += share * pow(1 - v_h, 5);
        }
    *bias = sum[1] / (N * N);
    *scale = sum[0] / (N * N) - *bias;
}

static void split_sum(const double n[3], const double v[3], const double base[3], double roughness, double metallic,
                      bool single, double out[3])
{
    double n_dot_v = n[0] * v[0] + n[1] * v[1] + n[2] * v[2], r[3], around[3], above[3], scale, bias;
    for (int i = 0; i < 3; i++)
        r[i] = 2 * n_dot_v * n[i] - v[i];
    prefiltered(r, roughness, around);
    irradiance(n, above);
    scale_and_bias(fmax(n_dot_v, 1e-4), roughness, &scale, &bias);
    double gain = single ? 0 : 1 / (scale + bias) - 1;
    for (int i = 0; i < 3; i++) {
        double glass = (0.04 * scale + bias) * (1 + 0.04 * gain),
               metal = (base[i] * scale + bias) * (1 + base[i] * gain);
        double diffuse = base[i] * above[i] * (1 - (0.04 * scale + bias));
        out[i] = (1 - metallic) * (diffuse + glass * around[i]) + metallic * metal * around[i];
    }
}

// --- pictures

static double mean_difference(bool single)
{
    lam_environment *environment = make_environment();
    lam_scene *scene =
        make_spheres(environment, (lam_rgb){(float)base_color[0], (float)base_color[1], (float)base_color[2]});
    lam_image picture = draw_spheres(
        scene, (lam_draw_params){.single_scattering = single, .specular_aa = LAM_SPECULAR_AA_OFF}, 0, LAM_ISA_AUTO);
    lam_image normals = draw_spheres(scene, (lam_draw_params){.output = LAM_OUTPUT_NORMALS}, 0, LAM_ISA_AUTO);
    double sum = 0, v[3] = {0, 0, 1};
    int count = 0;
    for (int at = 0; at < picture.width * picture.height; at += is_long() ? 17 : 53) {
        const float *pixel = (const float *)picture.pixels + 4 * (size_t)at,
                    *from = (const float *)normals.pixels + 4 * (size_t)at;
        if (from[3] == 0 || from[2] < 0.02f)
            continue;
        int column = at % picture.width / CELL, row = at / picture.width / CELL;
        double n[3] = {(double)from[0], (double)from[1], (double)from[2]}, expected[3];
        split_sum(n, v, base_color, (double)roughnesses[column], (double)row / (DOWN - 1), single, expected);
        for (int c = 0; c < 3; c++)
            sum += fabs((double)pixel[c] - expected[c]) / 3;
        count++;
    }
    lam_image_free(&picture);
    lam_image_free(&normals);
    lam_scene_free(scene);
    lam_environment_free(environment);
    assert_true(count > (is_long() ? 1000 : 320));
    return sum / count;
}

TEST(test_split_sum)
{
    for (int single = 0; single < 2; single++) {
        double mean = mean_difference(single);
        print_message("%s scattering: %.2g off in the mean\n", single ? "single" : "multiple", mean);
        assert_true(mean < 1e-3);
    }
}

// A white metal in a uniform environment of 1 returns all of its light, for any roughness.
TEST(test_white_furnace) { check_white_furnace((lam_draw_params){0}); }

TEST(test_same_bytes) { check_same_bytes((lam_draw_params){0}); }

// The sums are the same with every instruction set. With `alpha` of cube_sums_row < 0, it is the irradiance. The rows
// of the last face that cube_sums_row fills are opposite to rows of LAM_FACE_PZ.
TEST(test_kernels)
{
    enum { SIZE = 21, ROW = 3 * (SIZE + 2) }; // not a multiple of any number of lanes
    lam_error error;
    lam_environment *environment = make_environment();
    struct cube_chain chain;
    assert_true(cube_chain_make(&chain, environment, NULL, NULL, &error));
    struct cube_sums *sums = cube_sums_make(&chain, &error);
    assert_non_null(sums);
    struct lobe_cells cells = {.count = 60};
    for (int i = 0; i < cells.count; i++) {
        double angle = i * 2.4, away = i / 40.0, z = 1 - away, r = sqrt(1 - z * z);
        cells.cell[i] = (struct cell){(float)(r * cos(angle)), (float)(r * sin(angle)), (float)z, 1.0f / 60,
                                      &chain.cube[i % chain.count]};
    }
    static float texels[3][LAM_FACE_COUNT * (SIZE + 2) * ROW + CUBE_TEXELS_AFTER];
    for (int lanes = 0; lanes < 3; lanes++) {
        const struct environment_kernels *kernels = CPU_WIDEST(4 << lanes, environment_kernels);
        struct lam_environment out = {.size = SIZE, .texels = texels[lanes]};
        for (int row = 0; row < LAM_FACE_COUNT * SIZE; row++) {
            int face = row / SIZE, t = row % SIZE;
            if (t % 3 == 0)
                kernels->prefilter_row(&cells, 0, cells.count, t % 2 ? &chain.cube[2] : NULL, &out, face, t);
            else if (face % 2 == 0)
                kernels->cube_sums_row(sums, t % 3 == 1 ? -1 : 0.3, &out, face, t);
        }
        assert_memory_equal(texels[lanes], texels[0], sizeof *texels);
    }
    assert_true(cube_texel(&(struct lam_environment){.size = SIZE, .texels = texels[0]}, 5, 20, 19)[1] > 0);
    free(sums);
    cube_chain_free(&chain);
    lam_environment_free(environment);
}

// Cubes of any size are prefiltered, including the smallest, and light too strong for sums of floats stays finite.
TEST(test_any_size)
{
    lam_error error;
    for (int width = 2; width <= 46; width += 11) {
        AUTO_IMAGE image = {0};
        assert_true(lam_image_make(&image, 2 * (width / 2 * 2), width / 2 * 2, LAM_RGBA32F, &error));
        for (int i = 0; i < image.width * image.height * 4; i++)
            ((float *)image.pixels)[i] = i % 4 == 3 ? 1 : 2e38f;
        lam_environment *environment = lam_environment_from_image(&image, LAM_COLOR_SRGB, &error);
        assert_non_null(environment);
        const struct environment_light *light =
            environment_light(environment, ENVIRONMENT_LIGHT_ALL, NULL, NULL, &error);
        assert_non_null(light);
        assert_ptr_equal(light, environment_light(environment, ENVIRONMENT_LIGHT_ALL, NULL, NULL, &error));
        for (int i = 0; i <= ENVIRONMENT_LEVELS; i++) {
            const struct lam_environment *cube = i < ENVIRONMENT_LEVELS ? &light->level[i] : &light->irradiance;
            for (size_t k = 0; k < cube_bytes(cube->size) / sizeof(float); k++)
                if (!(fabsf(cube->texels[k] / 2e38f - 1) < 1e-4f))
                    fail_msg("level %d, number %zu: %g, expected 2e38", i, k, (double)cube->texels[k]);
        }
        AUTO_IMAGE texture = {0};
        assert_true(lam_environment_light_image(environment, &texture, NULL, &error));
        assert_int_equal(texture.width, ENVIRONMENT_LIGHT_WIDTH);
        const float *last = (const float *)texture.pixels + 4 * (size_t)environment_light_first(ENVIRONMENT_LEVELS);
        assert_memory_equal(last, light->irradiance.texels, 3 * sizeof(float));
        lam_environment_free(environment);
    }
}

// Levels made one after another, as frames request them, equal levels made together.
TEST(test_parts)
{
    lam_error error;
    lam_environment *whole = make_environment(), *parts = make_environment();
    const struct environment_light *all = environment_light(whole, ENVIRONMENT_LIGHT_ALL, NULL, NULL, &error);
    assert_int_equal(environment_light_parts(0, 0), 3 | 1 << ENVIRONMENT_LEVELS);
    assert_int_equal(environment_light_parts(11, 11), 3 << 10 | 1 << ENVIRONMENT_LEVELS);
    assert_int_equal(environment_light_parts(2.9f, 5.1f), 0x7c | 1 << ENVIRONMENT_LEVELS);
    assert_int_equal(environment_light_parts(0, 11), ENVIRONMENT_LIGHT_ALL);
    static const float asked[] = {10.5f, 3, 0, 7.9f, 5, 1, 9};
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        unsigned needed = environment_light_parts(asked[i], asked[i]);
        const struct environment_light *some = environment_light(parts, needed, NULL, NULL, &error);
        assert_true(some && (some->made & needed) == needed);
        assert_true(i > 0 || (some->made & 1 << 5) == 0);
        for (int k = 1; k <= ENVIRONMENT_LEVELS; k++) {
            const struct lam_environment *a = k < ENVIRONMENT_LEVELS ? &all->level[k] : &all->irradiance,
                                         *b = k < ENVIRONMENT_LEVELS ? &some->level[k] : &some->irradiance;
            if (some->made >> k & 1)
                assert_memory_equal(a->texels, b->texels, cube_bytes(a->size));
        }
    }
    lam_environment_free(whole);
    lam_environment_free(parts);
}

// Bounds of a map's numbers: of each channel, of pictures with and without alpha, of any size.
TEST(test_map_ranges)
{
    enum { SIDE = 23 };
    lam_error error;
    static uint8_t pixels[SIDE * SIDE][4];
    for (int i = 0; i < SIDE * SIDE; i++)
        for (int c = 0; c < 4; c++)
            pixels[i][c] = (uint8_t)(60 + 30 * c + i * 7 % 20); // the last texels contain neither bound
    for (int opaque = 0; opaque < 2; opaque++) {
        for (int i = 0; i < SIDE * SIDE && opaque; i++)
            pixels[i][3] = 255;
        lam_image image = {.width = SIDE, .height = SIDE, .format = LAM_RGBA8, .pixels = pixels};
        lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_NUMBERS, NULL, &error);
        assert_non_null(texture);
        for (int c = 0; c < 4; c++) {
            lam_texture_map map = {.texture = texture, .channel = c};
            float range[2];
            texture_map_range(&map, range);
            assert_true(fabsf(range[0] * 255 - (c == 3 && opaque ? 255.0f : 60.0f + 30.0f * (float)c)) < 1e-4f);
            assert_true(fabsf(range[1] * 255 - (c == 3 && opaque ? 255.0f : 79.0f + 30.0f * (float)c)) < 1e-4f);
            map.scale = -1;
            map.offset = 1;
            float turned[2];
            texture_map_range(&map, turned);
            assert_true(turned[0] == 1 - range[1] && turned[1] == 1 - range[0]);
        }
        lam_texture_free(texture);
    }
    float number[4] = {0.5f, 0.5f, 0.5f, 1}, range[2];
    lam_image image = {.width = 1, .height = 1, .format = LAM_RGBA32F, .pixels = number};
    lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_NUMBERS, NULL, &error);
    texture_map_range(&(lam_texture_map){.texture = texture}, range);
    assert_true(range[0] <= 0.5f && range[1] >= 0.5f);
    lam_texture_free(texture);
}

// Only the levels that a map's roughnesses need are made, and the picture equals the picture with all levels.
TEST(test_levels_of_maps)
{
    lam_error error;
    lam_environment *whole = make_environment(), *parts = make_environment();
    static uint8_t pixels[64][4];
    for (int i = 0; i < 64; i++)
        memcpy(pixels[i], (uint8_t[]){(uint8_t)(120 + i), (uint8_t)(140 + i), 0, 255}, 4);
    lam_image image = {.width = 8, .height = 8, .format = LAM_RGBA8, .pixels = pixels};
    lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_NUMBERS, NULL, &error);
    const lam_texture_map rough = {.texture = texture, .channel = 1}, coat = {.texture = texture};
    lam_image pictures[2];
    assert_non_null(environment_light(whole, ENVIRONMENT_LIGHT_ALL, NULL, NULL, &error));
    for (int i = 0; i < 2; i++) {
        AUTO_SCENE scene = lam_scene_make(&error);
        lam_material material = lam_material_default();
        material.physical = true;
        material.roughness = 0.9f;
        material.clearcoat = 1;
        material.clearcoat_roughness = 0.25f;
        material.maps[LAM_MAP_ROUGHNESS] = &rough;
        material.maps[LAM_MAP_CLEARCOAT_ROUGHNESS] = &coat;
        lam_object object = lam_object_default();
        object.mesh = lam_scene_add_shape(scene, "sphere", NULL, &error);
        object.material = lam_scene_add_material(scene, &material, &error);
        assert_true(object.material >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
        assert_true(lam_scene_set_environment(scene, i ? parts : whole, 0, &error));
        pictures[i] = draw_spheres(scene, (lam_draw_params){0}, 2, LAM_ISA_AUTO);
    }
    assert_memory_equal(pictures[0].pixels, pictures[1].pixels,
                        (size_t)pictures[0].width * (size_t)pictures[0].height * 16);
    // The coat needs 0.25 · 120 / 255 to 0.25, levels 2.3 to 5.01; the base needs 0.49 to 0.9, levels 7.7 to 10.5.
    assert_int_equal(parts->light->made, 1 | 0x7c | 0xf80 | 1 << ENVIRONMENT_LEVELS);
    for (int i = 0; i < 2; i++)
        lam_image_free(&pictures[i]);
    lam_texture_free(texture);
    lam_environment_free(whole);
    lam_environment_free(parts);
}
