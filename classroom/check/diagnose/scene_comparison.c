// scene_comparison.c: selects the pixels to compare in two pictures, and compares these pixels.
#include "diagnostics.h"

static float clamped(float x) { return x > 0 ? (x < 1 ? x : 1) : 0; } // NaN: 0

// Blending uses the unclamped alpha, so values above 1 matter.
static float bounded(float x) { return x > 0 ? (x < 4 ? x : 4) : 0; }

static double cosine(const float *a, const float *b)
{
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

void scene_comparison_leave_out_turns(struct scene_comparison *scene, const float *normals, int size)
{
    static const double least_cosine = 0.9; // 26 degrees
    size_t kept = 0;
    for (size_t i = 0; i < scene->inside_count; i++) {
        size_t at = scene->inside[i];
        bool turns = false;
        for (int k = 0; k < 9; k++) {
            size_t other = at + (size_t)(k % 3) + (size_t)(k / 3) * (size_t)size - (size_t)size - 1;
            turns = turns || cosine(normals + 4 * at, normals + 4 * other) < least_cosine;
        }
        if (!turns)
            scene->inside[kept++] = scene->inside[i];
    }
    scene->inside_count = kept;
}

void scene_comparison_find_inside(struct scene_comparison *scene, int size)
{
    scene->inside_count = 0;
    for (int y = 1; y + 1 < size; y++)
        for (int x = 1; x + 1 < size; x++) {
            bool all = true;
            for (int k = 0; k < 9; k++) {
                size_t at = (size_t)(y + k / 3 - 1) * (size_t)size + (size_t)(x + k % 3 - 1);
                all = all && scene->reference[4 * at + 3] > 0;
            }
            if (all)
                scene->inside[scene->inside_count++] = (uint32_t)(y * size + x);
        }
}

void scene_comparison_apply_tone(lam_tone tone, float *pixels, size_t count)
{
    for (size_t i = 0; i < count && tone != LAM_TONE_AUTO; i++) {
        float *p = pixels + 4 * i;
        lam_rgb c = lam_tone_apply(tone, (lam_rgb){p[0], p[1], p[2]});
        p[0] = c.r;
        p[1] = c.g;
        p[2] = c.b;
    }
}

size_t scene_comparison_sample_count(const struct scene_comparison *scene)
{
    return scene->inside_count * (scene->alpha ? 4 : 3);
}

void scene_comparison_sample(const struct scene_comparison *scene, const float *picture, float *out)
{
    for (size_t i = 0; i < scene->inside_count; i++) {
        const float *p = picture + 4 * (size_t)scene->inside[i];
        for (int c = 0; c < 3; c++)
            *out++ = clamped(p[c]);
        if (scene->alpha)
            *out++ = bounded(p[3]);
    }
}

struct difference scene_comparison_difference(const struct scene_comparison *scene, const float *other,
                                              double tolerance)
{
    struct difference d = {.pixels = scene->inside_count};
    double sum = 0;
    uint64_t over = 0;
    size_t channels = scene->alpha ? 4 : 3;
    const float *theirs = scene->samples;
    for (size_t i = 0; i < scene->inside_count; i++, theirs += channels, other += channels) {
        double largest = 0;
        for (size_t c = 0; c < channels; c++) {
            double difference = (double)theirs[c] - (double)other[c];
            difference = difference < 0 ? -difference : difference;
            sum += difference;
            largest = difference > largest ? difference : largest;
        }
        over += largest > tolerance;
        d.maximum = largest > d.maximum ? largest : d.maximum;
    }
    if (d.pixels) {
        d.mean = sum / ((double)d.pixels * (double)channels);
        d.share_over = (double)over / (double)d.pixels;
    }
    d.fits = d.share_over <= 0.005 && d.mean <= tolerance / 4;
    return d;
}
