// lobes.h: the reflection models: how a point of a surface reflects light from one direction; and their table.
//
// The same source is compiled as C and as GLSL (prelude_c.h, prelude.glsl). All vectors are in eye space: n is the unit
// normal, l points to the light, v to the eye, t along the tangent. Each vector has length 1, or 0 if the vector is
// missing; the result is then 0. D is the fraction of diffuse light, S the strength of the highlight, both in 0...1;
// sum.h multiplies them by colours. No light passes through a surface: S is 0 if n.l <= 0, although r.v and n.h may be
// positive there.
//
// `lambent shader` prints this text, and src/gpu/glsl/equations.c and specialize.c read it line by line. They rely on its
// layout, here and in lights.h and sum.h. A definition and its closing brace begin in column 1. An `if` ends its line
// with a brace, and the closing brace is below the `if`. A struct has one member per line. A comment precedes its
// definition without an empty line between them. clang-format preserves all of this.

// The response to light from one direction, before the highlight is raised to its power.
STRUCT(lobe_sample)
{
    num diffuse; // D
    num n_dot_l; // cosine between normal and light, -1...1
    num base;    // base of the highlight's power: r.v, n.h or the cosine of Kajiya and Kay's cone, at most 1
    mask lit;    // whether there is a highlight; otherwise S is 0
};

STRUCT(lobe_value)
{
    num diffuse;  // D
    num specular; // S
    num n_dot_l;  // as above
    num base;     // as above, 0...1
};

// Lambert (1760): a matt surface reflects light evenly in all directions, and receives less light at oblique angles:
//    D = max(n.l, 0)
FN lobe_sample lambert_lobe(surface s, vec3 l)
{
    lobe_sample b;
    b.n_dot_l = cosine(dot3(s.n, l));
    b.diffuse = positive(b.n_dot_l);
    b.base = num_of(0.0f);
    b.lit = both(b.n_dot_l > 0.0f, present(s.v));
    return b;
}

// Phong (1975): the highlight surrounds the mirror image of the light.
//    S = [n.l > 0] max(r.v, 0)^shininess
// r.v is computed as 1 - |r - v|^2 / 2, which is equal for unit vectors. At the brightest point of the highlight, the
// product would multiply an error in the length of n by four; this form does not depend on it.
FN num phong_base(vec3 n, vec3 l, vec3 v)
{
    vec3 difference = sub3(mirror3(l, n), v);
    return 1.0f - 0.5f * dot3(difference, difference);
}

FN lobe_sample phong_lobe(surface s, vec3 l)
{
    lobe_sample b = lambert_lobe(s, l);
    b.base = phong_base(s.n, l, s.v);
    return b;
}

// Blinn (1977), also called modified Phong: the highlight is brightest where the normal is halfway between the
// directions to the light and to the eye.
//    S = [n.l > 0] max(n.h, 0)^shininess   with   h = (l + v) / |l + v|
// The division by the length follows the product with n, which saves three multiplications; n.l + n.v instead of n.(l +
// v) would save more, but loses digits if l and v are nearly opposite.
STRUCT(halfway)
{
    num product; // n.(l + v)
    num square;  // |l + v|^2
};

FN halfway halfway_of(vec3 n, vec3 l, vec3 v)
{
    halfway h;
    vec3 sum = add3(l, v);
    h.product = dot3(n, sum);
    h.square = dot3(sum, sum);
    return h;
}

FN lobe_sample blinn_phong_lobe(surface s, vec3 l)
{
    lobe_sample b = lambert_lobe(s, l);
    halfway h = halfway_of(s.n, l, s.v);
    b.base = h.product * rsqrt(h.square);
    return b;
}

// Kajiya and Kay (1989): a thread along t reflects light into a cone around t. With the angles between t and l, and
// between t and v:
//    D = sin(t,l)
//    S = max(sin(t,l) sin(t,v) - cos(t,l) cos(t,v), 0)^shininess
// On a solid surface (fibre = 0), D and S are 0 unless n.l > 0. A fibre (fibre = 1) has no inside and therefore no such
// gate.
STRUCT(thread_angles)
{
    num sine;    // sin(t,l)
    num sines;   // sin(t,l) sin(t,v)
    num cosines; // cos(t,l) cos(t,v)
};

