// layers.h: the layers that glTF 2.0's extensions add to a metallic-roughness surface: a dielectric of any index, a
// clear coat, sheen, anisotropy, a thin film, transmission.
//
// The same source is compiled as C and as GLSL (prelude_c.h, prelude.glsl). The formulas are from the Khronos
// extensions KHR_materials_ior, specular, clearcoat, sheen, anisotropy, iridescence, transmission and volume. `set`
// contains a bit for each layer of the material (layer_kinds.h). For materials without layers, lobes.h and sum.h are
// sufficient. The colours of the base layer include the factor pi, as do all lobes in this file.

// The numbers of a material at a point.
STRUCT(layer_values)
{
    vec3 base; // base colour
    num metallic;
    num roughness;
    num ior;                 // the dielectric's index of refraction
    num specular_weight;     // reflectance at grazing angles
    vec3 f0_color;           // factor of the reflectance along the normal
    num specular_glossiness; // share of the reflectance along the normal that diffuse light loses
    num clearcoat;           // share of the surface that is coated
    num clearcoat_roughness;
    vec3 clearcoat_normal; // unit
    vec3 sheen_color;
    num sheen_roughness;
    num anisotropy;
    vec3 stretch; // unit, along the surface: the direction of the stretched highlight
    num iridescence;
    num iridescence_ior;
    num film; // thickness in nanometres
    num transmission;
    num thickness;        // the thickness of the volume behind the surface
    num path;             // distance that light travels in the volume, in units of attenuation_distance
    vec3 attenuation_log; // log2 of the volume's colour after a path of 1
};

// The numbers that the sum over the lights needs.
STRUCT(layered)
{
    vec3 dielectric; // f0
    num grazing;     // the dielectric's f90
    vec3 metal;      // f0
    num metallic;
    num albedo; // of anisotropic microfacets, as single_scattering
    num bias;   // as schlick_scattering
    num gain;   // gain by multiple scattering, for f0 = 1
    num roughness;
    num alpha_t; // anisotropy: alpha along `stretch`
    num alpha_b; // and across
    vec3 stretch;
    vec3 across;
    num iridescence;
    num iridescence_ior;
    num film;
    num opaque; // share of the light in the dielectric that is not transmitted
    num matt;   // share of that light that is reflected diffusely
    vec3 sheen_color;
    num sheen_largest; // the largest channel
    num sheen_roughness;
    num sheen_left; // share of the light towards the eye that the sheen transmits
    vec3 coat_normal;
    num coat; // share that the coat reflects, including its Fresnel factor
    num coat_roughness;
    num coat_gain; // gain by multiple scattering in the coat
};

// The response of all layers to light from one direction: the factors of kd Ld and of Ls. It also contains intermediate
// values, which drawing does not read.
STRUCT(layered_value)
{
    num diffuse;
    vec3 specular;
    num strength; // S of the base
    num base_diffuse;
    vec3 base;
    num sheen_left; // share of the base's light that the sheen transmits
    vec3 sheen;
    num coat;
};

FN num largest3(vec3 a) { return max_of(max_of(a.x, a.y), a.z); }
FN vec3 min3(vec3 a, num b) { return vec3_of(min_of(a.x, b), min_of(a.y, b), min_of(a.z, b)); }
FN vec3 root3(vec3 a) { return vec3_of(square_root(a.x), square_root(a.y), square_root(a.z)); }
FN vec3 divide3(vec3 a, vec3 b) { return vec3_of(a.x / b.x, a.y / b.y, a.z / b.z); }
FN vec3 grey3(num x) { return vec3_of(x, x, x); }
FN num fifth_power(num x) { return x * x * (x * x) * x; }

// Returns the reflectance along the normal of a boundary between two indices of refraction: ((a - b) / (a + b))^2.
FN num boundary_f0(num a, num b)
{
    num ratio = (a - b) / (a + b);
    return ratio * ratio;
}

// Returns the Fresnel factor (Schlick) from its value along the normal and its value at grazing angles.
FN vec3 fresnel_mix(vec3 f0, num f90, num weight) { return add3(f0, scale3(sub3(grey3(f90), f0), weight)); }

// Returns the cosine of x turns, for x >= 0.
FN num cosine_of_turns(num x)
{
    num part = x - whole(x);
    num q = absolute(part - 0.5f) - 0.25f;
    num a = 6.28318530718f * q;
    num s = a * a;
    num tail = 8.33333333e-3f + s * (-1.98412698e-4f + s * (2.75573192e-6f - s * 2.50521084e-8f));
    return a * (1.0f + s * (-0.166666667f + s * tail));
}

