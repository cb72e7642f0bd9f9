// test_pictures.c: Radiance, JPEG and 16-bit PNG files are decoded correctly, and broken ones are refused.
#include "test.h"
#include "codec.h"

#include <jpeglib.h>

// --- Radiance

struct file {
    uint8_t bytes[8192];
    size_t size;
};

static void put(struct file *file, const void *bytes, size_t size)
{
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

static struct file hdr_of(const char *header, const uint8_t *pixels, size_t size)
{
    struct file file = {.size = 0};
    put(&file, header, strlen(header));
    put(&file, pixels, size);
    return file;
}

static const float *pixel(const lam_image *image, int x, int y)
{
    return (const float *)image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static lam_image read_hdr(const struct file *file)
{
    lam_image image = {0};
    lam_error error = {0};
    if (!codec_hdr.probe(file->bytes, file->size) ||
        !codec_hdr.read(&(struct picture_file){file->bytes, file->size, "test.hdr", NULL}, &image, &error))
        fail_msg("%s", error.text);
    assert_int_equal(image.format, LAM_RGBA32F);
    return image;
}

#define HEADER "#?RADIANCE\n# a remark\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n"

TEST(test_hdr_numbers)
{
    // 128·2^(129 − 136) = 1; exponent 0 is black for any mantissas; the largest value; a value below the normal floats.
    static const uint8_t rows[] = {128, 64, 32, 129, 200, 100, 50, 0, 255, 0, 1, 255, 255, 255, 255, 9};
    struct file file = hdr_of(HEADER "-Y 2 +X 2\n", rows, sizeof rows);
    lam_image image = read_hdr(&file);
    static const float expected[4][3] = {{1, 0.5f, 0.25f}, {0, 0, 0}, {255 * 0x1p119f, 0, 0x1p119f}, {0, 0, 0}};
    for (int i = 0; i < 4; i++) {
        assert_memory_equal(pixel(&image, i % 2, i / 2), expected[i], 12);
        assert_true(pixel(&image, i % 2, i / 2)[3] == 1);
    }
    lam_image_free(&image);
    // Rows upwards, pixels to the left.
    file = hdr_of("#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n+Y 2 -X 2\n", rows, sizeof rows);
    image = read_hdr(&file);
    for (int i = 0; i < 4; i++)
        assert_memory_equal(pixel(&image, 1 - i % 2, 1 - i / 2), expected[i], 12);
    lam_image_free(&image);
}

TEST(test_hdr_runs)
{
    // New runs: 10 pixels; red 10 × 128, green 4 literal values and 6 × 8, blue 9 + 1, exponent 10 × 129.
    static const uint8_t fresh[] = {2, 2, 0, 10, 138, 128, 4, 1, 2, 3, 4, 134, 8, 137, 16, 1, 32, 138, 129};
    struct file file = hdr_of(HEADER "-Y 1 +X 10\n", fresh, sizeof fresh);
    lam_image image = read_hdr(&file);
    for (int x = 0; x < 10; x++) {
        const float expected[3] = {1, (float)(x < 4 ? x + 1 : 8) / 128, x < 9 ? 0.125f : 0.25f};
        assert_memory_equal(pixel(&image, x, 0), expected, 12);
    }
    lam_image_free(&image);
    // Old runs: one pixel, 3 more, 1·256 more, another pixel.
    static const uint8_t old[] = {128, 0, 0, 129, 1, 1, 1, 3, 1, 1, 1, 1, 0, 128, 0, 129};
    file = hdr_of(HEADER "-Y 1 +X 261\n", old, sizeof old);
    image = read_hdr(&file);
    for (int x = 0; x < 261; x++)
        assert_true(pixel(&image, x, 0)[0] == (x < 260) && pixel(&image, x, 0)[1] == (x == 260));
    lam_image_free(&image);
}

static void hdr_refused(const struct file *file, lam_code code, const char *word)
{
    lam_image image = {0};
    lam_error error = {0};
    assert_false(codec_hdr.read(&(struct picture_file){file->bytes, file->size, "test.hdr", NULL}, &image, &error));
    assert_null(image.pixels);
    assert_int_equal(error.code, code);
    if (!strstr(error.text, word) || !strstr(error.text, "test.hdr"))
        fail_msg("'%s' does not say '%s'", error.text, word);
}

TEST(test_hdr_refusals)
{
    static const uint8_t fresh[] = {2, 2, 0, 10, 138, 128, 4, 1, 2, 3, 4, 134, 8, 137, 16, 1, 32, 138, 129};
    struct file whole = hdr_of(HEADER "-Y 1 +X 10\n", fresh, sizeof fresh), file;
    for (size_t size = 11; size < whole.size; size++) {
        file = whole;
        file.size = size;
        hdr_refused(&file, LAM_CANNOT_READ, size < whole.size - sizeof fresh ? "header" : "row 1 of 1");
    }
    uint8_t wrong[sizeof fresh];
    memcpy(wrong, fresh, sizeof wrong);
    wrong[4] = 139; // one more than fits
    file = hdr_of(HEADER "-Y 1 +X 10\n", wrong, sizeof wrong);
    hdr_refused(&file, LAM_CANNOT_READ, "wrong run");
    wrong[4] = 128; // an empty run would never end
    file = hdr_of(HEADER "-Y 1 +X 10\n", wrong, sizeof wrong);
    hdr_refused(&file, LAM_CANNOT_READ, "wrong run");
    static const uint8_t old[] = {9, 9, 9, 9, 1, 1, 1, 255, 1, 1, 1, 255, 1, 1, 1, 255, 1, 1, 1, 255, 1, 1, 1, 255};
    file = hdr_of(HEADER "-Y 1 +X 3\n", old, sizeof old);
    hdr_refused(&file, LAM_CANNOT_READ, "wrong run");
    file = hdr_of(HEADER "-Y 20000 +X 20000\n", old, sizeof old); // without allocating 6.4 GB
    hdr_refused(&file, LAM_CANNOT_READ, "row 1 of 20000");
    file = hdr_of("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 10\n", fresh, sizeof fresh);
    hdr_refused(&file, LAM_UNSUPPORTED, "32-bit_rle_xyze");
    file = hdr_of(HEADER "+X 10 -Y 1\n", fresh, sizeof fresh);
    hdr_refused(&file, LAM_UNSUPPORTED, "columns first");
    static const char *const sizes[] = {
        "-Y 0 +X 10", "-Y 1 +X 65536", "-Y 1", "-Y 99999999999999999999 +X 1", "-Y 1 +X 10 x", "Y"};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char header[128];
        snprintf(header, sizeof header, HEADER "%s\n", sizes[i]);
        file = hdr_of(header, fresh, sizeof fresh);
        hdr_refused(&file, LAM_CANNOT_READ, sizes[i]);
    }
}

// --- JPEG

struct jpeg_file {
    unsigned char *bytes;
    unsigned long size;
};

enum { SIDE = 40 };

static void colors_at(int x, int y, int components, uint8_t *out)
{
    const int rgb[3] = {255 * x / SIDE, 255 * y / SIDE, 128};
    for (int c = 0; c < components; c++)
        out[c] = (uint8_t)(components == 3 ? rgb[c] : rgb[0]);
}

static struct jpeg_file make_jpeg(int components, bool progressive)
{
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_file file = {0};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &file.bytes, &file.size);
    jpeg.image_width = jpeg.image_height = SIDE;
    jpeg.input_components = components;
    jpeg.in_color_space = components == 3 ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    if (progressive)
        jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < SIDE; y++) {
        uint8_t row[SIDE * 4];
        for (int x = 0; x < SIDE; x++)
            colors_at(x, y, components, row + components * x);
        JSAMPROW rows = row;
        jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    return file;
}

