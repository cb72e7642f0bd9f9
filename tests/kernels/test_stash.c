// test_stash.c: what is kept of a tile's fragments comes back as it was, from every instruction set's kernels
// and for every number of samples, with triangles near one another and far apart.
#include "cpu_features.h"
#include "kernels.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = TILE * TILE * SAMPLES_MAX };

struct fragments {
    uint32_t id[MOST];
    uint16_t pixel[MOST];
    uint8_t weight[MOST], sample[MOST];
};

static uint32_t random_below(uint64_t *seed, uint32_t end)
{
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)((*seed >> 33) % end);
}

static struct thread_state thread_of(struct fragments *f, int count)
{
    return (struct thread_state){.fragment_id = f->id,
                                 .fragment_pixel = f->pixel,
                                 .fragment_weight = f->weight,
                                 .fragment_sample = f->sample,
                                 .fragment_count = count};
}

// Numbers from `lowest` to `highest`, both of which occur.
static void comes_back(const struct kernels *kernels, int samples, int count, uint32_t lowest, uint32_t highest)
{
    struct fragments *in = calloc(1, sizeof *in), *out = calloc(1, sizeof *out);
    uint64_t seed = (uint64_t)samples + highest;
    for (int i = 0; i < count; i++) {
        in->id[i] = i == 0 ? highest : i == 1 ? lowest : lowest + random_below(&seed, highest - lowest + 1);
        in->id[i] |= random_below(&seed, 2) ? BACK_SIDE : 0;
        in->pixel[i] = (uint16_t)random_below(&seed, TILE * TILE);
        in->weight[i] = (uint8_t)(1 + random_below(&seed, (uint32_t)samples));
        in->sample[i] = (uint8_t)random_below(&seed, (uint32_t)samples);
    }
    struct arena arena;
    arena_start(&arena, NULL);
    struct thread_state from = thread_of(in, count), to = thread_of(out, 0);
    struct fragment_store fragment_store = {.lowest = lowest};
    assert_true(kernels->save_fragment_store(&fragment_store, &from, samples, highest, &arena));
    kernels->load_fragment_store(&fragment_store, &to, samples);
    assert_int_equal(to.fragment_count, count);
    assert_memory_equal(out, in, sizeof *in);
    arena_free(&arena);
    free(in);
    free(out);
}

static void stashes_come_back(void **state)
{
    (void)state;
    const struct kernels *all[] = {
        &kernels_scalar,
#if defined(__x86_64__)
        cpu_features() & CPU_SSE4 ? &kernels_sse4 : NULL,
        cpu_features() & CPU_AVX2 ? &kernels_avx2 : NULL,
        cpu_features() & CPU_AVX512 ? &kernels_avx512 : NULL,
#elif defined(__aarch64__)
        &kernels_neon,
#endif
    };
    const int numbers[] = {1, 2, 4, 8, 16}, counts[] = {1, 2, 3, 63, 4097};
    const uint32_t last = 0x7FFFFFFF;
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        for (int s = 0; all[k] && s < 5; s++)
            for (int c = 0; c < 5; c++) {
                comes_back(all[k], numbers[s], counts[c], 5, 5);
                comes_back(all[k], numbers[s], counts[c], 0, (1 << 23) - 1);
                comes_back(all[k], numbers[s], counts[c], 77, 77 + (1 << 23) - 1);
                comes_back(all[k], numbers[s], counts[c], 77, 77 + (1 << 23));
                comes_back(all[k], numbers[s], counts[c], 0, last);
                comes_back(all[k], numbers[s], counts[c], last - 3, last);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(stashes_come_back)};
    return cmocka_run_group_tests_name("fragment_store", tests, NULL, NULL);
}
