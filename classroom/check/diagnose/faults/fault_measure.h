// fault_measure.h: draws the scenes of a search with faults switched on, and measures the remaining difference.
#ifndef FAULT_MEASURE_H
#define FAULT_MEASURE_H

#include "fault_search.h"

struct fault_measure {
    struct fault_search *s;
    struct scene_comparison *scenes; // the scenes of the search, reduced to the drawn pixels
    int stride, size;                // the stride and size of the fault shader's pictures
    struct fault_shader *shader;     // opened on first use
    float *pixels, *samples, *memory;
    int order[MAX_SCENES]; // indices of the scenes to use: differing scenes first, by descending difference
    int scene_count, differ_count;
    uint64_t pictures; // the number of pictures measured so far
};

bool fault_measure_open(struct fault_measure *measure, struct fault_search *search, lam_error *error);
void fault_measure_close(struct fault_measure *measure);

// Draws a scene: every `stride`-th pixel of every `stride`-th row.
bool fault_measure_draw(struct fault_measure *measure, int scene, const fault_set *set, float *pixels,
                        lam_error *error);

// Measures the difference between the shader's picture of a scene and the picture with these faults.
bool fault_measure_scene(struct fault_measure *measure, int scene, const fault_set *set, struct difference *difference,
                         lam_error *error);

// Returns the set, extended by one fitted fault.
fault_set fault_measure_with(const fault_set *set, const struct found_fault *fault);

// Finds the best number for a fault that is added to `base`: the factor of the exponent, or the constant exponent. Uses
// the scene whose highlight depends most on this number. *exponent is 0 if no value fits.
bool fault_measure_fit(struct fault_measure *measure, const fault_set *base, const struct fault *row, float *exponent,
                       lam_error *error);

#endif
