// fragment_store.h: a tile's fragments in compact form, kept while normals of all visible triangles are computed.
#ifndef FRAGMENT_STORE_H
#define FRAGMENT_STORE_H

#include <stdbool.h>
#include <stdint.h>

struct fragment_store {
    int count;
    uint32_t lowest; // the lowest triangle number
    bool narrow;     // all numbers are within 23 bits of `lowest`
    void *fragments;
};

#endif
