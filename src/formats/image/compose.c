// compose.c: composites a picture over a background, for formats without alpha.
#include "compose.h"

#include "srgb.h"

// Returns the byte that is nearest to a linear number. The byte is found by bisection. Numbers outside 0…1 are clamped,
// and NaN becomes 0.
static uint8_t byte_of(const struct compose *compose, double linear)
{
    int byte = 0;
    for (int step = 128; step > 0; step /= 2)
        if (linear >= compose->from[byte + step])
            byte += step;
    return (uint8_t)byte;
}

void compose_start(struct compose *compose, const lam_save_params *params)
{
    for (int i = 0; i < 256; i++) {
        compose->linear[i] = params->raw ? i / 255.0 : srgb_linear(i / 255.0);
        compose->from[i] = params->raw ? (i - 0.5) / 255.0 : srgb_linear((i - 0.5) / 255.0);
    }
    compose->background[0] = (double)params->background.r;
    compose->background[1] = (double)params->background.g;
    compose->background[2] = (double)params->background.b;
    for (int channel = 0; channel < 3; channel++)
        compose->clear[channel] = byte_of(compose, compose->background[channel]);
}

static uint8_t over(const struct compose *compose, uint8_t color, uint8_t alpha, double background)
{
    double share = alpha / 255.0;
    return byte_of(compose, compose->linear[color] * share + background * (1.0 - share));
}

void compose_row(const struct compose *compose, const uint8_t *rgba, size_t count, uint8_t *rgb)
{
    for (size_t i = 0; i < count; i++, rgba += 4, rgb += 3)
        for (int channel = 0; channel < 3; channel++)
            rgb[channel] = rgba[3] == 255 ? rgba[channel] // unchanged
                           : rgba[3] == 0 ? compose->clear[channel]
                                          : over(compose, rgba[channel], rgba[3], compose->background[channel]);
}
