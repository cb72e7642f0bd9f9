// test_physical.c: metallic–roughness materials next to classic ones, and conversions between them.

#include "test.h"

#include <lambent/device.h>
#include <lambent/light.h>
#include <lambent/words.h>

#include "device_type.h"

enum { WIDTH = 96, HEIGHT = 48 };

static lam_material physical(float r, float g, float b, float metallic, float roughness)
{
    lam_material m = lam_material_default();
    m.diffuse = (lam_rgba){r, g, b, 1};
    m.physical = true;
    m.metallic = metallic;
    m.roughness = roughness;
    return m;
}

static bool near(float a, double b) { return fabs((double)a - b) <= 1e-5 * fmax(1, fabs(b)); }

TEST(test_as_classic)
{
    lam_material from = physical(0.8f, 0.4f, 0.1f, 0.25f, 0.5f), m = lam_material_as_classic(&from);
    double rho = 0.25, alpha = 2 / (rho * rho) - 2, energy = (alpha + 8) / 8; // conventions, "Mapping"
    assert_false(m.physical);
    assert_true(near(m.shininess, alpha));
    assert_true(near(m.diffuse.r, 0.8 * 0.75) && near(m.diffuse.g, 0.4 * 0.75) && near(m.diffuse.b, 0.1 * 0.75));
    assert_true(near(m.specular.r, (0.04 * 0.75 + 0.8 * 0.25) * energy));
    assert_true(near(m.specular.b, (0.04 * 0.75 + 0.1 * 0.25) * energy));
    assert_true(m.ambient.g == 0.4f && m.diffuse.a == 1);
    from.roughness = 0;
    assert_true(lam_material_as_classic(&from).shininess == 4096);
    from.roughness = 1;
    assert_true(lam_material_as_classic(&from).shininess == 1);
    lam_material classic = lam_material_default(), same = lam_material_as_classic(&classic);
    assert_memory_equal(&same.diffuse, &classic.diffuse, sizeof same.diffuse);
}

// Converting a physical material and back preserves it.
TEST(test_and_back)
{
    for (int i = 0; i < 1000; i++) {
        float metallic = (float)(i % 10) / 9, roughness = 0.2f + 0.075f * (float)(i / 10 % 10);
        float base = 0.1f + 0.085f * (float)(i / 100);
        lam_material from = physical(base, base, base, metallic, roughness), classic = lam_material_as_classic(&from);
        lam_material back = lam_material_as_physical(&classic);
        assert_true(back.physical);
        assert_true(fabsf(back.diffuse.r - base) < 1e-4f);
        assert_true(fabsf(back.roughness - roughness) < 1e-4f);
        assert_true(fabsf(back.metallic - metallic) < 1e-3f);
    }
}

// Two spheres side by side, each with a material.
static lam_scene *two_spheres(const lam_material *left, const lam_material *right)
{
    lam_error error;
    lam_scene *scene = lam_scene_make(&error);
    assert_int_equal(lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 32, .stacks = 16}, &error), 0);
    const lam_material *materials[] = {left, right};
    for (int i = 0; i < 2; i++) {
        lam_object object = lam_object_default();
        object.transform.m[0][3] = i ? 2.4 : -2.4;
        object.material = lam_scene_add_material(scene, materials[i], &error);
        assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
    }
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    light.position = (lam_vec3){1, 3, 4};
    assert_true(lam_scene_add_light(scene, &light, &error) >= 0);
    return scene;
}

static void draw_with(lam_device *device, const lam_scene *scene, lam_reflection reflection,
                      float out[HEIGHT][WIDTH][4])
{
    lam_error error;
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){0, 0, 9};
    AUTO_IMAGE image = {0};
    assert_true(lam_image_make(&image, WIDTH, HEIGHT, LAM_RGBA32F, &error));
    lam_draw_params params = {.reflection = reflection, .samples = 1};
    assert_true(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    memcpy(out, image.pixels, sizeof(float) * HEIGHT * WIDTH * 4);
}

