// test_textures.c: textures of the OpenGL device: compares every wrap and filter with the CPU device, numbers beyond
// 0…1, uploads.
#include "card.h"
#include "floor_scene.h"

#include <lambent/gl.h>
#include <lambent/lambent.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 192, SIDE = 20 };

static lam_device *cpu, *gl[2]; // OpenGL 3.3 and OpenGL ES 3.0; NULL if not available

static lam_draw_params more; // shading, stage and output of the picture

static lam_image draw(lam_device *device, const lam_scene *scene, int anisotropy)
{
    return floor_draw(device, scene, SIZE, anisotropy, &more);
}

// At most one covered pixel of a thousand (of 200 on a graphics card, at borders of texels) differs by more than 1/255 (by the same share
// of larger numbers).
static void compare(lam_device *device, const lam_scene *scene, int anisotropy, const char *name)
{
    lam_image a = draw(cpu, scene, anisotropy), b = draw(device, scene, anisotropy);
    const float *p = a.pixels, *q = b.pixels;
    int covered = 0, over = 0;
    double variety = 0;
    for (int i = 0; i < SIZE * SIZE; i++, p += 4, q += 4) {
        bool apart = false;
        for (int c = 0; c < 3; c++)
            apart |=
                p[c] > 1 ? !(fabsf(p[c] - q[c]) <= p[c] / 255) : !(fabs(encoded(p[c]) - encoded(q[c])) <= 1 / 255.0);
        covered += p[3] > 0;
        over += apart;
        variety += p[3] > 0 && fabsf(p[0] - p[1]) > 0.05f;
    }
    if (covered < SIZE * SIZE / 20 || variety < covered / 10.0 ||
        over * (is_card(lam_device_name(device)) ? 200 : 1000) > covered)
        fail_msg("%s: %d of %d covered pixels differ, %g are coloured", name, over, covered, variety);
    lam_image_free(&a);
    lam_image_free(&b);
}

static void wraps_and_filters(void **state)
{
    (void)state;
    if (!gl[0] && !gl[1])
        skip();
    int count = 0;
    lam_texture *texture = random_texture(SIDE, 13, 1);
    for (int wrap = 0; wrap < LAM_WRAP_COUNT * LAM_WRAP_COUNT; wrap++)
        for (int how = 0; how < 4 * LAM_MIP_COUNT; how++, count++) {
            char name[64];
            if (wrap % 4 && how % 5) // all ways alone, and some combinations
                continue;
            lam_texture_map map = {.texture = texture,
                                   .wrap_s = (lam_wrap)(wrap % 3),
                                   .wrap_t = (lam_wrap)(wrap / 3),
                                   .magnify = (lam_filter)(how % 2),
                                   .minify = (lam_filter)(how / 2 % 2),
                                   .mip = (lam_mip)(how / 4),
                                   .texcoords = count % 2};
            snprintf(name, sizeof name, "wraps %d %d, filters %d %d %d, set %d", wrap % 3, wrap / 3, how % 2,
                     how / 2 % 2, how / 4, count % 2);
            lam_scene *scene = floor_scene(&map);
            compare(gl[count % 2] ? gl[count % 2] : gl[!(count % 2)], scene, 0, name);
            lam_scene_free(scene);
        }
    lam_texture_free(texture);
}

static void transforms_floats_and_anisotropy(void **state)
{
    (void)state;
    lam_texture *texture = random_texture(33, 64, 8), *plain = random_texture(64, 64, 1);
    for (int i = 0; i < 2; i++) {
        if (!gl[i])
            continue;
        lam_texture_map bright = {
            .texture = texture, .transform = {{0.6f, 0.8f, 0.25f}, {-0.8f, 0.6f, -7}}, .scale = 0.5f, .offset = 0.125f};
        lam_texture_map slanted = {.texture = plain};
        lam_scene *scenes[] = {floor_scene(&bright), floor_scene(&slanted)};
        compare(gl[i], scenes[0], 0, "numbers up to 8");
        compare(gl[i], scenes[1], 2, "2 probes");
        compare(gl[i], scenes[1], 16, "16 probes");
        lam_scene_free(scenes[0]);
        lam_scene_free(scenes[1]);
    }
    lam_texture_free(texture);
    lam_texture_free(plain);
}

