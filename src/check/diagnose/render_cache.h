// render_cache.h: pictures drawn with faults, kept from one check to the next.
#ifndef RENDER_CACHE_H
#define RENDER_CACHE_H

#include "fault.h"

// Everything that a picture of the fault shader depends on.
struct render_key {
    int scene;                            // index in reference_scenes
    uint64_t contract, declared, numbers; // the contract's hash; of shader_interface; shader_constants_hash
    int light_frame, reflection, vertex_lit;
    int size; // width and height in pixels
    int light_capacity;
    unsigned supports;    // of shader_interface
    unsigned expectation; // of fault_search
    fault_set set;
};

// The samples stored for a key. NULL: none.
const float *render_cache_find(const lam_check_cache *cache, const struct render_key *key);

// Adds an entry of `count` samples, which the caller fills. NULL: the cache is full.
float *render_cache_add(lam_check_cache *cache, const struct render_key *key, size_t count);

#endif
