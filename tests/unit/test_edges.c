// test_edges.c: wireframes and feature edges: selection, width and hidden lines, the same on every device.
#include "test.h"
#include "device_fixture.h"
#include "loading.h"

#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif

enum { SIDE = 256 };

static lam_camera camera_at(double x, double y, double z)
{
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){x, y, z};
    camera.target = (lam_vec3){0, 0, 0};
    camera.fovy_rad = 0.6;
    return camera;
}

// Only lines over nothing, so alpha is their coverage.
static lam_image draw(const lam_scene *scene, const lam_camera *camera, lam_draw_params params)
{
    params.no_surfaces = true;
    return draw_square(scene, camera, &params, SIDE);
}

static uint64_t drawn(void)
{
    lam_frame_report report;
    lam_device_report(device, &report);
    return report.edges_drawn;
}

static double alpha(const lam_image *image, int x, int y)
{
    return x < 0 || y < 0 || x >= SIDE || y >= SIDE ? 0
                                                    : (double)((const float *)image->pixels)[4 * (y * SIDE + x) + 3];
}

static double area(const lam_image *image)
{
    double sum = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            sum += alpha(image, x, y);
    return sum;
}

// The pixel of a point.
static void project(const lam_camera *camera, const float p[3], double out[2])
{
    double f[3] = {camera->target.x - camera->eye.x, camera->target.y - camera->eye.y,
                   camera->target.z - camera->eye.z};
    double d[3] = {(double)p[0] - camera->eye.x, (double)p[1] - camera->eye.y, (double)p[2] - camera->eye.z};
    double u[3] = {camera->up.x, camera->up.y, camera->up.z};
    double r[3] = {f[1] * u[2] - f[2] * u[1], f[2] * u[0] - f[0] * u[2], f[0] * u[1] - f[1] * u[0]};
    double up[3] = {r[1] * f[2] - r[2] * f[1], r[2] * f[0] - r[0] * f[2], r[0] * f[1] - r[1] * f[0]};
    double x = 0, y = 0, z = 0, fl = 0, rl = 0, ul = 0;
    for (int i = 0; i < 3; i++) {
        fl += f[i] * f[i];
        rl += r[i] * r[i];
        ul += up[i] * up[i];
    }
    for (int i = 0; i < 3; i++) {
        x += d[i] * r[i] / sqrt(rl);
        y += d[i] * up[i] / sqrt(ul);
        z += d[i] * f[i] / sqrt(fl);
    }
    bool flat = camera->ortho_half_height > 0;
    double scale = SIDE / 2.0 / (flat ? camera->ortho_half_height : z * tan(camera->fovy_rad / 2));
    out[0] = SIDE / 2.0 + x * scale;
    out[1] = SIDE / 2.0 - y * scale;
}

// The coverage across a line from a to b at a fraction of it: the sum over a row or a column, whichever crosses it
// more, times the cosine of the angle between them. This is the line's width.
static double width_near(const lam_image *image, const double a[2], const double b[2], double share, int reach)
{
    double x = a[0] + (b[0] - a[0]) * share, y = a[1] + (b[1] - a[1]) * share, sum = 0;
    double dx = fabs(b[0] - a[0]), dy = fabs(b[1] - a[1]), length = sqrt(dx * dx + dy * dy);
    for (int i = -reach; i <= reach; i++)
        sum += dx > dy ? alpha(image, (int)x, (int)y + i) : alpha(image, (int)x + i, (int)y);
    return sum * (dx > dy ? dx : dy) / length;
}

static double width_at(const lam_image *image, const double a[2], const double b[2], double share)
{
    return width_near(image, a, b, share, 5);
}

// --- a cube of 12 edges, as triangles with 18

