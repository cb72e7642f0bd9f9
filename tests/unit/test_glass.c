// test_glass.c: compares rough and thick glass with an evaluation in double: the exit point of light, absorption, blur;
// and coloured glass in front of nothing.
#include "test.h"

#include <lambent/explain.h>

enum { SIZE = 256 };

static lam_error error;

// The scene behind: at depth WALL, a square up to ±EXTENT, wider than the picture, whose light grows with x and y, or
// has a step at x = 0.
#define WALL   (-1.5)
#define EXTENT 4.0
#define EYE    6.0

static void wall_light(double x, double y, double out[3])
{
    out[0] = 0.5 + x / 10;
    out[1] = 0.5 + y / 12;
    out[2] = 0.4 + (x - y) / 30;
}

static void add_wall(lam_scene *scene, bool step)
{
    // Left half, right half.
    const float x[4] = {-(float)EXTENT, 0, 0, (float)EXTENT}, y = (float)EXTENT, z = (float)WALL;
    float positions[8][3], colors[8][4];
    for (int i = 0; i < 8; i++) {
        double light[3];
        positions[i][0] = x[i / 2];
        positions[i][1] = i % 2 ? y : -y;
        positions[i][2] = z;
        wall_light((double)positions[i][0], (double)positions[i][1], light);
        for (int c = 0; c < 3; c++)
            colors[i][c] = step ? (float)(i / 4) : (float)light[c];
        colors[i][3] = 1;
    }
    const uint32_t indices[12] = {0, 2, 3, 0, 3, 1, 4, 6, 7, 4, 7, 5};
    lam_mesh mesh = {.positions = positions[0],
                     .vertex_count = 8,
                     .indices = indices,
                     .triangle_count = 4,
                     .colors = colors,
                     .color_count = 8,
                     .colors_format = LAM_COLORS_LINEAR_F32};
    lam_material m = lam_material_default();
    m.unlit = true;
    m.diffuse = (lam_rgba){1, 1, 1, 1};
    lam_object o = lam_object_default();
    o.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    o.material = lam_scene_add_material(scene, &m, &error);
    if (lam_scene_add_object(scene, &o, &error) < 0)
        fail_msg("%s", error.text);
}

static lam_material glass_of(double ior, double roughness, double thickness)
{
    lam_material m = lam_material_default();
    m.physical = true;
    m.metallic = 0;
    m.diffuse = (lam_rgba){0.9f, 0.6f, 0.3f, 1};
    m.transmission = 1;
    m.ior = (float)ior;
    m.roughness = (float)roughness;
    m.thickness = (float)thickness;
    m.attenuation_distance = 0.8f;
    m.attenuation_color = (lam_rgb){0.7f, 0.9f, 0.4f};
    m.specular = m.ambient = (lam_rgb){0, 0, 0};
    return m;
}

static void add_glass(lam_scene *scene, const char *shape, const lam_material *material, const lam_mat4 *place)
{
    const lam_shape_params fine = {.slices = 512, .stacks = 256};
    lam_object o = lam_object_default();
    o.mesh = lam_scene_add_shape(scene, shape, strcmp(shape, "sphere") == 0 ? &fine : NULL, &error);
    o.material = lam_scene_add_material(scene, material, &error);
    o.transform = *place;
    o.one_sided = true;
    o.cull = LAM_CULL_BACK;
    if (lam_scene_add_object(scene, &o, &error) < 0)
        fail_msg("%s", error.text);
}

static lam_camera camera(void)
{
    lam_camera c = {0};
    c.eye = (lam_vec3){0, 0, EYE};
    c.up = (lam_vec3){0, 1, 0};
    c.fovy_rad = 0.5;
    return c;
}