// sin(t,l) = |t x l|: the root of 1 - (t.l)^2 would lose half of the digits if l is nearly parallel to t.
FN thread_angles thread_angles_of(vec3 t, vec3 l, vec3 v)
{
    thread_angles a;
    vec3 across_l = cross3(t, l);
    vec3 across_v = cross3(t, v);
    a.sine = min_of(square_root(dot3(across_l, across_l)), num_of(1.0f));
    a.sines = a.sine * min_of(square_root(dot3(across_v, across_v)), num_of(1.0f));
    a.cosines = dot3(t, l) * dot3(t, v);
    return a;
}

FN lobe_sample kajiya_kay_lobe(surface s, vec3 l, num fibre)
{
    thread_angles a = thread_angles_of(s.t, l, s.v);
    lobe_sample b;
    b.n_dot_l = cosine(dot3(s.n, l));
    b.base = a.sines - a.cosines;
    mask there = both(both(present(s.t), present(l)), either(b.n_dot_l > 0.0f, fibre > 0.5f));
    b.diffuse = pick(there, a.sine, num_of(0.0f));
    b.lit = both(there, present(s.v));
    return b;
}

// Kajiya-Kay with the sign that some lectures print, and without a gate:
//     S = max(sin(t,l) sin(t,v) + cos(t,l) cos(t,v), 0)^shininess
FN lobe_sample kajiya_kay_lecture_lobe(surface s, vec3 l)
{
    thread_angles a = thread_angles_of(s.t, l, s.v);
    lobe_sample b;
    b.n_dot_l = cosine(dot3(s.n, l));
    b.base = a.sines + a.cosines;
    mask there = both(present(s.t), present(l));
    b.diffuse = pick(there, a.sine, num_of(0.0f));
    b.lit = both(there, present(s.v));
    return b;
}

// Oren and Nayar (1994), the qualitative model: a rough matt surface consists of small matt facets whose slopes have
// the standard deviation sigma (radians). Facets seen from the light's side return more of the light, so such a surface
// (the moon, clay) looks flatter than Lambert's. With the angles of l and v from the normal, and phi between the planes
// that they form with it:
//    A = 1 - 0.5 sigma^2 / (sigma^2 + 0.33)
//    B = 0.45 sigma^2 / (sigma^2 + 0.09)
//    D = max(n.l, 0) (A + B max(cos phi, 0) sin(larger angle) tan(smaller angle))
// The product of cosine, sine and tangent is (l.v - n.l n.v) / max(n.l, n.v).
FN lobe_sample oren_nayar_lobe(surface s, vec3 l, num sigma)
{
    lobe_sample b = lambert_lobe(s, l);
    num square = sigma * sigma;
    num n_dot_v = cosine(dot3(s.n, s.v));
    num beside = positive(dot3(l, s.v) - b.n_dot_l * n_dot_v);
    num larger = max_of(max_of(b.n_dot_l, n_dot_v), num_of(1.0e-6f));
    num rest = 1.0f - 0.5f * square / (square + 0.33f);
    num back = 0.45f * square / (square + 0.09f);
    b.diffuse = b.diffuse * rest + back * beside * (b.diffuse / larger);
    return b;
}

// Returns the cosine between the normal and the eye, |n.v|, as in glTF 2.0 (appendix B). An interpolated normal may
// face away from the eye although the triangle's front is visible. The absolute value lights such points, so that
// metals have no black holes.
FN num eye_cosine(surface s) { return min_of(absolute(dot3(s.n, s.v)), num_of(1.0f)); }

