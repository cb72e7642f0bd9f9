// test_reference.c: compares the integral of environment light by fixed directions (lam_draw_params.reference) with
// quadrature in double precision, implemented from docs/lighting/physical.md independently with libm.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "environment_scene.h"

static double inner(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The light that a point returns, over pi, from a fine grid of directions in the half space above it. For the diffuse
// part, rings are even in the square of the sine around the normal; for the highlight, around the mirrored direction,
// even in GGX's distribution of half vectors, so that each lobe is resolved.
static void frame_around(const double n[3], double x[3], double y[3])
{
    int far = fabs(n[0]) < 0.6 ? 0 : 1;
    double along = n[far], length = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = (i == far) - along * n[i];
        length += x[i] * x[i];
    }
    for (int i = 0; i < 3; i++)
        x[i] /= sqrt(length);
    for (int i = 0; i < 3; i++)
        y[i] = n[(i + 1) % 3] * x[(i + 2) % 3] - n[(i + 2) % 3] * x[(i + 1) % 3];
}

enum { RINGS = 300 };

static void add_scaled(double sum[3], const double color[3], double by)
{
    for (int i = 0; i < 3; i++)
        sum[i] += color[i] * by;
}

// Sums the light over its half vectors h around n: D (n.h) of them are evenly dense, and l has 4 (v.h) times as large a
// solid angle.
static void specular_integral(const double n[3], const double v[3], double roughness, double plain[3], double bent[3])
{
    double x[3], y[3], square = pow(roughness, 4), n_v = inner(n, v);
    frame_around(n, x, y);
    memset(plain, 0, 3 * sizeof *plain);
    memset(bent, 0, 3 * sizeof *bent);
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < RINGS; k++) {
            // Rings are denser near u = 1, the slopes of the lobe's far parts.
            double low = 1 - pow(1 - (double)i / RINGS, 3), high = 1 - pow(1 - (i + 1.0) / RINGS, 3),
                   u = (low + high) / 2;
            double angle = 2 * PI * (k + (i % 2) * 0.5) / RINGS;
            double n_h = sqrt((1 - u) / (1 + (square - 1) * u)), sine = sqrt(fmax(0, 1 - n_h * n_h)), h[3], l[3];
            for (int j = 0; j < 3; j++)
                h[j] = x[j] * sine * cos(angle) + y[j] * sine * sin(angle) + n[j] * n_h;
            double v_h = inner(v, h);
            for (int j = 0; j < 3; j++)
                l[j] = 2 * v_h * h[j] - v[j];
            double n_l = inner(n, l), light[3];
            if (v_h <= 0 || n_l <= 0)
                continue;
            double visible =
                0.5 / (n_l * sqrt(n_v * n_v * (1 - square) + square) + n_v * sqrt(n_l * n_l * (1 - square) + square));
            double weight = visible * n_l * 4 * v_h / n_h * (high - low) / RINGS;
            radiance(l, light);
            add_scaled(plain, light, weight);
            add_scaled(bent, light, weight * pow(1 - v_h, 5));
        }
}

static void diffuse_integral(const double n[3], const double v[3], double out[3])
{
    double x[3], y[3];
    frame_around(n, x, y);
    memset(out, 0, 3 * sizeof *out);
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < RINGS; k++) {
            double square = (i + 0.5) / RINGS, angle = 2 * PI * (k + (i % 2) * 0.5) / RINGS, l[3], light[3], sum = 0;
            for (int j = 0; j < 3; j++) {
                l[j] = (x[j] * cos(angle) + y[j] * sin(angle)) * sqrt(square) + n[j] * sqrt(1 - square);
                sum += (l[j] + v[j]) * (l[j] + v[j]);
            }
            double v_h = sqrt(sum) / 2;
            radiance(l, light);
            add_scaled(out, light, (1 - (0.04 + 0.96 * pow(1 - v_h, 5))) / (RINGS * RINGS));
        }
}

