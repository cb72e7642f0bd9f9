// test_png.c: PNG files decode to the picture from which they were made, and have the same bytes on every machine. The
// file has more than 600 lines because the encoder's steps, each with a second implementation here, share their test
// pictures.
#include "test.h"
#include "fnv.h"
#include "checksum.h"
#include "deflate.h"
#include "png_encoding.h"

#include <lambent/image.h>

#include <dlfcn.h>
#include <time.h>

#include <spng.h>

static uint64_t random_state;

static uint32_t random_bits(void)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(random_state >> 33);
}

enum content {
    CLEAR,
    OPAQUE_NOISE,
    NOISE,
    GRADIENT,
    OPAQUE_GRADIENT,
    RUNS,
    FLAT,
    LAST_PIXEL,
    GREY,
    OPAQUE_GREY,
    CONTENTS
};

static const char *const content_names[CONTENTS] = {
    "clear", "opaque noise", "noise",      "gradient", "opaque gradient",
    "runs",  "flat",         "last pixel", "grey",     "opaque grey"};

static uint32_t pixel_of(enum content content, int x, int y, int width, int height, uint32_t before)
{
    uint32_t gradient =
        (uint32_t)(x * 255 / width) | (uint32_t)(y * 255 / height) << 8 | (uint32_t)((x + y) & 255) << 16;
    switch (content) {
    case OPAQUE_NOISE:
        return random_bits() << 1 | 0xFF000000u;
    case NOISE:
        return random_bits() << 1 ^ random_bits() >> 3;
    case GRADIENT:
        return x > width / 3 ? gradient | ((uint32_t)x * (uint32_t)y & 255) << 24 : 0;
    case OPAQUE_GRADIENT:
        return gradient | 0xFF000000u;
    case RUNS:
        return random_bits() % 9 ? before : random_bits() & 0x03030303u;
    case FLAT:
        return 0xFF6496C8u;
    case GREY:
    case OPAQUE_GREY: { // smooth, with noise in the lowest bits and a transparent part; matches of all distances
        uint32_t level = ((uint32_t)x * (uint32_t)x / 40 + (uint32_t)y * 3) / 5 + (random_bits() % 7 == 0);
        uint32_t grey = (level & 255) * 0x00010101u;
        return content == OPAQUE_GREY ? grey | 0xFF000000u : (x + y) % 300 > 200 ? 0 : grey | 0xF0000000u;
    }
    case LAST_PIXEL:
        return x == width - 1 && y == height - 1 ? 0x01020304u : 0;
    default:
        return 0;
    }
}

static void make_picture(lam_image *image, int width, int height, enum content content)
{
    lam_error error;
    SUCCEEDS(lam_image_make(image, width, height, LAM_RGBA8, &error));
    random_state = (uint64_t)width * 1000003u + (uint64_t)height * 17 + content;
    uint32_t pixel = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            pixel = pixel_of(content, x, y, width, height, pixel);
            memcpy((uint8_t *)image->pixels + ((size_t)y * (size_t)width + (size_t)x) * 4, &pixel, 4);
        }
}

static lam_bytes encode_as(const lam_image *image, int threads, lam_compress compress)
{
    lam_error error;
    lam_bytes bytes;
    lam_save_params params = {.threads = threads, .compress = compress};
    SUCCEEDS(lam_image_encode(image, "png", &params, &bytes, &error));
    return bytes;
}

static lam_bytes encode(const lam_image *image, int threads) { return encode_as(image, threads, LAM_COMPRESS_FAST); }

// libspng checks every CRC, zlib the Adler-32.
static void decode_and_compare(const lam_bytes *bytes, const lam_image *image, const char *what)
{
    spng_ctx *spng = spng_ctx_new(0);
    assert_non_null(spng);
    spng_set_crc_action(spng, SPNG_CRC_ERROR, SPNG_CRC_ERROR);
    assert_int_equal(spng_set_png_buffer(spng, bytes->data, bytes->size), 0);
    size_t size = 0, wanted = (size_t)image->width * (size_t)image->height * 4;
    int code = spng_decoded_image_size(spng, SPNG_FMT_RGBA8, &size);
    uint8_t *pixels = malloc(wanted);
    assert_non_null(pixels);
    if (!code && size == wanted)
        code = spng_decode_image(spng, pixels, size, SPNG_FMT_RGBA8, 0);
    if (!code)
        code = spng_decode_chunks(spng);
    bool same = !code && size == wanted && memcmp(pixels, image->pixels, wanted) == 0;
    free(pixels);
    spng_ctx_free(spng);
    if (!same)
        fail_msg("%s, %d×%d: %s", what, image->width, image->height, code ? spng_strerror(code) : "other pixels");
}

