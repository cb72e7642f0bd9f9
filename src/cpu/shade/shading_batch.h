// shading_batch.h: points side by side on their way through shading, and the scratch memory of shading.
#ifndef SHADING_BATCH_H
#define SHADING_BATCH_H

#include "layer_inputs.h"
#include "light_cull.h"
#include "opacity.h"
#include "texture_map.h"
#include "tile.h"
#include "work.h"

#include <stdbool.h>

// Rows are a little longer than a batch: the same entries of several rows then lie in different sets of the
// processor's cache.
enum { BATCH_MAX = 512, BATCH_ROW = BATCH_MAX + 16, LIGHT_BATCH = 256 };
_Static_assert((int)BATCH_ROW <= (int)TAPS_ROW, "the taps of a batch fit");

// Consecutive fragments that show the same triangle are a run. Rows hold what belongs to the triangle
// (triangle_runs.inc).
enum { RUN_CORNERS = 0, RUN_INTERPOLANT = 9, RUN_EXTRA = 18, RUN_ROWS = 21 };
struct triangle_runs {
    int count;
    uint32_t triangle[BATCH_MAX + LANES_MAX];
    int32_t first[BATCH_MAX];  // of LANES fragments: the run of the first
    int32_t offset[BATCH_MAX]; // of each fragment: its run, counted from there
    float row[RUN_ROWS][BATCH_MAX + LANES_MAX];
};

// Intermediate values of LIGHT_BATCH points for the current light, and the sums so far (light_loop.inc).
struct light_batch {
    _Alignas(64) float ambient[3][BATCH_ROW]; // each packet is a cache line
    float diffuse[3][BATCH_ROW], specular[3][BATCH_ROW];
    float f0[3][BATCH_ROW], rest[3][BATCH_ROW]; // Fresnel's factor of microfacet lobes
    float tint[3][BATCH_ROW];                   // of the light, by what it came through (frame.tints_rays)
    float kept_diffuse[3][BATCH_ROW], kept_specular[3][BATCH_ROW];
    float l[3][BATCH_ROW], distance[BATCH_ROW], arriving[BATCH_ROW];
    float share[BATCH_ROW];                    // of the arriving light: all where there is a highlight, else 0
    float base[BATCH_ROW];                     // of the packets listed below, one after the other
    float first[BATCH_ROW], second[BATCH_ROW]; // from one step to the next
    int packets[LIGHT_BATCH], packet_count;    // first points of the packets with a highlight
};

struct shading_batch {
    struct light_batch lit;
    float p[3][BATCH_ROW], n[3][BATCH_ROW], v[3][BATCH_ROW], t[3][BATCH_ROW];
    float color[3][BATCH_ROW], alpha[BATCH_ROW];    // of the vertices; after shading the result
    uint32_t triangle[BATCH_ROW];                   // of the mesh
    float x[BATCH_ROW], y[BATCH_ROW];               // the pixel's centre, in pixels of the window
    float sample_x[BATCH_ROW], sample_y[BATCH_ROW]; // the sample nearest to it, where a pixel has several
    float b1[BATCH_ROW], b2[BATCH_ROW];             // barycentric weights of corners 1 and 2
    float unoccluded[BATCH_ROW];                    // with ambient occlusion only: the share of light from around
    // Of materials with maps only (textures.inc).
    struct {
        float s[BATCH_ROW], t[BATCH_ROW], ds_dx[BATCH_ROW], dt_dx[BATCH_ROW], ds_dy[BATCH_ROW], dt_dy[BATCH_ROW];
    } texcoord;
    struct texture_taps taps;
    float texel[4][BATCH_ROW], level[BATCH_ROW];                   // of the map that was read last
    float vertex_color[3][BATCH_ROW], ambient_color[3][BATCH_ROW]; // what multiplies ka; `color` multiplies kd
    float specular[3][BATCH_ROW], emission[3][BATCH_ROW];          // what multiplies the highlights; the emission
    float power[BATCH_ROW], roughness[BATCH_ROW], metallic[BATCH_ROW], occlusion[BATCH_ROW];
    // The variance of the normals of base and coat within the pixel (lam_specular_aa).
    float variance[BATCH_ROW], coat_variance[BATCH_ROW];
    // Of materials with maps and layers (layered.inc): what the maps make of their numbers.
    struct {
#define NUMBER_ROW(member, field, map) float member[BATCH_ROW];
#define COLOR_ROWS(member, field, map) float member[3][BATCH_ROW];
        LAYER_MAPPED_NUMBERS(NUMBER_ROW)
        LAYER_MAPPED_COLORS(COLOR_ROWS)
#undef NUMBER_ROW
#undef COLOR_ROWS
        float clearcoat_normal[3][BATCH_ROW];               // of any length
        float stretch[2][BATCH_ROW], anisotropy[BATCH_ROW]; // by tangent and bitangent
    } layered;
    float through[3][BATCH_ROW]; // of surfaces that transmit: the share of what is behind them
    float bend[3][BATCH_ROW];    // and where the frame refracts, as fragments.bend
    float sign[BATCH_ROW];       // of the bitangent
    float rest[3][BATCH_ROW];    // as vertex_cache.rest
    struct triangle_runs runs;
};

// Gouraud and flat shading: the vertices (or triangles) shaded for a tile, found again by hashing.
struct vertex_cache {
    uint32_t *table;    // slot → vertex + 1; its size is a power of two, fitted to the group
    uint32_t (*key)[4]; // identity of a vertex: position, normal, colour, tangent element
    float (*color)[4];  // r, g, b, a
    // Of materials with maps: `color` is ambient and diffuse light, which the diffuse map multiplies, and this the rest
    // (specular, emission without a map, reflection).
    float (*rest)[3];
    uint32_t *run_vertex; // 3 for each run of fragments: the rows fragments->scratch
    uint32_t count;
};

// Where the shadow rays of a batch start, as in ray_lanes.
struct shadow_rows {
    double origin[3][BATCH_ROW], point[3][BATCH_ROW];
    int32_t own[BATCH_ROW];
};

// Scratch memory of one thread's shading, and its counters.
struct shading {
    struct shading_batch *batch;
    struct shadow_rows *shadows; // NULL: the frame has none
    struct ray_layers ray_layers;
    struct vertex_cache vertices;
    struct light_list lights;
    uint64_t points_lit, lights_evaluated, rays;
    struct work *work; // of the frame
};

#endif
