// compare.c: measures the difference between two pictures.
#include "fail.h"
#include "float_state.h"
#include "pixels.h"

#include <string.h>

// Returns log10 of a positive finite number, without libm. The function splits x = m·2^e with m near 1, and uses ln m =
// 2·artanh((m − 1)/(m + 1)).
static double log10_of(double x)
{
    int exponent = 0;
    if (x < 0x1p-1022) {
        x *= 0x1p54;
        exponent = -54;
    }
    uint64_t bits;
    memcpy(&bits, &x, 8);
    exponent += (int)(bits >> 52) - 1023;
    bits = (bits & 0x000FFFFFFFFFFFFFu) | 0x3FF0000000000000u;
    double m;
    memcpy(&m, &bits, 8);
    if (m > 1.4142135623730951) {
        m *= 0.5;
        exponent++;
    }
    double s = (m - 1.0) / (m + 1.0), square = s * s, series = 0.0;
    for (int k = 23; k >= 1; k -= 2)
        series = series * square + 1.0 / k; // Σ s²ⁿ/(2n + 1); |s| < 0.172, so the omitted terms are below 1e-19
    const double log10_2 = 0.30102999566398120, log10_e = 0.43429448190325183;
    return exponent * log10_2 + 2.0 * s * series * log10_e;
}

// Sums of differences.
struct tally {
    double sum, squares, maximum;
    uint64_t over_1, over_2; // pixels
};

static void tally_bytes(struct tally *tally, const uint8_t *a, const uint8_t *b, size_t pixels)
{
    uint64_t sum = 0, squares = 0;
    unsigned maximum = 0;
    for (size_t i = 0; i < pixels; i++) {
        unsigned largest = 0;
        for (int channel = 0; channel < 4; channel++) {
            int difference = a[4 * i + (size_t)channel] - b[4 * i + (size_t)channel];
            unsigned size = (unsigned)(difference < 0 ? -difference : difference);
            sum += size;
            squares += size * size;
            largest = size > largest ? size : largest;
        }
        maximum = largest > maximum ? largest : maximum;
        tally->over_1 += largest > 1;
        tally->over_2 += largest > 2;
    }
    tally->sum = (double)sum / 255.0;
    tally->squares = (double)squares / (255.0 * 255.0);
    tally->maximum = maximum / 255.0;
}

static void tally_floats(struct tally *tally, const float *a, const float *b, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++) {
        double largest = 0.0;
        for (size_t at = 4 * i; at < 4 * i + 4; at++) {
            bool nan_a = a[at] != a[at], nan_b = b[at] != b[at];
            double size = 0.0;
            if (nan_a != nan_b)
                size = __builtin_inf();
            else if (!nan_a && a[at] != b[at]) // the difference between equal infinities would be NaN
                size = a[at] < b[at] ? (double)b[at] - (double)a[at] : (double)a[at] - (double)b[at];
            tally->sum += size;
            tally->squares += size * size;
            largest = size > largest ? size : largest;
        }
        tally->maximum = largest > tally->maximum ? largest : tally->maximum;
        tally->over_1 += largest > 1.0 / 255.0;
        tally->over_2 += largest > 2.0 / 255.0;
    }
}

bool image_pair(const char *what, const lam_image *const given[2], lam_image pair[2], lam_error *error)
{
    const lam_image *a = given[0], *b = given[1];
    pair[0] = pair[1] = (lam_image){0};
    if (!a || !b)
        return fail(error, LAM_BAD_ARGUMENT, "%s: two pictures are needed", what);
    if (!image_check(a, what, error) || !image_check(b, what, error))
        return false;
    if (a->width != b->width || a->height != b->height)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the pictures have %d×%d and %d×%d pixels, expected the same", what,
                    a->width, a->height, b->width, b->height);
    if (working_format(a->format) != working_format(b->format))
        return fail(error, LAM_BAD_ARGUMENT, "%s: one picture has bytes, the other floats, expected the same", what);
    if (image_working(a, &pair[0], error) && image_working(b, &pair[1], error))
        return true;
    lam_image_free(&pair[0]);
    return false;
}

bool lam_image_compare(const lam_image *a, const lam_image *b, lam_difference *difference, lam_error *error)
{
    lam_image pair[2];
    if (!difference)
        return fail(error, LAM_BAD_ARGUMENT, "compare: difference is NULL");
    if (!image_pair("compare", (const lam_image *const[]){a, b}, pair, error))
        return false;
    uint64_t state = float_state_enter();
    struct tally tally = {0};
    size_t pixels = (size_t)a->width * (size_t)a->height;
    if (format_is_float(a->format))
        tally_floats(&tally, pair[0].pixels, pair[1].pixels, pixels);
    else
        tally_bytes(&tally, pair[0].pixels, pair[1].pixels, pixels);
    double channels = 4.0 * (double)pixels, mean_square = tally.squares / channels;
    *difference = (lam_difference){
        .maximum = tally.maximum,
        .mean = tally.sum / channels,
        .rmse = __builtin_sqrt(mean_square),
        .psnr_db = mean_square == 0.0               ? __builtin_inf()
                   : mean_square == __builtin_inf() ? -__builtin_inf()
                                                    : -10.0 * log10_of(mean_square),
        .share_over_1 = (double)tally.over_1 / (double)pixels,
        .share_over_2 = (double)tally.over_2 / (double)pixels,
    };
    float_state_leave(state);
    lam_image_free(&pair[0]);
    lam_image_free(&pair[1]);
    return true;
}
