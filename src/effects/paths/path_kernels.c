// path_kernels.c: advances paths at LANES points. This file is compiled once for each instruction set, with LANES and
// ISA defined (meson.build).
#include "lobe_sampling.h"
#include "path_numbers.h"
#include "path_tree.h"
#include "paths.h"

#define PI_F 3.14159265f

// The decisions of a path at one surface; each uses a pair of numbers.
enum { CHOOSE_EVENT, CHOOSE_DIRECTION, CHOOSE_SOURCE, CHOOSE_ON_SOURCE, DECISIONS };

// Roulette begins at this surface of a path, and ends a path with at least this probability.
enum { ROULETTE_FROM = 3, EVENTS_MAX = 1024 };
#define ROULETTE_MOST 0.95f

// Below this roughness, a surface without diffuse light shows what it reflects, so that glass in it must refract.
#define SHARP_ROUGHNESS 0.25f

struct numbers {
    _Alignas(64) float u[DECISIONS][LANES], v[DECISIONS][LANES];
};

// The lobes of a point, with the probability of each.
struct lobe_mixture {
    struct sampled_lobe lobe[LOBES_MAX];
    num share[LOBES_MAX];
    int count;
    num reflects;        // the probability of an event that these lobes sample
    num passes, mirrors; // the probabilities of passing through the surface, and of a perfect mirror
    mask sharp;
};

// The points that scatter paths.
struct scattering {
    const struct path_frame *frame;
    struct path_stream *stream;
    const struct lit_point *point;
    const struct ray_starts *starts;
    int at; // of the first point in `starts`
    const uint32_t *paths;
    struct numbers numbers;
    struct lobe_mixture lobes;
};

LANE_FN num luminance(vec3 c) { return dot3(vec3_of(num_of(0.2126f), num_of(0.7152f), num_of(0.0722f)), c); }

LANE_FN vec3 load_vector(float rows[3][LANES])
{
    return vec3_of(num_load(rows[0]), num_load(rows[1]), num_load(rows[2]));
}

LANE_FN void store_vector(float rows[3][LANES], vec3 v)
{
    num_store(rows[0], v.x);
    num_store(rows[1], v.y);
    num_store(rows[2], v.z);
}

// --- lobes

// Returns the estimated luminance of the highlight towards the eye.
LANE_FN num highlight_of(const struct lit_point *p)
{
    const physical_point *b = &p->base;
    num c = eye_cosine(b->s), weight = fifth_power(1.0f - c);
    vec3 color = p->ks;
    if (b->layers)
        color = mul3(color, layered_mix(b->layered, layered_dielectric(b->layered, c, weight, b->layers),
                                        layered_metal(b->layered, c, weight, b->layers)));
    else if (lobe_properties(b->model) & LOBE_MICROFACET)
        color = mul3(color, add3(b->f.f0, scale3(b->f.rest, weight)));
    return luminance(mul3(color, p->specular));
}

// The lobes of a classic material: a microfacet lobe of the highlight's width and the cosine, or the sphere if light from
// behind contributes.
LANE_FN int classic_lobes_of(const physical_point *p, struct sampled_lobe lobes[LOBES_MAX])
{
    int properties = lobe_properties(p->model);
    bool all_sides = properties & (LOBE_BACKLIT | LOBE_TANGENT);
    num exponent = p->m.shininess * (properties & LOBE_MIRRORED ? 4.0f : 1.0f);
    lobes[0] = lobes[1] = round_lobe_of(p->s.n, p->s.v, square_root(square_root(2.0f / (exponent + 2.0f))));
    lobes[1].kind = all_sides ? SAMPLED_SPHERE : SAMPLED_COSINE;
    lobes[1].mirrors = present(p->s.n);
    return 2;
}

