// test_camera.c: the fitted camera. For any position and rotation, a model fills 92 % of the tighter side of the
// picture, in its middle.
#include "test.h"
#include "../lighting/random.h"
#include "loading.h"

static const double FILL = 0.92;

static double between(struct random *r, double low, double high)
{
    return (double)random_between(r, (float)low, (float)high);
}

// Evenly distributed in the logarithm.
static double between_logs(struct random *r, double low, double high) { return exp(between(r, log(low), log(high))); }

static lam_vec3 direction(struct random *r)
{
    for (;;) {
        lam_vec3 d = {between(r, -1, 1), between(r, -1, 1), between(r, -1, 1)};
        double length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        if (length > 0.1 && length <= 1)
            return (lam_vec3){d.x / length, d.y / length, d.z / length};
    }
}

static lam_vec3 moved(const lam_mat4 *m, const double p[3])
{
    double q[3];
    for (int i = 0; i < 3; i++)
        q[i] = m->m[i][0] * p[0] + m->m[i][1] * p[1] + m->m[i][2] * p[2] + m->m[i][3];
    return (lam_vec3){q[0], q[1], q[2]};
}

// The extent of something in a picture, on x and y in pixels.
struct span {
    double low[2], high[2];
};

static void widen(struct span *span, double x, double y)
{
    const double at[2] = {x, y};
    for (int k = 0; k < 2; k++) {
        span->low[k] = fmin(span->low[k], at[k]);
        span->high[k] = fmax(span->high[k], at[k]);
    }
}

static const struct span no_span = {{1e300, 1e300}, {-1e300, -1e300}};

// A box, its corners in world space, and its picture.
struct boxed {
    lam_scene *scene;
    lam_vec3 corners[8];
    lam_view view;
    int width, height;
    double distance; // from zero, in multiples of the box's size
};

// The ways in which a box can be far from zero.
enum { BY_POSITIONS, BY_ORIGIN, BY_TRANSFORM, WAYS };

