// khr_layers.h: the members of glTF's material extensions for layers, each with its field and map in lam_material.
#ifndef KHR_LAYERS_H
#define KHR_LAYERS_H

#include <lambent/material.h>

// A number or colour, with the range that the extension's specification allows.
struct khr_number {
    const char *extension, *key;
    size_t offset; // offset of the member in lam_material
    int count;     // number of floats
    double min, max;
};

struct khr_map {
    const char *extension, *key;
    lam_map slot;
    lam_texture_values values;
    int channel;
};

enum { KHR_NUMBERS = 17, KHR_MAPS = 12 };
extern const struct khr_number khr_numbers[KHR_NUMBERS];
extern const struct khr_map khr_maps[KHR_MAPS];

#endif
