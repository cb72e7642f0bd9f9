// light_eval.c: evaluates attenuation, cone and highlight for a single value, with the kernels' code for one lane.
#define LANES 1
#include "lighting.h"

#include "float_state.h"
#include "frame.h"
#include "linear.h"

#include <lambent/light_eval.h>

// Returns the members of a light that attenuation_at and spot_at read.
static light_source source_of(const struct frame_light *light)
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
    struct frame_light profile;
    frame_light_init(&profile, light);
    float result = attenuation_at(distance, source_of(&profile), profile.falloff);
    float_state_leave(state);
    return result;
}

float lam_spot_at(const lam_light *light, double angle_rad)
{
    if (!light || light->type != LAM_LIGHT_SPOT)
        return 1.0f;
    uint64_t state = float_state_enter();
    struct frame_light profile;
    frame_light_init(&profile, light);
    float result = spot_at(cosine((float)math_cos(angle_rad)), source_of(&profile), profile.kind);
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
