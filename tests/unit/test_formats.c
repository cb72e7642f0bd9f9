// test_formats.c: pictures of every format and stride: drawn, encoded, compared, captioned; and the caller's own
// memory.
#include "test.h"
#include "share.h"

enum { WIDTH = 150, HEIGHT = 90, PAD = 12, GUARD = 0xA5 };

static const lam_pixel_format formats[] = {LAM_RGBA8, LAM_RGBA32F, LAM_BGRA8, LAM_RGB8, LAM_GREY8, LAM_RGB32F};
static const size_t bytes_of[] = {
    [LAM_RGBA8] = 4, [LAM_RGBA32F] = 16, [LAM_BGRA8] = 4, [LAM_RGB8] = 3, [LAM_GREY8] = 1, [LAM_RGB32F] = 12};

// The caller's memory: rows with padding at their ends, bottom row first with `upside_down`.
struct window {
    unsigned char *memory;
    size_t pitch;
    lam_image image;
};

static struct window open_window(lam_pixel_format format, bool upside_down)
{
    struct window w = {.pitch = (WIDTH * bytes_of[format] + PAD + 3) / 4 * 4};
    w.memory = malloc(w.pitch * HEIGHT);
    assert_non_null(w.memory);
    memset(w.memory, GUARD, w.pitch * HEIGHT);
    w.image = (lam_image){.width = WIDTH,
                          .height = HEIGHT,
                          .format = format,
                          .pixels = upside_down ? w.memory + (HEIGHT - 1) * w.pitch : w.memory,
                          .stride = upside_down ? -(ptrdiff_t)w.pitch : (ptrdiff_t)w.pitch};
    return w;
}

static void close_window(struct window *w)
{
    for (size_t y = 0; y < HEIGHT; y++)
        for (size_t x = WIDTH * bytes_of[w->image.format]; x < w->pitch; x++)
            assert_int_equal(w->memory[y * w->pitch + x], GUARD); // memory after a row belongs to the caller
    unsigned char *memory = w->memory;
    lam_image_free(&w->image);
    assert_null(w->image.pixels);
    memory[0] = 0; // not freed, which the sanitizer would report
    free(memory);
}

static const void *pixel_of(const lam_image *image, int x, int y)
{
    size_t bytes = bytes_of[image->format];
    ptrdiff_t stride = image->stride ? image->stride : (ptrdiff_t)((size_t)image->width * bytes);
    return (const char *)image->pixels + y * stride + (ptrdiff_t)((size_t)x * bytes);
}

static double linear_of(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

static double encoded_of(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

// The luminance of a pixel by the formula in image.h, before rounding.
static double grey_of(const unsigned char rgb[3], bool raw)
{
    static const double weight[3] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += weight[c] * (raw ? rgb[c] / 255.0 : linear_of(rgb[c] / 255.0));
    return 255 * (raw ? sum : encoded_of(sum));
}

static void expect_pixels(const struct window *w, const lam_image *bytes, const lam_image *floats,
                          const lam_image *opaque_bytes, const lam_image *opaque_floats, bool raw)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const unsigned char *got = pixel_of(&w->image, x, y), *rgba = pixel_of(bytes, x, y);
            const unsigned char *opaque = pixel_of(opaque_bytes, x, y);
            switch (w->image.format) {
            case LAM_RGBA8:
                assert_memory_equal(got, rgba, 4);
                break;
            case LAM_RGBA32F:
                assert_memory_equal(got, pixel_of(floats, x, y), 16);
                break;
            case LAM_BGRA8:
                assert_memory_equal(got, ((const unsigned char[]){rgba[2], rgba[1], rgba[0], rgba[3]}), 4);
                break;
            case LAM_RGB8:
                assert_memory_equal(got, opaque, 3);
                break;
            case LAM_GREY8:
                if (!(fabs(*got - grey_of(opaque, raw)) <= 0.501))
                    fail_msg("grey %d, expected %g", *got, grey_of(opaque, raw));
                if (opaque[0] == opaque[1] && opaque[1] == opaque[2])
                    assert_int_equal(*got, opaque[0]);
                break;
            case LAM_RGB32F:
                assert_memory_equal(got, pixel_of(opaque_floats, x, y), 12);
                break;
            }
        }
}

static void draw(lam_device *device, const lam_scene *scene, lam_draw_params params, bool opaque, lam_image *image)
{
    if (opaque) { // a background over black
        lam_rgba *b = &params.background;
        *b = (lam_rgba){b->r * b->a, b->g * b->a, b->b * b->a, 1};
    }
    lam_camera camera = lam_camera_fit(scene, WIDTH, HEIGHT, NULL);
    lam_error error = {0};
    SUCCEEDS(lam_draw(device, scene, &camera, &params, image, NULL, &error));
}

static lam_scene *make_scene(void)
{
    lam_scene *scene = lam_scene_make(NULL);
    lam_material material = lam_material_named(LAM_MATERIAL_COPPER, LAM_COLOR_SRGB);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "torus-knot", NULL, NULL);
    object.material = lam_scene_add_material(scene, &material, NULL);
    assert_true(lam_scene_add_object(scene, &object, NULL) >= 0);
    return scene;
}

