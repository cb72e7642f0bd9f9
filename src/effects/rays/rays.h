// rays.h: rays from lit points, for shadows and ambient occlusion. This header is the entry to this folder: other wings
// include only this header of the folder, and call only the functions that it declares (tests/structure.py).
#ifndef RAYS_H
#define RAYS_H

#include "hierarchy.h"
#include "light_pattern.h"
#include "occlusion_pattern.h"
#include "opacity.h"
#include "visible_normals.h"

// --- the triangles that block rays

// Sets the members that rays need, and determines whether any light casts shadows. The draws and lights must have been
// built.
void frame_rays_build(struct frame *frame, const lam_scene *scene, const lam_mat4 *view);

// Builds the hierarchy of a frame, unless the existing one has the same meshes at the same positions. Stores in *built
// whether a hierarchy was built. Fails with LAM_LIMIT (memory, time) or LAM_CANCELLED.
const struct hierarchy *hierarchy_of_frame(struct hierarchy_memory *memory, const struct frame *frame,
                                           struct pool *pool, struct call_control *call, bool *built, lam_error *error);
void hierarchy_free(struct hierarchy_memory *memory);
uint64_t hierarchy_bytes(const struct hierarchy_memory *memory);

// The first function gets the linear colour, with alpha, of a corner. The mesh must have colours. The second function
// gets the texture coordinates of a corner from the set with the number `set`, or returns false if the mesh lacks this
// set. Corners are numbered over all triangles.
void ray_corner_color(const lam_mesh *mesh, uint32_t corner, float out[4]);
bool ray_corner_texcoord(const lam_mesh *mesh, int set, uint32_t corner, float out[2]);

// --- rays of a batch of points

// `count` is the number of rays to each light with a size, 1 … LIGHT_POINTS_MAX.
void light_pattern_fill(struct light_pattern *pattern, int count);
// `count` is the number of rays from each point, 1 … OCCLUSION_RAYS_MAX.
void occlusion_pattern_fill(struct occlusion_pattern *pattern, int count);

// The input of rays, and counters.
struct light_rays {
    const struct frame *frame;
    const struct hierarchy *hierarchy;
    const struct light_pattern *pattern;       // used for lights with a size
    const struct occlusion_pattern *occlusion; // used for ambient occlusion
    struct ray_layers *layers;
    uint64_t sent;  // number of traced rays
    bool scattered; // few of the rays that are traced together have nearly the same direction
};

// The draw that contains the points, and the side that is lit.
struct ray_surface {
    const struct frame_draw *draw;
    const float *normals;                  // NULL if face normals are used
    const struct visible_normals *visible; // computed for the frame; NULL if the mesh's own normals are used
    bool back;
};

// Points of a batch: the triangles that contain them, with the barycentric weights of corners 1 and 2, and the centres
// of their pixels. For vertices, `elements` lists the positions instead.
struct ray_points {
    int count;
    const uint32_t *triangle, *elements;
    const float *b1, *b2, *x, *y;
};

// The start points of the rays of a batch.
enum { RAY_STARTS_MAX = 528 };
struct ray_starts {
    double origin[3][RAY_STARTS_MAX]; // where a ray starts
    double point[3][RAY_STARTS_MAX];  // the point itself; on a smooth surface, `origin` is moved outward
    int32_t own[RAY_STARTS_MAX];      // the triangle that the ray starts on, or NO_TRIANGLE
};

// Computes the start points of the rays. Rays from the position of a vertex start exactly there, so that the triangles
// around the vertex do not shadow it. The rows are padded to a multiple of `lanes` with the last point.
void ray_starts_find(const struct light_rays *rays, const struct ray_surface *surface, const struct ray_points *points,
                     int lanes, struct ray_starts *starts);

// Fragments of a batch for which the light that passes is computed together, with their pixels.
struct ray_pixels {
    int count;
    const float *x, *y; // the pixel's centre, in pixels
    // The cosine of the angle between the light and the normal, times 255. 0: the light cannot reach the fragment.
    const uint8_t *weight;
    struct ray_scratch *scratch;
};

// Scratch memory for the light of a batch (penumbra.h).
enum { BLOCKERS_MAX = 1024 };
struct ray_scratch {
    double direction[3][RAY_STARTS_MAX], u[3][RAY_STARTS_MAX], v[3][RAY_STARTS_MAX]; // to the light, axes of its disc
    float probes[RAY_STARTS_MAX], probed[RAY_STARTS_MAX]; // first rays of a fragment: number, and sum of light
    uint32_t blockers[BLOCKERS_MAX], may[BLOCKERS_MAX];   // triangles between the light and a cell
    float corners[BLOCKERS_MAX][3][3];                    // of these triangles, relative to the cell's middle
};

// A ray of a path of light, in the hierarchy's space. `straight` means that glass tints the ray without bending it;
// otherwise the ray ends at glass.
struct path_ray {
    double origin[3], point[3]; // as in ray_starts
    double direction[3], end;   // `end` in lengths of the direction
    int32_t own;
    uint32_t seed; // decides which translucent surfaces the ray passes
    bool straight;
};

// The nearest surface on a ray.
struct ray_hit {
    uint32_t number, range; // the triangle in the frame, NO_TRIANGLE if there is none; its range
    bool back;              // the ray meets the triangle's back
    float b1, b2;           // weights of corners 1 and 2
    float distance;         // in world space
    float area_per_angle;   // area of the surface per solid angle, in the hierarchy's space
    float passed[3];        // factor of the light on this ray, from translucent surfaces
};

// The functions that trace several rays at a time, compiled for each instruction set.
struct ray_kernels {
    // Computes the share of a light that reaches the active ones of the points `at` … `at` + lanes − 1: a row of
    // `lanes` numbers, or three rows (red, green, blue) if a material of the frame tints light (frame.tints_rays).
    void (*pass)(struct light_rays *rays, const struct ray_starts *starts, int at, const struct frame_light *light,
                 unsigned active, float *passed);
    // Computes the share of a light with a size that reaches the wanted fragments: a row of RAY_STARTS_MAX numbers, or
    // three rows as above. Fragments of neighbouring pixels share rays (penumbra.h).
    void (*pass_pixels)(struct light_rays *rays, const struct ray_starts *starts, const struct ray_pixels *pixels,
                        const struct frame_light *light, float passed[3][RAY_STARTS_MAX]);
    // Computes the fraction of each point's surroundings that is not occluded. A ray through translucent surfaces
    // contributes their transmittance.
    void (*occlude)(struct light_rays *rays, const struct ray_surface *surface, const struct ray_starts *starts,
                    const struct ray_points *points, float *unoccluded);
    // Finds the nearest surface on each ray. A translucent surface is either met or passed; the mean over many seeds is
    // right.
    void (*nearest)(struct light_rays *rays, const struct path_ray *from, int count, struct ray_hit *hits);
    // Computes the light (red, green, blue) that passes along each ray.
    void (*pass_along)(struct light_rays *rays, const struct path_ray *from, int count, float (*passed)[3]);
    // Finds the triangle nearest to a point that blocks light on the way to a light, and its distance in world space.
    // Returns NO_TRIANGLE if there is none. Only the version with one lane has this function.
    int64_t (*blocker)(struct light_rays *rays, const struct ray_starts *starts, int at,
                       const struct frame_light *light, double *distance);
};
// Returns the version with the given number of lanes (1, 4, 8, 16). NULL if the build has no effects.
const struct ray_kernels *ray_kernels_of(int lanes);

#endif
