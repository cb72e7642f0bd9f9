// shade_frame.h: data of a frame that shading uses.
#ifndef SHADE_FRAME_H
#define SHADE_FRAME_H

#include "buffer.h"
#include "environment.h"
#include "frame.h"
#include "paths.h"
#include "visible_normals.h"

// The products of a light and a material for the sum of terms (docs/lighting.md).
struct light_products {
    float diffuse[3], specular[3]; // kd ⊙ Ld, ks ⊙ Ls
    float ambient[3];              // ka ⊙ La, used if ambient light is attenuated (gl1)
};
struct material_products {
    float ambient[3]; // ka ⊙ (La_global + Σ La)
    float emission[3];
    float diffuse[4];      // kd and opacity
    float reflectivity[3]; // kr
    float kd[3], ks[3];    // multiply the lights (frame_material_colors)
    bool mirrors;          // there is an environment, kr is not 0, and the material is classic
    const lam_material *given;
    unsigned maps;                       // the maps that shading uses, as bits 1 << LAM_MAP_…
    bool converted;                      // a metallic-roughness material with maps that is lit with a classic model
    float shininess;                     // after match_highlights and gl1
    int layers;                          // LAYER_…; 0 for a plain metallic-roughness surface or a classic material
    float stretch[2];                    // the unit direction of the anisotropy: its components along tangent and
                                         // bitangent
    const struct light_products *lights; // one for each light
    float (*sky)[3], (*ground)[3];       // ka ⊙ sky, ka ⊙ ground for each hemisphere light
};

// Multiplies all materials by all lights, once per frame. `storage` owns the products. Returns NULL on failure.
struct material_products *products_make(struct buffer *storage, const struct frame *frame, struct call_control *call,
                                        lam_error *error);

struct shade_frame {
    const struct frame *frame;
    const struct material_products *materials;
    const struct environment_light *environment_light; // the environment's light on physical materials, or NULL
    const struct environment_samples *reference;       // used instead of the split sum, or NULL
    const struct light_bounds *light_bounds;           // NULL if every light is evaluated everywhere
    const struct hierarchy *hierarchy;                 // NULL if no rays are traced
    const struct light_pattern *light_pattern;         // used for lights with a size
    const struct path_frame *paths;                    // NULL if lighting is local
    // The effects' functions for the lanes of the instruction set.
    const struct ray_kernels *ray_kernels;
    const struct environment_lookups *lookups;
    // ambient occlusion of each pixel; NULL if there is none or if rays compute it
    const struct screen_occlusion *occlusion;
    const struct occlusion_pattern *occlusion_pattern; // ambient occlusion by rays, or NULL
    const float *decode_srgb, *decode_linear;          // 256 entries each: the value of a colour byte
    struct visible_normals
        visible;               // for draws whose meshes have no normals; its set contains triangle numbers of the frame
    struct recorder *recorder; // records the explained pixel (recorder.h), otherwise NULL
};

// Returns the parts of an environment's light that the frame's materials use (environment_light.h).
unsigned environment_parts_of(const struct shade_frame *shade);

#endif
