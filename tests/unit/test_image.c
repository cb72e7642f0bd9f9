// test_image.c: pictures in memory, their files except PNG compression, comparison, and all errors.
#include "test.h"

#include <lambent/image.h>

#include <dirent.h>
#include <sys/stat.h>

#include "temporary_folder.h"

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/lambent-test-image-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int files_in_folder(void)
{
    DIR *dir = opendir(folder);
    assert_non_null(dir);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(dir));)
        count += entry->d_name[0] != '.';
    closedir(dir);
    return count;
}

static int empty_folder(void **state)
{
    (void)state;
    DIR *dir = opendir(folder);
    assert_non_null(dir);
    for (struct dirent *entry; (entry = readdir(dir));)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            unlink(in_folder(entry->d_name));
    closedir(dir);
    return 0;
}

static void write_file(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static lam_image bytes_picture(int width, int height)
{
    lam_image image;
    assert_true(lam_image_make(&image, width, height, LAM_RGBA8, NULL));
    uint8_t *pixels = image.pixels;
    for (int i = 0; i < width * height * 4; i++)
        pixels[i] = (uint8_t)(i * 37 + i / 7);
    return image;
}

static lam_image floats_picture(int width, int height)
{
    lam_image image;
    assert_true(lam_image_make(&image, width, height, LAM_RGBA32F, NULL));
    float *pixels = image.pixels;
    for (int i = 0; i < width * height * 4; i++)
        pixels[i] = i % 4 == 3 ? 1.0f : (float)i * 0.37f - 3.0f;
    return image;
}

static void expect_near(double found, double wanted, double apart)
{
    if (!(fabs(found - wanted) <= apart))
        fail_msg("%.17g, expected %.17g", found, wanted);
}

static void expect_error(bool ok, const lam_error *error, lam_code code, const char *words)
{
    assert_false(ok);
    if (error->code != code || !strstr(error->text, words))
        fail_msg("code %d, '%s'; expected %d, '%s'", (int)error->code, error->text, (int)code, words);
    assert_null(strchr(error->text, '\n'));
}

TEST(makes_within_limits)
{
    lam_image image;
    lam_error error;
    assert_true(lam_image_make(&image, 65535, 1, LAM_RGBA32F, NULL));
    ((float *)image.pixels)[65534 * 4 + 3] = 1.0f;
    lam_image_free(&image);
    assert_null(image.pixels);
    lam_image_free(&image);
    lam_image_free(NULL);
    assert_true(lam_image_make(&image, 1024, 1024, LAM_RGBA8, NULL)); // in separate pages
    memset(image.pixels, 1, 1024 * 1024 * 4);
    lam_image_free(&image);

    expect_error(lam_image_make(&image, 0, 5, LAM_RGBA8, &error), &error, LAM_BAD_ARGUMENT, "0×5");
    expect_error(lam_image_make(&image, 5, -1, LAM_RGBA8, &error), &error, LAM_BAD_ARGUMENT, "5×-1");
    expect_error(lam_image_make(&image, 65536, 5, LAM_RGBA8, &error), &error, LAM_LIMIT, "65535");
    expect_error(lam_image_make(&image, 5, 2147483647, LAM_RGBA8, &error), &error, LAM_LIMIT, "65535");
    expect_error(lam_image_make(&image, 5, 5, (lam_pixel_format)7, &error), &error, LAM_BAD_ARGUMENT, "format 7");
    expect_error(lam_image_make(NULL, 5, 5, LAM_RGBA8, &error), &error, LAM_BAD_ARGUMENT, "image");
    assert_false(lam_image_make(&image, 0, 0, LAM_RGBA8, NULL));
    assert_null(image.pixels);
}

TEST(names_pick_formats)
{
    lam_pixel_format format;
    lam_error error;
    assert_true(lam_image_format_for("a.png", &format, NULL));
    assert_int_equal(format, LAM_RGBA8);
    assert_true(lam_image_format_for("dir.d/A.PPM", &format, NULL));
    assert_int_equal(format, LAM_RGBA8);
    assert_true(lam_image_format_for("x.y.pfm", &format, NULL));
    assert_int_equal(format, LAM_RGBA32F);
    expect_error(lam_image_format_for("a.tif", &format, &error), &error, LAM_UNSUPPORTED,
                 ".png, .ppm, .pfm, .exr, .jpg");
    expect_error(lam_image_format_for("a.pngg", &format, &error), &error, LAM_UNSUPPORTED, "use .png");
    expect_error(lam_image_format_for("dir.png/a", &format, &error), &error, LAM_UNSUPPORTED, "no extension");
    expect_error(lam_image_format_for(NULL, &format, &error), &error, LAM_BAD_ARGUMENT, "path");
}

// Every row of the table: written files can be read, and the list in an error message names each format.
TEST(formats_that_are_written_are_read)
{
    char path[256], wanted[32];
    lam_pixel_format pixels;
    lam_error error, unknown;
    int written = 0, format = 0;
    assert_false(lam_image_format_for("a.bmp", &pixels, &unknown));
    for (const char *name; (name = lam_image_format_name(format)); format++) {
        snprintf(path, sizeof path, "%s/a.%s", folder, name);
        snprintf(wanted, sizeof wanted, ".%s", name);
        if (!lam_image_format_written(format)) {
            assert_false(lam_image_format_for(path, &pixels, &error));
            continue;
        }
        written++;
        assert_non_null(strstr(unknown.text, wanted));
        assert_true(lam_image_format_for(path, &pixels, &error));
        if (lam_image_format_alias(format)) {
            snprintf(wanted, sizeof wanted, "b.%s", lam_image_format_alias(format));
            assert_true(lam_image_format_for(wanted, &pixels, &error));
        }
        lam_image image = pixels == LAM_RGBA8 ? bytes_picture(40, 30) : floats_picture(40, 30), again;
        if (lam_image_save(&image, path, NULL, &error) && !lam_image_format_is_read(format)) {
            assert_false(lam_image_load(&again, path, NULL, &error));
            assert_int_equal(error.code, LAM_UNSUPPORTED);
            unlink(path);
        } else if (access(path, F_OK) == 0) {
            SUCCEEDS(lam_image_load(&again, path, NULL, &error));
            assert_true(again.width == 40 && again.height == 30 && again.format == pixels);
            lam_image_free(&again);
            unlink(path);
        } else {
            assert_int_equal(error.code, LAM_UNSUPPORTED); // without its library
        }
        lam_image_free(&image);
    }
    assert_true(written >= 6 && format >= 9);
    assert_null(lam_image_format_name(-1));
    assert_null(lam_image_format_alias(-1));
    assert_null(lam_image_format_written(format));
}

TEST(encode_checks_its_arguments)
{
    lam_image bytes = bytes_picture(3, 2), floats = floats_picture(3, 2), none = {0};
    AUTO_BYTES out = {&out, 5};
    lam_error error;
    expect_error(lam_image_encode(&bytes, "tif", NULL, &out, &error), &error, LAM_UNSUPPORTED,
                 "png, ppm, pfm, exr, jpg");
    assert_null(out.data);
    expect_error(lam_image_encode(&bytes, "pfm", NULL, &out, &error), &error, LAM_BAD_ARGUMENT, "LAM_RGBA32F");
    expect_error(lam_image_encode(&floats, "png", NULL, &out, &error), &error, LAM_BAD_ARGUMENT, "LAM_RGBA8");
    expect_error(lam_image_encode(&floats, "ppm", NULL, &out, &error), &error, LAM_BAD_ARGUMENT, "PPM");
    expect_error(lam_image_encode(&none, "png", NULL, &out, &error), &error, LAM_BAD_ARGUMENT, "pixels");
    expect_error(lam_image_encode(NULL, "png", NULL, &out, &error), &error, LAM_BAD_ARGUMENT, "pixels");
    expect_error(lam_image_encode(&bytes, NULL, NULL, &out, &error), &error, LAM_BAD_ARGUMENT, "format");
    expect_error(lam_image_encode(&bytes, "png", &(lam_save_params){.threads = -1}, &out, &error), &error,
                 LAM_BAD_ARGUMENT, "threads");
    lam_bytes_free(NULL);
    lam_image_free(&bytes);
    lam_image_free(&floats);
}

TEST(png_comes_back)
{
    const char *path = in_folder("a.png");
    lam_image image = bytes_picture(61, 47), back;
    assert_true(lam_image_save(&image, path, NULL, NULL));
    assert_true(lam_image_load(&back, path, NULL, NULL));
    assert_int_equal(back.width, 61);
    assert_int_equal(back.height, 47);
    assert_int_equal(back.format, LAM_RGBA8);
    assert_memory_equal(back.pixels, image.pixels, 61 * 47 * 4);
    assert_int_equal(files_in_folder(), 1);
    assert_true(lam_image_is_from_lambent(path));
    lam_image_free(&image);
    lam_image_free(&back);
}

TEST(pfm_is_exact)
{
    const char *path = in_folder("a.pfm");
    lam_image image = floats_picture(5, 3), back;
    lam_bytes bytes;
    assert_true(lam_image_encode(&image, "pfm", NULL, &bytes, NULL));
    static const char header[] = "PF\n5 3\n-1.0\n";
    assert_int_equal(bytes.size, sizeof header - 1 + 5 * 3 * 12);
    assert_memory_equal(bytes.data, header, sizeof header - 1);
    // The bottom row comes first.
    assert_memory_equal((uint8_t *)bytes.data + sizeof header - 1, (float *)image.pixels + 2 * 5 * 4, 12);
    lam_bytes_free(&bytes);
    assert_true(lam_image_save(&image, path, NULL, NULL));
    assert_true(lam_image_load(&back, path, NULL, NULL));
    assert_int_equal(back.format, LAM_RGBA32F);
    assert_memory_equal(back.pixels, image.pixels, 5 * 3 * 16); // the source's alpha is 1 everywhere
    assert_false(lam_image_is_from_lambent(path));
    lam_image_free(&image);
    lam_image_free(&back);
}

TEST(pfm_of_others)
{
    // Grey, big-endian, another scale.
    static const char grey[] = "Pf 2\n1\r2.5\n\x3F\x80\x00\x00\xC0\x00\x00\x00";
    AUTO_IMAGE image = {0};
    write_file(in_folder("g.pfm"), grey, sizeof grey - 1);
    assert_true(lam_image_load(&image, in_folder("g.pfm"), NULL, NULL));
    const float wanted[8] = {1, 1, 1, 1, -2, -2, -2, 1};
    assert_memory_equal(image.pixels, wanted, sizeof wanted);
}

static double decode(double x) { return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4); }
static double encode(double x) { return x <= 0.0031308 ? x * 12.92 : 1.055 * pow(x, 1 / 2.4) - 0.055; }