// A texture is uploaded once, and removed with its scene.
static void uploads(void **state)
{
    (void)state;
    if (!gl[0])
        skip();
    lam_texture *texture = random_texture(512, 512, 1);
    lam_texture_map map = {.texture = texture};
    lam_scene *scene = floor_scene(&map), *next = floor_scene(NULL);
    lam_image images[3] = {draw(gl[0], next, 0), draw(gl[0], scene, 0)};
    lam_frame_report report;
    lam_device_report(gl[0], &report);
    uint64_t with = report.memory_bytes;
    assert_true(report.bytes_uploaded > 512 * 512 * 8 * 4 / 3);
    images[2] = draw(gl[0], scene, 0);
    lam_device_report(gl[0], &report);
    assert_true(report.bytes_uploaded < 1000);
    assert_memory_equal(images[1].pixels, images[2].pixels, (size_t)SIZE * SIZE * 16);
    lam_scene_free(scene);
    lam_texture_free(texture);
    lam_image_free(&images[0]);
    images[0] = draw(gl[0], next, 0);
    lam_device_report(gl[0], &report);
    assert_true(report.memory_bytes + 512u * 512 * 8 < with);
    for (int i = 0; i < 3; i++)
        lam_image_free(&images[i]);
    lam_scene_free(next);
}

// Maps of diffuse colour, opacity and emission if lighting is computed at vertices, in every stage: opaque, masked,
// blended; and only an opacity map.
static void lit_at_vertices(void **state)
{
    (void)state;
    static const struct {
        lam_shading shading;
        lam_stage stage;
    } ways[] = {{LAM_SHADING_GOURAUD, LAM_STAGE_VERTEX},
                {LAM_SHADING_GOURAUD, LAM_STAGE_APPLICATION},
                {LAM_SHADING_FLAT, LAM_STAGE_FRAGMENT},
                {LAM_SHADING_FLAT, LAM_STAGE_VERTEX},
                {LAM_SHADING_FLAT, LAM_STAGE_APPLICATION}};
    static const lam_output outputs[] = {LAM_OUTPUT_PICTURE, LAM_OUTPUT_DIFFUSE, LAM_OUTPUT_EMISSION};
    if (!gl[0] && !gl[1])
        skip();
    lam_texture *colors = random_texture(8, 8, 1), *glow = random_texture(4, 4, 2);
    lam_texture_map map = {.texture = colors}, emission = {.texture = glow, .magnify = LAM_FILTER_NEAREST};
    for (int i = 0; i < 4; i++) {
        lam_scene *scene = floor_scene(&map);
        lam_material m = *lam_scene_material(scene, 0);
        m.unlit = false;
        m.alpha_mode = (lam_alpha_mode)(i % 3);
        m.alpha_cutoff = 0.5f;
        m.emission = (lam_rgb){0.2f, 0.4f, 0.1f};
        m.maps[LAM_MAP_EMISSION] = &emission;
        m.maps[LAM_MAP_OPACITY] = &map; // by its red channel
        if (i == 3) {
            m.maps[LAM_MAP_DIFFUSE] = m.maps[LAM_MAP_EMISSION] = NULL;
            m.ambient = m.specular = (lam_rgb){0.1f, 0.5f, 0.2f};
            m.diffuse = (lam_rgba){0.1f, 0.8f, 0.3f, 1};
            m.alpha_mode = LAM_ALPHA_BLEND;
        }
        assert_true(lam_scene_set_material(scene, 0, &m, NULL));
        for (size_t k = 0; k < 5 * 3; k++) {
            char name[64];
            more =
                (lam_draw_params){.shading = ways[k / 3].shading, .stage = ways[k / 3].stage, .output = outputs[k % 3]};
            snprintf(name, sizeof name, "alpha %d, shading %d, stage %d, output %d", i, (int)more.shading,
                     (int)more.stage, (int)more.output);
            for (int g = 0; g < 2; g++)
                if (gl[g])
                    compare(gl[g], scene, 1, name);
        }
        more = (lam_draw_params){0};
        lam_scene_free(scene);
    }
    lam_texture_free(colors);
    lam_texture_free(glow);
}