// Belcour and Barla (2017), in the approximation of KHR_materials_iridescence: the reflectance of a thin film over a
// surface of f0, for light at an angle to the film's normal with the cosine `c`. Light reflected by both sides of the
// film interferes; the integral over the wavelengths is computed in Fourier space, with Gaussians for the sensitivities
// of the eye. `path` is the optical path difference in nanometres times the order, and `shift` contains the phase
// shifts in turns.
FN vec3 film_sensitivity(num path, vec3 shift)
{
    num square = path * path;
    num x = 0.846590002f * cosine_of_turns(1.6810e-3f * path + shift.x) * exp2_of(-2.46491222e-7f * square);
    num second = 0.153868307f * cosine_of_turns(2.2399e-3f * path + shift.x) * exp2_of(-2.57905068e-7f * square);
    num y = 1.00022189f * cosine_of_turns(1.7953e-3f * path + shift.y) * exp2_of(-5.29946445e-7f * square);
    num z = 1.00112249f * cosine_of_turns(2.2084e-3f * path + shift.z) * exp2_of(-3.76594254e-7f * square);
    x = x + second;
    return vec3_of(3.2404542f * x - 1.5371385f * y - 0.4985314f * z, -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
                   0.0556434f * x - 0.2040259f * y + 1.0572252f * z);
}

FN vec3 film_reflectance(vec3 f0, num film_ior, num thickness, num c)
{
    num inside = square_root(positive(1.0f - (1.0f - c * c) / (film_ior * film_ior))); // cosine after refraction
    num first_f0 = boundary_f0(film_ior, num_of(1.0f));
    num first = first_f0 + (1.0f - first_f0) * fifth_power(1.0f - c);
    num through = 1.0f - first;
    vec3 root = root3(min3(add3(f0, grey3(num_of(0.0001f))), num_of(0.9999f)));
    vec3 one = grey3(num_of(1.0f));
    vec3 index = divide3(add3(one, root), sub3(one, root)); // index of the base, from its f0
    vec3 second_f0 =
        vec3_of(boundary_f0(index.x, film_ior), boundary_f0(index.y, film_ior), boundary_f0(index.z, film_ior));
    vec3 second = fresnel_mix(second_f0, num_of(1.0f), fifth_power(1.0f - inside));
    num path = 2.0f * film_ior * thickness * inside;
    num half_turn = num_of(0.5f);
    num turn = num_of(1.0f);
    vec3 shift = vec3_of(pick(index.x < film_ior, turn, half_turn), pick(index.y < film_ior, turn, half_turn),
                         pick(index.z < film_ior, turn, half_turn));
    vec3 both_sides = scale3(second, first);
    both_sides = vec3_of(min_of(max_of(both_sides.x, num_of(1.0e-5f)), num_of(0.9999f)),
                         min_of(max_of(both_sides.y, num_of(1.0e-5f)), num_of(0.9999f)),
                         min_of(max_of(both_sides.z, num_of(1.0e-5f)), num_of(0.9999f)));
    vec3 amplitude = root3(both_sides);
    vec3 returned = divide3(scale3(second, through * through), sub3(one, both_sides));
    vec3 sum = add3(grey3(first), returned);
    vec3 order = mul3(sub3(returned, grey3(through)), amplitude);
    sum = add3(sum, mul3(order, scale3(film_sensitivity(path, shift), num_of(2.0f))));
    order = mul3(order, amplitude);
    sum = add3(sum, mul3(order, scale3(film_sensitivity(2.0f * path, scale3(shift, num_of(2.0f))), num_of(2.0f))));
    return vec3_of(positive(sum.x), positive(sum.y), positive(sum.z));
}

// Burley's GGX with two roughnesses, along t and b, as in KHR_materials_anisotropy:
//    D = 1 / (pi at ab ((h.t)^2 / at^2 + (h.b)^2 / ab^2 + (h.n)^2)^2)
//    V = 1 / (2 (n.l |(at v.t, ab v.b, v.n)| + |n.v| |(at l.t, ab l.b, l.n)|))
// S is as in ggx_lobe.
FN num stretched_root(vec3 w, vec3 n, layered m)
{
    num t = m.alpha_t * dot3(w, m.stretch);
    num b = m.alpha_b * dot3(w, m.across);
    num along = dot3(w, n);
    return square_root(t * t + b * b + along * along);
}

