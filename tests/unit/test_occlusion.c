// test_occlusion.c: compares ambient occlusion with known results: planes have none, and a floor next to a wall has the
// integral over all directions; it also tests when a frame has any.

#include "test.h"

enum { SIZE = 256 };

// A rectangle in the scene, from a corner along two edges.
static void add_rectangle(lam_scene *scene, lam_vec3 at, lam_vec3 u, lam_vec3 v)
{
    float p[12];
    for (int i = 0; i < 4; i++) {
        double s = i == 1 || i == 2, t = i >= 2;
        p[3 * i] = (float)(at.x + s * u.x + t * v.x);
        p[3 * i + 1] = (float)(at.y + s * u.y + t * v.y);
        p[3 * i + 2] = (float)(at.z + s * u.z + t * v.z);
    }
    lam_mesh mesh = {.positions = p, .vertex_count = 4, .indices = (uint32_t[]){0, 1, 2, 0, 2, 3}, .triangle_count = 2};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, NULL);
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, NULL) >= 0);
}

// The share at each pixel; −1 for the background. The caller frees it.
static float *shares(const lam_scene *scene, const lam_camera *camera, lam_draw_params params)
{
    lam_error error;
    lam_device *device = lam_device_cpu(NULL, &error);
    lam_image image = {0};
    params.output = LAM_OUTPUT_AMBIENT_OCCLUSION;
    assert_true(lam_image_make(&image, SIZE, SIZE, LAM_RGBA32F, &error));
    if (!device || !lam_draw(device, scene, camera, &params, &image, NULL, &error))
        fail_msg("%s", error.text);
    float *out = malloc(sizeof *out * SIZE * SIZE);
    assert_non_null(out);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const float *pixel = (const float *)image.pixels + 4 * (ptrdiff_t)i;
        out[i] = pixel[3] > 0 ? pixel[0] : -1;
    }
    lam_image_free(&image);
    lam_device_free(device);
    return out;
}

// A plane at any angle, in perspective or not, has exactly all of the light, except for rounding.
TEST(test_planes)
{
    for (int turn = 0; turn < 8; turn++)
        for (int orthographic = 0; orthographic < 2; orthographic++) {
            AUTO_SCENE scene = lam_scene_make(NULL);
            add_rectangle(scene, (lam_vec3){-1, -1, 0}, (lam_vec3){2, 0, 0}, (lam_vec3){0, 2, 0});
            lam_camera camera = {
                .eye = {2.5 * sin(0.18 * turn), 0.3 * turn, 2.5 * cos(0.18 * turn)}, .up = {0, 1, 0}, .fovy_rad = 0.9};
            if (orthographic)
                camera.ortho_half_height = 1.2;
            float *a = shares(scene, &camera, (lam_draw_params){.samples = turn % 2 ? 8 : 1});
            int seen = 0;
            for (int i = 4 * SIZE + 4; i < SIZE * (SIZE - 4) - 4; i++) {
                // At the plane's rim, samples are not around the pixels' centres, and the filter spreads this.
                bool inside = true;
                for (int y = -4; y <= 4; y++)
                    for (int x = -4; x <= 4; x++)
                        inside &= a[i + y * SIZE + x] >= 0;
                seen += inside;
                if (inside && a[i] < 0.99f)
                    fail_msg("turn %d: pixel %d,%d has %g", turn, i % SIZE, i / SIZE, (double)a[i]);
            }
            assert_true(seen > SIZE * SIZE / 20);
            free(a);
        }
}

