// blend.c: sorts a pixel's translucent fragments by depth at every sample, and blends them.
//
// The formula for one layer over another is:
//
//  color = src·a + dst·(1 − a)
//  alpha = a + A·(1 − a)
//
// The layers are summed from the nearest to the farthest, each weighted by the fraction of light that the previous
// layers let through. The remaining fraction is the weight of the opaque surface or the background.
#include "blend.h"

#include "behind.h"
#include "recorder.h"

#include <string.h>

static void sort_by_pixel(const struct fragments *fragments, struct blend_scratch *scratch)
{
    uint32_t *start = scratch->start;
    memset(start, 0, (TILE * TILE + 1) * sizeof *start);
    for (int i = 0; i < fragments->count; i++)
        start[fragments->pixel[i]]++;
    uint32_t sum = 0;
    for (int p = 0; p <= TILE * TILE; p++) {
        uint32_t count = start[p];
        start[p] = sum;
        sum += count;
    }
    for (int i = 0; i < fragments->count; i++)
        scratch->order[start[fragments->pixel[i]]++] = (uint32_t)i;
    // Each pixel's start has been advanced to the start of the next pixel.
    memmove(start + 1, start, TILE * TILE * sizeof *start);
    start[0] = 0;
}

// Sorts by descending rank. The ranks of a pixel are all different, so the order is unique.
static void insertion_sort(struct layer *layers, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        struct layer moved = layers[i];
        uint32_t to = i;
        for (; to > 0 && layers[to - 1].rank < moved.rank; to--)
            layers[to] = layers[to - 1];
        layers[to] = moved;
    }
}

// Moves the layer at index `at` down to its position in a heap whose top has the smallest rank.
static void sift_down(struct layer *heap, uint32_t count, uint32_t at)
{
    struct layer moved = heap[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && heap[child + 1].rank < heap[child].rank)
            child++;
        if (heap[child].rank >= moved.rank)
            break;
        heap[at] = heap[child];
    }
    heap[at] = moved;
}

static void sort_by_rank(struct layer *layers, uint32_t count)
{
    uint32_t sorted = 1;
    while (sorted < count && layers[sorted - 1].rank >= layers[sorted].rank)
        sorted++;
    if (sorted >= count)
        return;
    if (count <= 32) {
        insertion_sort(layers, count);
        return;
    }
    for (uint32_t i = count / 2; i-- > 0;)
        sift_down(layers, count, i);
    for (uint32_t last = count - 1; last > 0; last--) {
        struct layer smallest = layers[0];
        layers[0] = layers[last];
        layers[last] = smallest;
        sift_down(layers, last, 0);
    }
}

// Returns a rank by depth key, then by triangle number: if keys are equal, the lower number is nearer, as for opaque
// triangles.
static uint64_t rank_of(float key, uint32_t id)
{
    float unsigned_zero = key + 0.0f;
    uint32_t bits;
    memcpy(&bits, &unsigned_zero, sizeof bits);
    bits = bits >> 31 ? ~bits : bits | 0x80000000u;
    return (uint64_t)bits << 32 | (uint32_t)~(id << 1 | id >> 31);
}

// Clipping divides a triangle into several triangles. This function joins the fragments of these triangles in each
// pixel into one fragment. If two of the fragments cover a sample, the nearer key is used.
static void join_clipped_parts(const struct fragments *fragments, struct layer_rows *rows,
                               struct blend_scratch *scratch, int samples)
{
    for (int pixel = 0; pixel < TILE * TILE; pixel++) {
        uint32_t first = scratch->start[pixel], count = scratch->start[pixel + 1] - first;
        for (uint32_t i = 0; i < count; i++) {
            uint32_t fragment = scratch->order[first + i];
            scratch->layers[i] = (struct layer){rank_of(0, fragments->id[fragment]), fragment};
        }
        sort_by_rank(scratch->layers, count);
        for (uint32_t i = 1, kept = 0; i < count; i++) {
            uint32_t to = scratch->layers[kept].fragment, from = scratch->layers[i].fragment;
            if (fragments->id[to] != fragments->id[from]) {
                kept = i;
                continue;
            }
            float *keys = rows->keys + (size_t)to * (size_t)samples;
            const float *more = rows->keys + (size_t)from * (size_t)samples;
            unsigned has = rows->samples[to], gets = rows->samples[from];
            for (int s = 0; s < samples; s++)
                if (gets >> s & 1 && (!(has >> s & 1) || more[s] > keys[s]))
                    keys[s] = more[s];
            rows->samples[to] = (uint16_t)(has | gets);
            rows->samples[from] = 0;
        }
    }
}

// Removes fragments without samples, which were joined or masked, and updates the nearest samples of the remaining
// fragments.
static void drop_empty(const struct sample_pattern *pattern, struct fragments *fragments, struct layer_rows *rows)
{
    size_t samples = (size_t)pattern->count, kept = 0;
    for (size_t i = 0; i < (size_t)fragments->count; i++) {
        if (!rows->samples[i])
            continue;
        int nearest = 0;
        while (!(rows->samples[i] >> pattern->by_distance[nearest] & 1))
            nearest++;
        fragments->id[kept] = fragments->id[i];
        fragments->pixel[kept] = fragments->pixel[i];
        fragments->sample[kept] = pattern->by_distance[nearest];
        rows->samples[kept] = rows->samples[i];
        memmove(rows->keys + kept * samples, rows->keys + i * samples, samples * sizeof(float));
        kept++;
    }
    fragments->count = (int)kept;
}

