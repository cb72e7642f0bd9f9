// test_decoders.c: every picture of tests/pictures is decoded to the pixels recorded by its maker and Pillow (make.py
// there); a truncated file, or a file with any byte changed, is refused with an error message or read without harm.
#include "test.h"
#include "codec.h"

#include <dirent.h>

#include <jpeglib.h>

enum { FILE_BYTES = 16384, WIDTH = 13, HEIGHT = 7 };

static const struct {
    const char *name;
    const struct codec *codec;
} formats[] = {{"avif", &codec_avif}, {"bmp", &codec_bmp}, {"jpeg", &codec_jpeg},
               {"png", &codec_png},   {"tga", &codec_tga}, {"webp", &codec_webp}};
enum { FORMATS = sizeof formats / sizeof *formats };

struct file {
    char name[300]; // "test.EXT" for data in memory, otherwise the file's own name
    uint8_t bytes[FILE_BYTES];
    size_t size;
};

static bool read_file(const char *folder, const char *name, struct file *file)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s/%s", PICTURES, folder, name);
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return false;
    snprintf(file->name, sizeof file->name, "%.200s", name);
    file->size = fread(file->bytes, 1, FILE_BYTES, stream);
    assert_true(file->size < FILE_BYTES);
    fclose(stream);
    return true;
}

// A copy of exactly this size: a sanitizer detects every read beyond it.
static bool decode(const struct file *file, size_t size, lam_image *image, lam_error *error)
{
    uint8_t *bytes = malloc(size + !size);
    assert_non_null(bytes);
    memcpy(bytes, file->bytes, size);
    *error = (lam_error){0};
    bool ok = picture_decode(&(struct picture_file){bytes, size, file->name, NULL}, image, error);
    free(bytes);
    return ok;
}

static int each_file(const char *folder, bool (*visit)(const char *folder, const struct file *file))
{
    char path[1024];
    struct dirent **names;
    snprintf(path, sizeof path, "%s/%s", PICTURES, folder);
    int listed = scandir(path, &names, NULL, alphasort), count = 0;
    assert_true(listed > 0);
    for (int i = 0; i < listed; i++) {
        struct file file;
        if (names[i]->d_name[0] != '.') {
            assert_true(read_file(folder, names[i]->d_name, &file));
            count += visit(folder, &file);
        }
        free(names[i]);
    }
    free(names);
    return count;
}

// --- pixels

static bool compare(const char *folder, const struct file *file)
{
    struct file picture;
    char name[600];
    snprintf(name, sizeof name, "%s-%.*s.png", folder, (int)(strchr(file->name, '.') - file->name), file->name);
    assert_true(read_file("expected", name, &picture));
    lam_image image, expected;
    lam_error error;
    if (!decode(file, file->size, &image, &error)) {
        if (error.code == LAM_UNSUPPORTED && strstr(error.text, "install the Debian package"))
            return false;
        fail_msg("%s", error.text);
    }
    assert_true(decode(&picture, picture.size, &expected, &error));
    assert_true(image.width == WIDTH && image.height == HEIGHT && image.format == LAM_RGBA8);
    const uint8_t *found = image.pixels, *wanted = expected.pixels;
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        if (found[i] != wanted[i])
            fail_msg("%s/%s: pixel %d, %d, channel %d is %d, expected %d", folder, file->name, i / 4 % WIDTH,
                     i / 4 / WIDTH, i % 4, found[i], wanted[i]);
    lam_image_free(&image);
    lam_image_free(&expected);
    return true;
}

TEST(test_pixels)
{
    for (int i = 0; i < FORMATS; i++) {
        int count = each_file(formats[i].name, compare);
        print_message("%s: %d pictures\n", formats[i].name, count);
    }
}

// All 16 bits of a 16-bit PNG, interlaced or not: the numbers of make.py.
TEST(test_wide)
{
    static const char *const names[] = {"bits16.png", "bits16-interlaced.png", "grey16.png", "grey16-interlaced.png"};
    for (int i = 0; i < 4; i++) {
        struct file file;
        assert_true(read_file("png", names[i], &file));
        AUTO_IMAGE image = {0};
        lam_error error = {0};
        bool wide = false;
        assert_true(
            codec_png.read_wide(&(struct picture_file){file.bytes, file.size, names[i], NULL}, &image, &wide, &error));
        assert_true(wide && image.format == LAM_RGBA32F);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                int color[4] = {x * 21, y * 42, (x * y * 13 + 40) % 256, (x * 37 + y * 91) % 256};
                const float *pixel = (const float *)image.pixels + 4 * (y * WIDTH + x);
                for (int c = 0; c < 4; c++) {
                    double value = ((color[i < 2 ? c : 0] * 257 + 100) & 0xffff) / 65535.0;
                    assert_true(fabs((double)pixel[c] - (i >= 2 && c == 3 ? 1 : value)) < 1e-7);
                }
            }
        }
    }
}

// --- JPEG with ink colours

