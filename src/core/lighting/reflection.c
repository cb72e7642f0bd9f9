// reflection.c: implements lam_reflection_describe: names and descriptions of the reflection models
// (src/core/lighting/lobes.h).
#define LANES 1
#include "lighting.h"

#include <stddef.h>

#define TEXT_OR_NULL(text) (sizeof(text) > 1 ? (text) : NULL)
#define LOBE(NAME, call, flags, name, text, diffuse_formula, base_formula)                                             \
    [LAM_REFLECTION_##NAME] = {.word = name,                                                                           \
                               .summary = text,                                                                        \
                               .diffuse = diffuse_formula,                                                             \
                               .base = TEXT_OR_NULL(base_formula),                                                     \
                               .tangents = ((flags) & LOBE_TANGENT) != 0,                                              \
                               .microfacet = ((flags) & LOBE_MICROFACET) != 0,                                         \
                               .toned = ((flags) & LOBE_TONED) != 0,                                                   \
                               .backlit = ((flags) & LOBE_BACKLIT) != 0,                                               \
                               .backlit_fibre = ((flags) & LOBE_BACKLIT_FIBRE) != 0},

static const lam_reflection_info models[LAM_REFLECTION_COUNT] = {
    [LAM_REFLECTION_AUTO] =
        {.word = "auto",
         .summary = "the material's own model: ggx for physical materials, blinn-phong for classic materials"},
    [LAM_REFLECTION_NONE] = {.word = "none", .summary = "the diffuse colour, unlit"},
    LOBES(LOBE)};

const lam_reflection_info *lam_reflection_describe(lam_reflection model)
{
    return (unsigned)model < LAM_REFLECTION_COUNT ? &models[model] : NULL;
}
