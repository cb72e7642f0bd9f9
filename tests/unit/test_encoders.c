// test_encoders.c: JPEG and WebP pictures equal the encoded pictures, over the background, within the error of the
// quality.

#include "test.h"

enum { WIDTH = 61, HEIGHT = 37, PIXELS = WIDTH * HEIGHT };

// Smooth colours; alpha 0, 255 and values between in stripes; also colours with alpha 0.
static lam_image make_picture(int width, int height, bool opaque)
{
    lam_image image;
    assert_true(lam_image_make(&image, width, height, LAM_RGBA8, NULL));
    uint8_t *pixel = image.pixels;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++, pixel += 4) {
            const uint8_t alpha[3] = {255, 0, (uint8_t)(64 + x)};
            memcpy(pixel,
                   (uint8_t[4]){(uint8_t)(3 * x), (uint8_t)(5 * y), (uint8_t)(x + y), opaque ? 255 : alpha[y / 16 % 3]},
                   4);
        }
    return image;
}

static lam_bytes encode(const lam_image *image, const char *format, const lam_save_params *params)
{
    lam_bytes bytes;
    lam_error error;
    SUCCEEDS(lam_image_encode(image, format, params, &bytes, &error));
    return bytes;
}

// Decodes through a file, as a user does; `ours`: the file states that Lambent wrote it.
static lam_image decode(const lam_bytes *bytes, bool ours)
{
    char path[64];
    lam_image image;
    lam_error error;
    snprintf(path, sizeof path, "test-encoders-%d", (int)getpid());
    assert_true(lam_bytes_save(bytes, path, &error));
    SUCCEEDS(lam_image_load(&image, path, NULL, &error));
    assert_int_equal(lam_image_is_from_lambent(path), ours);
    unlink(path);
    return image;
}

static bool have_webp(void)
{
    lam_image image = make_picture(1, 1, true);
    lam_bytes bytes = {0};
    lam_error error = {0};
    bool ok = lam_image_encode(&image, "webp", NULL, &bytes, &error);
    if (!ok)
        assert_true(error.code == LAM_UNSUPPORTED && strstr(error.text, "Debian package libwebp") != NULL);
    lam_bytes_free(&bytes);
    lam_image_free(&image);
    return ok;
}

// The sampling of the first component in the frame's header: 0x11 or 0x22.
static int jpeg_sampling(const lam_bytes *bytes)
{
    const uint8_t *at = bytes->data;
    for (size_t i = 2; i + 12 < bytes->size; i += 2 + (size_t)(at[i + 2] << 8 | at[i + 3]))
        if (at[i] == 0xff && at[i + 1] == 0xc0)
            return at[i + 11];
    return -1;
}

TEST(test_jpeg_quality)
{
    AUTO_IMAGE image = make_picture(WIDTH, HEIGHT, true);
    static const int qualities[] = {1, 30, 60, 89, 90, 100};
    size_t last_size = 0;
    double last = 1e9;
    for (size_t i = 0; i < sizeof qualities / sizeof *qualities; i++) {
        lam_bytes bytes =
            encode(&image, i % 2 ? "jpeg" : "JPG", &(lam_save_params){.quality = qualities[i], .threads = 1});
        AUTO_BYTES again = encode(&image, "jpg", &(lam_save_params){.quality = qualities[i], .threads = 4});
        assert_true(bytes.size == again.size && memcmp(bytes.data, again.data, bytes.size) == 0);
        assert_int_equal(jpeg_sampling(&bytes), qualities[i] < 90 ? 0x22 : 0x11);
        AUTO_IMAGE back = decode(&bytes, true);
        lam_difference difference;
        assert_true(lam_image_compare(&image, &back, &difference, NULL));
        assert_true(bytes.size > last_size && difference.rmse < last);
        last = difference.rmse;
        last_size = bytes.size;
        lam_bytes_free(&bytes);
    }
    assert_true(last < 0.004); // at 100, only the rounding of YCbCr
    lam_bytes plain = encode(&image, "jpg", NULL), named = encode(&image, "jpg", &(lam_save_params){.quality = 90});
    assert_true(plain.size == named.size && memcmp(plain.data, named.data, plain.size) == 0);
    lam_bytes_free(&plain);
    lam_bytes_free(&named);
}