FN num stretched_lobe(surface s, vec3 l, layered m)
{
    num n_dot_l = positive(dot3(s.n, l));
    vec3 sum = add3(l, s.v);
    num square = dot3(sum, sum);
    num t = dot3(sum, m.stretch) * m.alpha_b;
    num b = dot3(sum, m.across) * m.alpha_t;
    num along = dot3(sum, s.n) * (m.alpha_t * m.alpha_b);
    num spread = square * (m.alpha_t * m.alpha_b) / max_of(t * t + b * b + along * along, num_of(1.0e-30f));
    num shadow = n_dot_l * stretched_root(s.v, s.n, m) + eye_cosine(s) * stretched_root(l, s.n, m);
    num value = 0.5f * spread * spread * (m.alpha_t * m.alpha_b) * n_dot_l / max_of(shadow, num_of(1.0e-30f));
    return pick(both(both(n_dot_l > 0.0f, present(s.v)), square > 0.0f), value, num_of(0.0f));
}

// Conty and Kulla (2017): fibres perpendicular to the surface, with a spread of alpha = roughness^2 and s = |n x h|:
//    S = pi D V n.l
//    D = (2 + 1/alpha) s^(1/alpha) / (2 pi)
//    V = 1 / (4 n.l |n.v| (1 + L(|n.v|) + L(n.l)))
// L is the authors' fit of the shadowing between fibres.
FN num sheen_fit(num x, num alpha)
{
    num part = (1.0f - alpha) * (1.0f - alpha);
    num a = 21.5473f + (25.3245f - 21.5473f) * part;
    num b = 3.82987f + (3.32435f - 3.82987f) * part;
    num c = 0.19823f + (0.16801f - 0.19823f) * part;
    num d = -1.97760f + (-1.27393f + 1.97760f) * part;
    num e = -4.32054f + (-4.85967f + 4.32054f) * part;
    return a / (1.0f + b * unit_power(x, c)) + d * x + e;
}

FN num sheen_shadow(num c, num alpha)
{
    num low = sheen_fit(min_of(c, num_of(0.5f)), alpha);
    num high = 2.0f * sheen_fit(num_of(0.5f), alpha) - sheen_fit(min_of(1.0f - c, num_of(0.5f)), alpha);
    return exp2_of(1.44269504f * pick(c < 0.5f, low, high));
}

FN num sheen_lobe(surface s, vec3 l, num roughness)
{
    num rough = max_of(roughness, num_of(ROUGHNESS_MIN));
    num alpha = rough * rough;
    num n_dot_l = cosine(dot3(s.n, l));
    num n_dot_v = eye_cosine(s);
    vec3 sum = add3(l, s.v);
    vec3 across = cross3(s.n, sum);
    num square = dot3(sum, sum);
    num sine_square = min_of(dot3(across, across) / max_of(square, num_of(1.0e-30f)), num_of(1.0f));
    num spread = (2.0f + 1.0f / alpha) * unit_power(sine_square, 0.5f / alpha);
    num shadow = 1.0f + sheen_shadow(n_dot_v, alpha) + sheen_shadow(positive(n_dot_l), alpha);
    num value = spread / (8.0f * max_of(n_dot_v, num_of(1.0e-4f)) * shadow);
    return pick(both(both(n_dot_l > 0.0f, present(s.v)), square > 0.0f), value, num_of(0.0f));
}

// Returns the share of uniform light that the sheen reflects: the integral of S over all l, divided by pi.
FN num sheen_albedo(num n_dot_v, num roughness)
{
    albedo_cell p = albedo_cell_of(n_dot_v, roughness);
    num a = p.across;
    num upper = sheen_texel(p.first) * (1.0f - a) + sheen_texel(p.first + 1.0f) * a;
    num lower = sheen_texel(p.first + 32.0f) * (1.0f - a) + sheen_texel(p.first + 33.0f) * a;
    return upper + (lower - upper) * p.down;
}

// The microfacets that the eye sees: GGX with two roughnesses. All vectors have the components along t, b and n.
STRUCT(seen_facets)
{
    vec3 v;      // towards the eye, n.v >= 0
    vec3 alpha;  // alpha along t and along b; 1
    vec3 middle; // unit: the direction to the eye in the space in which microfacets form a sphere
    vec3 side;   // unit, perpendicular to `middle` and to n
    vec3 up;     // unit, perpendicular to both
};