static const uint32_t faces[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

static struct boxed make_box(struct random *r, int number)
{
    struct boxed b = {.distance = number % 2 ? between(r, 0, 4) : between_logs(r, 4, 1e6)};
    double size = between_logs(r, 1e-3, 1e3), sides[3], far[3];
    for (int i = 0; i < 3; i++)
        sides[i] = size * between_logs(r, 0.05, 1);
    double longest = fmax(sides[0], fmax(sides[1], sides[2]));
    lam_vec3 d = direction(r);
    far[0] = d.x * b.distance * longest;
    far[1] = d.y * b.distance * longest;
    far[2] = d.z * b.distance * longest;
    int way = number % WAYS;

    // The object is rotated; the mesh is then far from zero in a rotated direction.
    lam_scene *scene = b.scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    float p[24];
    for (int c = 0; c < 8; c++)
        for (int i = 0; i < 3; i++)
            p[3 * c + i] = (float)((c >> i & 1 ? 0.5 : -0.5) * sides[i] + (way == BY_POSITIONS ? far[i] : 0));
    lam_mesh mesh = {.positions = p, .vertex_count = 8, .indices = faces, .triangle_count = 12};
    for (int i = 0; i < 3 && way == BY_ORIGIN; i++)
        mesh.origin[i] = far[i];
    object.mesh = lam_scene_add_mesh(scene, &mesh, NULL);
    assert_true(object.mesh == 0 && lam_scene_add_object(scene, &object, NULL) == 0);
    assert_true(lam_scene_rotate(scene, (lam_vec3){0, 0, 0}, direction(r), between(r, 0, 6.3), NULL));
    lam_mat4 away = lam_mat4_identity();
    for (int i = 0; i < 3; i++)
        away.m[i][3] = way == BY_TRANSFORM ? far[i] : 0;
    assert_true(lam_scene_transform(scene, &away, NULL));
    for (int c = 0; c < 8; c++) {
        double q[3];
        for (int i = 0; i < 3; i++)
            q[i] = (double)p[3 * c + i] + mesh.origin[i];
        b.corners[c] = moved(&lam_scene_object(scene, 0)->transform, q);
    }
    lam_scene_set_up(scene, (lam_up)(1 + random_bits(r) % (LAM_UP_COUNT - 1)));
    b.view = (lam_view){.from_angles = number % 5 > 0,
                        .azimuth_rad = between(r, -4, 4),
                        .elevation_rad = between(r, -1.5, 1.5),
                        .fovy_rad = number % 7 ? between(r, 0.1, 1.6) : 0,
                        .orthographic = number % 4 == 3};
    double aspect = between_logs(r, 0.3, 3);
    b.width = (int)(512 * fmin(aspect, 1));
    b.height = (int)(512 * fmin(1 / aspect, 1));
    return b;
}

// The box's corners in the picture, computed in double.
static struct span projected(const struct boxed *b, const lam_camera *camera)
{
    lam_mat4 look = lam_camera_view_matrix(camera);
    struct span span = no_span;
    for (int c = 0; c < 8; c++) {
        lam_vec3 e = moved(&look, (const double[3]){b->corners[c].x, b->corners[c].y, b->corners[c].z});
        double half = camera->ortho_half_height > 0 ? camera->ortho_half_height : -e.z * tan(camera->fovy_rad / 2);
        if (!(half > 0)) { // behind the eye
            widen(&span, -1e300, -1e300);
            widen(&span, 1e300, 1e300);
            continue;
        }
        widen(&span, 0.5 * b->width + e.x / half * 0.5 * b->height, 0.5 * b->height - e.y / half * 0.5 * b->height);
    }
    return span;
}

// The pixels that the drawn box touches.
static struct span drawn(const struct boxed *b, const lam_camera *camera)
{
    lam_error error;
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = 1}, &error);
    lam_image image = {0};
    assert_true(device && lam_image_make(&image, b->width, b->height, LAM_RGBA8, &error));
    assert_true(lam_draw(device, b->scene, camera, &(lam_draw_params){.samples = 16}, &image, NULL, &error));
    struct span span = no_span;
    const uint8_t *pixels = image.pixels;
    for (int y = 0; y < b->height; y++)
        for (int x = 0; x < b->width; x++)
            if (pixels[4 * ((size_t)y * (size_t)b->width + (size_t)x) + 3]) {
                widen(&span, x, y);
                widen(&span, x + 1, y + 1);
            }
    lam_image_free(&image);
    lam_device_free(device);
    return span;
}

// None of 300 random boxes is off the middle or cut off, at up to a million sizes from zero. A perspective box touches
// both ends of the tighter side; its other side is also centred.
TEST(boxes_fill_the_picture)
{
    struct random r = {11};
    for (int number = 0; number < 300; number++) {
        struct boxed b = make_box(&r, number);
        lam_camera camera = lam_camera_fit(b.scene, b.width, b.height, &b.view);
        struct span span = projected(&b, &camera);
        double fill = 0;
        for (int k = 0; k < 2; k++) {
            double side = k ? b.height : b.width;
            fill = fmax(fill, (span.high[k] - span.low[k]) / side);
            if (!(fabs(span.low[k] + span.high[k] - side) < 2e-4))
                fail_msg("box %d at %.3g sizes: %c from %g to %g of %g pixels", number, b.distance, "xy"[k],
                         span.low[k], span.high[k], side);
        }
        if (!(fabs(fill - FILL) < 1e-6))
            fail_msg("box %d at %.3g sizes: fills %.9g", number, b.distance, fill);
        if (number % 6 == 5 || b.distance > 1e5) {
            // A sharp corner may extend over a pixel without covering one of its samples.
            struct span seen = drawn(&b, &camera);
            for (int k = 0; k < 2; k++)
                if (!(fabs(seen.low[k] - span.low[k]) < 1.5 && fabs(seen.high[k] - span.high[k]) < 1.5))
                    fail_msg("box %d at %.3g sizes: %c drawn from %g to %g, computed %g to %g", number, b.distance,
                             "xy"[k], seen.low[k], seen.high[k], span.low[k], span.high[k]);
        }
        lam_scene_free(b.scene);
    }
}