// A floor with a wall across, seen from above. Near the wall, the radius has no effect, and the wall is practically
// infinite to the sides; beyond the radius nothing occludes.
static void check_wall(lam_occlusion method)
{
    bool rays = method == LAM_OCCLUSION_RAYS;
    const double radius = 0.25;
    AUTO_SCENE scene = lam_scene_make(NULL);
    add_rectangle(scene, (lam_vec3){-4, 0, 0}, (lam_vec3){0, 0, 8}, (lam_vec3){8, 0, 0});
    add_rectangle(scene, (lam_vec3){-4, 0, 0}, (lam_vec3){8, 0, 0}, (lam_vec3){0, 4, 0});
    lam_camera camera = {.eye = {0, 3, 3}, .target = {0, 0, 0.5}, .up = {0, 1, 0}, .ortho_half_height = 1.5};
    lam_vec3 low, high;
    assert_true(lam_scene_bounds(scene, &low, &high));
    double half = 0.5 * sqrt(8.0 * 8 + 4 * 4 + 8 * 8);
    float *a = shares(
        scene, &camera,
        (lam_draw_params){
            .samples = 1, .occlusion = method, .occlusion_radius = (float)(radius / half), .occlusion_samples = 128});
    // The middle column, from the wall's foot towards the eye: each row is a step dz along the floor.
    double slope = sqrt(3 * 3 + 2.5 * 2.5), dz = 3.0 / SIZE * slope / 3;
    double foot = SIZE / 2 - 0.5 / dz; // the row of the foot: the view's middle is at z = 0.5
    double before = 0;
    int checked = 0;
    for (int row = (int)foot + 2; row < SIZE; row++) {
        double d = (row + 0.5 - foot) * dz, share = (double)a[row * SIZE + SIZE / 2];
        assert_true(share > before - 0.03); // increasingly bright, except for noise
        before = share > before ? share : before;
        // The mean over cosine-weighted directions, each occluded according to the distance to the wall relative to the
        // radius.
        double exact = 0, all = 0;
        for (int i = 0; i < 200; i++)
            for (int k = 0; k < 400; k++) {
                double r = sqrt((i + 0.5) / 200), way = d / fmax(-r * cos((k + 0.5) * M_PI / 200), 1e-9);
                exact += cos((k + 0.5) * M_PI / 200) < 0 ? 1 - fmin(fmax((radius - way) / (0.4 * radius), 0), 1) : 1;
                all++;
            }
        exact /= all;
        if (!(share > exact - 0.03 && share < exact + (rays ? 0.03 : 0.06))) // the samples miss some
            fail_msg("%g from the wall: %g, expected %g", d, share, exact);
        checked += share < 0.9;
    }
    assert_true(checked > 3);
    free(a);
}

TEST(test_wall)
{
    check_wall(LAM_OCCLUSION_SCREEN);
    check_wall(LAM_OCCLUSION_RAYS);
}

// --- rays

// Whether a triangle blocks a ray, and at which distance (Möller and Trumbore 1997), in double.
static double crossing(const double p[3][3], const double o[3], const double d[3])
{
    double a[3], b[3], s[3], h[3], q[3], det = 0, u = 0, v = 0, t = 0;
    for (int i = 0; i < 3; i++) {
        a[i] = p[1][i] - p[0][i];
        b[i] = p[2][i] - p[0][i];
        s[i] = o[i] - p[0][i];
    }
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++) {
        h[i] = d[j] * b[k] - d[k] * b[j];
        q[i] = s[j] * a[k] - s[k] * a[j];
    }
    for (int i = 0; i < 3; i++) {
        det += a[i] * h[i];
        u += s[i] * h[i];
        v += d[i] * q[i];
        t += b[i] * q[i];
    }
    return det != 0 && u / det >= 0 && v / det >= 0 && (u + v) / det <= 1 && t / det > 0 ? t / det : HUGE_VAL;
}

// The integral at the point o with the normal n: `rings` × 4 `rings` cosine-weighted directions against all triangles
// except `own`, each occluded according to the distance to the nearest of them relative to the radius.
static double integral(const double (*triangles)[3][3], int count, int own, const double o[3], const double n[3],
                       double radius, int rings)
{
    double u[3] = {n[1], n[2], n[0]}, v[3], along = u[0] * n[0] + u[1] * n[1] + u[2] * n[2], length = 0, sum = 0;
    for (int i = 0; i < 3; i++) {
        u[i] -= along * n[i];
        length += u[i] * u[i];
    }
    for (int i = 0; i < 3; i++)
        u[i] /= sqrt(length);
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++)
        v[i] = n[j] * u[k] - n[k] * u[j];
    for (int ring = 0; ring < rings; ring++)
        for (int step = 0; step < 4 * rings; step++) {
            double square = (ring + 0.5) / rings, r = sqrt(square), angle = 2 * M_PI * (step + 0.5) / (4 * rings);
            double d[3], nearest = HUGE_VAL;
            for (int i = 0; i < 3; i++)
                d[i] = r * cos(angle) * u[i] + r * sin(angle) * v[i] + sqrt(1 - square) * n[i];
            for (int i = 0; i < count; i++)
                if (i != own)
                    nearest = fmin(nearest, crossing(triangles[i], o, d));
            sum += 1 - fmin(fmax((radius - nearest) / (0.4 * radius), 0), 1);
        }
    return sum / (4.0 * rings * rings);
}