TEST(test_jpeg_pixels)
{
    for (int kind = 0; kind < 4; kind++) {
        int components = kind & 1 ? 3 : 1;
        struct jpeg_file file = make_jpeg(components, kind & 2);
        lam_image image = {0};
        lam_error error = {0};
        assert_true(codec_jpeg.probe(file.bytes, file.size));
        SUCCEEDS(codec_jpeg.read(&(struct picture_file){file.bytes, file.size, "test.jpg", NULL}, &image, &error));
        assert_true(image.width == SIDE && image.height == SIDE && image.format == LAM_RGBA8);
        for (int y = 0; y < SIDE; y++) {
            for (int x = 0; x < SIDE; x++) {
                const uint8_t *p = (const uint8_t *)image.pixels + 4 * (y * SIDE + x);
                uint8_t expected[3];
                colors_at(x, y, components, expected);
                for (int c = 0; c < 3; c++)
                    if (abs(p[c] - expected[components == 3 ? c : 0]) > 8)
                        fail_msg("kind %d, pixel %d, %d: %d, expected %d", kind, x, y, p[c],
                                 expected[components == 3 ? c : 0]);
                assert_int_equal(p[3], 255);
            }
        }
        lam_image_free(&image);
        // A file truncated anywhere is refused; no grey remainder is drawn.
        for (size_t size = 3; size + 2 < file.size; size += 1 + size / 64) {
            assert_false(codec_jpeg.read(&(struct picture_file){file.bytes, size, "test.jpg", NULL}, &image, &error));
            assert_null(image.pixels);
            assert_non_null(strstr(error.text, "test.jpg"));
        }
        free(file.bytes);
    }
}