// A box rotated about an axis by any angle is never cut off, and the camera equals the camera of the unrotated box if
// that does not cut it off either. Rotated about any axis, it is treated as a ball that is not cut off.
TEST(turning_boxes_are_not_cut)
{
    struct random r = {3};
    int kept = 0, moved_back = 0;
    for (int number = 0; number < 150; number++) {
        struct boxed b = make_box(&r, number);
        lam_vec3 centre, axis = direction(&r);
        assert_true(lam_scene_sphere(b.scene, -1, &centre, NULL));
        bool any = number % 5 == 4;
        lam_camera still = lam_camera_fit(b.scene, b.width, b.height, &b.view);
        lam_camera camera =
            lam_camera_fit_turning(b.scene, centre, any ? (lam_vec3){0} : axis, b.width, b.height, &b.view);
        lam_vec3 corners[8];
        memcpy(corners, b.corners, sizeof corners);
        bool same = memcmp(&still, &camera, sizeof camera) == 0;
        kept += same;
        moved_back += !same;
        double fill = 0, fill_still = 0;
        for (int turn = 0; turn < 200; turn++) {
            // A scene with one object at the position of the corners performs the rotation.
            AUTO_SCENE turning = lam_scene_make(NULL);
            lam_object object = lam_object_default();
            object.mesh = lam_scene_add_shape(turning, "cube", NULL, NULL);
            assert_true(lam_scene_add_object(turning, &object, NULL) == 0);
            lam_vec3 about = any ? direction(&r) : axis;
            assert_true(lam_scene_rotate(turning, centre, about, between(&r, 0, 6.3), NULL));
            for (int c = 0; c < 8; c++)
                b.corners[c] = moved(&lam_scene_object(turning, 0)->transform,
                                     (const double[3]){corners[c].x, corners[c].y, corners[c].z});
            struct span span = projected(&b, &camera), before = projected(&b, &still);
            for (int k = 0; k < 2; k++) {
                double half = 0.5 * (k ? b.height : b.width);
                fill = fmax(fill, fmax(half - span.low[k], span.high[k] - half) / half);
                fill_still = fmax(fill_still, fmax(half - before.low[k], before.high[k] - half) / half);
            }
        }
        if (!(fill < (same ? 0.985 : 0.925)))
            fail_msg("box %d: turned it reaches %g of the side", number, fill);
        if (!same && !any && fill_still < 0.95)
            fail_msg("box %d: the camera moved, though %g of the side would do", number, fill_still);
        lam_scene_free(b.scene);
    }
    assert_true(kept >= 10 && moved_back >= 10);
}

// --- files

static void put_corner(struct made *file, const double p[3], bool doubles)
{
    for (int i = 0; i < 3; i++) {
        if (doubles)
            put_f64(file, p[i]);
        else
            put_f32(file, (float)p[i]);
    }
}

static void make_stl(struct made *file, const double corners[8][3], bool binary)
{
    char line[200];
    *file = (struct made){0};
    if (binary) {
        uint8_t header[80] = {0};
        put(file, header, 80);
        put_u32(file, 12);
    } else {
        put_text(file, "solid box\n");
    }
    for (int t = 0; t < 12; t++) {
        if (binary)
            put_corner(file, (const double[3]){0, 0, 0}, false);
        else
            put_text(file, "facet normal 0 0 0\nouter loop\n");
        for (int i = 0; i < 3; i++) {
            const double *p = corners[faces[3 * t + i]];
            snprintf(line, sizeof line, "vertex %.17g %.17g %.17g\n", p[0], p[1], p[2]);
            if (binary)
                put_corner(file, p, false);
            else
                put_text(file, line);
        }
        if (binary)
            put_u16(file, 0);
        else
            put_text(file, "endloop\nendfacet\n");
    }
    if (!binary)
        put_text(file, "endsolid box\n");
}

