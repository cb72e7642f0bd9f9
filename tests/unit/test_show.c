// test_show.c: pictures of terms add up to the picture; pictures of quantities contain the documented numbers and
// encodings.
#include "test.h"
#include "scenes.h"

#include "device_fixture.h"

static lam_image draw(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params, int width,
                      int height, lam_pixel_format format)
{
    lam_image image;
    lam_error error = {0};
    assert_true(lam_image_make(&image, width, height, format, &error));
    if (!lam_draw(device, scene, camera, params, &image, NULL, &error))
        fail_msg("%s: %s", lam_output_name(params->output), error.text);
    return image;
}

static lam_image draw_show(const lam_scene *scene, const lam_camera *camera, lam_draw_params params, lam_output show,
                           int light)
{
    params.output = show;
    params.output_light = light;
    return draw(scene, camera, &params, 96, 72, LAM_RGBA32F);
}

enum { CHANNELS = 96 * 72 * 4 };

static void add(double *sums, lam_image image)
{
    const float *p = image.pixels;
    for (int i = 0; i < CHANNELS; i++)
        sums[i] += i % 4 == 3 ? 0 : (double)p[i];
    lam_image_free(&image);
}

// Channels in which the sums and the picture differ by at most some rounding errors of float numbers of this size.
static void check_sums(const char *what, const double *sums, const lam_image *picture)
{
    const float *p = picture->pixels;
    double brightest = 0;
    bool covered = false;
    for (int i = 0; i < CHANNELS; i++) {
        if (i % 4 == 3) {
            covered |= p[i] > 0;
            continue;
        }
        double expected = (double)p[i], bound = 1e-6 * (1 + fabs(expected));
        brightest = fmax(brightest, expected);
        if (!(fabs(sums[i] - expected) <= bound))
            fail_msg("%s: pixel %d,%d channel %d: the sum is %.9g, the picture %.9g", what, i / 4 % 96, i / 4 / 96,
                     i % 4, sums[i], expected);
    }
    if (covered && brightest < 0.02)
        fail_msg("%s: the picture is black", what);
}

// Both sums: the five terms; and the lights, with the light that belongs to no light.
static void check_scene(const char *name, lam_scene *scene, const lam_camera *camera, lam_draw_params params)
{
    static double sums[CHANNELS];
    params.background = (lam_rgba){0};
    if (strcmp(name, "layers-transmission") == 0 || strcmp(name, "layers-refraction") == 0)
        params.background.a = 1; // over nothing, coloured glass contains white that belongs to no term
    lam_image picture = draw_show(scene, camera, params, LAM_OUTPUT_PICTURE, 0);
    memset(sums, 0, sizeof sums);
    for (int show = LAM_OUTPUT_AMBIENT; show <= LAM_OUTPUT_REFLECTION; show++)
        add(sums, draw_show(scene, camera, params, (lam_output)show, 0));
    check_sums(name, sums, &picture);
    // Unlit surfaces belong to no light, including lines without normals.
    if (params.reflection == LAM_REFLECTION_NONE || strcmp(name, "lines") == 0) {
        lam_image_free(&picture);
        return;
    }
    memset(sums, 0, sizeof sums);
    int lights = lam_draw_lights(scene, params.rig, params.ground, NULL, 0);
    for (int i = 0; i < lights; i++)
        add(sums, draw_show(scene, camera, params, LAM_OUTPUT_LIGHT, i));
    add(sums, draw_show(scene, camera, params, LAM_OUTPUT_EMISSION, 0));
    add(sums, draw_show(scene, camera, params, LAM_OUTPUT_ENVIRONMENT, 0));
    // The remainder is the scene's own ambient light, as in a scene without others.
    lam_light ambient = lam_light_default(LAM_LIGHT_AMBIENT);
    ambient.ambient = lam_scene_ambient(scene);
    lam_scene_set_ambient(scene, (lam_rgb){0});
    params.rig = params.rig == LAM_RIG_AUTO && lights && !lam_scene_light_count(scene) ? LAM_RIG_STUDIO : params.rig;
    int added = lam_scene_add_light(scene, &ambient, NULL);
    assert_true(added >= 0);
    add(sums, draw_show(scene, camera, params, LAM_OUTPUT_LIGHT, added));
    char title[100];
    snprintf(title, sizeof title, "%s, by lights", name);
    check_sums(title, sums, &picture);
    lam_image_free(&picture);
}

