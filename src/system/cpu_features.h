// cpu_features.h: detects the processor's instruction sets. Code that is compiled for several instruction sets selects
// its version with these functions.
#ifndef CPU_FEATURES_H
#define CPU_FEATURES_H

#include <stdbool.h>

enum cpu_feature {
    CPU_SCALAR = 0, // every machine
    CPU_SSE4 = 1,   // SSE4.2
    CPU_AVX2 = 2,   // AVX2
    CPU_AVX512 = 4, // AVX-512 F, BW, DQ, VL
    CPU_NEON = 8,
    CPU_WASM = 16, // SIMD128
};

// Returns the features of this machine. Omits features whose registers the operating system does not save.
unsigned cpu_features(void);

// Returns whether the machine has all of `features`, which may be 0.
static inline bool cpu_has(unsigned features) { return (features & ~cpu_features()) == 0; }

// Each macro contains its arguments if the build contains the versions for that instruction set. The build option `isas`
// omits instruction sets (WITHOUT_…).
#if defined(__x86_64__) && !defined(WITHOUT_SSE4)
#define CPU_IF_SSE4(...) __VA_ARGS__
#else
#define CPU_IF_SSE4(...)
#endif
#if defined(__x86_64__) && !defined(WITHOUT_AVX2)
#define CPU_IF_AVX2(...) __VA_ARGS__
#else
#define CPU_IF_AVX2(...)
#endif
#if defined(__x86_64__) && !defined(WITHOUT_AVX512)
#define CPU_IF_AVX512(...) __VA_ARGS__
#else
#define CPU_IF_AVX512(...)
#endif
#if defined(__aarch64__)
#define CPU_IF_NEON(...) __VA_ARGS__
#else
#define CPU_IF_NEON(...)
#endif
#if defined(__wasm_simd128__)
#define CPU_IF_WASM(...) __VA_ARGS__
#else
#define CPU_IF_WASM(...)
#endif

// Declares the versions of a table or function: name_scalar, name_avx2 …
#define CPU_VERSIONS(type, name)                                                                                       \
    extern type name##_scalar, name##_sse4, name##_avx2, name##_avx512, name##_neon, name##_wasm

// Select the version for the widest instruction set that the machine supports and that has at most `most` lanes.
// CPU_WIDEST is for tables with versions of 1, 8 and 16 lanes only.
#define CPU_WIDEST(most, name)                                                                                         \
    (CPU_IF_AVX512((most) >= 16 && cpu_has(CPU_AVX512) ? &name##_avx512 :)                                             \
         CPU_IF_AVX2((most) >= 8 && cpu_has(CPU_AVX2) ? &name##_avx2 :)((void)(most), &name##_scalar))
#define CPU_WIDEST_OF_ALL(most, name)                                                                                  \
    (CPU_IF_AVX512((most) >= 16 && cpu_has(CPU_AVX512) ? &name##_avx512 :)                                             \
         CPU_IF_AVX2((most) >= 8 && cpu_has(CPU_AVX2) ? &name##_avx2 :)                                                \
             CPU_IF_SSE4((most) >= 4 && cpu_has(CPU_SSE4) ? &name##_sse4 :) CPU_IF_NEON((most) >= 4 ? &name##_neon :)  \
                 CPU_IF_WASM((most) >= 4 ? &name##_wasm :)((void)(most), &name##_scalar))

#endif
