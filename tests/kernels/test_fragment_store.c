// test_fragment_store.c: stored fragments of a tile are loaded unchanged, by the kernels of every instruction set, for
// every number of samples, with triangle numbers near one another and far apart.
#include "test.h"
#include "arena.h"
#include "fragment_store.h"
#include "fragments.h"
#include "isa.h"
#include "kernels.h"
#include "samples.h"

enum { MAX = TILE * TILE * SAMPLES_MAX };

struct rows {
    uint32_t id[MAX];
    uint16_t pixel[MAX];
    uint8_t weight[MAX], sample[MAX];
};

static uint32_t random_below(uint64_t *seed, uint32_t end)
{
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)((*seed >> 33) % end);
}

static struct fragments fragments_of(struct rows *rows, int count)
{
    return (struct fragments){
        .count = count, .id = rows->id, .pixel = rows->pixel, .weight = rows->weight, .sample = rows->sample};
}

// Numbers from `lowest` to `highest`, both of which occur.
static void comes_back(const struct kernels *kernels, int samples, int count, uint32_t lowest, uint32_t highest)
{
    struct rows *in = calloc(1, sizeof *in), *out = calloc(1, sizeof *out);
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
    struct fragments from = fragments_of(in, count), to = fragments_of(out, 0);
    struct fragment_store fragment_store = {.lowest = lowest};
    assert_true(kernels->raster->save_fragments(&fragment_store, &from, samples, highest, &arena));
    kernels->raster->load_fragments(&fragment_store, &to, samples);
    assert_int_equal(to.count, count);
    assert_memory_equal(out, in, sizeof *in);
    arena_free(&arena);
    free(in);
    free(out);
}

TEST(fragments_come_back)
{
    const int numbers[] = {1, 2, 4, 8, 16}, counts[] = {1, 2, 3, 63, 4097};
    const uint32_t last = 0x7FFFFFFF;
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++) {
        const struct kernels *kernels = kernels_of((lam_isa)isa);
        for (int s = 0; kernels && s < 5; s++)
            for (int c = 0; c < 5; c++) {
                comes_back(kernels, numbers[s], counts[c], 5, 5);
                comes_back(kernels, numbers[s], counts[c], 0, (1 << 23) - 1);
                comes_back(kernels, numbers[s], counts[c], 77, 77 + (1 << 23) - 1);
                comes_back(kernels, numbers[s], counts[c], 77, 77 + (1 << 23));
                comes_back(kernels, numbers[s], counts[c], 0, last);
                comes_back(kernels, numbers[s], counts[c], last - 3, last);
            }
    }
}
