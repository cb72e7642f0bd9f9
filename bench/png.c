// png.c: encodes one picture as PNG with Lambent, libpng and libdeflate alternately: `png PICTURE.png ROUNDS`. It
// prints a line of JSON with the median milliseconds and the number of bytes of each encoder. Every result is first
// decoded and compared with the picture.
//
// libpng uses its default filters (all five, chosen for each row by their sums) at levels 1 and 6. libdeflate has no
// PNG encoder. The program itself applies the filter Up to the picture, and libdeflate compresses the result at level
// 1. This is the fastest way to write a PNG with libdeflate.
#include <lambent/image.h>

#include <libdeflate.h>
#include <png.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LAMBENT, LAMBENT_ONE_THREAD, LIBPNG_1, LIBPNG_6, LIBDEFLATE_1, ENCODERS, ROUNDS_MOST = 1000 };
static const char *const names[ENCODERS] = {"lambent", "lambent_one_thread", "libpng_1", "libpng_6", "libdeflate_1"};

struct growing {
    unsigned char *bytes;
    size_t size, room;
};

static void stop(const char *what, const char *why)
{
    fprintf(stderr, "png: %s: %s\n", what, why);
    exit(1);
}

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static void append(struct growing *out, const void *bytes, size_t size)
{
    if (out->size + size > out->room) {
        out->room = 2 * out->room + size + 65536;
        out->bytes = realloc(out->bytes, out->room);
        if (!out->bytes)
            stop("memory", "none left");
    }
    memcpy(out->bytes + out->size, bytes, size);
    out->size += size;
}

static void write_libpng(png_structp png, png_bytep bytes, png_size_t size)
{
    append(png_get_io_ptr(png), bytes, size);
}
static void flush_libpng(png_structp png) { (void)png; }

static void encode_libpng(const lam_image *image, int level, struct growing *out)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info || setjmp(png_jmpbuf(png)))
        stop("libpng", "cannot encode");
    png_set_write_fn(png, out, write_libpng, flush_libpng);
    png_set_compression_level(png, level);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8, PNG_COLOR_TYPE_RGBA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < image->height; y++)
        png_write_row(png, (png_const_bytep)image->pixels + 4 * (size_t)y * (size_t)image->width);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
}

static void put_chunk(struct growing *out, const char *type, const unsigned char *bytes, size_t size)
{
    unsigned char number[4] = {(unsigned char)(size >> 24), (unsigned char)(size >> 16), (unsigned char)(size >> 8),
                               (unsigned char)size};
    append(out, number, 4);
    size_t start = out->size;
    append(out, type, 4);
    append(out, bytes, size);
    uint32_t sum = libdeflate_crc32(0, out->bytes + start, size + 4);
    for (int i = 0; i < 4; i++)
        number[i] = (unsigned char)(sum >> (24 - 8 * i));
    append(out, number, 4);
}

static void encode_libdeflate(const lam_image *image, struct growing *out)
{
    size_t row = 4 * (size_t)image->width, height = (size_t)image->height, size = (row + 1) * height;
    unsigned char *filtered = malloc(size);
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(1);
    size_t room = compressor ? libdeflate_zlib_compress_bound(compressor, size) : 0;
    unsigned char *packed = malloc(room + 1);
    if (!filtered || !compressor || !packed)
        stop("libdeflate", "no memory");
    const unsigned char *pixels = image->pixels;
    for (size_t y = 0; y < height; y++) {
        unsigned char *to = filtered + (row + 1) * y;
        const unsigned char *here = pixels + row * y;
        *to++ = y ? 2 : 0;
        for (size_t x = 0; x < row; x++)
            to[x] = (unsigned char)(here[x] - (y ? here[x - row] : 0));
    }
    size_t packed_size = libdeflate_zlib_compress(compressor, filtered, size, packed, room);
    unsigned char header[13] = {0};
    for (int i = 0; i < 4; i++) {
        header[i] = (unsigned char)(image->width >> (24 - 8 * i));
        header[4 + i] = (unsigned char)(image->height >> (24 - 8 * i));
    }
    header[8] = 8, header[9] = 6;
    append(out, "\x89PNG\r\n\x1a\n", 8);
    put_chunk(out, "IHDR", header, 13);
    put_chunk(out, "IDAT", packed, packed_size);
    put_chunk(out, "IEND", header, 0);
    libdeflate_free_compressor(compressor);
    free(filtered);
    free(packed);
}

static void encode(int encoder, const lam_image *image, struct growing *out)
{
    out->size = 0;
    lam_save_params params = {.threads = encoder == LAMBENT_ONE_THREAD};
    lam_bytes bytes = {0};
    lam_error error = {0};
    switch (encoder) {
    case LIBPNG_1:
    case LIBPNG_6:
        encode_libpng(image, encoder == LIBPNG_1 ? 1 : 6, out);
        break;
    case LIBDEFLATE_1:
        encode_libdeflate(image, out);
        break;
    default:
        if (!lam_image_encode(image, "png", &params, &bytes, &error))
            stop("lambent", error.text);
        free(out->bytes);
        *out = (struct growing){bytes.data, bytes.size, bytes.size};
    }
}

// Decodes an encoder's result with libpng and compares it with the picture.
static void verify(const char *name, const struct growing *out, const lam_image *image)
{
    png_image reader = {.version = PNG_IMAGE_VERSION};
    size_t size = 4 * (size_t)image->width * (size_t)image->height;
    unsigned char *pixels = malloc(size);
    if (!pixels || !png_image_begin_read_from_memory(&reader, out->bytes, out->size))
        stop(name, "its PNG cannot be read");
    reader.format = PNG_FORMAT_RGBA;
    if (!png_image_finish_read(&reader, NULL, pixels, 0, NULL) || memcmp(pixels, image->pixels, size) != 0)
        stop(name, "its PNG holds another picture");
    free(pixels);
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int count, char **arguments)
{
    static double times[ENCODERS][ROUNDS_MOST];
    lam_image image = {0};
    lam_error error = {0};
    int rounds = count == 3 ? atoi(arguments[2]) : 0;
    if (rounds < 1 || rounds > ROUNDS_MOST)
        stop("usage", "png PICTURE.png ROUNDS, 1 to 1000");
    if (!lam_image_load(&image, arguments[1], NULL, &error) || image.format != LAM_RGBA8)
        stop(arguments[1], *error.text ? error.text : "is no 8-bit picture");
    struct growing out[ENCODERS] = {0};
    for (int e = 0; e < ENCODERS; e++) {
        encode(e, &image, &out[e]);
        verify(names[e], &out[e], &image);
    }
    for (int round = 0; round < rounds; round++)
        for (int e = 0; e < ENCODERS; e++) {
            double start = now_ms();
            encode(e, &image, &out[e]);
            times[e][round] = now_ms() - start;
        }
    printf("{");
    for (int e = 0; e < ENCODERS; e++) {
        qsort(times[e], (size_t)rounds, sizeof(double), by_size);
        printf("%s\"%s\": {\"ms\": %.4f, \"least_ms\": %.4f, \"bytes\": %zu}", e ? ", " : "", names[e],
               times[e][rounds / 2], times[e][0], out[e].size);
    }
    printf("}\n");
    return 0;
}
