// cpu_frame.h: one frame of the CPU device, and the state of a thread. Only the functions that call the steps use this
// struct; each step receives only the members that it reads and writes (kernels.h).
//
//  vertices   positions → pixel x, y and depth key of shared vertices     vertex_transform.inc
//  triangles  index triples, or positions → tile bins                     bin_triangles.inc, corners.inc, clip.c
//  tiles      bins → depth key and triangle number of every sample        cover*.inc, occlusion.inc
//             translucent triangles → layers over the samples, blended    translucent_fragments.inc, blend.c
//             samples → fragments (a pixel and a triangle that it shows)  visibility_resolve.inc, fragments.c
//             fragments → colours                                         shade.c, lights.c
//             colours → pixels of the picture                             resolve.inc
//
#ifndef CPU_FRAME_H
#define CPU_FRAME_H

#include "bins.h"
#include "blend.h"
#include "coverage.h"
#include "fragment_store.h"
#include "kernels.h"
#include "light_bounds.h"
#include "pool.h"
#include "resolve.h"
#include "occlusion.h"
#include "shade_frame.h"
#include "shading_batch.h"

// The state of one thread. The thread's bins are stored elsewhere (struct raster_frame), because all threads read them.
struct thread_state {
    struct tile_samples samples;
    struct fragments fragments; // fragments of translucent surfaces first, then of opaque surfaces
    struct layer_rows layers;   // allocated only for frames with translucent surfaces, like the next member
    struct blend_scratch blend;
    struct shading shading;
    struct pixel_sums sums;
    struct buffer storage; // memory of the arrays
    uint64_t coverage_ns, lighting_ns, resolve_ns, pixels_covered;
};

struct cpu_frame {
    struct raster_frame raster;
    struct shade_frame shade;
    struct resolve_target target;
    const struct kernels *kernels;
    struct call_control *call;
    struct pool *pool;
    struct thread_bins *bins; // the bins of each thread
    struct thread_state *threads;
    const struct chunk *vertex_chunks, *triangle_chunks;
    size_t vertex_chunk_count, triangle_chunk_count;
    struct screen_occlusion occlusion;      // used only if the frame has ambient occlusion
    struct fragment_store *fragment_stores; // one per tile; NULL if each tile is drawn in one pass
    enum failure failure;
    struct work work;
};

static inline size_t tile_count(const struct cpu_frame *cpu)
{
    return (size_t)cpu->raster.tiles_across * (size_t)cpu->raster.tiles_down;
}

static inline struct tile tile_number(const struct cpu_frame *cpu, size_t index)
{
    size_t across = (size_t)cpu->raster.tiles_across;
    return tile_at((int)(index % across), (int)(index / across), cpu->target.image->width, cpu->target.image->height);
}

// Memory that the device keeps from frame to frame.
struct frame_memory {
    struct buffer vertices;  // x, y and key of the vertices of indexed meshes
    struct buffer chunks;    // chunks of parallel tasks, and the first vertex of each draw
    struct buffer products;  // materials × lights
    struct buffer lights;    // the rows of light_bounds
    struct buffer bins;      // the first blocks of all threads' bins
    struct buffer reference; // sampled directions
    struct buffer occlusion; // planes of struct screen_occlusion, or a struct occlusion_pattern
    struct buffer behind;    // the picture behind glass
    struct light_bounds light_bounds;
    struct environment_samples samples;
    struct path_frame paths;
};

// Sets up the lists, products and threads of a frame. Returns false if memory runs out, or if there are too many
// vertices or materials.
bool cpu_frame_set_up(struct cpu_frame *cpu, struct frame_memory *memory, lam_error *error);

uint64_t frame_memory_bytes(const struct frame_memory *memory);
void frame_memory_free(struct frame_memory *memory);
uint64_t thread_bytes(const struct thread_state *thread, const struct thread_bins *bins, bool first);
void thread_free(struct thread_state *thread, struct thread_bins *bins);

// Runs all steps for a tile, with the state of one thread.
void draw_tile(struct cpu_frame *cpu, size_t index, int thread);

#endif
