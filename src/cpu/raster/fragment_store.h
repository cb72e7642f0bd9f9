// fragment_store.h: a tile's fragments in compact form, kept while normals are made for all visible triangles.
#ifndef FRAGMENT_STORE_H
#define FRAGMENT_STORE_H

#include <stdbool.h>
#include <stdint.h>

struct fragment_store {
    int count;
    uint32_t lowest; // triangle number
    bool narrow;     // the other numbers follow within 23 bits
    void *fragments;
};

#endif
