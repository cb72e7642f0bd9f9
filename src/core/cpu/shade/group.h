// group.h: the points of one surface that are shaded together, and the rows that shade.c and lights.c exchange. Define
// LANES before including this file.
#ifndef GROUP_H
#define GROUP_H

#include "fragments.h"
#include "shade_frame.h"
#include "shading_batch.h"

#include "layer_kinds.h"
#include "prelude_c.h"
#include "surface.h"

// The fragments of one surface and side, and all data for shading them.
struct group {
    const struct shade_frame *shade;
    const struct frame *frame;
    struct fragments *fragments;
    struct shading *shading;
    const struct tile *tile;
    const struct frame_draw *draw;
    const lam_mesh *mesh;
    const struct material_products *material;
    const float *decode;         // colour byte → linear light
    const float *share;          // alpha byte → 0…1
    bool flip;                   // the back side, lit with −n
    bool translucent;            // the fragments are layers
    bool blends;                 // the fragments may have an alpha below 1
    bool catches;                // the ground that catches shadows: alpha is the missing fraction of light
    bool separate_texture_terms; // colours of vertices are interpolated, and maps multiply only some of their terms
    bool maps_emission;          // additionally, an emission map multiplies the emission at each fragment
    bool has_map_rows;           // the rows of a batch contain the material's values after maps
    bool widens;                 // the rows also contain the roughness widened by the variance of normals
                                 // (lam_specular_aa)
    lam_reflection reflection;
    uint32_t first_id;
    const float *normals;                  // NULL if face normals are used
    const struct visible_normals *visible; // computed for the frame; NULL if the mesh's own normals are used
    const struct light_list *lights;       // NULL if all lights of the frame are used
    const struct hierarchy *hierarchy;     // NULL if no rays are traced
    bool tangents;                         // the reflection model, the material or the output needs tangents
    bool occlusion;                        // if false, all surrounding light arrives
    bool traced;                           // paths find the light
    float shift[2];                        // from the centres of pixels to the shaded points, in pixels
    struct recorder *recorder;
};

static inline bool reads_map(const struct group *g, lam_map map) { return g->material->maps >> map & 1; }

// Returns the fraction of the surrounding light that is not occluded, at LANES points.
LANE_FN num unoccluded_share(const struct group *g, const struct shading_batch *batch, int at)
{
    return g->occlusion ? num_load(batch->unoccluded + at) : num_of(1.0f);
}

// Gets what the rays of the group's points need.
static inline struct light_rays light_rays_of(const struct group *g)
{
    return (struct light_rays){.frame = g->frame,
                               .hierarchy = g->hierarchy,
                               .pattern = g->shade->light_pattern,
                               .occlusion = g->shade->occlusion_pattern,
                               .layers = &g->shading->ray_layers};
}

LANE_FN num row3(const float row[3], vec3 v) { return (row[0] * v.x + row[1] * v.y) + row[2] * v.z; }

// Loads and stores vectors in the rows of a batch.
LANE_FN vec3 load3(float rows[3][BATCH_ROW], int at)
{
    return (vec3){num_load(rows[0] + at), num_load(rows[1] + at), num_load(rows[2] + at)};
}

LANE_FN void store3(float rows[3][BATCH_ROW], int at, vec3 v)
{
    num_store(rows[0] + at, v.x);
    num_store(rows[1] + at, v.y);
    num_store(rows[2] + at, v.z);
}

LANE_FN surface load_surface(struct shading_batch *batch, int at)
{
    return (surface){load3(batch->p, at), load3(batch->n, at), load3(batch->v, at), load3(batch->t, at)};
}

#include "record.h"

// Finds the light that reaches the fragments of a batch from lights with a size (lights.c).
void FOR_ISA(find_shadows)(const struct group *g, struct shading_batch *batch, int count);
// Lights the points of a batch (lights.c): replaces the vertex colours in its rows with the shaded colours.
void FOR_ISA(light_points)(const struct group *g, struct shading_batch *batch, int count);
// Scatters paths at the points of a batch (lights.c).
void FOR_ISA(scatter_points)(const struct group *g, struct shading_batch *batch, int count, int rounds,
                             const uint32_t *slots);

#endif
