// lambent/light_eval.h: computes attenuation, cones and highlights for single values, for plots and tables.
//
// The numbers are computed by the code that lights pixels, one value at a time.
#ifndef LAMBENT_LIGHT_EVAL_H
#define LAMBENT_LIGHT_EVAL_H

#include "device.h"
#include "light.h"

#ifdef __cplusplus
extern "C" {
#endif

// Returns the attenuation of a point or spot light at a distance ≥ 0 in model units, including its range:
//  window(d) / (constant + linear·d + quadratic·d²)
// The result is 0 if the sum is 0, and 1 for lights of other types. The light must pass lam_light_check.
LAM_API float lam_attenuation_at(const lam_light *light, float distance);

// Returns the cone's factor of a spot light, 0..1, for a point that is `angle_rad` off its axis. Returns 1 for lights
// of other types.
LAM_API float lam_spot_at(const lam_light *light, double angle_rad);

// Returns the highlight's strength S, 0..1, with the light straight above the surface (l = n) and the eye at the angle
// `angle_rad` from the light, 0..π. That angle φ is the angle between the mirrored light and the eye; half of it, ψ, is
// the angle between the normal and the half vector:
//  LAM_REFLECTION_PHONG                  S = cos(φ)^shininess
//  LAM_REFLECTION_BLINN_PHONG, …_AUTO    S = cos(φ/2)^shininess
// Returns 0 for models without a highlight, and for models of threads, which need a tangent. `shininess` is finite and
// ≥ 0.
LAM_API float lam_highlight_at(lam_reflection reflection, float shininess, double angle_rad);

#ifdef __cplusplus
}
#endif
#endif