static void round_trip(int width, int height, enum content content)
{
    AUTO_IMAGE image = {0};
    make_picture(&image, width, height, content);
    AUTO_BYTES bytes = encode(&image, 1);
    decode_and_compare(&bytes, &image, content_names[content]);
    const uint8_t *data = bytes.data;
    static const uint8_t end[12] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};
    assert_memory_equal(data + bytes.size - 12, end, 12);
}

TEST(decodes_to_the_source)
{
    static const int sizes[][2] = {{1, 1},   {2, 1},    {1, 2},     {3, 3},   {4, 7},    {5, 64},   {15, 16},
                                   {16, 15}, {17, 17},  {31, 9},    {33, 2},  {63, 65},  {86, 86},  {87, 3},
                                   {88, 5},  {129, 97}, {255, 257}, {300, 3}, {515, 70}, {1024, 64}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int content = 0; content < CONTENTS; content++)
            round_trip(sizes[i][0], sizes[i][1], content);
}

TEST(decodes_at_the_limits_of_size)
{
    for (int content = 0; content < CONTENTS; content++) {
        round_trip(65535, 1, content);
        round_trip(1, 65535, content);
        round_trip(65535, 3, content);
    }
    round_trip(3, 65535, RUNS);
}

// Every length of a run from 1 to 700 bytes and more, in both pixel sizes, at several offsets.
TEST(holds_runs_of_every_length)
{
    for (int opaque = 0; opaque < 2; opaque++) {
        AUTO_IMAGE image = {0};
        lam_error error;
        assert_true(lam_image_make(&image, 256, 256, LAM_RGBA8, &error));
        for (int y = 0; y < 256; y++)
            for (int x = 0; x < 256; x++) {
                // A first run of y pixels and a second of the rest; after filtering, there are also runs of all
                // lengths.
                uint32_t value = x < y ? 0x00112233u : 0x00445566u + (uint32_t)(y % 3);
                value |= opaque ? 0xFF000000u : 0x80000000u;
                memcpy((uint8_t *)image.pixels + (y * 256 + x) * 4, &value, 4);
            }
        AUTO_BYTES bytes = encode(&image, 1);
        decode_and_compare(&bytes, &image, "staircase");
        assert_true(bytes.size < 256 * 40);
    }
}

TEST(threads_change_nothing)
{
    static const int sizes[][2] = {{1024, 700}, {333, 1001}, {65535, 5}, {7, 50000}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int content = NOISE; content < CONTENTS; content++) {
            AUTO_IMAGE image = {0};
            make_picture(&image, sizes[i][0], sizes[i][1], content);
            lam_bytes one = encode(&image, 1), two = encode(&image, 2), five = encode(&image, 5);
            assert_int_equal(one.size, two.size);
            assert_int_equal(one.size, five.size);
            assert_memory_equal(one.data, two.data, one.size);
            assert_memory_equal(one.data, five.data, one.size);
            lam_bytes_free(&one);
            lam_bytes_free(&two);
            lam_bytes_free(&five);
        }
}

// One hash for each picture, the same for every compiler, build type and instruction set. They change only if the
// encoder is meant to write other bytes; in this case, also check the sizes.
TEST(bytes_are_the_recorded_ones)
{
    static const struct {
        enum content content;
        size_t size;
        uint64_t hash;
    } recorded[] = {
        {CLEAR, 906, 0x5ce9e9b42c821d68},       {NOISE, 430016, 0x959081525ee6b91e},
        {GRADIENT, 105781, 0xcef7b54a13700460}, {OPAQUE_GRADIENT, 1628, 0x67049af9e1054640},
        {GREY, 27416, 0xcbf463859ac8c4d8},      {OPAQUE_GREY, 23795, 0xb703f10897ca298b},
        {RUNS, 36247, 0xc1d09b25293ad2ca},
    };
    int wrong = 0;
    for (size_t i = 0; i < sizeof recorded / sizeof *recorded; i++) {
        AUTO_IMAGE image = {0};
        make_picture(&image, 509, 211, recorded[i].content);
        AUTO_BYTES bytes = encode(&image, 2);
        uint64_t hash = hash_of(bytes.data, bytes.size);
        if (hash != recorded[i].hash || bytes.size != recorded[i].size) {
            print_message("%s: %zu bytes, 0x%016llx\n", content_names[recorded[i].content], bytes.size,
                          (unsigned long long)hash);
            wrong++;
        }
    }
    assert_int_equal(wrong, 0);
}

