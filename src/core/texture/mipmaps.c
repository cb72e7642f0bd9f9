// mipmaps.c: makes the levels of a texture: each texel is the average of the area that it covers in the previous level.
//
// A side of n texels is reduced to n/2 texels, rounded down. If n is even, each new texel covers two texels of the
// previous level. If n is odd, each new texel covers slightly more than two texels. The texels at both ends of this
// range are weighted by the share that is covered. Rows and columns are averaged together, in a fixed order.
#include "texture_levels.h"

#include <stddef.h>

// The texels along one side that a texel of the next level covers, and their weights, which sum to 1.
struct cover {
    int first, count;
    float weight[4];
};

static struct cover cover_of(int from, int to, int i)
{
    double step = (double)from / to, begin = i * step, end = (i + 1) * step;
    struct cover cover = {.first = (int)begin};
    for (int k = cover.first; k < from && k < end - 1e-9 && cover.count < 4; k++) {
        double low = k > begin ? k : begin, high = k + 1 < end ? k + 1 : end;
        cover.weight[cover.count++] = (float)((high - low) / step);
    }
    return cover;
}

// With three channels, the fourth number is written into the next texel, which is stored later.
static void store_texel(float *out, texel t) { *(texel_memory *)out = t; }

// Makes level 1 from bytes. `channels` is a constant after inlining.
static inline __attribute__((always_inline)) void halve_bytes(const struct lam_texture *texture, int channels)
{
    const struct texture_level *to = &texture->levels[1];
    float *out = (float *)(uintptr_t)to->floats;
    for (int y = 0; y < to->height; y++) {
        const size_t row = (size_t)texture->levels[0].width * (size_t)channels;
        const uint8_t *upper = texture->bytes + 2 * (size_t)y * row, *lower = upper + row;
        for (int x = 0; x < to->width; x++, out += channels, upper += 2 * channels, lower += 2 * channels)
            for (int c = 0; c < channels; c++) {
                const float *decode = texture->decode + (c < 3 ? 0 : 256);
                out[c] = ((decode[upper[c]] + decode[upper[channels + c]]) +
                          (decode[lower[c]] + decode[lower[channels + c]])) *
                         0.25f;
            }
    }
}

static void halve_floats(const struct lam_texture *texture, int level)
{
    const struct texture_level *from = &texture->levels[level - 1], *to = &texture->levels[level];
    const size_t channels = (size_t)texture->channels, row = (size_t)from->width * channels;
    float *out = (float *)(uintptr_t)to->floats;
    for (int y = 0; y < to->height; y++) {
        const float *upper = from->floats + 2 * (size_t)y * row, *lower = upper + row;
        for (int x = 0; x < to->width; x++, out += channels, upper += 2 * channels, lower += 2 * channels) {
            texel above = texel_of_floats(upper, 4) + texel_of_floats(upper + channels, 4);
            texel below = texel_of_floats(lower, 4) + texel_of_floats(lower + channels, 4);
            store_texel(out, (above + below) * 0.25f);
        }
    }
}

static void halve_even(const struct lam_texture *texture, int level)
{
    if (texture->levels[level - 1].floats)
        halve_floats(texture, level);
    else if (texture->channels == 3)
        halve_bytes(texture, 3);
    else
        halve_bytes(texture, 4);
}

static void halve_any(const struct lam_texture *texture, int level)
{
    const struct texture_level *from = &texture->levels[level - 1], *to = &texture->levels[level];
    float *out = (float *)(uintptr_t)to->floats;
    for (int y = 0; y < to->height; y++) {
        struct cover rows = cover_of(from->height, to->height, y);
        for (int x = 0; x < to->width; x++, out += texture->channels) {
            struct cover columns = cover_of(from->width, to->width, x);
            texel sum = {0, 0, 0, 0};
            for (int j = 0; j < rows.count; j++)
                for (int i = 0; i < columns.count; i++)
                    sum += texel_at(texture, level - 1, columns.first + i, rows.first + j) *
                           (columns.weight[i] * rows.weight[j]);
            store_texel(out, sum);
        }
    }
}

void mipmaps_make(struct lam_texture *texture)
{
    for (int level = 1; level < texture->level_count; level++) {
        const struct texture_level *from = &texture->levels[level - 1];
        if (from->width % 2 == 0 && from->height % 2 == 0)
            halve_even(texture, level);
        else
            halve_any(texture, level);
    }
}
