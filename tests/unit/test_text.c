// test_text.c: text in pictures: its position, its widths, UTF-8, and missing characters.
#include "test.h"

#include <lambent/caption.h>

static lam_font *font;

static int open_font(void **state)
{
    (void)state;
    lam_error error;
    font = lam_font_open(NULL, &error);
    if (!font)
        printf("# no text here: %s\n", error.text);
    return 0;
}

static int close_font(void **state)
{
    (void)state;
    lam_font_free(font);
    return 0;
}

static lam_image blank(int width, int height, lam_pixel_format format)
{
    lam_image image;
    assert_true(lam_image_make(&image, width, height, format, NULL));
    memset(image.pixels, 0, (size_t)width * (size_t)height * (format == LAM_RGBA8 ? 4 : 16));
    return image;
}

// The box of the covered pixels: left, top, right, bottom, the last two excluded; all 0 if there are none.
static void ink(const lam_image *image, int box[4])
{
    const uint8_t *p = image->pixels;
    memset(box, 0, 4 * sizeof *box);
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++)
            if (p[4 * ((size_t)y * (size_t)image->width + (size_t)x) + 3]) {
                bool first = box[2] == 0;
                box[0] = first || x < box[0] ? x : box[0];
                box[1] = first ? y : box[1];
                box[2] = x + 1 > box[2] ? x + 1 : box[2];
                box[3] = y + 1;
            }
}

TEST(stands_on_its_baseline)
{
    if (!font)
        skip();
    AUTO_IMAGE image = blank(200, 60, LAM_RGBA8);
    assert_true(lam_text_draw(&image, font, 20, 40, 32, (lam_rgba){1, 0, 0, 1}, "HEX", NULL));
    int box[4];
    ink(&image, box);
    double width = lam_text_width(font, 32, "HEX");
    assert_true(width > 45 && width < 85);
    assert_true(box[0] >= 19 && box[0] <= 25 && box[2] <= 20 + width + 1 && box[2] > 20 + width - 6);
    assert_int_equal(box[3], 40);
    assert_true(box[1] >= 14 && box[1] <= 20); // capitals are about 0.73 of the size
    const uint8_t *p = image.pixels;
    int full = 0;
    for (size_t i = 0; i < 200 * 60; i++) {
        assert_true(p[4 * i + 3] == 0 || (p[4 * i] == 255 && p[4 * i + 1] == 0 && p[4 * i + 2] == 0));
        full += p[4 * i + 3] == 255;
    }
    assert_true(full > 50);
}

TEST(measures)
{
    if (!font)
        skip();
    double one = lam_text_width(font, 20, "m"), two = lam_text_width(font, 20, "mm");
    assert_true(one > 10 && two > 1.9 * one && two < 2.1 * one);
    assert_true(lam_text_width(font, 40, "m") > 1.8 * one);
    assert_true(lam_text_width(font, 20, "") == 0 && lam_text_width(font, 0, "m") == 0 &&
                lam_text_width(NULL, 20, "m") == 0);
    // One letter of two bytes and one of three; each invalid byte is one replacement letter.
    double letter = lam_text_width(font, 20, "\u00e9"), replacement = lam_text_width(font, 20, "\ufffd");
    assert_true(letter > 5 && letter < 20);
    assert_true(lam_text_width(font, 20, "\xff") == replacement);
    assert_true(lam_text_width(font, 20, "\xc3") == replacement);
    assert_true(lam_text_width(font, 20, "\xed\xa0\x80") == replacement); // a surrogate
}

TEST(blends_and_clips)
{
    if (!font)
        skip();
    lam_image bytes = blank(20, 20, LAM_RGBA8), floats = blank(20, 20, LAM_RGBA32F);
    memset(bytes.pixels, 255, 20 * 20 * 4);
    // Far larger than the picture, beyond every side; the middle of a bar covers all of it.
    assert_true(lam_text_draw(&bytes, font, -200, 200, 800, (lam_rgba){0, 0, 0, 0.5f}, "\u2588\u2588\u2588", NULL));
    assert_true(lam_text_draw(&floats, font, -200, 200, 800, (lam_rgba){2, 0, 0, 0.5f}, "\u2588\u2588\u2588", NULL));
    const uint8_t *b = (const uint8_t *)bytes.pixels + 4 * (10 * 20 + 10);
    const float *f = (const float *)floats.pixels + 4 * (10 * 20 + 10);
    assert_true(b[0] == 128 && b[3] == 255);
    assert_true(f[0] == 1 && f[1] == 0 && f[3] == 0.5f);
    lam_image_free(&bytes);
    lam_image_free(&floats);
}

TEST(says_what_is_missing)
{
    lam_error error;
    if (font) {
        assert_null(lam_font_open("/nowhere/font.ttf", &error));
        assert_int_equal(error.code, LAM_CANNOT_READ);
        assert_non_null(strstr(error.text, "/nowhere/font.ttf"));
        assert_null(lam_font_open("/etc/passwd", &error));
        assert_int_equal(error.code, LAM_CANNOT_READ);
        AUTO_IMAGE image = blank(4, 4, LAM_RGBA8);
        assert_false(lam_text_draw(&image, font, 0, 0, 0.5, (lam_rgba){0}, "a", &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_false(lam_text_draw(&image, font, 1e9, 0, 10, (lam_rgba){0}, "a", &error));
        assert_false(lam_text_draw(&image, NULL, 0, 0, 10, (lam_rgba){0}, "a", &error));
    } else {
        assert_null(lam_font_open(NULL, &error));
        assert_int_equal(error.code, LAM_UNSUPPORTED);
    }
    assert_non_null(lam_font_path(0));
    assert_null(lam_font_path(1000));
    assert_null(lam_font_path(-1));
}

TEST(follows_the_environment)
{
    if (!font)
        skip();
    lam_error error;
    setenv("LAMBENT_FONT", "/nowhere/else.ttf", 1);
    assert_null(lam_font_open(NULL, &error));
    assert_non_null(strstr(error.text, "/nowhere/else.ttf"));
    unsetenv("LAMBENT_FONT");
}

FIXTURE(open_font, close_font)
