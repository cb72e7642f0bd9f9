// lobe_sampling.h: samples the directions from which a material reflects light, for sums of light from all directions. C
// only.
#ifndef LOBE_SAMPLING_H
#define LOBE_SAMPLING_H

#include "lighting.h"

enum lobe_kind { SAMPLED_FACETS, SAMPLED_FIBRES, SAMPLED_COSINE, SAMPLED_SPHERE };

// A lobe that samples directions.
struct sampled_lobe {
    enum lobe_kind kind;
    vec3 x, y, n; // the axes of `facets`
    seen_facets facets;
    num seen;     // n.v + the root of v
    num exponent; // of fibres: 1 / alpha
    mask mirrors; // Whether n.v > 0. If not, facets and fibres sample no directions.
};

// A lobe around n. `x` is a direction along the surface: alpha_t is the roughness along it.
LANE_FN struct sampled_lobe sampled_lobe_of(vec3 n, vec3 v, vec3 x, num alpha_t, num alpha_b)
{
    struct sampled_lobe f = {.x = x, .y = cross3(n, x), .n = n, .exponent = 1.0f / alpha_b};
    num n_dot_v = cosine(dot3(n, v));
    f.mirrors = n_dot_v > 0.0f;
    n_dot_v = pick(f.mirrors, n_dot_v, num_of(1.0f));
    f.facets = seen_facets_of(vec3_of(dot3(x, v), dot3(f.y, v), n_dot_v), alpha_t, alpha_b);
    f.seen = n_dot_v + facet_root(f.facets, f.facets.v);
    return f;
}

// An isotropic lobe. Its axis x is towards the eye, so that the directions change smoothly over a surface.
LANE_FN struct sampled_lobe round_lobe_of(vec3 n, vec3 v, num roughness)
{
    vec3 along_x = vec3_of(num_of(1.0f), num_of(0.0f), num_of(0.0f));
    vec3 along_y = vec3_of(num_of(0.0f), num_of(1.0f), num_of(0.0f));
    vec3 any = perpendicular3(pick3(absolute(n.x) < 0.7f, along_x, along_y), n), x = perpendicular3(v, n);
    num alpha = max_of(roughness, num_of(ROUGHNESS_MIN));
    alpha = alpha * alpha;
    return sampled_lobe_of(n, v, pick3(present(x), x, any), alpha, alpha);
}

LANE_FN vec3 from_lobe_axes(const struct sampled_lobe *f, num x, num y, num z)
{
    return add3(add3(scale3(f->x, x), scale3(f->y, y)), scale3(f->n, z));
}

// Returns a direction from which a microfacet or a fibre reflects light to the eye, for a point of the unit disc. Their normal is h. The sine s of
// fibres has the density (2 + 1/alpha) s^(1 + 1/alpha).
LANE_FN vec3 direction_by_lobe(const struct sampled_lobe *f, vec3 v, num x, num y)
{
    num square = x * x + y * y;
    if (f->kind == SAMPLED_COSINE)
        return from_lobe_axes(f, x, y, square_root(positive(1.0f - square)));
    if (f->kind == SAMPLED_SPHERE) {
        num scale = 2.0f * square_root(positive(1.0f - square));
        return from_lobe_axes(f, scale * x, scale * y, 1.0f - 2.0f * square);
    }
    vec3 h = seen_facet(f->facets, x, y);
    if (f->kind == SAMPLED_FIBRES) {
        num sine_square = unit_power(square, 2.0f / (2.0f + f->exponent));
        num scale = square_root(sine_square) * (1.0f / square_root(square));
        h = vec3_of(scale * x, scale * y, square_root(positive(1.0f - sine_square)));
    }
    return unit3(sub3(scale3(from_lobe_axes(f, h.x, h.y, h.z), 2.0f * dot3(h, f->facets.v)), v));
}

// Returns pi times the density of direction_by_lobe around l: pi D / (2 (n.v + root(v))) for microfacets,
// pi D n.h / (4 v.h) for fibres, the cosine itself, and 1/4 for the sphere.
LANE_FN num lobe_density(const struct sampled_lobe *f, vec3 v, vec3 l)
{
    vec3 sum = add3(l, v), alpha = f->facets.alpha;
    num square = dot3(sum, sum), along = dot3(sum, f->n), density;
    if (f->kind == SAMPLED_SPHERE) {
        density = num_of(0.25f);
    } else if (f->kind == SAMPLED_COSINE) {
        density = positive(cosine(dot3(f->n, l)));
    } else if (f->kind == SAMPLED_FIBRES) {
        vec3 across = cross3(f->n, sum);
        square = max_of(square, num_of(1.0e-30f));
        density = (2.0f + f->exponent) * unit_power(dot3(across, across) / square, 0.5f * f->exponent) *
                  positive(along) / (4.0f * square);
    } else {
        num t = dot3(sum, f->x) * alpha.y, b = dot3(sum, f->y) * alpha.x, both_alpha = alpha.x * alpha.y;
        num bracket = t * t + b * b + (along * both_alpha) * (along * both_alpha);
        num spread = square * both_alpha / max_of(bracket, num_of(1.0e-30f));
        density = 0.5f * spread * spread * both_alpha / f->seen;
    }
    return pick(f->mirrors, density, num_of(0.0f));
}

// Makes the lobes that sample a physical material: the base, the coat, the sheen, and the cosine as the last. Returns
// their number.
enum { LOBES_MAX = 4 };
LANE_FN int sampled_lobes_of(const physical_point *point, struct sampled_lobe lobes[LOBES_MAX])
{
    surface s = point->s;
    const layered *m = &point->layered;
    int set = point->layers, count = 0;
    lobes[count++] = set & LAYER_ANISOTROPY ? sampled_lobe_of(s.n, s.v, m->stretch, m->alpha_t, m->alpha_b)
                                            : round_lobe_of(s.n, s.v, point->m.roughness);
    if (set & LAYER_CLEARCOAT)
        lobes[count++] = round_lobe_of(m->coat_normal, s.v, m->coat_roughness);
    if (set & LAYER_SHEEN) {
        lobes[count] = round_lobe_of(s.n, s.v, m->sheen_roughness);
        lobes[count++].kind = SAMPLED_FIBRES;
    }
    lobes[count] = lobes[0];
    lobes[count].mirrors = present(s.n);
    lobes[count++].kind = SAMPLED_COSINE;
    return count;
}

// Returns the terms of light from the direction t.l that a point reflects, as the sum over lights computes them
// (sum.h). The point may have any reflection model. The colours of `light` are products with the material's.
LANE_FN terms reflected_terms(const physical_point *p, light_source light, light_sample t)
{
    terms sum = start_terms(black3(), black3());
    lobe_value lobe = reflect_light(p->s, t.l, p->m, p->model);
    if (p->layers)
        return add_layered(sum, light, t, layered_light(p->s, p->layered, t.l, lobe, p->layers));
    if (lobe_properties(p->model) & LOBE_MICROFACET)
        light = with_fresnel(light, p->f, p->s.v, t.l);
    if (lobe_properties(p->model) & LOBE_TONED)
        light = with_tone(light, p->s.n, t.l);
    return add_reflected(sum, light, t, lobe);
}

#endif
