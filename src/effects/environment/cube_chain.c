// cube_chain.c: builds a chain of copies of a cube map, each half the size of the previous one.
#include "environment_light.h"

#include "call_control.h"
#include "fail.h"
#include "pages.h"
#include "pool.h"

enum {
    SMALLEST = 4,        // texels per side of the last copy
    WEIGHTED_BELOW = 128 // in larger cubes, neighbouring texels have nearly equal solid angles
};

float texel_weight(int size, int s, int t)
{
    float x = ((float)(2 * s + 1) - (float)size) / (float)size, y = ((float)(2 * t + 1) - (float)size) / (float)size;
    float square = 1.0f + x * x + y * y;
    return 1.0f / (square * __builtin_sqrtf(square));
}

// A row of `n` source texels is divided into `m` texels. Returns the fraction of source texel `i` that is inside texel
// `k`.
static float overlap(int i, int n, int k, int m)
{
    int64_t low = (int64_t)i * m, high = low + m, from = (int64_t)k * n, to = from + n; // in units of 1 / (n m)
    int64_t shared = (high < to ? high : to) - (low > from ? low : from);
    return shared > 0 ? (float)shared / (float)m : 0;
}

struct shrinking {
    const struct lam_environment *from;
    struct lam_environment *to;
    struct call_control *call;
};

static void shrink_texel(const struct lam_environment *from, int face, int s, int t, int size, float out[3])
{
    int n = from->size, s0 = (int)((int64_t)s * n / size), t0 = (int)((int64_t)t * n / size);
    float across[4], down[4], weight[4][4], total = 0;
    for (int i = 0; i < 4; i++) {
        across[i] = s0 + i < n ? overlap(s0 + i, n, s, size) : 0;
        down[i] = t0 + i < n ? overlap(t0 + i, n, t, size) : 0;
    }
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++) {
            float w = across[i] * down[j];
            weight[j][i] = w > 0 && n < WEIGHTED_BELOW ? w * texel_weight(n, s0 + i, t0 + j) : w;
            total += weight[j][i];
        }
    float sum[3] = {0, 0, 0};
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++) {
            if (!(weight[j][i] > 0))
                continue;
            const float *texel = cube_texel(from, face, s0 + i, t0 + j);
            for (int c = 0; c < 3; c++)
                sum[c] += texel[c] * (weight[j][i] / total);
        }
    for (int c = 0; c < 3; c++)
        out[c] = sum[c];
}

static void shrink_row(void *user, size_t index, int thread)
{
    (void)thread;
    const struct shrinking *work = user;
    int size = work->to->size, face = (int)(index / (size_t)size), t = (int)(index % (size_t)size);
    if (work->call && !call_should_continue(work->call))
        return;
    if (work->from->size != 2 * size || work->from->size < WEIGHTED_BELOW) {
        for (int s = 0; s < size; s++)
            shrink_texel(work->from, face, s, t, size, cube_texel(work->to, face, s, t));
        return;
    }
    float *out = cube_texel(work->to, face, 0, t); // the common case: four texels become one
    const float *a = cube_texel(work->from, face, 0, 2 * t), *b = cube_texel(work->from, face, 0, 2 * t + 1);
    for (int s = 0; s < size; s++, a += 6, b += 6)
        for (int c = 0; c < 3; c++)
            *out++ = (0.25f * a[c] + 0.25f * a[c + 3]) + (0.25f * b[c] + 0.25f * b[c + 3]);
}

bool cube_chain_make(struct cube_chain *chain, const struct lam_environment *cube, struct pool *pool,
                     struct call_control *call, lam_error *error)
{
    *chain = (struct cube_chain){.count = 1};
    chain->cube[0] = *cube;
    size_t bytes = CUBE_TEXELS_AFTER;
    for (int size = cube->size / 2; size >= SMALLEST; size /= 2) {
        chain->cube[chain->count++].size = size;
        bytes += cube_bytes(size);
    }
    chain->texels = pages_get(bytes, &chain->held);
    if (!chain->texels)
        return fail_memory(error, bytes);
    float *at = chain->texels;
    for (int i = 1; i < chain->count; i++) {
        struct lam_environment *to = &chain->cube[i];
        to->texels = at;
        at += cube_bytes(to->size) / sizeof *at;
        struct shrinking work = {&chain->cube[i - 1], to, call};
        pool_run(pool, (size_t)to->size * LAM_FACE_COUNT, shrink_row, &work);
        if (call && !call_should_continue(call)) {
            cube_chain_free(chain);
            return call_error(call, error);
        }
        cube_close(to);
    }
    return true;
}

void cube_chain_free(struct cube_chain *chain)
{
    pages_free(chain->texels, chain->held);
    chain->texels = NULL;
}

const struct lam_environment *cube_chain_near(const struct cube_chain *chain, double size)
{
    int i = 0;
    // Chooses the size with the ratio to `size` that is nearest to 1. The geometric mean of two neighbouring sizes is
    // the limit between them.
    while (i + 1 < chain->count && size * size < (double)chain->cube[i].size * (double)chain->cube[i + 1].size)
        i++;
    return &chain->cube[i];
}
