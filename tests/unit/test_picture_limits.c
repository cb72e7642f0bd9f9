// test_picture_limits.c: reading pictures obeys the limits of the call in every format, and allocates no memory for a
// header that claims too much.
#include "test.h"
#include "codec.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <jpeglib.h>

enum { SIDE = 64, PIXELS = SIDE * SIDE };

struct file {
    uint8_t *bytes;
    size_t size;
};

// --- one file of every format

static struct file make_jpeg(bool progressive)
{
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    unsigned char *bytes = NULL;
    unsigned long size = 0;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = jpeg.image_height = SIDE;
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    if (progressive)
        jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < SIDE; y++) {
        uint8_t row[3 * SIDE];
        for (int i = 0; i < 3 * SIDE; i++)
            row[i] = (uint8_t)(i * y);
        JSAMPROW rows = row;
        jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    return (struct file){bytes, size};
}

static struct file make_hdr(void)
{
    static const char header[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 64\n";
    struct file file = {malloc(sizeof header - 1 + 4 * PIXELS), sizeof header - 1 + 4 * PIXELS};
    assert_non_null(file.bytes);
    memcpy(file.bytes, header, sizeof header - 1);
    memset(file.bytes + sizeof header - 1, 129, 4 * PIXELS);
    return file;
}

// 24 bits per pixel after a header.
static struct file make_plain(const uint8_t *header, size_t size)
{
    struct file file = {malloc(size + 3 * PIXELS), size + 3 * PIXELS};
    assert_non_null(file.bytes);
    memcpy(file.bytes, header, size);
    memset(file.bytes + size, 129, 3 * PIXELS);
    return file;
}

static struct file encode(const char *format, lam_pixel_format pixels)
{
    lam_image image;
    lam_bytes bytes = {0};
    lam_error error = {0};
    assert_true(lam_image_make(&image, SIDE, SIDE, pixels, NULL));
    memset(image.pixels, 0, PIXELS * (pixels == LAM_RGBA8 ? 4 : 16));
    bool ok = lam_image_encode(&image, format, NULL, &bytes, &error);
    if (!ok && error.code != LAM_UNSUPPORTED) // EXR and WebP, if their libraries are missing
        fail_msg("%s", error.text);
    lam_image_free(&image);
    return (struct file){bytes.data, bytes.size};
}

enum { PNG, PPM, PFM, EXR, HDR, JPEG, PROGRESSIVE, BMP, TGA, WEBP, FORMATS };
static const char *const names[FORMATS] = {"a.png", "a.ppm",           "a.pfm", "a.exr", "a.hdr",
                                           "a.jpg", "progressive.jpg", "a.bmp", "a.tga", "a.webp"};
static struct file files[FORMATS];

static int make_files(void **state)
{
    (void)state;
    files[PNG] = encode("png", LAM_RGBA8);
    files[PPM] = encode("ppm", LAM_RGBA8);
    files[PFM] = encode("pfm", LAM_RGBA32F);
    files[EXR] = encode("exr", LAM_RGBA32F);
    files[HDR] = make_hdr();
    files[JPEG] = make_jpeg(false);
    files[PROGRESSIVE] = make_jpeg(true);
    files[BMP] = make_plain(
        (const uint8_t[54]){'B', 'M', [10] = 54, [14] = 40, [18] = SIDE, [22] = SIDE, [26] = 1, [28] = 24}, 54);
    files[WEBP] = encode("webp", LAM_RGBA8);
    files[TGA] = make_plain((const uint8_t[18]){[2] = 2, [12] = SIDE, [14] = SIDE, [16] = 24}, 18);
    return 0;
}

static int free_files(void **state)
{
    (void)state;
    for (int i = 0; i < FORMATS; i++)
        free(files[i].bytes);
    return 0;
}

// --- limits

static bool decode(int i, struct call_control *call, bool linear, lam_image *image, lam_error *error)
{
    struct picture_file file = {files[i].bytes, files[i].size, names[i], call};
    *error = (lam_error){0};
    return linear ? picture_decode_linear(&file, LAM_COLOR_SRGB, image, error) : picture_decode(&file, image, error);
}

// The codecs themselves end within the rows, not only before the first.
TEST(test_cancelled)
{
    lam_cancel cancel = {0};
    struct call_control call;
    call_start(&call, &(lam_control){.cancel = &cancel});
    lam_cancel_raise(&cancel);
    for (int i = 0; i < FORMATS; i++) {
        if (!files[i].bytes)
            continue;
        lam_image image = {0};
        lam_error error = {0};
        struct picture_file file = {files[i].bytes, files[i].size, names[i], &call};
        assert_false(codec_of(file.bytes, file.size, NULL)->read(&file, &image, &error));
        assert_int_equal(error.code, LAM_CANCELLED);
        assert_null(image.pixels);
        assert_int_equal(call.memory_used, 0);
        lam_cancel_clear(&cancel);
        assert_true(decode(i, &call, false, &image, &error));
        picture_free(&call, &image);
        lam_cancel_raise(&cancel);
    }
    // The conversion to linear light likewise.
    struct picture_file file = {.name = "bytes", .call = &call};
    lam_image image;
    lam_error error = {0};
    assert_true(picture_make(&file, SIDE, SIDE, LAM_RGBA8, &image, &error));
    assert_false(picture_linearize(&file, &image, false, LAM_COLOR_SRGB, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    picture_free(&call, &image);
    assert_int_equal(call.memory_used, 0);
}

TEST(test_time)
{
    for (int i = 0; i < FORMATS; i++) {
        struct call_control call;
        call_start(&call, &(lam_control){.time_limit_s = 1e-9});
        lam_image image = {0};
        lam_error error = {0};
        struct picture_file file = {files[i].bytes, files[i].size, names[i], &call};
        assert_false(file.bytes && codec_of(file.bytes, file.size, NULL)->read(&file, &image, &error));
        assert_true(!file.bytes || error.code == LAM_LIMIT);
        assert_null(image.pixels);
    }
}

// The pixels are counted while they exist; a limit just below the required memory refuses the picture.
TEST(test_memory)
{
    for (int i = 0; i < FORMATS; i++) {
        if (!files[i].bytes)
            continue;
        for (int linear = 0; linear < 2; linear++) {
            lam_image image = {0};
            lam_error error;
            struct call_control call;
            call_start(&call, NULL);
            assert_true(decode(i, &call, linear, &image, &error));
            size_t held = PIXELS * (image.format == LAM_RGBA8 ? 4 : 16);
            assert_int_equal(image.format == LAM_RGBA8, !linear && (i < PFM || i > HDR));
            assert_int_equal(call.memory_used, held);
            picture_free(&call, &image);
            assert_int_equal(call.memory_used, 0);

            call_start(&call, &(lam_control){.memory_limit_bytes = held - 1});
            assert_false(decode(i, &call, linear, &image, &error));
            assert_int_equal(error.code, LAM_LIMIT);
            assert_non_null(strstr(error.text, "memory limit"));
            assert_null(image.pixels);
            assert_int_equal(call.memory_used, 0);
        }
    }
    // A progressive JPEG's coefficients also count: 6 bytes per pixel in addition to the 4 of the picture.
    struct call_control call;
    lam_image image;
    lam_error error;
    call_start(&call, &(lam_control){.memory_limit_bytes = 9 * PIXELS});
    assert_true(decode(JPEG, &call, false, &image, &error));
    picture_free(&call, &image);
    assert_false(decode(PROGRESSIVE, &call, false, &image, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    call_start(&call, &(lam_control){.memory_limit_bytes = 10 * PIXELS});
    assert_true(decode(PROGRESSIVE, &call, false, &image, &error));
    assert_int_equal(call.memory_used, 4 * PIXELS);
    picture_free(&call, &image);
}

// --- headers that claim too much

static uint32_t crc_of(const uint8_t *bytes, size_t size)
{
    uint32_t crc = ~0u;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

static void put_big(uint8_t *to, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        to[i] = (uint8_t)(value >> 8 * (bytes - 1 - i));
}

// The file with another size in its header.
static struct file claim(int i, uint32_t width, uint32_t height)
{
    struct file file = {malloc(files[i].size + 64), files[i].size};
    assert_non_null(file.bytes);
    memcpy(file.bytes, files[i].bytes, files[i].size);
    char *text = (char *)file.bytes, *at;
    if (i == PNG) {
        put_big(file.bytes + 16, width, 4);
        put_big(file.bytes + 20, height, 4);
        put_big(file.bytes + 29, crc_of(file.bytes + 12, 17), 4);
    } else if (i == PPM || i == PFM) {
        file.size = (size_t)sprintf(text, i == PPM ? "P6\n%u %u\n255\n" : "PF\n%u %u\n-1.0\n", width, height);
    } else if (i == EXR) {
        at = memmem(text, file.size, "dataWindow\0box2i", 17);
        assert_non_null(at);
        const uint32_t most[2] = {width - 1, height - 1};
        memcpy(at + 17 + 4 + 8, most, sizeof most);
    } else if (i == HDR) {
        file.size = (size_t)sprintf(text, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %u +X %u\n", height, width);
    } else if (i == BMP || i == TGA) {
        const size_t at_width = i == BMP ? 18 : 12, at_height = i == BMP ? 22 : 14;
        for (int k = 0; k < 2; k++) {
            file.bytes[at_width + (size_t)k] = (uint8_t)(width >> 8 * k);
            file.bytes[at_height + (size_t)k] = (uint8_t)(height >> 8 * k);
        }
    } else {
        for (size_t k = 0; k + 9 < file.size; k++) {
            if (file.bytes[k] != 0xff || file.bytes[k + 1] != (i == JPEG ? 0xc0 : 0xc2))
                continue;
            put_big(file.bytes + k + 5, height, 2);
            put_big(file.bytes + k + 7, width, 2);
            break;
        }
    }
    return file;
}

TEST(test_claims)
{
    for (int i = 0; i < FORMATS; i++) {
        if (!files[i].bytes || i == WEBP) // whose header has no room for such a size
            continue;
        struct file large = claim(i, 40000, 20000), most = claim(i, 20000, 20000);
        lam_image image = {0};
        lam_error error = {0};
        struct call_control call;
        // A memory limit of one byte: the size is refused before memory is considered.
        call_start(&call, &(lam_control){.memory_limit_bytes = 1});
        struct picture_file file = {large.bytes, large.size, names[i], &call};
        assert_false(picture_decode(&file, &image, &error));
        assert_int_equal(error.code, LAM_LIMIT);
        if (!strstr(error.text, "40000×20000") || !strstr(error.text, "at most 400000000 (lam_control.pixel_limit)"))
            fail_msg("%s", error.text);
        // 400 million pixels are not refused for their number, but because the file does not contain them (a JPEG of
        // few bytes may) or because of the limit.
        file = (struct picture_file){most.bytes, most.size, names[i], &call};
        assert_false(picture_decode(&file, &image, &error));
        assert_null(strstr(error.text, "pixel_limit"));
        assert_null(image.pixels);
        free(large.bytes);
        free(most.bytes);
    }
}

// --- other things than regular files

TEST(test_kinds)
{
    char folder[] = "/tmp/lambent-limits-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    lam_image image;
    lam_error error;
    assert_false(lam_image_load(&image, folder, NULL, &error));
    assert_non_null(strstr(error.text, "is a directory, expected a file"));
    assert_false(lam_image_load(&image, "/dev/zero", NULL, &error));
    assert_non_null(strstr(error.text, "/dev/zero: is a device, expected a regular file"));
    snprintf(path, sizeof path, "%s/pipe", folder);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_false(lam_image_load(&image, path, NULL, &error)); // and does not wait for a writer
    assert_non_null(strstr(error.text, "/pipe: is a pipe, expected a regular file (- is standard input)"));
    unlink(path);
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    snprintf(address.sun_path, sizeof address.sun_path, "%s/socket", folder);
    int made = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_int_equal(bind(made, (const struct sockaddr *)&address, sizeof address), 0);
    assert_false(lam_image_load(&image, address.sun_path, NULL, &error));
    assert_non_null(strstr(error.text, "/socket: is a socket, expected a regular file"));
    assert_int_equal(error.code, LAM_CANNOT_READ);
    close(made);
    unlink(address.sun_path);
    rmdir(folder);
}

FIXTURE(make_files, free_files)
