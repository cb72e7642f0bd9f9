// bins.h: the triangles of each tile.
#ifndef BINS_H
#define BINS_H

#include "raster_frame.h"

// Each tile has two bins: one for small back-facing triangles, and one for all others. A bin is a chain of blocks of
// entries. Every thread fills its own bins, so binning needs no locks. The picture does not depend on the order of a
// tile's triangles. Back faces are drawn last, because most of them are then occluded. The box and the nearest key of
// an entry's back faces are tested first (occlusion.inc).
enum {
    TILE_BINS = 2, // bin 2·t of tile t contains front faces and large back faces, and bin 2·t + 1 contains small back
                   // faces
    BIN_BLOCK_ENTRIES = 40,
    SMALL = TILE * SUBPIXEL, // largest extent for which edge functions fit into 32 bits
};
#define CLIPPED 0x80000000u // flag in bin_entry.first: the number of a clipped triangle

// Triangles that touch a tile and have similar numbers. Neighbours in a mesh usually touch the same tile, so one entry
// lists up to LANES triangles.
struct bin_entry {
    uint32_t first;     // a triangle number
    uint16_t triangles; // bit i is set if the entry contains triangle first + i; one bit if the triangle is clipped
    uint16_t box;       // for back faces: the box around the triangles in the tile (occlusion.inc)
    float key;          // for back faces: the nearest key of all corners
};

struct bin_block {
    struct bin_block *next;
    uint32_t count;
    struct bin_entry entries[BIN_BLOCK_ENTRIES];
};

// One triangle of a clipped polygon: its own window coordinates, and the number of the original triangle.
struct clipped_triangle {
    float x[3], y[3], key[3];
    uint32_t id;
    bool back;
};

// Memory in slabs that are never moved.
struct slab_list {
    void **slabs;
    int count, capacity; // slabs
    int current;         // the slab being filled
    size_t used;         // used bytes of the current slab
    size_t charged;      // bytes that count towards the call's memory limit
};

// The bins that one thread fills and all threads read.
struct thread_bins {
    struct bin_block **heads; // the newest block of each bin
    struct slab_list blocks;
    struct slab_list clipped;
    uint32_t clipped_count;
    uint64_t triangles_binned;
    uint64_t work; // units of work that have not been added to the frame's sum yet
};

// Allocate a block for one more bin, or memory for one more clipped triangle. Both functions return NULL if memory runs
// out; the frame is then marked as failed.
struct bin_block *new_bin_block(const struct raster_frame *raster, struct thread_bins *bins);
struct clipped_triangle *new_clipped_triangle(const struct raster_frame *raster, struct thread_bins *bins,
                                              uint32_t *number);
const struct clipped_triangle *clipped_triangle(const struct thread_bins *bins, uint32_t number);
size_t slabs_free(struct slab_list *list); // returns the number of freed bytes that counted

// The snapped coordinates of a triangle's corners.
struct snapped {
    int32_t x[3], y[3];
};

// Returns twice the signed area. If y points down, a triangle with a positive area is clockwise on the screen.
static inline int64_t snapped_area(const struct snapped *c)
{
    return (int64_t)(c->x[1] - c->x[0]) * (c->y[2] - c->y[0]) - (int64_t)(c->x[2] - c->x[0]) * (c->y[1] - c->y[0]);
}

// Bins a triangle of any size into the tiles that it can touch.
void bin_large(const struct raster_frame *raster, struct thread_bins *bins, const struct snapped *corners, uint32_t id);

static inline bool tile_has_triangles(const struct raster_frame *raster, size_t tile)
{
    for (int i = 0; i < raster->thread_count; i++)
        for (size_t b = 0; b < TILE_BINS; b++)
            if (raster->bins[i].heads[tile * TILE_BINS + b])
                return true;
    return false;
}

// Adds an entry to a bin. If memory runs out, the entry is dropped, and the frame is marked as failed.
static inline void bin_add(const struct raster_frame *raster, struct thread_bins *bins, int bin, struct bin_entry entry)
{
    struct bin_block *block = bins->heads[bin];
    if (!block || block->count == BIN_BLOCK_ENTRIES) {
        struct bin_block *fresh = new_bin_block(raster, bins);
        if (!fresh)
            return;
        fresh->next = block;
        fresh->count = 0;
        block = bins->heads[bin] = fresh;
    }
    block->entries[block->count++] = entry;
}

#endif
