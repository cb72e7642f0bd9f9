// arithmetic.c: prints the floating-point operations per second of a core as JSON, in 10^9/s. It measures products and
// sums that are rounded separately, as in the library, and fused multiply-adds. A fused multiply-add counts as two
// operations. The program runs independent chains of operations in registers. It measures several numbers of chains and
// prints the best result, because enough chains hide the latency.
#include <stdio.h>

#if defined(__x86_64__)
#include <immintrin.h>
#include <time.h>

enum { ROUNDS = 12, TURNS = 200000 };

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

// Defines a function that measures one instruction set with a number of chains. `FUSED` is 0 or 1.
#define MEASURE(NAME, TARGET, TYPE, LANES, CHAINS, FUSED, SET, MULTIPLY, ADD, FMA)                                     \
    __attribute__((target(TARGET))) static double NAME(void)                                                           \
    {                                                                                                                  \
        double best = 1e9;                                                                                             \
        for (int round = 0; round < ROUNDS; round++) {                                                                 \
            TYPE chain[CHAINS], factor = SET(0.9999999f), term = SET(1e-9f);                                           \
            for (int i = 0; i < CHAINS; i++)                                                                           \
                chain[i] = SET(1.0f + (float)i * 0.01f);                                                               \
            double start = now_s();                                                                                    \
            for (int turn = 0; turn < TURNS; turn++) {                                                                 \
                _Pragma("GCC unroll 32") for (int i = 0; i < CHAINS; i++) chain[i] =                                   \
                    FUSED ? FMA(chain[i], factor, term) : MULTIPLY(chain[i], factor);                                  \
                _Pragma("GCC unroll 32") for (int i = 0; i < CHAINS; i++) chain[i] =                                   \
                    FUSED ? FMA(chain[i], factor, term) : ADD(chain[i], term);                                         \
            }                                                                                                          \
            double taken = now_s() - start;                                                                            \
            for (int i = 0; i < CHAINS; i++)                                                                           \
                __asm__ volatile("" ::"x"(chain[i]));                                                                  \
            best = taken < best ? taken : best;                                                                        \
        }                                                                                                              \
        return (FUSED ? 4.0 : 2.0) * CHAINS * LANES * TURNS / best / 1e9;                                              \
    }

#define AVX512(NAME, CHAINS, FUSED)                                                                                    \
    MEASURE(NAME, "avx512f", __m512, 16, CHAINS, FUSED, _mm512_set1_ps, _mm512_mul_ps, _mm512_add_ps, _mm512_fmadd_ps)
#define AVX2(NAME, CHAINS, FUSED)                                                                                      \
    MEASURE(NAME, "avx2,fma", __m256, 8, CHAINS, FUSED, _mm256_set1_ps, _mm256_mul_ps, _mm256_add_ps, _mm256_fmadd_ps)

AVX512(avx512_apart_12, 12, 0)
AVX512(avx512_apart_20, 20, 0)
AVX512(avx512_apart_28, 28, 0)
AVX512(avx512_fused_12, 12, 1)
AVX512(avx512_fused_20, 20, 1)
AVX2(avx2_apart_10, 10, 0)
AVX2(avx2_apart_14, 14, 0)
AVX2(avx2_fused_10, 10, 1)
AVX2(avx2_fused_14, 14, 1)

static double most(double a, double b) { return a > b ? a : b; }

int main(void)
{
    printf("{");
    if (__builtin_cpu_supports("avx512f"))
        printf("\"avx512\": {\"unfused\": %.1f, \"fused\": %.1f}, ",
               most(avx512_apart_12(), most(avx512_apart_20(), avx512_apart_28())),
               most(avx512_fused_12(), avx512_fused_20()));
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        printf("\"avx2\": {\"unfused\": %.1f, \"fused\": %.1f}", most(avx2_apart_10(), avx2_apart_14()),
               most(avx2_fused_10(), avx2_fused_14()));
    printf("}\n");
    return 0;
}
#else
int main(void)
{
    fprintf(stderr, "arithmetic: written for x86-64\n");
    return 3;
}
#endif
