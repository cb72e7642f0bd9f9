// paths.c: lists the sources of light of a frame, and advances streams of paths.
#include "paths.h"

#include "cpu_features.h"
#include "layer_kinds.h"
#include "linear.h"
#include "path_numbers.h"
#include "path_tree.h"

#include <stdlib.h>
#include <string.h>

CPU_VERSIONS(const struct path_kernels, path_kernels);

const struct path_kernels *path_kernels_of(int lanes) { return CPU_WIDEST_OF_ALL(lanes, path_kernels); }

// --- the sources of light

// The environment is sampled in fixed directions, which each pixel visits in its own order.
enum { ENVIRONMENT_DIRECTIONS = 1 << 15 };

// A kind of source has at least this share of the rays, so that a wrong estimate costs little.
#define SHARE_LEAST 0.1

// The tree has directional lights at this distance, in the hierarchy's space, in which the scene has about the size 1.
#define DIRECTIONAL_AT 1024

static double luminance(const float c[3])
{
    return (0.2126 * (double)c[0] + 0.7152 * (double)c[1]) + 0.0722 * (double)c[2];
}

// Returns the light of a source at the scene's middle, or at a distance of the scene's size if the source is nearer.
static double light_power(const struct path_frame *f, const struct frame_light *light)
{
    double power =
        luminance(light->diffuse) > luminance(light->specular) ? luminance(light->diffuse) : luminance(light->specular);
    double square = 0, size = 0.5 / f->hierarchy->scale;
    if (light->kind == LIGHT_DIRECTIONAL)
        return power;
    for (int c = 0; c < 3; c++) {
        double d = light->world_position[c] - f->hierarchy->centre[c];
        square += d * d;
    }
    double distance = square > size * size ? math_sqrt(square) : size;
    double sum = (double)light->attenuation[0] +
                 ((double)light->attenuation[1] + (double)light->attenuation[2] * distance) * distance;
    return sum > 0 ? power / sum : power;
}

// Lists the lights. Returns the power of all of them.
static double set_lights(struct path_frame *f, uint64_t *keys)
{
    const struct frame *frame = f->frame;
    const double scale = f->hierarchy->scale;
    double total = 0;
    for (int i = 0; i < frame->light_count; i++) {
        const struct frame_light *light = &frame->lights[i];
        const double power = light_power(f, light), matt = luminance(light->diffuse),
                     shine = luminance(light->specular);
        double at[3];
        struct path_node *node = &f->lights.nodes[i];
        *node = (struct path_node){.power = power > 0 ? (float)(matt > shine ? matt : shine) : 0};
        ray_point(f->hierarchy, light->world_position, at);
        for (int c = 0; c < 3; c++) {
            at[c] = light->kind == LIGHT_DIRECTIONAL ? -DIRECTIONAL_AT * light->world_axis[c] : at[c];
            node->low[c] = (float)(at[c] - light->radius * scale);
            node->high[c] = (float)(at[c] + light->radius * scale);
            node->axis[c] = (float)light->world_axis[c];
        }
        node->is_sun = light->kind == LIGHT_DIRECTIONAL;
        if (light->kind == LIGHT_SPOT_CUTOFF || light->kind == LIGHT_SPOT_CONES) {
            node->cosine = light->kind == LIGHT_SPOT_CONES ? light->cos_outer : light->cos_cutoff;
            node->sine = (float)math_sqrt(1 - (double)node->cosine * (double)node->cosine);
        }
        const double range =
            light->inverse_range > 0 ? 1.001 * scale / (double)light->inverse_range : (double)__builtin_inff();
        node->reach = (float)(range * range);
        node->attenuation[0] = light->attenuation[0];
        node->attenuation[1] = (float)((double)light->attenuation[1] / scale);
        node->attenuation[2] = (float)((double)light->attenuation[2] / (scale * scale));
        total += power;
    }
    path_tree_make(&f->lights, keys);
    return total;
}

static const lam_material *side_material(const struct frame *frame, int range, bool back)
{
    const struct frame_draw_range *r = &frame->ranges[range];
    return frame->materials[back && !frame->draws[r->draw].one_sided ? r->back : r->front];
}