TEST(test_demos)
{
    for (int i = 0; i < demo_count; i++) {
        struct demo demo;
        lam_error error = {0};
        if (!demo_build(&demos[i], &demo, &error))
            fail_msg("%s: %s", demos[i].name, error.text);
        if (!demo.params.gl1 && !demo.params.bounces) // paths have no terms
            check_scene(demos[i].name, demo.scene, &demo.camera, demo.params);
        lam_scene_free(demo.scene);
    }
}

// A scene with every kind of light and term: emission, ambient light of lights and of the scene, hemisphere, spot,
// coloured vertices.
static lam_scene *full_scene(bool colors)
{
    lam_scene *scene = lam_scene_make(NULL);
    assert_non_null(scene);
    lam_error error = {0};
    lam_object object = lam_object_default();
    lam_material material = lam_material_default();
    material.emission = (lam_rgb){0.05f, 0.1f, 0.02f};
    material.diffuse = (lam_rgba){0.7f, 0.4f, 0.2f, 1};
    material.specular = (lam_rgb){0.9f, 0.8f, 0.7f};
    material.shininess = 12;
    object.material = lam_scene_add_material(scene, &material, NULL);
    if (colors) {
        static const float positions[] = {-1, -1, 0, 1, -1, 0.3f, 1, 1, 0, -1, 1, -0.3f};
        static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
        static const float paint[] = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 0, 1};
        lam_mesh mesh = {.vertex_count = 4,
                         .triangle_count = 2,
                         .positions = positions,
                         .indices = indices,
                         .colors = paint,
                         .color_count = 4,
                         .colors_format = LAM_COLORS_LINEAR_F32};
        object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    } else {
        object.mesh = lam_scene_add_shape(scene, "torus", NULL, &error);
    }
    if (object.mesh < 0 || lam_scene_add_object(scene, &object, &error) < 0)
        fail_msg("%s", error.text);
    lam_scene_set_ambient(scene, (lam_rgb){0.1f, 0.05f, 0.2f});
    lam_light point = lam_light_default(LAM_LIGHT_POINT), spot = lam_light_default(LAM_LIGHT_SPOT),
              sky = lam_light_default(LAM_LIGHT_HEMISPHERE), sun = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    point.position = (lam_vec3){1, 2, 2};
    point.attenuation = (lam_attenuation){0.5f, 0.1f, 0.05f};
    point.ambient = (lam_rgb){0.1f, 0.2f, 0.1f};
    point.name = "lamp";
    spot.position = (lam_vec3){-1, 0, 3};
    spot.exponent = 3;
    spot.ambient = (lam_rgb){0.02f, 0.02f, 0.02f};
    sun.direction = (lam_vec3){0.2, -1, -1};
    sun.diffuse = (lam_rgb){0.3f, 0.3f, 0.1f};
    const lam_light *all[] = {&sky, &point, &spot, &sun};
    for (int i = 0; i < 4; i++)
        assert_true(lam_scene_add_light(scene, all[i], NULL) >= 0);
    return scene;
}

TEST(test_every_method)
{
    for (int colors = 0; colors < 2; colors++)
        for (int shading = LAM_SHADING_PHONG; shading <= LAM_SHADING_FLAT; shading++)
            for (int model = LAM_REFLECTION_NONE; model < LAM_REFLECTION_COUNT; model++)
                for (int gl1 = 0; gl1 < 2; gl1++) {
                    lam_draw_params params = {.shading = (lam_shading)shading,
                                              .reflection = (lam_reflection)model,
                                              .samples = gl1 ? 1 : 4,
                                              .gl1 = gl1 && shading == LAM_SHADING_PHONG};
                    AUTO_SCENE scene = full_scene(colors);
                    lam_camera camera = lam_camera_fit(scene, 96, 72, NULL);
                    char name[80];
                    snprintf(name, sizeof name, "colours %d, shading %d, model %d, gl1 %d", colors, shading, model,
                             gl1);
                    // the scene's ambient light is added to the lights' there, and is attenuated like theirs
                    if (params.gl1)
                        lam_scene_set_ambient(scene, (lam_rgb){0});
                    check_scene(name, scene, &camera, params);
                }
}

