// recorder.h: records the values of one pixel while its tile is drawn (lambent/explain.h).
#ifndef RECORDER_H
#define RECORDER_H

#include "arena.h"

#include <lambent/explain.h>

enum { RECORDER_POINTS = 3 }; // maximum of one fragment

struct recorder {
    struct arena arena;   // owns the explanation
    lam_explanation *out; // with the pixel's coordinates, set before drawing
    lam_explained_fragment *fragments;
    int capacity;
    bool failed; // out of memory
    int pixel;   // number of the pixel in its tile
    // For each translucent fragment, its index + 1 in the explanation; 0: of another pixel.
    uint32_t *layer_slots;

    // The current fragment.
    bool on; // its values are being recorded
    lam_explained_point points[RECORDER_POINTS];
    int point_count;
    float weight_1, weight_2;
    int lit_sample;
    float picture_x, picture_y;
    float received, unobstructed; // of a ground that catches shadows
    lam_explained_map maps[LAM_MAP_COUNT];
    int map_count;
    lam_explained_values values;
};

// Adds a fragment, zeroed, or NULL if memory runs out.
lam_explained_fragment *recorder_add(struct recorder *recorder);

// Records that a translucent fragment is blended into a sample. `transmittance`: of the layers before it.
void recorder_layer(struct recorder *recorder, int pixel, uint32_t fragment, int sample, float transmittance,
                    float share);

// Records the light that a sample's layers let through from the picture behind them or from the background, in the sum's units.
void recorder_behind(struct recorder *recorder, int pixel, const float light[3]);

// Memory for the explanation, zeroed, or NULL if memory runs out.
void *recorder_alloc(struct recorder *recorder, size_t count, size_t size);

#endif
