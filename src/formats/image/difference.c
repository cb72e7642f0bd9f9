// difference.c: draws the differences between two pictures.
#include "fail.h"
#include "float_state.h"
#include "pixels.h"

static void difference_bytes(const uint8_t *a, const uint8_t *b, uint8_t *out, size_t pixels, float gain)
{
    // The value that is shown for each difference from 0 to 255.
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
    if (a == b) // the difference between equal infinities would be NaN
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
    lam_image pair[2], made;
    if (!difference)
        return fail(error, LAM_BAD_ARGUMENT, "difference: the third picture is NULL");
    if (!(gain >= 0.0f && gain <= 3e38f))
        return fail(error, LAM_BAD_ARGUMENT, "difference: gain is %g, expected a finite number of 0 or more",
                    (double)gain);
    if (!image_pair("difference", (const lam_image *const[]){a, b}, pair, error))
        return false;
    bool ok = lam_image_make(&made, a->width, a->height, working_format(a->format), error);
    uint64_t state = float_state_enter();
    size_t pixels = (size_t)a->width * (size_t)a->height;
    if (ok && made.format == LAM_RGBA32F)
        difference_floats(pair[0].pixels, pair[1].pixels, made.pixels, pixels, gain);
    else if (ok)
        difference_bytes(pair[0].pixels, pair[1].pixels, made.pixels, pixels, gain);
    float_state_leave(state);
    if (ok)
        *difference = made;
    lam_image_free(&pair[0]);
    lam_image_free(&pair[1]);
    return ok;
}