// The picture over the background in linear light, compared with libm.
TEST(ppm_lies_over_the_background)
{
    AUTO_IMAGE image = {0};
    lam_bytes out;
    assert_true(lam_image_make(&image, 256, 256, LAM_RGBA8, NULL));
    uint8_t *pixels = image.pixels;
    for (int alpha = 0; alpha < 256; alpha++)
        for (int color = 0; color < 256; color++, pixels += 4) {
            pixels[0] = (uint8_t)color;
            pixels[1] = (uint8_t)(255 - color);
            pixels[2] = (uint8_t)(color ^ 0x55);
            pixels[3] = (uint8_t)alpha;
        }
    for (int raw = 0; raw < 2; raw++) {
        const lam_rgb background = {0.25f, 0.0f, 1.5f};
        lam_save_params params = {.background = background, .raw = raw};
        assert_true(lam_image_encode(&image, "ppm", &params, &out, NULL));
        static const char header[] = "P6\n# lambent\n256 256\n255\n";
        assert_int_equal(out.size, sizeof header - 1 + 256 * 256 * 3);
        assert_memory_equal(out.data, header, sizeof header - 1);
        const uint8_t *got = (uint8_t *)out.data + sizeof header - 1, *source = image.pixels;
        int near = 0; // where libm's last digits decide
        for (int i = 0; i < 256 * 256; i++)
            for (int channel = 0; channel < 3; channel++) {
                double over = (double)(&background.r)[channel], a = source[4 * i + 3] / 255.0;
                double c = source[4 * i + channel] / 255.0;
                double sum = (raw ? c : decode(c)) * a + over * (1 - a);
                double value = 255 * (raw ? sum : encode(sum));
                value = value < 0 ? 0 : value > 255 ? 255 : value;
                assert_true(fabs(got[3 * i + channel] - value) < 0.501);
                near += got[3 * i + channel] != (int)floor(value + 0.5);
                if (source[4 * i + 3] == 255)
                    assert_int_equal(got[3 * i + channel], source[4 * i + channel]);
            }
        assert_true(near < 100);
        lam_bytes_free(&out);
    }
}