// A JPEG shows the same as a PPM, whose numbers test_image.c compares with the formulas.
TEST(test_jpeg_background)
{
    AUTO_IMAGE image = make_picture(WIDTH, HEIGHT, false);
    for (int raw = 0; raw < 2; raw++) {
        lam_save_params params = {.quality = 100, .background = {0.2f, 0.5f, 1}, .raw = raw};
        lam_bytes jpeg = encode(&image, "jpg", &params), ppm = encode(&image, "ppm", &params);
        lam_image a = decode(&jpeg, true), b = decode(&ppm, true);
        const uint8_t *found = a.pixels, *wanted = b.pixels;
        for (int i = 0; i < 4 * PIXELS; i++)
            assert_true(abs(found[i] - wanted[i]) <= 4);
        lam_image_free(&a);
        lam_image_free(&b);
        lam_bytes_free(&jpeg);
        lam_bytes_free(&ppm);
    }
}

TEST(test_webp)
{
    if (!have_webp())
        skip();
    lam_image image = make_picture(WIDTH, HEIGHT, false);
    for (int quality = 0; quality <= 100; quality += 100) {
        AUTO_BYTES bytes = encode(&image, "webp", &(lam_save_params){.quality = quality});
        AUTO_IMAGE back = decode(&bytes, false);
        assert_memory_equal(back.pixels, image.pixels, 4 * PIXELS); // including the colours of transparent pixels
    }
    lam_image_free(&image);
    image = make_picture(WIDTH, HEIGHT, true);
    double last = 1e9;
    size_t last_size = 0;
    for (int quality = 1; quality < 100; quality += 49) {
        AUTO_BYTES bytes = encode(&image, "webp", &(lam_save_params){.quality = quality});
        AUTO_IMAGE back = decode(&bytes, false);
        lam_difference difference;
        assert_true(lam_image_compare(&image, &back, &difference, NULL));
        assert_true(difference.rmse > 0 && difference.rmse < last && bytes.size > last_size);
        last = difference.rmse;
        last_size = bytes.size;
    }
    assert_true(last < 0.02);
    lam_image_free(&image);
}

static void refused(const lam_image *image, const char *format, const lam_save_params *params, lam_code code,
                    const char *word)
{
    lam_bytes bytes = {&bytes, 1};
    lam_error error = {0};
    assert_false(lam_image_encode(image, format, params, &bytes, &error));
    assert_null(bytes.data);
    if (error.code != code || !strstr(error.text, word))
        fail_msg("'%s' does not say '%s'", error.text, word);
}

TEST(test_refusals)
{
    lam_image image = make_picture(WIDTH, HEIGHT, true), wide = make_picture(16384, 1, true);
    lam_cancel cancel = {0};
    lam_control stop = {.cancel = &cancel}, late = {.time_limit_s = 1e-9};
    lam_cancel_raise(&cancel);
    static const char *const formats[] = {"jpg", "webp"};
    for (int i = 0; i < 1 + have_webp(); i++) {
        refused(&image, formats[i], &(lam_save_params){.control = &stop}, LAM_CANCELLED, "cancelled");
        refused(&image, formats[i], &(lam_save_params){.control = &late}, LAM_LIMIT, "time limit");
        refused(&image, formats[i], &(lam_save_params){.quality = 101}, LAM_BAD_ARGUMENT,
                "quality: 101, expected 1 to 100");
        refused(&image, formats[i], &(lam_save_params){.quality = -1}, LAM_BAD_ARGUMENT, "quality: -1");
    }
    if (have_webp())
        refused(&wide, "webp", NULL, LAM_LIMIT, "16384×1 pixels, expected at most 16383");
    // In the middle of a picture, after part of its memory was allocated.
    lam_image_free(&wide);
    wide = make_picture(6000, 4000, true);
    refused(&wide, "jpg", &(lam_save_params){.control = &(lam_control){.time_limit_s = 0.02}}, LAM_LIMIT, "time limit");
    if (have_webp())
        refused(&wide, "webp", &(lam_save_params){.control = &(lam_control){.time_limit_s = 0.02}}, LAM_LIMIT,
                "time limit");
    lam_image_free(&wide);
    wide = make_picture(65535, 1, true); // the maximum size of JPEG itself is 65500
    refused(&wide, "jpg", NULL, LAM_LIMIT, "JPEG: Maximum supported image dimension is 65500");
    lam_image_free(&wide);
    lam_image_free(&image);
}
