// test_shadows.c: the share of light that passes blocking surfaces, in pictures and explanations.
#include "test.h"
#include "device_fixture.h"

#include <lambent/explain.h>

enum { SIZE = 64 };

static lam_error error;

// A floor of side 8 at y = 0, seen from above.
static lam_camera camera;

static int add_plate(lam_scene *scene, double side, double y, double x, float alpha)
{
    lam_material m = lam_material_default();
    m.diffuse = (lam_rgba){1, 1, 1, alpha};
    lam_object o = lam_object_default();
    o.mesh = lam_scene_add_shape(scene, "plane", NULL, &error);
    o.material = lam_scene_add_material(scene, &m, &error);
    o.transform.m[0][0] = o.transform.m[2][2] = side / 2;
    o.transform.m[1][3] = y;
    o.transform.m[0][3] = x;
    int index = lam_scene_add_object(scene, &o, &error);
    assert_true(index >= 0);
    return index;
}

static lam_scene *floor_scene(void)
{
    lam_scene *scene = lam_scene_make(&error);
    add_plate(scene, 8, 0, 0, 1);
    camera = lam_camera_default();
    camera.eye = (lam_vec3){0, 20, 0.01};
    camera.target = (lam_vec3){0, 0, 0};
    camera.ortho_half_height = 4;
    return scene;
}

static lam_light *sun(void)
{
    static lam_light l;
    l = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    l.direction = (lam_vec3){0.3, -1, 0};
    return &l;
}

static const lam_draw_params with = {.shadows = true, .samples = 1};

static lam_image draw(const lam_scene *scene, lam_draw_params params)
{
    return draw_square(scene, &camera, &params, SIZE);
}

// The share of light 0 that reaches a point of the floor (x, 0, z), or of a surface over it.
static lam_explained_light explained(const lam_scene *scene, lam_draw_params params, double x, double z)
{
    int px = (int)((x + 4) / 8 * SIZE), py = (int)((z + 4) / 8 * SIZE);
    lam_explanation *e = lam_explain(device, scene, &camera, &params, SIZE, SIZE, LAM_RGBA32F, px, py, NULL, &error);
    SUCCEEDS(e);
    const lam_explained_fragment *f = &e->fragments[e->fragment_count - 1]; // the floor: opaque surfaces come last
    lam_explained_light light = f->points[0].lights[0];
    lam_explanation_free(e);
    return light;
}

// --- layers

// Translucent plates over one another multiply; masked ones pass everything or nothing; an opaque one passes nothing.
TEST(test_layers)
{
    AUTO_SCENE scene = floor_scene();
    const float alphas[] = {0.25f, 0.5f, 0.125f};
    for (int i = 0; i < 3; i++)
        add_plate(scene, 1, 1, -2 + 2 * i, alphas[i]); // apart
    for (int i = 0; i < 3; i++)
        add_plate(scene, 1.0 - 0.1 * i, 10 + i, 0.5, alphas[i]); // over one another, out of the camera's sight
    lam_scene_add_light(scene, sun(), &error);
    sun()->direction = (lam_vec3){0, -1, 0};
    lam_light straight = *sun();
    straight.direction = (lam_vec3){0.05, -1, 0};
    assert_true(lam_scene_set_light(scene, 0, &straight, &error));
    // The layers at y = 10…12 over x = 0.5 cast shadows on x = 1 … 1.1.
    lam_explained_light l = explained(scene, with, 1.05, 0);
    assert_true(fabs((double)l.passed.r - 0.75 * 0.5 * 0.875) < 1e-6);
    assert_true(l.casts_shadows && l.shadow_object == 4 && fabs((double)l.shadow_distance - 10 * sqrt(1.0025)) < 1e-3);
    assert_true(explained(scene, with, 3.5, 3).passed.r == 1);
    lam_material m;
    for (int i = 0; i < 3; i++) { // masked: the second has an alpha equal to its cutoff, and remains
        m = *lam_scene_material(scene, 4 + i);
        m.alpha_mode = LAM_ALPHA_MASK;
        m.alpha_cutoff = 0.5f;
        assert_true(lam_scene_set_material(scene, 4 + i, &m, &error));
    }
    assert_true(explained(scene, with, 1.05, 0).passed.r == 0);
    m.diffuse.a = 0.4f;
    assert_true(lam_scene_set_material(scene, 5, &m, &error));
    assert_true(explained(scene, with, 1.05, 0).passed.r == 1);
    m.alpha_mode = LAM_ALPHA_OPAQUE; // for any alpha
    assert_true(lam_scene_set_material(scene, 5, &m, &error));
    assert_true(explained(scene, with, 1.05, 0).passed.r == 0);
}