// Cook and Torrance (1982) with Walter's distribution GGX (2007): a surface of microfacets, which glTF 2.0 (appendix B)
// uses for metals and dielectrics. With alpha = roughness^2 and h halfway between l and v
//    S = pi D V max(n.l, 0)   where h.v > 0
//    D = alpha^2 / (pi (|n x h|^2 + (n.h)^2 alpha^2)^2)
//    V = 1 / (2 (n.l root((n.v)^2 (1 - alpha^2) + alpha^2) + |n.v| root((n.l)^2 (1 - alpha^2) + alpha^2)))
//    D' = max(n.l, 0) (1 - F)
// where V is Smith's height-correlated shadowing of microfacets (Heitz 2014), D' the diffuse share, and F Schlick's
// Fresnel factor of a dielectric. The factor pi is needed because a matt surface returns kd here, not kd / pi. The
// textbook form (n.h)^2 (alpha^2 - 1) + 1 of D's bracket loses three digits on smooth surfaces. h.v is |l + v| / 2,
// which is 0 only for opposite directions.

// Schlick (1994): a microfacet reflects f0 + (1 - f0) (1 - v.h)^5; returns the power (1 - v.h)^5. v.h = |l + v| / 2.
FN num schlick_weight(vec3 v, vec3 l)
{
    vec3 sum = add3(l, v);
    num m = positive(1.0f - 0.5f * square_root(dot3(sum, sum)));
    num square = m * m;
    return square * square * m;
}

// Returns the microfacets' visibility times 2 n.l: n.l / (n.l root(...) + |n.v| root(...)).
FN num smith_visibility(num n_dot_l, num n_dot_v, num alpha_square)
{
    num beyond = 1.0f - alpha_square;
    num masked = n_dot_l * square_root(n_dot_v * n_dot_v * beyond + alpha_square);
    num shadowed = n_dot_v * square_root(n_dot_l * n_dot_l * beyond + alpha_square);
    return n_dot_l / max_of(masked + shadowed, num_of(1.0e-30f));
}

FN lobe_sample ggx_lobe(surface s, vec3 l, num roughness)
{
    lobe_sample b = lambert_lobe(s, l);
    num alpha = max_of(roughness, num_of(ROUGHNESS_MIN));
    alpha = alpha * alpha;
    num alpha_square = alpha * alpha;
    vec3 sum = add3(l, s.v);
    vec3 across = cross3(s.n, sum);
    num along = dot3(s.n, sum);
    num square = dot3(sum, sum);
    // All terms are multiplied by |l + v|^2, so that h is not needed.
    num bracket = dot3(across, across) + along * along * alpha_square;
    num spread = alpha * square / max_of(bracket, num_of(1.0e-30f));
    b.base = 0.5f * spread * spread * smith_visibility(positive(b.n_dot_l), eye_cosine(s), alpha_square);
    b.lit = both(b.lit, square > 0.0f);
    b.diffuse = b.diffuse * (1.0f - (DIELECTRIC_F0 + (1.0f - DIELECTRIC_F0) * schlick_weight(s.v, l)));
    return b;
}

// Toon shading, as in Lake, Marshall, Harris and Blackstein (2000): light in flat steps, and a highlight with an edge at
// half of Blinn and Phong's. Lake's table of colours is here a stair with steps of equal height:
//    D = ceil(steps max(n.l, 0)) / steps
//    S = [n.l > 0] [max(n.h, 0)^shininess >= 1/2]
// The edges are moved by 1e-5 of a step, so that rounding does not decide on a plane whose n.l is 1/3.
FN lobe_sample toon_lobe(surface s, vec3 l, num steps, num shininess)
{
    lobe_sample b = blinn_phong_lobe(s, l);
    steps = min_of(max_of(steps, num_of(1.0f)), num_of(1.0e6f));
    num level = positive(steps * b.diffuse - 1.0e-5f);
    num below = whole(level);
    b.diffuse = pick(level > below, below + 1.0f, below) / steps;
    b.base = pick(unit_power(positive(b.base), shininess) >= 0.5f, num_of(1.0f), num_of(0.0f));
    return b;
}

