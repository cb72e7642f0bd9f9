// test_png_read.c: pictures read in one step (png_read.c) have libspng's pixels, and files that libspng refuses are
// refused.
#include "test.h"
#include "dynamic_library.h"
#include "pixels.h"
#include "png_encoding.h"

#include <spng.h>
#include <zlib.h>

// WIDTH × HEIGHT is more than the pixels of the smallest picture that is read in one step.
enum { WIDTH = 151, HEIGHT = 113, FILE_BYTES = 1 << 20 };

static uint32_t random_bits(void)
{
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return state >> 8;
}

struct file {
    uint8_t *bytes;
    size_t size;
};

static void put_u32(struct file *file, uint32_t value)
{
    for (int shift = 24; shift >= 0; shift -= 8)
        file->bytes[file->size++] = (uint8_t)(value >> shift);
}

static void put_chunk(struct file *file, const char *type, const void *data, size_t size)
{
    put_u32(file, (uint32_t)size);
    memcpy(file->bytes + file->size, type, 4);
    if (size)
        memcpy(file->bytes + file->size + 4, data, size);
    uint32_t crc = (uint32_t)crc32(0, file->bytes + file->size, (uInt)size + 4);
    file->size += size + 4;
    put_u32(file, crc);
}

// A fault or a peculiarity of a file.
enum fault {
    NOTHING,
    EMPTY_CHUNKS,
    TEXT_BEFORE,
    TEXT_CRC, // libspng skips it
    TEXT_BEHIND,
    JUNK_BEHIND_END,
    LAST_SOUND = JUNK_BEHIND_END, // faults up to this one are accepted
    PIXELS_CRC,
    END_CRC,
    NO_END,
    CUT_PIXELS,
    TOO_FEW_ROWS,
    ADLER,
    NO_FILTER,
    SPLIT_PIXELS,
    FAULTS
};

// A picture of random filtered bytes, in several chunks. In every second group of eight rows, the filters are 1 and 4,
// whose rows are unfiltered together.
static struct file make_file(int color_type, int channels, enum fault fault)
{
    struct file file = {malloc(FILE_BYTES), 0};
    size_t row = 1 + (size_t)WIDTH * (size_t)channels, rows = HEIGHT - (fault == TOO_FEW_ROWS), bytes = rows * row;
    uint8_t *filtered = malloc(bytes), *compressed = malloc(2 * bytes);
    assert_true(file.bytes && filtered && compressed);
    for (size_t i = 0; i < bytes; i++)
        filtered[i] = (uint8_t)(random_bits() & random_bits());
    for (size_t y = 0; y < rows; y++)
        filtered[y * row] = (uint8_t)((y / 8 + fault) % 2 ? 1 + random_bits() % 2 * 3
                                      : y % 8 < 5         ? y % 8
                                                          : random_bits() % 5);
    if (fault == NO_FILTER)
        filtered[row * (rows - 1)] = 5;
    uLongf size = 2 * bytes;
    assert_int_equal(compress2(compressed, &size, filtered, bytes, 6), Z_OK);
    if (fault == ADLER)
        compressed[size - 1] ^= 1;
    if (fault == CUT_PIXELS)
        size -= 10;
    memcpy(file.bytes, "\x89PNG\r\n\x1a\n", 8);
    file.size = 8;
    uint8_t header[13] = {0, 0, 0, WIDTH, 0, 0, 0, HEIGHT, 8, (uint8_t)color_type};
    put_chunk(&file, "IHDR", header, sizeof header);
    if (fault == TEXT_BEFORE || fault == TEXT_CRC)
        put_chunk(&file, "tEXt", "Title\0a", 7);
    if (fault == TEXT_CRC)
        file.bytes[file.size - 1] ^= 1;
    for (size_t at = 0, part; at < size; at += part) {
        part = size - at < 8192 ? size - at : 8192;
        put_chunk(&file, "IDAT", compressed + at, part);
        if (fault == PIXELS_CRC && at > 0 && at < 16384)
            file.bytes[file.size - 1] ^= 1;
        if (fault == EMPTY_CHUNKS)
            put_chunk(&file, "IDAT", NULL, 0);
        if (fault == SPLIT_PIXELS && at == 0)
            put_chunk(&file, "tEXt", "Title\0a", 7);
    }
    if (fault == TEXT_BEHIND)
        put_chunk(&file, "tEXt", "Title\0a", 7);
    if (fault != NO_END)
        put_chunk(&file, "IEND", NULL, 0);
    if (fault == END_CRC)
        file.bytes[file.size - 1] ^= 1;
    if (fault == JUNK_BEHIND_END)
        memcpy(file.bytes + file.size, "junk", 4), file.size += 4;
    free(filtered);
    free(compressed);
    // A block of exactly this size: a sanitizer detects every read beyond it.
    file.bytes = realloc(file.bytes, file.size);
    assert_non_null(file.bytes);
    return file;
}