// The sides of a plate may pass different shares: the side that the light hits decides.
TEST(test_sides)
{
    for (int mirrored = 0; mirrored < 2; mirrored++)
        for (int below = 0; below < 2; below++) {
            AUTO_SCENE scene = floor_scene();
            int plate = add_plate(scene, 2, 10, 0, 0.25f);
            lam_object o = *lam_scene_object(scene, plate);
            lam_material m = *lam_scene_material(scene, o.material);
            m.diffuse.a = 0.5f;
            o.back_material = lam_scene_add_material(scene, &m, &error);
            if (mirrored)
                o.transform.m[0][0] = -o.transform.m[0][0];
            if (below) // upside down
                for (int i = 0; i < 3; i++)
                    o.transform.m[i][1] = -o.transform.m[i][1], o.transform.m[i][2] = -o.transform.m[i][2];
            assert_true(lam_scene_set_object(scene, plate, &o, &error));
            lam_light l = *sun();
            lam_scene_add_light(scene, &l, &error);
            assert_true(explained(scene, with, 3, 0).passed.r == (below ? 0.5f : 0.75f));
        }
}

// --- which objects cast shadows, and where

TEST(test_lights)
{
    AUTO_SCENE scene = floor_scene();
    add_plate(scene, 2, 3, 0, 1);
    lam_light l = *sun();
    lam_scene_add_light(scene, &l, &error);
    lam_image bare = draw(scene, (lam_draw_params){.samples = 1}), shadowed = draw(scene, with);
    assert_true(memcmp(bare.pixels, shadowed.pixels, SIZE * SIZE * 16) != 0);
    lam_frame_report report;
    lam_device_report(device, &report);
    assert_true(report.rays > 1000 && report.rays <= report.points_lit);
    lam_image_free(&shadowed);
    // A light without shadows, and a picture without shadows, do not change.
    l.no_shadows = true;
    assert_true(lam_scene_set_light(scene, 0, &l, &error));
    shadowed = draw(scene, with);
    assert_memory_equal(bare.pixels, shadowed.pixels, SIZE * SIZE * 16);
    lam_device_report(device, &report);
    assert_true(report.rays == 0);
    lam_image_free(&shadowed);
    // Ambient light and emission do not change: the shadow removes the light's own terms, once.
    l.no_shadows = false;
    lam_scene_set_light(scene, 0, &l, &error);
    lam_scene_set_ambient(scene, (lam_rgb){0.3f, 0.3f, 0.3f});
    for (int output = LAM_OUTPUT_AMBIENT; output <= LAM_OUTPUT_EMISSION; output++) {
        if (output == LAM_OUTPUT_DIFFUSE || output == LAM_OUTPUT_SPECULAR)
            continue;
        lam_draw_params a = {.samples = 1, .output = (lam_output)output}, b = with;
        b.output = (lam_output)output;
        lam_image without = draw(scene, a), also = draw(scene, b);
        assert_memory_equal(without.pixels, also.pixels, SIZE * SIZE * 16);
        lam_image_free(&without);
        lam_image_free(&also);
    }
    // Two lights at one position: each loses its own terms.
    lam_scene_add_light(scene, &l, &error);
    AUTO_IMAGE sum = draw(scene, with);
    lam_draw_params one = with;
    one.output = LAM_OUTPUT_LIGHT;
    AUTO_IMAGE light = draw(scene, one);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const float *s = (const float *)sum.pixels + 4 * i, *p = (const float *)light.pixels + 4 * i;
        assert_true(fabs((double)s[0] - 2 * (double)p[0] - 0.3 * (double)lam_material_default().ambient.r) < 1e-5);
    }
    lam_image_free(&bare);
}

