// surroundings_at.h: the environment around LANES surfaces (sum.h, surroundings_light). Include with LANES defined.
#ifndef SURROUNDINGS_AT_H
#define SURROUNDINGS_AT_H

#include "frame.h"
#include "lighting.h"
#include "prefiltered_lookup.h"

_Static_assert((int)PREFILTERED_LAST == ENVIRONMENT_LEVELS - 1, "lobes.h and environment_light.h have the same levels");

LANE_FN vec3 to_environment_axes(const struct frame *frame, vec3 w)
{
    const float(*m)[3] = frame->to_environment;
    return vec3_of((m[0][0] * w.x + m[0][1] * w.y) + m[0][2] * w.z, (m[1][0] * w.x + m[1][1] * w.y) + m[1][2] * w.z,
                   (m[2][0] * w.x + m[2][1] * w.y) + m[2][2] * w.z);
}

// The surroundings of a surface of that roughness.
LANE_FN surroundings surroundings_at(const struct frame *frame, const struct environment_light *light, surface s,
                                     num roughness)
{
    surroundings e;
    vec3 n = to_environment_axes(frame, s.n), r = to_environment_axes(frame, mirror3(s.v, s.n));
    num n_dot_v = dot3(s.n, s.v);
    struct cube_color above = cube_look(&light->irradiance, n.x, n.y, n.z);
    struct cube_color around = prefiltered_look(light, prefilter_level(roughness), r.x, r.y, r.z);
    e.irradiance = vec3_of(above.r, above.g, above.b);
    e.prefiltered = vec3_of(around.r, around.g, around.b);
    e.albedo = single_scattering(n_dot_v, roughness);
    e.bias = schlick_scattering(n_dot_v, roughness);
    return e;
}

#endif
