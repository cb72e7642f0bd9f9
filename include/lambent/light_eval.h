// lambent/light_eval.h: the equations at single values, for plots and tables. The numbers are those that pixels are lit
// with: the same code, one value at a time.
#ifndef LAMBENT_LIGHT_EVAL_H
#define LAMBENT_LIGHT_EVAL_H

#include "device.h"
#include "light.h"

#ifdef __cplusplus
extern "C" {
#endif

// What is left of a point or spot light at this distance (≥ 0, in the light's units), by its attenuation and its range:
// 0 where the sum of the attenuation is 0. 1 for the other types. The light must pass lam_light_check.
LAM_API float lam_attenuation_at(const lam_light *light, float distance);

// The factor of a spot light's cone for a point this far (radians) off its axis, 0..1. 1 for the other types.
LAM_API float lam_spot_at(const lam_light *light, double angle_rad);

// The strength S of the highlight, 0..1, with the light straight above the surface (l = n) and the eye `angle_rad` away
// from it, 0..π: the angle between the mirrored light and the eye, φ; half of it lies between normal and half vector,
// ψ. LAM_REFLECTION_PHONG gives cos(φ)^shininess, LAM_REFLECTION_BLINN_PHONG (or AUTO) cos(φ/2)^shininess; models
// without a highlight, and Kajiya–Kay, which needs a thread, give 0. `shininess` ≥ 0, finite.
LAM_API float lam_highlight_at(lam_reflection reflection, float shininess, double angle_rad);

#ifdef __cplusplus
}
#endif
#endif
