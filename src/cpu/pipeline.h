// pipeline.h: what the steps of the CPU device hand to each other.
//
//   vertices   positions → pixel x, y and depth key of every vertex           vertex_transform.inc
//   triangles  index triples → tile bins                                      bin.inc, clip.c
//   tiles      bins → depth key and triangle number of every sample           cover*.inc, occlusion.inc
//              translucent triangles → layers over the samples, blended       translucent_fragments.inc, blend.c
//              samples → fragments (a pixel and a triangle it shows)          visibility_resolve.inc, fragments.c
//              fragments → colours                                            shade.inc
//              colours → pixels of the picture                                resolve.inc
#ifndef PIPELINE_H
#define PIPELINE_H

#include "buffer.h"
#include "frame.h"
#include "light_bounds.h"
#include "pool.h"
#include "samples.h"
#include "visible_normals.h"
#include "call_control.h"

enum {
    TILE = 64, // pixels on a side; the same on every machine
    TILE_SHIFT = 6,
    SUBPIXEL = 256, // steps of a snapped vertex in a pixel
    SUBPIXEL_SHIFT = 8,
    LANES_MAX = 16,
    VERTEX_PIECE = 8192, // vertices and triangles in one piece of parallel work
    TRIANGLE_PIECE = 4096,
    SMALL = TILE * SUBPIXEL, // triangles up to this extent have edge functions in 32 bits
    LAYERS_MAX = 65536, // fragments of translucent surfaces held at once by a thread, and so the most over one pixel
};

#define NOTHING   0xffffffffu // a sample that no triangle covers
#define BACK_SIDE 0x80000000u // in a visibility number: the triangle shows its back
#define CLIPPED   0x80000000u // in a bin: the number of a clipped piece, not of a triangle

// A vertex that the fast path cannot use has x = NaN whose low bits say why: outside of which planes it lies.
enum outside {
    OUTSIDE_LEFT = 1,
    OUTSIDE_RIGHT = 2,
    OUTSIDE_TOP = 4,
    OUTSIDE_BOTTOM = 8,
    OUTSIDE_NEAR = 16,
    OUTSIDE_FAR = 32,
    OUTSIDE_ALL = 63,
};
#define OUTSIDE_NAN 0x7fc00000

// A piece of a triangle that was clipped: its own window coordinates, and the triangle that it belongs to.
struct clipped_piece {
    float x[3], y[3], key[3];
    uint32_t id;
    bool back;
};

// A run of vertices or triangles of one draw.
struct piece {
    uint32_t draw, first, count;
};

// Bins: for each tile two chains of blocks with triangle numbers, small ones that show their back and all
// others. Every thread has its own, so no locks are taken; the picture does not depend on the order in which
// a tile's triangles come. Backs are drawn last, since most are hidden by then, and carry a bound that tells
// it (occlusion.inc).
enum {
    TILE_BINS = 2,       // of tile t: 2·t, and 2·t + 1 with backs
    BIN_BLOCK_IDS = 128, // multiples of LANES_MAX: whole packets can be read
    BIN_BLOCK_BACKS = 64,
};
struct bin_block {
    struct bin_block *next;
    uint32_t count;
    uint32_t ids[BIN_BLOCK_IDS]; // of backs BIN_BLOCK_BACKS, then as many bounds
};

// Memory in slabs that never move: blocks and clipped pieces of one thread.
struct slab_list {
    void **slabs;
    int count, room; // slabs held
    int current;     // the slab being filled
    size_t used;     // bytes of it
};

// A pixel's fragment of a translucent surface, to be put in order for one sample: the larger rank is nearer.
struct layer {
    uint64_t rank;
    uint32_t fragment;
};

// Pixels of a tile, both ends included.
struct rectangle {
    int left, top, right, bottom;
};

// Points about to be lit, side by side, and in the end their colours.
// Rows are a little longer than the points at once: the same places of several rows then lie in different
// sets of the processor's cache.
enum { POINTS_AT_ONCE = 512, POINT_ROW = POINTS_AT_ONCE + 16 };