// A point, a spot and a directional light cast the same shadow; culled objects also cast it; an object behind the light
// does not.
TEST(test_kinds)
{
    for (int kind = LAM_LIGHT_POINT; kind <= LAM_LIGHT_SPOT; kind++) {
        AUTO_SCENE scene = floor_scene();
        int plate = add_plate(scene, 1, 2, 1, 1);
        lam_light l = lam_light_default((lam_light_type)kind);
        l.direction = (lam_vec3){0, -1, 0};
        l.position = (lam_vec3){1, 1000, 0};
        l.cutoff_rad = 0;
        lam_scene_add_light(scene, &l, &error);
        for (int i = 0; i < 3; i++) {
            lam_object o = *lam_scene_object(scene, plate);
            o.cull = (lam_cull)i;
            lam_scene_set_object(scene, plate, &o, &error);
            lam_draw_params params = with;
            AUTO_IMAGE image = draw(scene, params);
            const float *under = (const float *)image.pixels + 4 * (SIZE / 2 * SIZE + SIZE * 5 / 8);
            // From above, the plate hides its own shadow, unless it is culled.
            assert_true(o.cull == LAM_CULL_BACK || o.cull == LAM_CULL_NONE ? under[0] > 0.1f : under[0] == 0);
        }
        if (kind != LAM_LIGHT_DIRECTIONAL) {
            l.position.y = 1.5;
            lam_scene_set_light(scene, 0, &l, &error);
            lam_object o = *lam_scene_object(scene, plate);
            o.cull = LAM_CULL_FRONT;
            lam_scene_set_object(scene, plate, &o, &error);
            assert_true(explained(scene, with, 1, 0).passed.r == 1);
        }
    }
}

// --- soft shadows

TEST(test_soft)
{
    AUTO_SCENE scene = floor_scene();
    add_plate(scene, 2000, 4, 1000, 1); // its edge is above x = 0
    lam_light l = *sun();
    l.direction = (lam_vec3){0, -1, 0};
    l.angular_radius_rad = 0.2f;
    lam_scene_add_light(scene, &l, &error);
    lam_object o = *lam_scene_object(scene, 1);
    o.cull = LAM_CULL_FRONT; // so that the camera sees through it
    lam_scene_set_object(scene, 1, &o, &error);
    double radius = 4 * tan(0.2), worst = 0, sum = 0;
    for (int n = 16; n <= 256; n *= 4)
        for (double x = -1.95; x < 1.5; x += 0.125) {
            lam_draw_params params = with;
            params.shadow_samples = n;
            double at = ((int)((x + 4) / 8 * SIZE) + 0.5) / SIZE * 8 - 4, h = -at / radius;
            double share = h >= 1 ? 1 : h <= -1 ? 0 : 0.5 + (h * sqrt(1 - h * h) + asin(h)) / 3.14159265358979;
            double passed = (double)explained(scene, params, x, 0).passed.r;
            int points = n > 48 ? 1024 : n; // the plate's triangles cover points of the light, without rays
            assert_true(fabs(passed * points - round(passed * points)) < 1e-3);
            double off = fabs(passed - share);
            worst = n == 256 && off > worst ? off : worst;
            sum += n == 256 ? passed - share : 0;
            assert_true(off < 2.0 / sqrt(n) && (share > 0 || passed == 0) && (share < 1 || passed == 1));
        }
    assert_true(worst < 0.02 && fabs(sum) < 0.05);
    // A ball of the same size at the same distance.
    l = lam_light_default(LAM_LIGHT_POINT);
    l.position = (lam_vec3){0, 8, 0};
    l.radius = 1;
    lam_scene_set_light(scene, 0, &l, &error);
    lam_draw_params params = with;
    params.shadow_samples = 256;
    assert_true(fabs((double)explained(scene, params, 0.07, 0).passed.r - 0.5) < 0.1);
    assert_true(explained(scene, params, -1.2, 0).passed.r == 1 && explained(scene, params, 1.2, 0).passed.r == 0);
}

// --- acne and the terminator

