// lights.c: computes the colours of points of one surface: the lights, the environment and the layers of physical
// materials. Lights are evaluated for LANES points at a time, so that materials and lights are the same in every lane.
// This file is compiled once for each instruction set, with LANES and ISA defined (kernels.h). shade.c prepares the
// points.
#include "lighting.h"

#include "group.h"
#include "recorder.h"

#include <stdlib.h>
#include <string.h>

// Converts a light for the lighting equations; the values are the same in every lane.
LANE_FN light_source source_of(const struct frame_light *light, const struct light_products *products)
{
    light_source s;
    s.position = vec3_from(light->position);
    s.direction = vec3_from(light->axis);
    s.constant = num_of(light->attenuation[0]);
    s.linear = num_of(light->attenuation[1]);
    s.quadratic = num_of(light->attenuation[2]);
    s.inverse_range = num_of(light->inverse_range);
    s.cos_cutoff = num_of(light->cos_cutoff);
    s.exponent = num_of(light->exponent);
    s.cos_outer = num_of(light->cos_outer);
    s.inverse_width = num_of(light->inverse_width);
    s.diffuse = vec3_from(products->diffuse);
    s.specular = vec3_from(products->specular);
    return s;
}

LANE_FN lobe_parameters parameters_of(const struct group *g)
{
    return lobe_parameters_of(g->material->given, g->material->shininess);
}

// Returns the Fresnel factor of a physical material at points whose base colour is multiplied by `color`.
LANE_FN fresnel fresnel_at(const struct group *g, surface s, lobe_parameters m, vec3 color)
{
    num gain = g->frame->settings.single_scattering ? num_of(0.0f) : scattering_gain(s, m.roughness);
    return fresnel_of(mul3(vec3_from(g->material->diffuse), color), m.metallic, gain);
}

// Returns the material's parameters for lobes at LANES points.
LANE_FN lobe_parameters parameters_at(const struct group *g, const struct shading_batch *batch, int at)
{
    lobe_parameters m = parameters_of(g);
    if (g->has_map_rows) {
        m.shininess = num_load(batch->power + at);
        m.metallic = num_load(batch->metallic + at);
    }
    if (g->has_map_rows || g->widens)
        m.roughness = num_load(batch->roughness + at);
    return m;
}

// Returns a light after it has passed through coloured surfaces.
LANE_FN light_source tinted_light(light_source light, vec3 tint)
{
    light.diffuse = mul3(light.diffuse, tint);
    light.specular = mul3(light.specular, tint);
    return light;
}

#include "record_lights.inc"

#include "light_loop.inc"

#include "environment_light.inc"

// Returns the terms of LANES points of one surface before lights are added. The terms already include the hemisphere
// lights.
LANE_FN terms terms_before(const struct group *g, surface s)
{
    const struct material_products *m = g->material;
    terms sum = start_terms(vec3_from(m->ambient), vec3_from(m->emission));
    for (int i = 0; i < g->frame->hemisphere_count; i++) {
        hemisphere h = {vec3_from(g->frame->hemispheres[i].up), vec3_from(m->sky[i]), vec3_from(m->ground[i])};
        sum = add_hemisphere(sum, s, h);
        RECORD(record_hemisphere(g, i, s, h));
    }
    return sum;
}

// Completes the terms after the lights are added: applies the environment and the vertex colours.
LANE_FN terms terms_after(const struct group *g, surface s, terms sum, struct shading_batch *batch, int at)
{
    const struct material_products *m = g->material;
    if (m->mirrors)
        sum = add_environment(sum, vec3_from(m->reflectivity), environment_of(g, s));
    RECORD(record_environment(g, s));
    vec3 ambient = mul3(sum.ambient, g->has_map_rows ? load3(batch->ambient_color, at) : load3(batch->color, at));
    sum = tint_terms(sum, load3(batch->color, at));
    sum.ambient = ambient;
    return sum;
}

// Returns the terms after all lights are added. If a map varies the metalness, kd has so far been the value of a
// dielectric (products.c).
LANE_FN terms textured_terms(const struct group *g, struct shading_batch *batch, int at, terms t)
{
    if (g->material->converted || reads_map(g, LAM_MAP_METALLIC))
        t.diffuse = scale3(t.diffuse, 1.0f - num_load(batch->metallic + at));
    t.specular = mul3(t.specular, load3(batch->specular, at));
    t.emission = load3(batch->emission, at);
    t.ambient = scale3(t.ambient, num_load(batch->occlusion + at));
    return t;
}

#include "output_values.inc"