TEST(test_jpeg_refusals)
{
    lam_image image = {0};
    lam_error error = {0};
    struct jpeg_file file = make_jpeg(3, false);
    for (size_t i = 0; i + 9 < file.size; i++) {
        if (file.bytes[i] == 0xff && file.bytes[i + 1] == 0xc0) // the frame's header: precision, height, width
            memset(file.bytes + i + 5, 0xff, 4);
    }
    assert_false(codec_jpeg.read(&(struct picture_file){file.bytes, file.size, "test.jpg", NULL}, &image, &error));
    assert_true(error.code == LAM_CANNOT_READ && error.text[0]);
    free(file.bytes);
}

// --- linear light from each format

TEST(test_linear)
{
    char path[64];
    snprintf(path, sizeof path, "test-pictures-%d.png", (int)getpid());
    lam_image bytes = {0}, linear;
    lam_error error = {0};
    assert_true(lam_image_make(&bytes, 2, 1, LAM_RGBA8, &error));
    memcpy(bytes.pixels, (uint8_t[]){255, 128, 10, 255, 200, 100, 0, 51}, 8);
    assert_true(lam_image_save(&bytes, path, NULL, &error));
    for (int mode = 0; mode < 2; mode++) {
        SUCCEEDS(lam_image_load_linear(&linear, path, mode ? LAM_COLOR_RAW : LAM_COLOR_SRGB, NULL, &error));
        assert_int_equal(linear.format, LAM_RGBA32F);
        for (int i = 0; i < 8; i++) {
            double x = ((const uint8_t *)bytes.pixels)[i] / 255.0, alpha = i < 4 ? 1 : 0.2;
            double light = mode ? x : x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
            double expected = i % 4 == 3 ? alpha : light * alpha;
            assert_true(fabs((double)((const float *)linear.pixels)[i] - expected) < 1e-7);
        }
        lam_image_free(&linear);
    }
    assert_false(lam_image_load_linear(&linear, path, (lam_color_mode)7, NULL, &error));
    unlink(path);
    lam_image_free(&bytes);
    // Formats that are only read are not offered for writing.
    lam_pixel_format format;
    assert_false(lam_image_format_for("x.hdr", &format, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    assert_false(lam_image_format_for("x.bmp", &format, &error));
}
