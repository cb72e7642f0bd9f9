// test_texture_filter.c: textures filtered by the graphics card (lam_gl_params.hardware_filter): the difference from
// exact filters, every wrap and filter, anisotropy, formats, uploads, samplers that stay bound, printed shaders.
#include "card.h"
#include "floor_scene.h"
#include "scenes.h"

#include <lambent/gl.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 96, MODES_MAX = 32 };

static lam_device *cpu, *exact[2], *hardware[2]; // OpenGL 3.3 and OpenGL ES 3.0; NULL if not available
static const lam_draw_params plain;

// The mean and the largest difference of encoded channels in 0…1.
struct difference {
    double mean, worst;
};

static struct difference difference_of(const lam_image *a, const lam_image *b)
{
    struct difference d = {0, 0};
    const float *p = a->pixels, *q = b->pixels;
    size_t count = (size_t)a->width * (size_t)a->height * 4, channels = 0;
    assert_true(a->format == LAM_RGBA32F && b->format == LAM_RGBA32F && a->stride == b->stride);
    for (size_t i = 0; i < count; i++) {
        if (i % 4 == 3 || (!(p[i / 4 * 4 + 3] > 0) && !(q[i / 4 * 4 + 3] > 0)))
            continue;
        double one = fabs(encoded(p[i]) - encoded(q[i]));
        if (!(one <= 1))
            fail_msg("pixel %zu, %zu: %g and %g", i / 4 % (size_t)a->width, i / 4 / (size_t)a->width, (double)p[i],
                     (double)q[i]);
        d.worst = one > d.worst ? one : d.worst;
        d.mean += one;
        channels++;
    }
    assert_true(channels > 0);
    d.mean /= (double)channels;
    return d;
}

// Textured scenes, and the limits of their difference from the CPU device's pictures, as in docs/opengl.md.
static const struct {
    const char *name;
    double mean, worst;
} textured[] = {{"textured", 0.002, 0.25},
                {"textured-classic", 0.002, 0.03},
                {"textured-as-phong", 0.002, 0.1},
                {"textured-gouraud", 0.002, 0.03},
                {"masked", 0.002, 1},
                {"textured-layers", 0.002, 0.25}};

static void scenes_are_near(void **state)
{
    (void)state;
    if (!hardware[0] && !hardware[1])
        skip();
    for (size_t i = 0; i < sizeof textured / sizeof *textured; i++) {
        struct demo demo;
        lam_error error = {0};
        if (!demo_build_named(textured[i].name, &demo, &error))
            fail_msg("%s", error.text);
        lam_image images[4] = {{0}};
        for (int k = 0; k < 4; k++) {
            lam_device *device = k == 0 ? cpu : k == 1 ? exact[0] : hardware[k - 2];
            lam_draw_params params = demo.params;
            params.samples = 1;
            params.anisotropy = 1; // cards differ in where they sample long footprints
            if (device && (!lam_image_make(&images[k], demo.width, demo.height, LAM_RGBA32F, &error) ||
                           !lam_draw(device, demo.scene, &demo.camera, &params, &images[k], NULL, &error)))
                fail_msg("%s: %s", textured[i].name, error.text);
        }
        for (int k = 2; k < 4; k++) {
            if (!images[k].pixels)
                continue;
            struct difference d = difference_of(&images[0], &images[k]);
            print_message("%s, %s: mean %.2e, worst %.3f\n", textured[i].name, k == 2 ? "gl" : "gles", d.mean, d.worst);
            bool card = is_card(lam_device_name(hardware[k - 2]));
            double mean = (card ? 2 : 1) * textured[i].mean,
                   worst = card ? fmax(textured[i].worst, 0.25) : textured[i].worst;
            if (d.mean > mean || d.worst > worst)
                fail_msg("%s: mean %g, worst %g, expected at most %g, %g", textured[i].name, d.mean, d.worst, mean,
                         worst);
            if (images[1].pixels && difference_of(&images[1], &images[k]).worst == 0)
                fail_msg("%s: the picture equals the picture of the shader's filters", textured[i].name);
        }
        for (int k = 0; k < 4; k++)
            lam_image_free(&images[k]);
        lam_scene_free(demo.scene);
    }
}

