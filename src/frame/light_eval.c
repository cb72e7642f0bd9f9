// light_eval.c: the equations at single values: what the kernels compute, one lane wide.
#define LANES 1
#include "lighting.h"

#include "float_state.h"
#include "frame.h"
#include "linear.h"

#include <lambent/light_eval.h>

// The part of a light that attenuation and cone read.
static light_source reach_of(const struct frame_light *light)
{
    return (light_source){
        .constant = light->attenuation[0],
        .linear = light->attenuation[1],
        .quadratic = light->attenuation[2],
        .inverse_range = light->inverse_range,
        .cos_cutoff = light->cos_cutoff,
        .exponent = light->exponent,
        .cos_outer = light->cos_outer,
        .inverse_width = light->inverse_width,
    };
}

float lam_attenuation_at(const lam_light *light, float distance)
{
    if (!light || (light->type != LAM_LIGHT_POINT && light->type != LAM_LIGHT_SPOT))
        return 1.0f;
    uint64_t state = float_state_enter();
    struct frame_light reach;
    frame_light_reach(&reach, light);
    float result = attenuation_at(distance, reach_of(&reach), reach.falloff);
    float_state_leave(state);
    return result;
}

float lam_spot_at(const lam_light *light, double angle_rad)
{
    if (!light || light->type != LAM_LIGHT_SPOT)
        return 1.0f;
    uint64_t state = float_state_enter();
    struct frame_light reach;
    frame_light_reach(&reach, light);
    float result = spot_at(cosine((float)math_cos(angle_rad)), reach_of(&reach), reach.kind);
    float_state_leave(state);
    return result;
}

float lam_highlight_at(lam_reflection reflection, float shininess, double angle_rad)
{
    int model = reflection == LAM_REFLECTION_AUTO ? LAM_REFLECTION_BLINN_PHONG : reflection;
    if (lobe_properties(model) & LOBE_TANGENT)
        return 0.0f;
    uint64_t state = float_state_enter();
    surface s = {.n = {0, 0, 1}, .v = {(float)math_sin(angle_rad), 0, (float)math_cos(angle_rad)}};
    lobe_parameters m = {.shininess = shininess};
    float result = reflect_light(s, (vec3){0, 0, 1}, m, model).specular;
    float_state_leave(state);
    return result;
}
