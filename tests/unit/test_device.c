// test_device.c: the common interface of devices: arguments, control, sharing, memory, and the caller's floating-point
// state.
#include "test.h"
#include "scenes.h"

#include "float_state.h"
#include "pool.h"

#include <lambent/settings.h>

#include <pthread.h>

static struct demo make_demo(const char *name)
{
    struct demo demo;
    lam_error error = {0};
    SUCCEEDS(demo_build_named(name, &demo, &error));
    return demo;
}

static lam_device *make_device(int threads)
{
    lam_error error = {0};
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = threads}, &error);
    SUCCEEDS(device);
    return device;
}

static lam_image make_image(int width, int height)
{
    lam_image image = {0};
    assert_true(lam_image_make(&image, width, height, LAM_RGBA8, NULL));
    return image;
}

// Without a given number of samples, the picture's size determines it, for any shape.
TEST(test_default_samples)
{
    static const struct {
        int width, height, samples;
    } cases[] = {{512, 512, 8}, {513, 512, 4},     {512, 513, 4},  {2048, 128, 8}, {2048, 129, 4},
                 {1, 1, 16},    {65535, 65535, 4}, {256, 256, 16}, {257, 256, 8}};
    struct demo demo = make_demo("sphere-phong");
    AUTO_DEVICE device = make_device(1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int width = cases[i].width, height = cases[i].height;
        assert_int_equal(lam_default_samples(width, height), cases[i].samples);
        if (width > 4096)
            continue;
        lam_image images[2] = {make_image(width, height), make_image(width, height)};
        for (int given = 0; given < 2; given++) {
            lam_draw_params params = {.samples = given ? cases[i].samples : 0};
            assert_true(lam_draw(device, demo.scene, &demo.camera, &params, &images[given], NULL, NULL));
        }
        assert_memory_equal(images[0].pixels, images[1].pixels, (size_t)width * (size_t)height * 4);
        for (int k = 0; k < 2; k++)
            lam_image_free(&images[k]);
    }
    lam_scene_free(demo.scene);
}

