// diagnostics.h: the messages of a report: the compiler's messages, hints, and unknown names.
#ifndef DIAGNOSTICS_H
#define DIAGNOSTICS_H

#include "arena.h"
#include "declarations.h"
#include "draw_request.h"
#include "reference_scene.h"
#include "shader_interface.h"

#include <lambent/check.h>

struct diagnostics {
    struct arena *arena; // owns the strings
    lam_check_diagnostic *items;
    int count;
    bool failed; // out of memory
};

// Adds a message. Ignores repeated messages, and messages beyond a fixed count.
__attribute__((format(printf, 5, 6))) void diagnostics_add(struct diagnostics *diagnostics,
                                                           lam_check_diagnostic_kind kind, const char *file, int line,
                                                           const char *format, ...);

// --- explains compiler messages about spelling and syntax mistakes that occur in lectures and in students' shaders.

// Adds hints for one message of the compiler about a line (0 if unknown).
void compiler_hints_for_message(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                                int line, const char *message);

// Adds hints for the source of a shader that does not compile.
void compiler_hints_for_text(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                             bool vertex);

// Adds a hint for each uniform that a shader declares but does not use.
void compiler_hints_for_unused(struct diagnostics *diagnostics, const struct declarations *d, const char *file);

// Adds hints about the outputs of a fragment shader that compiles. `output` is the output's name in the course, or
// NULL. Returns false if no output of the shader is floating-point, because a picture cannot store other outputs.
bool compiler_hints_for_output(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                               const char *output);

// Adds hints for two shaders that compile but do not link.
void compiler_hints_for_link(struct diagnostics *diagnostics, const struct shader_interface *interface,
                             const lam_check_params *params);

// --- diagnostics of shaders that do not compile, and of names and types that do not match the contract.

// Adds the driver's log of a shader that does not compile, line by line, with hints for known messages.
void diagnostics_add_refusal(struct diagnostics *diagnostics, const struct draw_result *result,
                             const struct shader_interface *interface, const lam_check_params *params);

// Reports unknown names and mismatched types, whether or not the shaders compile.
void diagnostics_add_names(struct diagnostics *diagnostics, const struct draw_result *result,
                           const struct shader_interface *interface, const lam_check_params *params);

// --- measures the difference between the shader's picture of a scene and another picture.

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
