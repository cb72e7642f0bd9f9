// isa.c: the selectable instruction sets of the CPU device.
#include "isa.h"

#include "cpu_features.h"
#include "kernels.h"

static const char *const isa_names[LAM_ISA_COUNT] = {"auto", "scalar", "sse4", "avx2", "avx512", "neon", "wasm"};

const char *lam_isa_name(lam_isa isa) { return (unsigned)isa < LAM_ISA_COUNT ? isa_names[isa] : NULL; }

const struct kernels *kernels_of(lam_isa isa)
{
    static const struct {
        unsigned features;
        const struct kernels *kernels;
    } all[LAM_ISA_COUNT] = {
        [LAM_ISA_SCALAR] = {0, &kernels_scalar},
#if defined(__x86_64__)
        [LAM_ISA_SSE4] = {CPU_SSE4, &kernels_sse4},
        [LAM_ISA_AVX2] = {CPU_AVX2, &kernels_avx2},
        [LAM_ISA_AVX512] = {CPU_AVX512, &kernels_avx512},
#elif defined(__aarch64__)
        [LAM_ISA_NEON] = {CPU_NEON, &kernels_neon},
#elif defined(__wasm_simd128__)
        [LAM_ISA_WASM] = {CPU_WASM_SIMD, &kernels_wasm},
#endif
    };
    return (unsigned)isa < LAM_ISA_COUNT && cpu_has(all[isa].features) ? all[isa].kernels : NULL;
}

bool lam_isa_usable(lam_isa isa) { return isa == LAM_ISA_AUTO || kernels_of(isa) != NULL; }

lam_isa widest_isa(void)
{
    for (int isa = LAM_ISA_COUNT - 1; isa > LAM_ISA_AUTO; isa--)
        if (kernels_of((lam_isa)isa))
            return (lam_isa)isa;
    return LAM_ISA_SCALAR;
}
