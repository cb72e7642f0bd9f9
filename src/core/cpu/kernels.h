// kernels.h: the tables of performance-critical functions. raster/raster.c, shade/shade.c and lights/lights.c are compiled
// once for each instruction set, with LANES and ISA defined. The results of all versions are bit-identical to those that
// `scalar` computes. A step accesses only its parameters. The parameters that it does not change are const.
#ifndef KERNELS_H
#define KERNELS_H

#include <lambent/device.h>

#include <stddef.h>

struct arena;
struct cpu_frame;
struct fragment_store;
struct fragments;
struct layer_rows;
struct chunk;
struct pixel_sums;
struct raster_frame;
struct rectangle;
struct resolve_target;
struct sample_pattern;
struct screen_occlusion;
struct shade_frame;
struct shading;
struct thread_bins;
struct thread_state;
struct tile;
struct tile_samples;
struct vertex_run;

// The steps that find visible surfaces, and that write pixels (raster/raster.c).
struct raster_kernels {
    // Writes the x, y and depth key of the task's vertices to raster->vertices. For a vertex that needs clipping, x is
    // a NaN that encodes the planes (clip.h). The tasks may run in any order and on any thread. Only indexed meshes
    // have vertex tasks.
    void (*vertex_transform)(const struct raster_frame *raster, const struct chunk *chunk);

    // Appends the task's triangles to the bins of the tiles that they touch, and clips triangles if necessary. Drops
    // triangles that are outside the window or culled, and triangles without an area or without a sample in their
    // bounding box. If the mesh is indexed, all vertices of the draw must have been transformed.
    void (*bin_triangles)(const struct raster_frame *raster, struct thread_bins *bins, const struct chunk *chunk);

    // Clears the tile's samples, then draws the opaque triangles of all threads' bins. Each sample keeps the triangle
    // with the nearest key. If keys are equal, the sample keeps the triangle with the lowest number. Counts the
    // translucent triangles.
    void (*cover_tile)(const struct raster_frame *raster, struct tile_samples *samples, const struct tile *tile);

    // Lists the fragments of translucent triangles within `area` of the tile, except samples behind an opaque triangle.
    // Fills in the rows id, pixel and sample, and the layer rows. Returns false if there are more than LAYERS_MAX
    // fragments.
    bool (*translucent_fragments)(const struct raster_frame *raster, const struct tile_samples *samples,
                                  struct fragments *fragments, struct layer_rows *rows, const struct tile *tile,
                                  const struct rectangle *area);

    // Lists the opaque fragments of the tile's pixels inside the picture, and fills in the rows id, pixel, weight and
    // sample. The fragments of a pixel are consecutive. The order is given by one sample of each fragment: the nearest
    // to the pixel's centre among the samples that show the fragment. Returns the number of pixels with fragments.
    uint64_t (*visibility_resolve)(const struct sample_pattern *pattern, const struct tile_samples *samples,
                                   struct fragments *fragments, const struct tile *tile);

    // Stores the fragments from visibility_resolve in memory allocated from the arena. The triangle numbers of the
    // fragments are between store->lowest and `highest`. Returns false if memory runs out.
    bool (*save_fragments)(struct fragment_store *store, const struct fragments *fragments, int samples,
                           uint32_t highest, struct arena *arena);
    // Restores the rows id, pixel, weight and sample of the stored fragments.
    void (*load_fragments)(const struct fragment_store *store, struct fragments *fragments, int samples);

    // Stores the depths of the surfaces in a tile, after its triangles are drawn. Ambient occlusion is computed from
    // these depths later.
    void (*depth_of_tile)(const struct raster_frame *raster, const struct tile_samples *samples,
                          const struct tile *tile, struct screen_occlusion *occlusion);

    // Stores the hidden surfaces in a tile for ambient occlusion (struct screen_occlusion).
    void (*layers_of_tile)(const struct raster_frame *raster, const struct tile *tile,
                           struct screen_occlusion *occlusion);

    // Sums the fragments' colours in their pixels, weighted by samples, and writes the tile to the picture. If the tile
    // has translucent layers, they are blended over these sums. Pixels without fragments are set to
    // target->empty_pixel.
    void (*resolve)(const struct resolve_target *target, const struct fragments *fragments,
                    const struct tile_samples *samples, struct pixel_sums *sums, const struct tile *tile);

    // Sets target->empty_pixel to the encoded background.
    void (*resolve_empty)(struct resolve_target *target);
};

// The steps that compute colours (shade/shade.c).
struct shade_kernels {
    // Removes samples of masked surfaces from the rows of listed fragments if the opacity at the sample is below the
    // cutoff. Sets rows->masked if a fragment belongs to a masked surface.
    void (*mask_fragments)(const struct shade_frame *shade, struct fragments *fragments, struct layer_rows *rows,
                           struct shading *shading, const struct tile *tile);

    // Fills in the colours of grouped fragments.
    void (*shade_fragments)(const struct shade_frame *shade, struct fragments *fragments, struct shading *shading,
                            const struct tile *tile);

    // Computes the lighting of the vertices of a run, and stores it in shading->vertices.color and .rest
    // (vertex_colors.h).
    void (*light_vertices)(const struct shade_frame *shade, struct shading *shading, const struct vertex_run *run);
};

struct kernels {
    const char *name;
    int lanes;
    const struct raster_kernels *raster;
    const struct shade_kernels *shade;
};

// The shading functions of the `scalar` version, with hooks that record the values of one pixel (record.h).
struct recording_kernels {
    // Records the explained pixel's fragments after they are shaded.
    void (*record_fragments)(const struct cpu_frame *cpu, struct thread_state *thread, const struct tile *tile);
    // Records the pixel after it is resolved.
    void (*record_pixel)(const struct cpu_frame *cpu, struct thread_state *thread, const struct tile *tile);
};

extern const struct recording_kernels recording_kernels;

#endif