// False, with a message, if libdeflate is not installed.
static bool have_best(void)
{
    lam_image image;
    lam_bytes bytes;
    lam_error error;
    make_picture(&image, 3, 3, NOISE);
    bool have = lam_image_encode(&image, "png", &(lam_save_params){.compress = LAM_COMPRESS_BEST}, &bytes, &error);
    lam_image_free(&image);
    if (have) {
        lam_bytes_free(&bytes);
    } else {
        assert_int_equal(error.code, LAM_UNSUPPORTED);
        assert_non_null(strstr(error.text, "libdeflate"));
        print_message("skipped: %s\n", error.text);
    }
    return have;
}

// The best compression: strips of several rows and of one; the same pixels in fewer bytes, for any number of threads.
TEST(best_files_decode)
{
    if (!have_best())
        skip();
    static const int sizes[][2] = {{1, 1},   {3, 3},    {5, 64},    {16, 15},  {87, 3},
                                   {129, 9}, {200, 40}, {65535, 9}, {600, 900}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int content = 0; content < CONTENTS; content++) {
            const bool large = sizes[i][0] * sizes[i][1] > 100000;
            if (large && content != RUNS && content != OPAQUE_NOISE) // others are slow
                continue;
            AUTO_IMAGE image = {0};
            make_picture(&image, sizes[i][0], sizes[i][1], content);
            lam_bytes bytes = encode_as(&image, 1, LAM_COMPRESS_BEST), fast = encode(&image, 1);
            decode_and_compare(&bytes, &image, content_names[content]);
            if (bytes.size > fast.size + fast.size / 4096 + 16)
                fail_msg("%s, %d×%d: %zu bytes, %zu by the fast way", content_names[content], sizes[i][0], sizes[i][1],
                         bytes.size, fast.size);
            if (large) {
                AUTO_BYTES three = encode_as(&image, 3, LAM_COMPRESS_BEST);
                assert_int_equal(bytes.size, three.size);
                assert_memory_equal(bytes.data, three.data, bytes.size);
            }
            lam_bytes_free(&bytes);
            lam_bytes_free(&fast);
        }
}

// The time limit is reached during the picture, and the call ends long before it would be done.
TEST(best_keeps_its_time)
{
    if (!have_best())
        skip();
    AUTO_IMAGE image = {0};
    make_picture(&image, 3000, 2000, GREY); // some 15 seconds of work
    lam_control control = {.time_limit_s = 0.2};
    lam_save_params params = {.control = &control, .threads = 1, .compress = LAM_COMPRESS_BEST};
    lam_bytes bytes;
    lam_error error;
    struct timespec start, end;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &start);
    assert_false(lam_image_encode(&image, "png", &params, &bytes, &error));
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    assert_int_equal(error.code, LAM_LIMIT);
    assert_null(bytes.data);
    assert_true(end.tv_sec - start.tv_sec < 5);
}

static void *no_memory(size_t size)
{
    (void)size;
    return NULL;
}

// Running out of memory in libdeflate is also an error.
TEST(best_without_memory)
{
    if (!have_best())
        skip();
    void *library = dlopen("libdeflate.so.0", RTLD_NOW | RTLD_LOCAL);
    assert_non_null(library);
    void (*set_allocator)(void *(*)(size_t), void (*)(void *));
    *(void **)&set_allocator = dlsym(library, "libdeflate_set_memory_allocator");
    assert_non_null(set_allocator);
    AUTO_IMAGE image = {0};
    make_picture(&image, 300, 200, NOISE);
    lam_save_params params = {.compress = LAM_COMPRESS_BEST};
    lam_bytes bytes;
    lam_error error;
    set_allocator(no_memory, free);
    bool ok = lam_image_encode(&image, "png", &params, &bytes, &error);
    set_allocator(malloc, free);
    assert_false(ok);
    assert_int_equal(error.code, LAM_MACHINE);
    assert_null(bytes.data);
    dlclose(library);
}