static int count_dark(const lam_image *shadowed, const lam_image *bare, float least)
{
    int dark = 0;
    for (int i = 0; i < bare->width * bare->height; i++) {
        const float *a = (const float *)bare->pixels + 4 * i, *b = (const float *)shadowed->pixels + 4 * i;
        dark += a[3] > 0 && a[0] > least && b[0] < a[0];
    }
    return dark;
}

// A single convex body has no shadow except its own dark side: with the correction, no point is shadowed where n·l > 0;
// without it, the terminator of a coarse ball is shadowed, but not with flat shading.
TEST(test_convex)
{
    for (int size = -20; size <= 20; size += 20)
        for (int slices = 8; slices <= 64; slices *= 2) {
            AUTO_SCENE scene = lam_scene_make(&error);
            lam_shape_params shape = {.slices = slices, .stacks = slices / 2};
            lam_object o = lam_object_default();
            o.mesh = lam_scene_add_shape(scene, "sphere", &shape, &error);
            for (int i = 0; i < 3; i++)
                o.transform.m[i][i] = pow(2, size);
            o.transform.m[0][3] = pow(2, size) * 1e3; // away from zero
            lam_scene_add_object(scene, &o, &error);
            lam_light l = *sun();
            l.direction = (lam_vec3){-1, -0.3, -0.2};
            lam_scene_add_light(scene, &l, &error);
            camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
            lam_draw_params bare = {.samples = 1, .output = LAM_OUTPUT_LIGHT}, cured = bare, literal, flat;
            cured.shadows = true;
            literal = flat = cured;
            literal.flat_terminator = true;
            flat.shading = LAM_SHADING_FLAT;
            lam_image a = draw(scene, bare), b = draw(scene, cured), c = draw(scene, literal);
            assert_int_equal(count_dark(&b, &a, 0), 0);
            if (slices < 32)
                assert_true(count_dark(&c, &a, 0) > 10);
            lam_image_free(&a);
            lam_image_free(&b);
            lam_image_free(&c);
            // Samples at edges, where the light falls steeply: no neighbour blocks it.
            lam_draw_params edges = bare, edges_literal = literal;
            edges.samples = edges_literal.samples = 8;
            a = draw(scene, edges);
            b = draw(scene, edges_literal);
            assert_int_equal(count_dark(&b, &a, 0.5f), 0);
            lam_image_free(&a);
            lam_image_free(&b);
            bare.shading = LAM_SHADING_FLAT;
            a = draw(scene, bare);
            b = draw(scene, flat);
            assert_int_equal(count_dark(&b, &a, 0), 0);
            lam_image_free(&a);
            lam_image_free(&b);
        }
}

// Models from files: single pixels that are dark among lit neighbours. Most of them are tips of real shadows; rays that
// hit their own surface would cause many times as many.
TEST(test_models)
{
    static const char *const names[] = {"obj/cat/cat-low-resolution.obj",
                                        "obj/koala/koala.obj",
                                        "obj/boat/boat.obj",
                                        "obj/fish/fish.obj",
                                        "obj/spot/spot.obj",
                                        "stl/trimesh/featuretype.stl",
                                        "ply/trimesh/featuretype.ply",
                                        "stl/trimesh/20mm-xyz-cube.stl",
                                        "obj/cornell_box/cornell_box.obj"};
    enum { SIDE = 512 };
    static uint8_t dark[SIDE * SIDE], lit[SIDE * SIDE];
    const char *folder = getenv("LAMBENT_MODELS");
    int models = 0;
    double alone = 0, covered = 0;
    for (size_t m = 0; m < sizeof names / sizeof *names; m++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", folder ? folder : ".", names[m]);
        AUTO_SCENE scene = lam_scene_load(path, NULL, NULL, &error);
        if (!scene)
            continue;
        models++;
        lam_light l = *sun();
        l.frame = LAM_FRAME_CAMERA;
        l.direction = (lam_vec3){-0.4, -0.7, -0.6};
        lam_scene_clear_lights(scene);
        lam_scene_add_light(scene, &l, &error);
        camera = lam_camera_fit(scene, SIDE, SIDE, NULL);
        lam_image image[2] = {{0}};
        for (int i = 0; i < 2; i++) {
            lam_draw_params params = {
                .samples = 1, .shadows = i, .output = LAM_OUTPUT_LIGHT, .reflection = LAM_REFLECTION_LAMBERT};
            assert_true(lam_image_make(&image[i], SIDE, SIDE, LAM_RGBA32F, &error));
            assert_true(lam_draw(device, scene, &camera, &params, &image[i], NULL, &error));
        }
        for (int i = 0; i < SIDE * SIDE; i++) {
            const float *a = (const float *)image[0].pixels + 4 * i, *b = (const float *)image[1].pixels + 4 * i;
            lit[i] = a[0] > 0.02f;
            dark[i] = lit[i] && b[0] < 0.5f * a[0];
            covered += a[3] > 0;
        }
        for (int y = 1; y < SIDE - 1; y++)
            for (int x = 1; x < SIDE - 1; x++) {
                int others = 0, i = y * SIDE + x;
                for (int k = 0; k < 9; k++)
                    others += dark[i + (k / 3 - 1) * SIDE + k % 3 - 1];
                alone += dark[i] && others == 1;
            }
        lam_image_free(&image[0]);
        lam_image_free(&image[1]);
    }
    if (!models)
        skip();
    print_message("%d models: %g of %g pixels alone are dark\n", models, alone, covered);
    assert_true(alone <= 1e-4 * covered);
}