// Lists the layers of a pixel and returns how many there are.
static uint32_t list_layers(struct blend_scratch *scratch, int pixel)
{
    uint32_t first = scratch->start[pixel], count = scratch->start[pixel + 1] - first;
    for (uint32_t i = 0; i < count; i++)
        scratch->layers[i].fragment = scratch->order[first + i];
    return count;
}

// Sorts the layers of a pixel by depth at a sample, the nearest first. Layers that do not cover the sample are sorted
// too, because the order at the next sample is nearly the same.
static void rank_layers(const struct fragments *fragments, const struct layer_rows *rows, struct layer *layers,
                        uint32_t count, int samples, int sample)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t f = layers[i].fragment;
        layers[i].rank = rank_of(rows->keys[(size_t)f * (size_t)samples + (size_t)sample], fragments->id[f]);
    }
    sort_by_rank(layers, count);
}

// Blends the layers of one pixel: adds their light to the pixel's sums, and sets the transmittance of each sample.
static void blend_pixel(const struct fragments *fragments, const struct layer_rows *rows, struct blend_scratch *scratch,
                        int samples, int pixel, struct pixel_sums *sums, struct recorder *recorder)
{
    uint32_t count = list_layers(scratch, pixel);
    struct layer *layers = scratch->layers;
    float share = 1.0f / (float)samples;
    for (int s = 0; s < samples; s++) {
        rank_layers(fragments, rows, layers, count, samples, s);
        float sum[3] = {0, 0, 0}, transmittance = 1;
        for (uint32_t i = 0; i < count && transmittance > 0; i++) {
            uint32_t f = layers[i].fragment;
            float alpha = fragments->color[3][f];
            if (!(rows->samples[f] >> s & 1) || !(alpha > 0))
                continue;
            if (recorder)
                recorder_layer(recorder, pixel, f, s, transmittance, share);
            float part = transmittance * alpha;
            for (int c = 0; c < 3; c++)
                sum[c] += fragments->color[c][f] * part;
            transmittance = transmittance * (1 - alpha);
        }
        for (int c = 0; c < 3; c++)
            sums->sum[c][pixel] += sum[c] * share;
        sums->sum[3][pixel] += (1 - transmittance) * share;
        sums->transmittance[pixel * samples + s] = transmittance;
    }
}

// The light that the layers at a sample reflect, and the transmittance for the light behind them.
struct layer_sum {
    float sum[3], left[3], mean; // the mean of `left`
    // For layers that refract: the shift of the picture behind, and the square of the blur width.
    float x, y, square;
    bool refracts;
};

static float mean_of(const float left[3]) { return (left[0] + left[1] + left[2]) * (1 / 3.0f); }

// Sums the layers of a sample with a transmittance per channel. A fragment with opacity a, colour C and transmittance T
// changes the light L behind it to C a + L (1 - a (1 - T)). A surface that refracts shows the picture behind it, which
// already contains the opaque surfaces. The opaque surfaces are therefore omitted.
static struct layer_sum sum_layers(const struct fragments *fragments, const struct layer_rows *rows,
                                   const struct layer *layers, uint32_t count, int sample, struct recorder *recorder,
                                   int pixel, float share)
{
    struct layer_sum l = {.left = {1, 1, 1}, .mean = 1};
    float *const *bend = fragments->bend;
    for (uint32_t i = 0; i < count && l.mean > 0; i++) {
        uint32_t f = layers[i].fragment;
        float alpha = fragments->color[3][f];
        if (!(rows->samples[f] >> sample & 1) || !(alpha > 0) || (l.refracts && bend[2][f] < 0))
            continue;
        if (recorder)
            recorder_layer(recorder, pixel, f, sample, l.mean, share);
        for (int c = 0; c < 3; c++) {
            l.sum[c] += fragments->color[c][f] * (l.left[c] * alpha);
            l.left[c] = l.left[c] * (1 - alpha * (1 - fragments->through[c][f]));
        }
        l.mean = mean_of(l.left);
        if (!bend[0] || bend[2][f] < 0)
            continue;
        l.x += bend[0][f];
        l.y += bend[1][f];
        l.square += bend[2][f];
        l.refracts |= bend[0][f] != 0 || bend[1][f] != 0 || bend[2][f] > 0;
    }
    return l;
}

// A pixel with layers that have a transmittance per channel. A picture has only one alpha per pixel, the mean of the
// channels. The differences from the mean tint the visible background.
struct tinted_pixel {
    int number;      // index in the tile
    float x, y;      // the centre of the pixel in the picture
    int samples;     // per pixel
    float looked[4]; // the colour of the picture behind the glass, read for the last sample that refracts
    struct layer_sum last;
};

