// test_environment.c: surfaces mirror their surroundings as computed by a reference in double precision, and cube maps
// have no seams.
// The file has more than 600 lines because it contains the reference lookup in double and every picture and seam
// compared with it.

#include "test.h"

#include <spng.h>

#include "vec.h"

// --- cubes of pictures, and their reference in double

struct cube {
    int size;
    lam_image faces[6];
};

// OpenGL's table as printed in the specification: sc, tc, ma for each face.
static int face_of(vec d, double *sc, double *tc, double *ma)
{
    double ax = fabs(d.x), ay = fabs(d.y), az = fabs(d.z);
    int face = ax >= ay && ax >= az ? (d.x < 0) : ay >= az ? 2 + (d.y < 0) : 4 + (d.z < 0);
    const double table[6][3] = {{-d.z, -d.y, d.x}, {d.z, -d.y, -d.x}, {d.x, d.z, d.y},
                                {d.x, -d.z, -d.y}, {d.x, -d.y, d.z},  {-d.x, -d.y, -d.z}};
    *sc = table[face][0];
    *tc = table[face][1];
    *ma = table[face][2];
    return face;
}

// The inverse: the direction with these three numbers on a face.
static vec direction_on(int face, double sc, double tc, double ma)
{
    const vec table[6] = {{ma, -tc, -sc}, {-ma, -tc, sc}, {sc, ma, tc}, {sc, -ma, -tc}, {sc, -tc, ma}, {-sc, -tc, -ma}};
    return table[face];
}

static vec texel(const struct cube *cube, int face, int s, int t)
{
    const float *p = (const float *)cube->faces[face].pixels + 4 * ((size_t)t * (size_t)cube->size + (size_t)s);
    return of((double)p[0], (double)p[1], (double)p[2]);
}

// Texel (s, t), which may be one texel beyond an edge: then it is the nearest texel on the face there; beyond a corner,
// it is the average.
static vec any_texel(const struct cube *cube, int face, int s, int t)
{
    int n = cube->size;
    bool out_s = s < 0 || s >= n, out_t = t < 0 || t >= n;
    if (!out_s && !out_t)
        return texel(cube, face, s, t);
    int in_s = s < 0 ? 0 : s >= n ? n - 1 : s, in_t = t < 0 ? 0 : t >= n ? n - 1 : t;
    if (out_s && out_t)
        return times(
            add(add(texel(cube, face, in_s, in_t), any_texel(cube, face, s, in_t)), any_texel(cube, face, in_s, t)),
            1 / 3.0);
    double sc = out_s ? (s < 0 ? -1 : 1) : (2 * s + 1.0) / n - 1, tc = out_t ? (t < 0 ? -1 : 1) : (2 * t + 1.0) / n - 1,
           ma;
    vec d = direction_on(face, sc, tc, 1 - 1.0 / n);
    face = face_of(d, &sc, &tc, &ma);
    return texel(cube, face, (int)floor((sc / ma + 1) / 2 * n), (int)floor((tc / ma + 1) / 2 * n));
}

static vec look(const struct cube *cube, vec d)
{
    double sc, tc, ma;
    int face = face_of(d, &sc, &tc, &ma), n = cube->size;
    double u = (sc / ma + 1) / 2 * n - 0.5, v = (tc / ma + 1) / 2 * n - 0.5;
    int s = (int)floor(u), t = (int)floor(v);
    u -= s;
    v -= t;
    vec upper = add(times(any_texel(cube, face, s, t), 1 - u), times(any_texel(cube, face, s + 1, t), u));
    vec lower = add(times(any_texel(cube, face, s, t + 1), 1 - u), times(any_texel(cube, face, s + 1, t + 1), u));
    return add(times(upper, 1 - v), times(lower, v));
}

static uint64_t random_state = 1;
static double random_number(void)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (double)(random_state >> 40) / (1 << 24);
}