FN seen_facets seen_facets_of(vec3 v, num alpha_t, num alpha_b)
{
    seen_facets f;
    f.v = v;
    f.alpha = vec3_of(alpha_t, alpha_b, num_of(1.0f));
    f.middle = unit3(mul3(f.alpha, v));
    vec3 across = vec3_of(-f.middle.y, f.middle.x, num_of(0.0f));
    f.side = unit3(pick3(dot3(across, across) < 1.0e-12f, vec3_of(num_of(0.0f), num_of(1.0f), num_of(0.0f)), across));
    f.up = cross3(f.middle, f.side);
    return f;
}

// Returns the normal of a microfacet that the eye sees. The point (x, y) of the unit disc selects it (Heitz, "Sampling
// the GGX Distribution of Visible Normals", 2018); evenly distributed points select microfacets by their visible area.
FN vec3 seen_facet(seen_facets f, num x, num y)
{
    num lift = 0.5f * (1.0f + f.middle.z);
    num up = (1.0f - lift) * square_root(positive(1.0f - x * x)) + lift * y;
    num front = square_root(positive(1.0f - x * x - up * up));
    vec3 h = add3(add3(scale3(f.side, x), scale3(f.up, up)), scale3(f.middle, front));
    return unit3(mul3(f.alpha, vec3_of(h.x, h.y, positive(h.z))));
}

// Returns the length of w after its components are multiplied by alpha: the root in Smith's shadowing.
FN num facet_root(seen_facets f, vec3 w)
{
    vec3 a = mul3(f.alpha, w);
    return square_root(dot3(a, a));
}

// Sets `albedo` and `bias`. Works like single_scattering and schlick_scattering, for two roughnesses. The result is the mean of
//    G2 / G1 = n.l (n.v + root(v)) / (n.l root(v) + n.v root(l))
// over the microfacets that 28 points of a disc select. The points form a spiral (Vogel 1979): their angle increases by
// the golden angle. If the roughnesses are nearly equal, the tables of isotropic lobes replace the mean. Compared with
// the integral, the largest error is 4 %, and the mean error is 1 %.
// `v` has the components along t, b and n.
FN layered stretched_scattering(layered sum, vec3 v)
{
    sum.albedo = num_of(0.0f);
    sum.bias = num_of(0.0f);
    seen_facets f = seen_facets_of(v, sum.alpha_t, sum.alpha_b);
    num root_v = facet_root(f, v);
    num x = num_of(0.0f);
    num y = num_of(1.0f);
    num square = num_of(0.5f / 28.0f);
    for (int i = 0; i < 28; i++) {
        num radius = square_root(square);
        vec3 h = seen_facet(f, radius * x, radius * y);
        num v_dot_h = positive(dot3(v, h));
        vec3 l = sub3(scale3(h, 2.0f * v_dot_h), v);
        num n_dot_l = positive(l.z);
        num shadow = n_dot_l * root_v + v.z * facet_root(f, l);
        num share = n_dot_l * (v.z + root_v) / max_of(shadow, num_of(1.0e-30f));
        sum.albedo = sum.albedo + share / 28.0f;
        sum.bias = sum.bias + share * fifth_power(positive(1.0f - v_dot_h)) / 28.0f;
        num turned = -0.737368878f * x - 0.675490294f * y;
        y = 0.675490294f * x - 0.737368878f * y;
        x = turned;
        square = square + 1.0f / 28.0f;
    }
    num unequal = saturate(4.0f * (1.0f - sum.alpha_b / sum.alpha_t));
    num roughness = square_root(0.5f * (sum.alpha_t + sum.alpha_b));
    num albedo = single_scattering(v.z, roughness);
    num bias = schlick_scattering(v.z, roughness);
    // The least albedo is 0.3. Only without an eye it is 0.
    sum.albedo = max_of(albedo + (sum.albedo - albedo) * unequal, num_of(0.1f));
    sum.bias = bias + (sum.bias - bias) * unequal;
    return sum;
}