static const float cube_positions[24] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                         -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
static const uint32_t cube_indices[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                          3, 6, 2, 3, 7, 6, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};
static const uint8_t cube_inner[12] = {1, 4, 4, 1, 4, 1, 1, 4, 4, 1, 4, 1};
static const int cube_edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                      {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

static lam_mesh cube(void)
{
    return (lam_mesh){.positions = cube_positions, .vertex_count = 8, .indices = cube_indices, .triangle_count = 12};
}

TEST(cubes)
{
    lam_mesh mesh = cube();
    lam_scene *scene = scene_of(&mesh);
    for (int flat = 0; flat < 2; flat++) {
        lam_camera camera = camera_at(3.1, 2.3, 4.2); // corner 0 is the hidden one
        camera.ortho_half_height = flat ? 2 : 0;
        for (int hidden = 0; hidden < LAM_HIDDEN_LINES_COUNT; hidden++) {
            lam_draw_params params = {
                .edges = LAM_EDGES_CREASE, .edge_width = 1.25f, .hidden_lines = (lam_hidden_lines)hidden};
            AUTO_IMAGE image = draw(scene, &camera, params);
            assert_int_equal(drawn(), 12);
            int visible = 0;
            for (int e = 0; e < 12; e++) {
                double a[2], b[2], whole = 0;
                project(&camera, cube_positions + 3 * cube_edges[e][0], a);
                project(&camera, cube_positions + 3 * cube_edges[e][1], b);
                bool behind = cube_edges[e][0] == 0 || cube_edges[e][1] == 0;
                int count = 0, on = 0, nothing = 0;
                double length = sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
                for (double t = 24 / length; t < 1 - 24 / length; t += 0.5 / length, count++) {
                    double width = width_near(&image, a, b, t, 2);
                    whole += width;
                    on += width > 0.6;
                    if (!behind || hidden == LAM_HIDDEN_LINES_SHOW)
                        assert_true(width > 1.24 && (width < 1.26 || hidden)); // wider at a crossing with a hidden edge
                    else
                        nothing += hidden == LAM_HIDDEN_LINES_REMOVE ? width == 0 : width < 0.3;
                }
                visible += on == count;
                if (behind && hidden == LAM_HIDDEN_LINES_REMOVE) // except at a crossing with a visible edge
                    assert_true(nothing > 0.7 * count);
                if (behind && hidden == LAM_HIDDEN_LINES_DASH && count > 100) // 5 of 8, and a crossing
                    assert_true(whole > 0.5 * 1.25 * count && whole < 0.85 * 1.25 * count && nothing > 0.1 * count);
                else if (on == count && hidden == LAM_HIDDEN_LINES_REMOVE)
                    assert_true(fabs(whole / (1.25 * count) - 1) < 0.02);
            }
            assert_int_equal(visible, hidden == LAM_HIDDEN_LINES_SHOW ? 12 : 9);
        }
    }
    // Diagonals of the triangles: two of three silhouettes of a wireframe's 18 edges occur by chance; the flags leave
    // 12.
    lam_camera camera = camera_at(3.1, 2.3, 4.2);
    lam_image image = draw(scene, &camera, (lam_draw_params){.wireframe = true});
    assert_int_equal(drawn(), 18);
    lam_image_free(&image);
    image = draw(scene, &camera, (lam_draw_params){.edges = LAM_EDGES_SILHOUETTE});
    assert_int_equal(drawn(), 6);
    lam_image_free(&image);
    image = draw(scene, &camera, (lam_draw_params){.edges = LAM_EDGES_BOUNDARY});
    assert_true(drawn() == 0 && area(&image) == 0);
    lam_image_free(&image);
    image = draw(scene, &camera, (lam_draw_params){.edges = LAM_EDGES_CREASE, .edge_angle_rad = 1.6});
    assert_int_equal(drawn(), 0); // its faces meet at π/2
    lam_image_free(&image);
    lam_scene_free(scene);
    mesh.inner_edges = cube_inner;
    scene = scene_of(&mesh);
    image = draw(scene, &camera, (lam_draw_params){.wireframe = true});
    assert_int_equal(drawn(), 12);
    lam_image_free(&image);
    lam_scene_free(scene);
}

// --- the area of a line is its width times its length, at any position

TEST(widths)
{
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    for (int turn = 0; turn < 12; turn++) {
        double angle = turn * 0.13, shift = turn * 0.0007, s = sin(angle), c = cos(angle);
        float p[12];
        for (int k = 0; k < 4; k++) {
            double x = k == 1 || k == 2 ? 1 : -1, y = k >= 2 ? 1 : -1;
            p[3 * k] = (float)(x * c - y * s + shift);
            p[3 * k + 1] = (float)(x * s + y * c + shift);
            p[3 * k + 2] = 0;
        }
        lam_mesh mesh = {.positions = p, .vertex_count = 4, .indices = indices, .triangle_count = 2};
        AUTO_SCENE scene = scene_of(&mesh);
        lam_camera camera = camera_at(0, 0, 6);
        static const double all[] = {0.3, 1, 1.5, 2.75, 6};
        for (int w = 0; w < 5; w++) {
            for (int samples = 1; samples <= 16; samples += 15) {
                lam_draw_params params = {.edges = LAM_EDGES_BOUNDARY, .edge_width = (float)all[w], .samples = samples};
                AUTO_IMAGE image = draw(scene, &camera, params);
                assert_int_equal(drawn(), 4);
                double corner[4][2], length = 0, least = 1e9, most = 0;
                for (int k = 0; k < 4; k++)
                    project(&camera, p + 3 * k, corner[k]);
                for (int k = 0; k < 4; k++) {
                    const double *a = corner[k], *b = corner[(k + 1) % 4];
                    length += sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
                    for (double t = 0.1; t < 0.9; t += 0.003) {
                        double width = width_at(&image, a, b, t);
                        least = width < least ? width : least;
                        most = width > most ? width : most;
                    }
                }
                // Round corners: four quarters of a disc instead of the overlap of four squares.
                assert_true(fabs(area(&image) - all[w] * length) < 0.01 * all[w] * length + 0.5 * all[w] * all[w]);
                assert_true(least > 0.99 * all[w] && most < 1.01 * all[w]);
            }
        }
    }
}

// --- the outline of a sphere is one closed curve

TEST(silhouettes)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 97, .stacks = 53}, NULL);
    assert_true(lam_scene_add_object(scene, &object, NULL) >= 0);
    lam_camera camera = camera_at(2.3, 3.7, 1.9);
    double d = sqrt(2.3 * 2.3 + 3.7 * 3.7 + 1.9 * 1.9), radius = SIDE / 2.0 / tan(0.3) / sqrt(d * d - 1);
    lam_image image = draw(scene, &camera, (lam_draw_params){.edges = LAM_EDGES_ALL, .edge_width = 1.5f});
    double inside = 0;
    for (int i = 0; i < 2000; i++) {
        double angle = i * M_PI / 1000, c = cos(angle), s = sin(angle), most = 0;
        for (double r = radius - 4; r < radius + 3; r += 0.25) {
            double a = alpha(&image, (int)(SIDE / 2.0 + r * c), (int)(SIDE / 2.0 + r * s));
            most = a > most ? a : most;
        }
        assert_true(most > 0.5);
        for (double r = 0; r < radius - 4; r += 0.7)
            inside += alpha(&image, (int)(SIDE / 2.0 + r * c), (int)(SIDE / 2.0 + r * s));
    }
    assert_true(inside == 0);
    assert_true(fabs(area(&image) / (1.5 * 2 * M_PI * radius) - 1) < 0.04);
    lam_image_free(&image);
    // Without hidden lines, the curve is the same, because a sphere has no other edges of these kinds.
    image = draw(scene, &camera,
                 (lam_draw_params){.edges = LAM_EDGES_ALL, .edge_width = 1.5f, .hidden_lines = LAM_HIDDEN_LINES_SHOW});
    assert_true(fabs(area(&image) / (1.5 * 2 * M_PI * radius) - 1) < 0.04);
    lam_image_free(&image);
}

