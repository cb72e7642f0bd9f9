// denoise.c: removes the noise of path-traced pictures (docs/lighting/bounces.md).
//
// The filter is the non-local mean of two half pictures with different paths (Rousselle, Knaus and Zwicker, "Adaptive
// Rendering with Non-Local Means Filtering", 2012): the weights for one half come from the other half, so that noise
// cannot select itself. Neighbours count less if their patches differ by more than the noise explains, or if their
// normals, distances or base colours differ. Before filtering, colours are divided by the base colours, so that textures
// stay sharp.
#include "paths.h"

#define LANES 1
#include "functions.h"

#include "fail.h"

#include <stdlib.h>

enum { REACH = 6, CHUNK = 128, SMOOTH = 2 }; // radii: of the window, and of the mean of variances; columns at a time

// A pixel of one half: the colour divided by the base colour, and the variance of this quotient.
struct sample {
    float color[3], variance[3];
};

struct denoiser {
    const struct path_pictures *in;
    int width, height;
    struct sample *halves[2];
    float *raw[3];   // the variance of each channel, of single pixels
    float *slope[2]; // by how much the distance changes from a pixel to the next, to the right and downwards
    lam_image *out;
    struct call_control *call;
};

static const float *pixel(const lam_image *image, int x, int y)
{
    return (const float *)image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static int within(int x, int end) { return x < 0 ? 0 : x < end ? x : end - 1; }

// The base colour that colours are divided by. Black surfaces only have highlights, which are left as they are.
static float base_of(const struct denoiser *d, int x, int y, int c)
{
    float base = pixel(&d->in->colors, x, y)[c];
    return base > 0.02f ? base : 1;
}

static float luminance(const float *p) { return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2]; }

// Single bright pixels come from rare paths. They are dimmed to twice the brightest of their eight neighbours, in the
// mean of both halves.
static float dimmed(const struct denoiser *d, int half, int x, int y)
{
    float most = 0, own = luminance(pixel(&d->in->halves[half], x, y));
    for (int i = 0; i < 9; i++) {
        int at_x = within(x + i % 3 - 1, d->width), at_y = within(y + i / 3 - 1, d->height);
        float mean =
            0.5f * (luminance(pixel(&d->in->halves[0], at_x, at_y)) + luminance(pixel(&d->in->halves[1], at_x, at_y)));
        if ((at_x != x || at_y != y) && mean > most)
            most = mean;
    }
    return own > 2 * most && own > 0 ? 2 * most / own : 1;
}

// Of the differences to both neighbours along an axis, the smaller one: the other may cross an edge.
static float slope_of(const struct denoiser *d, int x, int y, int right, int down)
{
    const float z = pixel(&d->in->depths, x, y)[0];
    const float next = pixel(&d->in->depths, within(x + right, d->width), within(y + down, d->height))[0] - z;
    const float last = z - pixel(&d->in->depths, within(x - right, d->width), within(y - down, d->height))[0];
    return next * next < last * last ? next : last;
}

// --- a row at a time

static void prepare_row(void *user, size_t row, int thread)
{
    (void)thread;
    const struct denoiser *d = user;
    const int y = (int)row;
    for (int x = 0; x < d->width; x++) {
        const size_t at = row * (size_t)d->width + (size_t)x;
        const float alpha = pixel(&d->in->halves[0], x, y)[3];
        for (int half = 0; half < 2; half++) {
            const float share = alpha > 0 ? dimmed(d, half, x, y) / alpha : 0;
            for (int c = 0; c < 3; c++)
                d->halves[half][at].color[c] = pixel(&d->in->halves[half], x, y)[c] * share / base_of(d, x, y, c);
        }
        for (int c = 0; c < 3; c++) {
            float apart = d->halves[0][at].color[c] - d->halves[1][at].color[c];
            d->raw[c][at] = 0.5f * apart * apart;
        }
        d->slope[0][at] = slope_of(d, x, y, 1, 0);
        d->slope[1][at] = slope_of(d, x, y, 0, 1);
    }
}

// Smooths the variances, which are known from two values only.
static void smooth_row(void *user, size_t row, int thread)
{
    (void)thread;
    const struct denoiser *d = user;
    for (int x = 0; x < d->width; x++)
        for (int c = 0; c < 3; c++) {
            float sum = 0;
            for (int dy = -SMOOTH; dy <= SMOOTH; dy++)
                for (int dx = -SMOOTH; dx <= SMOOTH; dx++)
                    sum += d->raw[c][(size_t)within((int)row + dy, d->height) * (size_t)d->width +
                                     (size_t)within(x + dx, d->width)];
            const size_t at = row * (size_t)d->width + (size_t)x;
            const float mean = sum * (1.0f / ((2 * SMOOTH + 1) * (2 * SMOOTH + 1)));
            d->halves[0][at].variance[c] = d->halves[1][at].variance[c] = mean;
        }
}

// By how much two pixels differ, beyond the noise.
static float noise_distance(const struct sample *p, const struct sample *q)
{
    float sum = 0;
    for (int c = 0; c < 3; c++) {
        float apart = p->color[c] - q->color[c], both = p->variance[c] + q->variance[c];
        float least = p->variance[c] < q->variance[c] ? p->variance[c] : q->variance[c];
        sum += (apart * apart - (p->variance[c] + least)) / (1e-12f + 0.2f * both);
    }
    return sum * (1.0f / 3);
}