static lam_image draw(const lam_scene *scene, lam_rgba background, int threads)
{
    lam_camera c = camera();
    lam_image image = {0};
    const lam_cpu_params cpu = {.threads = threads};
    lam_device *device = lam_device_cpu(&cpu, &error);
    const lam_draw_params params = {.rig = LAM_RIG_NONE, .tone = LAM_TONE_NONE, .samples = 1, .background = background};
    if (!device || !lam_image_make(&image, SIZE, SIZE, LAM_RGBA32F, &error) ||
        !lam_draw(device, scene, &c, &params, &image, NULL, &error))
        fail_msg("%s", error.text);
    lam_device_free(device);
    return image;
}

static const float *at(const lam_image *image, int x, int y)
{
    return (const float *)image->pixels + 4 * ((size_t)y * SIZE + (size_t)x);
}

// --- the evaluation, by angles

typedef struct ray {
    double from[3], along[3]; // unit
} ray;

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The ray from the eye through a point of the picture, in pixels.
static ray eye_ray(double x, double y)
{
    double half = tan(0.25);
    ray r = {{0, 0, EYE}, {(2 * x / SIZE - 1) * half, (1 - 2 * y / SIZE) * half, -1}};
    double length = sqrt(dot(r.along, r.along));
    for (int i = 0; i < 3; i++)
        r.along[i] /= length;
    return r;
}

// The position of a point in the picture.
static void picture_place(const double p[3], double *x, double *y)
{
    double half = tan(0.25) * (EYE - p[2]);
    *x = (p[0] / half + 1) * SIZE / 2;
    *y = (1 - p[1] / half) * SIZE / 2;
}

// The light visible through glass with the normal n at p: the wall's light at the position in the picture where light
// leaves the glass.
static void expected_light(const lam_material *m, const ray *r, const double p[3], const double n[3], double out[3])
{
    double c = -dot(r->along, n), angle = acos(c), inside = asin(sin(angle) / (double)m->ior), exit[3], x, y;
    for (int i = 0; i < 3; i++) {
        double side = sin(angle) > 1e-9 ? (r->along[i] + c * n[i]) / sin(angle) : 0; // unit vector along the surface
        exit[i] = p[i] + (double)m->thickness * (sin(inside) * side - cos(inside) * n[i]);
    }
    picture_place(exit, &x, &y);
    ray behind = eye_ray(x, y);
    double t = (WALL - EYE) / behind.along[2];
    wall_light(t * behind.along[0], t * behind.along[1], out);
    double f0 = pow(((double)m->ior - 1) / ((double)m->ior + 1), 2), f = f0 + (1 - f0) * pow(1 - c, 5);
    for (int k = 0; k < 3; k++)
        out[k] *= (1 - f) * (double)(&m->diffuse.r)[k] *
                  pow((double)(&m->attenuation_color.r)[k], (double)(m->thickness / m->attenuation_distance));
}

static double largest;

static void compare(const lam_image *image, int x, int y, const double expected[3], const char *name)
{
    for (int c = 0; c < 3; c++) {
        double off = fabs((double)at(image, x, y)[c] / expected[c] - 1);
        largest = off > largest ? off : largest;
        if (off > 0.01)
            fail_msg("%s: pixel %d,%d: %g, expected %g", name, x, y, (double)at(image, x, y)[c], expected[c]);
    }
}