// The picture of each wrapping and filtering mode is closest to the CPU device's picture of the same mode.
static void modes_are_kept(void **state)
{
    (void)state;
    if (!hardware[0] && !hardware[1])
        skip();
    lam_texture *texture = random_texture(20, 13, 1);
    lam_image wanted[MODES_MAX], drawn[MODES_MAX];
    char names[MODES_MAX][64];
    int count = 0;
    for (int wrap = 0; wrap < LAM_WRAP_COUNT * LAM_WRAP_COUNT; wrap++)
        for (int how = 0; how < 4 * LAM_MIP_COUNT; how++) {
            if (wrap && how) // the filters with one wrap, the wraps with one filter
                continue;
            lam_texture_map map = {.texture = texture,
                                   .wrap_s = (lam_wrap)(wrap % 3),
                                   .wrap_t = (lam_wrap)(wrap / 3),
                                   .magnify = (lam_filter)(how % 2),
                                   .minify = (lam_filter)(how / 2 % 2),
                                   .mip = (lam_mip)(how / 4)};
            lam_scene *scene = floor_scene(&map);
            lam_device *device = hardware[count % 2] ? hardware[count % 2] : hardware[!(count % 2)];
            snprintf(names[count], sizeof *names, "wraps %d %d, filters %d %d %d", wrap % 3, wrap / 3, how % 2,
                     how / 2 % 2, how / 4);
            wanted[count] = floor_draw(cpu, scene, SIZE, 1, &plain);
            drawn[count++] = floor_draw(device, scene, SIZE, 1, &plain);
            lam_scene_free(scene);
        }
    for (int i = 0; i < count; i++) {
        double own = difference_of(&wanted[i], &drawn[i]).mean;
        if (own > 0.03)
            fail_msg("%s: mean %g", names[i], own);
        for (int k = 0; k < count; k++)
            if (k != i && difference_of(&wanted[k], &drawn[i]).mean <= own)
                fail_msg("%s is nearer to %s", names[i], names[k]);
    }
    for (int i = 0; i < count; i++) {
        lam_image_free(&wanted[i]);
        lam_image_free(&drawn[i]);
    }
    lam_texture_free(texture);
}

// How much a picture's red varies: the mean square around the mean.
static double variance_of(const lam_image *image)
{
    double sum = 0, squares = 0, count = (double)image->width * image->height;
    for (int i = 0; i < image->width * image->height; i++) {
        double red = encoded(((const float *)image->pixels)[4 * i]);
        sum += red / count;
        squares += red * red / count;
    }
    return squares - sum * sum;
}

// More probes give sharper pictures if the driver supports them, and one sampler serves frames with different numbers.
static void anisotropy(void **state)
{
    (void)state;
    lam_error error = {0};
    lam_image stripes = {0};
    assert_true(lam_image_make(&stripes, 64, 64, LAM_RGBA8, &error));
    for (int i = 0; i < 64 * 64 * 4; i++)
        ((uint8_t *)stripes.pixels)[i] = i % 4 == 3 || i / 4 % 64 / 8 % 2 ? 255 : 20;
    lam_texture *texture = lam_texture_make(&stripes, LAM_TEXTURE_COLOR, NULL, &error);
    assert_non_null(texture);
    lam_image_free(&stripes);
    for (int g = 0; g < 2; g++) {
        if (!hardware[g])
            continue;
        lam_texture_map map = {.texture = texture, .transform = {{1, 0, 0}, {0, 16, 0}}}; // long footprints
        lam_scene *scene = floor_scene(&map);
        lam_image images[3];
        for (int i = 0; i < 3; i++)
            images[i] = floor_draw(hardware[g], scene, SIZE, i == 1 ? 16 : 1, &plain);
        bool has = difference_of(&images[0], &images[1]).worst > 0;
        if (strstr(lam_device_name(hardware[g]), "llvmpipe"))
            assert_true(has);
        assert_true(!has || variance_of(&images[1]) > 1.1 * variance_of(&images[0]));
        assert_memory_equal(images[0].pixels, images[2].pixels, (size_t)SIZE * SIZE * 16);
        for (int i = 0; i < 3; i++)
            lam_image_free(&images[i]);
        lam_scene_free(scene);
    }
    lam_texture_free(texture);
}

// Floats beyond 0…1, and beyond the range of 16 bits.
static void large_numbers(void **state)
{
    (void)state;
    lam_texture *bright = random_texture(33, 64, 8), *huge = random_texture(8, 8, 1.0e6f);
    for (int g = 0; g < 2; g++) {
        if (!hardware[g])
            continue;
        lam_texture_map maps[] = {
            {.texture = bright, .scale = 0.125f},
            {.texture = huge, .scale = 1 / 65504.0f, .magnify = LAM_FILTER_NEAREST, .mip = LAM_MIP_NONE}};
        for (int i = 0; i < 2; i++) {
            lam_scene *scene = floor_scene(&maps[i]);
            lam_image a = floor_draw(cpu, scene, SIZE, 1, &plain), b = floor_draw(hardware[g], scene, SIZE, 1, &plain);
            const float *p = b.pixels;
            float most = 0;
            for (int k = 0; k < SIZE * SIZE * 4; k++)
                most = k % 4 < 3 && p[k] > most ? p[k] : most;
            if (i == 0)
                assert_true(difference_of(&a, &b).mean < 0.01);
            else
                assert_true(most > 0.99f && most < 1.01f);
            lam_image_free(&a);
            lam_image_free(&b);
            lam_scene_free(scene);
        }
    }
    lam_texture_free(bright);
    lam_texture_free(huge);
}