static void integral(const double n[3], const double v[3], double roughness, double metallic, double out[3])
{
    double plain[3], bent[3], matt[3];
    specular_integral(n, v, roughness, plain, bent);
    diffuse_integral(n, v, matt);
    for (int i = 0; i < 3; i++) {
        double dielectric = base_color[i] * matt[i] + 0.04 * (plain[i] - bent[i]) + bent[i];
        double metal = base_color[i] * (plain[i] - bent[i]) + bent[i];
        out[i] = (1 - metallic) * dielectric + metallic * metal;
    }
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// The sorted relative differences between a picture's channels and the integral at some pixels of each sphere.
static size_t differences(int count, double *out, size_t capacity)
{
    lam_environment *environment = make_environment();
    lam_scene *scene =
        make_spheres(environment, (lam_rgb){(float)base_color[0], (float)base_color[1], (float)base_color[2]});
    lam_image picture =
        draw_spheres(scene, (lam_draw_params){.single_scattering = true, .reference = count}, 0, LAM_ISA_AUTO);
    lam_image normals = draw_spheres(scene, (lam_draw_params){.output = LAM_OUTPUT_NORMALS}, 0, LAM_ISA_AUTO);
    const double v[3] = {0, 0, 1};
    size_t found = 0;
    for (int at = 0; at < picture.width * picture.height; at += 613) {
        const float *pixel = (const float *)picture.pixels + 4 * (size_t)at,
                    *from = (const float *)normals.pixels + 4 * (size_t)at;
        if (from[3] == 0 || from[2] < 0.1f)
            continue;
        int column = at % picture.width / CELL, row = at / picture.width / CELL;
        double n[3] = {(double)from[0], (double)from[1], (double)from[2]}, expected[3];
        integral(n, v, (double)roughnesses[column], (double)row / (DOWN - 1), expected);
        for (int c = 0; c < 3 && found < capacity; c++)
            out[found++] = fabs((double)pixel[c] - expected[c]) / fmax(expected[c], 0.05);
    }
    lam_image_free(&picture);
    lam_image_free(&normals);
    lam_scene_free(scene);
    lam_environment_free(environment);
    qsort(out, found, sizeof *out, ascending);
    return found;
}

// 4096 directions are within 0.2 % of the integral for half of the points, and within 0.5 % for nine tenths.
static void test_integral(void **state)
{
    (void)state;
    static double out[1000];
    size_t count = differences(4096, out, 1000);
    assert_true(count > 150);
    print_message("4096 directions: off by %.2g for half, %.2g for nine tenths, %.2g at most, of %zu numbers\n",
                  out[count / 2], out[count * 9 / 10], out[count - 1], count);
    assert_true(out[count / 2] < 0.002 && out[count * 9 / 10] < 0.005);
}

// In a uniform environment, a white metal returns all light, and half as many directions do not change that.
static void test_white_furnace(void **state)
{
    (void)state;
    check_white_furnace((lam_draw_params){.reference = 1024});
}

static void test_same_bytes(void **state)
{
    (void)state;
    check_same_bytes((lam_draw_params){.reference = 19});
}

// An environment without light, one with light in a single texel, and numbers out of range.
static void test_limits(void **state)
{
    (void)state;
    lam_error error;
    lam_image image = {0};
    assert_true(lam_image_make(&image, 64, 32, LAM_RGBA32F, &error));
    memset(image.pixels, 0, 64 * 32 * 16);
    for (int lit = 0; lit < 2; lit++) {
        for (int c = 0; c < 4 * lit; c++)
            ((float *)image.pixels)[4 * (8 * 64 + 20) + c] = 1e6f;
        lam_environment *environment = lam_environment_from_image(&image, LAM_COLOR_SRGB, &error);
        assert_non_null(environment);
        lam_scene *scene = make_spheres(environment, (lam_rgb){1, 1, 1});
        lam_image picture = draw_spheres(scene, (lam_draw_params){.reference = 64}, 0, LAM_ISA_AUTO);
        double sum = 0;
        for (int i = 0; i < picture.width * picture.height * 4; i++) {
            float x = ((const float *)picture.pixels)[i];
            assert_true(x >= 0 && x < 1e30f);
            sum += i % 4 < 3 ? (double)x : 0;
        }
        assert_true(lit ? sum > 1e4 : sum == 0);
        lam_image_free(&picture);
        lam_scene_free(scene);
        lam_environment_free(environment);
    }
    lam_scene *scene = lam_scene_make(&error);
    lam_device *device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_default();
    static const int wrong[] = {-1, 1, 15, (1 << 20) + 1};
    for (int i = 0; i < 4; i++) {
        lam_draw_params params = {.reference = wrong[i]};
        assert_false(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_non_null(strstr(error.text, "reference is"));
    }
    lam_device_free(device);
    lam_scene_free(scene);
    lam_image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_integral), cmocka_unit_test(test_white_furnace),
                                       cmocka_unit_test(test_same_bytes), cmocka_unit_test(test_limits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