// `scattering` is 0 without multiple scattering.
FN layered layered_of(surface s, layer_values m, int scattering, int set)
{
    layered y;
    num n_dot_v = eye_cosine(s);
    y.dielectric = grey3(num_of(DIELECTRIC_F0));
    y.grazing = num_of(1.0f);
    if ((set & LAYER_DIELECTRIC) != 0) {
        vec3 reflected = scale3(m.f0_color, boundary_f0(m.ior, num_of(1.0f)));
        y.dielectric = scale3(min3(reflected, num_of(1.0f)), m.specular_weight);
        y.grazing = m.specular_weight;
    }
    y.metal = m.base;
    y.metallic = m.metallic;
    y.roughness = m.roughness;
    y.albedo = num_of(1.0f);
    y.bias = num_of(0.0f);
    y.alpha_t = num_of(1.0f);
    y.alpha_b = num_of(1.0f);
    y.stretch = m.stretch;
    y.across = m.stretch;
    if ((set & LAYER_ANISOTROPY) != 0) {
        num least = max_of(m.roughness, num_of(ROUGHNESS_MIN));
        y.alpha_b = least * least;
        y.alpha_t = y.alpha_b + (1.0f - y.alpha_b) * m.anisotropy * m.anisotropy;
        y.across = cross3(s.n, m.stretch);
        vec3 v = vec3_of(dot3(s.v, y.stretch), dot3(s.v, y.across), n_dot_v);
        y = stretched_scattering(y, v);
    }
    y.gain = num_of(0.0f);
    y.coat_gain = num_of(0.0f);
    if (scattering != 0) {
        y.gain = scattering_gain(s, m.roughness);
        if ((set & LAYER_ANISOTROPY) != 0) {
            y.gain = 1.0f / y.albedo - 1.0f;
        }
    }
    y.iridescence = m.iridescence;
    y.iridescence_ior = max_of(m.iridescence_ior, num_of(1.0f));
    y.film = m.film;
    y.opaque = num_of(1.0f);
    if ((set & LAYER_TRANSMISSION) != 0) {
        y.opaque = 1.0f - m.transmission;
    }
    y.matt = y.opaque;
    if ((set & LAYER_DIELECTRIC) != 0) {
        y.matt = y.opaque * positive(1.0f - m.specular_glossiness * largest3(y.dielectric));
    }
    y.sheen_color = m.sheen_color;
    y.sheen_largest = num_of(0.0f);
    y.sheen_roughness = m.sheen_roughness;
    y.sheen_left = num_of(1.0f);
    if ((set & LAYER_SHEEN) != 0) {
        y.sheen_largest = largest3(m.sheen_color);
        y.sheen_left = positive(1.0f - y.sheen_largest * sheen_albedo(n_dot_v, m.sheen_roughness));
    }
    y.coat_normal = m.clearcoat_normal;
    y.coat_roughness = m.clearcoat_roughness;
    y.coat = num_of(0.0f);
    if ((set & LAYER_CLEARCOAT) != 0) {
        num along = absolute(cosine(dot3(s.v, m.clearcoat_normal)));
        y.coat = m.clearcoat * (DIELECTRIC_F0 + (1.0f - DIELECTRIC_F0) * fifth_power(1.0f - along));
        if (scattering != 0) {
            y.coat_gain = DIELECTRIC_F0 * (1.0f / single_scattering(along, m.clearcoat_roughness) - 1.0f);
        }
    }
    return y;
}

// Return the Fresnel factors for the angle between the eye and a microfacet, with the cosine `c` and Schlick's weight.
FN vec3 layered_dielectric(layered m, num c, num weight, int set)
{
    vec3 f = fresnel_mix(m.dielectric, m.grazing, weight);
    if ((set & LAYER_IRIDESCENCE) != 0) {
        f = mix3(f, film_reflectance(m.dielectric, m.iridescence_ior, m.film, c), m.iridescence);
    }
    return f;
}

FN vec3 layered_metal(layered m, num c, num weight, int set)
{
    vec3 f = fresnel_mix(m.metal, num_of(1.0f), weight);
    if ((set & LAYER_IRIDESCENCE) != 0) {
        f = mix3(f, film_reflectance(m.metal, m.iridescence_ior, m.film, c), m.iridescence);
    }
    return f;
}

// Mixes the dielectric and the metal, each with its own multiple scattering.
FN vec3 layered_mix(layered m, vec3 dielectric, vec3 metal)
{
    vec3 one = grey3(num_of(1.0f));
    vec3 d = mul3(dielectric, add3(one, scale3(m.dielectric, m.gain)));
    vec3 c = mul3(metal, add3(one, scale3(m.metal, m.gain)));
    return mix3(d, c, m.metallic);
}