// Stores the colours of points, computed from the terms that the output shows. For a vertex, it stores the terms that a
// diffuse map multiplies, and separately all other terms.
LANE_FN void store_terms(const struct group *g, struct shading_batch *batch, int at, terms t)
{
    vec3 shown = output_terms(g, t);
    RECORD(record_terms(g, t, shown));
    store3(batch->color, at, shown);
    if (!g->separate_texture_terms)
        return;
    terms matte = {t.ambient, t.diffuse, black3(), black3(), black3()};
    terms rest = {black3(), black3(), t.specular, t.emission, t.reflection};
    if (g->maps_emission)
        rest.emission = black3();
    store3(batch->color, at, output_terms(g, matte));
    store3(batch->rest, at, output_terms(g, rest));
}

#include "layered.inc"
#include "path_points.inc"

// Shades unlit points: the vertices' colours times the material's colour.
static void shade_unlit(const struct group *g, struct shading_batch *batch, int count)
{
    for (int i = 0; i < count; i += LANES) {
        vec3 color = load3(batch->color, i);
        RECORD(record_surface(g, load_surface(batch, i), color, unoccluded_share(g, batch, i)));
        store_terms(g, batch, i, tint_terms(unlit_terms(vec3_from(g->material->diffuse)), color));
    }
}

// `model` is a constant after inlining.
LANE_FN void shade_light_batch(const struct group *g, struct shading_batch *batch, int first, int count, int model)
{
    struct light_batch *lit = &batch->lit; // not on the stack, which may be small in a caller's thread
    for (int i = 0; i < count; i += LANES) {
        surface s = load_surface(batch, first + i);
        RECORD(record_surface(g, s, load3(batch->color, first + i), unoccluded_share(g, batch, first + i)));
        store3(lit->ambient, i, terms_before(g, s).ambient);
        store3(lit->diffuse, i, black3());
        store3(lit->specular, i, black3());
        if (lobe_properties(model) & LOBE_MICROFACET) {
            fresnel f = fresnel_at(g, s, parameters_at(g, batch, first + i), load3(batch->color, first + i));
            store3(lit->f0, i, f.f0);
            store3(lit->rest, i, f.rest);
        }
    }
    add_lights(g, batch, first, count, lit, model);
    RECORD(record_lights(g, batch, first, model));
    const bool around = g->shade->environment_light || g->shade->reference;
    if (lobe_properties(model) & LOBE_MICROFACET && g->shade->environment_light)
        find_surroundings(g, batch, first, count);
    for (int i = 0; i < count; i += LANES) {
        surface s = load_surface(batch, first + i);
        vec3 specular = pick3(present(s.v), load3(lit->specular, i), black3()); // see add_diffuse
        terms t = {load3(lit->ambient, i), load3(lit->diffuse, i), specular, vec3_from(g->material->emission),
                   black3()};
        if (g->has_map_rows)
            t = textured_terms(g, batch, first + i, t);
        if (g->occlusion)
            t.ambient = scale3(t.ambient, num_load(batch->unoccluded + first + i));
        t = terms_after(g, s, t, batch, first + i);
        if (lobe_properties(model) & LOBE_MICROFACET && around)
            t = add_environment_light(g, batch, first, i, s, t);
        store_terms(g, batch, first + i, t);
    }
}

LANE_FN void shade_with_model(const struct group *g, struct shading_batch *batch, int count, int model)
{
    for (int first = 0; first < count; first += LIGHT_BATCH)
        shade_light_batch(g, batch, first, count - first < LIGHT_BATCH ? count - first : LIGHT_BATCH, model);
}