// A box on the floor: the shadow begins at its foot, and the floor next to it is lit up to the edge.
TEST(test_contact)
{
    AUTO_SCENE scene = floor_scene();
    lam_object o = lam_object_default();
    o.mesh = lam_scene_add_shape(scene, "cube", NULL, &error);
    o.transform.m[0][0] = o.transform.m[1][1] = o.transform.m[2][2] = 0.5;
    o.transform.m[1][3] = 0.5;
    lam_scene_add_object(scene, &o, &error);
    lam_light l = *sun();
    l.direction = (lam_vec3){1, -1, 0};
    lam_scene_add_light(scene, &l, &error);
    for (double z = -0.4; z < 0.4; z += 0.05) {
        assert_true(explained(scene, with, 0.56, z).passed.r == 0);
        assert_true(explained(scene, with, 1.4, z).passed.r == 0);
        assert_true(explained(scene, with, 1.6, z).passed.r == 1);
        assert_true(explained(scene, with, -0.56, z).passed.r == 1);
    }
}

// Two plates at the same place, such as the sides of a sheet: neither shadows the other.
TEST(test_twins)
{
    AUTO_SCENE scene = floor_scene();
    add_plate(scene, 8, 0, 0, 1);
    lam_light l = *sun();
    lam_scene_add_light(scene, &l, &error);
    lam_image a = draw(scene, (lam_draw_params){.samples = 1}), b = draw(scene, with);
    assert_memory_equal(a.pixels, b.pixels, SIZE * SIZE * 16);
    lam_image_free(&a);
    lam_image_free(&b);
}

// Adds overlapping triangles in one plane, in general position: the corners of two pentagons, whose coordinates are
// rounded to floats. `spread` of the normals makes rays start above the plane (the correction of the terminator). *n
// gets the plane's normal.
static void add_pentagons(lam_scene *scene, double turn, double spread, lam_vec3 *n)
{
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 1, 3, 4, 5, 6, 7, 6, 8, 9, 5, 7, 9};
    float positions[10][3], normals[10][3];
    lam_mat4 m = lam_mat4_rotation((lam_vec3){1, 2 - turn, turn}, turn);
    for (int k = 0; k < 10; k++) {
        double size = k < 5 ? 1 : 0.6, u = size * cos(1.2566370614 * k), v = size * sin(1.2566370614 * k);
        for (int i = 0; i < 3; i++) {
            double flat = m.m[i][0] * u + m.m[i][1] * v;
            positions[k][i] = (float)(flat + 2 * turn);
            normals[k][i] = (float)(m.m[i][2] + spread * flat);
        }
    }
    lam_mesh mesh = {.positions = positions[0],
                     .normals = normals[0],
                     .vertex_count = 10,
                     .normal_count = 10,
                     .indices = corners,
                     .triangle_count = sizeof corners / sizeof *corners / 3};
    lam_object o = lam_object_default();
    o.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    assert_true(o.mesh >= 0 && lam_scene_add_object(scene, &o, &error) >= 0);
    *n = (lam_vec3){m.m[0][2], m.m[1][2], m.m[2][2]};
}