// Smooth: every texel is its direction, mapped to 0…1, with some waves. Otherwise: noise.
static struct cube make_cube(int size, bool smooth)
{
    struct cube cube = {.size = size};
    for (int face = 0; face < 6; face++) {
        assert_true(lam_image_make(&cube.faces[face], size, size, LAM_RGBA32F, NULL));
        float *p = cube.faces[face].pixels;
        for (int t = 0; t < size; t++) {
            for (int s = 0; s < size; s++, p += 4) {
                vec d = unit(direction_on(face, (2 * s + 1.0) / size - 1, (2 * t + 1.0) / size - 1, 1));
                const double smooth_values[3] = {0.5 + 0.5 * d.x, 0.5 + 0.5 * d.y,
                                                 0.5 + 0.25 * d.z + 0.25 * sin(5 * d.x + 3 * d.y)};
                for (int c = 0; c < 3; c++)
                    p[c] = (float)(smooth ? smooth_values[c] : random_number());
                p[3] = 1;
            }
        }
    }
    return cube;
}

static void free_cube(struct cube *cube)
{
    for (int face = 0; face < 6; face++)
        lam_image_free(&cube->faces[face]);
}

static lam_environment *environment_of(const struct cube *cube)
{
    const lam_image *faces[6];
    for (int face = 0; face < 6; face++)
        faces[face] = &cube->faces[face];
    lam_error error = {0};
    lam_environment *environment = lam_environment_make(faces, LAM_COLOR_RAW, &error);
    SUCCEEDS(environment);
    return environment;
}

static double apart(lam_rgb a, vec b)
{
    double r = fabs((double)a.r - b.x), g = fabs((double)a.g - b.y), bl = fabs((double)a.b - b.z);
    return fmax(r, fmax(g, bl));
}

static lam_rgb look_at(const lam_environment *e, vec d) { return lam_environment_sample(e, (lam_vec3){d.x, d.y, d.z}); }

TEST(test_lookup_equals_reference)
{
    for (int size = 1; size <= 64; size = size * 2 + (size < 4)) {
        struct cube cube = make_cube(size, false);
        lam_environment *e = environment_of(&cube);
        assert_int_equal(lam_environment_size(e), size);
        for (int i = 0; i < 4000; i++) {
            vec d = of(random_number() * 2 - 1, random_number() * 2 - 1, random_number() * 2 - 1);
            if (apart(look_at(e, d), look(&cube, d)) > 2e-5)
                fail_msg("size %d, direction %g %g %g: %g apart", size, d.x, d.y, d.z,
                         apart(look_at(e, d), look(&cube, d)));
        }
        lam_environment_free(e);
        free_cube(&cube);
    }
}

static double step_between(const lam_environment *e, vec a, vec b)
{
    lam_rgb y = look_at(e, b);
    return apart(look_at(e, a), of((double)y.r, (double)y.g, (double)y.b));
}

