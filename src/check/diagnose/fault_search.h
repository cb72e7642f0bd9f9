// fault_search.h: measures the difference between pictures, and searches for the faults that explain it.
#ifndef FAULT_SEARCH_H
#define FAULT_SEARCH_H

#include "fault_shader.h"
#include "render_cache.h"

// The comparison of one scene. A pixel is compared where its 3×3 neighbours are all covered in the reference.
struct scene_comparison {
    const struct reference_scene *row;      // of the table
    struct reference_scene reference_scene; // as the contract can express it
    const float *theirs;                    // straight RGBA
    float *reference;                       // drawn by the CPU device, straight alpha
    uint32_t *inside;                       // indices of the compared pixels
    size_t inside_count;
    float *samples; // of `theirs` (fault_search_sample)
    bool alpha;     // alpha is compared too
    double mean_difference;
    bool passes;
};

struct difference {
    double maximum, mean, share_over;
    uint64_t pixels;
    bool fits;
};

// Copies the compared pixels of a picture to `out`: red, green, blue (clamped to 0…1), and alpha where it is compared.
size_t fault_search_sample_count(const struct scene_comparison *scene);
void fault_search_sample(const struct scene_comparison *scene, const float *picture, float *out);

// The difference between scene->samples and those of another picture.
struct difference fault_search_difference(const struct scene_comparison *scene, const float *other, double tolerance);

enum { MAX_FOUND_FAULTS = 4, MAX_SCENES = 32 };

struct fault_search {
    const char *gl_device;
    lam_check_cache *cache; // may be NULL
    const struct shader_interface *interface;
    lam_light_frame frame;
    lam_reflection reflection;
    struct scene_comparison *scenes;
    int scene_count, size;
    int light_capacity; // of the shaders under test
    double tolerance;
    int order[MAX_SCENES];
    unsigned needs; // of all scenes together
    // Some names have no value: only a single fault that explains everything counts.
    bool has_unset_names;
    double before; // mean difference without faults
    // Results: the faults in the order found, the mean difference after each, and whether they explain everything.
    const struct fault *found[MAX_FOUND_FAULTS];
    double after[MAX_FOUND_FAULTS];
    int count;
    bool certain;
    // For each scene, the found fault that explains it alone. Where no explanation is certain: the one fault that
    // explains this scene and at least half of those that differ. NULL: none.
    const struct fault **scene_faults;
};

// Searches for the fewest faults that explain the pictures. The caller allocates `scene_faults`.
bool fault_search_run(struct fault_search *search, lam_error *error);

#endif