// Quantities of masked surfaces omit the holes, like the picture; quantities of blended surfaces are complete.
static void values_of_masked(void **state)
{
    (void)state;
    static const lam_output outputs[] = {LAM_OUTPUT_NORMALS,  LAM_OUTPUT_DEPTH,      LAM_OUTPUT_FACING, LAM_OUTPUT_IDS,
                                         LAM_OUTPUT_COVERAGE, LAM_OUTPUT_BASE_COLOR, LAM_OUTPUT_LOD};
    lam_texture *texture = random_texture(8, 8, 1);
    lam_texture_map map = {.texture = texture};
    for (int shading = 0; shading < 3; shading++)
        for (int i = 0; i < 7; i++)
            for (int mode = LAM_ALPHA_BLEND; mode < LAM_ALPHA_COUNT; mode++) {
                lam_scene *scene = floor_scene(&map);
                lam_material m = *lam_scene_material(scene, 0);
                m.unlit = false;
                m.alpha_mode = (lam_alpha_mode)mode;
                m.alpha_cutoff = 0.4f;
                m.diffuse.a = 0.9f;
                m.maps[LAM_MAP_OPACITY] = &map; // by its red channel
                assert_true(lam_scene_set_material(scene, 0, &m, NULL));
                more = (lam_draw_params){.shading = (lam_shading)shading};
                lam_image picture = draw(cpu, scene, 1);
                more.output = outputs[i];
                for (int g = -1; g < 2; g++) {
                    if (g >= 0 && !gl[g])
                        continue;
                    lam_image values = draw(g < 0 ? cpu : gl[g], scene, 1);
                    int holes = 0, apart = 0;
                    for (int k = 0; k < SIZE * SIZE; k++) {
                        const float *v = (const float *)values.pixels + 4 * k;
                        bool seen = ((const float *)picture.pixels)[4 * k + 3] > 0;
                        bool there = outputs[i] == LAM_OUTPUT_COVERAGE ? v[0] > 0 : v[3] > 0;
                        apart += seen != there;
                        holes += !there;
                    }
                    if (apart * 1000 > SIZE * SIZE || holes < SIZE * SIZE / 10)
                        fail_msg("device %d, output %d, mode %d: %d pixels differ, %d holes", g, (int)outputs[i], mode,
                                 apart, holes);
                    lam_image_free(&values);
                }
                lam_image_free(&picture);
                lam_scene_free(scene);
            }
    more = (lam_draw_params){0};
    lam_texture_free(texture);
}

// Twelve different textures, on the front and the back of one surface: more than the minimum number of texture units.
static void many_textures(void **state)
{
    (void)state;
    static const lam_map slots[] = {LAM_MAP_DIFFUSE,   LAM_MAP_ROUGHNESS, LAM_MAP_METALLIC,
                                    LAM_MAP_OCCLUSION, LAM_MAP_EMISSION,  LAM_MAP_OPACITY};
    if (!gl[0] && !gl[1])
        skip();
    lam_texture *textures[12];
    lam_texture_map maps[12];
    for (int i = 0; i < 12; i++) {
        textures[i] = random_texture(4 + i, 8, 1);
        maps[i] = (lam_texture_map){.texture = textures[i]};
    }
    lam_scene *scene = floor_scene(&maps[0]);
    int materials[2] = {0, -1};
    for (int side = 0; side < 2; side++) {
        lam_material m = lam_material_default();
        m.physical = true;
        m.diffuse = (lam_rgba){1, 1, 1, 1};
        m.emission = (lam_rgb){0.3f, 0.1f, 0.2f};
        m.roughness = m.metallic = 0.8f;
        m.alpha_mode = LAM_ALPHA_MASK;
        m.alpha_cutoff = 0.3f;
        for (int i = 0; i < 6; i++)
            m.maps[slots[i]] = &maps[6 * side + i];
        if (side)
            materials[1] = lam_scene_add_material(scene, &m, NULL);
        else
            assert_true(lam_scene_set_material(scene, 0, &m, NULL));
    }
    lam_object object = *lam_scene_object(scene, 0);
    object.back_material = materials[1];
    assert_true(lam_scene_set_object(scene, 0, &object, NULL));
    lam_light sun = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    sun.direction = (lam_vec3){0.2, -1, -0.4};
    assert_true(lam_scene_add_light(scene, &sun, NULL) >= 0);
    for (int g = 0; g < 2; g++)
        if (gl[g])
            compare(gl[g], scene, 1, "twelve textures");
    lam_scene_free(scene);
    for (int i = 0; i < 12; i++)
        lam_texture_free(textures[i]);
}