TEST(ppm_comes_back)
{
    lam_image image = bytes_picture(9, 4), back;
    for (int i = 0; i < 9 * 4; i++)
        ((uint8_t *)image.pixels)[4 * i + 3] = 255;
    assert_true(lam_image_save(&image, in_folder("a.ppm"), NULL, NULL));
    assert_true(lam_image_is_from_lambent(in_folder("a.ppm")));
    assert_true(lam_image_load(&back, in_folder("a.ppm"), NULL, NULL));
    assert_memory_equal(back.pixels, image.pixels, 9 * 4 * 4);
    lam_image_free(&image);
    lam_image_free(&back);
}

// A NaN background must not reach an undefined conversion.
TEST(background_of_nan)
{
    AUTO_IMAGE image = bytes_picture(2, 2);
    AUTO_BYTES out = {0};
    ((uint8_t *)image.pixels)[3] = 0;
    lam_save_params params = {.background = {NAN, INFINITY, -INFINITY}};
    assert_true(lam_image_encode(&image, "ppm", &params, &out, NULL));
    const uint8_t *pixel = (uint8_t *)out.data + out.size - 12;
    assert_int_equal(pixel[0], 0);
    assert_int_equal(pixel[1], 255);
    assert_int_equal(pixel[2], 0);
}