// The other lights, and terms that belong to no light, do not affect it.
TEST(test_one_light)
{
    AUTO_SCENE scene = full_scene(false);
    lam_camera camera = lam_camera_fit(scene, 96, 72, NULL);
    lam_draw_params params = {.samples = 1, .output = LAM_OUTPUT_LIGHT, .output_light = 4};
    AUTO_IMAGE image = {0};
    lam_error error;
    assert_true(lam_image_make(&image, 16, 16, LAM_RGBA8, NULL));
    assert_false(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_non_null(strstr(error.text, "has 4 lights"));
    params = (lam_draw_params){.output = LAM_OUTPUT_N_L};
    assert_false(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    assert_non_null(strstr(error.text, "n.l: light 0 comes from everywhere"));
    params = (lam_draw_params){.output = LAM_OUTPUT_COUNT};
    assert_false(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    params = (lam_draw_params){.output = LAM_OUTPUT_LIGHT, .output_light = -1};
    assert_false(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    lam_light lights[4];
    assert_int_equal(lam_draw_lights(scene, LAM_RIG_AUTO, false, lights, 2), 4);
    assert_string_equal(lights[1].name, "lamp");
    assert_int_equal(lam_draw_lights(scene, LAM_RIG_STUDIO, true, NULL, 0), 8);
}

// --- quantities: a rectangle across the picture at z = 0, whose left half is seen from behind, over a second one at z
// = -1

static lam_scene *two_sheets(lam_camera *camera)
{
    lam_scene *scene = lam_scene_make(NULL);
    static const float positions[] = {-2, -2, 0, 0, -2, 0, 0, 2, 0, -2, 2, 0, 2, -2, 0, 2, 2, 0};
    static const uint32_t indices[] = {0, 2, 1, 0, 3, 2, 1, 4, 5, 1, 5, 2}; // the left half clockwise
    lam_mesh near_sheet = {.vertex_count = 6, .triangle_count = 4, .positions = positions, .indices = indices};
    static const float behind[] = {-2, -2, -1, 2, -2, -1, 2, 0, -1, -2, 0, -1}; // only the lower half
    static const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    lam_mesh far_sheet = {.vertex_count = 4, .triangle_count = 2, .positions = behind, .indices = quad};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &near_sheet, NULL);
    assert_true(lam_scene_add_object(scene, &object, NULL) == 0);
    object.mesh = lam_scene_add_mesh(scene, &far_sheet, NULL);
    assert_true(lam_scene_add_object(scene, &object, NULL) == 1);
    lam_light sun = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    sun.direction = (lam_vec3){0, -0.6, -0.8};
    sun.diffuse = (lam_rgb){2, 2, 0.5f};
    sun.specular = (lam_rgb){0};
    assert_true(lam_scene_add_light(scene, &sun, NULL) == 0);
    *camera = lam_camera_default();
    camera->ortho_half_height = 3;
    camera->near_plane = 2;
    camera->far_plane = 6;
    return scene;
}

struct expected {
    lam_output show;
    float left[4], right[4], outside[4]; // floats at a pixel of each part
    uint8_t left_code[4], right_code[4], outside_code[4];
};

// 8 bits of the background {1, 0.5, 0, 0.4}: sRGB and not premultiplied, as in the picture.
#define BACK {255, 188, 0, 102}

TEST(test_numbers)
{
    static const struct expected all[] = {
        {LAM_OUTPUT_NORMALS, {0, 0, 1, 1}, {0, 0, 1, 1}, {0}, {128, 128, 255, 255}, {128, 128, 255, 255}, BACK},
        {LAM_OUTPUT_DEPTH, {4, 4, 4, 1}, {4, 4, 4, 1}, {0}, {255, 255, 255, 255}, {255, 255, 255, 255}, BACK},
        {LAM_OUTPUT_N_L,
         {0.8f, 0.8f, 0.8f, 1},
         {0.8f, 0.8f, 0.8f, 1},
         {0},
         {204, 204, 204, 255},
         {204, 204, 204, 255},
         BACK},
        {LAM_OUTPUT_N_H,
         {0.94868330f, 0.94868330f, 0.94868330f, 1},
         {0.94868330f, 0.94868330f, 0.94868330f, 1},
         {0},
         {242, 242, 242, 255},
         {242, 242, 242, 255},
         BACK}, // 0.9/√0.9
        {LAM_OUTPUT_FACING, {-1, -1, -1, 1}, {1, 1, 1, 1}, {0}, {255, 51, 0, 255}, {0, 102, 255, 255}, BACK},
        {LAM_OUTPUT_COVERAGE,
         {1, 1, 1, 1},
         {1, 1, 1, 1},
         {0, 0, 0, 1},
         {255, 255, 255, 255},
         {255, 255, 255, 255},
         {0, 0, 0, 255}},
        // two sheets below, one above: the left pixel is in the lower half
        {LAM_OUTPUT_OVERDRAW,
         {2, 2, 2, 1},
         {1, 1, 1, 1},
         {0, 0, 0, 1},
         {102, 102, 102, 255},
         {64, 64, 64, 255},
         {0, 0, 0, 255}},
    };
    static const lam_shading shadings[] = {LAM_SHADING_PHONG, LAM_SHADING_GOURAUD, LAM_SHADING_FLAT};
    lam_camera camera;
    AUTO_SCENE scene = two_sheets(&camera);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        for (size_t k = 0; k < 3 * 2; k++) {
            const struct expected *e = &all[i];
            lam_draw_params params = {.output = e->show,
                                      .shading = shadings[k / 2],
                                      .samples = k % 2 ? 4 : 1,
                                      .background = {1, 0.5f, 0, 0.4f}};
            AUTO_IMAGE floats = draw(scene, &camera, &params, 60, 60, LAM_RGBA32F);
            AUTO_IMAGE bytes = draw(scene, &camera, &params, 60, 60, LAM_RGBA8);
            const int at[3] = {40 * 60 + 15, 20 * 60 + 40, 2 * 60 + 2}; // left below, right above, outside
            const float *const values[] = {e->left, e->right, e->outside};
            const uint8_t *const codes[] = {e->left_code, e->right_code, e->outside_code};
            for (int p = 0; p < 3; p++)
                for (int c = 0; c < 4; c++) {
                    float found = ((float *)floats.pixels)[4 * at[p] + c];
                    if (!(fabsf(found - values[p][c]) <= 1e-6f * (1 + fabsf(found))))
                        fail_msg("%s, place %d, channel %d: %g, expected %g", lam_output_name(e->show), p, c,
                                 (double)found, (double)values[p][c]);
                    int code = ((uint8_t *)bytes.pixels)[4 * at[p] + c];
                    if (code != codes[p][c])
                        fail_msg("%s, place %d, channel %d: byte %d, expected %d", lam_output_name(e->show), p, c, code,
                                 codes[p][c]);
                }
        }
}

// 8 bits of depth cover the scene's vertices, visible or not, from any eye position; the camera's planes limit the
// range. If floats cannot distinguish the ends of the range, every depth is near.
TEST(test_depth_range)
{
    static const struct {
        double near_plane, far_plane, scale_z, expected_near, expected_far;
    } cases[] = {{0, 0, 1, 7, 9}, {0, 0, 0.25, 7.75, 8.25}, {7.5, 100, 1, 7.5, 9}, {1, 7.9, 1, 7, 7.9}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        AUTO_SCENE scene = lam_scene_make(NULL);
        lam_object object = lam_object_default();
        object.mesh = lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 128, .stacks = 64}, NULL);
        object.transform.m[2][2] = cases[i / 2].scale_z;
        object.transform.m[0][3] = 300; // the sphere's position has no effect
        assert_true(lam_scene_add_object(scene, &object, NULL) == 0);
        lam_camera camera = {.eye = {300, 0, 8}, .target = {300, 0, 0}, .up = {0, 1, 0}, .fovy_rad = 0.35};
        camera.ortho_half_height = i % 2 ? 1.2 : 0;
        camera.near_plane = cases[i / 2].near_plane;
        camera.far_plane = cases[i / 2].far_plane;
        lam_draw_params params = {.output = LAM_OUTPUT_DEPTH, .samples = 4};
        lam_image floats = draw(scene, &camera, &params, 61, 61, LAM_RGBA32F),
                  bytes = draw(scene, &camera, &params, 61, 61, LAM_RGBA8);
        double near = cases[i / 2].expected_near, far = cases[i / 2].expected_far;
        for (int p = 0; p < 61 * 61; p++) {
            const float *d = (const float *)floats.pixels + (ptrdiff_t)4 * p;
            const uint8_t *code = (const uint8_t *)bytes.pixels + (ptrdiff_t)4 * p;
            double expected = d[3] > 0 ? 255 * (far - (double)d[0]) / (far - near) : 0;
            assert_true(fabs(fmin(fmax(expected, 0), 255) - code[0]) <= 0.51 && code[0] == code[2]);
        }
        const uint8_t middle = ((const uint8_t *)bytes.pixels)[4 * (30 * 61 + 30)];
        if (cases[i / 2].near_plane < 7)
            assert_int_equal(middle, 255);
        lam_image_free(&floats);
        lam_image_free(&bytes);
    }
}

TEST(test_ids)
{
    lam_camera camera;
    AUTO_SCENE scene = two_sheets(&camera);
    camera.eye.z = -4; // from behind: the lower half shows object 1
    lam_draw_params params = {.output = LAM_OUTPUT_IDS, .samples = 4};
    lam_image floats = draw(scene, &camera, &params, 60, 60, LAM_RGBA32F),
              bytes = draw(scene, &camera, &params, 60, 60, LAM_RGBA8);
    bool seen[2][4] = {{0}};
    uint8_t colors[2][4][3];
    for (int i = 0; i < 60 * 60; i++) {
        const float *v = (float *)floats.pixels + (ptrdiff_t)4 * i;
        const uint8_t *b = (uint8_t *)bytes.pixels + (ptrdiff_t)4 * i;
        if (v[3] == 0) {
            assert_memory_equal(b, ((uint8_t[4]){0}), 4);
            continue;
        }
        int triangle = (int)v[0], object = (int)v[1];
        assert_true((float)triangle == v[0] && (float)object == v[1] && v[2] == 0 && v[3] == 1); // never a mixture
        assert_true(object >= 0 && object < 2 && triangle >= 0 && triangle < (object ? 2 : 4));
        assert_true(b[0] >= 48 && b[1] >= 48 && b[2] >= 48 && b[3] == 255);
        if (seen[object][triangle])
            assert_memory_equal(colors[object][triangle], b, 3);
        memcpy(colors[object][triangle], b, 3);
        seen[object][triangle] = true;
    }
    assert_true(seen[1][0] && seen[1][1] && (seen[0][1] || seen[0][0]) && (seen[0][2] || seen[0][3]));
    assert_memory_not_equal(colors[1][0], colors[1][1], 3);
    lam_image_free(&floats);
    lam_image_free(&bytes);
}

// The pixels whose linear numbers exceed 1, and the excess.
TEST(test_clipped)
{
    lam_camera camera;
    AUTO_SCENE scene = two_sheets(&camera);
    lam_draw_params params = {.samples = 4, .exposure = 0.6};
    AUTO_IMAGE picture = draw(scene, &camera, &params, 60, 60, LAM_RGBA32F);
    params.output = LAM_OUTPUT_CLIPPED;
    lam_image floats = draw(scene, &camera, &params, 60, 60, LAM_RGBA32F),
              bytes = draw(scene, &camera, &params, 60, 60, LAM_RGBA8);
    int marked = 0;
    for (int i = 0; i < 60 * 60; i++) {
        const float *p = (float *)picture.pixels + (ptrdiff_t)4 * i, *v = (float *)floats.pixels + (ptrdiff_t)4 * i;
        const uint8_t *b = (uint8_t *)bytes.pixels + (ptrdiff_t)4 * i;
        bool over = false;
        for (int c = 0; c < 3; c++) {
            float straight = p[3] > 0 ? p[c] / p[3] : 0;
            assert_true(v[c] == (straight > 1 ? straight - 1 : 0));
            over |= straight > 1;
        }
        assert_true((b[0] == 255 && b[1] == 0 && b[2] == 0) == over);
        assert_int_equal(b[3], p[3] > 0 ? 255 : 0);
        marked += over;
    }
    assert_true(marked > 1000 && marked < 60 * 60);
    lam_image_free(&floats);
    lam_image_free(&bytes);
}

// Coverage is the picture's alpha; tangents are unit vectors perpendicular to the normals; depth is the distance from
// the eye.
TEST(test_relations)
{
    AUTO_SCENE scene = full_scene(false);
    lam_camera camera = lam_camera_fit(scene, 96, 72, NULL);
    lam_draw_params params = {.samples = 8};
    lam_image picture = draw_show(scene, &camera, params, LAM_OUTPUT_PICTURE, 0);
    lam_image coverage = draw_show(scene, &camera, params, LAM_OUTPUT_COVERAGE, 0);
    lam_image normals = draw_show(scene, &camera, params, LAM_OUTPUT_NORMALS, 0);
    lam_image tangents = draw_show(scene, &camera, params, LAM_OUTPUT_TANGENTS, 0);
    lam_image n_h = draw_show(scene, &camera, params, LAM_OUTPUT_N_H, 1),
              n_l = draw_show(scene, &camera, params, LAM_OUTPUT_N_L, 1);
    int partly = 0;
    for (int i = 0; i < CHANNELS; i += 4) {
        const float *p = (float *)picture.pixels + i, *c = (float *)coverage.pixels + i,
                    *n = (float *)normals.pixels + i, *t = (float *)tangents.pixels + i;
        assert_true(c[0] == p[3]);
        partly += c[0] > 0 && c[0] < 1;
        assert_true((n[3] == 1) == (p[3] > 0));
        if (n[3] == 0)
            continue;
        double nn = 0, tt = 0, nt = 0;
        for (int k = 0; k < 3; k++) {
            nn += (double)n[k] * (double)n[k];
            tt += (double)t[k] * (double)t[k];
            nt += (double)n[k] * (double)t[k];
        }
        assert_true(fabs(nn - 1) < 1e-5 && fabs(tt - 1) < 1e-5 && fabs(nt) < 1e-5);
        assert_true(n[2] > -0.35f); // two-sided: towards the eye, except for the smooth normals of triangles at the rim
        float cosine = ((float *)n_l.pixels)[i], half = ((float *)n_h.pixels)[i];
        assert_true(cosine >= -1 && cosine <= 1 && half >= -1 && half <= 1);
    }
    assert_true(partly > 50);
    lam_image *all[] = {&picture, &coverage, &normals, &tangents, &n_h, &n_l};
    for (int i = 0; i < 6; i++)
        lam_image_free(all[i]);
}

TEST(test_names)
{
    for (int i = 0; i < LAM_OUTPUT_COUNT; i++) {
        assert_non_null(lam_output_name((lam_output)i));
        for (int k = 0; k < i; k++)
            assert_string_not_equal(lam_output_name((lam_output)i), lam_output_name((lam_output)k));
    }
    assert_null(lam_output_name(LAM_OUTPUT_COUNT));
    assert_true(lam_output_is_light(LAM_OUTPUT_PICTURE) && lam_output_is_light(LAM_OUTPUT_LIGHT));
    assert_false(lam_output_is_light(LAM_OUTPUT_NORMALS) || lam_output_is_light(LAM_OUTPUT_CLIPPED));
}

FIXTURE(set_up, tear_down)
