// recorder.h: records the values of one pixel while its tile is drawn (lambent/explain.h).
#ifndef RECORDER_H
#define RECORDER_H

#include "arena.h"

#include <lambent/explain.h>

enum { RECORDER_POINTS = 3 }; // the maximum number of points of one fragment

// The share of a light that reaches a fragment of the explained pixel, if neighbouring fragments decide about it.
struct recorded_shadow {
    struct recorded_shadow *next;
    uint32_t triangle; // in the frame
    const struct frame_light *light;
    float passed[3]; // only the first number is used unless the frame tints rays
};

struct recorder {
    struct arena arena;   // owns the explanation
    lam_explanation *out; // the explanation; the caller sets the pixel's coordinates before drawing
    lam_explained_fragment *fragments;
    int capacity;
    bool failed; // out of memory
    int pixel;   // index of the pixel in its tile
    // For each translucent fragment, 1 + its index in the explanation, or 0 if the fragment belongs to another pixel.
    uint32_t *layer_slots;
    struct recorded_shadow *shadows; // the last one first

    lam_explained_fragment *fragment; // the fragment whose values are being recorded, or NULL
    lam_explained_point points[RECORDER_POINTS];
    int point_count;
    lam_explained_map maps[LAM_MAP_COUNT];
    int map_count;
    lam_explained_values values;
};

// Adds a zeroed fragment and returns it. Returns NULL if memory runs out.
lam_explained_fragment *recorder_add(struct recorder *recorder);

// Records that a translucent fragment is blended into a sample. `transmittance` is the transmittance of the layers in
// front of the fragment.
void recorder_layer(struct recorder *recorder, int pixel, uint32_t fragment, int sample, float transmittance,
                    float share);

// Records the light that arrives from behind a sample's translucent layers: from the picture behind glass, or from the
// background. The light has the units of the sum.
void recorder_behind(struct recorder *recorder, int pixel, const float light[3]);

// Allocates zeroed memory for the explanation. Returns NULL if memory runs out.
void *recorder_alloc(struct recorder *recorder, size_t count, size_t size);

#endif