TEST(ours_only_where_it_says_so)
{
    static const char foreign[] = "P6\n1 1\n255\nabc";
    assert_false(lam_image_is_from_lambent(in_folder("none.png")));
    assert_false(lam_image_is_from_lambent(folder));
    assert_false(lam_image_is_from_lambent("/dev/null"));
    assert_false(lam_image_is_from_lambent(NULL));
    write_file(in_folder("f.ppm"), foreign, sizeof foreign - 1);
    assert_false(lam_image_is_from_lambent(in_folder("f.ppm")));
    write_file(in_folder("empty.png"), "", 0);
    assert_false(lam_image_is_from_lambent(in_folder("empty.png")));
    assert_int_equal(mkfifo(in_folder("pipe.png"), 0600), 0);
    assert_false(lam_image_is_from_lambent(in_folder("pipe.png"))); // and does not wait for a writer

    // A PNG with another program's Software text, and Lambent's truncated at every byte before the pixels.
    AUTO_IMAGE image = bytes_picture(4, 4);
    AUTO_BYTES out = {0};
    assert_true(lam_image_encode(&image, "png", NULL, &out, NULL));
    uint8_t *text = out.data;
    while (memcmp(text, "lambent", 7) != 0)
        text++;
    const size_t said = (size_t)(text + 7 - (uint8_t *)out.data);
    for (size_t size = 0; size < said; size++) {
        write_file(in_folder("cut.png"), out.data, size);
        assert_false(lam_image_is_from_lambent(in_folder("cut.png")));
    }
    text[0] = 'L';
    write_file(in_folder("other.png"), out.data, out.size);
    assert_false(lam_image_is_from_lambent(in_folder("other.png")));
}