// Replaces the batch's vertex colours with the shaded colours.
static void shade_surface(const struct group *g, struct shading_batch *batch, int count)
{
    if (output_kind(g->frame->settings.output) == OUTPUT_VECTOR) {
        for (int i = 0; i < count; i += LANES)
            store3(batch->color, i, output_vector(g, load_surface(batch, i)));
        return;
    }
    if (output_kind(g->frame->settings.output) == OUTPUT_MATERIAL) {
        for (int i = 0; i < count; i += LANES)
            store3(batch->color, i, output_material(g, batch, i));
        return;
    }
    if (g->material->layers && lobe_properties((int)g->reflection) & LOBE_MICROFACET) {
        shade_layered(g, batch, count);
        return;
    }
    switch (g->reflection) {
#define LOBE(NAME, ...)                                                                                                \
    case LAM_REFLECTION_##NAME:                                                                                        \
        shade_with_model(g, batch, count, LAM_REFLECTION_##NAME);                                                      \
        break;
        LOBES(LOBE)
#undef LOBE
    default:
        shade_unlit(g, batch, count);
        break;
    }
}

LANE_FN num luminance(vec3 c) { return dot3(vec3_of(num_of(0.2126f), num_of(0.7152f), num_of(0.0722f)), c); }

// Shades the ground that catches shadows. The colour of the ground is black, and its alpha is the blocked fraction of
// the light.
static void shade_catcher(const struct group *g, struct shading_batch *batch, int count)
{
    _Alignas(64) float received[BATCH_ROW];
    struct group open = *g; // without shadows
    open.hierarchy = NULL;
    open.occlusion = false;
    open.recorder = NULL;
    shade_surface(g, batch, count);
    for (int i = 0; i < count; i += LANES) {
        num_store(received + i, luminance(load3(batch->color, i)));
        store3(batch->color, i, vec3_of(num_of(1.0f), num_of(1.0f), num_of(1.0f)));
    }
    shade_surface(&open, batch, count);
    for (int i = 0; i < count; i += LANES) {
        num arrives = num_load(received + i), all = luminance(load3(batch->color, i));
        RECORD(record_catcher(g, arrives, all));
        num share = pick(all > arrives, 1.0f - arrives / all, num_of(0.0f));
        num_store(batch->alpha + i, num_load(batch->alpha + i) * share);
        store3(batch->color, i, black3());
    }
}

#ifdef RECORDING
// Gets the values that drawing has found, because a fragment's neighbours are not shaded again.
void FOR_ISA(find_shadows)(const struct group *g, struct shading_batch *batch, int count)
{
    struct shadow_rows *rows = g->shading->shadows;
    rows->count = 0;
    for (const struct recorded_shadow *s = g->shade->recorder->shadows; s && count; s = s->next) {
        if (s->triangle != g->first_id + batch->triangle[0])
            continue;
        rows->light[rows->count] = s->light;
        rows->weight[rows->count][0] = 1;
        for (int c = 0; c < 3; c++)
            rows->passed[rows->count][c][0] = s->passed[c];
        rows->count++;
    }
}
#else
// Stores the light that reaches the fragments of the explained pixel.
static void keep_shadows(const struct group *g, const struct shading_batch *batch, int count)
{
    struct recorder *recorder = g->shade->recorder;
    const struct shadow_rows *rows = g->shading->shadows;
    for (int i = 0; i < count * rows->count; i++) {
        int at = i / rows->count, k = i % rows->count;
        if ((int)batch->x[at] != recorder->out->x || (int)batch->y[at] != recorder->out->y || !rows->weight[k][at])
            continue;
        struct recorded_shadow *s = recorder_alloc(recorder, 1, sizeof *s);
        if (!s)
            return;
        *s = (struct recorded_shadow){recorder->shadows, g->first_id + batch->triangle[at], rows->light[k], {0}};
        for (int c = 0; c < (g->frame->tints_rays ? 3 : 1); c++)
            s->passed[c] = rows->passed[k][c][at];
        recorder->shadows = s;
    }
}

// Finds the cosine of the angle between each fragment's normal and the light, times 255. The result is 0 if the light
// cannot reach the fragment. Layers and hairs also reflect light that arrives from behind.
static void weigh_light(const struct group *g, struct shading_batch *batch, int count, const struct frame_light *light,
                        uint8_t *weights)
{
    static const struct light_products none = {0};
    bool both_sides = g->material->layers || lobe_properties((int)g->reflection) & LOBE_TANGENT;
    for (int at = 0; at < count; at += LANES) {
        light_sample t = toward_light(load3(batch->p, at), source_of(light, &none), light->kind, light->falloff);
        num cosine = both_sides ? num_of(1.0f) : dot3(load3(batch->n, at), t.l);
        mask lit = both(both(t.attenuation * t.spot > 0.0f, cosine > 0.0f), lane_numbers() < count - at);
        inum weight = ipick(lit, int_of(min_of(cosine, num_of(1.0f)) * 254.0f) + 1, inum_of(0));
        for (int k = 0; k < LANES; k++)
            weights[at + k] = (uint8_t)ilane(weight, k);
    }
}

void FOR_ISA(find_shadows)(const struct group *g, struct shading_batch *batch, int count)
{
    struct shadow_rows *rows = g->shading->shadows;
    struct light_rays rays = light_rays_of(g);
    rows->count = 0;
    if (g->shade->light_pattern->all.count <= LIGHT_PROBES)
        return;
    for (int i = 0, all = g->lights ? g->lights->count : g->frame->light_count; i < all; i++) {
        const struct frame_light *light = &g->frame->lights[g->lights ? g->lights->numbers[i] : (uint32_t)i];
        if (!light->casts_shadows || !(light->radius > 0))
            continue;
        if (rows->count == SHADOW_LIGHTS || !work_continues(g->shading->work))
            break;
        uint8_t *weights = rows->weight[rows->count];
        weigh_light(g, batch, count, light, weights);
        g->shade->ray_kernels->pass_pixels(&rays, g->shading->starts,
                                           &(struct ray_pixels){count, batch->x, batch->y, weights, &rows->scratch},
                                           light, rows->passed[rows->count]);
        rows->light[rows->count++] = light;
    }
    g->shading->rays += rays.sent;
    if (g->shade->recorder)
        keep_shadows(g, batch, count);
}
#endif

void FOR_ISA(light_points)(const struct group *g, struct shading_batch *batch, int count)
{
    if (g->catches)
        shade_catcher(g, batch, count);
    else
        shade_surface(g, batch, count);
}