// Noise has steps of up to 1 between texels, so a seam would be visible.
TEST(test_no_seams)
{
    const double tiny = 1e-6;
    struct cube cube = make_cube(5, false);
    lam_environment *e = environment_of(&cube);
    for (int axis = 0; axis < 3; axis++) {
        for (int edge = 0; edge < 4; edge++) {
            for (int i = 0; i <= 1000; i++) {
                double along = i / 500.0 - 1, p = edge & 1 ? 1 : -1, q = edge & 2 ? 1 : -1;
                const double a[3] = {along, p * (1 + tiny), q}, b[3] = {along, p, q * (1 + tiny)};
                vec before = of(a[(3 - axis) % 3], a[(4 - axis) % 3], a[(5 - axis) % 3]);
                vec after = of(b[(3 - axis) % 3], b[(4 - axis) % 3], b[(5 - axis) % 3]);
                if (step_between(e, before, after) > 1e-4)
                    fail_msg("axis %d, edge %d, %g along: a step of %g", axis, edge, along,
                             step_between(e, before, after));
            }
        }
    }
    for (int corner = 0; corner < 8; corner++) {
        vec middle = of(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        for (int i = 0; i < 500; i++) {
            vec shift = of(random_number() * 2 - 1, random_number() * 2 - 1, random_number() * 2 - 1);
            vec place = add(middle, times(shift, tiny));
            assert_true(step_between(e, middle, place) < 1e-4);
        }
    }
    // A path of small steps through every kind of border.
    vec last = of(1, 0, 0);
    for (int i = 1; i <= 400000; i++) {
        double t = i * 1e-4;
        vec next = of(cos(t), sin(1.37 * t), sin(t));
        assert_true(step_between(e, last, next) < 5e-3);
        last = next;
    }
    lam_environment_free(e);
    free_cube(&cube);
}

// --- a mirror ball compared with rays

struct ball {
    double rotation;
    lam_up up;
    bool orthographic, light; // with a light: its own reflection must not appear
};

static vec from_lam(lam_vec3 v) { return of(v.x, v.y, v.z); }

// Transforms to the environment's axes: up to +Y, then back by the rotation.
static vec into_environment(const struct ball *ball, vec w)
{
    if (ball->up == LAM_UP_Z)
        w = of(w.x, w.z, -w.y);
    if (ball->up == LAM_UP_X)
        w = of(-w.y, w.x, w.z);
    if (ball->up == LAM_UP_NEGATIVE_Z)
        w = of(-w.x, -w.z, -w.y);
    if (ball->up == LAM_UP_NEGATIVE_Y)
        w = of(-w.x, -w.y, w.z);
    if (ball->up == LAM_UP_NEGATIVE_X)
        w = of(w.y, -w.x, w.z);
    double a = -ball->rotation;
    return of(cos(a) * w.x + sin(a) * w.z, w.y, -sin(a) * w.x + cos(a) * w.z);
}

static vec vertex(const float *list, uint32_t i)
{
    return of((double)list[3 * i], (double)list[3 * i + 1], (double)list[3 * i + 2]);
}

// The first intersection of a ray and a mesh, well within a triangle: point and interpolated normal. False if there is
// none, or near an edge.
static bool meet(const lam_mesh *mesh, vec from, vec along, vec *point, vec *normal)
{
    double nearest = HUGE_VAL;
    bool sure = false;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t corner[3], own[3];
        for (uint32_t k = 0; k < 3; k++) {
            corner[k] = mesh->indices ? mesh->indices[3 * t + k] : 3 * t + k;
            own[k] = mesh->normal_indices ? mesh->normal_indices[3 * t + k] : corner[k];
        }
        vec a = vertex(mesh->positions, corner[0]), u = sub(vertex(mesh->positions, corner[1]), a),
            w = sub(vertex(mesh->positions, corner[2]), a), h = cross(along, w), q;
        double determinant = dot(u, h);
        if (fabs(determinant) < 1e-14)
            continue;
        vec s = sub(from, a);
        q = cross(s, u);
        double b = dot(s, h) / determinant, c = dot(along, q) / determinant, distance = dot(w, q) / determinant;
        if (b < -1e-3 || c < -1e-3 || b + c > 1 + 1e-3 || distance > nearest)
            continue;
        nearest = distance;
        sure = b > 1e-2 && c > 1e-2 && b + c < 1 - 1e-2;
        *point = add(from, times(along, distance));
        *normal = unit(add(times(vertex(mesh->normals, own[0]), 1 - b - c),
                           add(times(vertex(mesh->normals, own[1]), b), times(vertex(mesh->normals, own[2]), c))));
    }
    return sure;
}