// Fragments beside each other that show the same triangle are a run: rows of what belongs to the triangle (triangle_runs.inc).
enum { RUN_CORNERS = 0, RUN_SPANNED = 9, RUN_MORE = 18, RUN_ROWS = 21 };
struct runs {
    int count;
    uint32_t triangle[POINTS_AT_ONCE + LANES_MAX];
    int32_t first[POINTS_AT_ONCE]; // of LANES fragments, the first one's run
    int32_t from[POINTS_AT_ONCE];  // each fragment's, counted from there
    float row[RUN_ROWS][POINTS_AT_ONCE + LANES_MAX];
};

struct shading_batch {
    float p[3][POINT_ROW], n[3][POINT_ROW], v[3][POINT_ROW], t[3][POINT_ROW];
    float color[3][POINT_ROW], alpha[POINT_ROW];    // of the vertices, then as seen
    uint32_t triangle[POINT_ROW];                   // of the mesh
    float x[POINT_ROW], y[POINT_ROW];               // the pixel's centre, in pixels of the window
    float sample_x[POINT_ROW], sample_y[POINT_ROW]; // the sample nearest to it, where a pixel has several
    float b1[POINT_ROW], b2[POINT_ROW];             // weights of its corners 1 and 2
    struct runs runs;
};

// The lights that some points are lit by (light_cull.inc).
struct light_choice {
    uint32_t *numbers; // in the frame, ascending
    int count;
    uint64_t *bits; // of every light of the frame: whether it is among them
    float *most;    // while they are chosen: the most that each can add
};

struct thread_state {
    struct bin_block **bins; // first block of each bin, newest first
    struct slab_list blocks;
    struct slab_list pieces;
    uint32_t piece_count;

    // One tile's visibility, each sample's: in cells.
    float *keys;
    uint32_t *ids;
    // One tile's fragments, in the order of pixels.
    uint32_t *fragment_id;    // with BACK_SIDE
    uint16_t *fragment_pixel; // y·TILE + x
    uint8_t *fragment_weight; // samples
    uint8_t *fragment_sample; // the covered one nearest to the centre
    uint32_t *fragment_group; // surface·2 + back
    uint32_t *order;          // fragments sorted by group
    float *fragment_color[4]; // r, g, b, a; not premultiplied
    int fragment_count;
    // Gouraud and flat shading: the points lit in this tile, found again by hashing.
    uint32_t *point_table;    // slot → point + 1; a power of two of them, fitted to the group
    uint32_t (*point_key)[4]; // what makes a point: position, normal, colour, tangent element
    uint32_t *fragment_point; // 3 per run of fragments
    float (*point_color)[4];  // r, g, b, a of each
    uint32_t point_count;
    struct shading_batch *points;
    struct light_choice choice;
    int32_t *counts; // triangles that cover each sample; NULL: nobody asks (output.c)
    float *shown;    // the tile's part of the picture, for LAM_OUTPUT_CLIPPED
    // Sums of a tile's pixels: r, g, b premultiplied, and alpha.
    float *sum[4];

    // Translucent surfaces; room is made only for frames that have any. Their fragments use the arrays above, before
    // the opaque ones do: one for each pixel and triangle, with the samples that show it.
    uint32_t translucent_triangles; // binned in this tile
    bool layers_clipped;            // among the gathered are pieces of clipped triangles, that may share a pixel
    uint16_t *layer_samples;        // of each fragment, a bit each
    float *layer_keys;              // of each fragment, one for each sample
    uint32_t *layer_order;          // fragments in the order of pixels
    uint32_t *layer_start;          // of each pixel, in layer_order; one more at the end
    struct layer *layers;           // of one pixel
    float *clear;                   // what the layers over each sample let through

    struct buffer scratch; // holds the arrays above but the slabs
    uint64_t coverage_ns, lighting_ns, resolve_ns, pixels_covered, points_lit, lights_evaluated, triangles_binned;
};