// Returns the lobes of a point, with probabilities in proportion to their estimated light.
LANE_FN struct lobe_mixture mixture_of(const struct lit_point *p, mask straight)
{
    const physical_point *b = &p->base;
    struct lobe_mixture m; // large, so it is not cleared
    num zero = num_of(0.0f), sum = zero;
    bool physical = lobe_properties(b->model) & LOBE_MICROFACET, hairy = lobe_properties(b->model) & LOBE_TANGENT;
    m.count = physical ? sampled_lobes_of(b, m.lobe) : classic_lobes_of(b, m.lobe);
    num diffuse = luminance(mul3(b->kd, p->diffuse)) * p->matt;
    num highlight = lobe_properties(b->model) & LOBE_HIGHLIGHT ? highlight_of(p) : zero;
    if (lobe_properties(b->model) & LOBE_TONED || hairy) {
        diffuse = diffuse + highlight;
        highlight = zero;
    }
    num given[LOBES_MAX] = {highlight};
    for (int i = 1; i < m.count; i++)
        given[i] = m.lobe[i].kind == SAMPLED_FACETS   ? b->layered.coat
                   : m.lobe[i].kind == SAMPLED_FIBRES ? luminance(b->layered.sheen_color)
                                                      : diffuse;
    num through = pick(straight, zero, luminance(p->through)), mirrored = luminance(p->mirrored);
    for (int i = 0; i < m.count; i++) {
        m.share[i] = pick(m.lobe[i].mirrors, given[i], zero);
        sum = sum + m.share[i];
    }
    m.sharp = physical ? both(b->m.roughness < SHARP_ROUGHNESS, diffuse < 0.25f * (highlight + luminance(p->through)))
                       : diffuse < 0.25f * mirrored;
    for (int i = 0; i < m.count; i++) // a metal seen at a grazing angle or from behind needs a share of the cosine
        m.share[i] = pick(sum > 0.0f, m.share[i] / sum, num_of(i == m.count - 1 ? 1.0f : 0.0f));
    num all = (sum + through) + mirrored;
    m.passes = pick(all > 0.0f, through / all, zero);
    m.mirrors = pick(all > 0.0f, mirrored / all, zero);
    m.reflects = pick(all > 0.0f, sum / all, num_of(1.0f));
    if (p->inside) {
        m.passes = num_of(1.0f);
        m.mirrors = m.reflects = zero;
    }
    return m;
}

// Returns pi times the density of a direction.
LANE_FN num mixture_density(const struct lobe_mixture *m, vec3 v, vec3 l)
{
    num density = num_of(0.0f);
    for (int i = 0; i < m->count; i++)
        density = density + m->share[i] * lobe_density(&m->lobe[i], v, l);
    return density * m->reflects;
}

// Returns a point of the unit disc.
LANE_FN vec3 disc_point(num u, num v)
{
    num radius = square_root(u);
    return vec3_of(radius * cosine_of_turns(v), radius * cosine_of_turns(v + 0.75f), num_of(0.0f));
}

// Returns a direction of the lobe that `choice` selects. `at` is a point of the unit disc.
LANE_FN vec3 mixture_direction(const struct lobe_mixture *m, vec3 v, num choice, vec3 at)
{
    vec3 l = direction_by_lobe(&m->lobe[0], v, at.x, at.y);
    num before = m->share[0];
    for (int i = 1; i < m->count; i++) {
        l = pick3(choice < before, l, direction_by_lobe(&m->lobe[i], v, at.x, at.y));
        before = before + m->share[i];
    }
    return l;
}

// Returns light from l that was sampled with a density. `density` contains the factor pi.
LANE_FN light_sample sample_of(vec3 l, num density)
{
    return (light_sample){
        .l = l, .attenuation = pick(density > 0.0f, 1.0f / density, num_of(0.0f)), .spot = num_of(1.0f)};
}

