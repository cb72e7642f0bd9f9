// recorder.h: what keeps the numbers of one pixel while its tile is drawn (lambent/explain.h).
#ifndef RECORDER_H
#define RECORDER_H

#include "arena.h"

#include <lambent/explain.h>

enum { RECORDER_POINTS = 3 }; // that one fragment has at most

struct recorder {
    struct arena arena;   // holds all of the explanation
    lam_explanation *out; // its pixel is told before drawing
    lam_explained_fragment *fragments;
    int room;
    bool failed; // out of memory
    int pixel;   // number of the pixel in its tile
    // the explanation's fragment of each fragment of the translucent surfaces, + 1; 0: of another pixel
    uint32_t *layer_slots;

    // The fragment in hand; on: its numbers are being kept.
    bool on;
    lam_explained_point points[RECORDER_POINTS];
    int point_count;
    float weight_1, weight_2;
    int lit_sample;
    float picture_x, picture_y;
};

// One more fragment, zeroed; NULL: out of memory.
lam_explained_fragment *recorder_add(struct recorder *recorder);

// A translucent fragment is blended into a sample, with what the layers before it let through.
void recorder_layer(struct recorder *recorder, int pixel, uint32_t fragment, int sample, float through, float share);

// Memory of the explanation, zeroed; NULL: out of memory.
void *recorder_alloc(struct recorder *recorder, size_t count, size_t size);

#endif
