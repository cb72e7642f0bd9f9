// render_cache.h: pictures drawn with faults, and the fault shaders, kept from one check to the next. For any number of
// threads at once.
#ifndef RENDER_CACHE_H
#define RENDER_CACHE_H

#include "fault_shader.h"

// Everything that a picture of the fault shader depends on.
struct render_key {
    int scene;                            // index in reference_scenes
    uint64_t contract, declared, numbers; // the contract's hash; of shader_interface; shader_constants_hash
    int light_frame, reflection, vertex_lit;
    int size; // width and height in pixels
    int light_capacity;
    unsigned supports;    // of shader_interface
    unsigned factors;     // likewise
    int tone;             // lam_tone, likewise
    unsigned expectation; // of fault_search
    fault_set set;
};

// The samples stored for a key. NULL: none.
const float *render_cache_find(lam_check_cache *cache, const struct render_key *key);

// Stores a copy of `count` samples. Does nothing if the cache is full.
void render_cache_add(lam_check_cache *cache, const struct render_key *key, const float *samples, size_t count);

// A fault shader for such pictures that is not in use, made current; else a new one. NULL: see `error`. `cache` may be
// NULL in both.
struct fault_shader *render_cache_take_shader(lam_check_cache *cache, const lam_check_painter *painter, int size,
                                              int stride, lam_error *error);
// Gives a shader back; NULL is fine.
void render_cache_keep_shader(lam_check_cache *cache, struct fault_shader *shader);

#endif