// Draws one of `share` cases: the cases whose number plus `first` is a multiple of it.
static void draw_all(lam_device *device, size_t first, size_t share)
{
    static const struct {
        lam_output show;
        lam_color_mode color;
        lam_rgba background;
    } cases[] = {
        {LAM_OUTPUT_PICTURE, LAM_COLOR_SRGB, {0, 0, 0, 0}},
        {LAM_OUTPUT_PICTURE, LAM_COLOR_SRGB, {0.2f, 0.5f, 0.9f, 0.5f}},
        {LAM_OUTPUT_PICTURE, LAM_COLOR_RAW, {0.9f, 0.3f, 0.1f, 1}},
        {LAM_OUTPUT_NORMALS, LAM_COLOR_SRGB, {0, 0, 0, 0}},
        {LAM_OUTPUT_COVERAGE, LAM_COLOR_SRGB, {0, 0, 0, 0}},
        {LAM_OUTPUT_CLIPPED, LAM_COLOR_SRGB, {0, 0, 0, 0}},
    };
    AUTO_SCENE scene = make_scene();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!is_taken(first + i, share))
            continue;
        lam_draw_params params = {.output = cases[i].show, .color = cases[i].color, .background = cases[i].background};
        lam_image plain[4] = {0}; // RGBA8 and RGBA32F, as requested and over black
        for (int k = 0; k < 4; k++) {
            assert_true(lam_image_make(&plain[k], WIDTH, HEIGHT, k % 2 ? LAM_RGBA32F : LAM_RGBA8, NULL));
            draw(device, scene, params, k >= 2, &plain[k]);
        }
        bool raw = params.color == LAM_COLOR_RAW || !lam_output_is_light(params.output);
        for (int k = 0; k < 12; k++) {
            struct window w = open_window(formats[k / 2], k % 2);
            draw(device, scene, params, false, &w.image);
            expect_pixels(&w, &plain[0], &plain[1], &plain[2], &plain[3], raw);
            close_window(&w);
        }
        for (int k = 0; k < 4; k++)
            lam_image_free(&plain[k]);
    }
    lam_device_free(device);
}

TEST(draws_every_format)
{
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++)
        if (lam_isa_usable((lam_isa)isa))
            draw_all(lam_device_cpu(&(lam_cpu_params){.threads = 2, .isa = (lam_isa)isa}, NULL), (size_t)isa, 3);
}

TEST(opengl_draws_every_format)
{
    lam_device *device = lam_device_gl(NULL, NULL);
    if (!device)
        skip();
    draw_all(device, 0, 3);
}

// A picture of noise in a window of each format, and its compact working copy.
static void fill(struct window *w, lam_image *tight)
{
    bool is_float = w->image.format == LAM_RGBA32F || w->image.format == LAM_RGB32F;
    size_t bytes = bytes_of[w->image.format];
    assert_true(lam_image_make(tight, WIDTH, HEIGHT, is_float ? LAM_RGBA32F : LAM_RGBA8, NULL));
    uint32_t noise = 12345;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            unsigned char b[4];
            for (int c = 0; c < 4; c++)
                b[c] = (unsigned char)((noise = noise * 1664525 + 1013904223) >> 24);
            if (w->image.format == LAM_RGB8 || w->image.format == LAM_GREY8)
                b[3] = 255;
            if (w->image.format == LAM_GREY8)
                b[1] = b[2] = b[0];
            const float f[4] = {b[0] / 100.0f, b[1] / 100.0f, b[2] / 100.0f,
                                w->image.format == LAM_RGB32F ? 1 : b[3] / 255.0f};
            const unsigned char bgra[4] = {b[2], b[1], b[0], b[3]};
            void *to = (void *)(uintptr_t)pixel_of(&w->image, x, y);
            memcpy(to, is_float ? (const void *)f : w->image.format == LAM_BGRA8 ? bgra : b, bytes);
            memcpy((void *)(uintptr_t)pixel_of(tight, x, y), is_float ? (const void *)f : b, is_float ? 16 : 4);
        }
}

