// shrink.c: averages the pixels of a large picture, in linear light.
#include "shrink.h"

#include <math.h>
#include <string.h>

static unsigned char encode(double linear)
{
    double x = linear <= 0 ? 0 : linear >= 1 ? 1 : linear;
    return (unsigned char)((x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055) * 255 + 0.5);
}

// Averages the pixels of the large picture under each pixel of the small picture, in linear light with premultiplied
// alpha.
static void average(const lam_image *from, const lam_image *to)
{
    for (int y = 0; y < to->height; y++)
        for (int x = 0; x < to->width; x++) {
            int left = (int)((int64_t)x * from->width / to->width),
                right = (int)((int64_t)(x + 1) * from->width / to->width);
            int top = (int)((int64_t)y * from->height / to->height),
                bottom = (int)((int64_t)(y + 1) * from->height / to->height);
            double sum[4] = {0};
            for (int v = top; v < bottom; v++)
                for (int u = left; u < right; u++)
                    for (int c = 0; c < 4; c++)
                        sum[c] +=
                            (double)((const float *)
                                         from->pixels)[4 * ((size_t)v * (size_t)from->width + (size_t)u) + (size_t)c];
            unsigned char *pixel = (unsigned char *)to->pixels + 4 * ((size_t)y * (size_t)to->width + (size_t)x);
            double alpha = sum[3] / ((double)(right - left) * (bottom - top));
            for (int c = 0; c < 3; c++)
                pixel[c] = encode(sum[3] > 0 ? sum[c] / sum[3] : 0);
            pixel[3] = (unsigned char)((alpha < 1 ? alpha : 1) * 255 + 0.5);
        }
}

bool shrink_linear(const lam_image *from, int most, lam_image *to, lam_error *error)
{
    int longer = from->width > from->height ? from->width : from->height;
    most = longer < most ? longer : most;
    int width = (int)((int64_t)from->width * most / longer), height = (int)((int64_t)from->height * most / longer);
    if (!lam_image_make(to, width ? width : 1, height ? height : 1, LAM_RGBA8, error))
        return false;
    average(from, to);
    return true;
}

static double decode(unsigned char value)
{
    double x = value / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

bool shrink_bytes(const lam_image *from, int most, lam_image *to, lam_error *error)
{
    size_t count = (size_t)from->width * (size_t)from->height;
    if (from->width <= most && from->height <= most) {
        if (!lam_image_make(to, from->width, from->height, LAM_RGBA8, error))
            return false;
        memcpy(to->pixels, from->pixels, 4 * count);
        return true;
    }
    lam_image linear;
    float light[256];
    if (!lam_image_make(&linear, from->width, from->height, LAM_RGBA32F, error))
        return false;
    for (int i = 0; i < 256; i++)
        light[i] = (float)decode((unsigned char)i);
    const unsigned char *bytes = from->pixels;
    float *numbers = linear.pixels;
    for (size_t i = 0; i < 4 * count; i += 4) {
        float alpha = (float)bytes[i + 3] / 255;
        for (size_t c = 0; c < 3; c++)
            numbers[i + c] = light[bytes[i + c]] * alpha;
        numbers[i + 3] = alpha;
    }
    bool ok = shrink_linear(&linear, most, to, error);
    lam_image_free(&linear);
    return ok;
}