// libspng's pixels; false if it refuses the file.
static bool reference(const struct file *file, uint8_t *pixels)
{
    spng_ctx *spng = spng_ctx_new(0);
    bool ok = spng && !spng_set_png_buffer(spng, file->bytes, file->size) &&
              !spng_decode_image(spng, pixels, WIDTH * HEIGHT * 4, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS) &&
              !spng_decode_chunks(spng);
    spng_ctx_free(spng);
    return ok;
}

static const struct {
    int color_type, channels;
} kinds[] = {{0, 1}, {2, 3}, {6, 4}};
enum { KINDS = sizeof kinds / sizeof *kinds };

TEST(test_files)
{
    static uint8_t expected[WIDTH * HEIGHT * 4];
    for (int kind = 0; kind < KINDS; kind++)
        for (enum fault fault = NOTHING; fault < FAULTS; fault++) {
            struct file file = make_file(kinds[kind].color_type, kinds[kind].channels, fault);
            AUTO_IMAGE image = {0};
            lam_error error = {0};
            bool ok = picture_decode(&(struct picture_file){file.bytes, file.size, "a.png", NULL}, &image, &error);
            if (reference(&file, expected) != (fault <= LAST_SOUND) || ok != (fault <= LAST_SOUND))
                fail_msg("kind %d, fault %d: %s", kind, (int)fault, ok ? "read" : error.text);
            if (ok)
                assert_memory_equal(image.pixels, expected, sizeof expected);
            else if (!strstr(error.text, "a.png: PNG pixels: "))
                fail_msg("kind %d, fault %d: %s", kind, (int)fault, error.text);
            free(file.bytes);
        }
}

// Without alpha, three bytes per pixel if the caller accepts them: the same numbers.
TEST(test_opaque)
{
    static uint8_t expected[WIDTH * HEIGHT * 4];
    for (int kind = 0; kind < KINDS; kind++)
        for (enum fault fault = NOTHING; fault <= LAST_SOUND; fault++) {
            struct file file = make_file(kinds[kind].color_type, kinds[kind].channels, fault);
            AUTO_IMAGE image = {0};
            struct picture_file picture = {file.bytes, file.size, "a.png", NULL};
            bool wide;
            assert_true(picture_decode_wide(&picture, &wide, &image, NULL));
            assert_true(reference(&file, expected));
            int bytes = kinds[kind].channels == 4 ? 4 : 3;
            assert_int_equal(image.format, bytes == 4 ? LAM_RGBA8 : LAM_RGB8);
            for (int i = 0; i < WIDTH * HEIGHT; i++)
                assert_memory_equal((uint8_t *)image.pixels + i * bytes, expected + 4 * i, (size_t)bytes);
            free(file.bytes);
        }
}

// Files with a fault, or with data after their pixels, are not read in one step.
TEST(test_at_once)
{
    void *library = library_open("libdeflate.so.0", false, NULL);
    if (!library) {
        print_message("libdeflate is not installed\n");
        skip();
    }
    library_close(library);
    for (int kind = 0; kind < KINDS; kind++)
        for (enum fault fault = NOTHING; fault < FAULTS; fault++) {
            struct file file = make_file(kinds[kind].color_type, kinds[kind].channels, fault);
            struct call_control call;
            call_start(&call, &(lam_control){.memory_limit_bytes = FILE_BYTES});
            struct picture_file picture = {file.bytes, file.size, "a.png", &call};
            AUTO_IMAGE image = {0};
            size_t extra = png_whole_extra(WIDTH, HEIGHT, LAM_RGBA8, kinds[kind].channels);
            assert_true(image_make_larger(&image, WIDTH, HEIGHT, LAM_RGBA8, extra, NULL));
            bool expected = fault <= TEXT_CRC || fault == JUNK_BEHIND_END;
            if (png_read_whole(&picture, kinds[kind].channels, &image) != expected)
                fail_msg("kind %d, fault %d: %s", kind, (int)fault, expected ? "not read" : "read");
            // Without memory for it, it is not read in one step, and no error is reported.
            call_start(&call, &(lam_control){.memory_limit_bytes = 1000});
            assert_false(png_read_whole(&picture, kinds[kind].channels, &image));
            assert_true(call_should_continue(&call) && !call.refused && call.memory_used == 0);
            free(file.bytes);
        }
}