// --- lines have no gaps along a surface, or where triangles meet in the middle of an edge

static double next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / (1 << 24);
}

TEST(surfaces)
{
    // A plate: a square over two rectangles, whose common corner is in the middle of the square's edge; and a step on
    // that edge, which makes it a crease.
    static const float plate[] = {-1,     0, 0, 1,  0,  0, 1,      1,  0, -1, 1,  0,
                                  0.234f, 0, 0, -1, -1, 0, 0.234f, -1, 0, 1,  -1, 0};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 5, 6, 4, 5, 4, 0, 6, 7, 1, 6, 1, 4};
    uint32_t random = 1;
    for (int round = 0; round < 60; round++) {
        double angles[3], far_away = round % 3 == 0 ? 300 : 0;
        for (int i = 0; i < 3; i++)
            angles[i] = (next_random(&random) - 0.5) * 2.2;
        float p[24];
        for (int v = 0; v < 8; v++) {
            double q[3] = {(double)plate[3 * v], (double)plate[3 * v + 1], (double)plate[3 * v + 2]};
            for (int i = 0; i < 3; i++) {
                int j = (i + 1) % 3;
                double c = cos(angles[i]), s = sin(angles[i]), a = q[i] * c - q[j] * s, b = q[i] * s + q[j] * c;
                q[i] = a;
                q[j] = b;
            }
            for (int i = 0; i < 3; i++)
                p[3 * v + i] = (float)(q[i] + (i == 0 ? far_away : 0));
        }
        lam_mesh mesh = {.positions = p, .vertex_count = 8, .indices = indices, .triangle_count = 6};
        AUTO_SCENE scene = scene_of(&mesh);
        lam_camera camera = camera_at(far_away, 0, 5);
        camera.target.x = far_away;
        AUTO_IMAGE image = draw(scene, &camera, (lam_draw_params){.wireframe = true, .wireframe_width = 1});
        for (int e = 0; e < 6; e++) { // each edge of the outline, and both along the seam
            static const int ends[6][2] = {{0, 1}, {2, 3}, {3, 0}, {1, 2}, {5, 6}, {7, 1}};
            double a[2], b[2];
            project(&camera, p + 3 * ends[e][0], a);
            project(&camera, p + 3 * ends[e][1], b);
            double length = sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
            if (length < 40)
                continue;
            for (double t = 0.02; t < 0.98;
                 t += 0.5 / length) // thinner if the plate is seen at an angle, but without gaps
                assert_true(width_at(&image, a, b, t) > 0.15);
        }
    }
}