static void make_ply(struct made *file, const double corners[8][3], const char *format, const char *type)
{
    char line[400];
    *file = (struct made){0};
    snprintf(line, sizeof line,
             "ply\nformat %s 1.0\nelement vertex 8\nproperty %s x\nproperty %s y\nproperty %s z\n"
             "element face 12\nproperty list uchar int vertex_indices\nend_header\n",
             format, type, type, type);
    put_text(file, line);
    for (int c = 0; c < 8; c++) {
        snprintf(line, sizeof line, "%.17g %.17g %.17g\n", corners[c][0], corners[c][1], corners[c][2]);
        if (*format == 'a')
            put_text(file, line);
        else
            put_corner(file, corners[c], *type == 'd');
    }
    for (int t = 0; t < 12; t++) {
        snprintf(line, sizeof line, "3 %u %u %u\n", faces[3 * t], faces[3 * t + 1], faces[3 * t + 2]);
        if (*format == 'a')
            put_text(file, line);
        for (int i = 0; i < 4 && *format != 'a'; i++) {
            if (i == 0)
                put_u8(file, 3);
            else
                put_u32(file, faces[3 * t + i - 1]);
        }
    }
}

static void make_obj(struct made *file, const double corners[8][3])
{
    char line[200];
    *file = (struct made){0};
    for (int c = 0; c < 8; c++) {
        snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", corners[c][0], corners[c][1], corners[c][2]);
        put_text(file, line);
    }
    for (int t = 0; t < 12; t++) {
        snprintf(line, sizeof line, "f %u %u %u\n", faces[3 * t] + 1, faces[3 * t + 1] + 1, faces[3 * t + 2] + 1);
        put_text(file, line);
    }
}

// A box of every format, a thousand and a million sizes from zero: the picture shows its corners at the positions in
// the file, rounded to floats if the file contains floats.
TEST(files_far_from_zero)
{
    enum { OBJ, STL_TEXT, STL_BINARY, PLY_TEXT, PLY_FLOAT, PLY_DOUBLE, FORMATS };
    static const char *const names[FORMATS] = {"box.obj", "box.stl", "box.stl", "box.ply", "box.ply", "box.ply"};
    static const lam_vec3 places[] = {{700, 0, -1200}, {8e5, -6e5, 1}};
    for (int i = 0; i < 2 * FORMATS; i++) {
        int format = i / 2;
        bool floats = format == STL_BINARY || format == PLY_FLOAT;
        const lam_vec3 *place = &places[i % 2];
        double corners[8][3];
        struct boxed b = {.width = 400, .height = 300};
        for (int c = 0; c < 8; c++) {
            const double p[3] = {place->x + (c & 1 ? 0.7 : 0), place->y + (c & 2 ? 1.1 : 0),
                                 place->z + (c & 4 ? 0.6 : 0)};
            for (int k = 0; k < 3; k++)
                corners[c][k] = floats ? (double)(float)p[k] : p[k];
            b.corners[c] = (lam_vec3){corners[c][0], corners[c][1], corners[c][2]};
        }
        struct made file;
        if (format == OBJ)
            make_obj(&file, (const double(*)[3])corners);
        else if (format == STL_TEXT || format == STL_BINARY)
            make_stl(&file, (const double(*)[3])corners, format == STL_BINARY);
        else
            make_ply(&file, (const double(*)[3])corners, format == PLY_TEXT ? "ascii" : "binary_little_endian",
                     format == PLY_DOUBLE ? "double" : "float");
        b.scene = load(&file, names[format]);
        const lam_mesh *mesh = lam_scene_mesh(b.scene, 0);
        assert_true(mesh->origin[0] != 0);
        for (uint32_t k = 0; k < 36; k++) {
            lam_vec3 found = corner_at(mesh, k / 3, k % 3), expected = b.corners[faces[k]];
            double apart = floats ? 0 : 1e-6;
            assert_near(found.x, expected.x, apart);
            assert_near(found.y, expected.y, apart);
            assert_near(found.z, expected.z, apart);
        }
        lam_camera camera = lam_camera_fit(b.scene, b.width, b.height, NULL);
        struct span span = projected(&b, &camera), seen = drawn(&b, &camera);
        for (int k = 0; k < 2; k++) {
            double side = k ? b.height : b.width;
            assert_near(span.low[k] + span.high[k], side, 1e-3);
            assert_near(seen.low[k], span.low[k], 1.5);
            assert_near(seen.high[k], span.high[k], 1.5);
        }
        lam_scene_free(b.scene);
    }
}