static const lam_shader_uniform *find(const lam_shader_draw *run, const char *name)
{
    for (int i = 0; i < run->uniform_count; i++)
        if (strcmp(run->uniforms[i].name, name) == 0)
            return &run->uniforms[i];
    return NULL;
}

// Printed shaders: the sampler of a map names its texture; a run without the map has the value 1 for any bound texture;
// one text cannot support two wrap modes.
static void printed_shaders(void **state)
{
    (void)state;
    lam_error error = {0};
    lam_texture *texture = random_texture(16, 16, 1);
    lam_texture_map map = {.texture = texture, .wrap_s = LAM_WRAP_CLAMP, .scale = 0.5f, .offset = 0.25f}, other = map;
    other.wrap_s = LAM_WRAP_MIRROR;
    for (int i = 0; i < 2; i++) {
        lam_scene *scene = floor_and_cube(&map, i ? &other : NULL);
        lam_camera camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
        lam_shader *shader = lam_shader_make(scene, &camera, NULL, SIZE, SIZE, -1, NULL, &error);
        if (i) {
            assert_null(shader);
            assert_int_equal(error.code, LAM_BAD_ARGUMENT);
            lam_scene_free(scene);
            continue;
        }
        assert_non_null(shader);
        assert_int_equal(shader->draw_count, 2);
        const lam_shader_uniform *sampler = find(&shader->draws[0], "diffuse_map");
        assert_non_null(sampler);
        assert_string_equal(sampler->type, "sampler2D");
        assert_ptr_equal(sampler->map->texture, texture);
        assert_true(find(&shader->draws[0], "diffuse_map_s")->value[3] == 0.5f);
        assert_true(find(&shader->draws[0], "diffuse_map_t")->value[3] == 0.25f);
        assert_null(find(&shader->draws[1], "diffuse_map")->map);
        assert_true(find(&shader->draws[1], "diffuse_map_s")->value[3] == 0);
        assert_true(find(&shader->draws[1], "diffuse_map_t")->value[3] == 1);
        lam_shader_free(shader);
        lam_scene_free(scene);
    }
    lam_texture_free(texture);
}

int main(void)
{
    lam_error error = {0};
    cpu = lam_device_cpu(NULL, &error);
    for (int i = 0; i < 2; i++) {
        gl[i] = lam_device_gl(&(lam_gl_params){.api = i ? LAM_GL_ES : LAM_GL_CORE, .debug = true}, &error);
        print_message("%s\n", gl[i] ? lam_device_name(gl[i]) : error.text);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wraps_and_filters), cmocka_unit_test(transforms_floats_and_anisotropy),
        cmocka_unit_test(uploads),           cmocka_unit_test(lit_at_vertices),
        cmocka_unit_test(values_of_masked),  cmocka_unit_test(many_textures),
        cmocka_unit_test(printed_shaders),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    lam_device_free(gl[0]);
    lam_device_free(gl[1]);
    lam_device_free(cpu);
    return failed;
}