static void check_ball(const struct ball *ball)
{
    enum { SIDE = 96 };
    lam_error error = {0};
    struct cube cube = make_cube(64, true);
    lam_environment *environment = environment_of(&cube);
    AUTO_SCENE scene = lam_scene_make(&error);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 24, .stacks = 12}, &error);
    lam_material mirror = {.diffuse = {0, 0, 0, 1}, .reflectivity = {0.9f, 0.8f, 0.7f}};
    object.material = lam_scene_add_material(scene, &mirror, &error);
    lam_scene_add_object(scene, &object, &error);
    vec light = unit(of(-1, 2, 0.5));
    if (ball->light) {
        lam_light l = lam_light_default(LAM_LIGHT_DIRECTIONAL);
        l.direction = (lam_vec3){-light.x, -light.y, -light.z};
        lam_scene_add_light(scene, &l, &error);
    }
    lam_scene_set_up(scene, ball->up);
    assert_true(lam_scene_set_reflection_map(scene, environment, ball->rotation, &error));
    lam_environment_free(environment); // the scene still uses it
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){2, 1.2, 2.5};
    camera.ortho_half_height = ball->orthographic ? 1.05 : 0;
    camera.fovy_rad = 0.65;
    lam_draw_params params = {.samples = 1, .color = LAM_COLOR_RAW, .rig = LAM_RIG_NONE};
    AUTO_IMAGE image = {0};
    assert_true(lam_image_make(&image, SIDE, SIDE, LAM_RGBA32F, &error));
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    SUCCEEDS(lam_draw(device, scene, &camera, &params, &image, NULL, &error));

    vec eye = from_lam(camera.eye), back = unit(eye), right = unit(cross(of(0, 1, 0), back)),
        above = cross(back, right);
    double most = 0, sum = 0, wrong = 0;
    int count = 0;
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            double half = ball->orthographic ? 1.05 : tan(0.65 / 2);
            double px = (2 * (x + 0.5) / SIDE - 1) * half, py = (1 - 2 * (y + 0.5) / SIDE) * half;
            vec across = add(times(right, px), times(above, py)), point, normal;
            vec from = ball->orthographic ? add(times(back, 5), across) : eye;
            vec along = ball->orthographic ? times(back, -1) : sub(across, back);
            if (!meet(lam_scene_mesh(scene, 0), from, along, &point, &normal))
                continue;
            vec v = ball->orthographic ? back : unit(sub(eye, point));
            vec r = sub(times(normal, 2 * dot(normal, v)), v),
                of_light = sub(times(normal, 2 * dot(normal, light)), light);
            vec expected = look(&cube, into_environment(ball, r)),
                other = look(&cube, into_environment(ball, of_light));
            const float *p = (const float *)image.pixels + 4 * ((size_t)y * SIDE + (size_t)x);
            const double kr[3] = {(double)0.9f, (double)0.8f, (double)0.7f},
                         e[3] = {expected.x, expected.y, expected.z}, o[3] = {other.x, other.y, other.z};
            for (int c = 0; c < 3; c++) {
                double error_here = fabs((double)p[c] - kr[c] * e[c]);
                most = fmax(most, error_here);
                sum += error_here;
                wrong += fabs((double)p[c] - kr[c] * o[c]);
                count++;
            }
        }
    }
    assert_true(count > 3 * SIDE * SIDE / 3);
    if (getenv("LAMBENT_TEST_TELL"))
        print_message("# at most %g, mean %g, light's r %g over %d numbers\n", most, sum / count, wrong / count, count);
    if (most > 5e-4 || sum / count > 5e-6)
        fail_msg("%g at most, %g on average, expected 5e-4 and 5e-6", most, sum / count);
    assert_true(wrong / count > 0.05);
    free_cube(&cube);
}

TEST(test_ball) { check_ball(&(struct ball){0}); }
TEST(test_ball_turned) { check_ball(&(struct ball){.rotation = 0.7}); }
TEST(test_ball_orthographic) { check_ball(&(struct ball){.orthographic = true, .rotation = -2}); }
TEST(test_ball_z_up) { check_ball(&(struct ball){.up = LAM_UP_Z, .rotation = 1}); }
TEST(test_ball_x_up)
{
    check_ball(&(struct ball){.up = LAM_UP_X, .light = true});
    check_ball(&(struct ball){.up = LAM_UP_NEGATIVE_X, .rotation = 1});
    check_ball(&(struct ball){.up = LAM_UP_NEGATIVE_Y, .rotation = 1});
    check_ball(&(struct ball){.up = LAM_UP_NEGATIVE_Z, .rotation = 1});
}
TEST(test_ball_lit) { check_ball(&(struct ball){.light = true}); }

// --- layouts

