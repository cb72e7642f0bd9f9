// difference.c: a picture of where two pictures are apart.
#include "fail.h"
#include "float_state.h"

#include <lambent/image.h>

static void difference_bytes(const uint8_t *a, const uint8_t *b, uint8_t *out, size_t pixels, float gain)
{
    // Every difference there can be, brightened once.
    uint8_t shown[256];
    for (int i = 0; i < 256; i++) {
        float value = (float)i * gain + 0.5f;
        shown[i] = value < 255.0f ? (uint8_t)value : 255;
    }
    for (size_t i = 0; i < 4 * pixels; i += 4) {
        int size[4];
        for (size_t c = 0; c < 4; c++)
            size[c] = a[i + c] > b[i + c] ? a[i + c] - b[i + c] : b[i + c] - a[i + c];
        for (size_t c = 0; c < 3; c++)
            out[i + c] = shown[size[c] > size[3] ? size[c] : size[3]];
        out[i + 3] = 255;
    }
}

static float distance(float a, float b)
{
    bool nan_a = a != a, nan_b = b != b;
    if (nan_a || nan_b)
        return nan_a == nan_b ? 0.0f : __builtin_inff();
    if (a == b) // equal infinities would give NaN
        return 0.0f;
    return a < b ? b - a : a - b;
}

static void difference_floats(const float *a, const float *b, float *out, size_t pixels, float gain)
{
    for (size_t i = 0; i < 4 * pixels; i += 4) {
        float alpha = distance(a[i + 3], b[i + 3]);
        for (size_t c = 0; c < 3; c++) {
            float size = distance(a[i + c], b[i + c]);
            size = size > alpha ? size : alpha;
            out[i + c] = size > 0.0f && gain > 0.0f ? size * gain : 0.0f;
        }
        out[i + 3] = 1.0f;
    }
}

bool lam_image_difference(const lam_image *a, const lam_image *b, float gain, lam_image *difference, lam_error *error)
{
    if (!a || !b || !a->pixels || !b->pixels || !difference)
        return fail(error, LAM_BAD_ARGUMENT, "difference: two pictures and a place for the third are needed");
    if (a->width != b->width || a->height != b->height)
        return fail(error, LAM_BAD_ARGUMENT, "difference: the pictures have %d×%d and %d×%d pixels, expected the same",
                    a->width, a->height, b->width, b->height);
    if (a->format != b->format)
        return fail(error, LAM_BAD_ARGUMENT, "difference: one picture has bytes, the other floats, expected the same");
    if (!(gain >= 0.0f && gain <= 3e38f))
        return fail(error, LAM_BAD_ARGUMENT, "difference: gain is %g, expected a finite number of 0 or more",
                    (double)gain);
    lam_image made;
    if (!lam_image_make(&made, a->width, a->height, a->format, error))
        return false;
    uint64_t state = float_state_enter();
    size_t pixels = (size_t)a->width * (size_t)a->height;
    if (a->format == LAM_RGBA32F)
        difference_floats(a->pixels, b->pixels, made.pixels, pixels, gain);
    else
        difference_bytes(a->pixels, b->pixels, made.pixels, pixels, gain);
    float_state_leave(state);
    *difference = made;
    return true;
}