enum { SIDE = 16 };
static struct file make_inks(J_COLOR_SPACE space, bool marker, const uint8_t ink[4])
{
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    unsigned char *bytes = NULL;
    unsigned long size = 0;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = jpeg.image_height = SIDE;
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_colorspace(&jpeg, space);
    jpeg.write_Adobe_marker = marker;
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < SIDE; y++) {
        uint8_t row[SIDE * 4];
        for (int x = 0; x < SIDE; x++)
            memcpy(row + 4 * x, ink, 4);
        JSAMPROW rows = row;
        jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    struct file file = {.name = "inks.jpg", .size = size};
    assert_true(size < FILE_BYTES);
    memcpy(file.bytes, bytes, size);
    free(bytes);
    return file;
}

TEST(test_inks)
{
    // In Adobe's files, the numbers are the visible fraction of the paper; in others, the amount of ink.
    static const uint8_t through[4] = {255, 128, 64, 204};
    static const uint8_t inks[4] = {0, 127, 191, 51};
    static const int expected[4] = {204, 102, 51, 255};
    for (int kind = 0; kind < 3; kind++) {
        struct file file = make_inks(kind == 1 ? JCS_YCCK : JCS_CMYK, kind < 2, kind < 2 ? through : inks);
        AUTO_IMAGE image = {0};
        lam_error error;
        assert_true(decode(&file, file.size, &image, &error));
        for (int i = 0; i < SIDE * SIDE * 4; i++)
            if (abs(((const uint8_t *)image.pixels)[i] - expected[i % 4]) > 2)
                fail_msg("kind %d, channel %d: %d, expected %d", kind, i % 4, ((const uint8_t *)image.pixels)[i],
                         expected[i % 4]);
    }
}

// --- damage

static bool cut(const char *folder, const struct file *file)
{
    // Unread parts: the end of a JPEG, a two-byte marker that libjpeg does not need; the checksum of a PNG's last
    // chunk, which is empty; data after a TGA's pixels.
    size_t end = file->size - (strcmp(folder, "jpeg") == 0             ? 2
                               : strcmp(folder, "png") == 0            ? 4
                               : strcmp(file->name, "footer.tga") == 0 ? 26
                                                                       : 0);
    for (size_t size = 0; size < end; size++) {
        lam_image image;
        lam_error error;
        if (decode(file, size, &image, &error))
            fail_msg("%s/%s is read when cut to %zu of %zu bytes", folder, file->name, size, file->size);
        assert_null(image.pixels);
        assert_true(error.code != LAM_OK);
        if (!strstr(error.text, file->name))
            fail_msg("'%s' does not name %s", error.text, file->name);
    }
    return true;
}

TEST(test_cut)
{
    for (int i = 0; i < FORMATS; i++)
        each_file(formats[i].name, cut);
}

static bool flip(const char *folder, const struct file *file)
{
    (void)folder;
    static const uint8_t changes[] = {0x01, 0x80, 0xff};
    struct file changed = *file;
    for (size_t at = 0; at < file->size; at++) {
        for (size_t i = 0; i < sizeof changes; i++) {
            changed.bytes[at] = file->bytes[at] ^ changes[i];
            struct call_control call;
            call_start(&call, &(lam_control){.memory_limit_bytes = 1 << 24});
            lam_image image;
            lam_error error = {0};
            bool ok = picture_decode(&(struct picture_file){changed.bytes, changed.size, changed.name, &call}, &image,
                                     &error);
            assert_true(ok ? image.pixels != NULL : !image.pixels && error.code != LAM_OK && error.text[0]);
            picture_free(&call, &image);
            assert_int_equal(call.memory_used, 0);
        }
        changed.bytes[at] = file->bytes[at];
    }
    return true;
}

TEST(test_flips)
{
    for (int i = 0; i < FORMATS; i++)
        each_file(formats[i].name, flip);
}

// --- refused files, and the reasons

static void refused(struct file *file, size_t at, const char *bytes, size_t count, const char *name, lam_code code,
                    const char *word)
{
    struct file changed = *file;
    memcpy(changed.bytes + at, bytes, count);
    snprintf(changed.name, sizeof changed.name, "%s", name);
    lam_image image;
    lam_error error;
    if (decode(&changed, changed.size, &image, &error))
        fail_msg("read, expected '%s'", word);
    if (error.code != code || !strstr(error.text, word) || !strstr(error.text, name))
        fail_msg("%d: '%s', expected '%s'", error.code, error.text, word);
}