// Cuts a cross: each face moves to its documented place.
TEST(test_crosses)
{
    enum { N = 6 };
    struct cube cube = make_cube(N, false);
    lam_environment *straight = environment_of(&cube);
    static const int places[2][6][2] = {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}},
                                        {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}};
    for (int stands = 0; stands < 2; stands++) {
        AUTO_IMAGE cross_image = {0};
        assert_true(lam_image_make(&cross_image, N * (stands ? 3 : 4), N * (stands ? 4 : 3), LAM_RGBA32F, NULL));
        memset(cross_image.pixels, 0xff, (size_t)12 * N * N * 16); // NaN: texels outside the cross are never used
        for (int face = 0; face < 6; face++) {
            for (int t = 0; t < N; t++) {
                for (int s = 0; s < N; s++) {
                    bool turned = stands && face == LAM_FACE_NZ;
                    int x = places[stands][face][0] * N + (turned ? N - 1 - s : s),
                        y = places[stands][face][1] * N + (turned ? N - 1 - t : t);
                    memcpy((float *)cross_image.pixels + 4 * (y * cross_image.width + x),
                           (float *)cube.faces[face].pixels + 4 * (t * N + s), 16);
                }
            }
        }
        lam_error error = {0};
        lam_environment *e = lam_environment_from_image(&cross_image, LAM_COLOR_RAW, &error);
        SUCCEEDS(e);
        for (int i = 0; i < 2000; i++) {
            vec d = of(random_number() * 2 - 1, random_number() * 2 - 1, random_number() * 2 - 1);
            lam_rgb a = look_at(e, d), b = look_at(straight, d);
            assert_memory_equal(&a, &b, sizeof a);
        }
        lam_environment_free(e);
    }
    lam_environment_free(straight);
    free_cube(&cube);
}

// A 2:1 picture whose pixels are their directions: −Z in the middle, +X to the right, +Y at the top.
TEST(test_equirectangular)
{
    enum { WIDTH = 512, HEIGHT = 256 };
    AUTO_IMAGE image = {0};
    assert_true(lam_image_make(&image, WIDTH, HEIGHT, LAM_RGBA32F, NULL));
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            double longitude = ((x + 0.5) / WIDTH - 0.5) * 2 * M_PI, down = (y + 0.5) / HEIGHT * M_PI;
            float *p = (float *)image.pixels + 4 * (y * WIDTH + x);
            p[0] = (float)(0.5 + 0.5 * sin(down) * sin(longitude));
            p[1] = (float)(0.5 + 0.5 * cos(down));
            p[2] = (float)(0.5 - 0.5 * sin(down) * cos(longitude));
            p[3] = 1;
        }
    }
    lam_environment *e = lam_environment_from_image(&image, LAM_COLOR_SRGB, NULL);
    assert_non_null(e);
    assert_int_equal(lam_environment_size(e), 163); // ⌈512/π⌉
    for (int i = 0; i < 20000; i++) {
        vec d = unit(of(random_number() * 2 - 1, random_number() * 2 - 1, random_number() * 2 - 1));
        if (apart(look_at(e, d), of(0.5 + 0.5 * d.x, 0.5 + 0.5 * d.y, 0.5 + 0.5 * d.z)) >
            1e-3) // least precise where three faces meet
            fail_msg("%g %g %g: %g", d.x, d.y, d.z,
                     apart(look_at(e, d), of(0.5 + 0.5 * d.x, 0.5 + 0.5 * d.y, 0.5 + 0.5 * d.z)));
    }
    lam_environment_free(e);
}

// --- files

