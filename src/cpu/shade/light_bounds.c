// light_bounds.c: a frame's lights put in order of place and laid out in rows.
#include "light_bounds.h"

#include "pipeline.h"

#include <string.h>

#define ENDLESS __builtin_inff()

enum { KEY_BITS = 10, PASS_BITS = 11 };

// The steepest slope of the sRGB curve, at black: what a little light can do to a byte.
#define SRGB_SLOPE 12.92f

// A light's place in the order.
struct place {
    uint32_t key, number;
};

// Bits 0…9 three apart.
static uint32_t spread_bits(uint32_t x)
{
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

// Where x lies in low…high, 0…1023; anything that is no number lies at 0.
static uint32_t step_of(float x, float low, float high)
{
    float part = (x - low) / (high - low) * (float)((1 << KEY_BITS) - 1);
    return part > 0 ? part < (1 << KEY_BITS) - 1 ? (uint32_t)part : (1 << KEY_BITS) - 1 : 0;
}

static bool ends(const struct frame_light *light) { return !light->directional && light->inverse_range > 0; }

// Morton's order: the bits of the three coordinates interleaved. Lights without an end come last.
static void find_places(const struct frame *frame, struct place *places)
{
    float low[3], high[3];
    for (int a = 0; a < 3; a++) {
        low[a] = ENDLESS, high[a] = -ENDLESS;
        for (int i = 0; i < frame->light_count; i++) {
            const struct frame_light *light = &frame->lights[i];
            float x = light->position[a];
            if (light->directional)
                continue;
            low[a] = x < low[a] ? x : low[a];
            high[a] = x > high[a] ? x : high[a];
        }
    }
    for (int i = 0; i < frame->light_count; i++) {
        const struct frame_light *light = &frame->lights[i];
        uint32_t key = ends(light) ? 0 : 1u << (3 * KEY_BITS);
        for (int a = 0; a < 3 && !light->directional; a++)
            key |= spread_bits(step_of(light->position[a], low[a], high[a])) << a;
        places[i] = (struct place){key, (uint32_t)i};
    }
}

// By key, from the lowest 11 bits to the highest; equals stay in the frame's order.
static void sort_places(struct place *places, struct place *other, int count)
{
    for (int shift = 0; shift < 3 * PASS_BITS; shift += PASS_BITS) {
        uint32_t starts[1 << PASS_BITS] = {0}, sum = 0;
        for (int i = 0; i < count; i++)
            starts[places[i].key >> shift & ((1 << PASS_BITS) - 1)]++;
        for (int d = 0; d < 1 << PASS_BITS; d++) {
            uint32_t n = starts[d];
            starts[d] = sum;
            sum += n;
        }
        for (int i = 0; i < count; i++)
            other[starts[places[i].key >> shift & ((1 << PASS_BITS) - 1)]++] = places[i];
        memcpy(places, other, (size_t)count * sizeof *places);
    }
}

static float largest(const float v[3])
{
    float most = 0;
    for (int i = 0; i < 3; i++) {
        float size = v[i] < 0 ? -v[i] : v[i];
        most = size > most ? size : most;
    }
    return most;
}

static float least_cosine(const struct frame_light *light)
{
    switch (light->cone) {
    case CONE_CUTOFF:
        return light->cos_cutoff;
    case CONE_SOFT:
        return light->cos_outer;
    case CONE_EXPONENT:
        return 0;
    default:
        return -2;
    }
}

// Rows are handed out one after the other, each a multiple of 64 bytes; a NULL block only counts.
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

// The same rows, to be written.
struct written {
    uint32_t *number, *all;
    float *position[3], *axis[3], *attenuation[3], *least_cosine, *inverse_range, *most_diffuse, *most_specular;
    int32_t *far;
    float *group_low[3], *group_high[3], *group_reach;
    struct place *places, *other;
};

static struct written cut_rows(struct rows *rows, int room, int group_room, int materials)
{
    struct written w;
    w.number = (uint32_t *)row(rows, room);
    w.all = (uint32_t *)row(rows, room);
    w.far = (int32_t *)row(rows, room);
    for (int a = 0; a < 3; a++) {
        w.position[a] = row(rows, room);
        w.axis[a] = row(rows, room);
        w.attenuation[a] = row(rows, room);
        w.group_low[a] = row(rows, group_room);
        w.group_high[a] = row(rows, group_room);
    }
    w.least_cosine = row(rows, room);
    w.inverse_range = row(rows, room);
    w.group_reach = row(rows, group_room);
    w.most_diffuse = w.most_specular = NULL;
    for (int m = 0; m < materials; m++) {
        float *diffuse = row(rows, room), *specular = row(rows, room);
        w.most_diffuse = m ? w.most_diffuse : diffuse;
        w.most_specular = m ? w.most_specular : specular;
    }
    w.places = (struct place *)(void *)row(rows, 2 * room);
    w.other = (struct place *)(void *)row(rows, 2 * room);
    return w;
}

static void fill_light(const struct written *w, int i, const struct frame_light *light, uint32_t number)
{
    w->number[i] = number;
    w->far[i] = light->directional ? -1 : 0;
    for (int a = 0; a < 3; a++) {
        w->position[a][i] = light->directional ? -light->axis[a] : light->position[a];
        w->axis[a][i] = light->cone == CONE_NONE ? 0 : light->axis[a];
        w->attenuation[a][i] = light->attenuation[a];
    }
    w->least_cosine[i] = least_cosine(light);
    w->inverse_range[i] = light->inverse_range;
}

// A light that reaches nothing: its cone lets no direction through.
static void fill_nothing(const struct written *w, int i)
{
    static const struct frame_light nothing = {.attenuation = {1, 0, 0}};
    fill_light(w, i, &nothing, 0);
    w->least_cosine[i] = 2;
}

static void fill_group(const struct written *w, int group, int count)
{
    int first = group * LIGHTS_IN_GROUP;
    int end = first + LIGHTS_IN_GROUP < count ? first + LIGHTS_IN_GROUP : count;
    float reach = 0;
    for (int a = 0; a < 3; a++) {
        float low = ENDLESS, high = -ENDLESS;
        for (int i = first; i < end; i++) {
            low = w->position[a][i] < low ? w->position[a][i] : low;
            high = w->position[a][i] > high ? w->position[a][i] : high;
        }
        w->group_low[a][group] = low;
        w->group_high[a][group] = high;
    }
    for (int i = first; i < end; i++) {
        float range = !w->far[i] && w->inverse_range[i] > 0 ? 1.00001f / w->inverse_range[i] : ENDLESS;
        reach = range > reach ? range : reach;
    }
    w->group_reach[group] = reach;
}

static void fill_materials(const struct written *w, int count, int room, const struct frame *frame,
                           const struct material_products *materials)
{
    for (int m = 0; m < frame->material_count; m++) {
        float *diffuse = w->most_diffuse + (size_t)m * 2 * (size_t)room;
        float *specular = w->most_specular + (size_t)m * 2 * (size_t)room;
        for (int i = 0; i < room; i++) {
            diffuse[i] = specular[i] = 0;
            if (i >= count)
                continue;
            const struct light_products *products = &materials[m].lights[w->number[i]];
            diffuse[i] = largest(products->diffuse) + (frame->gl1 ? largest(products->ambient) : 0);
            specular[i] = largest(products->specular);
        }
    }
}

bool light_bounds_make(struct light_bounds *table, struct buffer *storage, const struct frame *frame,
                       const struct material_products *materials, struct call_control *call, lam_error *error)
{
    int count = frame->light_count;
    int group_count = (count + LIGHTS_IN_GROUP - 1) / LIGHTS_IN_GROUP, room = group_count * LIGHTS_IN_GROUP;
    int group_room = (group_count + LANES_MAX - 1) / LANES_MAX * LANES_MAX;
    struct rows rows = {0};
    cut_rows(&rows, room, group_room, frame->material_count);
    if (!buffer_reserve(storage, rows.used * sizeof(float), call, error))
        return false;
    rows = (struct rows){.at = storage->data};
    struct written w = cut_rows(&rows, room, group_room, frame->material_count);
    find_places(frame, w.places);
    if (count > LIGHTS_IN_GROUP)
        sort_places(w.places, w.other, count);
    for (int i = 0; i < room; i++) {
        w.all[i] = (uint32_t)i;
        if (i < count)
            fill_light(&w, i, &frame->lights[w.places[i].number], w.places[i].number);
        else
            fill_nothing(&w, i);
    }
    for (int g = 0; g < group_room; g++) {
        for (int a = 0; a < 3 && g >= group_count; a++)
            w.group_low[a][g] = w.group_high[a][g] = 0;
        w.group_reach[g] = -1;
        if (g < group_count)
            fill_group(&w, g, count);
    }
    fill_materials(&w, count, room, frame, materials);
    float slope = (frame->color == LAM_COLOR_RAW ? 1.0f : SRGB_SLOPE) * frame->exposure;
    *table =
        (struct light_bounds){.count = count,
                              .room = room,
                              .number = w.number,
                              .position = {w.position[0], w.position[1], w.position[2]},
                              .far = w.far,
                              .axis = {w.axis[0], w.axis[1], w.axis[2]},
                              .least_cosine = w.least_cosine,
                              .attenuation = {w.attenuation[0], w.attenuation[1], w.attenuation[2]},
                              .inverse_range = w.inverse_range,
                              .most_diffuse = w.most_diffuse,
                              .most_specular = w.most_specular,
                              .group_count = group_count,
                              .group_room = group_room,
                              .group_low = {w.group_low[0], w.group_low[1], w.group_low[2]},
                              .group_high = {w.group_high[0], w.group_high[1], w.group_high[2]},
                              .group_reach = w.group_reach,
                              .all = w.all,
                              .cutoff = count > LIGHTS_ALL_SUMMED ? (slope > 0 ? frame->light_cutoff / slope : 0) : 0};
    return true;
}
