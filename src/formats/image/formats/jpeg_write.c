// jpeg_write.c: writes baseline JPEG files with libjpeg-turbo. The accurate integer transform and optimised Huffman
// codes are used. The bytes depend only on the picture, the quality and the version of libjpeg-turbo.
#include "codec.h"
#include "compose.h"
#include "fail.h"

#include <setjmp.h>
#include <stdio.h> // required by jpeglib.h
#include <stdlib.h>

#include <jerror.h>
#include <jpeglib.h>

// If the quality is at least QUALITY_OF_FULL_COLOR, chroma is stored for every pixel. For lower quality, chroma is
// stored once for every four pixels.
enum { QUALITY_DEFAULT = 90, QUALITY_OF_FULL_COLOR = 90 };

// The libjpeg error struct that the callbacks receive, followed by our own members.
struct writer {
    struct jpeg_error_mgr errors;
    struct jpeg_compress_struct jpeg;
    jmp_buf out;
    struct compose compose;
    struct call_control call;
    const lam_image *image;
    int quality;
    unsigned char *bytes; // allocated with malloc
    unsigned long size;
    bool has_bytes; // jpeg_mem_dest has returned, so jpeg.dest is complete
    uint8_t *row;
};

_Noreturn static void give_up(j_common_ptr jpeg) { longjmp(((struct writer *)jpeg->err)->out, 1); }

static void ignore_message(j_common_ptr jpeg, int level) { (void)jpeg, (void)level; }

static void print_nothing(j_common_ptr jpeg) { (void)jpeg; }

// libjpeg may leave this function with longjmp, so the function stores its results only in memory that its parameters
// point to.
static bool encode(struct writer *writer, lam_error *error)
{
    struct jpeg_compress_struct *jpeg = &writer->jpeg;
    const lam_image *image = writer->image;
    jpeg_create_compress(jpeg);
    jpeg_mem_dest(jpeg, &writer->bytes, &writer->size);
    writer->has_bytes = true;
    jpeg->image_width = (JDIMENSION)image->width;
    jpeg->image_height = (JDIMENSION)image->height;
    jpeg->input_components = 3;
    jpeg->in_color_space = JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, writer->quality, TRUE);
    jpeg->dct_method = JDCT_ISLOW;
    jpeg->optimize_coding = TRUE;
    int sampling = writer->quality >= QUALITY_OF_FULL_COLOR ? 1 : 2;
    jpeg->comp_info[0].h_samp_factor = jpeg->comp_info[0].v_samp_factor = sampling;
    jpeg_start_compress(jpeg, TRUE);
    jpeg_write_marker(jpeg, JPEG_COM, (const JOCTET *)JPEG_REMARK, sizeof JPEG_REMARK - 1);
    while (jpeg->next_scanline < jpeg->image_height) {
        if (jpeg->next_scanline % 16 == 0 && !call_should_continue(&writer->call))
            return call_error(&writer->call, error);
        const uint8_t *from = (const uint8_t *)image->pixels + (size_t)jpeg->next_scanline * (size_t)image->width * 4;
        compose_row(&writer->compose, from, (size_t)image->width, writer->row);
        jpeg_write_scanlines(jpeg, &writer->row, 1);
    }
    jpeg_finish_compress(jpeg);
    return true;
}

static bool fail_jump(const struct writer *writer, lam_error *error)
{
    if (writer->errors.msg_code == JERR_OUT_OF_MEMORY)
        return fail_memory(error, (size_t)writer->image->width * (size_t)writer->image->height * 3);
    char message[JMSG_LENGTH_MAX];
    writer->errors.format_message((j_common_ptr)&writer->jpeg, message);
    return fail(error, LAM_LIMIT, "JPEG: %s", message);
}

// Calls setjmp, so that libjpeg can return here with longjmp. No local variable of this function changes after setjmp.
static bool encode_or_jump(struct writer *writer, lam_error *error)
{
    return setjmp(writer->out) == 0 ? encode(writer, error) : fail_jump(writer, error);
}

bool jpeg_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                lam_error *error)
{
    (void)pool;
    size_t row_bytes = (size_t)image->width * 3;
    struct writer *writer = calloc(1, sizeof *writer + row_bytes);
    if (!writer)
        return fail_memory(error, sizeof *writer + row_bytes);
    writer->jpeg.err = jpeg_std_error(&writer->errors);
    writer->errors.error_exit = give_up;
    writer->errors.emit_message = ignore_message;
    writer->errors.output_message = print_nothing;
    writer->image = image;
    writer->quality = params->quality ? (int)params->quality : QUALITY_DEFAULT;
    writer->row = (uint8_t *)(writer + 1);
    compose_start(&writer->compose, params);
    call_start(&writer->call, params->control);
    bool ok = encode_or_jump(writer, error);
    if (!ok && writer->has_bytes)
        writer->jpeg.dest->term_destination(&writer->jpeg); // stores the current address of the memory
    jpeg_destroy_compress(&writer->jpeg);
    if (ok)
        *out = (lam_bytes){writer->bytes, writer->size};
    else
        free(writer->bytes);
    free(writer);
    return ok;
}