// Gooch, Gooch, Shirley and Cohen (1998), equations 2 and 3: technical drawings blend from a cool colour on the far side
// to a warm colour towards the light, with w = (1 + n.l) / 2:
//    (1 - w) (k_blue + 0.2 kd) + w (k_yellow + 0.6 kd)   where   k_blue = (0, 0, b), k_yellow = (y, y, 0)
// The share of kd is D; the rest is the second term, ks (w, w, 1 - w), with ks = (y, y, b). Gooch gives y = b = 0.4.
//    D = 0.2 + 0.4 w
FN num warmth(vec3 n, vec3 l) { return 0.5f + 0.5f * cosine(dot3(n, l)); }

FN lobe_sample gooch_lobe(surface s, vec3 l)
{
    lobe_sample b;
    b.n_dot_l = cosine(dot3(s.n, l));
    b.diffuse = pick(present(s.n), 0.2f + 0.4f * warmth(s.n, l), num_of(0.0f));
    b.base = num_of(1.0f);
    b.lit = both(present(s.n), present(s.v));
    return b;
}

// A position in the tables of the light that GGX's microfacets return under uniform light: 32 roughnesses,
// ROUGHNESS_MIN to 1, times 32 roots of n.v (scripts/albedo_tables.py).
STRUCT(albedo_cell)
{
    num first;  // index of the entry above and to the left
    num across; // fractions towards the next entries
    num down;
};

FN albedo_cell albedo_cell_of(num n_dot_v, num roughness)
{
    albedo_cell p;
    num along = 31.0f * square_root(saturate(n_dot_v));
    num down = (31.0f / (1.0f - ROUGHNESS_MIN)) * positive(min_of(roughness, num_of(1.0f)) - ROUGHNESS_MIN);
    num column = min_of(whole(along), num_of(30.0f));
    num row = min_of(whole(down), num_of(30.0f));
    p.across = along - column;
    p.down = down - row;
    p.first = 32.0f * row + column;
    return p;
}

// Returns the share of light that microfacets of f0 = 1 return after one reflection: the integral of S over all l,
// divided by pi. The rest hits other microfacets.
FN num single_scattering(num n_dot_v, num roughness)
{
    albedo_cell p = albedo_cell_of(n_dot_v, roughness);
    num a = p.across;
    num upper = albedo_texel(p.first) * (1.0f - a) + albedo_texel(p.first + 1.0f) * a;
    num lower = albedo_texel(p.first + 32.0f) * (1.0f - a) + albedo_texel(p.first + 33.0f) * a;
    return upper + (lower - upper) * p.down;
}

// Returns the integral of single_scattering, weighted by Schlick's (1 - v.h)^5.
FN num schlick_scattering(num n_dot_v, num roughness)
{
    albedo_cell p = albedo_cell_of(n_dot_v, roughness);
    num a = p.across;
    num upper = bias_texel(p.first) * (1.0f - a) + bias_texel(p.first + 1.0f) * a;
    num lower = bias_texel(p.first + 32.0f) * (1.0f - a) + bias_texel(p.first + 33.0f) * a;
    return upper + (lower - upper) * p.down;
}

// Returns the ratio of multiply to singly scattered light, for f0 = 1.
FN num scattering_gain(surface s, num roughness) { return 1.0f / single_scattering(eye_cosine(s), roughness) - 1.0f; }

// The level of a prefiltered environment for a roughness: 0 at ROUGHNESS_MIN, PREFILTERED_LAST at 1, linear in its
// fourth root.
#define PREFILTERED_LAST   11.0f
#define ROUGHNESS_MIN_ROOT 0.46057798f

FN num prefilter_level(num roughness)
{
    num root = square_root(square_root(max_of(min_of(roughness, num_of(1.0f)), num_of(ROUGHNESS_MIN))));
    return saturate((root - ROUGHNESS_MIN_ROOT) / (1.0f - ROUGHNESS_MIN_ROOT)) * PREFILTERED_LAST;
}

// Returns the value of a microfacet lobe, whose base is its S.
FN lobe_value microfacet_of(lobe_sample b)
{
    lobe_value r;
    r.diffuse = b.diffuse;
    r.specular = pick(b.lit, b.base, num_of(0.0f));
    r.n_dot_l = b.n_dot_l;
    r.base = r.specular;
    return r;
}

