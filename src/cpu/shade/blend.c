// blend.c: translucent surfaces: a pixel's fragments put in order of depth for every sample, and blended.
//
// Colours lie over one another as src·a + dst·(1−a), the result's alpha is a + A·(1−a). That is worked out from the
// nearest layer to the farthest, with the share of light that the layers so far let through: the sum is the same, and
// what is left over tells how much of the opaque surface or the background below is seen.
//
// Memory is bounded: a thread holds LAYERS_MAX fragments. Where a tile has more, it is done in halves, and those in
// halves again, down to single pixels, whose fragments must fit. Nothing is ever left out.
#include "kernels.h"

#include "recorder.h"

#include <string.h>

static void sort_by_pixel(struct thread_state *thread)
{
    uint32_t *start = thread->layer_start;
    memset(start, 0, (TILE * TILE + 1) * sizeof *start);
    for (int i = 0; i < thread->fragment_count; i++)
        start[thread->fragment_pixel[i]]++;
    uint32_t sum = 0;
    for (int p = 0; p <= TILE * TILE; p++) {
        uint32_t count = start[p];
        start[p] = sum;
        sum += count;
    }
    for (int i = 0; i < thread->fragment_count; i++)
        thread->layer_order[start[thread->fragment_pixel[i]]++] = (uint32_t)i;
    // Each start has moved on to the next one's place.
    memmove(start + 1, start, TILE * TILE * sizeof *start);
    start[0] = 0;
}

// The largest rank first. Ranks of a pixel are all different, so that there is one order only.
static void sort_few(struct layer *layers, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        struct layer moved = layers[i];
        uint32_t to = i;
        for (; to > 0 && layers[to - 1].rank < moved.rank; to--)
            layers[to] = layers[to - 1];
        layers[to] = moved;
    }
}

// Lets the layer at `at` sink in a heap whose smallest rank is on top.
static void sink(struct layer *heap, uint32_t count, uint32_t at)
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

static void sort_layers(struct layer *layers, uint32_t count)
{
    uint32_t sorted = 1;
    while (sorted < count && layers[sorted - 1].rank >= layers[sorted].rank)
        sorted++;
    if (sorted >= count)
        return;
    if (count <= 32) {
        sort_few(layers, count);
        return;
    }
    for (uint32_t i = count / 2; i-- > 0;)
        sink(layers, count, i);
    for (uint32_t last = count - 1; last > 0; last--) {
        struct layer smallest = layers[0];
        layers[0] = layers[last];
        layers[last] = smallest;
        sink(layers, last, 0);
    }
}

// A rank by depth key, then by triangle number: the lower of equals is nearer, as among opaque ones.
static uint64_t rank_of(float key, uint32_t id)
{
    float unsigned_zero = key + 0.0f;
    uint32_t bits;
    memcpy(&bits, &unsigned_zero, sizeof bits);
    bits = bits >> 31 ? ~bits : bits | 0x80000000u;
    return (uint64_t)bits << 32 | (uint32_t)~(id << 1 | id >> 31);
}

// Joins the fragments that pieces of one clipped triangle have in one pixel; a sample that two of them claim gets the
// nearer.
static void join_pieces(struct thread_state *thread, int samples)
{
    for (int pixel = 0; pixel < TILE * TILE; pixel++) {
        uint32_t first = thread->layer_start[pixel], count = thread->layer_start[pixel + 1] - first;
        for (uint32_t i = 0; i < count; i++) {
            uint32_t fragment = thread->layer_order[first + i];
            thread->layers[i] = (struct layer){rank_of(0, thread->fragment_id[fragment]), fragment};
        }
        sort_layers(thread->layers, count);
        for (uint32_t i = 1, kept = 0; i < count; i++) {
            uint32_t to = thread->layers[kept].fragment, from = thread->layers[i].fragment;
            if (thread->fragment_id[to] != thread->fragment_id[from]) {
                kept = i;
                continue;
            }
            float *keys = thread->layer_keys + (size_t)to * (size_t)samples;
            const float *more = thread->layer_keys + (size_t)from * (size_t)samples;
            unsigned has = thread->layer_samples[to], gets = thread->layer_samples[from];
            for (int s = 0; s < samples; s++)
                if (gets >> s & 1 && (!(has >> s & 1) || more[s] > keys[s]))
                    keys[s] = more[s];
            thread->layer_samples[to] = (uint16_t)(has | gets);
            thread->layer_samples[from] = 0;
        }
    }
}

// Takes out the fragments that have been joined to others, and finds the remaining ones' nearest samples anew.
static void drop_joined(const struct sample_pattern *pattern, struct thread_state *thread)
{
    size_t samples = (size_t)pattern->count, kept = 0;
    for (size_t i = 0; i < (size_t)thread->fragment_count; i++) {
        if (!thread->layer_samples[i])
            continue;
        int nearest = 0;
        while (!(thread->layer_samples[i] >> pattern->by_distance[nearest] & 1))
            nearest++;
        thread->fragment_id[kept] = thread->fragment_id[i];
        thread->fragment_pixel[kept] = thread->fragment_pixel[i];
        thread->fragment_sample[kept] = pattern->by_distance[nearest];
        thread->layer_samples[kept] = thread->layer_samples[i];
        memmove(thread->layer_keys + kept * samples, thread->layer_keys + i * samples, samples * sizeof(float));
        kept++;
    }
    thread->fragment_count = (int)kept;
}