static void draw(const lam_scene *scene, lam_reflection reflection, float out[HEIGHT][WIDTH][4])
{
    AUTO_DEVICE device = lam_device_cpu(NULL, NULL);
    draw_with(device, scene, reflection, out);
}

static float picture[5][HEIGHT][WIDTH][4];

TEST(test_two_kinds_in_one_scene)
{
    lam_material metal = physical(1, 0.7f, 0.3f, 1, 0.3f),
                 plastic = lam_material_named(LAM_MATERIAL_RED_PLASTIC, LAM_COLOR_SRGB);
    AUTO_SCENE scene = two_spheres(&metal, &plastic);
    draw(scene, LAM_REFLECTION_AUTO, picture[0]);
    draw(scene, LAM_REFLECTION_GGX, picture[1]);
    draw(scene, LAM_REFLECTION_BLINN_PHONG, picture[2]);
    // Without a reflection model from the caller, each has its own: left GGX, right Blinn–Phong.
    int other = 0;
    for (int y = 0; y < HEIGHT; y++) {
        assert_memory_equal(picture[0][y], picture[1][y], sizeof picture[0][y] / 2);
        assert_memory_equal(picture[0][y] + WIDTH / 2, picture[2][y] + WIDTH / 2, sizeof picture[0][y] / 2);
        other += memcmp(picture[1][y], picture[2][y], sizeof picture[0][y] / 2) != 0;
        other += memcmp(picture[1][y] + WIDTH / 2, picture[2][y] + WIDTH / 2, sizeof picture[0][y] / 2) != 0;
    }
    assert_true(other > HEIGHT / 2); // and the models differ
    // Another reflection model draws the material as lam_material_as_classic converts it.
    lam_material classic = lam_material_as_classic(&metal);
    lam_error error;
    assert_true(lam_scene_set_material(scene, 0, &classic, &error));
    draw(scene, LAM_REFLECTION_BLINN_PHONG, picture[3]);
    assert_memory_equal(picture[2], picture[3], sizeof picture[2]);
}

// A device keeps the studio of its first scene without lights. Pictures of later scenes, which need its light for other
// roughnesses, are the same as those of a new device.
TEST(test_kept_studio)
{
    lam_material metal = physical(1, 0.7f, 0.3f, 1, 0.3f), dull = physical(0.2f, 0.7f, 0.3f, 0, 0.9f);
    const lam_material *right[] = {&metal, &dull, &metal};
    lam_scene *scenes[3];
    AUTO_DEVICE device = lam_device_cpu(NULL, NULL);
    const lam_environment *studio = NULL;
    for (int i = 0; i < 3; i++) {
        scenes[i] = two_spheres(&metal, right[i]);
        lam_scene_clear_lights(scenes[i]);
        draw_with(device, scenes[i], LAM_REFLECTION_AUTO, picture[0]);
        assert_non_null(device->frame.environment);
        assert_true(!studio || device->frame.environment == studio);
        studio = device->frame.environment;
        draw(scenes[i], LAM_REFLECTION_AUTO, picture[1]);
        assert_memory_equal(picture[0], picture[1], sizeof picture[0]);
        if (i > 0)
            lam_scene_free(scenes[i - 1]); // after the next scene is drawn, so that their addresses differ
    }
    lam_scene_free(scenes[2]);
}

TEST(test_unlit)
{
    lam_material flat = lam_material_default(), lit = lam_material_default();
    flat.unlit = true;
    flat.diffuse = (lam_rgba){0.25f, 0.5f, 0.75f, 1};
    AUTO_SCENE scene = two_spheres(&flat, &lit);
    draw(scene, LAM_REFLECTION_AUTO, picture[0]);
    const float *middle = picture[0][HEIGHT / 2][WIDTH / 4], *beside = picture[0][HEIGHT / 2][WIDTH / 4 + 3];
    assert_true(middle[0] == 0.25f && middle[1] == 0.5f && middle[2] == 0.75f);
    assert_memory_equal(middle, beside, 4 * sizeof *middle);
    const float *round = picture[0][HEIGHT / 2][3 * WIDTH / 4];
    assert_true(memcmp(round, round + 16, 3 * sizeof *round) != 0);
}

