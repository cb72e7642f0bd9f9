// shade_frame.h: what shading reads of a frame.
#ifndef SHADE_FRAME_H
#define SHADE_FRAME_H

#include "buffer.h"
#include "environment_samples.h"
#include "frame.h"
#include "visible_normals.h"

// A light against a material: the products that the sum needs (conventions, "The sum").
struct light_products {
    float diffuse[3], specular[3]; // kd ⊙ Ld, ks ⊙ Ls
    float ambient[3];              // ka ⊙ La, where it is attenuated (gl1)
};
struct material_products {
    float ambient[3]; // ka ⊙ (La_global + Σ La)
    float emission[3];
    float diffuse[4];      // kd and opacity, for unlit painting
    float reflectivity[3]; // kr
    bool mirrors;          // there is an environment, kr is not 0, and the material is a classic one
    const lam_material *given;
    unsigned maps;                       // those that shading reads: a bit 1 << LAM_MAP_… for each
    bool converted;                      // with maps: a metallic-roughness material under a classic model
    float shininess;                     // in use
    int layers;                          // LAYER_…; 0: a metallic-roughness surface alone, or a classic material
    float stretch[2];                    // of anisotropy: the direction by tangent and bitangent, unit
    const struct light_products *lights; // one for each light
    float (*sky)[3], (*ground)[3];       // ka ⊙ sky, ka ⊙ ground for each hemisphere
};

// Multiplies all materials by all lights, once for the frame. The storage keeps the products. NULL: it failed.
struct material_products *products_make(struct buffer *storage, const struct frame *frame, struct call_control *call,
                                        lam_error *error);

struct shade_frame {
    const struct frame *frame;
    const struct material_products *materials;
    const struct environment_light *environment_light; // of physical materials; NULL: none
    const struct environment_samples *reference;       // in place of it; NULL: none
    const struct light_bounds *light_bounds;           // NULL: every light is evaluated everywhere
    const struct hierarchy *hierarchy;                 // NULL: no rays
    const struct light_pattern *light_pattern;         // of lights with a size
    const struct screen_occlusion *occlusion;          // ambient occlusion of each pixel; NULL: none, or by rays
    const struct occlusion_pattern *occlusion_pattern; // ambient occlusion by rays; NULL: none
    const float *decode_srgb, *decode_linear;          // 256 entries each: the value of a colour byte
    struct visible_normals
        visible;               // of draws whose meshes have no normals; its set holds triangle numbers of the frame
    struct recorder *recorder; // of the pixel that is explained (recorder.h); else NULL
};

// The parts of an environment's light that the frame's materials read (environment_light.h).
unsigned environment_parts_of(const struct shade_frame *shade);

#endif
