// lights.h: the light that arrives at a point: its direction, distance, attenuation and cone.
//
// The same source is compiled as C and as GLSL (prelude_c.h, prelude.glsl). All vectors are in eye space, distances in
// the scene's units.

// One light as it affects one material: the colours are products, computed once for each draw. Fields that a kind of
// light does not have are never read.
STRUCT(light_source)
{
    vec3 position;     // point and spot
    vec3 direction;    // unit: the direction of travel of the light, the axis of a spot
    vec3 diffuse;      // kd * Ld
    vec3 specular;     // ks * Ls
    num constant;      // attenuation: a,
    num linear;        // b per unit of distance,
    num quadratic;     // c per unit squared; all three >= 0
    num inverse_range; // 1 / range
    num cos_cutoff;    // LIGHT_SPOT_CUTOFF: cosine of its half angle
    num exponent;      // LIGHT_SPOT_CUTOFF, LIGHT_SPOT_EXPONENT: >= 0
    num cos_outer;     // LIGHT_SPOT_CONES: cosine of the outer half angle,
    num inverse_width; // 1 / max(0.001, cos inner - cos outer)
};

STRUCT(light_sample)
{
    vec3 l;          // unit, from the point to the light; 0 if the light is at the point
    num distance;    // 0 for a directional light
    num attenuation; // including the range's window
    num spot;        // the cone's factor, 0...1
};

// Returns 1 / (a + b d + c d^2), or 0 if that sum is 0. With a range, the result is multiplied by the window of glTF's
// KHR_lights_punctual: max(min(1 - (d / range)^4, 1), 0).
FN num attenuation_at(num d, light_source light, int falloff)
{
    num sum = light.constant + (light.linear + light.quadratic * d) * d;
    num attenuation = pick(sum >= 1.17549435e-38f, 1.0f / sum, num_of(0.0f));
    if (falloff == FALLOFF_RANGE) {
        num part = d * light.inverse_range;
        num square = part * part;
        attenuation = attenuation * saturate(1.0f - square * square);
    }
    return attenuation;
}

// Returns the cone's factor for c, the cosine between the spot's axis and the direction from the light to the point:
//    cutoff:    [c >= cos cutoff] max(c, 0)^exponent
//    exponent:  max(c, 0)^exponent
//    cones:     clamp((c - cos outer) / max(0.001, cos inner - cos outer), 0, 1)^2, as in KHR_lights_punctual
// The edge itself is always lit, whatever the rounding error of c, which is at most 5e-7. The cones multiply that error
// by 1 / (cos inner - cos outer), and the power multiplies it by the exponent.
FN num spot_at(num c, light_source light, int kind)
{
    num spot = num_of(1.0f);
    if (kind == LIGHT_SPOT_CUTOFF) {
        spot = pick(c >= light.cos_cutoff - 5.0e-7f, unit_power(c, light.exponent), num_of(0.0f));
    }
    if (kind == LIGHT_SPOT_EXPONENT) {
        spot = unit_power(c, light.exponent);
    }
    if (kind == LIGHT_SPOT_CONES) {
        num part = saturate((c - light.cos_outer) * light.inverse_width);
        spot = part * part;
    }
    return spot;
}

// Returns the sample for a light at the end of the vector `way` from a point. `square` is the squared length of `way`,
// and `inverse` is 1 / length.
FN light_sample toward_along(vec3 way, num square, num inverse)
{
    light_sample t;
    t.l = scale3(way, inverse);
    t.distance = square * inverse;
    t.attenuation = num_of(1.0f);
    t.spot = num_of(1.0f);
    return t;
}

// Applies the attenuation and the cone. A point at the light's own position receives no light, because no direction is
// defined there.
FN light_sample weaken_light(light_sample t, num square, light_source light, int kind, int falloff)
{
    if (falloff != FALLOFF_NONE) {
        t.attenuation = attenuation_at(t.distance, light, falloff);
    }
    t.attenuation = pick(square > 0.0f, t.attenuation, num_of(0.0f));
    if (kind >= LIGHT_SPOT_CUTOFF) {
        t.spot = spot_at(cosine(-dot3(t.l, light.direction)), light, kind);
    }
    return t;
}

// Returns the light that arrives at the point p.
FN light_sample toward_light(vec3 p, light_source light, int kind, int falloff)
{
    light_sample t;
    if (kind == LIGHT_DIRECTIONAL) {
        t.l = negate3(light.direction);
        t.distance = num_of(0.0f);
        t.attenuation = num_of(1.0f);
        t.spot = num_of(1.0f);
    } else {
        vec3 way = sub3(light.position, p);
        num square = dot3(way, way);
        t = toward_along(way, square, rsqrt(square));
        t = weaken_light(t, square, light, kind, falloff);
    }
    return t;
}