// --- hiding surfaces

static double hidden_share(lam_object front, lam_material material, double *rays)
{
    static const float line[] = {-1, 0, -1, 1, 0, -1, 0, 1, -1};
    static const float wall[] = {-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2, 0};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    lam_mesh one = {.positions = line, .vertex_count = 3, .triangle_count = 1};
    lam_mesh two = {.positions = wall, .vertex_count = 4, .indices = indices, .triangle_count = 2};
    lam_scene *scene = scene_of(&one);
    front.mesh = lam_scene_add_mesh(scene, &two, NULL);
    front.material = lam_scene_add_material(scene, &material, NULL);
    assert_true(lam_scene_add_object(scene, &front, NULL) >= 0);
    lam_camera camera = camera_at(0, 0, 4);
    camera.fovy_rad = 0.5; // the wall's own edges are outside
    lam_image image =
        draw(scene, &camera, (lam_draw_params){.wireframe = true, .hidden_lines = LAM_HIDDEN_LINES_REMOVE});
    float ends[2][3] = {{-1, 0, -1}, {0, 1, -1}};
    double a[2], b[2];
    project(&camera, ends[0], a);
    project(&camera, ends[1], b);
    double width = width_at(&image, a, b, 0.7);
    lam_frame_report report;
    lam_device_report(device, &report);
    *rays = (double)report.edge_rays;
    lam_image_free(&image);
    lam_scene_free(scene);
    return 1 - width;
}

