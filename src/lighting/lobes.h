// lobes.h: how a point of a surface answers the light of one direction: Lambert, Phong, Blinn-Phong, Kajiya-Kay.
//
// One text for C and GLSL (prelude_c.h, prelude.glsl). All vectors are in eye space: n the unit normal, l from the
// point to the light, v from the point to the eye, t the tangent, all of length 1, or 0 where there is none; then the
// answer is 0. D is the share of diffuse light, S the strength of the highlight, both in 0...1; what multiplies them
// stands in sum.h. No light comes through a surface: S is 0 where n.l <= 0, since r.v and n.h may be positive there.

// The reflection models, numbered as in lambent/device.h.
#define MODEL_NONE               1
#define MODEL_LAMBERT            2
#define MODEL_PHONG              3
#define MODEL_BLINN_PHONG        4
#define MODEL_KAJIYA_KAY         5
#define MODEL_KAJIYA_KAY_LECTURE 6

STRUCT(surface)
{
    vec3 p; // the point
    vec3 n; // its normal, on the side that is seen
    vec3 v; // towards the eye
    vec3 t; // along the surface, perpendicular to n; only Kajiya-Kay looks at it
};

// How the surface meets the light of one direction, but for the highlight's power.
STRUCT(lobe_sample)
{
    num diffuse; // D
    num n_dot_l; // cosine between normal and light, -1...1
    num base;    // of the highlight before it goes to the power: r.v or n.h or the cone's cosine, at most 1
    mask lit;    // whether there is a highlight: S is 0 elsewhere
};

STRUCT(lobe_value)
{
    num diffuse;  // D
    num specular; // S
    num n_dot_l;  // as above
    num base;     // as above, 0...1
};

// x in -1...1: a dot product of unit vectors may be a rounding more.
FN num cosine(num x) { return min_of(max_of(x, num_of(-1.0f)), num_of(1.0f)); }

// Whether a direction is there at all: not the zero vector.
FN mask present(vec3 w) { return dot3(w, w) > 0.0f; }

// The mirror image of w about n:  2 (n.w) n - w.  Of l it is the lectures' r, of v the ray that an environment is
// looked up with.
FN vec3 mirror3(vec3 w, vec3 n) { return sub3(scale3(n, 2.0f * dot3(n, w)), w); }

// The vector halfway between l and v, both of length 1.
FN vec3 halfway3(vec3 l, vec3 v) { return unit3(add3(l, v)); }

// w made perpendicular to n and unit (Gram and Schmidt); 0 where w lies along n.
FN vec3 perpendicular3(vec3 w, vec3 n) { return unit3(sub3(w, scale3(n, dot3(n, w)))); }

// Lambert (1760): a matt surface sends the light it takes in evenly to all sides, and takes in the more the steeper the
// light falls:  D = max(n.l, 0)
FN lobe_sample lambert_lobe(surface s, vec3 l)
{
    lobe_sample b;
    b.n_dot_l = cosine(dot3(s.n, l));
    b.diffuse = positive(b.n_dot_l);
    b.base = num_of(0.0f);
    b.lit = both(b.n_dot_l > 0.0f, present(s.v));
    return b;
}

// Phong (1975): the highlight is round the mirror image of the light.  S = [n.l > 0] max(r.v, 0)^shininess
// r.v is taken as 1 - |r - v|^2 / 2, the same for unit vectors: an error in the length of n would count fourfold in the
// product where the highlight is brightest, and here it does not count at all.
FN num phong_base(vec3 n, vec3 l, vec3 v)
{
    vec3 apart = sub3(mirror3(l, n), v);
    return 1.0f - 0.5f * dot3(apart, apart);
}

FN lobe_sample phong_lobe(surface s, vec3 l)
{
    lobe_sample b = lambert_lobe(s, l);
    b.base = phong_base(s.n, l, s.v);
    return b;
}

// Blinn (1977), the lectures' modified Phong: how near the normal comes to the vector halfway between light and eye.
// S = [n.l > 0] max(n.h, 0)^shininess  with  h = (l + v) / |l + v|
// The length is divided by after the product with n, which saves three products; n.l + n.v in place of n.(l + v) would
// save more and lose digits where l and v are nearly opposite.
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

// Kajiya and Kay (1989): a thread along t mirrors light into a cone round t. With the angles between t and l, t and v:
//     D = sin(t,l)        S = max(sin(t,l) sin(t,v) - cos(t,l) cos(t,v), 0)^shininess        the mirror cone
//                         S = max(sin(t,l) sin(t,v) + cos(t,l) cos(t,v), 0)^shininess        `lecture`, as some print it
// sin(t,l) = |t x l|: the root of 1 - (t.l)^2 would lose half of the digits where l is nearly along t. On a solid
// surface D and S are gated by n.l > 0; a fibre has no inside, and the lecture's form has no gate.
FN lobe_sample kajiya_kay_lobe(surface s, vec3 l, int lecture, int fibre)
{
    vec3 across_l = cross3(s.t, l);
    vec3 across_v = cross3(s.t, s.v);
    num sine_l = min_of(square_root(dot3(across_l, across_l)), num_of(1.0f));
    num sine_v = min_of(square_root(dot3(across_v, across_v)), num_of(1.0f));
    num cosines = dot3(s.t, l) * dot3(s.t, s.v);
    lobe_sample b;
    b.n_dot_l = cosine(dot3(s.n, l));
    b.base = sine_l * sine_v - cosines;
    if (lecture != 0) {
        b.base = sine_l * sine_v + cosines;
    }
    mask there = both(present(s.t), present(l));
    if (fibre == 0 && lecture == 0) {
        there = both(there, b.n_dot_l > 0.0f);
    }
    b.diffuse = pick(there, sine_l, num_of(0.0f));
    b.lit = both(there, present(s.v));
    return b;
}

// The model by its number. MODEL_NONE answers no light: its colour is `unlit` in sum.h.
FN lobe_sample lobe_of(surface s, vec3 l, int model, int fibre)
{
    lobe_sample b = lambert_lobe(s, l);
    if (model == MODEL_NONE) {
        b.diffuse = num_of(0.0f);
    }
    if (model == MODEL_PHONG) {
        b = phong_lobe(s, l);
    }
    if (model == MODEL_BLINN_PHONG) {
        b = blinn_phong_lobe(s, l);
    }
    if (model == MODEL_KAJIYA_KAY) {
        b = kajiya_kay_lobe(s, l, 0, fibre);
    }
    if (model == MODEL_KAJIYA_KAY_LECTURE) {
        b = kajiya_kay_lobe(s, l, 1, fibre);
    }
    return b;
}

// The highlight to its power.
FN lobe_value reflected_of(lobe_sample b, num shininess)
{
    lobe_value r;
    r.diffuse = b.diffuse;
    r.specular = pick(b.lit, unit_power(b.base, shininess), num_of(0.0f));
    r.n_dot_l = b.n_dot_l;
    r.base = saturate(b.base);
    return r;
}

FN lobe_value reflect_light(surface s, vec3 l, num shininess, int model, int fibre)
{
    lobe_value r = reflected_of(lobe_of(s, l, model, fibre), shininess);
    if (model <= MODEL_LAMBERT) { // and MODEL_NONE: no highlight
        r.specular = num_of(0.0f);
    }
    return r;
}
