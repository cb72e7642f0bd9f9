// cube_sums.c: cubes of which every texel is a weighted mean of all texels of a small copy of an environment, for weights
// that change slowly.
#include "environment_kernels.h"
#include "fail.h"

#include <stdlib.h>

enum { SOURCE_SIZE = 20 }; // about: texels on a side of the copy

static void unit(const double d[3], float out[3])
{
    double length = __builtin_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++)
        out[i] = (float)(d[i] / length);
}

void texel_direction(int size, int face, int s, int t, float out[3])
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
