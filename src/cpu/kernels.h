// kernels.h: the table of hot functions. One text, compiled once for each instruction set (kernels.c); every one gives
// the same bits as `scalar`.
#ifndef KERNELS_H
#define KERNELS_H

#include "pipeline.h"

struct kernels {
    const char *name;
    int lanes;
    // Projects the vertices of one piece.
    void (*project)(struct cpu_frame *cpu, const struct piece *piece);
    // Rejects and bins the triangles of one piece.
    void (*bin)(struct cpu_frame *cpu, struct thread_state *thread, const struct piece *piece);
    // Draws one tile's binned opaque triangles into the thread's visibility arrays, and counts the translucent ones.
    void (*cover)(struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y);
    // Lists the fragments of translucent triangles in a rectangle of the tile, but for what lies behind opaque ones.
    // False: there are more than LAYERS_MAX.
    bool (*gather_layers)(struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y,
                          const struct rectangle *rectangle);
    // Lists the opaque fragments of a tile: width × height pixels of it are in the picture.
    void (*collect)(const struct cpu_frame *cpu, struct thread_state *thread, int width, int height);
    // Keeps a tile's fragments, of triangles from fragment_store->lowest to `highest`, in memory of the arena (false:
    // there is none), and takes them out again.
    bool (*save_fragment_store)(struct fragment_store *fragment_store, const struct thread_state *thread, int samples,
                                uint32_t highest, struct arena *arena);
    void (*load_fragment_store)(const struct fragment_store *fragment_store, struct thread_state *thread, int samples);
    // Colours the thread's fragments.
    void (*light)(struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y);
    // Sums the fragments of a tile into its pixels, under the blended layers where there are any, and writes those into
    // the picture.
    void (*resolve)(struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y);
    // What a pixel without fragments holds, into cpu->empty_pixel.
    void (*resolve_empty)(struct cpu_frame *cpu);
};

// Those of `scalar`, which also keep the numbers of one pixel (record.inc).
extern const struct kernels kernels_recording;

extern const struct kernels kernels_scalar, kernels_sse4, kernels_avx2, kernels_avx512, kernels_neon, kernels_wasm;

#endif
