// test_specular_aa.c: specular antialiasing: compares small pictures of bumpy surfaces with one sample per pixel with
// the means of large ones.

#include "test.h"

#include <lambent/device.h>
#include <lambent/material.h>

enum { SIDE = 64, FINE = 8 * SIDE, TEXELS = 256 };

// A normal map of round bumps, each a few texels wide.
static lam_texture *bumps(void)
{
    static uint8_t pixels[TEXELS][TEXELS][3];
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++) {
            double a = 0.5 * cos(2 * 3.14159265358979 * x / 8), b = 0.5 * cos(2 * 3.14159265358979 * y / 8);
            double length = sqrt(a * a + b * b + 1);
            pixels[y][x][0] = (uint8_t)(127.5 * (a / length + 1) + 0.5);
            pixels[y][x][1] = (uint8_t)(127.5 * (b / length + 1) + 0.5);
            pixels[y][x][2] = (uint8_t)(127.5 * (1 / length + 1) + 0.5);
        }
    lam_image image = {
        .width = TEXELS, .height = TEXELS, .format = LAM_RGB8, .pixels = pixels, .stride = sizeof pixels[0]};
    lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_NUMBERS, "bumps", NULL);
    assert_non_null(texture);
    return texture;
}

// A smooth metal that mirrors the studio, with bumps from a map or from the mesh.
static lam_scene *scene_of(bool mapped, lam_texture *texture)
{
    lam_error error;
    lam_scene *scene = lam_scene_make(&error);
    const lam_shape_params shape = {.slices = mapped ? 96 : 40, .stacks = 48};
    assert_int_equal(lam_scene_add_shape(scene, mapped ? "sphere" : "gyroid", &shape, &error), 0);
    lam_texture_map map = {.texture = texture, .transform = {{4, 0, 0}, {0, 4, 0}}};
    lam_material material = lam_material_default();
    material.physical = true;
    material.metallic = 1;
    material.diffuse = (lam_rgba){1, 1, 1, 1};
    material.roughness = 0.1f;
    if (mapped)
        material.maps[LAM_MAP_NORMAL] = &map;
    lam_object object = lam_object_default();
    object.material = lam_scene_add_material(scene, &material, &error);
    assert_true(object.material >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    assert_true(lam_scene_make_tangents(scene, NULL, &error));
    return scene;
}

static lam_image draw(const lam_scene *scene, int side, lam_draw_params params)
{
    lam_error error;
    lam_device *device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){0, 0, 6};
    lam_image image;
    params.samples = 1;
    params.occlusion = LAM_OCCLUSION_OFF; // which depends on the picture's size
    assert_true(lam_image_make(&image, side, side, LAM_RGBA32F, &error));
    SUCCEEDS(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    lam_device_free(device);
    return image;
}

// The root mean square difference between a small picture and the means of a large one, tone-mapped: x / (1 + x).
static double difference(const lam_image *small, const lam_image *large)
{
    double sum = 0;
    int count = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const float *at = (const float *)small->pixels + 4 * ((size_t)y * SIDE + (size_t)x);
            double mean = 0, alpha = 0;
            for (int i = 0; i < 64; i++) {
                const float *fine =
                    (const float *)large->pixels + 4 * ((size_t)(8 * y + i / 8) * FINE + (size_t)(8 * x + i % 8));
                mean += (double)fine[1] / 64;
                alpha += (double)fine[3] / 64;
            }
            if (alpha < 1 || at[3] < 1)
                continue;
            double apart = (double)at[1] / (1 + (double)at[1]) - mean / (1 + mean);
            sum += apart * apart;
            count++;
        }
    assert_true(count > 800);
    return sqrt(sum / count);
}

// It moves pixels closer to the means over their area, which the exact equations give in a large picture.
TEST(test_nearer)
{
    for (int mapped = 0; mapped < 2; mapped++) {
        lam_texture *texture = bumps();
        AUTO_SCENE scene = scene_of(mapped, texture);
        lam_image large = draw(scene, FINE, (lam_draw_params){.specular_aa = LAM_SPECULAR_AA_OFF}),
                  exact = draw(scene, SIDE, (lam_draw_params){.specular_aa = LAM_SPECULAR_AA_OFF}),
                  smooth = draw(scene, SIDE, (lam_draw_params){.specular_aa = LAM_SPECULAR_AA_ON}),
                  automatic = draw(scene, SIDE, (lam_draw_params){0});
        double off = difference(&exact, &large), on = difference(&smooth, &large);
        print_message("%s: %.3f without, %.3f with\n", mapped ? "normal map" : "mesh", off, on);
        assert_true(on < (mapped ? 0.65 : 0.9) * off);
        assert_memory_equal(automatic.pixels, smooth.pixels, SIDE * SIDE * 16); // the default in the studio
        lam_image_free(&large);
        lam_image_free(&exact);
        lam_image_free(&smooth);
        lam_image_free(&automatic);
        lam_texture_free(texture);
    }
}

// Flat surfaces keep their bits, and shading at vertices is an error.
TEST(test_flat)
{
    lam_error error;
    AUTO_SCENE scene = lam_scene_make(&error);
    assert_int_equal(lam_scene_add_shape(scene, "cube", NULL, &error), 0);
    lam_material material = lam_material_default();
    material.physical = true;
    material.roughness = 0.2f;
    lam_object object = lam_object_default();
    object.material = lam_scene_add_material(scene, &material, &error);
    assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
    lam_image exact = draw(scene, SIDE, (lam_draw_params){.rig = LAM_RIG_STUDIO, .specular_aa = LAM_SPECULAR_AA_OFF}),
              flat = draw(scene, SIDE, (lam_draw_params){.rig = LAM_RIG_STUDIO, .specular_aa = LAM_SPECULAR_AA_ON});
    assert_memory_equal(exact.pixels, flat.pixels, SIDE * SIDE * 16);
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_default();
    lam_draw_params params = {.shading = LAM_SHADING_GOURAUD, .specular_aa = LAM_SPECULAR_AA_ON};
    assert_false(lam_draw(device, scene, &camera, &params, &flat, NULL, &error));
    assert_non_null(strstr(error.text, "specular antialiasing widens highlights at each pixel"));
    params = (lam_draw_params){.specular_aa = LAM_SPECULAR_AA_COUNT};
    assert_false(lam_draw(device, scene, &camera, &params, &flat, NULL, &error));
    lam_image_free(&exact);
    lam_image_free(&flat);
}
