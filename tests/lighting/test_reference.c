// test_reference.c: compares the integral of environment light by fixed directions (lam_draw_params.reference) with
// quadrature in double precision, implemented from docs/lighting/physical.md independently with libm.

#include "test.h"
#include "environment_scene.h"
#include "layered_textbook.h"

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

static void check_integral(int directions, double half, double most)
{
    static double out[1000];
    size_t count = differences(directions, out, 1000);
    assert_true(count > 150);
    print_message("%d directions: off by %.2g for half, %.2g for nine tenths, %.2g at most, of %zu numbers\n",
                  directions, out[count / 2], out[count * 9 / 10], out[count - 1], count);
    assert_true(out[count / 2] < half && out[count * 9 / 10] < most);
}

TEST(test_integral)
{
    check_integral(1024, 0.002, 0.005);
    check_integral(4096, 0.001, 0.002);
}

// --- layers

// Materials with every combination of a clear coat, sheen, anisotropy and iridescence, from dielectrics to metals. The coat is smooth over a rough base, or rough over a smooth one.
enum { COMBINATIONS = 16, PIXELS = 32, PLACES = 4 };
static const int layer_bits[4] = {LAYER_CLEARCOAT, LAYER_SHEEN, LAYER_ANISOTROPY, LAYER_IRIDESCENCE};

static struct point layered_point(int number, int *set)
{
    *set = LAYER_DIELECTRIC;
    for (int i = 0; i < 4; i++)
        *set |= number >> i & 1 ? layer_bits[i] : 0;
    bool smooth = number % 3 != 0;
    struct point p = {.base = {0.9, 0.55, 0.2},
                      .metallic = number % 5 == 4 ? 1 : 0.25 * (number % 5),
                      .roughness = smooth ? 0.8 : 0.25,
                      .ior = 1.7,
                      .weight = 0.75,
                      .color = {1, 1, 1},
                      .coat = *set & LAYER_CLEARCOAT ? 1 : 0,
                      .coat_roughness = smooth ? 0.0625 : 0.5,
                      .sheen_roughness = number % 2 ? 0.25 : 0.75,
                      .strength = *set & LAYER_ANISOTROPY ? 0.75 : 0,
                      .iridescence = *set & LAYER_IRIDESCENCE ? 1 : 0,
                      .film_ior = 1.5,
                      .film = 400};
    for (int i = 0; i < 3; i++)
        p.sheen[i] = *set & LAYER_SHEEN ? 0.5 + 0.25 * i : 0;
    return p;
}

static lam_material material_of(const struct point *p)
{
    lam_material m = lam_material_default();
    m.physical = true;
    m.diffuse = (lam_rgba){(float)p->base[0], (float)p->base[1], (float)p->base[2], 1};
    m.metallic = (float)p->metallic;
    m.roughness = (float)p->roughness;
    m.ior = (float)p->ior;
    m.specular_weight = (float)p->weight;
    m.clearcoat = (float)p->coat;
    m.clearcoat_roughness = (float)p->coat_roughness;
    m.sheen_color = (lam_rgb){(float)p->sheen[0], (float)p->sheen[1], (float)p->sheen[2]};
    m.sheen_roughness = (float)p->sheen_roughness;
    m.anisotropy = (float)p->strength;
    m.iridescence = (float)p->iridescence;
    m.iridescence_ior = (float)p->film_ior;
    m.iridescence_thickness_max = (float)p->film;
    return m;
}

// The light that the point p reflects, over pi: a plain sum over all directions, in double. The rings are denser around
// the mirrored direction, by the third power.
static void brute_force(struct point *p, int set, double out[3])
{
    enum { CIRCLES = 400, SPOKES = 240 };
    vector middle = unit(sum(times(2 * dot(p->n, p->v), p->n), times(-1, p->v)));
    double m[3] = {middle.x, middle.y, middle.z}, x[3], y[3];
    frame_around(m, x, y);
    memset(out, 0, 3 * sizeof *out);
    for (int i = 0; i < CIRCLES; i++) {
        double u = (i + 0.5) / CIRCLES, angle = PI * u * u * u, step = 3 * PI * u * u / CIRCLES;
        for (int k = 0; k < SPOKES; k++) {
            double turn = 2 * PI * (k + (i % 2) * 0.5) / SPOKES, l[3], light[3], diffuse, specular[3];
            for (int j = 0; j < 3; j++)
                l[j] = (x[j] * cos(turn) + y[j] * sin(turn)) * sin(angle) + m[j] * cos(angle);
            p->l = (vector){l[0], l[1], l[2]};
            if (dot(p->n, p->l) <= 0)
                continue;
            layered_textbook(p, set, &diffuse, specular);
            radiance(l, light);
            double solid = sin(angle) * step * 2 / SPOKES; // over pi
            for (int j = 0; j < 3; j++)
                out[j] += solid * light[j] * (diffuse * p->base[j] * (1 - p->metallic) + specular[j]);
        }
    }
}