// Returns the response to light from one direction:
//    base   = (1 - metallic) ((1 - max F_d) (1 - max f0_d) (1 - transmission) n.l, F_d S) + metallic F_m S
//             the second factor is only for specular-glossiness materials; S is from `lobe`, a microfacet model, unless
//             the highlight is anisotropic
//    sheen  = sheen_color S_s + base min(1 - max sheen_color E(n.v), 1 - max sheen_color E(n.l))
//    coated = clearcoat F(n_c.v) S_c + (1 - clearcoat F(n_c.v)) sheen
FN layered_value layered_light(surface s, layered m, vec3 l, lobe_value lobe, int set)
{
    layered_value r;
    vec3 sum = add3(l, s.v);
    num v_dot_h = min_of(0.5f * square_root(dot3(sum, sum)), num_of(1.0f));
    num weight = fifth_power(1.0f - v_dot_h);
    vec3 dielectric = layered_dielectric(m, v_dot_h, weight, set);
    vec3 metal = layered_metal(m, v_dot_h, weight, set);
    num lambert = positive(cosine(dot3(s.n, l)));
    num strength = lobe.specular;
    if ((set & LAYER_ANISOTROPY) != 0) {
        strength = stretched_lobe(s, l, m);
    }
    r.diffuse = lambert * positive(1.0f - largest3(dielectric)) * m.matt;
    r.specular = scale3(layered_mix(m, dielectric, metal), strength);
    r.strength = strength;
    r.base_diffuse = r.diffuse;
    r.base = r.specular;
    r.sheen_left = num_of(1.0f);
    r.sheen = black3();
    r.coat = num_of(0.0f);
    if ((set & LAYER_SHEEN) != 0) {
        num left = positive(1.0f - m.sheen_largest * sheen_albedo(positive(dot3(s.n, l)), m.sheen_roughness));
        r.sheen_left = min_of(left, m.sheen_left);
        r.sheen = scale3(m.sheen_color, sheen_lobe(s, l, m.sheen_roughness));
        r.diffuse = r.diffuse * r.sheen_left;
        r.specular = add3(scale3(r.specular, r.sheen_left), r.sheen);
    }
    if ((set & LAYER_CLEARCOAT) != 0) {
        surface top = s;
        top.n = m.coat_normal;
        lobe_sample c = ggx_lobe(top, l, m.coat_roughness);
        r.coat = m.coat * (1.0f + m.coat_gain) * pick(c.lit, c.base, num_of(0.0f));
        r.diffuse = r.diffuse * (1.0f - m.coat);
        r.specular = add3(scale3(r.specular, 1.0f - m.coat), grey3(r.coat));
    }
    return r;
}

// Adds spot * attenuation * (kd * Ld D + Ls S).
FN terms add_layered(terms sum, light_source light, light_sample t, layered_value r)
{
    num arriving = t.attenuation * t.spot;
    sum.diffuse = add3(sum.diffuse, scale3(light.diffuse, arriving * r.diffuse));
    sum.specular = add3(sum.specular, scale3(mul3(light.specular, r.specular), arriving));
    return sum;
}

// Applies the layers to the terms without a direction: the surface's emission under the coat, and ambient light.
FN terms cover_terms(terms sum, layered m, int set)
{
    if ((set & LAYER_TRANSMISSION) != 0) {
        sum.ambient = scale3(sum.ambient, m.opaque + (1.0f - m.opaque) * m.metallic);
    }
    if ((set & LAYER_SHEEN) != 0) {
        sum.ambient = scale3(sum.ambient, m.sheen_left);
    }
    if ((set & LAYER_CLEARCOAT) != 0) {
        sum.ambient = scale3(sum.ambient, 1.0f - m.coat);
        sum.emission = scale3(sum.emission, 1.0f - m.coat);
    }
    return sum;
}

// Returns a surface whose mirror direction represents an anisotropic highlight: its normal is bent towards the eye,
// across the stretched direction (KHR_materials_anisotropy, image-based lighting).
FN surface bent_surface(surface s, layered m, num anisotropy)
{
    vec3 bent = unit3(cross3(cross3(m.across, s.v), m.across));
    num straight = 1.0f - anisotropy * (1.0f - m.roughness);
    straight = straight * straight * (straight * straight);
    s.n = unit3(mix3(bent, s.n, straight));
    return s;
}