// Returns the luminance of a side that rays may aim at: its emission is the same at all points and in all directions.
static double aimed_emission(const struct frame *frame, int range, bool back)
{
    const lam_material *m = side_material(frame, range, back);
    const struct frame_draw_range *r = &frame->ranges[range];
    if (m->maps[LAM_MAP_EMISSION] || r->passes_rays || r->reflection == LAM_REFLECTION_NONE ||
        !frame_draw_casts(&frame->draws[r->draw]) || frame_layers(frame, m) & LAYER_CLEARCOAT)
        return 0;
    const float emission[3] = {m->emission.r, m->emission.g, m->emission.b};
    return luminance(emission);
}

// Lists the emitting triangles; without a list, only counts them. Returns their power.
static double set_emitters(struct path_frame *f, uint32_t *list, uint32_t *first, uint64_t *keys)
{
    const struct frame *frame = f->frame;
    struct path_tree *tree = &f->emitters;
    double total = 0;
    tree->count = 0;
    for (int r = 0; r < frame->range_count; r++) {
        const struct frame_draw_range *range = &frame->ranges[r];
        double each = aimed_emission(frame, r, false) + aimed_emission(frame, r, true);
        if (list)
            first[r] = tree->count;
        if (!list && each > 0)
            tree->count += range->count;
        for (uint32_t i = 0; list && i < range->count && each > 0; i++) {
            struct ray_triangle t;
            hierarchy_triangle(f->hierarchy, range->first_id + i, &t);
            double power = each * path_triangle_area(&t);
            struct path_node *node = &tree->nodes[tree->count];
            *node = (struct path_node){
                .power = power < 1e38 ? (float)power : 0, .attenuation = {0, 0, 1}, .reach = __builtin_inff()};
            for (int c = 0; c < 3; c++) {
                double low = t.p[0][c] < t.p[1][c] ? t.p[0][c] : t.p[1][c], high = t.p[0][c] + t.p[1][c] - low;
                node->low[c] = (float)(t.p[2][c] < low ? t.p[2][c] : low);
                node->high[c] = (float)(t.p[2][c] > high ? t.p[2][c] : high);
            }
            total += (double)node->power;
            list[tree->count++] = range->first_id + i;
        }
    }
    if (list)
        path_tree_make(tree, keys);
    return total;
}

// Sets, for each range and side, whether it emits, and whether rays aim at it.
static void set_sides(const struct path_frame *f, bool *aimed, bool *emits)
{
    const struct frame *frame = f->frame;
    for (int side = 0; side < 2 * frame->range_count; side++) {
        const lam_material *m = side_material(frame, side / 2, side % 2);
        emits[side] = frame->ranges[side / 2].reflection == LAM_REFLECTION_NONE || m->emission.r > 0 ||
                      m->emission.g > 0 || m->emission.b > 0;
        aimed[side] = aimed_emission(frame, side / 2, side % 2) > 0;
    }
}

// Returns the mean luminance of the environment.
static double environment_power(const struct environment_samples *samples)
{
    double sum = 0;
    for (int i = 0; i < samples->light_count; i++)
        if (samples->light[i].density > 0)
            sum += luminance(samples->light[i].color) / (double)samples->light[i].density;
    return samples->light_count ? sum / samples->light_count / (4 * PI) : 0;
}

// Returns the bytes of a tree, and moves its arrays to `at` unless that is NULL.
static size_t place_tree(struct path_tree *t, char *at)
{
    for (t->leaves = 1; t->leaves < t->count;)
        t->leaves *= 2;
    const size_t nodes = 2 * (size_t)t->leaves * sizeof *t->nodes, items = t->leaves * sizeof *t->item;
    if (at) {
        t->nodes = (struct path_node *)at;
        t->item = (uint32_t *)(at + nodes);
        t->leaf = (uint32_t *)(at + nodes + items);
    }
    return nodes + items + t->count * sizeof *t->leaf;
}