TEST(hiding)
{
    double rays;
    lam_material material = lam_material_default();
    lam_object object = lam_object_default();
    assert_true(hidden_share(object, material, &rays) == 1 && rays > 100);
    object.cull = LAM_CULL_BACK;
    assert_true(hidden_share(object, material, &rays) == 1);
    object.cull = LAM_CULL_FRONT; // it is completely invisible
    assert_true(fabs(hidden_share(object, material, &rays)) < 0.01);
    object.cull = LAM_CULL_NONE;
    material.diffuse.a = 0.6f;
    assert_true(hidden_share(object, material, &rays) == 1);
    material.diffuse.a = 0.4f;
    assert_true(fabs(hidden_share(object, material, &rays)) < 0.01);
    material.alpha_mode = LAM_ALPHA_MASK;
    material.alpha_cutoff = 0.3f;
    assert_true(hidden_share(object, material, &rays) == 1);
    material.alpha_cutoff = 0.5f;
    assert_true(fabs(hidden_share(object, material, &rays)) < 0.01);
    object.transform.m[2][3] = 9; // behind the eye
    material = lam_material_default();
    assert_true(fabs(hidden_share(object, material, &rays)) < 0.01);
}

// An edge that leads past the eye ends at the near plane, and surfaces in front of that plane hide nothing.
TEST(near_plane)
{
    static const float p[] = {0, -0.5f, -8, 0, -0.5f, 8, -3, -0.5f, -8};
    lam_mesh mesh = {.positions = p, .vertex_count = 3, .triangle_count = 1};
    AUTO_SCENE scene = scene_of(&mesh);
    lam_camera camera = camera_at(0, 0, 4);
    camera.near_plane = 1;
    camera.far_plane = 100;
    AUTO_IMAGE image = draw(scene, &camera, (lam_draw_params){.edges = LAM_EDGES_BOUNDARY, .edge_width = 1});
    double f = SIDE / 2.0 / tan(0.3);
    int rows = 0;
    for (int y = 0; y < SIDE; y++) {
        double sum = alpha(&image, SIDE / 2 - 1, y) + alpha(&image, SIDE / 2, y),
               depth = f * 0.5 / (y + 0.5 - SIDE / 2.0);
        if (depth > 1.02 && depth < 11)
            assert_true(fabs(sum - 1) < 0.01);
        else if (depth < 0.98)
            assert_true(sum == 0);
        rows += sum > 0.9;
    }
    assert_true(rows > 80);
}

// --- every instruction set, any number of threads, every format

TEST(same_bytes)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "teapot", &(lam_shape_params){.slices = 40}, NULL);
    assert_true(lam_scene_add_object(scene, &object, NULL) >= 0);
    lam_camera camera = camera_at(1.5, 1.8, 3.1);
    lam_draw_params params = {.wireframe = true,
                              .edges = LAM_EDGES_ALL,
                              .hidden_lines = LAM_HIDDEN_LINES_DASH,
                              .edge_color = {0.8f, 0, 0, 0.7f},
                              .background = {1, 1, 1, 1}};
    lam_image first = {0}, next = {0};
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++)
        for (int threads = 1; threads < 4 && lam_isa_usable((lam_isa)isa); threads += 2) {
            AUTO_DEVICE own = lam_device_cpu(&(lam_cpu_params){.threads = threads, .isa = (lam_isa)isa}, NULL);
            lam_image *to = first.pixels ? &next : &first;
            assert_true(to->pixels || lam_image_make(to, SIDE, SIDE, LAM_RGBA8, NULL));
            for (int again = 0; again < 2; again++) { // drawn again, and from stored data
                assert_true(lam_draw(own, scene, &camera, &params, to, NULL, NULL));
                if (to == &next)
                    assert_memory_equal(first.pixels, next.pixels, SIDE * SIDE * 4);
            }
        }
    lam_image_free(&first);
    lam_image_free(&next);
}