// A ball of a material, in linear floats.
static lam_image draw_ball(const lam_environment *environment, const lam_material *material, lam_draw_params params)
{
    lam_error error;
    lam_scene *scene = lam_scene_make(&error);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 256, .stacks = 256}, &error);
    object.material = lam_scene_add_material(scene, material, &error);
    assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
    assert_true(lam_scene_set_environment(scene, environment, 0, &error));
    lam_camera camera = {.eye = {0, 0, 24}, .up = {0, 1, 0}, .ortho_half_height = 1};
    lam_image image = {0};
    lam_device *device = lam_device_cpu(NULL, &error);
    assert_true(lam_image_make(&image, PIXELS, PIXELS, LAM_RGBA32F, &error));
    params.samples = 1;
    params.rig = LAM_RIG_NONE;
    params.occlusion = LAM_OCCLUSION_OFF;
    SUCCEEDS(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    lam_device_free(device);
    lam_scene_free(scene);
    return image;
}

// For every combination of layers, 4096 directions are within 0.5 % of the sum over all directions, and within 0.2 % in
// the mean.
TEST(test_layers)
{
    static const int places[PLACES][2] = {{16, 16}, {9, 11}, {25, 20}, {3, 14}};
    lam_environment *environment = make_environment();
    for (int number = 0; number < COMBINATIONS; number++) {
        int set, count = 0;
        struct point p = layered_point(number, &set);
        lam_material material = material_of(&p);
        lam_image picture = draw_ball(environment, &material, (lam_draw_params){.reference = 4096}),
                  normals = draw_ball(environment, &material, (lam_draw_params){.output = LAM_OUTPUT_NORMALS}),
                  tangents = draw_ball(environment, &material, (lam_draw_params){.output = LAM_OUTPUT_TANGENTS});
        double worst = 0, mean = 0;
        for (int i = 0; i < PLACES; i++) {
            size_t at = 4 * (size_t)(places[i][1] * PIXELS + places[i][0]);
            const float *n = (const float *)normals.pixels + at, *t = (const float *)tangents.pixels + at,
                        *found = (const float *)picture.pixels + at;
            double expected[3];
            p.n = unit((vector){(double)n[0], (double)n[1], (double)n[2]});
            p.coat_n = p.n;
            p.v = (vector){0, 0, 1};
            p.t = set & LAYER_ANISOTROPY ? (vector){(double)t[0], (double)t[1], (double)t[2]} : p.n;
            brute_force(&p, set, expected);
            for (int c = 0; c < 3; c++) {
                double error = fabs((double)found[c] - expected[c]) / fmax(expected[c], 0.02);
                if (error > 0.005)
                    fail_msg("combination %d, pixel %d, %d, channel %d: %.5f, the sum is %.5f", number, places[i][0],
                             places[i][1], c, (double)found[c], expected[c]);
                worst = fmax(worst, error);
                mean += error;
                count++;
            }
        }
        print_message("combination %2d: off by %.2g in the mean, %.2g at most\n", number, mean / count, worst);
        assert_true(mean / count < 0.002);
        lam_image_free(&picture);
        lam_image_free(&normals);
        lam_image_free(&tangents);
    }
    lam_environment_free(environment);
}

// In a uniform environment, a white metal returns all light, and half as many directions do not change that.
TEST(test_white_furnace) { check_white_furnace((lam_draw_params){.reference = 1024}); }

TEST(test_same_bytes) { check_same_bytes((lam_draw_params){.reference = 19}); }

// An environment without light, one with light in a single texel, and numbers out of range.
TEST(test_limits)
{
    lam_error error;
    AUTO_IMAGE image = {0};
    assert_true(lam_image_make(&image, 64, 32, LAM_RGBA32F, &error));
    memset(image.pixels, 0, 64 * 32 * 16);
    for (int lit = 0; lit < 2; lit++) {
        for (int c = 0; c < 4 * lit; c++)
            ((float *)image.pixels)[4 * (8 * 64 + 20) + c] = 1e6f;
        lam_environment *environment = lam_environment_from_image(&image, LAM_COLOR_SRGB, &error);
        assert_non_null(environment);
        AUTO_SCENE scene = make_spheres(environment, (lam_rgb){1, 1, 1});
        AUTO_IMAGE picture = draw_spheres(scene, (lam_draw_params){.reference = 64}, 0, LAM_ISA_AUTO);
        double sum = 0;
        for (int i = 0; i < picture.width * picture.height * 4; i++) {
            float x = ((const float *)picture.pixels)[i];
            assert_true(x >= 0 && x < 1e30f);
            sum += i % 4 < 3 ? (double)x : 0;
        }
        assert_true(lit ? sum > 1e4 : sum == 0);
        lam_environment_free(environment);
    }
    AUTO_SCENE scene = lam_scene_make(&error);
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_default();
    static const int wrong[] = {-1, 1, 15, (1 << 20) + 1};
    for (int i = 0; i < 4; i++) {
        lam_draw_params params = {.reference = wrong[i]};
        assert_false(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_non_null(strstr(error.text, "reference is"));
    }
}
