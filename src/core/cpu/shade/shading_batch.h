// shading_batch.h: batches of points that are shaded together, and the scratch memory for shading.
#ifndef SHADING_BATCH_H
#define SHADING_BATCH_H

#include "layer_inputs.h"
#include "light_cull.h"
#include "rays.h"
#include "texture_map.h"
#include "tile.h"
#include "work.h"

#include <stdbool.h>

// Rows are slightly longer than a batch, so that the same entries of several rows are in different sets of the
// processor's cache.
enum { BATCH_MAX = 512, BATCH_ROW = BATCH_MAX + 16, LIGHT_BATCH = 256 };
_Static_assert((int)BATCH_ROW <= (int)RAY_STARTS_MAX, "ray_starts has space for a batch");
_Static_assert((int)BATCH_ROW <= (int)TAPS_ROW, "texture_taps has space for a batch");

// Consecutive fragments that show the same triangle form a run. The rows contain the triangle's data
// (triangle_runs.inc).
enum { RUN_CORNERS = 0, RUN_INTERPOLANT = 9, RUN_EXTRA = 18, RUN_ROWS = 21 };
struct triangle_runs {
    int count;
    uint32_t triangle[BATCH_MAX + LANES_MAX];
    int32_t first[BATCH_MAX];  // for each group of LANES fragments, the run of its first fragment
    int32_t offset[BATCH_MAX]; // for each fragment, its run minus the run in `first`
    float row[RUN_ROWS][BATCH_MAX + LANES_MAX];
};

// Intermediate values of LIGHT_BATCH points for the current light, and the sums so far (light_loop.inc).
struct light_batch {
    _Alignas(64) float ambient[3][BATCH_ROW]; // each packet is a cache line
    float diffuse[3][BATCH_ROW], specular[3][BATCH_ROW];
    float f0[3][BATCH_ROW], rest[3][BATCH_ROW]; // Fresnel factor of microfacet lobes
    // the colour of the light after it has passed through surfaces (frame.tints_rays)
    float tint[3][BATCH_ROW];
    float kept_diffuse[3][BATCH_ROW], kept_specular[3][BATCH_ROW];
    float l[3][BATCH_ROW], distance[BATCH_ROW], arriving[BATCH_ROW];
    // `arriving` if there is a highlight, otherwise 0
    float share[BATCH_ROW];
    float base[BATCH_ROW];                     // the bases of the packets listed in `packets`, stored consecutively
    float first[BATCH_ROW], second[BATCH_ROW]; // values passed from one step to the next
    int packets[LIGHT_BATCH], packet_count;    // the first point of each packet with a highlight
};

struct shading_batch {
    struct light_batch lit;
    float p[3][BATCH_ROW], n[3][BATCH_ROW], v[3][BATCH_ROW], t[3][BATCH_ROW];
    float color[3][BATCH_ROW], alpha[BATCH_ROW]; // input: the vertices' colours; output: the lit colours
    uint32_t triangle[BATCH_ROW];                // index in the mesh
    float x[BATCH_ROW], y[BATCH_ROW];            // the pixel's centre, in pixels of the window
    // with several samples per pixel: the fragment's sample nearest to the centre
    float sample_x[BATCH_ROW], sample_y[BATCH_ROW];
    float b1[BATCH_ROW], b2[BATCH_ROW]; // barycentric weights of corners 1 and 2
    // set only with ambient occlusion: the fraction of the surrounding light that is not occluded
    float unoccluded[BATCH_ROW];
    // Set only for materials with maps (textures.inc).
    struct {
        float s[BATCH_ROW], t[BATCH_ROW], ds_dx[BATCH_ROW], dt_dx[BATCH_ROW], ds_dy[BATCH_ROW], dt_dy[BATCH_ROW];
    } texcoord;
    struct texture_taps taps;
    float texel[4][BATCH_ROW], level[BATCH_ROW];                   // the texel of the map that was read last
    float vertex_color[3][BATCH_ROW], ambient_color[3][BATCH_ROW]; // multiplies ka; `color` multiplies kd
    float specular[3][BATCH_ROW], emission[3][BATCH_ROW];          // `specular` multiplies the highlights
    float power[BATCH_ROW], roughness[BATCH_ROW], metallic[BATCH_ROW], occlusion[BATCH_ROW];
    // The variance of the normals of base and coat within the pixel (lam_specular_aa).
    float variance[BATCH_ROW], coat_variance[BATCH_ROW];
    // For materials with maps and layers (layered.inc): the layers' values after the maps are applied.
    struct {
#define NUMBER_ROW(member, field, map) float member[BATCH_ROW];
#define COLOR_ROWS(member, field, map) float member[3][BATCH_ROW];
        LAYER_MAPPED_NUMBERS(NUMBER_ROW)
        LAYER_MAPPED_COLORS(COLOR_ROWS)
#undef NUMBER_ROW
#undef COLOR_ROWS
        float clearcoat_normal[3][BATCH_ROW];               // not normalized
        float stretch[2][BATCH_ROW], anisotropy[BATCH_ROW]; // along tangent and bitangent
    } layered;
    float through[3][BATCH_ROW]; // transmittance of surfaces
    float bend[3][BATCH_ROW];    // the same as fragments.bend, if the frame is rendered with refraction
    float sign[BATCH_ROW];       // sign of the bitangent
    float rest[3][BATCH_ROW];    // same as vertex_cache.rest
    struct triangle_runs runs;
};

// The light that reaches the fragments of a batch, for the first lights that have a size and cast shadows. Other lights
// are traced for each fragment on its own.
enum { SHADOW_LIGHTS = 16 };
struct shadow_rows {
    int count; // 0 for vertices
    const struct frame_light *light[SHADOW_LIGHTS];
    uint8_t weight[SHADOW_LIGHTS][BATCH_ROW];
    float passed[SHADOW_LIGHTS][3][RAY_STARTS_MAX]; // only the first row is used unless the frame tints rays
    struct ray_scratch scratch;
};

// For Gouraud and flat shading: a hash table of the vertices (or triangles) that are shaded for a tile.
struct vertex_cache {
    uint32_t *table;    // slot → vertex + 1; its size is a power of two, chosen for each group
    uint32_t (*key)[4]; // identity of a vertex: position, normal, colour, tangent element
    float (*color)[4];  // r, g, b, a
    // For materials with maps, `color` is the ambient and diffuse light, which the diffuse map multiplies. `rest` is
    // all other light: the highlights, the reflection, and the emission if no map multiplies the emission.
    float (*rest)[3];
    uint32_t *run_vertex; // three vertices for each run of fragments, stored in fragments->scratch
    uint32_t count;
};

// Scratch memory and counters for the shading of one thread.
struct shading {
    struct shading_batch *batch;
    struct ray_starts *starts;   // NULL if the frame traces no rays
    struct shadow_rows *shadows; // NULL if vertices are shaded, or no shadows are cast
    struct ray_layers ray_layers;
    // Only for paths: the paths of a batch, and the points that they meet.
    struct path_stream *stream;
    struct shading_batch *hit_batch;
    struct ray_starts *hit_starts;
    struct vertex_cache vertices;
    struct light_list lights;
    uint64_t points_lit, lights_evaluated, rays;
    struct work *work;  // the frame's work
    uint64_t uncounted; // units of work that have not been added to `work` yet
};

#endif
