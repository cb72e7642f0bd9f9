// render_cache.h: pictures of mistakes, kept from one check to the next.
#ifndef RENDER_CACHE_H
#define RENDER_CACHE_H

#include "fault.h"

// All that a picture of the model depends on.
struct picture_key {
    int scene; // index of the study
    int contract, light_frame, reflection, vertex_lit;
    int size, room;  // pixels of a side; lights that the shaders have room for
    unsigned offers; // what the shaders have names for
    fault_set set;
};

// The numbers kept for a key: those of the pixels that are compared. NULL: none.
const float *render_cache_find(const lam_check_pictures *pictures, const struct picture_key *key);

// Room for `count` numbers, to be filled by the caller, kept from now on. NULL where the store is full: then
// the picture is drawn again when it is wanted again.
float *render_cache_add(lam_check_pictures *pictures, const struct picture_key *key, size_t count);

#endif
