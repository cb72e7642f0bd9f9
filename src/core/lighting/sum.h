// sum.h: the light that leaves a point, as terms and as their sum.
//
// The same source is compiled as C and as GLSL (prelude_c.h, prelude.glsl).
//
//
//    I = emission + ka * (La global + sum of La_i + sum of hemisphere_i)
//        + sum over lights of  spot_i attenuation_i (kd * Ld_i D_i + ks * Ls_i S_i)
//        + kr * environment
//
// For metallic-roughness materials the environment is a light: its split sum is added to the diffuse and the specular term.
// Here, * multiplies colours channel by channel. The products ka * La, kd * Ld, ks * Ls are computed once for each draw
// and are parameters here. Ambient light is neither attenuated nor limited by a cone, so all of it is one colour.

// The terms before their sum, for pictures of one term and the explanation of a pixel.
STRUCT(terms) { vec3 ambient, diffuse, specular, emission, reflection; };

// A hemisphere light, as products with the material: ka * sky, ka * ground.
STRUCT(hemisphere)
{
    vec3 up; // unit, towards the sky
    vec3 sky, ground;
};

// Returns the terms before any light is added: ambient = ka * (La global + sum of the lights' La), and the surface's
// emission.
FN terms start_terms(vec3 ambient, vec3 emission)
{
    terms sum;
    sum.ambient = ambient;
    sum.diffuse = black3();
    sum.specular = black3();
    sum.emission = emission;
    sum.reflection = black3();
    return sum;
}

// Returns the terms of the model `none`: the diffuse colour unchanged; lights are ignored.
FN terms unlit_terms(vec3 kd)
{
    terms sum = start_terms(black3(), black3());
    sum.diffuse = kd;
    return sum;
}

// Adds ka * mix(ground, sky, 1/2 + 1/2 n.up), the light of a hemisphere light (0 without a normal).
FN terms add_hemisphere(terms sum, surface s, hemisphere h)
{
    vec3 light = mix3(h.ground, h.sky, 0.5f + 0.5f * cosine(dot3(s.n, h.up)));
    sum.ambient = pick3(present(s.n), add3(sum.ambient, light), sum.ambient);
    return sum;
}

// The Fresnel factor of a metallic-roughness material, f0 + rest (1 - v.h)^5, for each channel.
STRUCT(fresnel) { vec3 f0, rest; };

// glTF 2.0, appendix B, the normative mix of a dielectric and a metal whose f0 is the base colour:
//    (1 - metallic) (0.04 + 0.96 w) + metallic (base + (1 - base) w)
// Each of the two is multiplied by 1 + its f0 gain, for multiple scattering between microfacets (gain 0: none).
FN fresnel fresnel_of(vec3 base, num metallic, num gain)
{
    fresnel f;
    vec3 white = vec3_of(num_of(1.0f), num_of(1.0f), num_of(1.0f));
    num dielectric = (1.0f - metallic) * (1.0f + DIELECTRIC_F0 * gain);
    vec3 metal = scale3(add3(white, scale3(base, gain)), metallic);
    f.f0 = add3(scale3(white, dielectric * DIELECTRIC_F0), mul3(metal, base));
    f.rest = add3(scale3(white, dielectric * (1.0f - DIELECTRIC_F0)), mul3(metal, sub3(white, base)));
    return f;
}

// Returns the light with its specular colour multiplied by the Fresnel factor.
FN light_source with_fresnel(light_source light, fresnel f, vec3 v, vec3 l)
{
    light.specular = mul3(light.specular, add3(f.f0, scale3(f.rest, schlick_weight(v, l))));
    return light;
}

// Returns the light with its specular colour multiplied by Gooch's tone.
FN light_source with_tone(light_source light, vec3 n, vec3 l)
{
    num w = warmth(n, l);
    light.specular = mul3(light.specular, vec3_of(w, w, 1.0f - w));
    return light;
}

// Adds spot * attenuation * (kd * Ld D + ks * Ls S) for known D and S.
FN terms add_reflected(terms sum, light_source light, light_sample t, lobe_value r)
{
    num arriving = t.attenuation * t.spot;
    sum.diffuse = add3(sum.diffuse, scale3(light.diffuse, arriving * r.diffuse));
    sum.specular = add3(sum.specular, scale3(light.specular, arriving * r.specular));
    return sum;
}

// Adds a light's ambient colour as in OpenGL 1: multiplied by attenuation and cone like the other terms.
FN terms add_arriving_ambient(terms sum, vec3 ambient, light_sample t)
{
    sum.ambient = add3(sum.ambient, scale3(ambient, t.attenuation * t.spot));
    return sum;
}

// Adds kr * environment, the environment's colour in the direction mirror3(v, n).
FN terms add_environment(terms sum, vec3 kr, vec3 colour)
{
    sum.reflection = add3(sum.reflection, mul3(kr, colour));
    return sum;
}

// Environment light on a metallic-roughness material.
STRUCT(surroundings)
{
    vec3 irradiance;  // divided by pi: the mean of the light above the surface, weighted by the cosine
    vec3 prefiltered; // the light around the mirrored direction, weighted by the lobe (prefilter_level)
    num albedo;       // single_scattering: scale + bias
    num bias;         // schlick_scattering
};

// The environment's light that a physical material reflects.
STRUCT(returned_light)
{
    vec3 diffuse;  // from its diffuse part
    vec3 specular; // from its microfacets
};

FN returned_light scale_returned(returned_light r, num share)
{
    r.diffuse = scale3(r.diffuse, share);
    r.specular = scale3(r.specular, share);
    return r;
}

// Adds the returned light to the terms of the lights. Vertex colours and maps are already included.
FN terms add_returned(terms sum, returned_light r)
{
    sum.diffuse = add3(sum.diffuse, r.diffuse);
    sum.specular = add3(sum.specular, r.specular);
    return sum;
}

// The split sum (Karis 2013): the integral of light times lobe is approximated by the light's mean times the lobe's
// integral,
//    kd irradiance (1 - (0.04 scale + bias)) + prefiltered (f0 scale + bias)
// with the mix of dielectric and metal, and multiple scattering, as in fresnel_of: f0 scale + bias = f0 (scale + bias)
// + (1 - f0) bias.
FN returned_light surroundings_light(fresnel f, vec3 kd, surroundings e)
{
    returned_light r;
    num dielectric = DIELECTRIC_F0 * e.albedo + (1.0f - DIELECTRIC_F0) * e.bias;
    vec3 mirrored = add3(scale3(f.f0, e.albedo), scale3(f.rest, e.bias));
    r.diffuse = mul3(scale3(kd, 1.0f - dielectric), e.irradiance);
    r.specular = mul3(mirrored, e.prefiltered);
    return r;
}

// Multiplies the ambient and diffuse terms by a colour that varies over the surface (vertex colours, a texture).
FN terms tint_terms(terms sum, vec3 colour)
{
    sum.ambient = mul3(sum.ambient, colour);
    sum.diffuse = mul3(sum.diffuse, colour);
    return sum;
}

// Returns the sum of the terms, unclamped.
FN vec3 sum_terms(terms t)
{
    return add3(add3(add3(add3(t.emission, t.ambient), t.diffuse), t.specular), t.reflection);
}
