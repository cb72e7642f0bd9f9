// cpu_features.c: the instruction sets of the processor.
#include "cpu_features.h"

unsigned cpu_features(void)
{
    unsigned features = 0;
#if defined(__x86_64__) || defined(__i386__)
    __builtin_cpu_init(); // also checks whether the operating system saves the wide registers
    if (__builtin_cpu_supports("sse4.2"))
        features |= CPU_SSE4;
    if (__builtin_cpu_supports("avx2"))
        features |= CPU_AVX2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        features |= CPU_AVX512;
#elif defined(__aarch64__)
    features |= CPU_NEON; // part of every 64-bit Arm processor
#elif defined(__wasm_simd128__)
    features |= CPU_WASM; // a module with SIMD can be loaded only if the host supports it
#endif
    return features;
}