// The surface point of a pixel, and its triangle in its mesh. False if no surface is visible.
static bool explained(lam_device *device, const lam_scene *scene, const lam_camera *camera, int x, int y, double o[3],
                      uint32_t *triangle)
{
    lam_error error;
    const lam_draw_params params = {.samples = 1, .occlusion = LAM_OCCLUSION_OFF};
    lam_explanation *e = lam_explain(device, scene, camera, &params, SIZE, SIZE, LAM_RGBA32F, x, y, NULL, &error);
    SUCCEEDS(e);
    bool shown = e->fragment_count > 0;
    if (shown) {
        const lam_explained_fragment *f = &e->fragments[e->fragment_count - 1];
        const lam_vec3 p = f->points[0].world_position;
        o[0] = p.x;
        o[1] = p.y;
        o[2] = p.z;
        *triangle = f->triangle;
    }
    lam_explanation_free(e);
    return shown;
}

static uint32_t random_bits(uint32_t *state) { return *state = *state * 1664525 + 1013904223; }

// Random triangles: the device's rays compared with the integral, at pixels over the picture.
TEST(test_rays_integral)
{
    enum { COUNT = 60, POINTS = 48 };
    uint32_t seed = 7;
    float p[COUNT * 9];
    static double exact[COUNT][3][3];
    for (int i = 0; i < COUNT; i++) {
        double middle[3];
        for (int k = 0; k < 3; k++)
            middle[k] = (random_bits(&seed) >> 8) / 16777216.0 * 2 - 1;
        for (int k = 0; k < 9; k++) {
            p[9 * i + k] = (float)(middle[k % 3] + (random_bits(&seed) >> 8) / 16777216.0 * 1.2 - 0.6);
            exact[i][k / 3][k % 3] = (double)p[9 * i + k];
        }
    }
    lam_mesh mesh = {.positions = p, .vertex_count = 3 * COUNT, .triangle_count = COUNT};
    lam_error error;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        AUTO_SCENE scene = lam_scene_make(NULL);
        lam_object object = lam_object_default();
        object.mesh = lam_scene_add_mesh(scene, &mesh, NULL);
        assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, NULL) >= 0);
        lam_vec3 low, high;
        assert_true(lam_scene_bounds(scene, &low, &high));
        double half = 0.5 * sqrt(pow(high.x - low.x, 2) + pow(high.y - low.y, 2) + pow(high.z - low.z, 2));
        lam_camera camera = {.eye = {1, 2, 4}, .up = {0, 1, 0}, .fovy_rad = 0.6};
        if (orthographic)
            camera.ortho_half_height = 1.5;
        lam_draw_params params = {.samples = 1,
                                  .occlusion = LAM_OCCLUSION_RAYS,
                                  .occlusion_radius = (float)(0.7 / half),
                                  .occlusion_samples = 512};
        float *shown = shares(scene, &camera, params);
        AUTO_DEVICE device = lam_device_cpu(NULL, &error);
        double bias = 0, darkest = 1;
        int points = 0;
        for (int i = 0; i < POINTS; i++) {
            int x = 20 + i % 8 * 30, y = 30 + i / 8 * 35;
            double share = (double)shown[y * SIZE + x], o[3], a[3], b[3], n[3], toward = 0, length = 0;
            uint32_t own;
            if (!explained(device, scene, &camera, x, y, o, &own))
                continue;
            for (int k = 0; k < 3; k++) {
                a[k] = exact[own][1][k] - exact[own][0][k];
                b[k] = exact[own][2][k] - exact[own][0][k];
            }
            for (int k = 0, l = 1, m = 2; k < 3; l = m, m = k++) {
                n[k] = a[l] * b[m] - a[m] * b[l];
                toward += n[k] * (orthographic ? (&camera.eye.x)[k] : (&camera.eye.x)[k] - o[k]);
                length += n[k] * n[k];
            }
            for (int k = 0; k < 3; k++)
                n[k] /= toward < 0 ? -sqrt(length) : sqrt(length);
            double want = integral(exact, COUNT, (int)own, o, n, 0.7, 48);
            if (fabs(share - want) > 0.025)
                fail_msg("point %d: %g, expected %g", i, share, want);
            bias += share - want;
            darkest = fmin(darkest, want);
            points++;
        }
        assert_true(points > POINTS / 3 && darkest < 0.6);
        if (fabs(bias / points) > 0.004)
            fail_msg("%g too light", bias / points);
        free(shown);
    }
}

