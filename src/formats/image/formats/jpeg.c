// jpeg.c: defines the entry for JPEG in the table of formats, and reads JPEG files with libjpeg-turbo. With the
// accurate integer transform, pictures are bit-identical on every processor.
#include "codec.h"
#include "fail.h"
#include "pixels.h"

#include <setjmp.h>
#include <stdio.h> // required by jpeglib.h
#include <string.h>

#include <jerror.h>
#include <jpeglib.h>

enum { MAX_SCANS = 200 }; // a progressive picture contains about ten scans; each scan covers the whole picture

// The libjpeg structs that the callbacks receive, followed by our own members.
struct jpeg_decoder {
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    struct jpeg_decompress_struct jpeg;
    jmp_buf out;
    char message[JMSG_LENGTH_MAX];
    const struct picture_file *file;
    bool rgb;           // decodes to LAM_RGB8 instead of LAM_RGBA8, except for CMYK files
    bool stopped;       // the call must stop
    bool out_of_memory; // libjpeg ran out of memory
    size_t charged;     // bytes of libjpeg's coefficients that count towards the call's limit
};

_Noreturn static void give_up(j_common_ptr jpeg)
{
    struct jpeg_decoder *reader = (struct jpeg_decoder *)jpeg->err;
    jpeg->err->format_message(jpeg, reader->message);
    reader->out_of_memory = jpeg->err->msg_code == JERR_OUT_OF_MEMORY;
    longjmp(reader->out, 1);
}

// Reading stops at a warning (level −1), because most warnings are about missing data. Three harmless warnings, which
// files from cameras and old programs often cause, are ignored.
static void take_message(j_common_ptr jpeg, int level)
{
    int code = jpeg->err->msg_code;
    if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR && code != JWRN_ADOBE_XFORM)
        give_up(jpeg);
}

static void print_nothing(j_common_ptr jpeg) { (void)jpeg; }

// libjpeg calls this function for every row of blocks, in each scan.
static void monitor(j_common_ptr jpeg)
{
    struct jpeg_decoder *reader = (struct jpeg_decoder *)jpeg->err;
    reader->stopped = !call_should_continue(reader->file->call);
    if (reader->stopped)
        longjmp(reader->out, 1);
    if (reader->jpeg.input_scan_number > MAX_SCANS) {
        snprintf(reader->message, sizeof reader->message, "more than %d scans", MAX_SCANS);
        longjmp(reader->out, 1);
    }
}

