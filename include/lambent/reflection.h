// lambent/reflection.h: the reflection models.
#ifndef LAMBENT_REFLECTION_H
#define LAMBENT_REFLECTION_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// Reflection models (docs/lighting.md lists their equations and sources).
typedef enum lam_reflection {
    // Depends on the material: none if it is unlit, GGX if it is physical, otherwise Blinn–Phong.
    LAM_REFLECTION_AUTO = 0,
    LAM_REFLECTION_NONE,               // the diffuse colour, unlit
    LAM_REFLECTION_LAMBERT,            // no highlight
    LAM_REFLECTION_PHONG,              // highlight from the mirrored light direction
    LAM_REFLECTION_BLINN_PHONG,        // highlight from the half vector
    LAM_REFLECTION_KAJIYA_KAY,         // threads along the tangents
    LAM_REFLECTION_KAJIYA_KAY_LECTURE, // the form that lectures print
    LAM_REFLECTION_OREN_NAYAR,         // rough diffuse surfaces, no highlight
    LAM_REFLECTION_GGX,                // microfacet model for metals and dielectrics, as in glTF
    LAM_REFLECTION_TOON,               // flat steps of light and a highlight with an edge
    LAM_REFLECTION_GOOCH,              // warm colours towards the light, cool colours away from it
    LAM_REFLECTION_COUNT
} lam_reflection;

// The description of a reflection model. Its formulas (UTF-8) give the light of one source as in lam_material:
//  diffuse ⊙ Ld · D + specular ⊙ Ls · base^α.
typedef struct lam_reflection_info {
    const char *word;    // name in options, scene files and reports: "blinn-phong"
    const char *summary; // one line
    // D: "max(n·l, 0)"; NULL: auto and none. A formula that does not begin with "max(" is also gated by [n·l > 0],
    // unless the model is backlit.
    const char *diffuse;
    const char *base; // of the highlight: "max(n·h, 0)"; NULL: no highlight
    // Whether the model uses the mesh's tangents, or a direction field if there are none.
    bool tangents;
    // Whether light from behind the surface (n·l ≤ 0) contributes: always, or only for fibres.
    bool backlit, backlit_fibre;
    // Whether the model lights physical materials; the Fresnel factor then colours its highlight.
    bool microfacet;
    // Whether the second term is Gooch's tone: specular ⊙ Ls ⊙ (w, w, 1 − w) with w = (1 + n·l)/2.
    bool toned;
    LAM_RESERVED(7);
} lam_reflection_info;

// Returns the description of a reflection model, or NULL if there is no such model.
LAM_API const lam_reflection_info *lam_reflection_describe(lam_reflection model);

#ifdef __cplusplus
}
#endif
#endif