// Adds the picture behind the glass to a sample whose layers refract. The remaining light is from the background.
static void add_behind(struct layer_sum *l, const struct behind *behind, struct tinted_pixel *p)
{
    if (!p->last.refracts || l->x != p->last.x || l->y != p->last.y || l->square != p->last.square)
        behind_look(behind, p->x + l->x, p->y + l->y, l->square, p->looked);
    p->last = *l;
    for (int c = 0; c < 3; c++) {
        l->sum[c] += l->left[c] * p->looked[c];
        l->left[c] = l->left[c] * (1 - p->looked[3]);
    }
    l->mean = mean_of(l->left);
}

static __attribute__((noinline)) void blend_tinted_pixel(const struct fragments *fragments,
                                                         const struct layer_rows *rows, struct blend_scratch *scratch,
                                                         const uint32_t *ids, struct tinted_pixel *p,
                                                         struct pixel_sums *sums, struct recorder *recorder)
{
    int pixel = p->number, samples = p->samples;
    uint32_t count = list_layers(scratch, pixel);
    float share = 1.0f / (float)samples;
    for (int s = 0; s < samples; s++) {
        rank_layers(fragments, rows, scratch->layers, count, samples, s);
        struct layer_sum l = sum_layers(fragments, rows, scratch->layers, count, s, recorder, pixel, share);
        float own[3] = {l.sum[0], l.sum[1], l.sum[2]};
        bool refracts = l.refracts && sums->behind;
        if (refracts)
            add_behind(&l, sums->behind, p);
        float least = l.left[0] < l.left[1] ? l.left[0] : l.left[1];
        least = least < l.left[2] ? least : l.left[2];
        bool open = (refracts || ids[s] == NOTHING) && sums->background[3] > 0;
        for (int c = 0; c < 3; c++) {
            float whole = l.sum[c] + (open ? (l.left[c] - least) * sums->background[c] : 0);
            sums->sum[c][pixel] += whole * share;
            sums->tint[c][pixel * samples + s] = refracts ? 0 : l.left[c];
            own[c] = (whole - own[c]) * share;
        }
        sums->sum[3][pixel] += (1 - (open ? least : l.mean)) * share;
        sums->transmittance[pixel * samples + s] = refracts ? 0 : l.mean;
        if (recorder)
            recorder_behind(recorder, pixel, own);
    }
}

static bool is_uncovered(const uint32_t *ids, int samples)
{
    for (int s = 0; s < samples; s++)
        if (ids[s] != NOTHING)
            return false;
    return true;
}

void sort_layers(const struct sample_pattern *pattern, struct fragments *fragments, struct layer_rows *rows,
                 struct blend_scratch *scratch)
{
    sort_by_pixel(fragments, scratch);
    if (!rows->clipped && !rows->masked)
        return;
    if (rows->clipped)
        join_clipped_parts(fragments, rows, scratch, pattern->count);
    drop_empty(pattern, fragments, rows);
    sort_by_pixel(fragments, scratch);
}

uint64_t blend_layers(const struct sample_pattern *pattern, const struct fragments *fragments,
                      const struct layer_rows *rows, struct blend_scratch *scratch, const struct tile_part *part,
                      struct pixel_sums *sums, struct recorder *recorder)
{
    const struct rectangle *area = part->area;
    struct cells cells = cells_of(pattern->count);
    uint64_t uncovered = 0;
    for (int y = area->top; y <= area->bottom; y++)
        for (int x = area->left; x <= area->right; x++) {
            int pixel = y * TILE + x;
            if (scratch->start[pixel] == scratch->start[pixel + 1])
                continue;
            const uint32_t *own = part->ids + pixel_index(&cells, x, y);
            if (sums->tint[0])
                blend_tinted_pixel(fragments, rows, scratch, own,
                                   &(struct tinted_pixel){.number = pixel,
                                                          .x = (float)(part->tile->x * TILE + x) + 0.5f,
                                                          .y = (float)(part->tile->y * TILE + y) + 0.5f,
                                                          .samples = pattern->count},
                                   sums, recorder);
            else
                blend_pixel(fragments, rows, scratch, pattern->count, pixel, sums, recorder);
            uncovered += is_uncovered(own, pattern->count);
        }
    return uncovered;
}

void show_layers(const struct sample_pattern *pattern, const struct fragments *fragments, const struct layer_rows *rows,
                 struct tile_samples *samples)
{
    struct cells cells = cells_of(pattern->count);
    for (int i = 0; i < fragments->count; i++) {
        int pixel = fragments->pixel[i];
        size_t first = (size_t)pixel_index(&cells, pixel % TILE, pixel / TILE);
        const float *keys = rows->keys + (size_t)i * (size_t)pattern->count;
        for (unsigned rest = rows->samples[i]; rest; rest &= rest - 1) {
            int s = __builtin_ctz(rest);
            size_t at = first + (size_t)s;
            if (samples->ids[at] != NOTHING &&
                rank_of(samples->keys[at], samples->ids[at]) >= rank_of(keys[s], fragments->id[i]))
                continue;
            samples->keys[at] = keys[s];
            samples->ids[at] = fragments->id[i];
        }
    }
}