// A cancelled call, with either compression, gives an error and no bytes.
TEST(stops_when_cancelled)
{
    AUTO_IMAGE image = {0};
    make_picture(&image, 400, 300, GRADIENT);
    const int last = have_best() ? LAM_COMPRESS_BEST : LAM_COMPRESS_FAST;
    for (int compress = LAM_COMPRESS_FAST; compress <= last; compress++) {
        lam_cancel cancel = {0};
        lam_cancel_raise(&cancel);
        lam_control control = {.cancel = &cancel};
        lam_save_params params = {.control = &control, .compress = (lam_compress)compress};
        lam_bytes bytes;
        lam_error error;
        assert_false(lam_image_encode(&image, "png", &params, &bytes, &error));
        assert_int_equal(error.code, LAM_CANCELLED);
        assert_null(bytes.data);
    }
}

static const uint8_t *find_chunk(const lam_bytes *bytes, const char *type)
{
    const uint8_t *data = bytes->data;
    for (size_t at = 8; at + 12 <= bytes->size;) {
        if (memcmp(data + at + 4, type, 4) == 0)
            return data + at;
        at += ((size_t)data[at] << 24 | (size_t)data[at + 1] << 16 | (size_t)data[at + 2] << 8 | data[at + 3]) + 12;
    }
    return NULL;
}

TEST(chunks_say_what_is_in_it)
{
    AUTO_IMAGE image = {0};
    lam_bytes bytes;
    make_picture(&image, 40, 30, GRADIENT);
    assert_true(lam_image_encode(&image, "png", NULL, &bytes, NULL));
    const uint8_t *header = find_chunk(&bytes, "IHDR"), *text = find_chunk(&bytes, "tEXt");
    assert_int_equal(header[8 + 8], 8);
    assert_int_equal(header[8 + 9], 6); // RGBA
    assert_non_null(find_chunk(&bytes, "sRGB"));
    assert_non_null(text);
    assert_memory_equal(text + 8, "Software\0lambent", 16);
    lam_bytes_free(&bytes);

    assert_true(lam_image_encode(&image, "png", &(lam_save_params){.raw = true}, &bytes, NULL));
    assert_null(find_chunk(&bytes, "sRGB"));
    lam_bytes_free(&bytes);
}

static int color_type(const lam_image *image, int threads, lam_compress compress)
{
    lam_bytes bytes = encode_as(image, threads, compress);
    decode_and_compare(&bytes, image, "color type");
    const int type = find_chunk(&bytes, "IHDR")[8 + 9];
    lam_bytes_free(&bytes);
    return type;
}

enum { TYPE_GREY = 0, TYPE_RGB = 2, TYPE_GREY_ALPHA = 4, TYPE_RGBA = 6 };

TEST(the_fewest_channels_are_written)
{
    static const int expected[CONTENTS] = {
        [CLEAR] = TYPE_GREY_ALPHA,    [OPAQUE_NOISE] = TYPE_RGB, [NOISE] = TYPE_RGBA, [GRADIENT] = TYPE_RGBA,
        [OPAQUE_GRADIENT] = TYPE_RGB, [RUNS] = TYPE_RGBA,        [FLAT] = TYPE_RGB,   [LAST_PIXEL] = TYPE_RGBA,
        [GREY] = TYPE_GREY_ALPHA,     [OPAQUE_GREY] = TYPE_GREY};
    const bool best = have_best();
    for (int content = 0; content < CONTENTS; content++) {
        char path[] = "/tmp/lambent-png-XXXXXX.png";
        int file = mkstemps(path, 4);
        assert_true(file >= 0);
        close(file);
        AUTO_IMAGE image = {0};
        make_picture(&image, 90, 40, content);
        for (int compress = LAM_COMPRESS_FAST; compress <= (best ? LAM_COMPRESS_BEST : LAM_COMPRESS_FAST); compress++) {
            assert_int_equal(color_type(&image, 1, (lam_compress)compress), expected[content]);
            lam_save_params params = {.compress = (lam_compress)compress};
            assert_true(lam_image_save(&image, path, &params, NULL));
            assert_true(lam_image_is_from_lambent(path));
            AUTO_IMAGE back = {0};
            assert_true(lam_image_load(&back, path, NULL, NULL));
            assert_memory_equal(back.pixels, image.pixels, 90 * 40 * 4);
        }
        unlink(path);
    }
}

