// environment_samples.h: fixed directions by which the integral of an environment's light over a lobe is summed, drawn by
// importance of three kinds: a half where the environment is bright, a quarter each for mirrors of GGX that the eye sees and by
// the cosine. A sum weighs each direction by all three densities (the balance heuristic: Veach and Guibas, "Optimally
// combining sampling techniques for Monte Carlo rendering", 1995), so that no kind needs to fit the lobe.
//
// Each kind is Hammersley's point set. The directions are the same for all points of a picture, and on every machine.
#ifndef ENVIRONMENT_SAMPLES_H
#define ENVIRONMENT_SAMPLES_H

#include "buffer.h"
#include "cube_map.h"

// A direction towards a bright part of the environment.
struct sampled_light {
    float direction[3]; // unit, in the caller's axes
    float density;      // of the directions around it, per steradian
    float color[3];     // the light from there
};

// A point of the unit disc; the points are spread evenly.
struct disc_point {
    float x, y;
};

struct environment_samples {
    struct sampled_light *light;
    struct disc_point *lobe, *cosine;
    int light_count, lobe_count, cosine_count;
    int size;             // texels on a side of the density's faces
    const float *density; // 6 faces, row by row: of `light`, per area of a face that reaches from −1 to 1
};

enum { ENVIRONMENT_SAMPLES_MIN = 16, ENVIRONMENT_SAMPLES_MAX = 1 << 20 };

// Draws `count` directions. `to_environment` turns the caller's axes, of a rotation, into the environment's. The
// storage contains the samples. `call` may be NULL.
bool environment_samples_make(struct environment_samples *samples, const struct lam_environment *cube,
                              const float to_environment[3][3], int count, struct buffer *storage,
                              struct call_control *call, lam_error *error);

#endif
