// isa.c: the selectable instruction sets of the CPU device.
#include "isa.h"

#include "cpu_features.h"
#include "kernels.h"

CPU_VERSIONS(const struct raster_kernels, raster_kernels);
CPU_VERSIONS(const struct shade_kernels, shade_kernels);
#if defined(__wasm_simd128__)
// A web module may be linked without the scalar version, because every browser supports SIMD (web/meson.build).
#pragma weak raster_kernels_scalar
#pragma weak shade_kernels_scalar
#endif

static const char *const isa_names[LAM_ISA_COUNT] = {"auto", "scalar", "sse4", "avx2", "avx512", "neon", "wasm"};

const char *lam_isa_name(lam_isa isa) { return (unsigned)isa < LAM_ISA_COUNT ? isa_names[isa] : NULL; }

const struct kernels *kernels_of(lam_isa isa)
{
#define VERSION(NAME, name, lanes)                                                                                     \
    [LAM_ISA_##NAME] = {CPU_##NAME, {#name, lanes, &raster_kernels_##name, &shade_kernels_##name}},
    static const struct {
        unsigned features;
        struct kernels kernels;
    } all[LAM_ISA_COUNT] = {VERSION(SCALAR, scalar, 1) CPU_IF_SSE4(VERSION(SSE4, sse4, 4))
                                CPU_IF_AVX2(VERSION(AVX2, avx2, 8)) CPU_IF_AVX512(VERSION(AVX512, avx512, 16))
                                    CPU_IF_NEON(VERSION(NEON, neon, 4)) CPU_IF_WASM(VERSION(WASM, wasm, 4))};
    bool usable = (unsigned)isa < LAM_ISA_COUNT && all[isa].kernels.raster && cpu_has(all[isa].features);
    return usable ? &all[isa].kernels : NULL;
}

bool lam_isa_usable(lam_isa isa) { return isa == LAM_ISA_AUTO || kernels_of(isa) != NULL; }

lam_isa widest_isa(void)
{
    for (int isa = LAM_ISA_COUNT - 1; isa > LAM_ISA_AUTO; isa--)
        if (kernels_of((lam_isa)isa))
            return (lam_isa)isa;
    return LAM_ISA_SCALAR;
}