// Returns the value of a lobe with the highlight raised to its power.
FN lobe_value reflected_of(lobe_sample b, num shininess)
{
    lobe_value r;
    r.diffuse = b.diffuse;
    r.specular = pick(b.lit, unit_power(b.base, shininess), num_of(0.0f));
    r.n_dot_l = b.n_dot_l;
    r.base = saturate(b.base);
    return r;
}

// --- C only: the GLSL text ends here (src/gpu/glsl/embed.py).

// The numbers of a material that lobes read. They have the same names in lam_material, its table of fields and shaders.
// For a number that only lobes read, this table contains the columns of its lam_field;
// src/core/scene/fields/material_fields.c makes the field's row from these columns.
// clang-format off
#define LOBE_PARAMETERS(X) \
    X(shininess) \
    X(fibre, .key = "fibre", .type = LAM_FIELD_FLAG, .max = 1, \
      .summary = "hair and thread: Kajiya-Kay without the condition n.l > 0") \
    X(roughness_angle_rad, .key = "roughness_angle", .symbol = "σ", .unit = "degrees", .type = LAM_FIELD_ANGLE, \
      .max = 90, .standard = {30}, \
      .summary = "sigma of Oren-Nayar: standard deviation of the facets' slopes") \
    X(roughness) \
    X(metallic) \
    X(toon_steps, .key = "toon_steps", .max = 256, .standard = {3}, .summary = "toon: number of steps of light, 1 or more")
// clang-format on

// The table of the reflection models. This table generates the dispatch in C and in GLSL, the keywords of the command
// line and of scene files, and entries in reports, explanations and tests. A new model needs an enumerator in
// lambent/reflection.h, a function above and a row here. A model with its own parameter also needs a member of
// lam_material and a row of LOBE_PARAMETERS. The columns:
//     the enumerator without LAM_REFLECTION_
//     the call: `s` is the surface, `l` the direction to the light, `m` the material's lobe_parameters
//     properties: LOBE_HIGHLIGHT   S is not 0: the lobe returns the base of a power
//                 LOBE_MICROFACET  the base is S itself, and the Fresnel factor colours it (fresnel_of)
//                 LOBE_TANGENT     it reads the surface's tangent
//                 LOBE_BACKLIT     light from behind (n.l < 0) contributes
//                 LOBE_BACKLIT_FIBRE   light from behind contributes if the material is a fibre
//                 LOBE_MIRRORED    Lambert's lobe with phong_base, r.v
//                 LOBE_TONED       the second term is Gooch's tone (with_tone)
//                 LOBE_HALFWAY     Lambert's lobe with the base n.h (halfway_of), which needs four times the exponent
//     the keyword, a one-line summary, the formula of D, the formula of the highlight's base ("" if none)
// clang-format off
#define LOBES(X) \
    X(LAMBERT, lambert_lobe(s, l), 0, \
      "lambert", "ambient and diffuse light, no highlight", \
      "max(n·l, 0)", "") \
    X(PHONG, phong_lobe(s, l), LOBE_HIGHLIGHT | LOBE_MIRRORED, \
      "phong", "a highlight around the mirrored light direction", \
      "max(n·l, 0)", "max(r·v, 0)") \
    X(BLINN_PHONG, blinn_phong_lobe(s, l), LOBE_HIGHLIGHT | LOBE_HALFWAY, \
      "blinn-phong", "a highlight computed from the half vector", \
      "max(n·l, 0)", "max(n·h, 0)") \
    X(KAJIYA_KAY, kajiya_kay_lobe(s, l, m.fibre), LOBE_HIGHLIGHT | LOBE_TANGENT | LOBE_BACKLIT_FIBRE, \
      "kajiya-kay", "highlights along threads, computed from their tangents", \
      "sin(t,l)", "max(sin(t,l) sin(t,v) − cos(t,l) cos(t,v), 0)") \
    X(KAJIYA_KAY_LECTURE, kajiya_kay_lecture_lobe(s, l), LOBE_HIGHLIGHT | LOBE_TANGENT | LOBE_BACKLIT, \
      "kajiya-kay-lecture", "kajiya-kay with a plus sign in the formula, as printed in some lectures", \
      "sin(t,l)", "max(sin(t,l) sin(t,v) + cos(t,l) cos(t,v), 0)") \
    X(OREN_NAYAR, oren_nayar_lobe(s, l, m.roughness_angle_rad), 0, \
      "oren-nayar", "rough matt surfaces, no highlight", \
      "max(n·l, 0) (A + B max(l·v − n·l n·v, 0) ÷ max(n·l, n·v))", "") \
    X(GGX, ggx_lobe(s, l, m.roughness), LOBE_HIGHLIGHT | LOBE_MICROFACET, \
      "ggx", "microfacets, for glTF's metallic-roughness materials", \
      "max(n·l, 0) (1 − F)", "π D V max(n·l, 0)") \
    X(TOON, toon_lobe(s, l, m.toon_steps, m.shininess), LOBE_HIGHLIGHT, \
      "toon", "flat steps of light, and a highlight with an edge", \
      "max(ceil(steps n·l), 0) ÷ steps", "[max(n·h, 0)^α ≥ 1/2]") \
    X(GOOCH, gooch_lobe(s, l), LOBE_HIGHLIGHT | LOBE_BACKLIT | LOBE_TONED, \
      "gooch", "warm colours towards the light, cool colours away from it", \
      "0.2 + 0.4 (1 + n·l) ÷ 2", "1")