TEST(test_bmp_refusals)
{
    struct file bmp, runs, masks;
    assert_true(read_file("bmp", "bits8-40.bmp", &bmp) && read_file("bmp", "runs8.bmp", &runs));
    assert_true(read_file("bmp", "masks565-40.bmp", &masks));
    refused(&bmp, 14, "\x29", 1, "a.bmp", LAM_UNSUPPORTED, "header of 41 bytes");
    refused(&bmp, 28, "\x02", 1, "a.bmp", LAM_UNSUPPORTED, "2 bits with compression 0, expected 1, 4, 8, 16, 24 or 32");
    refused(&bmp, 30, "\x04", 1, "a.bmp", LAM_UNSUPPORTED, "contains a JPEG");
    refused(&bmp, 30, "\x05", 1, "a.bmp", LAM_UNSUPPORTED, "contains a PNG");
    refused(&bmp, 30, "\x07", 1, "a.bmp", LAM_UNSUPPORTED, "compression 7");
    refused(&bmp, 30, "\x02", 1, "a.bmp", LAM_UNSUPPORTED, "8 bits with compression 2, expected 4 bits");
    refused(&bmp, 18, "\0", 1, "a.bmp", LAM_LIMIT, "0×7");
    refused(&bmp, 18, "\0\0\1", 3, "a.bmp", LAM_LIMIT, "65536×7");
    refused(&bmp, 22, "\0\0\0\x80", 4, "a.bmp", LAM_LIMIT, "13×2147483648");
    refused(&bmp, 22, "\x70", 1, "a.bmp", LAM_CANNOT_READ, "13×112 pixels take up to byte");
    refused(&bmp, 10, "\x20", 1, "a.bmp", LAM_CANNOT_READ, "pixels begin at byte 32, expected 54 to");
    refused(&bmp, 46, "\x05", 1, "a.bmp", LAM_CANNOT_READ, "colour 12 of a palette of 5");
    refused(&runs, 22, "\xf9\xff\xff\xff", 4, "a.bmp", LAM_CANNOT_READ, "top row first");
    refused(&runs, 118, "\x0e", 1, "a.bmp", LAM_CANNOT_READ, "byte 118: a run of 14 pixels at 0, 0");
    refused(&masks, 54, "\x00\xa8", 2, "a.bmp", LAM_CANNOT_READ, "mask of red is 0xa800");
}

TEST(test_tga_refusals)
{
    struct file tga, runs, palette;
    assert_true(read_file("tga", "bits24-0.tga", &tga) && read_file("tga", "runs24-0.tga", &runs));
    assert_true(read_file("tga", "palette-first.tga", &palette));
    // The name decides if the header does not identify a TGA; for another name, the error message lists the picture
    // formats.
    refused(&tga, 2, "\x05", 1, "a.tga", LAM_CANNOT_READ, "type 5, expected 1, 2, 3, 9, 10 or 11");
    refused(&tga, 2, "\x05", 1, "A.TGA", LAM_CANNOT_READ, "type 5, expected 1, 2, 3, 9, 10 or 11");
    refused(&tga, 2, "\x05", 1, "a.dat", LAM_CANNOT_READ, "not the start of a PNG, JPEG, WebP, BMP, TGA");
    refused(&tga, 16, "\x11", 1, "a.tga", LAM_CANNOT_READ, "17 bits a pixel, expected 15, 16, 24 or 32");
    refused(&tga, 17, "\x40", 1, "a.tga", LAM_CANNOT_READ, "interleaved");
    refused(&tga, 17, "\x08", 1, "a.tga", LAM_CANNOT_READ, "8 bits of alpha, expected 0 of colours of 24 bits");
    refused(&tga, 12, "\0", 1, "a.tga", LAM_CANNOT_READ, "0×7");
    refused(&tga, 14, "\x08", 1, "a.tga", LAM_CANNOT_READ, "13×8 pixels take up to byte 330");
    refused(&tga, 2, "\x01", 1, "a.tga", LAM_CANNOT_READ, "palette flag 0");
    refused(&runs, 14, "\x06", 1, "a.tga", LAM_CANNOT_READ, "after the last one");
    refused(&runs, 14, "\xff\xff", 2, "a.tga", LAM_CANNOT_READ, "13×65535 pixels take up to byte");
    refused(&palette, 3, "\x65", 1, "a.tga", LAM_CANNOT_READ, "colour 100, but the palette has 101 to 116");
    refused(&palette, 7, "\x09", 1, "a.tga", LAM_CANNOT_READ, "palette of 9 bits");
    // A text file is not a picture.
    struct file text = {.name = "a.txt", .size = 40};
    memcpy(text.bytes, "BMW and other cars; a text of 40 letters", 40);
    refused(&text, 0, "B", 1, "a.txt", LAM_CANNOT_READ, "byte 0: not the start of");
}

TEST(test_webp_refusals)
{
    struct file file;
    assert_true(read_file("webp", "lossy.webp", &file));
    lam_image image;
    lam_error error;
    if (!decode(&file, file.size, &image, &error)) {
        assert_int_equal(error.code, LAM_UNSUPPORTED);
        assert_true(strstr(error.text, "Debian package libwebp") != NULL);
        skip();
    }
    lam_image_free(&image);
    refused(&file, 4, "\xff\xff", 2, "a.webp", LAM_CANNOT_READ, "its WebP header says byte");
    refused(&file, 23, "\x00", 1, "a.webp", LAM_CANNOT_READ, "WebP: the picture is damaged");
    static const char moving[] = "RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0\x0c\0\0\x06\0\0";
    struct file animation = {.name = "a.webp", .size = sizeof moving - 1};
    memcpy(animation.bytes, moving, sizeof moving - 1);
    refused(&animation, 0, "R", 1, "a.webp", LAM_UNSUPPORTED, "WebP animation");
}
