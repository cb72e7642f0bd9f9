// cpu_features.h: what the processor can do.
#ifndef CPU_FEATURES_H
#define CPU_FEATURES_H

enum cpu_feature {
    CPU_SSE4 = 1,   // SSE4.2
    CPU_AVX2 = 2,   // AVX2, with the operating system saving its registers
    CPU_AVX512 = 4, // AVX-512 F, BW, DQ, VL, likewise
    CPU_NEON = 8,
};

// The set of cpu_feature of this machine.
unsigned cpu_features(void);

#endif