static bool jpeg_probe(const uint8_t *bytes, size_t size)
{
    return size >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

// Checks that the file is large enough for the declared size. Each block of 64 samples needs at least one bit. The
// largest component has at least 1/16 as many samples as the picture has pixels.
static bool jpeg_fits(const struct jpeg_decompress_struct *jpeg, size_t size)
{
    return (uint64_t)jpeg->image_width * jpeg->image_height / (8 * 64 * 16) <= size;
}

// Counts the coefficients towards the call's memory limit. A file with several scans keeps all of its coefficients in
// memory before the first row. A coefficient needs two bytes, and there are at most as many coefficients as if all
// components had full resolution.
static bool charge_coefficients(struct jpeg_decoder *reader, lam_error *error)
{
    struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    struct call_control *call = reader->file->call;
    size_t bytes = (size_t)jpeg->image_width * jpeg->image_height * (size_t)jpeg->num_components * 2;
    if (!call || !jpeg_has_multiple_scans(jpeg))
        return true;
    reader->charged = call_charge(call, bytes) ? bytes : 0;
    return reader->charged || call_memory_error(call, bytes, error);
}

// Converts one row of cyan, magenta, yellow and black ink values to RGBA, without a colour profile. Each channel is the
// product of the fractions of light that its ink and the black ink transmit. In files with Adobe's marker, 255 means no
// ink; this is a convention of Photoshop that every program follows. In other files, 0 means no ink.
static void mix_inks(uint8_t *row, size_t width, bool inverted)
{
    const unsigned flip = inverted ? 0 : 255;
    for (size_t x = 0; x < width; x++, row += 4) {
        unsigned black = row[3] ^ flip;
        for (int i = 0; i < 3; i++)
            row[i] = (uint8_t)(((row[i] ^ flip) * black * 2 + 255) / 510);
        row[3] = 255;
    }
}

// libjpeg may leave this function with longjmp, so the function stores its results only in memory that its parameters
// point to.
static bool decode(struct jpeg_decoder *reader, lam_image *image, lam_error *error)
{
    struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    const struct picture_file *file = reader->file;
    jpeg_create_decompress(jpeg);
    jpeg->progress = &reader->progress;
    jpeg_mem_src(jpeg, file->bytes, file->size);
    jpeg_read_header(jpeg, TRUE);
    const bool inks = jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK;
    if (!picture_size_check(file, jpeg->image_width, jpeg->image_height, error))
        return false;
    if (!jpeg_fits(jpeg, file->size))
        return fail(error, LAM_CANNOT_READ, "%s: JPEG of %u×%u pixels, which cannot be in a file of %zu bytes",
                    file->name, jpeg->image_width, jpeg->image_height, file->size);
    lam_pixel_format format = reader->rgb && !inks ? LAM_RGB8 : LAM_RGBA8;
    jpeg->out_color_space = inks ? JCS_CMYK : format == LAM_RGB8 ? JCS_RGB : JCS_EXT_RGBA; // alpha 255
    jpeg->dct_method = JDCT_ISLOW;
    jpeg->do_fancy_upsampling = TRUE; // linear interpolation of chroma, with integers: identical on every machine
    jpeg->do_block_smoothing = FALSE; // only affects files with missing scans, which are rejected
    // The picture is allocated first. If this allocation fails, the coefficients are not counted.
    if (!picture_make(file, jpeg->image_width, jpeg->image_height, format, image, error) ||
        !charge_coefficients(reader, error))
        return false;
    jpeg_start_decompress(jpeg);
    while (jpeg->output_scanline < jpeg->output_height) {
        JSAMPROW row = image_row(image, (int)jpeg->output_scanline);
        jpeg_read_scanlines(jpeg, &row, 1);
        if (inks)
            mix_inks(row, jpeg->output_width, jpeg->saw_Adobe_marker);
    }
    jpeg_finish_decompress(jpeg);
    return true;
}

static bool fail_jump(const struct jpeg_decoder *reader, lam_error *error)
{
    if (reader->stopped)
        return call_error(reader->file->call, error);
    if (reader->out_of_memory)
        return fail_memory(error, reader->charged);
    return fail(error, LAM_CANNOT_READ, "%s: JPEG: %s", reader->file->name, reader->message);
}

// Calls setjmp, so that libjpeg can return here with longjmp. No local variable of this function changes after setjmp.
static bool decode_or_jump(struct jpeg_decoder *reader, lam_image *image, lam_error *error)
{
    return setjmp(reader->out) == 0 ? decode(reader, image, error) : fail_jump(reader, error);
}

static bool jpeg_read_as(bool rgb, const struct picture_file *file, lam_image *image, lam_error *error)
{
    struct jpeg_decoder reader;
    reader.jpeg = (struct jpeg_decompress_struct){.err = jpeg_std_error(&reader.errors)};
    reader.errors.error_exit = give_up;
    reader.errors.emit_message = take_message;
    reader.errors.output_message = print_nothing;
    reader.progress = (struct jpeg_progress_mgr){.progress_monitor = monitor};
    reader.file = file;
    reader.rgb = rgb;
    reader.stopped = reader.out_of_memory = false;
    reader.charged = 0;
    bool ok = decode_or_jump(&reader, image, error);
    jpeg_destroy_decompress(&reader.jpeg);
    if (reader.charged)
        call_refund(file->call, reader.charged);
    if (!ok)
        picture_free(file->call, image);
    return ok;
}

static bool jpeg_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    return jpeg_read_as(false, file, image, error);
}

static bool jpeg_read_wide(const struct picture_file *file, lam_image *image, bool *wide, lam_error *error)
{
    *wide = false;
    return jpeg_read_as(true, file, image, error);
}

// Returns whether the comment after the markers SOI and JFIF states that Lambent wrote the file.
static bool jpeg_ours(const uint8_t *bytes, size_t size)
{
    static const char remark[] = "\xff\xfe\0\x09" JPEG_REMARK;
    enum { AT = 20, BYTES = sizeof remark - 1 };
    return size >= AT + BYTES && memcmp(bytes + AT, remark, BYTES) == 0;
}

const struct codec codec_jpeg = {
    .name = "jpg",
    .alias = "jpeg",
    .title = "JPEG",
    .written = "8 bits, sRGB, over the background, lossy",
    .pixels = LAM_RGBA8,
    .write = jpeg_write,
    .probe = jpeg_probe,
    .read = jpeg_read,
    .read_wide = jpeg_read_wide,
    .ours = jpeg_ours,
};