TEST(test_arguments)
{
    struct demo demo = make_demo("sphere-phong");
    AUTO_DEVICE device = make_device(1);
    lam_image image = make_image(32, 32), none = {0};
    lam_error error;
    lam_camera camera = demo.camera;
    lam_draw_params params = {0};

    assert_false(lam_draw(NULL, demo.scene, &camera, NULL, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_false(lam_draw(device, NULL, &camera, NULL, &image, NULL, &error));
    assert_false(lam_draw(device, demo.scene, NULL, NULL, &image, NULL, &error));
    assert_false(lam_draw(device, demo.scene, &camera, NULL, &none, NULL, &error));
    assert_non_null(strstr(error.text, "no pixels"));
    assert_false(lam_draw(device, demo.scene, &camera, NULL, &image, NULL, NULL) && false);

    params.samples = 3;
    assert_false(lam_draw(device, demo.scene, &camera, &params, &image, NULL, &error));
    assert_non_null(strstr(error.text, "samples is 3"));
    params = (lam_draw_params){.background = {NAN, 0, 0, 1}};
    assert_false(lam_draw(device, demo.scene, &camera, &params, &image, NULL, &error));
    camera.fovy_rad = 4;
    assert_false(lam_draw(device, demo.scene, &camera, NULL, &image, NULL, &error));
    assert_non_null(strstr(error.text, "fovy"));
    camera = demo.camera;
    camera.target = camera.eye;
    assert_false(lam_draw(device, demo.scene, &camera, NULL, &image, NULL, &error));
    camera = demo.camera;
    camera.near_plane = 2;
    camera.far_plane = 1;
    assert_false(lam_draw(device, demo.scene, &camera, NULL, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);

    assert_null(lam_device_cpu(&(lam_cpu_params){.threads = -1}, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_isa foreign = lam_isa_usable(LAM_ISA_NEON) ? LAM_ISA_AVX2 : LAM_ISA_NEON;
    assert_null(lam_device_cpu(&(lam_cpu_params){.isa = foreign}, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    lam_device_free(NULL);
    lam_image_free(&image);
    lam_scene_free(demo.scene);
}

TEST(test_cancel_and_limits)
{
    struct demo demo = make_demo("teapot");
    AUTO_DEVICE device = make_device(2);
    AUTO_IMAGE image = make_image(256, 256);
    lam_error error;
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    lam_control control = {.cancel = &cancel};
    assert_false(lam_draw(device, demo.scene, &demo.camera, NULL, &image, &control, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    lam_cancel_clear(&cancel);
    assert_true(lam_draw(device, demo.scene, &demo.camera, NULL, &image, &control, &error));

    control = (lam_control){.time_limit_s = 1e-9};
    assert_false(lam_draw(device, demo.scene, &demo.camera, NULL, &image, &control, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    assert_non_null(strstr(error.text, "time limit"));

    AUTO_DEVICE fresh = make_device(1);
    control = (lam_control){.memory_limit_bytes = 100000};
    assert_false(lam_draw(fresh, demo.scene, &demo.camera, NULL, &image, &control, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    assert_non_null(strstr(error.text, "memory limit"));
    control.memory_limit_bytes = 64000000;
    assert_true(lam_draw(fresh, demo.scene, &demo.camera, NULL, &image, &control, &error));
    lam_scene_free(demo.scene);
}

struct progress_seen {
    double last;
    int calls;
    bool backwards;
};

static void see_progress(void *user, double share, const char *step)
{
    struct progress_seen *seen = user;
    seen->backwards |= share < seen->last || share > 1 || !step;
    seen->last = share;
    seen->calls++;
}

TEST(test_progress)
{
    struct demo demo = make_demo("teapot");
    lam_device *device =
        make_device(1); // reports come from the calling thread: with others it may draw few tiles itself
    AUTO_IMAGE image = make_image(512, 512);
    struct progress_seen seen = {0};
    lam_control control = {.progress = see_progress, .user = &seen};
    assert_true(lam_draw(device, demo.scene, &demo.camera, NULL, &image, &control, NULL));
    assert_true(seen.calls > 2);
    assert_false(seen.backwards);
    assert_true(seen.last == 1);
    lam_device_free(device);
    lam_scene_free(demo.scene);
}

// After the first frame, drawing the same kind of frame allocates nothing.
TEST(test_memory_settles)
{
    struct demo demo = make_demo("ground"); // including clipped pieces
    AUTO_DEVICE device = make_device(1);
    AUTO_IMAGE image = make_image(300, 200);
    lam_frame_report first, second;
    assert_true(lam_draw(device, demo.scene, &demo.camera, NULL, &image, NULL, NULL));
    lam_device_report(device, &first);
    assert_true(lam_draw(device, demo.scene, &demo.camera, NULL, &image, NULL, NULL));
    lam_device_report(device, &second);
    assert_true(first.memory_bytes > 0);
    assert_int_equal(first.memory_bytes, second.memory_bytes);
    assert_int_equal(first.triangles, lam_scene_triangle_count(demo.scene));
    assert_true(first.pixels_covered > 0 && first.points_lit >= first.pixels_covered);
    lam_scene_free(demo.scene);
}

// A host that rounds upwards and flushes denormals gets the same bytes, and its state is restored.
TEST(test_float_state)
{
#if defined(__SSE2__)
    struct demo demo = make_demo("lights");
    AUTO_DEVICE device = make_device(2);
    lam_image before = make_image(160, 120), after = make_image(160, 120);
    assert_true(lam_draw(device, demo.scene, &demo.camera, NULL, &before, NULL, NULL));
    unsigned own = _mm_getcsr();
    unsigned odd = (own | 0x8040) & ~0x6000u;
    odd |= 0x4000; // flush to zero, denormals are zero, round up
    _mm_setcsr(odd);
    struct demo again;
    bool built = demo_build_named("lights", &again, NULL);
    AUTO_DEVICE made_here = lam_device_cpu(&(lam_cpu_params){.threads = 2}, NULL); // its threads inherit the state
    bool drawn = built && made_here && lam_draw(made_here, again.scene, &again.camera, NULL, &after, NULL, NULL);
    unsigned left = _mm_getcsr();
    _mm_setcsr(own);
    assert_true(drawn);
    assert_int_equal(left & ~0x3fu, odd & ~0x3fu);
    assert_memory_equal(before.pixels, after.pixels, 160 * 120 * 4);
    lam_image_free(&before);
    lam_image_free(&after);
    lam_scene_free(again.scene);
    lam_scene_free(demo.scene);
#else
    skip();
#endif
}

// Several threads, each with its own device, share one scene.
struct sharing {
    const struct demo *demo;
    lam_image image;
    bool ok;
};

static void *share_scene(void *argument)
{
    struct sharing *sharing = argument;
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = 2}, NULL);
    sharing->ok = device != NULL;
    for (int i = 0; i < 3 && sharing->ok; i++)
        sharing->ok = lam_draw(device, sharing->demo->scene, &sharing->demo->camera, &sharing->demo->params,
                               &sharing->image, NULL, NULL);
    lam_device_free(device);
    return NULL;
}

TEST(test_shared_scene)
{
    struct demo demo = make_demo("knot-blinn-phong");
    enum { THREADS = 4 };
    struct sharing sharing[THREADS];
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++) {
        sharing[i] = (struct sharing){&demo, make_image(96, 96), false};
        assert_int_equal(pthread_create(&threads[i], NULL, share_scene, &sharing[i]), 0);
    }
    for (int i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
    for (int i = 0; i < THREADS; i++) {
        assert_true(sharing[i].ok);
        assert_memory_equal(sharing[0].image.pixels, sharing[i].image.pixels, 96 * 96 * 4);
    }
    for (int i = 0; i < THREADS; i++)
        lam_image_free(&sharing[i].image);
    lam_scene_free(demo.scene);
}

TEST(test_null_device)
{
    struct demo demo = make_demo("sphere-flat");
    AUTO_DEVICE device = lam_device_null(NULL);
    AUTO_IMAGE image = make_image(16, 16);
    memset(image.pixels, 7, 16 * 16 * 4);
    assert_string_equal(lam_device_name(device), "null");
    assert_true(lam_draw(device, demo.scene, &demo.camera, NULL, &image, NULL, NULL));
    assert_int_equal(((uint8_t *)image.pixels)[0], 0);
    lam_frame_report report;
    lam_device_report(device, &report);
    assert_int_equal(report.triangles, lam_scene_triangle_count(demo.scene));
    lam_scene_free(demo.scene);
}

// The fitted camera: the projected vertices take 92 % of the tighter side and are centred.
TEST(test_fit)
{
    static const char *const names[] = {"teapot", "cone", "stretched"};
    for (int n = 0; n < 3; n++)
        for (int wide = 0; wide < 2; wide++) {
            struct demo demo = make_demo(names[n]);
            int width = wide ? 1000 : 400, height = wide ? 400 : 1000;
            lam_camera camera = lam_camera_fit(demo.scene, width, height, NULL);
            AUTO_DEVICE device = make_device(2);
            AUTO_IMAGE image = make_image(width, height);
            assert_true(lam_draw(device, demo.scene, &camera, NULL, &image, NULL, NULL));
            int left = width, right = -1, top = height, bottom = -1;
            for (int y = 0; y < height; y++)
                for (int x = 0; x < width; x++)
                    if (((uint8_t *)image.pixels)[4 * (y * width + x) + 3]) {
                        left = x < left ? x : left;
                        right = x > right ? x : right;
                        top = y < top ? y : top;
                        bottom = y;
                    }
            double across = (double)(right + 1 - left) / width, down = (double)(bottom + 1 - top) / height;
            assert_true(fabs((across > down ? across : down) - 0.92) < 0.006);
            assert_true(abs(left - (width - 1 - right)) <= 3);
            assert_true(abs(top - (height - 1 - bottom)) <= 3);
            lam_scene_free(demo.scene);
        }
}

// A bumpy sheet with a fold, without normals, as OBJ.
static lam_scene *load_sheet(bool when_drawn, lam_normals normals, bool clear)
{
    enum { SIDE = 60 };
    static char text[SIDE * SIDE * 80];
    size_t used = 0;
    for (int j = 0; j <= SIDE; j++)
        for (int i = 0; i <= SIDE; i++)
            used += (size_t)snprintf(text + used, sizeof text - used, "v %d.%02d %d %d\n", i / 10, i % 10 * 7 % 100,
                                     (i * i * 7 + j * 3) % 5 + (j > 30 ? 3 * j - 90 : 0), j);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            int a = j * (SIDE + 1) + i + 1;
            used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d %d\n", a, a + SIDE + 1, a + SIDE + 2,
                                     a + 1);
        }
    lam_error error = {0};
    lam_scene *scene = lam_scene_load_memory(
        text, used, "sheet.obj",
        &(lam_load_params){.normals_when_drawn = when_drawn, .normals = normals, .crease_angle_rad = 0.6}, NULL,
        &error);
    SUCCEEDS(scene);
    assert_int_equal(lam_scene_mesh(scene, 0)->normals == NULL, when_drawn);
    // Twice; the second one is mirrored, and made of glass on request.
    lam_object object = *lam_scene_object(scene, 0);
    object.transform.m[0][0] = -1.5;
    lam_material glass = lam_material_default();
    glass.diffuse.a = 0.4f;
    object.material = lam_scene_add_material(scene, &glass, &error);
    if (!clear)
        object.material = -1;
    assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
    return scene;
}

// Normals computed while drawing give the same bytes as normals computed before, for any drawing.
TEST(test_normals_when_drawn)
{
    for (int all = 0; all < 2 * 2 * 3 * 2 * 3; all++) {
        const int i = all / 2;
        const lam_normals normals = all % 2 ? LAM_NORMALS_FACET : LAM_NORMALS_FILE;
        bool clear = i % 2;
        lam_draw_params params = {.shading = (lam_shading)(i / 2 % 3), .samples = i / 6 % 2 ? 4 : 1};
        params.flat_normal = i / 6 % 2 ? LAM_FLAT_NORMAL_VERTEX : LAM_FLAT_NORMAL_FACE;
        params.output = i / 12 == 0 ? LAM_OUTPUT_PICTURE : i / 12 == 1 ? LAM_OUTPUT_NORMALS : LAM_OUTPUT_DEPTH;
        lam_image images[3];
        lam_scene *scenes[2] = {load_sheet(false, normals, clear), load_sheet(true, normals, clear)};
        lam_camera camera = lam_camera_fit(scenes[0], 1, 1, NULL);
        camera.fovy_rad *= 0.6; // some triangles are outside, some cross the edge
        lam_device *device = make_device(2);
        for (int k = 0; k < 3; k++) { // twice with the same device
            images[k] = make_image(200, 150);
            lam_error error = {0};
            SUCCEEDS(lam_draw(device, scenes[k > 0], &camera, &params, &images[k], NULL, &error));
            assert_memory_equal(images[k].pixels, images[0].pixels, 200 * 150 * 4);
        }
        lam_frame_report report;
        lam_device_report(device, &report);
        bool asked = params.shading != LAM_SHADING_FLAT || params.flat_normal == LAM_FLAT_NORMAL_VERTEX || i >= 12;
        if (normals == LAM_NORMALS_FACET && params.shading == LAM_SHADING_PHONG)
            asked = false; // each normal is computed where its triangle is shaded
        assert_true((report.normals_ms > 0) == asked);
        // If they are computed later, they belong to the scene, and the picture does not change.
        assert_true(lam_scene_make_normals(scenes[1], LAM_NORMALS_FILE, 0, 1, NULL, NULL));
        const lam_mesh *made = lam_scene_mesh(scenes[1], 0), *first = lam_scene_mesh(scenes[0], 0);
        assert_int_equal(made->normal_count, first->normal_count);
        assert_memory_equal(made->normals, first->normals, made->normal_count * 12);
        assert_true(lam_draw(device, scenes[1], &camera, &params, &images[1], NULL, NULL));
        assert_memory_equal(images[1].pixels, images[0].pixels, 200 * 150 * 4);
        // A memory limit that is too small ends the call.
        lam_scene *again = load_sheet(true, normals, clear);
        lam_error error = {0};
        lam_device *fresh = make_device(2);
        assert_false(
            lam_draw(fresh, again, &camera, &params, &images[1], &(lam_control){.memory_limit_bytes = 100000}, &error));
        assert_int_equal(error.code, LAM_LIMIT);
        lam_device_free(fresh);
        lam_device_free(device);
        lam_scene_free(again);
        for (int k = 0; k < 3; k++)
            lam_image_free(&images[k]);
        for (int k = 0; k < 2; k++)
            lam_scene_free(scenes[k]);
    }
}

// A number outside the range of its row in the table of settings causes an error that names the member.
TEST(test_ranges_of_settings)
{
    struct demo demo = make_demo("sphere-phong");
    AUTO_DEVICE device = make_device(1);
    AUTO_IMAGE image = make_image(8, 8);
    const lam_setting *s;
    int checked = 0;
    for (int i = 0; (s = lam_draw_setting(i)); i++) {
        lam_draw_params params = {0};
        char *member = (char *)&params + s->offset;
        switch (s->type) {
        case LAM_SETTING_WORD:
        case LAM_SETTING_WORDS:
            *(int *)member = 99;
            break;
        case LAM_SETTING_WHOLE:
            *(int *)member = (int)s->max + 1;
            break;
        case LAM_SETTING_NUMBER:
        case LAM_SETTING_ANGLE:
            *(float *)member = (float)(2 * s->max);
            break;
        case LAM_SETTING_RGB:
        case LAM_SETTING_RGBA:
            ((float *)member)[2] = -1;
            break;
        case LAM_SETTING_FLAG:
        case LAM_SETTING_NOT_FLAG:
            continue;
        }
        lam_error error = {0};
        if (lam_draw(device, demo.scene, &demo.camera, &params, &image, NULL, &error) ||
            error.code != LAM_BAD_ARGUMENT || !strstr(error.text, s->type == LAM_SETTING_ANGLE ? s->key : s->member))
            fail_msg("%s: '%s'", s->key, error.text);
        checked++;
    }
    assert_true(checked > 20);
    lam_scene_free(demo.scene);
}