// A picture of one pixel; and a single pixel, first or last, that the others' channels cannot represent.
TEST(one_pixel_decides)
{
    static const struct {
        uint32_t pixel;
        int alone, in_grey, in_grey_alpha, in_rgb;
    } rows[] = {
        {0xFF808080u, TYPE_GREY, TYPE_GREY, TYPE_GREY_ALPHA, TYPE_RGB},
        {0xFE808080u, TYPE_GREY_ALPHA, TYPE_GREY_ALPHA, TYPE_GREY_ALPHA, TYPE_RGBA},
        {0x00808080u, TYPE_GREY_ALPHA, TYPE_GREY_ALPHA, TYPE_GREY_ALPHA, TYPE_RGBA},
        {0xFF808081u, TYPE_RGB, TYPE_RGB, TYPE_RGBA, TYPE_RGB},    // red
        {0xFF818080u, TYPE_RGB, TYPE_RGB, TYPE_RGBA, TYPE_RGB},    // blue
        {0x00010000u, TYPE_RGBA, TYPE_RGBA, TYPE_RGBA, TYPE_RGBA}, // the colour of a transparent pixel is kept
    };
    enum { WIDTH = 700, HEIGHT = 400 }; // several strips
    static const enum content contents[3] = {OPAQUE_GREY, GREY, OPAQUE_GRADIENT};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        uint32_t pixel = rows[i].pixel;
        lam_image one = {.width = 1, .height = 1, .format = LAM_RGBA8, .pixels = &pixel};
        assert_int_equal(color_type(&one, 1, LAM_COMPRESS_FAST), rows[i].alone);
        const int expected[3] = {rows[i].in_grey, rows[i].in_grey_alpha, rows[i].in_rgb};
        for (int k = 0; k < 3; k++)
            for (int last = 0; last < 2; last++) {
                AUTO_IMAGE image = {0};
                make_picture(&image, WIDTH, HEIGHT, contents[k]);
                ((uint32_t *)image.pixels)[last ? WIDTH * HEIGHT - 1 : 0] = pixel;
                for (int threads = 1; threads <= 3; threads += 2)
                    assert_int_equal(color_type(&image, threads, LAM_COMPRESS_FAST), expected[k]);
            }
    }
}

TEST(checksums_are_the_published_ones)
{
    struct crc_tables tables;
    crc_tables_make(&tables);
    assert_int_equal(crc_of(&tables, (const uint8_t *)"123456789", 9),
                     0xCBF43926u); // the CRC catalogue's check value
    assert_int_equal(crc_of(&tables, (const uint8_t *)"IEND", 4), 0xAE426082u);
    struct adler_part part = {0};
    for (const char *c = "Wikipedia"; *c; c++)
        adler_byte(&part, (uint8_t)*c);
    assert_int_equal(adler_value(&part), 0x11E60398u);
}

// Compares a row with the definition of Adler-32, byte by byte, for all pixel sizes and every tail.
TEST(adler_of_rows)
{
    uint32_t *row = calloc(65536 + 16, 4);
    assert_non_null(row);
    random_state = 5;
    for (int bytes_per_pixel = 1; bytes_per_pixel <= 4; bytes_per_pixel++)
        for (int i = 0; i < 120; i++) {
            int width = i < 100 ? i + 1 : i < 119 ? 100 + (int)(random_bits() % 5000) : 65535;
            uint32_t mask = 0xFFFFFFFFu >> (32 - 8 * bytes_per_pixel);
            memset(row, 0, (65536 + 16) * 4);
            for (int x = 0; x < width; x++)
                row[x] = (i % 3 ? random_bits() << 1 : 0xFFFFFFFFu) & mask;
            struct adler_part part = {0};
            adler_byte(&part, 4);
            adler_row(&part, row, width, bytes_per_pixel);
            uint32_t low = 1 + 4, high = 1 + 4;
            for (int x = 0; x < width; x++)
                for (int channel = 0; channel < bytes_per_pixel; channel++) {
                    low = (low + (row[x] >> 8 * channel & 255)) % 65521;
                    high = (high + low) % 65521;
                }
            assert_int_equal(adler_value(&part), high << 16 | low);
            struct adler_part whole = {0};
            adler_byte(&whole, 4);
            if (bytes_per_pixel == 4)
                adler_bytes(&whole, (const uint8_t *)row, (size_t)width * 4);
            assert_true(bytes_per_pixel < 4 || adler_value(&whole) == adler_value(&part));
        }
    free(row);
}

