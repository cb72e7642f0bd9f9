// recorder.c: adds values to the explanation of a pixel.
#include "recorder.h"

#include <string.h>

lam_explained_fragment *recorder_add(struct recorder *recorder)
{
    int count = recorder->out->fragment_count;
    if (count == recorder->capacity) {
        int capacity = count ? 2 * count : 16;
        lam_explained_fragment *grown = recorder_alloc(recorder, (size_t)capacity, sizeof *grown);
        if (!grown)
            return NULL;
        if (count)
            memcpy(grown, recorder->fragments, (size_t)count * sizeof *grown);
        recorder->fragments = grown;
        recorder->capacity = capacity;
        recorder->out->fragments = grown;
    }
    recorder->out->fragment_count++;
    memset(&recorder->fragments[count], 0, sizeof *recorder->fragments);
    return &recorder->fragments[count];
}

void recorder_layer(struct recorder *recorder, int pixel, uint32_t fragment, int sample, float transmittance,
                    float share)
{
    if (pixel != recorder->pixel || !recorder->layer_slots || !recorder->layer_slots[fragment])
        return;
    lam_explained_fragment *out = &recorder->fragments[recorder->layer_slots[fragment] - 1];
    out->transmittance[sample] = transmittance;
    out->weight += transmittance * share;
}

void recorder_behind(struct recorder *recorder, int pixel, const float light[3])
{
    if (pixel != recorder->pixel || !recorder->layer_slots)
        return;
    lam_rgb *behind = &recorder->out->behind;
    behind->r += light[0];
    behind->g += light[1];
    behind->b += light[2];
}

void *recorder_alloc(struct recorder *recorder, size_t count, size_t size)
{
    void *memory = arena_array(&recorder->arena, count, size);
    if (memory)
        memset(memory, 0, count * size);
    else
        recorder->failed = true;
    return memory;
}
