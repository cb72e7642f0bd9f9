// cube_sums.c: cubes of which every texel is a weighted mean of all texels of a small copy of an environment, for weights
// that change slowly. LANES texels of the result at a time.
#define LANES 4
#include "lanes.h"

#include "environment_light.h"
#include "fail.h"

#include <stdlib.h>

enum { SOURCE_SIZE = 20, ROW_MAX = 64 };

struct cube_sums {
    size_t count;
    float texel[][8]; // unit direction, share of the sphere, red, green and blue times that
};

static void unit(const double d[3], float out[3])
{
    double length = __builtin_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++)
        out[i] = (float)(d[i] / length);
}

static void texel_direction(int size, int face, int s, int t, float out[3])
{
    double d[3];
    cube_direction(face, size, 2 * s + 1 - size, 2 * t + 1 - size, d);
    unit(d, out);
}

struct cube_sums *cube_sums_make(const struct cube_chain *chain, lam_error *error)
{
    const struct lam_environment *cube = cube_chain_near(chain, SOURCE_SIZE);
    size_t count = (size_t)cube->size * (size_t)cube->size * LAM_FACE_COUNT;
    size_t bytes = sizeof(struct cube_sums) + count * sizeof(float[8]);
    struct cube_sums *sums = malloc(bytes);
    if (!sums) {
        fail_memory(error, bytes);
        return NULL;
    }
    sums->count = count;
    double total = 0; // of the solid angles, which are made shares: no sum exceeds the brightest light
    for (int t = 0; t < cube->size; t++)
        for (int i = 0; i < cube->size; i++)
            total += LAM_FACE_COUNT * (double)texel_weight(cube->size, i, t);
    float(*out)[8] = sums->texel;
    for (int face = 0; face < LAM_FACE_COUNT; face++)
        for (int t = 0; t < cube->size; t++)
            for (int s = 0; s < cube->size; s++, out++) {
                const float *light = cube_texel(cube, face, s, t);
                texel_direction(cube->size, face, s, t, *out);
                (*out)[3] = (float)((double)texel_weight(cube->size, s, t) / total);
                for (int c = 0; c < 3; c++)
                    (*out)[4 + c] = light[c] * (*out)[3];
                (*out)[7] = 0;
            }
    return sums;
}

void cube_sums_row(const struct cube_sums *sums, double alpha, struct lam_environment *cube, int face, int t)
{
    _Alignas(16) float n[3][ROW_MAX];
    for (int s = 0; s < cube->size; s++) {
        float d[3];
        texel_direction(cube->size, face, s, t, d);
        for (int c = 0; c < 3; c++)
            n[c][s] = d[c];
    }
    // With c = cos(angle) and (n.h)² = (1 + c) / 2, GGX's lobe is D(h) c ~ c / (1 − q (1 + c))², q = (1 − alpha²) / 2; times
    // alpha⁴, at most 1.
    float q = alpha < 0 ? 0 : (float)((1 - alpha * alpha) / 2), square = (float)(alpha * alpha);
    for (int s = 0; s < cube->size; s += LANES) {
        num x = num_load(n[0] + s), y = num_load(n[1] + s), z = num_load(n[2] + s);
        num total = num_of(0), r = num_of(0), g = num_of(0), b = num_of(0);
        for (size_t i = 0; i < sums->count; i++) {
            const float *from = sums->texel[i];
            num cosine = max_of(x * from[0] + y * from[1] + z * from[2], num_of(0)), weight = cosine;
            if (q > 0) {
                num part = square / (1.0f - q * (1.0f + cosine));
                weight = cosine * (part * part);
            }
            total += weight * from[3];
            r += weight * from[4];
            g += weight * from[5];
            b += weight * from[6];
        }
        const num mean[3] = {r / total, g / total, b / total};
        for (int k = 0; k < LANES; k++)
            for (int c = 0; c < 3; c++)
                cube_texel(cube, face, s + k, t)[c] = lane(mean[c], k);
    }
}