// None of them shadows another for any position of the light: above, beside, or below, where spread normals still face
// it.
TEST(test_coplanar)
{
    for (int turn = 1; turn < 17; turn++) {
        AUTO_SCENE scene = lam_scene_make(&error);
        lam_vec3 n;
        double middle = 2 * 0.35 * turn;
        add_pentagons(scene, 0.35 * turn, turn % 2 ? 0 : 0.2, &n);
        camera = lam_camera_default();
        camera.target = (lam_vec3){middle, middle, middle};
        camera.eye = (lam_vec3){middle + n.x, middle + n.y, middle + n.z};
        camera.ortho_half_height = 1;
        for (int k = 0; k < 3; k++) {
            const double rise = k == 0 ? -1 : k == 1 ? -0.1 : 0.1;
            lam_light l = lam_light_default(LAM_LIGHT_DIRECTIONAL);
            l.direction = (lam_vec3){n.y - n.z + rise * n.x, n.z - n.x + rise * n.y, n.x - n.y + rise * n.z};
            assert_true(lam_scene_add_light(scene, &l, &error) >= 0);
        }
        for (int shading = LAM_SHADING_PHONG; shading <= LAM_SHADING_FLAT; shading++) {
            lam_draw_params params = {.samples = 1, .shading = (lam_shading)shading};
            AUTO_IMAGE without = draw(scene, params);
            params.shadows = true;
            AUTO_IMAGE shadowed = draw(scene, params);
            assert_int_equal(count_dark(&shadowed, &without, 0), 0);
        }
    }
}

// A sheet right above another shadows it, unless it is closer than the rounding of numbers. It is culled, so that one
// sees through it.
TEST(test_near_sheet)
{
    for (int apart = 0; apart < 2; apart++) {
        AUTO_SCENE scene = floor_scene();
        int sheet = add_plate(scene, 1, apart ? 1e-12 : 1e-20, 0.5, 1);
        lam_object o = *lam_scene_object(scene, sheet);
        o.cull = LAM_CULL_FRONT;
        assert_true(lam_scene_set_object(scene, sheet, &o, &error) && lam_scene_add_light(scene, sun(), &error) >= 0);
        assert_true(explained(scene, with, 0.5, 0.2).passed.r == (apart ? 0 : 1));
    }
}

// Limits: a memory limit that the hierarchy exceeds, and parameters out of range.
TEST(test_refused)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    lam_shape_params shape = {.slices = 400, .stacks = 400};
    lam_object o = lam_object_default();
    o.mesh = lam_scene_add_shape(scene, "sphere", &shape, &error);
    lam_scene_add_object(scene, &o, &error);
    lam_light l = *sun();
    lam_scene_add_light(scene, &l, &error);
    camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
    AUTO_DEVICE own = lam_device_cpu(&(lam_cpu_params){.threads = 1}, &error);
    AUTO_IMAGE image = {0};
    lam_image_make(&image, SIZE, SIZE, LAM_RGBA8, &error);
    lam_draw_params params = {.samples = 1};
    lam_control control = {.memory_limit_bytes = 14 << 20};
    assert_true(lam_draw(own, scene, &camera, &params, &image, &control, &error));
    params.shadows = true;
    assert_false(lam_draw(own, scene, &camera, &params, &image, &control, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    assert_true(lam_draw(own, scene, &camera, &params, &image, NULL, &error));
    lam_frame_report first, second;
    lam_device_report(own, &first);
    assert_true(lam_draw(own, scene, &camera, &params, &image, NULL, &error));
    lam_device_report(own, &second);
    assert_true(first.hierarchy_ms > 0 && second.hierarchy_ms == 0 && first.rays == second.rays && first.rays > 0);
    for (int n = -1; n <= 257; n += 258) {
        params.shadow_samples = n;
        assert_false(lam_draw(own, scene, &camera, &params, &image, NULL, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    }
}

FIXTURE(set_up, tear_down)