static float mean_share(const float *a, double *deviation)
{
    double sum = 0, squares = 0;
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i++)
        if (a[i] >= 0) {
            sum += (double)a[i];
            squares += (double)a[i] * (double)a[i];
            count++;
        }
    assert_true(count > SIZE * SIZE / 20);
    *deviation = sqrt(fmax(squares / count - sum / count * (sum / count), 0));
    return (float)(sum / count);
}

// Known shares: a plane has all of the light, the inside of a closed box none, and a hemispherical bowl ½ everywhere,
// because all parts of a sphere are equally bright to one another.
TEST(test_rays_known)
{
    double deviation;
    lam_scene *scene = lam_scene_make(NULL);
    add_rectangle(scene, (lam_vec3){-1, -1, 0}, (lam_vec3){2, 0, 0}, (lam_vec3){0, 2, 0});
    const lam_draw_params far = {
        .occlusion = LAM_OCCLUSION_RAYS, .occlusion_radius = 10, .occlusion_samples = 100, .samples = 1};
    lam_camera camera = {.eye = {1, 0.7, 3}, .up = {0, 1, 0}, .fovy_rad = 0.9};
    float *a = shares(scene, &camera, far);
    assert_true(mean_share(a, &deviation) == 1 && deviation == 0);
    free(a);
    lam_scene_free(scene);

    lam_error error;
    scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "cube", NULL, &error);
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    camera = (lam_camera){.eye = {0.5, 0.1, 0.3}, .up = {0, 1, 0}, .fovy_rad = 1.4};
    lam_draw_params few = far;
    few.occlusion_samples = 16;
    a = shares(scene, &camera, few);
    assert_true(mean_share(a, &deviation) == 0);
    free(a);
    lam_scene_free(scene);

    enum { RINGS = 32, SPOKES = 96 };
    static float bowl[(RINGS + 1) * SPOKES * 3];
    static uint32_t indices[RINGS * SPOKES * 6];
    for (int i = 0; i <= RINGS; i++)
        for (int k = 0; k < SPOKES; k++) {
            double theta = 0.5 * M_PI * i / RINGS, phi = 2 * M_PI * k / SPOKES;
            float *p = bowl + 3 * (i * SPOKES + k);
            p[0] = (float)(sin(theta) * cos(phi));
            p[1] = (float)(sin(theta) * sin(phi));
            p[2] = (float)-cos(theta);
        }
    for (int i = 0; i < RINGS * SPOKES; i++) {
        uint32_t ring = (uint32_t)(i / SPOKES * SPOKES), k = (uint32_t)(i % SPOKES), next = (k + 1) % SPOKES;
        const uint32_t corners[6] = {ring + k, ring + next,          ring + SPOKES + next,
                                     ring + k, ring + SPOKES + next, ring + SPOKES + k};
        for (int c = 0; c < 6; c++)
            indices[6 * i + c] = corners[c];
    }
    lam_mesh mesh = {.positions = bowl,
                     .vertex_count = (RINGS + 1) * SPOKES,
                     .indices = indices,
                     .triangle_count = 2 * RINGS * SPOKES};
    scene = lam_scene_make(NULL);
    object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    camera = (lam_camera){.eye = {0, 0, 3}, .up = {0, 1, 0}, .ortho_half_height = 0.8};
    a = shares(scene, &camera, far);
    double mean = (double)mean_share(a, &deviation);
    if (fabs(mean - 0.5) > 0.004 || deviation > 0.02)
        fail_msg("in the bowl: %g, and %g about it", mean, deviation);
    free(a);
    lam_scene_free(scene);
}