TEST(every_format_is_taken)
{
    lam_font *font = lam_font_open(NULL, NULL);
    for (int k = 0; k < 12; k++) {
        struct window w = open_window(formats[k / 2], k % 2);
        lam_image tight, apart;
        fill(&w, &tight);
        bool is_float = tight.format == LAM_RGBA32F;
        lam_bytes bytes[2];
        lam_error error = {0};
        SUCCEEDS(lam_image_encode(&w.image, is_float ? "pfm" : "png", NULL, &bytes[0], &error));
        assert_true(lam_image_encode(&tight, is_float ? "pfm" : "png", NULL, &bytes[1], NULL));
        assert_int_equal(bytes[0].size, bytes[1].size);
        assert_memory_equal(bytes[0].data, bytes[1].data, bytes[0].size);
        lam_bytes_free(&bytes[0]);
        lam_bytes_free(&bytes[1]);

        lam_difference difference;
        assert_true(lam_image_compare(&w.image, &tight, &difference, NULL));
        assert_true(difference.maximum == 0);
        assert_true(lam_image_difference(&tight, &w.image, 1, &apart, NULL));
        assert_int_equal(apart.format, tight.format);
        lam_image_free(&apart);

        if (font && w.image.format != LAM_GREY8) { // grey uses the luminance of the letters' colour
            lam_rgba red = {1, 0.25f, 0, 1};
            assert_true(lam_text_draw(&w.image, font, 5, 50, 30, red, "Format", NULL));
            assert_true(lam_image_compare(&w.image, &tight, &difference, NULL));
            assert_true(difference.maximum > 0);
            assert_true(lam_text_draw(&tight, font, 5, 50, 30, red, "Format", NULL));
            assert_true(lam_image_compare(&w.image, &tight, &difference, NULL));
            assert_true(difference.maximum == 0);
        }
        lam_environment *sky = lam_environment_from_image(&w.image, LAM_COLOR_SRGB, &error);
        assert_null(sky); // 150×90 is not a valid environment, in any format
        assert_int_equal(error.code, LAM_UNSUPPORTED);
        lam_image_free(&tight);
        close_window(&w);
    }
    lam_font_free(font);
}

TEST(refuses_pictures_that_cannot_be)
{
    static float memory[64 * 4];
    const lam_image good = {.width = 8, .height = 8, .pixels = memory};
    static const struct {
        int width, height, format;
        ptrdiff_t stride;
        size_t shift;
        const char *says;
    } wrong[] = {
        {0, 8, LAM_RGBA8, 0, 0, "0×8 pixels"},
        {8, 70000, LAM_RGBA8, 0, 0, "8×70000"},
        {8, 8, 6, 0, 0, "pixel format 6"},
        {8, 8, -1, 0, 0, "pixel format -1"},
        {8, 8, LAM_RGBA8, 31, 0, "stride is 31 bytes"},
        {8, 8, LAM_RGB8, -23, 0, "stride is -23 bytes"},
        {4, 4, LAM_RGBA32F, 66, 0, "divisible by 4"},
        {4, 4, LAM_RGB32F, 48, 2, "divisible by 4"},
    };
    AUTO_DEVICE device = lam_device_null(NULL);
    AUTO_SCENE scene = make_scene();
    lam_camera camera = lam_camera_default();
    lam_image ok = good;
    assert_true(lam_draw(device, scene, &camera, NULL, &ok, NULL, NULL));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        lam_image image = good;
        image.width = wrong[i].width;
        image.height = wrong[i].height;
        image.format = (lam_pixel_format)wrong[i].format;
        image.stride = wrong[i].stride;
        image.pixels = (char *)memory + wrong[i].shift;
        lam_error error = {0};
        lam_bytes bytes;
        assert_false(lam_draw(device, scene, &camera, NULL, &image, NULL, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        if (!strstr(error.text, wrong[i].says))
            fail_msg("'%s' does not say '%s'", error.text, wrong[i].says);
        assert_false(lam_image_encode(&image, "png", NULL, &bytes, &error));
        assert_false(lam_image_compare(&image, &image, &(lam_difference){0}, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    }
    lam_error error = {0};
    lam_image made;
    assert_false(lam_image_make(&made, 8, 8, (lam_pixel_format)6, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
}

// --- lam_render

TEST(renders_into_the_callers_memory)
{
    struct window w = open_window(LAM_BGRA8, false);
    lam_render_report report;
    lam_error error = {0};
    SUCCEEDS(lam_render("teapot", NULL, &w.image, &report, &error));
    assert_true(report.frame.pixels_covered > 1000 && report.triangles > 1000 && report.warnings[0] == 0);
    lam_image made = {.width = WIDTH, .height = HEIGHT, .format = LAM_RGBA8};
    assert_true(lam_render("teapot", NULL, &made, NULL, &error));
    assert_true(made.owned);
    lam_difference difference;
    assert_true(lam_image_compare(&made, &w.image, &difference, NULL));
    assert_true(difference.maximum == 0);
    lam_image_free(&made);
    close_window(&w);

    lam_device *device = lam_device_cpu(NULL, NULL); // the caller's own device, a view and methods
    lam_draw_params flat = {.shading = LAM_SHADING_FLAT, .samples = 1};
    lam_view front = {.from_angles = true};
    lam_image image = {.width = 40};
    assert_true(lam_render("cube", &(lam_render_params){.device = device, .draw = &flat, .view = &front}, &image,
                           &report, &error));
    assert_int_equal(image.width, 40);
    assert_int_equal(image.height, LAM_RENDER_SIZE);
    assert_int_equal(report.frame.triangles, 12);
    lam_image_free(&image);
    assert_false(lam_render("no-such-model", NULL, &image, &report, &error));
    assert_int_equal(error.code, LAM_CANNOT_READ);
    assert_null(image.pixels);
    assert_false(lam_render(NULL, NULL, &image, &report, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_device_free(device);
}
