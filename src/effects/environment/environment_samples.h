// environment_samples.h: fixed directions for summing an environment's light over lobes. Several methods of importance
// sampling are combined. Half of the directions follow the brightness of the environment, a quarter follow the base's
// microfacets that the eye sees, and a quarter follow the cosine. A clear coat and sheen add as many
// directions each. All of these use the points of `disc`. The sum weights each direction by the densities of all methods (multiple importance sampling). The weights are
// the balance heuristic (Veach and Guibas, "Optimally combining sampling techniques for Monte Carlo rendering", 1995).
//
// Each method uses the points of a Hammersley set. The directions are the same for all points of a picture, and on
// every machine.
#ifndef ENVIRONMENT_SAMPLES_H
#define ENVIRONMENT_SAMPLES_H

#include "buffer.h"
#include "cube_map.h"

// A direction towards a bright region of the environment.
struct sampled_light {
    float direction[3]; // unit vector, in the caller's axes
    float density;      // directions per steradian
    float color[3];     // the light from this direction
};

// A point in the unit disc. The points are evenly distributed.
struct disc_point {
    float x, y;
};

struct environment_samples {
    struct sampled_light *light;
    struct disc_point *disc;
    int light_count, disc_count;
    int size; // texels per side of the density's faces
    // 6 faces, row by row: the probability density of the directions in `light`, per area; a side of a face has length
    // 2.
    const float *density;
};

// Selects `count` directions. `to_environment` rotates the caller's axes to the environment's axes. `storage` owns the
// samples. `call` may be NULL.
bool environment_samples_make(struct environment_samples *samples, const struct lam_environment *cube,
                              const float to_environment[3][3], int count, struct buffer *storage,
                              struct call_control *call, lam_error *error);

#endif