// 8-bit texels are uploaded unchanged, once.
static void uploads(void **state)
{
    (void)state;
    if (!hardware[0])
        skip();
    lam_texture *texture = random_texture(512, 512, 1);
    lam_texture_map map = {.texture = texture};
    lam_scene *scene = floor_scene(&map);
    lam_frame_report report;
    lam_image first = floor_draw(hardware[0], scene, SIZE, 1, &plain);
    lam_device_report(hardware[0], &report);
    uint64_t texels = 512 * 512 * 4 / 3;
    assert_true(report.bytes_uploaded >= texels * 4 && report.bytes_uploaded < texels * 4 + 4000);
    lam_image second = floor_draw(hardware[0], scene, SIZE, 1, &plain);
    lam_device_report(hardware[0], &report);
    assert_true(report.bytes_uploaded < 1000);
    assert_memory_equal(first.pixels, second.pixels, (size_t)SIZE * SIZE * 16);
    lam_image_free(&first);
    lam_image_free(&second);
    lam_scene_free(scene);
    lam_texture_free(texture);
}

// A ground's ambient occlusion uses the unit of the first map, so the sampler of a map must not stay there.
static void ground_after_maps(void **state)
{
    (void)state;
    struct demo demo;
    lam_error error = {0};
    if (!demo_build_named("textured", &demo, &error))
        fail_msg("%s", error.text);
    demo.params.samples = 1;
    demo.params.ground = LAM_GROUND_SHADOW;
    demo.params.occlusion = LAM_OCCLUSION_SCREEN;
    for (int g = 0; g < 2; g++) {
        if (!hardware[g] || !exact[g])
            continue;
        lam_image images[3] = {{0}};
        for (int i = 0; i < 3; i++) // the second frame of `hardware` begins with the samplers of the first
            if (!lam_image_make(&images[i], demo.width, demo.height, LAM_RGBA32F, &error) ||
                !lam_draw(i ? hardware[g] : exact[g], demo.scene, &demo.camera, &demo.params, &images[i], NULL, &error))
                fail_msg("%s", error.text);
        // Only the ground: black, with the shadow's fraction as opacity.
        size_t count = (size_t)demo.width * (size_t)demo.height, shadow = 0;
        for (size_t i = 0; i < count; i++) {
            const float *p = (const float *)images[0].pixels + 4 * i;
            if (p[0] != 0 || p[1] != 0 || p[2] != 0 || !(p[3] > 0.02f) || p[3] > 0.98f)
                continue;
            shadow++;
            for (int k = 1; k < 3; k++)
                assert_true(fabsf(((const float *)images[k].pixels)[4 * i + 3] - p[3]) < 0.02f);
        }
        assert_true(shadow > count / 200);
        for (int i = 0; i < 3; i++)
            lam_image_free(&images[i]);
    }
    lam_scene_free(demo.scene);
}

// Printed shaders: one text supports two wrap modes, because the graphics card implements them.
static void printed_shaders(void **state)
{
    (void)state;
    lam_error error = {0};
    lam_texture *texture = random_texture(16, 16, 1);
    lam_texture_map map = {.texture = texture, .wrap_s = LAM_WRAP_CLAMP}, other = {.texture = texture};
    lam_scene *scene = floor_and_cube(&map, &other);
    lam_camera camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
    for (int glsl = 0; glsl < LAM_GLSL_COUNT; glsl++) {
        lam_shader_params params = {.glsl = (lam_glsl)glsl, .hardware_filter = true};
        lam_shader *shader = lam_shader_make(scene, &camera, NULL, SIZE, SIZE, -1, &params, &error);
        if (!shader)
            fail_msg("%s", error.text);
        assert_true((strstr(shader->fragment, "textureGrad(") != NULL) == (glsl != LAM_GLSL_120));
        assert_null(strstr(shader->fragment, "texelFetch("));
        assert_null(strstr(shader->fragment, "WRAP_"));
        lam_shader_free(shader);
    }
    lam_scene_free(scene);
    lam_texture_free(texture);
}

int main(void)
{
    lam_error error = {0};
    cpu = lam_device_cpu(NULL, &error);
    for (int i = 0; i < 2; i++) {
        lam_gl_params params = {.api = i ? LAM_GL_ES : LAM_GL_CORE, .debug = true};
        exact[i] = lam_device_gl(&params, &error);
        params.hardware_filter = true;
        hardware[i] = lam_device_gl(&params, &error);
        print_message("%s\n", hardware[i] ? lam_device_name(hardware[i]) : error.text);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_near), cmocka_unit_test(modes_are_kept), cmocka_unit_test(anisotropy),
        cmocka_unit_test(large_numbers),   cmocka_unit_test(uploads),        cmocka_unit_test(ground_after_maps),
        cmocka_unit_test(printed_shaders),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    for (int i = 0; i < 2; i++) {
        lam_device_free(exact[i]);
        lam_device_free(hardware[i]);
    }
    lam_device_free(cpu);
    return failed;
}