TEST(colors)
{
    lam_mesh mesh = cube();
    AUTO_SCENE scene = scene_of(&mesh);
    lam_camera camera = camera_at(0, 0, 6);
    static const lam_pixel_format formats[] = {LAM_RGBA8, LAM_RGB8, LAM_RGBA32F};
    for (int i = 0; i < 3; i++)
        for (int raw = 0; raw < 2; raw++) {
            AUTO_IMAGE image = {0};
            lam_draw_params params = {.edges = LAM_EDGES_CREASE,
                                      .edge_width = 6,
                                      .edge_color = {1, 0.25f, 0, 1},
                                      .background = {0, 0, 1, 1},
                                      .exposure = 3,
                                      .color = raw ? LAM_COLOR_RAW : LAM_COLOR_SRGB};
            float front[3] = {-1, 0, 1};
            double at[2];
            project(&camera, front, at);
            assert_true(lam_image_make(&image, SIDE, SIDE, formats[i], NULL));
            assert_true(lam_draw(device, scene, &camera, &params, &image, NULL, NULL));
            size_t pixel = (size_t)at[1] * SIDE + (size_t)at[0];
            if (formats[i] == LAM_RGBA32F) {
                const float *c = (const float *)image.pixels + 4 * pixel;
                assert_true(c[0] == 1 && c[1] == 0.25f && c[2] == 0 && c[3] == 1);
            } else {
                const uint8_t *c = (const uint8_t *)image.pixels + (formats[i] == LAM_RGB8 ? 3 : 4) * pixel;
                assert_int_equal(c[0], 255);
                assert_int_equal(c[1], raw ? 64 : 137);
                assert_int_equal(c[2], 0);
            }
            // Pictures of surface quantities have no lines over them.
            AUTO_IMAGE plain = {0};
            params.output = LAM_OUTPUT_NORMALS;
            params.color = LAM_COLOR_SRGB;
            assert_true(lam_image_make(&plain, SIDE, SIDE, formats[i], NULL));
            assert_true(lam_draw(device, scene, &camera, &params, &image, NULL, NULL));
            params.edges = 0;
            assert_true(lam_draw(device, scene, &camera, &params, &plain, NULL, NULL));
            assert_memory_equal(image.pixels, plain.pixels,
                                SIDE * SIDE *
                                    (formats[i] == LAM_RGB8    ? 3
                                     : formats[i] == LAM_RGBA8 ? 4
                                                               : 16));
        }
    // Lines without surfaces are white over a dark background, unless they have a colour.
    lam_image image =
        draw(scene, &camera, (lam_draw_params){.edges = LAM_EDGES_ALL, .background = {0.1f, 0.1f, 0.1f, 1}});
    float most = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        most = ((const float *)image.pixels)[4 * i] > most ? ((const float *)image.pixels)[4 * i] : most;
    assert_true(most > 0.9f);
    lam_image_free(&image);
}

