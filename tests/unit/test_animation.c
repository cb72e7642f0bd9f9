// test_animation.c: the interface of animations, and scenes that are reset to a marked state.
// tests/cli/test_animation.py decodes the files and tests their contents.

#include "test.h"

static void fill(lam_image *image, uint8_t r, uint8_t g, uint8_t b, uint8_t a)
{
    uint8_t *pixel = image->pixels;
    for (int i = 0; i < image->width * image->height; i++, pixel += 4)
        memcpy(pixel, (uint8_t[4]){r, g, b, a}, 4);
}

static lam_animation *make(const char *format, const lam_animation_params *params)
{
    lam_error error;
    lam_animation *animation = lam_animation_make(format, 30, 20, params, &error);
    SUCCEEDS(animation);
    return animation;
}

TEST(test_formats)
{
    assert_string_equal(lam_animation_format("a/b.PNG"), "png");
    assert_string_equal(lam_animation_format("b.webp"), "webp");
    assert_string_equal(lam_animation_format("b.gif"), "gif");
    assert_null(lam_animation_format("b.jpg"));
    assert_null(lam_animation_format("png"));
    assert_null(lam_animation_format(NULL));
    lam_error error;
    assert_null(lam_animation_make("jpg", 10, 10, NULL, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    assert_string_equal(error.text, "animation: 'jpg' is not a format for animations, expected png, webp or gif");
}

TEST(test_arguments)
{
    lam_error error;
    const lam_animation_params wrong[] = {{.frames_per_second = 0.05},
                                          {.frames_per_second = 241},
                                          {.frames_per_second = NAN},
                                          {.loops = -1},
                                          {.loops = 65536},
                                          {.reserved = {1}}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_null(lam_animation_make("png", 10, 10, &wrong[i], &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    }
    const lam_save_params quality = {.quality = 101};
    assert_null(lam_animation_make("png", 10, 10, &(lam_animation_params){.frames = &quality}, &error));
    assert_null(lam_animation_make("png", 0, 10, NULL, &error));
    assert_null(lam_animation_make(NULL, 10, 10, NULL, &error));

    lam_animation *animation = make("png", NULL);
    lam_bytes bytes;
    lam_image image, floats;
    assert_false(lam_animation_finish(animation, NULL, &bytes, &error)); // no frame
    assert_true(lam_image_make(&image, 29, 20, LAM_RGBA8, &error));
    fill(&image, 1, 2, 3, 4);
    assert_false(lam_animation_add(animation, &image, NULL, &error));
    assert_string_equal(error.text, "frame: 29x20 pixels, the animation has 30x20");
    assert_true(lam_image_make(&floats, 30, 20, LAM_RGBA32F, &error));
    assert_false(lam_animation_add(animation, &floats, NULL, &error));
    assert_false(lam_animation_add(NULL, &image, NULL, &error));
    lam_image_free(&image);
    lam_image_free(&floats);
    lam_animation_free(animation);
    lam_animation_free(NULL);
}

// Frames of every 8-bit format, and the end.
TEST(test_frames)
{
    lam_error error;
    lam_animation *animation = make("png", &(lam_animation_params){.loops = 3});
    static const lam_pixel_format formats[] = {LAM_RGBA8, LAM_BGRA8, LAM_RGB8, LAM_GREY8};
    for (size_t i = 0; i < 4; i++) {
        AUTO_IMAGE image = {0};
        assert_true(lam_image_make(&image, 30, 20, formats[i], &error));
        memset(image.pixels, (int)(40 * i), i < 2 ? 2400 : i == 2 ? 1800 : 600);
        assert_true(lam_animation_add(animation, &image, NULL, &error));
    }
    lam_bytes bytes;
    assert_true(lam_animation_finish(animation, NULL, &bytes, &error));
    assert_true(bytes.size > 8 && memcmp(bytes.data, "\x89PNG", 4) == 0);
    lam_bytes_free(&bytes);
    assert_false(lam_animation_finish(animation, NULL, &bytes, &error));
    assert_string_equal(error.text, "animation: it is finished");
    lam_animation_free(animation);
}

// Readers of still pictures see the first frame of the file, even if later frames have more channels.
TEST(test_first_frame)
{
    lam_error error;
    lam_image image, back;
    AUTO_BYTES bytes = {0};
    char path[64];
    lam_animation *animation = make("png", NULL);
    assert_true(lam_image_make(&image, 30, 20, LAM_RGBA8, &error));
    fill(&image, 90, 90, 90, 255);
    ((uint8_t *)image.pixels)[0] = ((uint8_t *)image.pixels)[1] = ((uint8_t *)image.pixels)[2] = 7;
    assert_true(lam_animation_add(animation, &image, NULL, &error));
    AUTO_IMAGE first = image;
    assert_true(lam_image_make(&image, 30, 20, LAM_RGBA8, &error));
    fill(&image, 200, 10, 90, 100);
    assert_true(lam_animation_add(animation, &image, NULL, &error));
    assert_true(lam_animation_finish(animation, NULL, &bytes, &error));
    snprintf(path, sizeof path, "test-animation-%d.png", (int)getpid());
    assert_true(lam_bytes_save(&bytes, path, &error));
    assert_true(lam_image_load(&back, path, NULL, &error));
    assert_true(lam_image_is_from_lambent(path));
    unlink(path);
    assert_memory_equal(back.pixels, first.pixels, 2400);
    lam_image_free(&back);
    lam_image_free(&image);
    lam_animation_free(animation);
}

TEST(test_cancelled)
{
    lam_error error;
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    AUTO_IMAGE image = {0};
    lam_bytes bytes;
    assert_true(lam_image_make(&image, 30, 20, LAM_RGBA8, &error));
    fill(&image, 1, 2, 3, 4);
    for (int i = 0; i < 2; i++) {
        lam_animation *animation = lam_animation_make(i ? "webp" : "png", 30, 20, NULL, &error);
        if (!animation) // no libwebpmux
            continue;
        assert_false(lam_animation_add(animation, &image, &(lam_control){.cancel = &cancel}, &error));
        assert_int_equal(error.code, LAM_CANCELLED);
        assert_false(lam_animation_add(animation, &image, NULL, &error));
        assert_false(lam_animation_finish(animation, NULL, &bytes, &error));
        lam_animation_free(animation);
    }
}

// Pixels that no compression makes smaller.
static void fill_noise(lam_image *image, uint32_t *seed)
{
    uint8_t *bytes = image->pixels;
    for (int i = 0; i < 4 * image->width * image->height; i++)
        bytes[i] = (uint8_t)((*seed = *seed * 1664525u + 1013904223u) >> 24);
}

// Encoded frames count: a PNG of n frames is refused if they, or they and the file, exceed the limit.
TEST(test_memory)
{
    enum { LIMIT = 50000, FRAME = 30 * 20 * 4 };
    const lam_control control = {.memory_limit_bytes = LIMIT};
    lam_error error;
    AUTO_IMAGE image = {0};
    lam_bytes bytes;
    uint32_t seed = 1;
    assert_true(lam_image_make(&image, 30, 20, LAM_RGBA8, &error));
    lam_animation *animation = make("png", NULL);
    int frames = 0;
    for (fill_noise(&image, &seed); lam_animation_add(animation, &image, &control, &error); fill_noise(&image, &seed))
        assert_true(++frames < 100);
    assert_int_equal(error.code, LAM_LIMIT);
    assert_non_null(strstr(error.text, "memory limit"));
    assert_in_range(frames, 10, LIMIT / FRAME);
    assert_false(lam_animation_finish(animation, NULL, &bytes, &error)); // it cannot be used any more
    lam_animation_free(animation);
    for (int fits = 0; fits < 2; fits++) { // the frames are below the limit, and the frames and their file exceed it
        animation = make("png", NULL);
        for (int i = 0; i < (fits ? 7 : 12); i++, fill_noise(&image, &seed))
            assert_true(lam_animation_add(animation, &image, &control, &error));
        assert_int_equal(lam_animation_finish(animation, &control, &bytes, &error), fits);
        if (fits)
            lam_bytes_free(&bytes);
        else
            assert_int_equal(error.code, LAM_LIMIT);
        lam_animation_free(animation);
    }
}

// For a WebP, the encoder's canvases count, and the memory for encoding a frame.
TEST(test_memory_webp)
{
    enum { CANVASES = 3 * 4 * 30 * 20, NEXT = 12 * 30 * 20 };
    lam_error error;
    AUTO_IMAGE image = {0};
    uint32_t seed = 1;
    assert_true(lam_image_make(&image, 30, 20, LAM_RGBA8, &error));
    fill_noise(&image, &seed);
    for (int fits = 0; fits < 2; fits++) {
        lam_animation *animation = lam_animation_make("webp", 30, 20, NULL, &error);
        if (!animation) // no libwebpmux
            break;
        const lam_control control = {.memory_limit_bytes = CANVASES + NEXT - !fits};
        assert_int_equal(lam_animation_add(animation, &image, &control, &error), fits);
        if (!fits)
            assert_int_equal(error.code, LAM_LIMIT);
        lam_animation_free(animation);
    }
}

static void draw(const lam_scene *scene, lam_device *device, lam_image *image)
{
    lam_error error;
    lam_camera camera = lam_camera_default();
    SUCCEEDS(lam_draw(device, scene, &camera, NULL, image, NULL, &error));
}

// A reset restores the picture after any change.
TEST(test_reset)
{
    lam_error error;
    AUTO_SCENE scene = lam_scene_make(&error);
    assert_false(lam_scene_reset(scene, &error)); // nothing is marked
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_false(lam_scene_mark(NULL, &error));
    lam_material red = lam_material_default(), blue = red;
    red.diffuse = (lam_rgba){1, 0, 0, 1};
    blue.diffuse = (lam_rgba){0, 0, 1, 1};
    lam_object object = lam_object_default();
    assert_int_equal(lam_scene_add_shape(scene, "cube", NULL, &error), 0);
    assert_int_equal(lam_scene_add_material(scene, &red, &error), 0);
    assert_int_equal(lam_scene_add_object(scene, &object, &error), 0);
    const lam_part *parts = lam_scene_mesh(scene, 0)->parts;
    uint32_t part_count = lam_scene_mesh(scene, 0)->part_count;
    lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    assert_int_equal(lam_scene_add_light(scene, &light, &error), 0);
    lam_image before, after;
    assert_true(lam_image_make(&before, 64, 64, LAM_RGBA8, &error) &&
                lam_image_make(&after, 64, 64, LAM_RGBA8, &error));
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    draw(scene, device, &before);
    assert_true(lam_scene_mark(scene, &error));
    for (int i = 0; i < 3; i++) {
        assert_true(lam_scene_rotate(scene, (lam_vec3){0, 0, 0}, (lam_vec3){0, 1, 0}, 0.5, &error));
        int material = lam_scene_add_material(scene, &blue, &error);
        assert_true(lam_scene_set_material(scene, 0, &blue, &error));
        for (uint32_t k = 0; k < part_count; k++)
            assert_true(lam_scene_set_part_material(scene, 0, k, material, &error));
        object.material = material;
        object.mesh = lam_scene_add_shape(scene, "sphere", NULL, &error);
        assert_true(object.mesh == 1 && lam_scene_add_object(scene, &object, &error) == 1);
        for (int k = 0; k < 20; k++) // the list of lights moves
            assert_true(lam_scene_add_light(scene, &light, &error) >= 0);
        assert_true(lam_scene_set_default_material(scene, &blue, &error));
        lam_scene_set_ambient(scene, (lam_rgb){0.3f, 0.3f, 0.3f});
        lam_scene_set_up(scene, LAM_UP_Z);
        draw(scene, device, &after);
        assert_memory_not_equal(before.pixels, after.pixels, 4 * 64 * 64);
        assert_true(lam_scene_reset(scene, &error));
        draw(scene, device, &after);
        assert_memory_equal(before.pixels, after.pixels, 4 * 64 * 64);
        assert_int_equal(lam_scene_light_count(scene), 1);
        assert_int_equal(lam_scene_mesh_count(scene), 1);
        assert_int_equal(lam_scene_object_count(scene), 1);
        assert_int_equal(lam_scene_material_count(scene), 1);
        assert_int_equal(lam_scene_up(scene), LAM_UP_Y);
        assert_ptr_equal(lam_scene_mesh(scene, 0)->parts, parts);
    }
    lam_image_free(&before);
    lam_image_free(&after);
}

TEST(test_warnings_once)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_scene_add_warning(scene, "one");
    lam_scene_add_warning(scene, "two");
    lam_scene_add_warning(scene, "one");
    assert_string_equal(lam_scene_warning(scene, 1), "two");
    assert_null(lam_scene_warning(scene, 2));
}

TEST(test_rotation)
{
    // A quarter turn about the diagonal of y and z maps x to its cross product with it.
    lam_mat4 m = lam_mat4_rotation((lam_vec3){0, 3, 3}, 1.57079632679489661923);
    const double expected[3] = {0, sqrt(0.5), -sqrt(0.5)};
    for (int i = 0; i < 3; i++)
        assert_true(fabs(m.m[i][0] - expected[i]) < 1e-15);
    assert_true(m.m[3][3] == 1 && m.m[0][3] == 0 && m.m[3][0] == 0);
}