// A light against a material: the products that the sum needs (conventions, "The sum").
struct light_products {
    float diffuse[3], specular[3]; // kd ⊙ Ld, ks ⊙ Ls
    float ambient[3];              // ka ⊙ La, where it is attenuated (gl1)
};
struct material_products {
    float ambient[3]; // ka ⊙ (La_global + Σ La)
    float emission[3];
    float diffuse[4]; // kd and opacity, for painting unlit
    float shininess;
    float reflectivity[3]; // kr
    bool mirrors;          // there is an environment, and kr is not 0
    bool fibre;
    const struct light_products *lights; // one for each light
    float (*sky)[3], (*ground)[3];       // ka ⊙ sky, ka ⊙ ground for each hemisphere
};

struct kernels;

// What is kept of a tile's fragments while normals are made for all that is seen.
struct fragment_store {
    int count;
    uint32_t lowest; // of their triangles' numbers
    bool narrow;     // the others follow within 23 bits
    void *fragments;
};

struct cpu_frame {
    const struct frame *frame;
    const struct kernels *kernels;
    const struct sample_pattern *pattern;
    lam_image *image;
    struct call_control *call;
    struct pool *pool;
    int tiles_across, tiles_down;
    // |x|, |y| of a vertex up to which the fast path takes it, in multiples of w, about the window's middle
    float guard[2];
    float *vertices;              // of all draws, x, y, key of each: pixels (y down, not snapped), and larger is nearer
    const uint32_t *first_vertex; // of each draw
    const struct piece *vertex_pieces, *triangle_pieces;
    const struct material_products *materials;
    const struct light_bounds *lights; // NULL: every light is evaluated everywhere
    struct thread_state *threads;
    const float *decode_srgb, *decode_linear; // 256 entries each: what a colour byte stands for
    struct recorder *recorder; // of the one pixel that is explained (recorder.h), in the recording kernels; else NULL
    struct seen_normals seen;  // of draws whose meshes have none; its set is of the frame's triangle numbers
    struct fragment_store *fragment_stores; // of each tile; NULL: tiles are drawn in one go
    uint8_t empty_pixel[16];                // what a pixel without fragments holds
    int failed;                             // enum failure, set atomically by a worker
};

enum failure {
    FAILED_NOT = 0,
    FAILED_MEMORY, // out of memory
    FAILED_LAYERS, // more than LAYERS_MAX translucent triangles over one pixel
};

// A block for one more bin, space for one more clipped piece; NULL: out of memory (cpu->failed is set).
struct bin_block *new_bin_block(struct cpu_frame *cpu, struct thread_state *thread);
struct clipped_piece *new_clipped_piece(struct cpu_frame *cpu, struct thread_state *thread, uint32_t *number);
const struct clipped_piece *clipped_piece(const struct thread_state *thread, uint32_t number);
size_t slabs_bytes(const struct slab_list *list);
size_t slabs_free(struct slab_list *list); // how many bytes that were

// Whether any triangle is in a tile's bins.
static inline bool tile_has_triangles(const struct cpu_frame *cpu, size_t tile)
{
    for (int i = 0; i < pool_threads(cpu->pool); i++)
        for (int b = 0; b < TILE_BINS; b++)
            if (cpu->threads[i].bins[tile * TILE_BINS + (size_t)b])
                return true;
    return false;
}

// The block of a bin that takes `room` numbers more; NULL: out of memory.
static inline struct bin_block *bin_with_room(struct cpu_frame *cpu, struct thread_state *thread, int bin,
                                              uint32_t room)
{
    struct bin_block *block = thread->bins[bin];
    if (block && block->count + room <= (bin & 1 ? BIN_BLOCK_BACKS : BIN_BLOCK_IDS))
        return block;
    struct bin_block *fresh = new_bin_block(cpu, thread);
    if (!fresh)
        return NULL;
    fresh->next = block;
    fresh->count = 0;
    return thread->bins[bin] = fresh;
}

