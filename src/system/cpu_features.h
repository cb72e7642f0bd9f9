// cpu_features.h: detects the processor's instruction sets. Code that is compiled for several instruction sets selects
// its version with these functions.
#ifndef CPU_FEATURES_H
#define CPU_FEATURES_H

#include <stdbool.h>

enum cpu_feature {
    CPU_SSE4 = 1,   // SSE4.2
    CPU_AVX2 = 2,   // AVX2
    CPU_AVX512 = 4, // AVX-512 F, BW, DQ, VL
    CPU_NEON = 8,
    CPU_WASM_SIMD = 16, // SIMD128
};

// Returns the features of this machine. Omits features whose registers the operating system does not save.
unsigned cpu_features(void);

// Returns whether the machine has all of `features`, which may be 0.
static inline bool cpu_has(unsigned features) { return (features & ~cpu_features()) == 0; }

// Selects one of several versions (with 1, 8 and 16 lanes): the widest that the machine supports and that has at most
// `lanes` lanes. On machines other than x86 the wider versions are not compiled and their names are not used.
#if defined(__x86_64__)
#define CPU_WIDEST(lanes, scalar, avx2, avx512)                                                                        \
    ((lanes) >= 16 && cpu_has(CPU_AVX512) ? (avx512) : (lanes) >= 8 && cpu_has(CPU_AVX2) ? (avx2) : (scalar))
#else
#define CPU_WIDEST(lanes, scalar, avx2, avx512) ((void)(lanes), (scalar))
#endif

#endif