static int plain_paeth(int a, int b, int c)
{
    int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

// Compares the filters with the specification, for every combination of left, above and above left in steps.
TEST(filters_as_specified)
{
    enum { WIDTH = 53 };
    uint8_t rows[2][WIDTH * 4];
    uint32_t out[(WIDTH + 3) / 4 * 4], fewer[(WIDTH + 3) / 4 * 4];
    random_state = 9;
    for (int round = 0; round < 3000; round++) {
        int width = 1 + (int)(random_bits() % WIDTH);
        uint32_t spread = round % 4 == 0 ? 3 : 255;
        for (int i = 0; i < WIDTH * 8; i++)
            rows[i / (WIDTH * 4)][i % (WIDTH * 4)] = (uint8_t)(random_bits() & spread);
        const uint8_t *above = rows[0], *row = rows[1];
        for (int filter = 0; filter <= 4; filter++) {
            memset(out, 0xEE, sizeof out);
            png_filter_row((enum png_filter)filter, row, above, width, 4, out);
            uint64_t cost = 0;
            for (int i = 0; i < width * 4; i++) {
                int a = i >= 4 ? row[i - 4] : 0, b = above[i], c = i >= 4 ? above[i - 4] : 0;
                const int predicted[5] = {0, a, b, (a + b) / 2, plain_paeth(a, b, c)};
                uint8_t wanted = (uint8_t)(row[i] - predicted[filter]);
                assert_int_equal(((uint8_t *)out)[i], wanted);
                cost += (uint64_t)abs((int8_t)wanted);
            }
            for (int i = width; i < (width + 3) / 4 * 4; i++)
                assert_int_equal(out[i], 0);
            assert_int_equal(png_filter_cost(out, width), cost);
            // Fewer channels: red; red and alpha; red, green and blue.
            for (int bytes_per_pixel = 1; bytes_per_pixel < 4; bytes_per_pixel++) {
                memset(fewer, 0xEE, sizeof fewer);
                png_filter_row((enum png_filter)filter, row, above, width, bytes_per_pixel, fewer);
                for (int i = 0; i < (width + 3) / 4 * 4; i++)
                    assert_int_equal(fewer[i], bytes_per_pixel == 1   ? out[i] & 0xFF
                                               : bytes_per_pixel == 2 ? (out[i] & 0xFF) | (out[i] >> 24) << 8
                                                                      : out[i] & 0xFFFFFF);
            }
        }
    }
}

// Zeros at a row's ends are skipped: the rest is filtered, summed and compressed like the whole row.
static void compare_ends_of_zeros(int bytes_per_pixel)
{
    enum { WIDTH = 150, ROWS = 6, WORDS = WIDTH + 4 };
    static uint32_t rows[ROWS + 1][WIDTH], whole[WORDS], part[WORDS];
    struct arena arena;
    struct deflate deflates[2];
    arena_start(&arena, NULL);
    for (int i = 0; i < 2; i++)
        assert_true(deflate_make(&deflates[i], &arena, WIDTH, ROWS, bytes_per_pixel));
    uint8_t *out[2] = {malloc(deflate_capacity(WIDTH, ROWS, bytes_per_pixel)),
                       malloc(deflate_capacity(WIDTH, ROWS, bytes_per_pixel))};
    random_state = 11;
    int passed = 0;
    for (int round = 0; round < 400; round++) {
        int width = WIDTH - (int)(random_bits() % 20) * (round % 3 == 0);
        memset(rows, 0, sizeof rows);
        for (int y = 1; y <= ROWS; y++) {
            int first = (int)(random_bits() % (unsigned)width), end = (int)(random_bits() % (unsigned)width);
            uint32_t few = round % 2 ? 0x01010101u : 0xFFFFFFFFu;
            for (int x = first; x < end; x++)
                rows[y][x] = x % 7 < 3 && x > first ? rows[y][x - 1] : random_bits() * 3 & few;
        }
        enum png_filter filter = (enum png_filter)(round % 5);
        struct adler_part sums[2] = {{0}, {0}};
        for (int i = 0; i < 2; i++) {
            deflates[i].width = width;
            deflate_start(&deflates[i], (uint8_t)filter, round / 5 % 2);
        }
        for (int y = 1; y <= ROWS; y++) {
            const uint8_t *row = (const uint8_t *)rows[y], *above = (const uint8_t *)rows[y - 1];
            struct png_span span = png_span_filtered(png_span_of(row, width), png_span_of(above, width), width);
            assert_in_range(span.first, 0, span.end);
            assert_in_range(span.end, 0, width);
            passed += width - (span.end - span.first);
            png_filter_row(filter, row, above, width, bytes_per_pixel, whole);
            memset(part, 0, sizeof part);
            png_filter_row(filter, row + 4 * span.first, above + 4 * span.first, span.end - span.first, bytes_per_pixel,
                           part + span.first);
            assert_memory_equal(whole, part, (size_t)width * 4);
            adler_row(&sums[0], whole, width, bytes_per_pixel);
            adler_zeros(&sums[1], (uint64_t)span.first * (unsigned)bytes_per_pixel);
            adler_row(&sums[1], part + span.first, span.end - span.first, bytes_per_pixel);
            adler_zeros(&sums[1], (uint64_t)(width - span.end) * (unsigned)bytes_per_pixel);
            assert_int_equal(adler_value(&sums[0]), adler_value(&sums[1]));
            for (int i = 0; i < 2; i++)
                memcpy(deflates[i].row, whole, (size_t)width * 4);
            deflate_row(&deflates[0], 0, width);
            deflate_row(&deflates[1], span.first, span.end);
        }
        size_t size = deflate_write(&deflates[0], out[0]);
        assert_int_equal(deflate_write(&deflates[1], out[1]), size);
        assert_memory_equal(out[0], out[1], size);
    }
    assert_true(passed > 400 * ROWS * WIDTH / 4);
    free(out[0]);
    free(out[1]);
    arena_free(&arena);
}

TEST(ends_of_zeros_change_nothing)
{
    for (int bytes_per_pixel = 1; bytes_per_pixel <= 4; bytes_per_pixel++)
        compare_ends_of_zeros(bytes_per_pixel);
}

// Codes of limited length: complete (Kraft's sum is 1), within the limit, and more frequent ones are never longer.
TEST(codes_are_complete)
{
    random_state = 3;
    for (int round = 0; round < 400; round++) {
        uint32_t counts[286] = {0};
        int used = 0, limit = round % 2 ? 14 : 9;
        uint32_t a = 1, b = 1;
        for (int i = 0; i < 286; i++) {
            if (round % 5 == 0) { // Fibonacci numbers make the deepest tree
                counts[i] = i < 29 ? a : 0;
                uint32_t next = a + b;
                a = b;
                b = i < 29 ? next : 1;
            } else {
                counts[i] = random_bits() % 3 ? random_bits() % (1u << (random_bits() % 18)) : 0;
            }
            used += counts[i] > 0;
        }
        uint8_t lengths[286];
        huffman_lengths(counts, 286, limit, lengths);
        uint32_t places = 0;
        for (int i = 0; i < 286; i++) {
            assert_true((lengths[i] > 0) == (counts[i] > 0));
            assert_true(lengths[i] <= limit);
            places += lengths[i] ? 1u << (limit - lengths[i]) : 0;
            for (int j = 0; j < i; j++)
                if (counts[i] > counts[j] && counts[j] > 0)
                    assert_true(lengths[i] <= lengths[j]);
        }
        assert_true(used < 2 || places == 1u << limit);
    }
    uint32_t one[4] = {0, 0, 7, 0};
    uint8_t lengths[4];
    huffman_lengths(one, 4, 14, lengths);
    assert_int_equal(lengths[2], 1);
    assert_int_equal(lengths[0] + lengths[1] + lengths[3], 0);
}

// Each allocation fails once: the result is an error, and nothing leaks (which a leak checker verifies).
TEST(survives_without_memory)
{
    const int last = have_best() ? LAM_COMPRESS_BEST : LAM_COMPRESS_FAST;
    for (int compress = LAM_COMPRESS_FAST; compress <= last; compress++) {
        AUTO_IMAGE image = {0};
        make_picture(&image, compress ? 100 : 1024, 300, GRADIENT);
        int failures = 0;
        for (long countdown = 0;; countdown++) {
            arena_fail_after(countdown);
            lam_save_params params = {.threads = 1, .compress = (lam_compress)compress};
            lam_bytes bytes;
            lam_error error;
            bool ok = lam_image_encode(&image, "png", &params, &bytes, &error);
            arena_fail_after(-1);
            if (ok) {
                lam_bytes_free(&bytes);
                break;
            }
            assert_int_equal(error.code, LAM_MACHINE);
            assert_null(bytes.data);
            failures++;
        }
        assert_true(failures >= 4);
    }
}
