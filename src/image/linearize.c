// linearize.c: a picture's numbers, as a file has them, to linear light.
#include "codec.h"
#include "fail.h"
#include "srgb.h"

#include <stdlib.h>

// The linear values of the numbers 0 … last.
static float *make_table(int last, lam_color_mode color, lam_error *error)
{
    size_t bytes = ((size_t)last + 1) * sizeof(float);
    float *table = malloc(bytes);
    if (!table) {
        fail_memory(error, bytes);
        return NULL;
    }
    for (int i = 0; i <= last; i++) {
        double number = (double)i / last;
        table[i] = (float)(color == LAM_COLOR_RAW ? number : srgb_linear(number));
    }
    return table;
}

static void premultiply(float pixel[4])
{
    for (int channel = 0; channel < 3; channel++)
        pixel[channel] *= pixel[3];
}

static void decode_wide(lam_image *image, const float *table)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    for (float *pixel = image->pixels; count > 0; count--, pixel += 4) {
        for (int channel = 0; channel < 3; channel++)
            pixel[channel] = table[(int)(pixel[channel] * 65535.0f + 0.5f)];
        premultiply(pixel);
    }
}

static bool decode_bytes(lam_image *image, const float *table, lam_error *error)
{
    lam_image bytes = *image;
    if (!lam_image_make(image, bytes.width, bytes.height, LAM_RGBA32F, error)) {
        *image = bytes;
        return false;
    }
    size_t count = (size_t)bytes.width * (size_t)bytes.height;
    const uint8_t *from = bytes.pixels;
    for (float *pixel = image->pixels; count > 0; count--, pixel += 4, from += 4) {
        for (int channel = 0; channel < 3; channel++)
            pixel[channel] = table[from[channel]];
        pixel[3] = (float)from[3] / 255.0f;
        premultiply(pixel);
    }
    lam_image_free(&bytes);
    return true;
}

bool image_linearize(lam_image *image, bool wide, lam_color_mode color, lam_error *error)
{
    if (image->format == LAM_RGBA32F && !wide)
        return true; // linear in the file
    float *table = make_table(wide ? 65535 : 255, color, error);
    if (!table)
        return false;
    bool ok = true;
    if (wide)
        decode_wide(image, table);
    else
        ok = decode_bytes(image, table, error);
    free(table);
    return ok;
}
