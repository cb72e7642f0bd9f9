// fragment_store.h: a tile's fragments in compact form, kept while normals of all visible triangles are computed.
#ifndef FRAGMENT_STORE_H
#define FRAGMENT_STORE_H

#include <stdbool.h>
#include <stdint.h>

struct fragment_store {
    int count;
    uint32_t lowest; // the lowest triangle number
    bool narrow;     // the differences between all triangle numbers and `lowest` fit into 23 bits
    void *fragments;
};

#endif