// By how much the surfaces at two pixels differ; 1 is much.
static float surface_distance(const struct denoiser *d, int x, int y, int dx, int dy)
{
    const float *n = pixel(&d->in->normals, x, y), *m = pixel(&d->in->normals, x + dx, y + dy);
    const float *a = pixel(&d->in->colors, x, y), *b = pixel(&d->in->colors, x + dx, y + dy);
    const float z = pixel(&d->in->depths, x, y)[0], w = pixel(&d->in->depths, x + dx, y + dy)[0];
    float normals = 0, colors = 0;
    for (int c = 0; c < 3; c++) {
        normals += (n[c] - m[c]) * (n[c] - m[c]);
        colors += (a[c] - b[c]) * (a[c] - b[c]);
    }
    // The difference from the plane through the point, relative to the distance and to the plane's own slope.
    const size_t at = (size_t)y * (size_t)d->width + (size_t)x;
    const float right = d->slope[0][at] * (float)dx, down = d->slope[1][at] * (float)dy;
    const float apart = w - z - (right + down);
    const float reach = 0.005f * z + 0.3f * ((right < 0 ? -right : right) + (down < 0 ? -down : down)) + 1e-20f;
    const float depth = apart * apart / (reach * reach);
    const float most = normals * 20 > colors * 8 ? normals * 20 : colors * 8;
    return most > depth ? most : depth;
}

// Adds the neighbours at an offset to the sums of a row's chunk.
static void add_offset(const struct denoiser *d, int half, int x0, int y, int count, int dx, int dy, float (*sums)[4])
{
    const struct sample *other = d->halves[!half], *own = d->halves[half];
    float columns[CHUNK + 2] = {0};
    for (int r = -1; r <= 1; r++) {
        const size_t row = (size_t)within(y + r, d->height) * (size_t)d->width;
        const size_t to_row = (size_t)within(y + r + dy, d->height) * (size_t)d->width;
        for (int i = 0; i < count + 2; i++)
            columns[i] += noise_distance(&other[row + (size_t)within(x0 + i - 1, d->width)],
                                         &other[to_row + (size_t)within(x0 + i - 1 + dx, d->width)]);
    }
    for (int i = 0; i < count; i++) {
        const int x = x0 + i, to_x = x + dx, to_y = y + dy;
        if (to_x < 0 || to_x >= d->width || !(pixel(&d->in->halves[0], to_x, to_y)[3] > 0))
            continue;
        float apart = (columns[i] + columns[i + 1] + columns[i + 2]) * (1.0f / 9);
        const float surface = surface_distance(d, x, y, dx, dy);
        apart = apart > surface ? apart : surface;
        apart = apart > 0 ? apart : 0;
        if (!(apart < 20))
            continue;
        const float weight = exp2_of(-1.442695f * apart);
        const struct sample *q = &own[(size_t)to_y * (size_t)d->width + (size_t)to_x];
        for (int c = 0; c < 3; c++)
            sums[i][c] += weight * q->color[c];
        sums[i][3] += weight;
    }
}

static void filter_row(void *user, size_t row, int thread)
{
    (void)thread;
    const struct denoiser *d = user;
    const int y = (int)row;
    for (int x0 = 0; x0 < d->width && call_should_continue(d->call); x0 += CHUNK) {
        const int count = d->width - x0 < CHUNK ? d->width - x0 : CHUNK;
        float sums[2][CHUNK][4] = {{{0}}};
        for (int half = 0; half < 2; half++)
            for (int dy = -REACH; dy <= REACH; dy++)
                for (int dx = -REACH; dx <= REACH && y + dy >= 0 && y + dy < d->height; dx++)
                    add_offset(d, half, x0, y, count, dx, dy, sums[half]);
        for (int i = 0; i < count; i++) {
            const int x = x0 + i;
            float *out = (float *)d->out->pixels + 4 * (row * (size_t)d->width + (size_t)x);
            const float *first = pixel(&d->in->halves[0], x, y), *second = pixel(&d->in->halves[1], x, y);
            const struct sample *own = &d->halves[0][row * (size_t)d->width + (size_t)x];
            const bool noisy = own->variance[0] > 0 || own->variance[1] > 0 || own->variance[2] > 0;
            out[3] = first[3];
            for (int c = 0; c < 3; c++) {
                float mean = 0;
                for (int half = 0; half < 2; half++)
                    mean += sums[half][i][3] > 0 ? 0.5f * sums[half][i][c] / sums[half][i][3] : 0;
                out[c] = noisy && first[3] > 0 ? mean * base_of(d, x, y, c) * first[3] : 0.5f * (first[c] + second[c]);
            }
        }
    }
}

bool path_denoise(const struct path_pictures *in, lam_image *out, struct pool *pool, struct call_control *call,
                  lam_error *error)
{
    const size_t pixels = (size_t)out->width * (size_t)out->height;
    const size_t bytes = pixels * (2 * sizeof(struct sample) + 5 * sizeof(float));
    struct denoiser d = {.in = in, .width = out->width, .height = out->height, .out = out, .call = call};
    struct sample *samples = call_charge(call, bytes) ? malloc(bytes) : NULL;
    if (!samples)
        return call_memory_error(call, bytes, error);
    d.halves[0] = samples;
    d.halves[1] = samples + pixels;
    float *numbers = (float *)(samples + 2 * pixels);
    for (size_t i = 0; i < 5; i++)
        *(i < 2 ? &d.slope[i] : &d.raw[i - 2]) = numbers + i * pixels;
    pool_run(pool, (size_t)d.height, prepare_row, &d);
    pool_run(pool, (size_t)d.height, smooth_row, &d);
    pool_run(pool, (size_t)d.height, filter_row, &d);
    free(samples);
    call_refund(call, bytes);
    return call_should_continue(call) || call_error(call, error);
}