FN surface coat_surface(surface s, layered m)
{
    s.n = m.coat_normal;
    return s;
}

// Returns the reflected environment light: the split sum of each layer. The sheen uses the mean of the light above the
// surface.
FN returned_light layered_surroundings(surface s, layered m, vec3 kd, surroundings e, surroundings top, int set)
{
    returned_light r;
    num c = eye_cosine(s);
    num scale = e.albedo - e.bias;
    vec3 d = add3(scale3(m.dielectric, scale), grey3(m.grazing * e.bias));
    vec3 f = add3(scale3(m.metal, scale), grey3(e.bias));
    if ((set & LAYER_IRIDESCENCE) != 0) {
        vec3 film_d = scale3(film_reflectance(m.dielectric, m.iridescence_ior, m.film, c), e.albedo);
        vec3 film_m = scale3(film_reflectance(m.metal, m.iridescence_ior, m.film, c), e.albedo);
        d = mix3(d, film_d, m.iridescence);
        f = mix3(f, film_m, m.iridescence);
    }
    num matt = positive(1.0f - largest3(d)) * m.matt;
    r.diffuse = mul3(scale3(kd, matt), e.irradiance);
    r.specular = mul3(layered_mix(m, d, f), e.prefiltered);
    if ((set & LAYER_SHEEN) != 0) {
        vec3 fibres = scale3(m.sheen_color, sheen_albedo(eye_cosine(s), m.sheen_roughness));
        r = scale_returned(r, m.sheen_left);
        r.specular = add3(r.specular, mul3(fibres, e.irradiance));
    }
    if ((set & LAYER_CLEARCOAT) != 0) {
        num mirrored = m.coat * (1.0f + m.coat_gain) * top.albedo;
        r = scale_returned(r, 1.0f - m.coat);
        r.specular = add3(r.specular, scale3(top.prefiltered, mirrored));
    }
    return r;
}

// Returns the transmittance along the view direction: (1 - max F_d) transmission base, times the volume's attenuation,
// under sheen and coat.
FN vec3 layered_transmittance(surface s, layered m, layer_values given, int set)
{
    num c = eye_cosine(s);
    vec3 dielectric = layered_dielectric(m, c, fifth_power(1.0f - c), set);
    num entering = positive(1.0f - largest3(dielectric)) * (1.0f - m.metallic) * (1.0f - m.opaque);
    vec3 through = scale3(given.base, entering);
    if ((set & LAYER_VOLUME) != 0) {
        vec3 left = scale3(given.attenuation_log, given.path);
        through = mul3(through, vec3_of(exp2_of(left.x), exp2_of(left.y), exp2_of(left.z)));
    }
    if ((set & LAYER_SHEEN) != 0) {
        through = scale3(through, m.sheen_left);
    }
    if ((set & LAYER_CLEARCOAT) != 0) {
        through = scale3(through, 1.0f - m.coat);
    }
    return through;
}

// --- C only: the GLSL text ends here (src/gpu/glsl/embed.py).

// Returns the values of a material that are the same at all points. The base colour, the coat's normal and the
// stretched direction are not set, because they differ between points.
LANE_FN layer_values layers_of(const lam_material *m)
{
    layer_values y;
    vec3 zero = vec3_of(num_of(0.0f), num_of(0.0f), num_of(0.0f));
    y.base = vec3_of(num_of(m->diffuse.r), num_of(m->diffuse.g), num_of(m->diffuse.b));
    y.metallic = num_of(m->metallic);
    y.roughness = num_of(m->roughness);
    y.clearcoat_normal = zero;
    y.anisotropy = num_of(m->anisotropy);
    y.stretch = zero;
#define NUMBER(member)                    y.member = num_of(m->member);
#define MAPPED_NUMBER(member, field, map) y.member = num_of(m->field);
#define MAPPED_COLOR(member, field, map)  y.member = vec3_of(num_of(m->field.r), num_of(m->field.g), num_of(m->field.b));
    LAYER_NUMBERS(NUMBER)
    LAYER_MAPPED_NUMBERS(MAPPED_NUMBER)
    LAYER_MAPPED_COLORS(MAPPED_COLOR)
#undef NUMBER
#undef MAPPED_NUMBER
#undef MAPPED_COLOR
    y.path = num_of(0.0f);
    y.attenuation_log = zero;
    return y;
}
