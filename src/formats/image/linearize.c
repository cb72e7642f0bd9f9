// linearize.c: converts the values of a picture file to linear light.
#include "codec.h"
#include "fail.h"
#include "pixels.h"
#include "srgb.h"

#include <stdlib.h>

// Makes a table of the linear values that correspond to the file's values 0 … last.
static float *make_table(int last, lam_color_mode color, lam_error *error)
{
    size_t bytes = ((size_t)last + 1) * sizeof(float);
    float *table = malloc(bytes);
    if (!table)
        return fail_memory(error, bytes), NULL;
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

static bool decode_wide(const struct picture_file *file, lam_image *image, const float *table, lam_error *error)
{
    float *pixel = image->pixels;
    for (int y = 0; y < image->height; y++) {
        if (!picture_continues(file, y, error))
            return false;
        for (int x = 0; x < image->width; x++, pixel += 4) {
            for (int channel = 0; channel < 3; channel++)
                pixel[channel] = table[(int)(pixel[channel] * 65535.0f + 0.5f)];
            premultiply(pixel);
        }
    }
    return true;
}

static bool decode_bytes(const struct picture_file *file, lam_image *image, const float *table, lam_error *error)
{
    lam_image floats;
    if (!picture_make(file, (uint32_t)image->width, (uint32_t)image->height, LAM_RGBA32F, &floats, error))
        return false;
    const uint8_t *from = image->pixels;
    const size_t bytes = pixel_bytes(image->format); // 4 bytes per pixel, or 3 without alpha
    float *pixel = floats.pixels;
    for (int y = 0; y < image->height; y++) {
        if (!picture_continues(file, y, error)) {
            picture_free(file->call, &floats);
            return false;
        }
        for (int x = 0; x < image->width; x++, pixel += 4, from += bytes) {
            for (int channel = 0; channel < 3; channel++)
                pixel[channel] = table[from[channel]];
            pixel[3] = bytes == 4 ? (float)from[3] / 255.0f : 1;
            premultiply(pixel);
        }
    }
    picture_free(file->call, image);
    *image = floats;
    return true;
}

bool picture_linearize(const struct picture_file *file, lam_image *image, bool wide, lam_color_mode color,
                       lam_error *error)
{
    if (image->format == LAM_RGBA32F && !wide)
        return true; // the file is linear already
    float *table = make_table(wide ? 65535 : 255, color, error);
    if (!table)
        return false;
    bool ok = wide ? decode_wide(file, image, table, error) : decode_bytes(file, image, table, error);
    free(table);
    return ok;
}