// Returns the diffuse and the specular light towards the eye that arrives from t.l.
LANE_FN terms lit_terms(const struct lit_point *p, vec3 diffuse, vec3 specular, light_sample t)
{
    light_source light = {.diffuse = mul3(p->base.kd, diffuse), .specular = mul3(p->ks, specular)};
    terms sum = reflected_terms(&p->base, light, t);
    sum.diffuse = mul3(scale3(sum.diffuse, p->matt), p->diffuse);
    sum.specular = pick3(present(p->base.s.v), mul3(sum.specular, p->specular), black3());
    return sum;
}

#include "path_sources.inc"

// --- surfaces that light passes through

// Returns the direction of light that passes through the surface at a microfacet with the normal h, or that the inside
// of a volume reflects. `chance` decides between the two.
LANE_FN vec3 passing_direction(const struct lit_point *p, vec3 h, num chance, mask *returned)
{
    surface s = p->base.s;
    num c = positive(cosine(dot3(s.v, h)));
    *returned = num_of(0.0f) > 1.0f;
    if (p->inside) {
        num beyond = 1.0f - p->ior * p->ior * (1.0f - c * c), out = square_root(positive(beyond));
        num f = largest3(layered_dielectric(p->base.layered, out, fifth_power(1.0f - out), p->base.layers));
        *returned = either(beyond <= 0.0f, chance < f);
        vec3 refracted = sub3(scale3(h, p->ior * c - out), scale3(s.v, p->ior));
        return unit3(pick3(*returned, mirror3(s.v, h), refracted));
    }
    if (p->volume)
        return refracted3(s.v, h, max_of(p->ior, num_of(1.0f)));
    vec3 across = mirror3(s.v, h);
    return unit3(sub3(across, scale3(s.n, 2.0f * dot3(across, s.n))));
}

// --- the next ray

struct next_ray {
    vec3 l, factor;                 // the direction, and the factor of the light from there
    num density;                    // pi times the density; 0 if it has none
    mask passes, mirrored, counted; // the kind of the event; counted: it is one of the reflections
};

LANE_FN struct next_ray next_ray_of(const struct lit_point *p, const struct lobe_mixture *m, const struct numbers *n)
{
    surface s = p->base.s;
    num event = num_load(n->u[CHOOSE_EVENT]), choice = num_load(n->v[CHOOSE_EVENT]);
    vec3 at = disc_point(num_load(n->u[CHOOSE_DIRECTION]), num_load(n->v[CHOOSE_DIRECTION]));
    struct next_ray r;
    vec3 white = grey3(num_of(1.0f));
    r.l = mixture_direction(m, s.v, choice, at);
    r.density = mixture_density(m, s.v, r.l);
    r.factor = sum_terms(lit_terms(p, white, white, sample_of(r.l, r.density)));
    r.passes = event < m->passes;
    r.mirrored = both(negate(r.passes), event < m->passes + m->mirrors);
    mask returned = r.passes;
    if (any_lane(r.passes)) {
        const struct sampled_lobe *facets = &m->lobe[0];
        vec3 h = seen_facet(facets->facets, at.x, at.y);
        vec3 l = passing_direction(p, from_lobe_axes(facets, h.x, h.y, h.z), choice, &returned);
        r.l = pick3(r.passes, l, r.l);
        r.factor = pick3(r.passes, p->inside ? white : scale3(p->through, 1.0f / m->passes), r.factor);
    }
    if (any_lane(r.mirrored)) {
        r.l = pick3(r.mirrored, mirror3(s.v, s.n), r.l);
        r.factor = pick3(r.mirrored, scale3(p->mirrored, 1.0f / m->mirrors), r.factor);
    }
    r.density = pick(either(r.passes, r.mirrored), num_of(0.0f), r.density);
    r.counted = negate(r.passes);
    r.passes = both(r.passes, negate(p->inside ? returned : num_of(0.0f) > 1.0f));
    return r;
}

// --- scatter