// A plate over a floor: a translucent plate blocks the share of its opacity, and a masked one everything or nothing.
TEST(test_rays_opacity)
{
    lam_error error;
    double taken[4];
    const struct {
        lam_alpha_mode mode;
        float alpha;
    } plates[4] = {{LAM_ALPHA_OPAQUE, 1}, {LAM_ALPHA_BLEND, 0.25f}, {LAM_ALPHA_MASK, 0.6f}, {LAM_ALPHA_MASK, 0.4f}};
    for (int i = 0; i < 4; i++) {
        AUTO_SCENE scene = lam_scene_make(NULL);
        add_rectangle(scene, (lam_vec3){-2, 0, 2}, (lam_vec3){4, 0, 0}, (lam_vec3){0, 0, -4});
        add_rectangle(scene, (lam_vec3){-0.5, 0.4, 0.5}, (lam_vec3){1, 0, 0}, (lam_vec3){0, 0, -1});
        lam_material m = lam_material_default();
        m.diffuse.a = plates[i].alpha;
        m.alpha_mode = plates[i].mode;
        m.alpha_cutoff = 0.5f;
        lam_object object = *lam_scene_object(scene, 1);
        object.material = lam_scene_add_material(scene, &m, &error);
        assert_true(lam_scene_set_object(scene, 1, &object, &error));
        lam_camera camera = {.eye = {0, 1.3, 5}, .target = {0, 0, 0.6}, .up = {0, 1, 0}, .ortho_half_height = 1};
        lam_draw_params params = {
            .samples = 1, .occlusion = LAM_OCCLUSION_RAYS, .occlusion_radius = 1, .occlusion_samples = 32};
        float *a = shares(scene, &camera, params);
        taken[i] = 1 - (double)a[SIZE / 2 * SIZE + SIZE / 2]; // on the floor, under the plate
        free(a);
    }
    assert_true(taken[0] > 0.1 && taken[2] == taken[0] && taken[3] == 0);
    assert_true(fabs(taken[1] - 0.25 * taken[0]) < 1e-6);
}

// A plate above a floor, seen at an angle from the front: the visible floor under it is dark. Compares the screen's
// shares with the ray-traced shares, over the whole picture.
TEST(test_screen_beside_rays)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    add_rectangle(scene, (lam_vec3){-2, 0, 2}, (lam_vec3){4, 0, 0}, (lam_vec3){0, 0, -4});
    add_rectangle(scene, (lam_vec3){-1, 0.2, 1}, (lam_vec3){2, 0, 0}, (lam_vec3){0, 0, -2});
    add_rectangle(scene, (lam_vec3){-1, 0.2, 1}, (lam_vec3){2, 0, 0}, (lam_vec3){0, 0.1, 0});
    add_rectangle(scene, (lam_vec3){-1, 0.3, 1}, (lam_vec3){2, 0, 0}, (lam_vec3){0, 0, -2});
    lam_camera camera = {.eye = {0, 1.6, 4}, .target = {0, 0, 0.6}, .up = {0, 1, 0}, .fovy_rad = 0.6};
    lam_draw_params params = {.samples = 1, .occlusion_radius = 0.25f, .occlusion_samples = 64};
    float *shown[2];
    for (int i = 0; i < 2; i++) {
        params.occlusion = i ? LAM_OCCLUSION_RAYS : LAM_OCCLUSION_SCREEN;
        shown[i] = shares(scene, &camera, params);
    }
    double apart = 0, bias = 0, dark = 0;
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i++)
        if (shown[1][i] >= 0) {
            apart += fabs((double)shown[0][i] - (double)shown[1][i]);
            bias += (double)shown[0][i] - (double)shown[1][i];
            dark += 1 - (double)shown[1][i];
            count++;
        }
    if (dark / count < 0.1 || apart / count > 0.025 || fabs(bias / count) > 0.02)
        fail_msg("%g apart, %g too light, of %g", apart / count, bias / count, dark / count);
    free(shown[0]);
    free(shown[1]);
}

