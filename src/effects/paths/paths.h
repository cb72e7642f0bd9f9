// paths.h: path tracing: light between surfaces. This header is the entry to this folder: other wings include only this
// header of the folder, and call only the functions that it declares (tests/structure.py).
//
// A path begins at a surface in a pixel and goes backwards along the light. At each surface, a ray to a light, to the
// environment or to an emitting triangle adds direct light, and another ray, in a direction that the material's lobes
// choose, finds the next surface. The CPU device finds the first surface and evaluates the materials at all surfaces as for
// local lighting. This folder chooses directions and weighs the light (docs/lighting/bounces.md).
//
// Paths advance together, as a stream. Each path's numbers depend only on its pixel, its number and its surfaces, and
// each path sums its own light, so no result depends on the other paths of a stream.
#ifndef PATHS_H
#define PATHS_H

#include "environment.h"
#include "frame.h"
#include "rays.h"

// The kinds of sources that a point chooses between, with fixed probabilities.
enum path_source { SOURCE_LIGHT, SOURCE_ENVIRONMENT, SOURCE_EMITTER, SOURCE_KINDS };

// Sources of light, for choosing one near a point (path_tree.h).
struct path_tree {
    struct path_node *nodes;
    uint32_t *item, *leaf; // the source at each leaf, and the leaf of each source
    uint32_t count, leaves;
};

// Data of a frame that all paths read.
struct path_frame {
    const struct frame *frame;
    const struct hierarchy *hierarchy;
    const struct ray_kernels *ray_kernels;
    const struct path_kernels *kernels;
    const struct environment_lookups *lookups;
    struct environment_view environment; // cube is NULL if there is none
    struct environment_samples samples;
    int bounces;
    float share[SOURCE_KINDS]; // the probability of each kind; 0 if there is none
    struct path_tree lights, emitters;
    const uint32_t *emitter; // for each emitting triangle, its number in the hierarchy
    // For each range, its first emitting triangle among all. For each range and side (2 range + back), whether rays aim
    // at it: the emission is the same at all points.
    const uint32_t *first_emitter;
    const bool *aimed;
    const bool *emits; // for each range and side, whether it may emit light
    bool caustics;     // whether glass refracts on all paths
    bool finds;        // whether a path's ray may find light: an environment, a sky, or emission
    struct buffer storage, sample_storage;
};

struct path {
    float through[3]; // the share of the light on the path's ray that reaches the eye
    float light[3];   // the light found so far
    // pi times the density with which the ray's direction was chosen. 0: no ray to a source could have found the light.
    float density;
    float emission_share;     // the share of the emission of the surface that the ray meets
    float distance;           // length of the ray, in world space
    float toward[3];          // direction of the ray in eye space
    float normal[3];          // of the ray's origin in world space, for path_tree.h
    uint32_t seed, number;    // of the pixel; of the path
    uint16_t bounces, events; // reflections so far; surfaces so far
    bool alive, straight, mirrored;
};

// A ray to a source, and the light that the path receives if nothing blocks the ray.
struct path_shadow {
    uint32_t path;
    float light[3];
};

enum { PATHS_AT_ONCE = 4096 };

// The paths that a thread traces together.
struct path_stream {
    int count;        // paths in use
    int shadow_count; // rays to sources
    struct path path[PATHS_AT_ONCE];
    struct path_ray ray[PATHS_AT_ONCE], shadow_ray[PATHS_AT_ONCE];
    struct path_shadow shadow[PATHS_AT_ONCE];
    struct ray_hit hit[PATHS_AT_ONCE], found[PATHS_AT_ONCE];
    float passed[PATHS_AT_ONCE][3];
    uint32_t order[PATHS_AT_ONCE], group[PATHS_AT_ONCE]; // paths that met a surface, sorted by range and side
    uint64_t key[PATHS_AT_ONCE];
    uint32_t slots[PATHS_AT_ONCE]; // 0, 1, 2 …
    double sum[3][PATHS_AT_ONCE];  // the light of each point's paths so far
    float rows[4][PATHS_AT_ONCE + 16];
    float color[3][PATHS_AT_ONCE + 16];
};

struct lit_point;
struct returned_light;
struct path_kernels {
    // Advances paths at as many points as there are lanes: adds the emission, sends a ray to a source, and chooses the
    // next ray. `paths` lists the path of each point; `left` is the number of points, if smaller than the lanes.
    void (*scatter)(const struct path_frame *frame, struct path_stream *stream, const struct lit_point *points,
                    const struct ray_starts *starts, int at, const uint32_t *paths, int left);
    // Sums the light that as many points as there are lanes reflect of an environment that nothing blocks, over `count`
    // directions of their lobes and all directions of `samples` (lam_draw_params.reference).
    void (*integrate)(const struct environment_view *view, const struct environment_lookups *lookups,
                      const struct lit_point *points, int count, struct returned_light *out);
};
// Returns the version with the given number of lanes (1, 4, 8, 16). NULL if the build has no effects.
const struct path_kernels *path_kernels_of(int lanes);

// Sets the sources. `hierarchy` and the functions must be set. Fails with LAM_LIMIT or LAM_CANCELLED.
bool path_frame_make(struct path_frame *paths, struct call_control *call, lam_error *error);
uint64_t path_frame_bytes(const struct path_frame *paths);
void path_frame_free(struct path_frame *paths);

// Starts path `number` of a pixel in a slot of the stream.
void path_start(struct path *path, float x, float y, uint32_t number);

// Advances all paths of a stream to their ends, after their first surfaces were scattered. `shade` calls scatter for the
// paths listed in `order`, which all met the same range and side. Returns false if the call must stop.
struct path_shader {
    void (*shade)(void *user, struct path_stream *stream, uint32_t group, const uint32_t *order, int count);
    void *user;
};
bool paths_trace(const struct path_frame *paths, struct path_stream *stream, struct light_rays *rays,
                 const struct path_shader *shader, struct call_control *call);

// The input of path_denoise, of one size (LAM_RGBA32F, without padding): two pictures of different paths, linear and
// premultiplied, and the normals, distances and base colours of the surfaces.
struct path_pictures {
    lam_image halves[2];
    lam_image normals, depths, colors;
};
struct pool;

// Writes the mean of the halves without its noise. Pixels without noise, and alpha, do not change. Fails with LAM_LIMIT
// or LAM_CANCELLED.
bool path_denoise(const struct path_pictures *in, lam_image *out, struct pool *pool, struct call_control *call,
                  lam_error *error);

#endif