// Adds the light that the surfaces emit, and ends paths that have no reflection left. Returns the remaining lanes.
static unsigned add_emission(const struct path_frame *f, struct path_stream *stream, const struct lit_point *p,
                             const uint32_t *paths, int left)
{
    _Alignas(64) float emission[3][LANES], absorbed[3][LANES], length[LANES];
    unsigned alive = 0;
    store_vector(emission, p->emission);
    for (int i = 0; i < LANES; i++)
        length[i] = p->inside && i < left ? stream->path[paths[i]].distance : 0;
    vec3 darker = scale3(p->absorbed, num_load(length));
    store_vector(absorbed, vec3_of(exp2_of(darker.x), exp2_of(darker.y), exp2_of(darker.z)));
    for (int i = 0; i < LANES && i < left; i++) {
        struct path *path = &stream->path[paths[i]];
        for (int c = 0; c < 3; c++) {
            path->through[c] *= p->inside ? absorbed[c][i] : 1;
            path->light[c] += path->through[c] * (emission[c][i] * path->emission_share);
        }
        path->alive = !p->unlit && path->bounces < f->bounces && path->events < EVENTS_MAX;
        alive |= (unsigned)path->alive << i;
    }
    return alive;
}

// Ends dim paths at random; the others become brighter, so that the mean stays the same.
static bool survives(struct path *path, float chance)
{
    float most = path->through[0] > path->through[1] ? path->through[0] : path->through[1];
    most = most > path->through[2] ? most : path->through[2];
    if (!(most > 0) || !(most <= 3e38f))
        return false;
    if (path->events < ROULETTE_FROM || most >= ROULETTE_MOST)
        return true;
    for (int c = 0; c < 3; c++)
        path->through[c] /= most;
    return chance < most;
}

// Sends the paths of `alive` along their next rays.
static void send(const struct scattering *at, const struct next_ray *next, mask straight, unsigned alive)
{
    const struct ray_starts *starts = at->starts;
    _Alignas(64) float l[3][LANES], factor[3][LANES], density[LANES];
    unsigned passes = mask_bits(next->passes), mirrored = mask_bits(next->mirrored), counted = mask_bits(next->counted),
             glass_tints = mask_bits(straight);
    store_vector(l, next->l);
    store_vector(factor, next->factor);
    num_store(density, next->density);
    for (unsigned rest = alive; rest; rest &= rest - 1) {
        int i = __builtin_ctz(rest);
        struct path *path = &at->stream->path[at->paths[i]];
        struct path_ray *ray = &at->stream->ray[at->paths[i]];
        const bool through = passes >> i & 1;
        for (int c = 0; c < 3; c++) {
            path->through[c] *= factor[c][i];
            path->toward[c] = l[c][i];
            ray->point[c] = starts->point[c][at->at + i];
            ray->origin[c] = through ? ray->point[c] : starts->origin[c][at->at + i];
            const double *m = at->frame->frame->eye_to_world[c];
            ray->direction[c] = (m[0] * (double)l[0][i] + m[1] * (double)l[1][i]) + m[2] * (double)l[2][i];
        }
        ray->own = starts->own[at->at + i];
        ray->end = (double)__builtin_inff();
        path->straight = ray->straight = glass_tints >> i & 1;
        path->mirrored = mirrored >> i & 1;
        path->density = density[i];
        path->bounces = (uint16_t)(path->bounces + (counted >> i & 1));
        path->events++;
        ray->seed = path_hash(path->seed ^ path_hash(path->number * 0x9e3779b9u + path->events));
        path->alive = survives(path, at->numbers.v[CHOOSE_SOURCE][i]);
    }
}

