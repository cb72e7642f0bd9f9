// fault_search.h: pictures against pictures: how far apart, and with which mistakes the model's pictures are nearest.
#ifndef FAULT_SEARCH_H
#define FAULT_SEARCH_H

#include "fault_shader.h"
#include "render_cache.h"

// One scene as it is judged.
struct judged {
    const struct reference_scene *row;      // of the table
    struct reference_scene reference_scene; // as the contract can say it
    const float *theirs;                    // straight RGBA
    float *reference;                       // the CPU device's, straight alpha
    // Compared are the pixels whose 3×3 neighbours are all covered in the reference: their indices, and what
    // theirs has there (fault_search_gather).
    uint32_t *inside;
    size_t inside_count;
    float *gathered;
    bool alpha;   // alpha counts
    double apart; // mean difference from the reference
    bool passes;
};

struct distance {
    double maximum, mean, share_over;
    uint64_t pixels;
    bool fits;
};

// The numbers of the pixels that are compared, one pixel after the other: red, green, blue (clamped to 0…1),
// and alpha where it counts.
size_t fault_search_gathered_count(const struct judged *scene);
void fault_search_gather(const struct judged *scene, const float *picture, float *out);

// Of scene->gathered from another picture's gathered numbers.
struct distance fault_search_distance(const struct judged *scene, const float *other, double tolerance);

enum { FOUND_MOST = 4, ORDER_MOST = 32 };

struct search {
    const char *gl_device;
    lam_check_pictures *pictures; // may be NULL
    const struct shader_interface *reading;
    lam_light_frame frame;
    lam_reflection reflection;
    struct judged *scenes;
    int scene_count, size;
    int room; // lights that the shaders have room for
    double tolerance;
    int order[ORDER_MOST];
    unsigned needs; // of the scenes together
    bool unset;     // names without a value: only a mistake that explains all by itself counts
    // Results: mistakes in the order found, the mean distance after each, and whether they explain everything.
    const struct fault *found[FOUND_MOST];
    double after[FOUND_MOST];
    int count;
    bool certain;
    double before;
    // For each scene the one of the found that explains it by itself; where no explanation is certain, the
    // one mistake that explains it and half of the others that differ. NULL: none.
    const struct fault **alone;
};

// Looks for the fewest mistakes that explain the pictures. `alone` has room for scene_count.
bool fault_search_run(struct search *search, lam_error *error);

#endif