// Files truncated at any byte are refused. Files with one changed byte are refused or, thanks to PNG's checksums, give
// the same picture (a damaged comment does no harm).
TEST(damaged_files_are_refused)
{
    lam_image bytes = bytes_picture(7, 5), floats = floats_picture(3, 2), back;
    lam_error error;
    static const struct {
        const char *format;
        size_t needless; // unneeded bytes at the end: the checksum of PNG's empty last chunk
    } cases[] = {{"png", 4}, {"ppm", 0}, {"pfm", 0}};
    for (int i = 0; i < 3; i++) {
        AUTO_BYTES out = {0};
        assert_true(lam_image_encode(i == 2 ? &floats : &bytes, cases[i].format, NULL, &out, NULL));
        for (size_t size = 0; size < out.size - cases[i].needless; size++) {
            write_file(in_folder("cut"), out.data, size);
            memset(&back, 0xEE, sizeof back);
            expect_error(lam_image_load(&back, in_folder("cut"), NULL, &error), &error, LAM_CANNOT_READ, "/cut: ");
            assert_null(back.pixels);
        }
        uint8_t *data = out.data;
        int refused = 0;
        for (size_t at = 0; at < out.size; at++) {
            data[at] ^= 0x15;
            write_file(in_folder("bad"), out.data, out.size);
            if (lam_image_load(&back, in_folder("bad"), NULL, &error)) {
                if (i == 0)
                    assert_memory_equal(back.pixels, bytes.pixels, 7 * 5 * 4);
                lam_image_free(&back);
            } else {
                refused++;
            }
            data[at] ^= 0x15;
        }
        assert_true(refused > (i == 0 ? (int)out.size / 2 : 4));
    }
    lam_image_free(&bytes);
    lam_image_free(&floats);
}

TEST(refusals_say_why)
{
    static const struct {
        const char *content;
        lam_code code;
        const char *words;
    } cases[] = {
        {"", LAM_CANNOT_READ, "is empty"},
        {"GIF89a", LAM_UNSUPPORTED, "is a GIF picture"},
        {"GIV89a", LAM_CANNOT_READ, "byte 0"},
        {"P6\n0 4\n255\n", LAM_CANNOT_READ, "width of 0"},
        {"P6\n3.5 4\n255\n", LAM_CANNOT_READ, "width of 3.5"},
        {"P6\n3 nan\n255\n", LAM_CANNOT_READ, "height of"},
        {"P6\n70000 1\n255\n", LAM_LIMIT, "65535"},
        {"P6\n1 1e300\n255\n", LAM_LIMIT, "65535"},
        {"P6\n1 1\n65535\nabcdef", LAM_UNSUPPORTED, "65535"},
        {"P6\n# no end", LAM_CANNOT_READ, "no width"},
        {"P6\n1 1 x", LAM_CANNOT_READ, "no number after the height"},
        {"PF\n60000 60000\n-1\nxx", LAM_LIMIT, "60000×60000"},
        {"PF\n20000 20000\n-1\nxx", LAM_CANNOT_READ, "20000×20000"},
        {"PF\n1 1\n0\nabcdabcdabcd", LAM_CANNOT_READ, "scale of 0"},
    };
    lam_image image;
    lam_error error;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_file(in_folder("r"), cases[i].content, strlen(cases[i].content));
        expect_error(lam_image_load(&image, in_folder("r"), NULL, &error), &error, cases[i].code, cases[i].words);
    }
    expect_error(lam_image_load(&image, in_folder("absent.png"), NULL, &error), &error, LAM_CANNOT_READ, "absent.png");
    expect_error(lam_image_load(&image, folder, NULL, &error), &error, LAM_CANNOT_READ, "directory");
    expect_error(lam_image_load(&image, NULL, NULL, &error), &error, LAM_BAD_ARGUMENT, "path");

    // A PNG of 57 bytes that claims 60000×60000 pixels: refused before memory is allocated.
    static const uint8_t bomb[] = {137,  80,   78,   71,   13,   10, 26, 10,   0,    0,  0,  13,   73,   72,   68,
                                   82,   0,    0,    0xEA, 0x60, 0,  0,  0xEA, 0x60, 8,  6,  0,    0,    0,    0x1D,
                                   0x3E, 0x8E, 0x51, 0,    0,    0,  0,  73,   68,   65, 84, 0x35, 0xAF, 0x06, 0x1E};
    write_file(in_folder("bomb.png"), bomb, sizeof bomb);
    assert_false(lam_image_load(&image, in_folder("bomb.png"), NULL, &error));
    assert_int_equal(error.code, LAM_LIMIT);
}