// A pane that is tilted to the side and back, in front of the wall. A linear gradient of light is unchanged by blur.
TEST(test_panes)
{
    static const double numbers[][3] = {{1.5, 0, 0},     {1.5, 0, 0.7}, {2.4, 0, 0.7},
                                        {1.1, 0.3, 0.4}, {1.5, 0.4, 0}, {1.33, 0.6, 0.9}};
    const double turn = 0.6, cs = cos(turn), sn = sin(turn), lean = 0.3, cl = cos(lean), sl = sin(lean);
    // About y, then about x: the pane's z is the normal.
    const lam_mat4 place = {{{cs, 0, sn, 0}, {sl * sn, cl, -sl * cs, 0}, {-cl * sn, sl, cl * cs, 0}, {0, 0, 0, 1}}};
    const double n[3] = {sn, -sl * cs, cl * cs};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        lam_material m = glass_of(numbers[i][0], numbers[i][1], numbers[i][2]);
        AUTO_SCENE scene = lam_scene_make(&error);
        add_wall(scene, false);
        const float corners[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
        const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
        lam_mesh mesh = {.positions = corners[0], .vertex_count = 4, .indices = indices, .triangle_count = 2};
        lam_object o = lam_object_default();
        o.mesh = lam_scene_add_mesh(scene, &mesh, &error);
        o.material = lam_scene_add_material(scene, &m, &error);
        o.transform = place;
        assert_true(lam_scene_add_object(scene, &o, &error) >= 0);
        AUTO_IMAGE image = draw(scene, (lam_rgba){0, 0, 0, 0}, 1);
        for (int y = 90; y < 166; y += 5)
            for (int x = 90; x < 166; x += 5) {
                ray r = eye_ray(x + 0.5, y + 0.5);
                double t = -dot(r.from, n) / dot(r.along, n), expected[3];
                const double p[3] = {r.from[0] + t * r.along[0], r.from[1] + t * r.along[1],
                                     r.from[2] + t * r.along[2]};
                expected_light(&m, &r, p, n, expected);
                compare(&image, x, y, expected, "pane");
            }
    }
    print_message("panes: %.2g %% off at most\n", 100 * largest);
}

// Balls with their real thickness, and rough ones. At the rim, the facets of the mesh are visible.
TEST(test_balls)
{
    largest = 0;
    for (int rough = 0; rough < 2; rough++) {
        lam_material m = glass_of(1.5, 0.35 * rough, 1.2);
        AUTO_SCENE scene = lam_scene_make(&error);
        add_wall(scene, false);
        lam_mat4 place = lam_mat4_identity();
        add_glass(scene, "sphere", &m, &place);
        AUTO_IMAGE image = draw(scene, (lam_rgba){0, 0, 0, 0}, 1);
        int compared = 0;
        for (int y = 3; y < SIZE; y += 6)
            for (int x = 3; x < SIZE; x += 6) {
                ray r = eye_ray(x + 0.5, y + 0.5);
                double b = dot(r.from, r.along), root = b * b - (EYE * EYE - 1), expected[3];
                if (root < 0.19) // 0 is the rim
                    continue;
                double t = -b - sqrt(root);
                const double p[3] = {r.from[0] + t * r.along[0], r.from[1] + t * r.along[1],
                                     r.from[2] + t * r.along[2]};
                expected_light(&m, &r, p, p, expected);
                compare(&image, x, y, expected, "ball");
                compared++;
            }
        assert_true(compared > 200);
    }
    print_message("balls: %.2g %% off at most\n", 100 * largest);
}

// A step from 0 to 1 between two texels, filtered by a cubic B-spline, at a distance in texels.
static double spline_step(double distance)
{
    double sum = 0;
    for (int i = 0; i < 8; i++) { // the lit texels
        double t = fabs(distance - (i + 0.5));
        sum += t < 1 ? 2 / 3.0 - t * t * (1 - t / 2) : t < 2 ? pow(2 - t, 3) / 6 : 0;
    }
    return sum;
}

// A step behind rough glass. Its width, 256 · 1024^(0.4 − 1) = 4 pixels, is the width of the texels of level 2, one of
// whose edges is at the step.
TEST(test_step)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    lam_material m = glass_of(1.5, 0.4, 0);
    lam_mat4 place = lam_mat4_identity();
    add_wall(scene, true);
    add_glass(scene, "sphere", &m, &place);
    AUTO_IMAGE image = draw(scene, (lam_rgba){0, 0, 0, 0}, 1);
    double whole = (double)at(&image, SIZE / 2 + 40, SIZE / 2)[0];
    const double expected = 0.9 * 0.96;
    assert_true(fabs(whole / expected - 1) < 0.01);
    double middle = ((double)at(&image, SIZE / 2 - 1, SIZE / 2)[0] + (double)at(&image, SIZE / 2, SIZE / 2)[0]) / 2;
    assert_true(fabs(middle / whole - 0.5) < 0.01);
    for (int x = 0; x < 24; x++) {
        double share = (double)at(&image, SIZE / 2 - 12 + x, SIZE / 2)[0] / whole;
        assert_true(fabs(share - spline_step((x - 11.5) / 4)) < 1e-3);
    }
}