TEST(mistakes)
{
    lam_mesh mesh = cube();
    AUTO_SCENE scene = scene_of(&mesh);
    lam_camera camera = camera_at(0, 0, 6);
    AUTO_IMAGE image = {0};
    lam_error error;
    static const struct {
        lam_draw_params params;
        const char *text;
    } wrong[] = {
        {{.edge_width = 1e9f}, "edge_width is 1e+09, expected pixels from 0 to 1000"},
        {{.wireframe_width = -1}, "wireframe_width is -1, expected pixels from 0 to 1000"},
        {{.edges = 8}, "draw parameters: edges or hidden_lines is out of range"},
        {{.hidden_lines = LAM_HIDDEN_LINES_COUNT}, "draw parameters: edges or hidden_lines is out of range"},
        {{.edge_angle_rad = 4}, "edge_angle is 229.183°, expected 0° to 180°"},
        {{.edge_color = {0, 0, 0, 2}}, "edge_color: a channel is 2, expected a number of at least 0 and at most 1"}};
    assert_true(lam_image_make(&image, SIDE, SIDE, LAM_RGBA8, NULL));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_false(lam_draw(device, scene, &camera, &wrong[i].params, &image, NULL, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_string_equal(error.text, wrong[i].text);
    }
    // A memory limit that the lists of edges exceed causes an error, and the device still works afterwards.
    AUTO_DEVICE own = lam_device_cpu(&(lam_cpu_params){.threads = 1}, NULL);
    lam_draw_params params = {.wireframe = true};
    assert_false(lam_draw(own, scene, &camera, &params, &image, &(lam_control){.memory_limit_bytes = 1 << 20}, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    assert_true(lam_draw(own, scene, &camera, &params, &image, NULL, &error));
}

// --- duplicate faces

// A file that contains each face twice, once for either side, gives the lines of single faces.
TEST(twins)
{
    uint32_t twice[72];
    for (int i = 0; i < 12; i++)
        for (int k = 0; k < 3; k++) {
            twice[6 * i + k] = cube_indices[3 * i + k];
            twice[6 * i + 3 + k] = cube_indices[3 * i + 2 - k];
        }
    lam_mesh one = cube(), both = cube();
    both.indices = twice;
    both.triangle_count = 24;
    lam_camera camera = camera_at(2, 3, 7);
    for (int kind = LAM_EDGES_CREASE; kind <= LAM_EDGES_SILHOUETTE; kind <<= 1) {
        lam_scene *scene = scene_of(&one), *doubled = scene_of(&both);
        AUTO_IMAGE plain = draw(scene, &camera, (lam_draw_params){.edges = (unsigned)kind});
        uint64_t count = drawn();
        AUTO_IMAGE image = draw(doubled, &camera, (lam_draw_params){.edges = (unsigned)kind});
        assert_int_equal(drawn(), count);
        assert_memory_equal(image.pixels, plain.pixels, (size_t)SIDE * SIDE * 16);
        lam_scene_free(scene);
        lam_scene_free(doubled);
    }
}

// --- polygons of files

// The edges of a file's meshes in a wireframe.
static uint64_t edges_of(const char *text, const char *name, bool polygons)
{
    lam_scene *scene = load_with(text, strlen(text), name, &(lam_load_params){.polygon_edges = polygons});
    lam_camera camera = camera_at(1, 2, 9);
    assert_true(!polygons == !lam_scene_mesh(scene, 0)->inner_edges);
    lam_image image = draw(scene, &camera, (lam_draw_params){.wireframe = true});
    uint64_t count = drawn();
    lam_image_free(&image);
    lam_scene_free(scene);
    return count;
}

TEST(polygons)
{
    // A quad, a triangle next to it, and an L of six corners, which is not convex.
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 0 -1 0\nv 2 -1 0\nv 2 -2 0\nv 1 -2 0\n"
                              "v 1 -1.5 0\nv 0 -1.5 0\nf 1 2 3 4\nf 2 5 3\nf 6 7 8 9 10 11\n";
    assert_int_equal(edges_of(obj, "a.obj", true), 4 + 2 + 6);
    assert_int_equal(edges_of(obj, "a.obj", false), 5 + 2 + 9);
    static const char ply[] =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n4 0 1 2 3\n3 1 4 2\n";
    assert_int_equal(edges_of(ply, "a.ply", true), 4 + 2);
    assert_int_equal(edges_of(ply, "a.ply", false), 5 + 2);
}

FIXTURE(set_up, tear_down)