// A mesh made by hand keeps its corners exactly; one near zero keeps its numbers, and an unused vertex has no effect,
// even if its distance exceeds the range of floats.
TEST(origins_are_exact)
{
    struct random r = {5};
    for (int number = 0; number < 200; number++) {
        float p[12];
        double distance = number % 4 ? between_logs(&r, 20, 1e7) : 10;
        const float far[3] = {(float)distance, (float)(-0.3 * distance), (float)between(&r, -3, 3)};
        for (int i = 0; i < 9; i++) // a triangle of size 1
            p[i] = far[i % 3] + (i % 3 == 0 && i < 6 ? (float)(i / 3) : random_between(&r, 0, 1));
        p[9] = p[10] = p[11] = -3.4e38f;
        AUTO_SCENE scene = lam_scene_make(NULL);
        lam_mesh mesh = {.positions = p, .vertex_count = 4, .indices = (uint32_t[]){0, 1, 2}, .triangle_count = 1};
        assert_true(lam_scene_add_mesh(scene, &mesh, NULL) == 0);
        const lam_mesh *kept = lam_scene_mesh(scene, 0);
        for (uint32_t c = 0; c < 3; c++)
            assert_corner(kept, 0, c, (double)p[3 * c], (double)p[3 * c + 1], (double)p[3 * c + 2]);
        assert_true((kept->origin[0] != 0) == (number % 4 > 0));
        for (int i = 0; i < 12; i++)
            assert_true(isfinite(kept->positions[i]));
    }
}

// Seen from above, the nearest corner alone decides the distance, which is then 0 but for rounding.
TEST(a_corner_that_hides_the_rest_is_in_view)
{
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 1 7 0\nv 0 1 0.24069478908188585\nf 1 2 3 4\n";
    lam_error error;
    lam_scene *scene = lam_scene_load_memory(text, sizeof text - 1, "a.obj", NULL, NULL, &error);
    assert_non_null(scene);
    lam_view view = lam_view_of_side(LAM_SIDE_TOP);
    lam_camera camera = lam_camera_fit(scene, 16, 16, &view);
    assert_true(camera.eye.y > 8 && camera.eye.y < 20);
    lam_scene_free(scene);
}

// The corners of the field of view are the corners of the picture, with and without perspective.
TEST(points_of_eye_space_have_a_place)
{
    lam_camera camera = lam_camera_default();
    const double half = 3 * tan(camera.fovy_rad / 2);
    double x = -1, y = -1;
    assert_true(lam_camera_project(&camera, 300, 200, (lam_vec3){1.5 * half, half, -3}, &x, &y));
    assert_true(fabs(x - 300) < 1e-9 && fabs(y) < 1e-9);
    assert_true(lam_camera_project(&camera, 300, 200, (lam_vec3){-0.75 * half, 0, -3}, &x, &y));
    assert_true(fabs(x - 75) < 1e-9 && fabs(y - 100) < 1e-9);
    x = y = -1;
    assert_false(lam_camera_project(&camera, 300, 200, (lam_vec3){0, 0, 0}, &x, &y));
    assert_false(lam_camera_project(&camera, 300, 200, (lam_vec3){1, 1, 2}, &x, &y));
    assert_true(x == -1 && y == -1);
    camera.ortho_half_height = 2;
    assert_true(lam_camera_project(&camera, 300, 200, (lam_vec3){3, -2, 7}, &x, &y));
    assert_true(x == 300 && y == 200);
}
