// environment_scene.c: spheres under an environment given by a formula.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "environment_scene.h"

#include <math.h>

// --- the environment

void radiance(const double d[3], double out[3])
{
    static const double a[3] = {0.45, 0.48, 0.55}, b[3] = {0.15, 0.20, 0.35}, c[3] = {-0.05, 0.00, 0.10};
    static const struct {
        double axis[3], sharpness, color[3];
    } discs[3] = {{{0.5, 0.7, 0.5}, 300, {40, 36, 30}},
                  {{-0.8, 0.3, 0.4}, 80, {4, 6, 10}},
                  {{0.1, 0.2, -1.0}, 1000, {60, 20, 10}}};
    for (int i = 0; i < 3; i++)
        out[i] = a[i] + b[i] * d[1] + c[i] * d[1] * d[1];
    for (int k = 0; k < 3; k++) {
        const double *axis = discs[k].axis;
        double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
        double cosine = (d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]) / length;
        double power = discs[k].sharpness * (cosine - 1);
        for (int i = 0; i < 3 && power > -40; i++)
            out[i] += discs[k].color[i] * exp(power);
    }
}

lam_environment *make_environment(void)
{
    lam_error error;
    lam_image image = {0};
    assert_true(lam_image_make(&image, 1024, 512, LAM_RGBA32F, &error));
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++) {
            double along = ((x + 0.5) / image.width - 0.5) * 2 * PI, down = (y + 0.5) / image.height * PI;
            double light[3], d[3] = {sin(down) * sin(along), cos(down), -sin(down) * cos(along)};
            radiance(d, light);
            float *pixel = (float *)image.pixels + 4 * ((size_t)y * 1024 + (size_t)x);
            for (int c = 0; c < 3; c++)
                pixel[c] = (float)light[c];
            pixel[3] = 1;
        }
    lam_environment *environment = lam_environment_from_image(&image, LAM_COLOR_SRGB, &error);
    assert_non_null(environment);
    lam_image_free(&image);
    return environment;
}

// --- pictures

const float roughnesses[ACROSS] = {0.1f, 0.2f, 0.3f, 0.45f, 0.6f, 0.8f, 1.0f};
const double base_color[3] = {0.9, 0.55, 0.2};

lam_scene *make_spheres(const lam_environment *environment, lam_rgb color)
{
    lam_error error;
    lam_scene *scene = lam_scene_make(&error);
    assert_non_null(scene);
    int mesh = lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 128, .stacks = 128}, &error);
    for (int row = 0; row < DOWN; row++)
        for (int i = 0; i < ACROSS; i++) {
            lam_material material = lam_material_default();
            material.physical = true;
            material.diffuse = (lam_rgba){color.r, color.g, color.b, 1};
            material.roughness = roughnesses[i];
            material.metallic = (float)row / (DOWN - 1);
            lam_object object = lam_object_default();
            object.mesh = mesh;
            object.material = lam_scene_add_material(scene, &material, &error);
            object.transform.m[0][3] = 2.2 * (i - (ACROSS - 1) / 2.0);
            object.transform.m[1][3] = 2.2 * ((DOWN - 1) / 2.0 - row);
            assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
        }
    assert_true(lam_scene_set_environment(scene, environment, 0, &error));
    return scene;
}

lam_image draw_spheres(const lam_scene *scene, lam_draw_params params, int threads, lam_isa isa)
{
    lam_error error;
    lam_camera camera = {.eye = {0, 0, 24}, .up = {0, 1, 0}, .ortho_half_height = 1.1 * DOWN};
    lam_image image = {0};
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = threads, .isa = isa}, &error);
    assert_true(lam_image_make(&image, ACROSS * CELL, DOWN * CELL, LAM_RGBA32F, &error));
    params.samples = 1;
    params.rig = LAM_RIG_NONE;
    params.occlusion = LAM_OCCLUSION_OFF; // neighbours would occlude one another
    if (!device || !lam_draw(device, scene, &camera, &params, &image, NULL, &error))
        fail_msg("%s", error.text);
    lam_device_free(device);
    return image;
}

void check_white_furnace(lam_draw_params params)
{
    lam_error error;
    lam_image white = {0};
    assert_true(lam_image_make(&white, 64, 32, LAM_RGBA32F, &error));
    for (int i = 0; i < 64 * 32 * 4; i++)
        ((float *)white.pixels)[i] = 1;
    lam_environment *environment = lam_environment_from_image(&white, LAM_COLOR_SRGB, &error);
    lam_scene *scene = make_spheres(environment, (lam_rgb){1, 1, 1});
    lam_image picture = draw_spheres(scene, params, 0, LAM_ISA_AUTO);
    int count = 0;
    for (int y = (DOWN - 1) * CELL; y < picture.height; y++)
        for (int x = 0; x < picture.width; x++) {
            const float *pixel = (const float *)picture.pixels + 4 * ((size_t)y * (size_t)picture.width + (size_t)x);
            if (pixel[3] == 0)
                continue;
            count++;
            for (int c = 0; c < 3; c++)
                if (fabsf(pixel[c] - 1) > 0.01f)
                    fail_msg("pixel %d, %d: %g, expected 1", x, y, (double)pixel[c]);
        }
    assert_true(count > 5000);
    lam_image_free(&picture);
    lam_image_free(&white);
    lam_scene_free(scene);
    lam_environment_free(environment);
}

void check_same_bytes(lam_draw_params params)
{
    static const int threads[] = {1, 2, 5};
    lam_image first = {0};
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++) {
        if (!lam_isa_usable((lam_isa)isa))
            continue;
        lam_environment *environment = make_environment();
        lam_scene *scene = make_spheres(environment, (lam_rgb){0.9f, 0.55f, 0.2f});
        lam_image picture = draw_spheres(scene, params, threads[isa % 3], (lam_isa)isa);
        if (!first.pixels)
            first = picture;
        else
            assert_memory_equal(first.pixels, picture.pixels, (size_t)picture.width * (size_t)picture.height * 16);
        if (picture.pixels != first.pixels)
            lam_image_free(&picture);
        lam_scene_free(scene);
        lam_environment_free(environment);
    }
    lam_image_free(&first);
}