bool path_frame_make(struct path_frame *f, struct call_control *call, lam_error *error)
{
    const struct frame *frame = f->frame;
    const size_t ranges = (size_t)frame->range_count, sides = 2 * ranges;
    double power[SOURCE_KINDS] = {0}, sum = 0;
    f->environment = (struct environment_view){frame->environment, frame->to_environment, NULL, &f->samples};
    f->samples.light_count = 0;
    f->bounces = frame->path_bounces;
    f->caustics = frame->settings.caustics;
    if (frame->environment_lights && !environment_samples_make(&f->samples, frame->environment, frame->to_environment,
                                                               ENVIRONMENT_DIRECTIONS, &f->sample_storage, call, error))
        return false;
    set_emitters(f, NULL, NULL, NULL);
    f->lights.count = (uint32_t)frame->light_count;
    size_t lights = place_tree(&f->lights, NULL), emitters = place_tree(&f->emitters, NULL);
    const size_t most = f->lights.count > f->emitters.count ? f->lights.count : f->emitters.count;
    if (!buffer_reserve(&f->storage,
                        most * sizeof(uint64_t) + lights + emitters + (f->emitters.count + ranges) * sizeof(uint32_t) +
                            2 * sides * sizeof(bool),
                        call, error))
        return false;
    uint64_t *keys = f->storage.data;
    char *trees = (char *)(keys + most);
    place_tree(&f->lights, trees);
    place_tree(&f->emitters, trees + lights);
    uint32_t *emitter = (uint32_t *)(trees + lights + emitters), *first = emitter + f->emitters.count;
    bool *aimed = (bool *)(first + ranges), *emits = aimed + sides;
    power[SOURCE_LIGHT] = set_lights(f, keys);
    power[SOURCE_ENVIRONMENT] = environment_power(&f->samples);
    power[SOURCE_EMITTER] = set_emitters(f, emitter, first, keys) / PI;
    set_sides(f, aimed, emits);
    f->emitter = emitter;
    f->first_emitter = first;
    f->aimed = aimed;
    f->emits = emits;
    f->finds = frame->environment || frame->hemisphere_count;
    for (int c = 0; c < 3; c++)
        f->finds |= frame->ambient[c] > 0;
    for (size_t i = 0; i < sides; i++)
        f->finds |= emits[i];
    for (int kind = 0; kind < SOURCE_KINDS; kind++)
        sum += power[kind];
    int present = 0;
    for (int kind = 0; kind < SOURCE_KINDS; kind++)
        present += power[kind] > 0;
    for (int kind = 0; kind < SOURCE_KINDS; kind++)
        f->share[kind] = power[kind] > 0 ? (float)(SHARE_LEAST + (1 - SHARE_LEAST * present) * (power[kind] / sum)) : 0;
    if (present == 1)
        for (int kind = 0; kind < SOURCE_KINDS; kind++)
            f->share[kind] = power[kind] > 0; // exactly 1
    return true;
}

uint64_t path_frame_bytes(const struct path_frame *f) { return f->storage.capacity + f->sample_storage.capacity; }

void path_frame_free(struct path_frame *f)
{
    buffer_free(&f->storage);
    buffer_free(&f->sample_storage);
}

// --- streams

void path_start(struct path *path, float x, float y, uint32_t number)
{
    uint32_t seed = path_hash(path_hash((uint32_t)x + 1) ^ (uint32_t)y * 0x9e3779b9u);
    *path = (struct path){.through = {1, 1, 1}, .emission_share = 1, .seed = seed, .number = number};
}

static void add_light(struct path *path, const float light[3], float share)
{
    for (int c = 0; c < 3; c++)
        path->light[c] += path->through[c] * (light[c] * share);
}

static void add_sources(const struct path_frame *f, struct path_stream *s, struct light_rays *rays)
{
    f->ray_kernels->pass_along(rays, s->shadow_ray, s->shadow_count, s->passed);
    for (int i = 0; i < s->shadow_count; i++)
        for (int c = 0; c < 3; c++)
            if (s->passed[i][c] > 0)
                s->path[s->shadow[i].path].light[c] += s->shadow[i].light[c] * s->passed[i][c];
    s->shadow_count = 0;
}

// Returns the light of the sky: ambient and hemisphere lights are light from all around.
static void sky_light(const struct frame *frame, const float toward[3], float out[3])
{
    memcpy(out, frame->ambient, 3 * sizeof *out);
    for (int i = 0; i < frame->hemisphere_count; i++) {
        const struct frame_hemisphere *h = &frame->hemispheres[i];
        bool up = (toward[0] * h->up[0] + toward[1] * h->up[1]) + toward[2] * h->up[2] > 0;
        for (int c = 0; c < 3; c++)
            out[c] += up ? h->sky[c] : h->ground[c];
    }
}