// clang-format on

enum {
    LOBE_HIGHLIGHT = 1,
    LOBE_TANGENT = 2,
    LOBE_BACKLIT = 4,
    LOBE_BACKLIT_FIBRE = 8,
    LOBE_MICROFACET = 16,
    LOBE_MIRRORED = 32,
    LOBE_HALFWAY = 64,
    LOBE_TONED = 128
};

STRUCT(lobe_parameters){
#define MEMBER(name, ...) num name;
    LOBE_PARAMETERS(MEMBER)
#undef MEMBER
};

// Returns the lobe of a lam_reflection. LAM_REFLECTION_NONE reflects nothing: its colour is `unlit_terms` in sum.h.
LANE_FN lobe_sample lobe_of(surface s, vec3 l, lobe_parameters m, int model)
{
    switch (model) {
#define LOBE(NAME, call, ...)                                                                                          \
    case LAM_REFLECTION_##NAME:                                                                                        \
        return call;
        LOBES(LOBE)
#undef LOBE
    default: {
        lobe_sample b = lambert_lobe(s, l);
        b.diffuse = num_of(0.0f);
        return b;
    }
    }
}

// Returns the properties of a model's lobe, or 0 for LAM_REFLECTION_NONE.
static inline int lobe_properties(int model)
{
    switch (model) {
#define LOBE(NAME, call, properties, ...)                                                                              \
    case LAM_REFLECTION_##NAME:                                                                                        \
        return properties;
        LOBES(LOBE)
#undef LOBE
    default:
        return 0;
    }
}

LANE_FN lobe_value reflect_light(surface s, vec3 l, lobe_parameters m, int model)
{
    if (lobe_properties(model) & LOBE_MICROFACET)
        return microfacet_of(lobe_of(s, l, m, model));
    lobe_value r = reflected_of(lobe_of(s, l, m, model), m.shininess);
    if (!(lobe_properties(model) & LOBE_HIGHLIGHT))
        r.specular = num_of(0.0f);
    return r;
}

// Returns the parameters of a material; `shininess` is the exponent in use (frame_shininess).
LANE_FN lobe_parameters lobe_parameters_of(const lam_material *material, float shininess)
{
#define OF_MATERIAL(name, ...) .name = num_of((float)material->name),
    lobe_parameters m = {LOBE_PARAMETERS(OF_MATERIAL)};
#undef OF_MATERIAL
    m.shininess = num_of(shininess);
    return m;
}