// Appends a number to a bin, and its bound if it is one of backs.
static inline void bin_put(struct cpu_frame *cpu, struct thread_state *thread, int bin, uint32_t id, uint32_t bound)
{
    struct bin_block *block = bin_with_room(cpu, thread, bin, 1);
    if (!block)
        return;
    if (bin & 1)
        block->ids[BIN_BLOCK_BACKS + block->count] = bound;
    block->ids[block->count++] = id;
}

// Snapped coordinates of a triangle's corners, in the order that makes its area positive with y down.
struct snapped {
    int32_t x[3], y[3];
};

// Bins a triangle of any size by its snapped corners: only tiles it can touch.
void bin_large(struct cpu_frame *cpu, struct thread_state *thread, const struct snapped *corners, uint32_t id);

// Clips triangle t of a draw (id is its number) against the planes its corners violate, and bins the pieces.
void clip_triangle(struct cpu_frame *cpu, struct thread_state *thread, const struct frame_draw *draw, uint32_t t,
                   uint32_t id);

// For frames that make normals (frame.h): finds the triangles that the frame shows, and makes the normals of
// those. Where the opaque ones are all there is, each tile's fragments are found on the way and kept; else
// every triangle that is in a bin counts. The memory is the device's, and lasts from frame to frame but for
// the fragment_stores.
struct seeing_room {
    struct buffer sets, normals, fragment_stores;
    struct buffer *vertices; // of the device: normals may lie there once the tiles are searched
    struct arena *arenas;    // of each thread, for the fragment_stores
    double search_ms;        // of the last frame: finding what the tiles show
};
bool see_triangles(struct cpu_frame *cpu, struct seeing_room *room, lam_error *error);
void seeing_room_empty(struct seeing_room *room, int threads); // ends the fragment_stores

// Finds the groups of the listed fragments, and their order by group.
void group_fragments(const struct frame *frame, struct thread_state *thread);

// Gathers, lights and blends the translucent fragments of a tile that lie before the opaque ones: into the thread's
// sums (premultiplied) and `clear`.
void blend_tile(struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y, int width, int height);

// What the picture holds where it shows numbers (lam_output): the pixels of a tile, in place of the kernels' resolve, and
// a pixel without fragments.
void show_tile(const struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y, int width, int height);
void show_empty(struct cpu_frame *cpu);

// Rounds to the nearest 1/256 pixel.
static inline int32_t snap(float x)
{
    float t = x * 256.0f + 0.5f;
    int32_t i = (int32_t)t;
    return i - ((float)i > t);
}

// The three corners' elements of an attribute with its own index array, or the positions' one, or none.
static inline uint32_t corner_element(const uint32_t *own, const uint32_t *shared, uint32_t corner)
{
    return own ? own[corner] : shared ? shared[corner] : corner;
}

// A tile's visibility arrays are cut into cells of CELL samples: of as square a part of the tile as has so many, so
// that small triangles touch few. Within a cell pixels lie row by row, and a pixel's samples side by side.
enum { CELL = 16 };
struct cells {
    int x_shift, y_shift; // a cell's width and height in pixels: 1 << shift
    int across;           // cells in a row of the tile
    int samples;          // of a pixel
};
static inline struct cells cells_of(int samples)
{
    int x_shift = samples <= 2 ? 2 : samples <= 8 ? 1 : 0, y_shift = samples == 1 ? 2 : samples <= 4 ? 1 : 0;
    return (struct cells){x_shift, y_shift, TILE >> x_shift, samples};
}

// Where a pixel's samples begin.
static inline int pixel_place(const struct cells *cells, int x, int y)
{
    int cell = (y >> cells->y_shift) * cells->across + (x >> cells->x_shift);
    int column = x & ((1 << cells->x_shift) - 1), row = y & ((1 << cells->y_shift) - 1);
    return cell * CELL + ((row << cells->x_shift) + column) * cells->samples;
}

// The most opaque fragments that a tile can have.
static inline int fragments_of_tile(int samples) { return TILE * TILE * samples; }

#endif