// Blends the layers of one pixel: adds to its sums, and sets what they let through at each sample.
static void blend_pixel(const struct cpu_frame *cpu, struct thread_state *thread, int pixel)
{
    uint32_t first = thread->layer_start[pixel], count = thread->layer_start[pixel + 1] - first;
    struct layer *layers = thread->layers;
    int samples = cpu->frame->samples;
    float share = 1.0f / (float)samples;
    for (uint32_t i = 0; i < count; i++)
        layers[i].fragment = thread->layer_order[first + i];
    for (int s = 0; s < samples; s++) {
        // All of them are ordered, seen at this sample or not: the next sample's order will be nearly the same.
        for (uint32_t i = 0; i < count; i++) {
            uint32_t f = layers[i].fragment;
            layers[i].rank =
                rank_of(thread->layer_keys[(size_t)f * (size_t)samples + (size_t)s], thread->fragment_id[f]);
        }
        sort_layers(layers, count);
        float sum[3] = {0, 0, 0}, clear = 1;
        for (uint32_t i = 0; i < count && clear > 0; i++) {
            uint32_t f = layers[i].fragment;
            float alpha = thread->fragment_color[3][f];
            if (!(thread->layer_samples[f] >> s & 1) || !(alpha > 0))
                continue;
            if (cpu->recorder)
                recorder_layer(cpu->recorder, pixel, f, s, clear, share);
            float part = clear * alpha;
            for (int c = 0; c < 3; c++)
                sum[c] += thread->fragment_color[c][f] * part;
            clear = clear * (1 - alpha);
        }
        for (int c = 0; c < 3; c++)
            thread->sum[c][pixel] += sum[c] * share;
        thread->sum[3][pixel] += (1 - clear) * share;
        thread->clear[pixel * samples + s] = clear;
    }
}

static bool bare(const uint32_t *ids, int samples)
{
    for (int s = 0; s < samples; s++)
        if (ids[s] != NOTHING)
            return false;
    return true;
}

static void blend_rectangle(struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y,
                            const struct rectangle *area)
{
    if (__atomic_load_n(&cpu->failed, __ATOMIC_RELAXED) || !call_should_continue(cpu->call))
        return;
    uint64_t start = now_ns();
    if (!cpu->kernels->gather_layers(cpu, thread, tile_x, tile_y, area)) {
        thread->coverage_ns += now_ns() - start;
        int width = area->right - area->left + 1, height = area->bottom - area->top + 1;
        if (width == 1 && height == 1) {
            __atomic_store_n(&cpu->failed, FAILED_LAYERS, __ATOMIC_RELAXED);
            return;
        }
        struct rectangle one = *area, other = *area;
        if (width > height)
            other.left = (one.right = area->left + width / 2 - 1) + 1;
        else
            other.top = (one.bottom = area->top + height / 2 - 1) + 1;
        blend_rectangle(cpu, thread, tile_x, tile_y, &one); // at most 12 deep
        blend_rectangle(cpu, thread, tile_x, tile_y, &other);
        return;
    }
    int samples = cpu->frame->samples;
    struct cells cells = cells_of(samples);
    sort_by_pixel(thread);
    if (thread->layers_clipped) {
        join_pieces(thread, samples);
        drop_joined(cpu->pattern, thread);
        sort_by_pixel(thread);
    }
    group_fragments(cpu->frame, thread);
    uint64_t gathered = now_ns();
    cpu->kernels->light(cpu, thread, tile_x, tile_y);
    uint64_t lit = now_ns();
    for (int y = area->top; y <= area->bottom; y++)
        for (int x = area->left; x <= area->right; x++) {
            int pixel = y * TILE + x;
            if (thread->layer_start[pixel] == thread->layer_start[pixel + 1])
                continue;
            blend_pixel(cpu, thread, pixel);
            thread->pixels_covered += bare(thread->ids + pixel_place(&cells, x, y), samples);
        }
    thread->coverage_ns += gathered - start;
    thread->lighting_ns += lit - gathered;
    thread->resolve_ns += now_ns() - lit;
}

void blend_tile(struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y, int width, int height)
{
    for (int c = 0; c < 4; c++)
        memset(thread->sum[c], 0, TILE * TILE * sizeof(float));
    for (int i = 0; i < fragments_of_tile(cpu->frame->samples); i++)
        thread->clear[i] = 1;
    struct rectangle whole = {0, 0, width - 1, height - 1};
    blend_rectangle(cpu, thread, tile_x, tile_y, &whole);
}