static void scatter(const struct path_frame *f, struct path_stream *stream, const struct lit_point *p,
                    const struct ray_starts *starts, int at, const uint32_t *paths, int left)
{
    struct scattering s; // large, so it is not cleared
    unsigned alive = add_emission(f, stream, p, paths, left), glass_tints = 0;
    if (!alive)
        return;
    s.frame = f;
    s.stream = stream;
    s.point = p;
    s.starts = starts;
    s.at = at;
    s.paths = paths;
    for (int i = 0; i < LANES; i++) {
        const struct path *path = &stream->path[paths[i < left ? i : 0]];
        for (uint32_t k = 0; k < DECISIONS; k++)
            path_numbers(path->seed, path->number, DECISIONS * path->events + k, &s.numbers.u[k][i],
                         &s.numbers.v[k][i]);
        glass_tints |= (unsigned)path->straight << i;
    }
    mask straight = mask_of_bits(glass_tints);
    s.lobes = mixture_of(p, straight);
    straight = f->caustics ? mask_of_bits(0) : either(straight, negate(s.lobes.sharp));
    if (!p->inside)
        seek_sources(&s, mask_bits(straight), alive);
    struct next_ray next = next_ray_of(p, &s.lobes, &s.numbers);
    straight = both(straight, negate(either(next.passes, num_of(p->inside ? 1.0f : 0.0f) > 0.5f)));
    send(&s, &next, straight, alive);
}

// --- the integral of the environment's light

// Returns the position of `choice` within the share of its lobe, from 0 to 1.
LANE_FN num mixture_rest(const struct lobe_mixture *m, num choice)
{
    num before = num_of(0.0f), rest = before;
    for (int i = 0; i < m->count; i++) {
        rest = pick(choice < before, rest, (choice - before) / max_of(m->share[i], num_of(1.0e-9f)));
        before = before + m->share[i];
    }
    return min_of(rest, num_of(1.0f));
}

// Adds light from l, weighted by the balance heuristic: `lobes` directions follow the lobes, and pi times the density of
// the other directions is `others`. (Not inlined: it stands twice in a loop, and pages download it.)
static __attribute__((noinline)) void add_from(const struct lit_point *p, const struct lobe_mixture *m, float lobes,
                                               const vec3 *l, const vec3 *light, const num *others, returned_light *sum)
{
    const num density = lobes * mixture_density(m, p->base.s.v, *l) + *others;
    const terms t = lit_terms(p, *light, *light, sample_of(*l, density));
    sum->diffuse = add3(sum->diffuse, t.diffuse);
    sum->specular = add3(sum->specular, t.specular);
}

enum { INTEGRAL_PART = 32 }; // pairs of directions per partial sum, which keeps rounding errors below 1e-6

static void integrate(const struct environment_view *view, const struct environment_lookups *lookups,
                      const struct lit_point *p, int count, returned_light *out)
{
    const struct environment_samples *samples = view->samples;
    const struct lobe_mixture m = mixture_of(p, mask_of_bits(0));
    const returned_light none = {black3(), black3()};
    const float lights = PI_F * (float)samples->light_count, lobes = (float)count;
    returned_light part = *out = none;
    for (int i = 0; i < count; i++) {
        // The directions of each lobe are consecutive points of a Hammersley set.
        _Alignas(64) float rows[3][LANES], density[LANES];
        float *const each[3] = {rows[0], rows[1], rows[2]};
        num choice = num_of(((float)i + 0.5f) / lobes), turn = num_of(unit_number(reversed_bits((uint32_t)i)));
        vec3 l = mixture_direction(&m, p->base.s.v, choice, disc_point(mixture_rest(&m, choice), turn));
        store_vector(rows, l);
        lookups->densities(view, each, LANES, density);
        lookups->colors(view, each, LANES, each);
        vec3 light = load_vector(rows);
        num others = lights * num_load(density);
        add_from(p, &m, lobes, &l, &light, &others, &part);
        if (i < samples->light_count) {
            const struct sampled_light *from = &samples->light[i];
            l = vec3_from(from->direction);
            light = vec3_from(from->color);
            others = num_of(lights * from->density);
            add_from(p, &m, lobes, &l, &light, &others, &part);
        }
        if (i + 1 == count || i % INTEGRAL_PART == INTEGRAL_PART - 1) {
            *out = (returned_light){add3(out->diffuse, part.diffuse), add3(out->specular, part.specular)};
            part = none;
        }
    }
}

const struct path_kernels FOR_ISA(path_kernels) = {scatter, integrate};
