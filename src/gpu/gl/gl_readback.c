// gl_readback.c: reads a part of the picture back into the image: composites linear light over the background and
// encodes the pixels, with the code of the CPU device.
#include "gl_device.h"

#include "fail.h"
#include "encode_values.h"
#include "pixels.h"

#define LANES 8
#include "picture_pixels.h"

// Encodes premultiplied RGBA pixels of a row in a working format, and stores them in `to`.
static void store_light(const struct gl_frame *f, const float *from, int count, lam_pixel_format format, char *to)
{
    size_t size = pixel_bytes(format);
    for (int x = 0; x < count; x += LANES) {
        int batch = count - x < LANES ? count - x : LANES;
        float lanes[4][LANES] = {{0}};
        for (int i = 0; i < batch; i++)
            for (int c = 0; c < 4; c++)
                lanes[c][i] = from[4 * (x + i) + c];
        struct pixel_lanes p = {num_load(lanes[0]), num_load(lanes[1]), num_load(lanes[2]),
                                min_of(num_load(lanes[3]), num_of(1.0f))}; // rounding may have raised a sum above 1
        write_pixels(f->frame, p, format, to + (size_t)x * size, batch);
    }
}

static void store_clipped(const struct gl_frame *f, const float *from, lam_pixel_format format, void *to)
{
    float p[4];
    num a = num_of(from[3] < 1 ? from[3] : 1);
    struct pixel_lanes one = {num_of(from[0]), num_of(from[1]), num_of(from[2]), a};
    write_pixels(f->frame, one, LAM_RGBA32F, p, 1);
    encode_clipped(format, p, to);
}

static void store_value(const struct gl_frame *f, const float *from, lam_pixel_format format, void *to)
{
    lam_output output = f->frame->settings.output;
    if (output == LAM_OUTPUT_COVERAGE || output == LAM_OUTPUT_OVERDRAW) {
        float share = output == LAM_OUTPUT_COVERAGE ? from[3] : from[0];
        encode_values(f->frame, format, (float[4]){share, share, share, 1}, to);
        return;
    }
    if (from[3] > 0)
        encode_values(f->frame, format, (float[4]){from[0], from[1], from[2], 1}, to);
    else
        encode_empty(f->frame, format, to);
}

bool readback_part(struct gl_frame *f, lam_error *error)
{
    const struct gl *gl = f->gl;
    size_t bytes = (size_t)f->width * (size_t)f->height * 4 * sizeof(float);
    if (!buffer_reserve(&f->device->pixels, bytes, f->call, error))
        return false;
    gl->ReadPixels(0, 0, f->width, f->height, GL_RGBA, GL_FLOAT, f->device->pixels.data);
    lam_pixel_format format = f->image->format, working = working_format(format);
    size_t size = pixel_bytes(working);
    char converted[PART_SIZE_MAX * 16]; // a row in the working format
    lam_output output = f->frame->settings.output;
    uint64_t covered = 0;
    for (int y = 0; y < f->height; y++) {
        const float *from = (const float *)f->device->pixels.data + (size_t)y * (size_t)f->width * 4;
        char *row = (char *)image_row(f->image, f->top + y) + (size_t)f->left * pixel_bytes(format);
        char *to = format == working ? row : converted;
        for (int x = 0; x < f->width; x++)
            covered += from[4 * x + 3] > 0;
        if (lam_output_is_light(output))
            store_light(f, from, f->width, working, to);
        else
            for (int x = 0; x < f->width; x++, from += 4)
                if (output == LAM_OUTPUT_CLIPPED)
                    store_clipped(f, from, working, to + (size_t)x * size);
                else
                    store_value(f, from, working, to + (size_t)x * size);
        if (format != working)
            pixels_from_working(format, values_are_raw(f->frame), converted, f->width, row);
    }
    f->device->base.report.pixels_covered += covered;
    return call_should_continue(f->call) || call_error(f->call, error);
}
