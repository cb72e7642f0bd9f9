// scene_comparison.h: measures the difference between the shader's picture of a scene and another picture.
#ifndef SCENE_COMPARISON_H
#define SCENE_COMPARISON_H

#include "reference_scene.h"

// The comparison of one scene. A pixel is compared if the reference covers all pixels of its 3×3 neighbourhood.
struct scene_comparison {
    const struct reference_scene *row;      // the scene's row in reference_scenes
    struct reference_scene reference_scene; // the expected scene
    const float *theirs;                    // the picture of the shader under test: RGBA with straight alpha
    float *reference;                       // straight alpha
    uint32_t *inside;                       // indices of the compared pixels
    size_t inside_count;
    float *samples; // the samples of `theirs`, from scene_comparison_sample
    bool alpha;     // alpha is also compared
    double mean_difference;
    bool passes;
    bool spoilt; // the shader's picture contains NaN, so the scene is useless for a search
};

struct difference {
    double maximum, mean, share_over;
    uint64_t pixels;
    bool fits; // at most one pixel in 200 exceeds the tolerance, and the mean is at most a quarter of the tolerance
};

// Finds the pixels to compare. The caller allocates `inside`, an array of size² elements.
void scene_comparison_find_inside(struct scene_comparison *scene, int size);

// Excludes each pixel whose normal differs by more than 26 degrees from the normal of a neighbour. `normals`: RGBA of
// size² pixels.
void scene_comparison_leave_out_turns(struct scene_comparison *scene, const float *normals, int size);

// Applies the tone curve of a shader printed by `lambent shader`. AUTO applies none.
void scene_comparison_apply_tone(lam_tone tone, float *pixels, size_t count);

// Copies the compared pixels of a picture to `out`: red, green, blue (clamped to 0…1), and alpha if it is compared.
size_t scene_comparison_sample_count(const struct scene_comparison *scene);
void scene_comparison_sample(const struct scene_comparison *scene, const float *picture, float *out);

// Returns the difference between scene->samples and another picture's samples.
struct difference scene_comparison_difference(const struct scene_comparison *scene, const float *other,
                                              double tolerance);

#endif