// If the front and back of an object are of different kinds, the reflection model of the front draws both.
TEST(test_back_of_the_other_kind)
{
    lam_error error;
    lam_material metal = physical(1, 0.7f, 0.3f, 0.5f, 0.4f),
                 plastic = lam_material_named(LAM_MATERIAL_RED_PLASTIC, LAM_COLOR_SRGB);
    AUTO_SCENE scene = two_spheres(&metal, &plastic);
    for (int i = 0; i < 2; i++) {
        lam_object object = *lam_scene_object(scene, i);
        object.back_material = 1 - i;
        object.cull = LAM_CULL_FRONT;
        assert_true(lam_scene_set_object(scene, i, &object, &error));
    }
    draw(scene, LAM_REFLECTION_AUTO, picture[0]);
    draw(scene, LAM_REFLECTION_GGX, picture[1]);
    draw(scene, LAM_REFLECTION_BLINN_PHONG, picture[2]);
    for (int y = 0; y < HEIGHT; y++) {
        assert_memory_equal(picture[0][y], picture[1][y], sizeof picture[0][y] / 2);
        assert_memory_equal(picture[0][y] + WIDTH / 2, picture[2][y] + WIDTH / 2, sizeof picture[0][y] / 2);
    }
    assert_true(picture[0][HEIGHT / 2][WIDTH / 4][3] == 1);
}

// A square that faces the eye, with normals that point away from it, and light in their direction: neither a metal nor
// a layer is black.
TEST(test_leaning_normals)
{
    static const float positions[] = {-2, -1, 0, 2, -1, 0, 2, 1, 0, -2, 1, 0};
    static const float normals[] = {-1, 0, -0.2f, -1, 0, -0.2f, -1, 0, -0.8f, -1, 0, -0.8f};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    lam_error error;
    lam_mesh mesh = {.positions = positions,
                     .vertex_count = 4,
                     .normals = normals,
                     .normal_count = 4,
                     .indices = indices,
                     .triangle_count = 2};
    for (int layer = 0; layer < 4; layer++) {
        lam_material m = physical(1, 0.7f, 0.3f, 1, 0.5f);
        m.anisotropy = layer == 1 ? 0.7f : 0;
        if (layer >= 2)
            m.diffuse = (lam_rgba){0, 0, 0, 1};
        if (layer == 2)
            m.sheen_color = (lam_rgb){1, 1, 1};
        m.sheen_roughness = 0.6f;
        m.metallic = layer != 3;
        m.clearcoat = layer == 3;
        m.clearcoat_roughness = 0.8f;
        AUTO_SCENE scene = lam_scene_make(&error);
        lam_object object = lam_object_default();
        object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
        object.material = lam_scene_add_material(scene, &m, &error);
        assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
        lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
        light.direction = (lam_vec3){1, 0, 0.1};
        assert_true(lam_scene_add_light(scene, &light, &error) >= 0);
        draw(scene, LAM_REFLECTION_AUTO, picture[0]);
        int seen = 0;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const float *pixel = picture[0][i / WIDTH][i % WIDTH];
            seen += pixel[3] == 1;
            assert_true(pixel[3] == 0 || pixel[0] > 1e-3f);
        }
        assert_true(seen > 500);
    }
}

TEST(test_words)
{
    lam_error error;
    lam_material m = lam_material_default();
    assert_true(lam_material_parse("#ffffff,roughness=0.25", LAM_COLOR_SRGB, &m, &error));
    assert_true(m.physical && m.roughness == 0.25f && m.metallic == 0);
    m = lam_material_default();
    assert_true(lam_material_parse("#ffffff,shininess=8", LAM_COLOR_SRGB, &m, &error));
    assert_false(m.physical);
    assert_false(lam_material_parse("metallic=2", LAM_COLOR_SRGB, &m, &error));
}