static void write_16(const char *path, const uint16_t pixels[3])
{
    spng_ctx *spng = spng_ctx_new(SPNG_CTX_ENCODER);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    struct spng_ihdr header = {.width = 1, .height = 1, .bit_depth = 16, .color_type = SPNG_COLOR_TYPE_TRUECOLOR};
    spng_set_png_file(spng, file);
    spng_set_ihdr(spng, &header);
    assert_int_equal(spng_encode_image(spng, pixels, 6, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
    spng_ctx_free(spng);
    fclose(file);
}

static double decoded(double x) { return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4); }

TEST(test_files_of_16_bits)
{
    static const vec axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    char names[6][64];
    const char *paths[6];
    uint16_t pixels[6][3];
    for (int face = 0; face < 6; face++) {
        snprintf(names[face], sizeof names[face], "test-environment-%d-%d.png", (int)getpid(), face);
        for (int c = 0; c < 3; c++)
            pixels[face][c] = (uint16_t)(10007 * (face + 1) + 257 * c + 3);
        write_16(names[face], pixels[face]);
        paths[face] = names[face];
    }
    for (int mode = 0; mode < 2; mode++) {
        lam_error error = {0};
        lam_environment *e = lam_environment_load_faces(paths, mode ? LAM_COLOR_RAW : LAM_COLOR_SRGB, NULL, &error);
        SUCCEEDS(e);
        for (int face = 0; face < 6; face++) {
            double v[3];
            for (int c = 0; c < 3; c++)
                v[c] = mode ? pixels[face][c] / 65535.0 : decoded(pixels[face][c] / 65535.0);
            if (apart(look_at(e, axes[face]), of(v[0], v[1], v[2])) > 2e-7)
                fail_msg("face %d: %g", face, apart(look_at(e, axes[face]), of(v[0], v[1], v[2])));
        }
        lam_environment_free(e);
    }
    // An error names the file that fails.
    paths[3] = "no-such-face.png";
    lam_error error = {0};
    assert_null(lam_environment_load_faces(paths, LAM_COLOR_SRGB, NULL, &error));
    assert_non_null(strstr(error.text, "no-such-face.png"));
    for (int face = 0; face < 6; face++)
        unlink(names[face]);
}

TEST(test_real_files)
{
    const char *models = getenv("LAMBENT_MODELS");
    char names[6][1024], hdr[1024];
    static const char *const sides[6] = {"posx", "negx", "posy", "negy", "posz", "negz"};
    const char *paths[6];
    snprintf(hdr, sizeof hdr, "%s/env/kloppenheim_05_1k.hdr", models ? models : "../shared/models");
    if (access(hdr, R_OK) != 0) {
        print_message("# %s is not there\n", hdr);
        skip();
    }
    for (int face = 0; face < 6; face++) {
        snprintf(names[face], sizeof names[face], "%s/env/noon_grass_cube/%s.png", models ? models : "../shared/models",
                 sides[face]);
        paths[face] = names[face];
    }
    lam_error error = {0};
    lam_environment *sphere = lam_environment_load(hdr, LAM_COLOR_SRGB, NULL, &error),
                    *cube = lam_environment_load_faces(paths, LAM_COLOR_SRGB, NULL, &error);
    if (!sphere || !cube)
        fail_msg("%s", error.text);
    assert_int_equal(lam_environment_size(sphere), 326);
    assert_int_equal(lam_environment_size(cube), 512);
    // Open country by day: bright and blue above, the ground darker, nothing black.
    const lam_environment *both[2] = {sphere, cube};
    for (int i = 0; i < 2; i++) {
        lam_rgb up = look_at(both[i], of(0.2, 1, 0.1)), down = look_at(both[i], of(0.1, -1, 0));
        assert_true(up.b > up.r && up.b > 2 * down.b && down.r > 0.005f);
    }
    lam_environment_free(sphere);
    lam_environment_free(cube);
}

TEST(test_built_in)
{
    int count = 0;
    for (; lam_environment_built_in_name(count); count++) {
        lam_environment *e = lam_environment_built_in(lam_environment_built_in_name(count), NULL);
        assert_non_null(e);
        double bright = 0, dark = 1e9;
        for (int i = 0; i < 20000; i++) {
            lam_rgb c = look_at(e, of(random_number() * 2 - 1, random_number() * 2 - 1, random_number() * 2 - 1));
            bright = fmax(bright, (double)c.g);
            dark = fmin(dark, (double)c.g);
        }
        assert_true(dark > 0 && dark < 0.5 && bright > 1.5 && bright < 500);
        // What a horizontal white surface returns: at most a quarter above white, and less at night. The mean of max(y, 0)
        // over random directions is 1/4 for a constant environment of 1.
        double up = 0;
        for (int i = 0; i < 200000; i++) {
            double x = random_number() * 2 - 1, y = random_number() * 2 - 1, z = random_number() * 2 - 1;
            double length = sqrt(x * x + y * y + z * z);
            i -= length > 1 || length == 0;
            if (length <= 1 && y > 0)
                up += 4 * (double)look_at(e, of(x, y, z)).g * y / length / 200000;
        }
        bool is_night = strcmp(lam_environment_built_in_name(count), "night") == 0;
        assert_true(is_night ? up > 0.1 && up < 0.5 : up > 0.3 && up < 1.3);
        lam_environment_free(e);
    }
    assert_int_equal(count, 6);
    assert_null(lam_environment_built_in_name(-1));
}

// A hash of every third texel of every third row: faster computations must not change the light.
TEST(test_built_in_texels)
{
    static const uint64_t expected[] = {0x6aa02f8d7b5c2bd7, 0x8253e980332de23e, 0x900046591e364453,
                                        0x6526c342cc076356, 0x298e9198f4c6a323, 0x6e865b74aad903d1};
    for (int index = 0; index < 6; index++) {
        lam_environment *e = lam_environment_built_in(lam_environment_built_in_name(index), NULL);
        assert_non_null(e);
        int size = lam_environment_size(e);
        uint64_t hash = 0xcbf29ce484222325; // FNV-1a
        for (int face = 0; face < 6; face++)
            for (int t = 0; t < size; t += 3)
                for (int s = 0; s < size; s += 3) {
                    double across = (2 * s + 1 - size) / (double)size, down = (2 * t + 1 - size) / (double)size;
                    double major = face % 2 ? -1 : 1;
                    lam_vec3 d = face < 2   ? (lam_vec3){major, down, across}
                                 : face < 4 ? (lam_vec3){across, major, down}
                                            : (lam_vec3){across, down, major};
                    lam_rgb c = lam_environment_sample(e, d);
                    unsigned char bytes[sizeof c];
                    memcpy(bytes, &c, sizeof c);
                    for (size_t i = 0; i < sizeof bytes; i++)
                        hash = (hash ^ bytes[i]) * 0x100000001b3;
                }
        lam_environment_free(e);
        assert_int_equal(hash, expected[index]);
    }
}

// --- refused cases

static void refused(lam_environment *environment, const lam_error *error, lam_code code, const char *word)
{
    assert_null(environment);
    assert_int_equal(error->code, code);
    if (!strstr(error->text, word))
        fail_msg("'%s' does not say '%s'", error->text, word);
}

TEST(test_refusals)
{
    lam_error error = {0};
    struct cube cube = make_cube(4, true);
    const lam_image *faces[6];
    for (int face = 0; face < 6; face++)
        faces[face] = &cube.faces[face];
    float *pixel = cube.faces[2].pixels;
    const float bad[3] = {NAN, -1e-3f, INFINITY};
    for (int i = 0; i < 3; i++) {
        pixel[4 * 5 + 1] = bad[i];
        refused(lam_environment_make(faces, LAM_COLOR_RAW, &error), &error, LAM_BAD_ARGUMENT, "face +Y: pixel 1, 1");
    }
    pixel[4 * 5 + 1] = 0;
    AUTO_IMAGE odd = {0};
    assert_true(lam_image_make(&odd, 5, 4, LAM_RGBA8, NULL));
    memset(odd.pixels, 0, 80);
    faces[4] = &odd;
    refused(lam_environment_make(faces, LAM_COLOR_RAW, &error), &error, LAM_UNSUPPORTED, "face +Z: 5×4 pixels");
    refused(lam_environment_from_image(&odd, LAM_COLOR_RAW, &error), &error, LAM_UNSUPPORTED,
            "5×4 pixels, expected a cross");
    refused(lam_environment_from_image(NULL, LAM_COLOR_RAW, &error), &error, LAM_BAD_ARGUMENT, "missing");
    faces[4] = NULL;
    refused(lam_environment_make(faces, LAM_COLOR_RAW, &error), &error, LAM_BAD_ARGUMENT, "missing");
    refused(lam_environment_make(NULL, LAM_COLOR_RAW, &error), &error, LAM_BAD_ARGUMENT, "no faces");
    refused(lam_environment_built_in("heaven", &error), &error, LAM_BAD_ARGUMENT, "heaven");
    refused(lam_environment_load("no-such-picture.hdr", LAM_COLOR_SRGB, NULL, &error), &error, LAM_CANNOT_READ,
            "no-such-picture.hdr");
    lam_scene *scene = lam_scene_make(&error);
    assert_false(lam_scene_set_reflection_map(scene, NULL, (double)NAN, &error));
    assert_true(lam_scene_set_reflection_map(scene, NULL, 0, &error));
    lam_scene_free(scene);
    assert_true(apart(lam_environment_sample(NULL, (lam_vec3){1, 0, 0}), of(0, 0, 0)) == 0);
    free_cube(&cube);
}
