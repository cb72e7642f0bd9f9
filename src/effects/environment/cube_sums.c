// cube_sums.c: computes cubes whose texels are weighted means of all texels of a small copy of an environment. This
// method suits weights that vary slowly with the direction.
#include "environment_kernels.h"
#include "fail.h"

#include <stdlib.h>

enum { SOURCE_SIZE = 20 }; // approximate number of texels per side of the copy

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
    int n = cube->size;
    size_t count = (size_t)n * (size_t)n * LAM_FACE_COUNT / 2;
    size_t bytes = sizeof(struct cube_sums) + count * sizeof(struct opposite_texels);
    struct cube_sums *sums = malloc(bytes);
    if (!sums)
        return fail_memory(error, bytes), NULL;
    sums->count = count;
    double total = 0; // sum of the solid angles; each solid angle is divided by the sum, so that no mean exceeds the
                      // brightest light
    for (int t = 0; t < n; t++)
        for (int s = 0; s < n; s++)
            total += LAM_FACE_COUNT * (double)texel_weight(n, s, t);
    struct opposite_texels *out = sums->pair;
    for (int face = 0; face < LAM_FACE_COUNT; face += 2)
        for (int t = 0; t < n; t++)
            for (int s = 0; s < n; s++, out++) {
                const float *light = cube_texel(cube, face, s, t), *behind = cube_opposite(cube, face, s, t);
                texel_direction(n, face, s, t, out->direction);
                out->share = (float)((double)texel_weight(n, s, t) / total);
                for (int c = 0; c < 3; c++) {
                    out->light[c] = light[c] * out->share;
                    out->light_behind[c] = behind[c] * out->share;
                }
            }
    return sums;
}
