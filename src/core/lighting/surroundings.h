// surroundings.h: the light of an environment around a point of a physical material.
//
// The same source is compiled as C and as GLSL (prelude_c.h, prelude.glsl). The including file defines the lookups; in
// C it defines SCENE and IN_SCENE as a parameter and its argument, which GLSL does not need.

// Return the environment's irradiance divided by pi for a surface with that normal, and its light around a direction,
// prefiltered for a level (prefilter_level). Directions are in eye space.
FN vec3 irradiance_at(SCENE vec3 normal);
FN vec3 prefiltered_at(SCENE vec3 direction, num level);

FN surroundings surroundings_of(SCENE surface s, num roughness)
{
    surroundings e;
    num n_dot_v = eye_cosine(s);
    e.irradiance = irradiance_at(IN_SCENE s.n);
    e.prefiltered = prefiltered_at(IN_SCENE mirror3(s.v, s.n), prefilter_level(roughness));
    e.albedo = single_scattering(n_dot_v, roughness);
    e.bias = schlick_scattering(n_dot_v, roughness);
    return e;
}

// The surroundings of the base, whose mirror direction anisotropy may bend, and of the coat.
STRUCT(layered_around)
{
    surroundings base;
    surroundings top;
};

FN layered_around layered_around_of(SCENE surface s, layer_values given, layered m, int set)
{
    layered_around a;
    a.base = surroundings_of(IN_SCENE s, given.roughness);
    if ((set & LAYER_ANISOTROPY) != 0) {
        vec3 bent = mirror3(s.v, bent_surface(s, m, given.anisotropy).n);
        a.base.prefiltered = prefiltered_at(IN_SCENE bent, prefilter_level(given.roughness));
        a.base.albedo = m.albedo;
        a.base.bias = m.bias;
    }
    a.top = a.base;
    if ((set & LAYER_CLEARCOAT) != 0) {
        a.top = surroundings_of(IN_SCENE coat_surface(s, m), m.coat_roughness);
    }
    return a;
}