// On any error, no file appears or changes, and no temporary file remains.
TEST(writes_whole_or_not_at_all)
{
    empty_folder(NULL);
    AUTO_IMAGE image = bytes_picture(40, 40);
    lam_error error;
    expect_error(lam_image_save(&image, in_folder("a.pfm"), NULL, &error), &error, LAM_BAD_ARGUMENT, "PFM");
    expect_error(lam_image_save(&image, in_folder("a.bmp"), NULL, &error), &error, LAM_UNSUPPORTED, ".bmp");
    expect_error(lam_image_save(&image, in_folder("sub/a.png"), NULL, &error), &error, LAM_CANNOT_WRITE, "sub/a.png");
    expect_error(lam_image_save(&image, NULL, NULL, &error), &error, LAM_BAD_ARGUMENT, "path");
    assert_int_equal(files_in_folder(), 0);

    // A full device behind a link that ends in .png.
    if (access("/dev/full", W_OK) == 0) {
        assert_int_equal(symlink("/dev/full", in_folder("full.png")), 0);
        expect_error(lam_image_save(&image, in_folder("full.png"), NULL, &error), &error, LAM_CANNOT_WRITE, "full.png");
        assert_int_equal(files_in_folder(), 1);
        unlink(in_folder("full.png"));
    }
    // A folder with the name of the file.
    assert_int_equal(mkdir(in_folder("dir.png"), 0700), 0);
    expect_error(lam_image_save(&image, in_folder("dir.png"), NULL, &error), &error, LAM_CANNOT_WRITE, "dir.png");
    assert_int_equal(files_in_folder(), 1);
    assert_int_equal(rmdir(in_folder("dir.png")), 0);

    // A read-only folder; root may write to it.
    if (geteuid() != 0) {
        assert_int_equal(chmod(folder, 0500), 0);
        expect_error(lam_image_save(&image, in_folder("a.png"), NULL, &error), &error, LAM_CANNOT_WRITE, "a.png");
        assert_int_equal(chmod(folder, 0700), 0);
        assert_int_equal(files_in_folder(), 0);
    }
    // An older file is replaced completely.
    write_file(in_folder("a.png"), "old", 3);
    assert_true(lam_image_save(&image, in_folder("a.png"), NULL, &error));
    assert_true(lam_image_is_from_lambent(in_folder("a.png")));
    assert_int_equal(files_in_folder(), 1);
}

TEST(compares_bytes)
{
    lam_image a = bytes_picture(10, 10), b = bytes_picture(10, 10), other = bytes_picture(10, 9);
    AUTO_IMAGE floats = floats_picture(10, 10);
    lam_difference d;
    lam_error error;
    assert_true(lam_image_compare(&a, &b, &d, NULL));
    assert_true(d.maximum == 0 && d.mean == 0 && d.rmse == 0 && isinf(d.psnr_db) && d.psnr_db > 0);
    uint8_t *pixels = b.pixels;
    for (int i = 0; i < 3; i++) { // differences of 1, 2 and 3 in three pixels
        uint8_t *channel = pixels + 4 * (i * 17) + i;
        *channel = (uint8_t)(*channel > 100 ? *channel - (i + 1) : *channel + (i + 1));
    }
    assert_true(lam_image_compare(&a, &b, &d, NULL));
    expect_near(d.maximum, 3 / 255.0, 1e-12);
    expect_near(d.mean, 6 / 255.0 / 400, 1e-12);
    expect_near(d.rmse, sqrt(14.0 / 400) / 255, 1e-12);
    expect_near(d.psnr_db, -20 * log10(sqrt(14.0 / 400) / 255), 1e-11);
    expect_near(d.share_over_1, 0.02, 1e-12);
    expect_near(d.share_over_2, 0.01, 1e-12);
    expect_error(lam_image_compare(&a, &other, &d, &error), &error, LAM_BAD_ARGUMENT, "10×9");
    expect_error(lam_image_compare(&a, &floats, &d, &error), &error, LAM_BAD_ARGUMENT, "floats");
    expect_error(lam_image_compare(&a, NULL, &d, &error), &error, LAM_BAD_ARGUMENT, "two pictures");
    lam_image_free(&a);
    lam_image_free(&b);
    lam_image_free(&other);
}

