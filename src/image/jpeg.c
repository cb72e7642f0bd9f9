// jpeg.c: JPEG, read only, through libjpeg-turbo with its exact integer transform: the same bytes on every processor.
#include "codec.h"
#include "fail.h"

#include <setjmp.h>
#include <stdio.h> // jpeglib.h wants it

#include <jerror.h>
#include <jpeglib.h>

enum { MAX_SCANS = 200 }; // a progressive picture has about ten; each one covers the whole picture

// libjpeg's structs, which its callbacks get, and our members after them.
struct reader {
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    struct jpeg_decompress_struct jpeg;
    jmp_buf out;
    char message[JMSG_LENGTH_MAX];
};

_Noreturn static void give_up(j_common_ptr jpeg)
{
    struct reader *reader = (struct reader *)jpeg->err;
    jpeg->err->format_message(jpeg, reader->message);
    longjmp(reader->out, 1);
}

// Warnings (level −1) about lost parts of the picture end the reading; others are habits of cameras and old programs.
static void take_message(j_common_ptr jpeg, int level)
{
    int code = jpeg->err->msg_code;
    if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR && code != JWRN_ADOBE_XFORM)
        give_up(jpeg);
}

static void print_nothing(j_common_ptr jpeg) { (void)jpeg; }

static void count_scans(j_common_ptr jpeg)
{
    struct reader *reader = (struct reader *)jpeg->err;
    if (reader->jpeg.input_scan_number > MAX_SCANS) {
        snprintf(reader->message, sizeof reader->message, "more than %d scans", MAX_SCANS);
        longjmp(reader->out, 1);
    }
}

static bool jpeg_probe(const uint8_t *bytes, size_t size)
{
    return size >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

// A block of 64 pixels takes at least one bit, in the component with the most blocks, which may cover 1/16 of
// the pixels.
static bool jpeg_fits(const struct jpeg_decompress_struct *jpeg, size_t size)
{
    return (uint64_t)jpeg->image_width * jpeg->image_height / (8 * 64 * 16) <= size;
}

// The part that libjpeg may jump out of (longjmp): it changes nothing but what its pointers lead to.
static bool decode(struct reader *reader, const uint8_t *bytes, size_t size, const char *name, lam_image *image,
                   lam_error *error)
{
    struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    jpeg_create_decompress(jpeg);
    jpeg->progress = &reader->progress;
    jpeg_mem_src(jpeg, bytes, size);
    jpeg_read_header(jpeg, TRUE);
    if (jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK)
        return fail(error, LAM_UNSUPPORTED, "%s: JPEG in CMYK colours, expected RGB or grey", name);
    if (!jpeg_fits(jpeg, size))
        return fail(error, LAM_CANNOT_READ, "%s: JPEG of %u×%u pixels, which cannot be in a file of %zu bytes", name,
                    jpeg->image_width, jpeg->image_height, size);
    jpeg->out_color_space = JCS_EXT_RGBA; // alpha 255
    jpeg->dct_method = JDCT_ISLOW;
    jpeg_start_decompress(jpeg);
    if (!lam_image_make(image, (int)jpeg->output_width, (int)jpeg->output_height, LAM_RGBA8, error))
        return false;
    while (jpeg->output_scanline < jpeg->output_height) {
        JSAMPROW row = (JSAMPROW)image->pixels + (size_t)jpeg->output_scanline * jpeg->output_width * 4;
        jpeg_read_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_decompress(jpeg);
    return true;
}

static bool jpeg_read(const uint8_t *bytes, size_t size, const char *name, lam_image *image, lam_error *error)
{
    struct reader reader;
    reader.jpeg = (struct jpeg_decompress_struct){.err = jpeg_std_error(&reader.errors)};
    reader.errors.error_exit = give_up;
    reader.errors.emit_message = take_message;
    reader.errors.output_message = print_nothing;
    reader.progress = (struct jpeg_progress_mgr){.progress_monitor = count_scans};
    bool ok = setjmp(reader.out) == 0 ? decode(&reader, bytes, size, name, image, error)
                                      : fail(error, LAM_CANNOT_READ, "%s: JPEG: %s", name, reader.message);
    jpeg_destroy_decompress(&reader.jpeg);
    if (!ok)
        lam_image_free(image);
    return ok;
}

const struct codec codec_jpeg = {
    .name = "jpg", .title = "JPEG", .pixels = LAM_RGBA8, .probe = jpeg_probe, .read = jpeg_read};
