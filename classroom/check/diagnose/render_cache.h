// render_cache.h: keeps the fault shaders and their pictures for later checks. Any number of threads may use the
// cache at the same time.
#ifndef RENDER_CACHE_H
#define RENDER_CACHE_H

#include "fault_shader.h"

// All inputs that determine a picture of the fault shader.
struct render_key {
    int scene;                            // index in reference_scenes
    uint64_t contract, declared, numbers; // hashes of the contract and of the shader_interface, and
                                          // shader_constants_hash
    int light_frame, reflection, vertex_lit;
    int size; // width and height in pixels
    int light_capacity;
    unsigned supports;    // shader_interface.supports
    unsigned factors;     // shader_interface.factors
    int tone;             // a lam_tone, as in shader_interface
    unsigned expectation; // fault_search.expectation
    fault_set set;
};

// Returns the samples stored for a key, or NULL if there are none.
const float *render_cache_find(lam_check_cache *cache, const struct render_key *key);

// Stores a copy of `count` samples. A full cache stays unchanged.
void render_cache_add(lam_check_cache *cache, const struct render_key *key, const float *samples, size_t count);

// Returns an unused fault shader for pictures of this size and stride, or opens a new fault shader. Makes the fault
// shader's context current. On failure, sets `error` and returns NULL. `cache` may be NULL in both functions.
struct fault_shader *render_cache_take_shader(lam_check_cache *cache, const lam_check_painter *painter, int size,
                                              int stride, lam_error *error);
// Returns a shader to the cache; NULL is allowed.
void render_cache_keep_shader(lam_check_cache *cache, struct fault_shader *shader);

#endif