TEST(compares_floats)
{
    lam_image a = floats_picture(8, 8), b = floats_picture(8, 8);
    lam_difference d;
    float *first = a.pixels, *second = b.pixels;
    first[5] = second[5] = NAN;
    first[9] = second[9] = INFINITY;
    assert_true(lam_image_compare(&a, &b, &d, NULL));
    assert_true(d.maximum == 0 && isinf(d.psnr_db));
    second[20] = first[20] + 0.25f;
    assert_true(lam_image_compare(&a, &b, &d, NULL));
    assert_true(fabs(d.maximum - 0.25) < 1e-6 && fabs(d.rmse - 0.25 / 16) < 1e-6);
    assert_true(fabs(d.psnr_db - 20 * log10(16 / 0.25)) < 1e-4);
    assert_true(d.share_over_2 == 1 / 64.0);
    second[5] = 0;
    assert_true(lam_image_compare(&a, &b, &d, NULL));
    assert_true(isinf(d.maximum) && isinf(d.mean) && isinf(d.psnr_db) && d.psnr_db < 0);
    // Differences whose square is a denormal number.
    second[5] = NAN;
    second[20] = first[20];
    first[24] = 0.0f;
    second[24] = 1e-40f;
    first[24 + 1] = second[24 + 1] = 0;
    assert_true(lam_image_compare(&a, &b, &d, NULL));
    assert_true(d.maximum > 0.9e-40 && fabs(d.psnr_db - 20 * log10(16 / (double)second[24])) < 1e-6);
    lam_image_free(&a);
    lam_image_free(&b);
}

TEST(shows_differences)
{
    lam_image a, b, where = {0};
    lam_error error;
    assert_true(lam_image_make(&a, 2, 1, LAM_RGBA8, NULL) && lam_image_make(&b, 2, 1, LAM_RGBA8, NULL));
    memcpy(a.pixels, (uint8_t[]){10, 20, 30, 255, 0, 7, 0, 40}, 8);
    memcpy(b.pixels, (uint8_t[]){13, 20, 230, 255, 0, 7, 1, 50}, 8);
    assert_true(lam_image_difference(&a, &b, 2.0f, &where, NULL));
    assert_memory_equal(where.pixels, ((uint8_t[]){6, 0, 255, 255, 20, 20, 20, 255}), 8);
    lam_image_free(&where);
    assert_false(lam_image_difference(&a, &b, NAN, &where, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_false(lam_image_difference(&a, NULL, 1, &where, &error));
    lam_image_free(&b);
    assert_true(lam_image_make(&b, 1, 1, LAM_RGBA8, NULL));
    assert_false(lam_image_difference(&a, &b, 1, &where, &error));
    lam_image_free(&a);
    assert_true(lam_image_make(&a, 1, 1, LAM_RGBA32F, NULL));
    assert_false(lam_image_difference(&a, &b, 1, &where, &error));
    lam_image_free(&b);
    assert_true(lam_image_make(&b, 1, 1, LAM_RGBA32F, NULL));
    memcpy(a.pixels, (float[]){1, INFINITY, NAN, 1}, 16);
    memcpy(b.pixels, (float[]){3, INFINITY, 0, 1}, 16);
    assert_true(lam_image_difference(&a, &b, 0.5f, &where, NULL));
    const float *p = where.pixels;
    assert_true(p[0] == 1 && p[1] == 0 && p[2] == INFINITY && p[3] == 1);
    lam_image_free(&a);
    lam_image_free(&b);
    lam_image_free(&where);
}

FIXTURE(make_folder, remove_folder)
