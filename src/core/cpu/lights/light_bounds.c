// light_bounds.c: sorts a frame's lights by position and stores them in rows.
#include "light_bounds.h"

#include "shade_frame.h"
#include "tile.h"

#include <string.h>

#define INFINITE __builtin_inff()

enum { KEY_BITS = 10, PASS_BITS = 11 };

// The slope of the sRGB curve at black, where the slope is largest. This slope limits how much a small amount of light
// changes a byte.
#define SRGB_SLOPE 12.92f

// The sort key of a light.
struct sort_key {
    uint32_t key, number;
};

// Spreads bits 0…9 to every third bit.
static uint32_t spread_bits(uint32_t x)
{
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

// Quantizes x from the range low…high to 0…1023; NaN becomes 0.
static uint32_t quantize(float x, float low, float high)
{
    float part = (x - low) / (high - low) * (float)((1 << KEY_BITS) - 1);
    return part > 0 ? part < (1 << KEY_BITS) - 1 ? (uint32_t)part : (1 << KEY_BITS) - 1 : 0;
}

static bool has_range(const struct frame_light *light) { return light->falloff == FALLOFF_RANGE; }

// Computes Morton codes, which interleave the bits of the three coordinates. Lights without a range come last.
static void make_keys(const struct frame *frame, struct sort_key *keys)
{
    float low[3], high[3];
    for (int a = 0; a < 3; a++) {
        low[a] = INFINITE, high[a] = -INFINITE;
        for (int i = 0; i < frame->light_count; i++) {
            const struct frame_light *light = &frame->lights[i];
            float x = light->position[a];
            if (light->kind == LIGHT_DIRECTIONAL)
                continue;
            low[a] = x < low[a] ? x : low[a];
            high[a] = x > high[a] ? x : high[a];
        }
    }
    for (int i = 0; i < frame->light_count; i++) {
        const struct frame_light *light = &frame->lights[i];
        uint32_t key = has_range(light) ? 0 : 1u << (3 * KEY_BITS);
        for (int a = 0; a < 3 && light->kind != LIGHT_DIRECTIONAL; a++)
            key |= spread_bits(quantize(light->position[a], low[a], high[a])) << a;
        keys[i] = (struct sort_key){key, (uint32_t)i};
    }
}

// Sorts by key with a stable radix sort, 11 bits at a time, starting with the lowest bits.
static void sort_keys(struct sort_key *keys, struct sort_key *other, int count)
{
    for (int shift = 0; shift < 3 * PASS_BITS; shift += PASS_BITS) {
        uint32_t starts[1 << PASS_BITS] = {0}, sum = 0;
        for (int i = 0; i < count; i++)
            starts[keys[i].key >> shift & ((1 << PASS_BITS) - 1)]++;
        for (int d = 0; d < 1 << PASS_BITS; d++) {
            uint32_t n = starts[d];
            starts[d] = sum;
            sum += n;
        }
        for (int i = 0; i < count; i++)
            other[starts[keys[i].key >> shift & ((1 << PASS_BITS) - 1)]++] = keys[i];
        memcpy(keys, other, (size_t)count * sizeof *keys);
    }
}

static float max_channel(const float v[3])
{
    float max = 0;
    for (int i = 0; i < 3; i++) {
        float size = v[i] < 0 ? -v[i] : v[i];
        max = size > max ? size : max;
    }
    return max;
}

static float min_cosine(const struct frame_light *light)
{
    switch (light->kind) {
    case LIGHT_SPOT_CUTOFF:
        return light->cos_cutoff;
    case LIGHT_SPOT_CONES:
        return light->cos_outer;
    case LIGHT_SPOT_EXPONENT:
        return 0;
    default:
        return -2;
    }
}

// Allocates rows from a block. The size of each row is a multiple of 64 bytes. If `at` is NULL, only the total size is
// computed.
struct rows {
    float *at;
    size_t used;
};

static float *row(struct rows *rows, int count)
{
    float *part = rows->at ? rows->at + rows->used : NULL;
    rows->used += (size_t)count;
    return part;
}

// The writable rows of struct light_bounds, and two rows for sorting.
struct bound_rows {
    uint32_t *number, *all;
    float *position[3], *axis[3], *attenuation[3], *min_cosine, *inverse_range, *max_diffuse, *max_specular;
    int32_t *far;
    float *group_low[3], *group_high[3], *group_reach;
    struct sort_key *keys, *other;
};

static struct bound_rows lay_out_rows(struct rows *rows, int capacity, int group_capacity, int materials)
{
    struct bound_rows w;
    w.number = (uint32_t *)row(rows, capacity);
    w.all = (uint32_t *)row(rows, capacity);
    w.far = (int32_t *)row(rows, capacity);
    for (int a = 0; a < 3; a++) {
        w.position[a] = row(rows, capacity);
        w.axis[a] = row(rows, capacity);
        w.attenuation[a] = row(rows, capacity);
        w.group_low[a] = row(rows, group_capacity);
        w.group_high[a] = row(rows, group_capacity);
    }
    w.min_cosine = row(rows, capacity);
    w.inverse_range = row(rows, capacity);
    w.group_reach = row(rows, group_capacity);
    w.max_diffuse = w.max_specular = NULL;
    for (int m = 0; m < materials; m++) {
        float *diffuse = row(rows, capacity), *specular = row(rows, capacity);
        w.max_diffuse = m ? w.max_diffuse : diffuse;
        w.max_specular = m ? w.max_specular : specular;
    }
    w.keys = (struct sort_key *)(void *)row(rows, 2 * capacity);
    w.other = (struct sort_key *)(void *)row(rows, 2 * capacity);
    return w;
}

static void fill_light(const struct bound_rows *w, int i, const struct frame_light *light, uint32_t number)
{
    w->number[i] = number;
    w->far[i] = light->kind == LIGHT_DIRECTIONAL ? -1 : 0;
    for (int a = 0; a < 3; a++) {
        w->position[a][i] = light->kind == LIGHT_DIRECTIONAL ? -light->axis[a] : light->position[a];
        w->axis[a][i] = light->kind >= LIGHT_SPOT_CUTOFF ? light->axis[a] : 0;
        w->attenuation[a][i] = light->attenuation[a];
    }
    w->min_cosine[i] = min_cosine(light);
    w->inverse_range[i] = light->inverse_range;
}

// Adds a light that reaches no point, because its cone excludes every direction.
static void fill_padding(const struct bound_rows *w, int i)
{
    static const struct frame_light nothing = {.attenuation = {1, 0, 0}};
    fill_light(w, i, &nothing, 0);
    w->min_cosine[i] = 2;
}

static void fill_group(const struct bound_rows *w, int group, int count)
{
    int first = group * LIGHTS_IN_GROUP;
    int end = first + LIGHTS_IN_GROUP < count ? first + LIGHTS_IN_GROUP : count;
    float reach = 0;
    for (int a = 0; a < 3; a++) {
        float low = INFINITE, high = -INFINITE;
        for (int i = first; i < end; i++) {
            low = w->position[a][i] < low ? w->position[a][i] : low;
            high = w->position[a][i] > high ? w->position[a][i] : high;
        }
        w->group_low[a][group] = low;
        w->group_high[a][group] = high;
    }
    for (int i = first; i < end; i++) {
        float range = !w->far[i] && w->inverse_range[i] > 0 ? 1.00001f / w->inverse_range[i] : INFINITE;
        reach = range > reach ? range : reach;
    }
    w->group_reach[group] = reach;
}

static void fill_materials(const struct bound_rows *w, int count, int capacity, const struct frame *frame,
                           const struct material_products *materials)
{
    for (int m = 0; m < frame->material_count; m++) {
        float *diffuse = w->max_diffuse + (size_t)m * 2 * (size_t)capacity;
        float *specular = w->max_specular + (size_t)m * 2 * (size_t)capacity;
        float max_lobe = frame_lobe_max(frame->materials[m]);
        for (int i = 0; i < capacity; i++) {
            diffuse[i] = specular[i] = 0;
            if (i >= count)
                continue;
            const struct light_products *products = &materials[m].lights[w->number[i]];
            diffuse[i] = max_channel(products->diffuse) + (frame->settings.gl1 ? max_channel(products->ambient) : 0);
            specular[i] = max_channel(products->specular) * max_lobe;
        }
    }
}

bool light_bounds_make(struct light_bounds *table, struct buffer *storage, const struct frame *frame,
                       const struct material_products *materials, struct call_control *call, lam_error *error)
{
    int count = frame->light_count;
    int group_count = (count + LIGHTS_IN_GROUP - 1) / LIGHTS_IN_GROUP, capacity = group_count * LIGHTS_IN_GROUP;
    int group_capacity = (group_count + LANES_MAX - 1) / LANES_MAX * LANES_MAX;
    struct rows rows = {0};
    lay_out_rows(&rows, capacity, group_capacity, frame->material_count);
    if (!buffer_reserve(storage, rows.used * sizeof(float), call, error))
        return false;
    rows = (struct rows){.at = storage->data};
    struct bound_rows w = lay_out_rows(&rows, capacity, group_capacity, frame->material_count);
    make_keys(frame, w.keys);
    if (count > LIGHTS_IN_GROUP)
        sort_keys(w.keys, w.other, count);
    for (int i = 0; i < capacity; i++) {
        w.all[i] = (uint32_t)i;
        if (i < count)
            fill_light(&w, i, &frame->lights[w.keys[i].number], w.keys[i].number);
        else
            fill_padding(&w, i);
    }
    for (int g = 0; g < group_capacity; g++) {
        for (int a = 0; a < 3 && g >= group_count; a++)
            w.group_low[a][g] = w.group_high[a][g] = 0;
        w.group_reach[g] = -1;
        if (g < group_count)
            fill_group(&w, g, count);
    }
    fill_materials(&w, count, capacity, frame, materials);
    // Only these three tone curves have a slope above 1.
    lam_tone tone = frame->settings.tone;
    float steep = tone == LAM_TONE_ACES || tone == LAM_TONE_AGX || tone == LAM_TONE_CONTRAST ? 4.0f : 1.0f;
    float slope = steep * (frame->settings.color == LAM_COLOR_RAW ? 1.0f : SRGB_SLOPE) * frame->exposure;
    *table = (struct light_bounds){
        .count = count,
        .capacity = capacity,
        .number = w.number,
        .position = {w.position[0], w.position[1], w.position[2]},
        .far = w.far,
        .axis = {w.axis[0], w.axis[1], w.axis[2]},
        .min_cosine = w.min_cosine,
        .attenuation = {w.attenuation[0], w.attenuation[1], w.attenuation[2]},
        .inverse_range = w.inverse_range,
        .max_diffuse = w.max_diffuse,
        .max_specular = w.max_specular,
        .group_count = group_count,
        .group_capacity = group_capacity,
        .group_low = {w.group_low[0], w.group_low[1], w.group_low[2]},
        .group_high = {w.group_high[0], w.group_high[1], w.group_high[2]},
        .group_reach = w.group_reach,
        .all = w.all,
        .cutoff = count > LIGHTS_ALL_SUMMED ? (slope > 0 ? frame->settings.light_cutoff / slope : 0) : 0};
    return true;
}
