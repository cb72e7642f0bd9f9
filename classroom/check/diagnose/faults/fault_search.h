// fault_search.h: searches for the faults that explain the difference between a shader's pictures and the reference.
#ifndef FAULT_SEARCH_H
#define FAULT_SEARCH_H

#include "fault_shader.h"
#include "render_cache.h"
#include "diagnostics.h"

enum { MAX_FOUND_FAULTS = 6, MAX_SCENES = 32, MAX_ALSO = 3 };

// A fault of the table, with the result of the search.
struct found_fault {
    const struct fault *row;
    float exponent;                     // fitted factor of the exponent, or fitted constant; 0 if nothing was fitted
    double after;                       // mean difference over all scenes with this fault and all previous faults
    const struct fault *also[MAX_ALSO]; // faults that draw the same pictures
    int also_count;
};

struct fault_search {
    const lam_check_painter *painter;
    lam_check_cache *cache; // may be NULL
    const struct shader_interface *interface;
    lam_light_frame frame;
    lam_reflection reflection;
    struct scene_comparison *scenes;
    int scene_count, size;
    int light_capacity;   // the number of lights in the tested shaders
    unsigned expectation; // identifies the expected appearance of the scenes in the cache (render_key)
    double tolerance;
    unsigned needs; // the union of the scenes' needs
    // Whether some names in the shader have no value. The search then accepts only a single fault that explains
    // everything.
    bool has_unset_names;
    uint64_t max_pictures; // after this many pictures, no further sets are tried
    double before;         // mean difference without faults, over the scenes without NaN
    // Results: the found faults (the fault that explains most is first), and whether they explain everything.
    struct found_fault found[MAX_FOUND_FAULTS];
    int count;
    bool certain;
    uint64_t tried; // number of faults and sets
    bool stopped;   // whether max_pictures was reached
    // The shader's styles: rows of the table that are not mistakes.
    const struct fault *styles[MAX_FOUND_FAULTS];
    int style_count;
    // For each scene, the found fault that explains it alone, or NULL.
    const struct fault **scene_faults;
};

// Searches for the smallest set of faults that explains every picture. The caller allocates `scene_faults`. For a shader
// that differs only by a style, `certain` is set and the count is 0.
bool fault_search_run(struct fault_search *search, lam_error *error);

// Draws a scene in the styles of search->styles. `pixels` has size² × 4 floats.
bool fault_search_draw_style(struct fault_search *search, int scene, float *pixels, lam_error *error);

#endif
