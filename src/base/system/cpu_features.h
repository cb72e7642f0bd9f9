// cpu_features.h: the instruction sets of the processor. Everything that is compiled for several of them asks here.
#ifndef CPU_FEATURES_H
#define CPU_FEATURES_H

#include <stdbool.h>

enum cpu_feature {
    CPU_SSE4 = 1,        // SSE4.2
    CPU_AVX2 = 2,        // AVX2
    CPU_AVX512 = 4,      // AVX-512 F, BW, DQ, VL
    CPU_AVX512_VBMI = 8, // AVX-512 VBMI, and BMI2
    CPU_NEON = 16,
    CPU_WASM_SIMD = 32, // SIMD128
};

// Returns the features of this machine. The operating system saves the registers of each.
unsigned cpu_features(void);

// Returns whether the machine has all of `features`; 0 names none.
static inline bool cpu_has(unsigned features) { return (features & ~cpu_features()) == 0; }

// Chooses from versions of one type for 1, 8 and 16 lanes the widest that the machine has and that has at most `lanes`.
// On machines other than x86 the wider versions are not in the build and their names are not used.
#if defined(__x86_64__)
#define CPU_WIDEST(lanes, scalar, avx2, avx512)                                                                        \
    ((lanes) >= 16 && cpu_has(CPU_AVX512) ? (avx512) : (lanes) >= 8 && cpu_has(CPU_AVX2) ? (avx2) : (scalar))
#else
#define CPU_WIDEST(lanes, scalar, avx2, avx512) ((void)(lanes), (scalar))
#endif

#endif