// Adds the light of the environment and the sky to `count` paths that meet nothing.
static void add_surroundings(const struct path_frame *f, struct path_stream *s, const uint32_t *paths, int count)
{
    const struct frame *frame = f->frame;
    float *const toward[3] = {s->rows[0], s->rows[1], s->rows[2]}, *const color[3] = {s->color[0], s->color[1],
                                                                                      s->color[2]};
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            toward[c][i] = s->path[paths[i]].toward[c];
    for (int c = 0; c < 3; c++)
        for (int i = count; i < count + 16; i++)
            toward[c][i] = 1;
    if (frame->environment)
        f->lookups->colors(&f->environment, toward, count, color);
    if (f->share[SOURCE_ENVIRONMENT] > 0)
        f->lookups->densities(&f->environment, toward, count, s->rows[3]);
    for (int i = 0; i < count; i++) {
        struct path *path = &s->path[paths[i]];
        float light[3], share = 1;
        if (path->density > 0 && f->share[SOURCE_ENVIRONMENT] > 0)
            share = path->density / (path->density + (float)PI * f->share[SOURCE_ENVIRONMENT] * s->rows[3][i]);
        for (int c = 0; c < 3; c++)
            light[c] = frame->environment ? color[c][i] : 0;
        path->alive = false;
        if (frame->environment_lights || path->mirrored) {
            add_light(path, light, share);
        } else if (path->density <= 0) { // glass shows the picture's background
            add_light(path, frame->glass_background, 1);
            continue;
        }
        sky_light(frame, path->toward, light);
        add_light(path, light, 1);
    }
}

// Returns pi times the density with which the ray's origin would have aimed a ray at the hit of an emitting triangle.
static float aimed_density(const struct path_frame *f, const struct path *path, const struct path_ray *ray,
                           const struct ray_hit *hit)
{
    struct ray_triangle t;
    hierarchy_triangle(f->hierarchy, hit->number, &t);
    const uint32_t number = f->first_emitter[hit->range] + (hit->number - f->frame->ranges[hit->range].first_id);
    const float share = f->share[SOURCE_EMITTER] * tree_share(&f->emitters, number, ray->origin, path->normal);
    return (float)(PI * (double)share / path_triangle_area(&t)) * hit->area_per_angle;
}

static int by_key(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

// Traces the rays of living paths. Lists the paths that met a surface in s->order, sorted by range and side, and returns
// their number.
static int find_surfaces(const struct path_frame *f, struct path_stream *s, struct light_rays *rays)
{
    int count = 0, missed = 0, met = 0;
    for (int i = 0; i < s->count; i++) {
        struct path *path = &s->path[i];
        path->alive = path->alive && (f->finds || path->bounces < f->bounces || path->density <= 0);
        if (!path->alive)
            continue;
        s->order[count] = (uint32_t)i;
        s->shadow_ray[count++] = s->ray[i];
    }
    f->ray_kernels->nearest(rays, s->shadow_ray, count, s->found);
    for (int i = 0; i < count; i++) {
        struct path *path = &s->path[s->order[i]];
        const struct ray_hit *hit = &s->found[i];
        for (int c = 0; c < 3; c++)
            path->through[c] *= hit->passed[c];
        if (hit->number == (uint32_t)NO_TRIANGLE) {
            s->group[missed++] = s->order[i];
            continue;
        }
        const uint32_t group = 2 * hit->range + hit->back;
        if (path->bounces >= f->bounces && !f->emits[group]) {
            path->alive = false;
            continue;
        }
        const float aimed = path->density > 0 && f->aimed[group] ? aimed_density(f, path, &s->shadow_ray[i], hit) : 0;
        path->emission_share = aimed > 0 ? path->density / (path->density + aimed) : 1;
        path->distance = hit->distance;
        s->hit[s->order[i]] = *hit;
        s->key[met++] = (uint64_t)group << 32 | s->order[i];
    }
    add_surroundings(f, s, s->group, missed);
    qsort(s->key, (size_t)met, sizeof *s->key, by_key);
    for (int i = 0; i < met; i++) {
        s->order[i] = (uint32_t)s->key[i];
        s->group[i] = (uint32_t)(s->key[i] >> 32);
    }
    return met;
}

bool paths_trace(const struct path_frame *f, struct path_stream *s, struct light_rays *rays,
                 const struct path_shader *shader, struct call_control *call)
{
    for (int met = 1; met;) {
        if (!call_should_continue(call))
            return false;
        add_sources(f, s, rays);
        met = find_surfaces(f, s, rays);
        for (int i = 0, end; i < met; i = end) {
            for (end = i + 1; end < met && s->group[end] == s->group[i];)
                end++;
            shader->shade(shader->user, s, s->group[i], s->order + i, end - i);
        }
        met += s->shadow_count;
    }
    return true;
}