// Cavity shading leaves planes and outer edges unchanged, and darkens the inner edges of a step.
TEST(test_cavity)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    // Two levels and the wall between them, seen from the front and above.
    add_rectangle(scene, (lam_vec3){-1, 0, 0}, (lam_vec3){2, 0, 0}, (lam_vec3){0, 0, 1});
    add_rectangle(scene, (lam_vec3){-1, 0, 0}, (lam_vec3){0, 0.5, 0}, (lam_vec3){2, 0, 0});
    add_rectangle(scene, (lam_vec3){-1, 0.5, 0}, (lam_vec3){2, 0, 0}, (lam_vec3){0, 0, -1});
    lam_camera camera = {.eye = {0, 3, 3}, .target = {0, 0.25, 0}, .up = {0, 1, 0}, .ortho_half_height = 1.5};
    lam_draw_params params = {.samples = 1, .occlusion = LAM_OCCLUSION_OFF, .cavity = LAM_CAVITY_ON};
    float *shown = shares(scene, &camera, params);
    int darker = 0, even = 0;
    for (int y = 0; y < SIZE; y++) {
        float share = shown[y * SIZE + SIZE / 2];
        assert_true(share <= 1 + 1e-5f);
        darker += share >= 0 && share < 0.9f;
        even += share >= 1 - 1e-5f && share <= 1 + 1e-5f;
    }
    if (darker < 2 || even < SIZE / 2)
        fail_msg("%d darker, %d even", darker, even);
    free(shown);
}

static bool same_picture(const lam_scene *scene, lam_draw_params a, lam_draw_params b)
{
    lam_error error;
    lam_device *device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_fit(scene, 64, 64, NULL);
    lam_image images[2] = {{0}};
    for (int i = 0; i < 2; i++) {
        assert_true(lam_image_make(&images[i], 64, 64, LAM_RGBA32F, &error));
        SUCCEEDS(lam_draw(device, scene, &camera, i ? &b : &a, &images[i], NULL, &error));
    }
    bool same = true;
    for (int i = 0; i < 64 * 64 * 4; i++)
        same &= ((float *)images[0].pixels)[i] == ((float *)images[1].pixels)[i];
    lam_image_free(&images[0]);
    lam_image_free(&images[1]);
    lam_device_free(device);
    return same;
}

// The studio has occlusion, and lights given by hand have none unless requested; occlusion needs Phong shading.
TEST(test_when)
{
    lam_error error;
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "gyroid", NULL, &error);
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    const lam_draw_params plain = {.occlusion_radius = 0.3f, .cavity = LAM_CAVITY_OFF},
                          off = {.occlusion = LAM_OCCLUSION_OFF}, automatic = {.occlusion_radius = 0.3f},
                          both = {.occlusion = LAM_OCCLUSION_SCREEN, .occlusion_radius = 0.3f, .cavity = LAM_CAVITY_ON},
                          screen = {.occlusion = LAM_OCCLUSION_SCREEN, .occlusion_radius = 0.3f};
    assert_false(same_picture(scene, plain, off));
    assert_true(same_picture(scene, plain, screen));
    assert_false(same_picture(scene, plain, automatic));
    assert_true(same_picture(scene, automatic, both));
    lam_draw_params flat = plain, flat_off = off;
    flat.shading = flat_off.shading = LAM_SHADING_FLAT;
    assert_true(same_picture(scene, flat, flat_off));
    lam_draw_params unlit = plain, unlit_off = off;
    unlit.reflection = unlit_off.reflection = LAM_REFLECTION_NONE;
    assert_true(same_picture(scene, unlit, unlit_off));

    lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    assert_int_equal(lam_scene_add_light(scene, &light, &error), 0);
    assert_true(same_picture(scene, plain, off));
    assert_true(same_picture(scene, screen, off)); // there is no light that it could dim
    light.occluded = 1;
    assert_int_equal(lam_scene_add_light(scene, &light, &error), 1);
    assert_false(same_picture(scene, plain, off));

    flat.occlusion = LAM_OCCLUSION_SCREEN;
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_fit(scene, 64, 64, NULL);
    AUTO_IMAGE image = {0};
    assert_true(lam_image_make(&image, 64, 64, LAM_RGBA8, &error));
    assert_false(lam_draw(device, scene, &camera, &flat, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    flat.occlusion = LAM_OCCLUSION_RAYS;
    assert_false(lam_draw(device, scene, &camera, &flat, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_draw_params many = {.occlusion_samples = 1025};
    assert_false(lam_draw(device, scene, &camera, &many, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_draw_params wrong = {.occlusion_radius = 11};
    assert_false(lam_draw(device, scene, &camera, &wrong, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
}