// Coloured glass in front of nothing: over white, the transparent picture equals the picture drawn over white, for any
// glass; and a picture with a background needs no white.
TEST(test_over_white)
{
    for (int i = 0; i < 3; i++) {
        AUTO_SCENE scene = lam_scene_make(&error);
        lam_material m = glass_of(i == 0 ? 1 : 1.5, i == 2 ? 0.5 : 0, 0.6);
        lam_mat4 place = lam_mat4_identity();
        m.emission = (lam_rgb){0.05f, 0, 0.1f};
        add_glass(scene, "sphere", &m, &place);
        lam_image clear = draw(scene, (lam_rgba){0, 0, 0, 0}, 1), white = draw(scene, (lam_rgba){1, 1, 1, 1}, 3);
        const float *p = at(&clear, SIZE / 2, SIZE / 2);
        assert_true(p[3] > 0.2f && p[3] < 0.95f && p[0] > 1.3f * p[2]);
        for (int k = 0; k < SIZE * SIZE; k++) {
            const float *a = at(&clear, k % SIZE, k / SIZE), *b = at(&white, k % SIZE, k / SIZE);
            for (int c = 0; c < 3; c++)
                assert_true(fabsf(a[c] + (1 - a[3]) - b[c]) < 2e-6f);
        }
        lam_image_free(&clear);
        lam_image_free(&white);
    }
}

// The explanation of a pixel of thick, rough glass adds up to the pixel.
TEST(test_explained)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    lam_material m = glass_of(1.5, 0.3, 0.8);
    lam_mat4 place = lam_mat4_identity();
    m.emission = (lam_rgb){0.05f, 0, 0.1f};
    add_wall(scene, false);
    add_glass(scene, "sphere", &m, &place);
    AUTO_IMAGE image = draw(scene, (lam_rgba){0, 0, 0, 0}, 1);
    const lam_camera c = camera();
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    const lam_draw_params params = {.rig = LAM_RIG_NONE, .tone = LAM_TONE_NONE, .samples = 1};
    lam_explanation *e = lam_explain(device, scene, &c, &params, SIZE, SIZE, LAM_RGBA32F, 140, 110, NULL, &error);
    SUCCEEDS(e);
    assert_memory_equal(&e->result, at(&image, 140, 110), sizeof e->result);
    assert_true(e->fragments[0].point_count == 1 && e->fragments[0].points[0].layers);
    const lam_explained_layers *layers = e->fragments[0].points[0].layers;
    assert_true(fabsf(layers->behind_x) > 1 && fabsf(layers->behind_y) > 1);
    assert_true(fabs((double)layers->behind_blur / (SIZE * pow(1024, -0.7)) - 1) < 1e-4);
    float sum[3] = {e->behind.r, e->behind.g, e->behind.b};
    for (int i = 0; i < e->fragment_count; i++)
        for (int k = 0; k < 3; k++)
            sum[k] += e->fragments[i].weight * (&e->fragments[i].color.r)[k] * e->fragments[i].color.a;
    for (int k = 0; k < 3; k++)
        assert_true(fabsf(sum[k] - (&e->sum.r)[k]) < 1e-6f);
    assert_true(e->fragments[e->fragment_count - 1].weight == 0); // the wall is visible at another position
    lam_explanation_free(e);
}
