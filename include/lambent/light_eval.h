// lambent/light_eval.h: the laws of light at single values, for plots and tables.
//
// The code that lights pixels computes the numbers, one value at a time.
#ifndef LAMBENT_LIGHT_EVAL_H
#define LAMBENT_LIGHT_EVAL_H

#include "device.h"
#include "light.h"

#ifdef __cplusplus
extern "C" {
#endif

// Returns the attenuation of a point or spot light at a distance ≥ 0 in model units, including its range:
//   window(d) / (constant + linear·d + quadratic·d²)
// 0 where the sum is 0, and 1 for lights of other types. The light must pass lam_light_check.
LAM_API float lam_attenuation_at(const lam_light *light, float distance);

// Returns the cone's factor of a spot light, 0..1, for a point that lies `angle_rad` off its axis. 1 for lights of
// other types.
LAM_API float lam_spot_at(const lam_light *light, double angle_rad);

// Returns the highlight's strength S, 0..1, with the light straight above the surface (l = n) and the eye `angle_rad`
// away from it, 0..π. That angle φ lies between the mirrored light and the eye, and half of it, ψ, between the normal
// and the half vector:
//   LAM_REFLECTION_PHONG                  S = cos(φ)^shininess
//   LAM_REFLECTION_BLINN_PHONG, …_AUTO    S = cos(φ/2)^shininess
// 0 for models without a highlight, and for models of threads, which need a tangent. `shininess` ≥ 0, finite.
LAM_API float lam_highlight_at(lam_reflection reflection, float shininess, double angle_rad);

#ifdef __cplusplus
}
#endif
#endif
