// lambent/explain.h: explains one pixel of a picture: every number from the triangles to the bytes.
//
// Vectors are in eye space unless a name says otherwise (docs/lighting.md, "Vectors"). Vectors and numbers are the
// floats that drawing used; angles are computed from them. Names belong to the scene.
#ifndef LAMBENT_EXPLAIN_H
#define LAMBENT_EXPLAIN_H

#include "device.h"
#include "light.h"
#include "material.h"

#ifdef __cplusplus
extern "C" {
#endif

// The response of a physical material's layers to light of strength 1 from one direction (docs/lighting/layers.md):
//     D                     = (1 − share) sheen_left base_diffuse
//     specular_term ÷ light = (1 − share) (sheen_left base + sheen) + coat
// with the coat's share of lam_explained_layers.
typedef struct lam_explained_light_layers {
    float S;            // of the base: π D V max(n·l, 0)
    float base_diffuse; // max(n·l, 0) (1 − max F) times the matt part
    lam_rgb base;       // F S; F mixes dielectric and metal
    float sheen_left;   // the fraction of light that passes the sheen; 1: no sheen
    lam_rgb sheen;      // sheen_color π D V n·l, with D and V of the fibres
    float coat;         // the share S of the coat; 0: no coat
    LAM_RESERVED(4);
} lam_explained_light_layers;

// A point, directional or spot light at a lit point.
typedef struct lam_explained_light {
    const char *name;      // NULL: unnamed
    int light;             // index in the scene; −1: a light of the rig
    lam_light_type type;   // point, directional or spot
    lam_light_frame frame; // the frame of the scene's light
    lam_vec3 position;     // point, spot
    // Directional, spot: the direction of travel of the light, unit.
    lam_vec3 axis;
    // La, Ld, Ls: the colours of the light.
    lam_rgb ambient, diffuse, specular;

    // Unit vectors, zero if there is none: to the light, its mirror image about n, and halfway between l and v.
    lam_vec3 l, r, h;
    // The angles between n and l, between r and v, and between n and h. NaN if one of the two vectors is missing.
    double theta_rad, phi_rad, psi_rad;
    float distance;                    // model units; 0: directional
    lam_attenuation attenuation_terms; // constant, linear, quadratic
    float range;                       // model units; 0: none
    float attenuation;                 // including the range's window; 1: none
    float cos_axis;                    // spot: cosine between −l and the axis; else 1
    float spot;                        // the cone's factor; 1: no cone
    float n_dot_l;                     // cosine between n and l
    // The highlight is S = base^power unless n·l ≤ 0 gates it; base 0…1.
    float base, power;
    float D; // strength of the diffuse term
    float S; // strength of the specular term

    // kd ⊙ Ld and ks ⊙ Ls.
    lam_rgb kd_Ld, ks_Ls;
    lam_rgb diffuse_term;  // spot · attenuation · D · kd ⊙ Ld
    lam_rgb specular_term; // spot · attenuation · S · ks ⊙ Ls
    // With gl1: spot · attenuation · ka ⊙ La. Otherwise 0; La is then part of the point's ambient light.
    lam_rgb ambient_term;
    // The sum omits the light's terms because they are too weak in this part of the picture
    // (lam_draw_params.light_cutoff).
    bool skipped;
    // Whether triangles may shadow the point from this light (lam_draw_params.shadows).
    bool casts_shadows;
    // The fraction of the light that reaches the point, a factor of diffuse_term and specular_term; 1 without shadows.
    lam_rgb passed;
    // The object of the nearest triangle between the point and the light's centre; −1: none.
    int shadow_object;
    uint32_t shadow_triangle; // index in its mesh
    float shadow_distance;    // from the point to that triangle, world units
    // Microfacet models: D(h), the density of microfacets that face h, and V, their visibility; S = pi D(h) V max(n.l,
    // 0). Other models: 0.
    float distribution, visibility;
    // Microfacet models: F, the Fresnel factor including multiple scattering; ks_Ls = F ⊙ Ls. Other models: 0.
    lam_rgb fresnel;
    // The factor of ambient occlusion, 1 − occluded (1 − unoccluded), which is included in both terms; 1: none.
    float occlusion;
    // The light reflected by each layer of a physical material; NULL: the material has no layers. With layers,
    // distribution, visibility and fresnel belong to the base (the first two are 0 for an anisotropic highlight), and S
    // is the largest channel of the reflected light of all layers.
    const lam_explained_light_layers *layers;
    LAM_RESERVED(1);
} lam_explained_light;

// A hemisphere light at a lit point.
typedef struct lam_explained_hemisphere {
    const char *name;    // NULL: unnamed
    int light;           // index in the scene; −1: a light of the rig
    lam_vec3 up;         // unit, towards the sky
    lam_rgb sky, ground; // colours of sky and ground
    float n_dot_up;      // cosine between n and up
    lam_rgb term;        // ka ⊙ mix(ground, sky, ½ + ½ n·up)
    bool by_diffuse;     // kd instead of ka in `term`
    LAM_RESERVED(7);
} lam_explained_hemisphere;

// The layers of a physical material at a point (docs/lighting/layers.md).
typedef struct lam_explained_layers {
    lam_rgb dielectric_f0, metal_f0; // of the base, along the normal
    float matt;                      // (1 − transmission) (1 − specular_glossiness max f0)
    float sheen_left;                // 1 − max(sheen_color) E(|n·v|); 1: no sheen
    lam_vec3 coat_normal;            // n_c, unit, eye space; zero: no coat
    float coat;                      // its weight, clearcoat (0.04 + 0.96 (1 − |n_c·v|)⁵)
    lam_rgb transmittance;           // factor of the light behind; black: opaque
    // The environment light returned by the split sum of each layer: environment_specular is
    //    mirrored_part + sheen_part + coat_part
    // Each is dimmed by the layers over it and by occlusion. Black without an environment, and with `reference`.
    lam_rgb mirrored_part, sheen_part, coat_part;
    float coat_level;         // of the prefiltered environment, for the coat's roughness
    float coat_albedo;        // scale + bias of the coat's lobe
    lam_rgb coat_prefiltered; // light around the mirror image of v about n_c
    // The picture behind rough or thick glass is shifted to the right and down by this many pixels, and blurred over
    // this many pixels.
    float behind_x, behind_y, behind_blur;
    LAM_RESERVED(6);
} lam_explained_layers;

// A lit point: the fragment itself (Phong), a corner (Gouraud), or the last corner (flat).
typedef struct lam_explained_point {
    int corner; // 0…2; −1: the fragment
    // The same position in mesh, world and eye space.
    lam_vec3 mesh_position, world_position, position;
    // Unit vectors: the normal, the direction to the eye, and the tangent, which is zero if the reflection model does
    // not use it.
    lam_vec3 n, v, t;
    lam_rgb color;         // vertex colour; 1 if the mesh has no colours
    lam_rgb ambient_light; // La_global + Σ La
    lam_rgb ambient_term;  // ka ⊙ ambient_light
    // The hemisphere lights of the scene and the rig.
    const lam_explained_hemisphere *hemispheres;
    int hemisphere_count; // elements of `hemispheres`
    // The point, directional and spot lights of the scene and the rig.
    const lam_explained_light *lights;
    int light_count; // elements of `lights`
    // The mirror image of the eye vector about the normal, R = 2 (n·v) n − v. Zero without an environment, n or v.
    lam_vec3 reflected;
    // R in the environment's own axes, the direction of the lookup. Zero if `reflected` is zero.
    lam_vec3 environment_direction;
    // The environment's light from that direction; the reflection term is kr ⊙ this light.
    lam_rgb environment_light;
    // The terms; ambient and diffuse are multiplied by the vertex colour.
    lam_rgb emission, ambient, diffuse, specular, reflection;
    lam_rgb sum;    // emission + ambient + diffuse + specular + reflection
    lam_rgb result; // the sum; clamped to 0…1 with gl1, flat and Gouraud
    // The split sum of a physical material under an environment; otherwise, and with `reference`, all zero. It adds to
    // the diffuse and to the specular term
    //    kd ⊙ irradiance (1 − (0.04 scale + bias))        prefiltered ⊙ (f0 scale + bias)
    // with the mix of dielectric and metal and the multiple scattering of the lights' Fresnel factor.
    float environment_roughness;
    float environment_level;                   // prefiltered: 0 (a mirror) to 11 (roughness 1)
    float environment_scale, environment_bias; // of the split sum
    lam_rgb irradiance, prefiltered;           // incoming light, linear
    lam_rgb environment_diffuse;               // its part of the diffuse term, even with `reference`
    // The share of surrounding light that ambient occlusion lets through. It multiplies the ambient term and the
    // environment's light on physical materials; 1 without occlusion.
    float unoccluded;
    // The layers of a physical material; NULL: the material has none.
    const lam_explained_layers *layers;
    // The environment's light in the specular term, even with `reference`; linear.
    lam_rgb environment_specular;
    LAM_RESERVED(5);
} lam_explained_point;

// A lookup in a map for a fragment.
typedef struct lam_explained_map {
    lam_map map;         // the material's map
    const char *texture; // the texture's name; NULL: unnamed
    int width, height;   // of the texture, texels
    float s, t;          // texture coordinates of the mesh
    // The position in the texture, after the map's transform and wrapping: texels of level 0 from its upper left
    // corner.
    float column, row;
    float level; // of detail, of each probe; 0 and less: level 0, magnified
    // The footprint: by how many texels of level 0 (columns, rows) the position changes from this pixel to its right
    // neighbour and to the one below.
    float across[2], down[2];
    // The number of lookups along the longer axis of the footprint (lam_draw_params.anisotropy).
    int probes;
    // The filtered texel, before scale and offset. For a bump map: the heights one texel of level 0 before and behind
    // the point, along rows and along columns.
    lam_rgba texel;
    LAM_RESERVED(4);
} lam_explained_map;

// The material at a fragment that is lit on its own (Phong shading).
typedef struct lam_explained_values {
    // The diffuse colour, or the base colour of a physical material, times maps and vertex colours.
    lam_rgb base_color;
    // Physical materials: as given; roughness below 0.045 is lit as 0.045. Classic materials: 0.
    float metallic, roughness;
    // Factor of ambient, hemisphere and environment light; 1: no map.
    float occlusion;
    float shininess; // classic materials; else 0
    // The roughness with which a physical material is lit: `roughness`, or more by specular antialiasing
    // (lam_specular_aa); 0 for other materials.
    float lit_roughness;
    // The interpolated unit normal before a normal map, and the mesh's tangent, which may have any length. The tangent
    // is zero if no map and no model uses it.
    lam_vec3 mesh_normal, tangent;
    float bitangent_sign; // the bitangent is this times n × t
    LAM_RESERVED(8);
} lam_explained_values;

// The positions of a point from the mesh to the window, as a vertex shader and the later stages compute them.
typedef struct lam_explained_place {
    lam_vec3 mesh_position; // in the mesh's own space
    lam_vec3 eye_position;  // the eye at the origin, looking along −z
    // x, y, z, w: inside the picture if w > 0 and −w ≤ x, y, z ≤ w.
    double clip[4];
    // x, y and z of `clip` divided by w: −1…1 inside the picture, y up. NaN if w ≤ 0 (behind the eye).
    double ndc[3];
    // Pixels from the lower left corner, as in OpenGL: (ndc.x + 1) · width / 2, (ndc.y + 1) · height / 2; and the depth
    // (ndc.z + 1) / 2. NaN if w ≤ 0.
    double window[3];
    // Corners: the mesh's normal in its own space, unit. Zero if the triangle's own normal is used
    // (lam_explained_fragment.face_normal).
    lam_vec3 normal;
    LAM_RESERVED(1);
} lam_explained_place;

// The matrices of an object, as passed to its vertex shader, m[row][column].
typedef struct lam_explained_matrices {
    lam_mat4 model_view; // the mesh's own space to eye space
    lam_mat4 projection; // eye space to clip space
    // The inverse transpose of the upper left 3×3 of `model_view`, which transforms normals to eye space; zero if it is
    // singular.
    double normal[3][3];
    LAM_RESERVED(8);
} lam_explained_matrices;

// A triangle that is visible in the pixel.
typedef struct lam_explained_fragment {
    // Indices in the scene; `part` is −1 for a mesh without parts. For the ground, all three are −1.
    int object, mesh, part;
    // Their names; NULL: unnamed.
    const char *object_name, *mesh_name, *part_name;
    // Index in the mesh. For lines and points (see `corners`) the index of the line or point.
    uint32_t triangle;
    bool back;                 // the camera sees the back side
    bool flipped;              // the camera sees the back side, lit with −n
    int material;              // index in the scene; −1: the default material
    lam_material surface;      // the material
    float shininess;           // the power in use; match_highlights and gl1 change it
    lam_reflection reflection; // the model in use, never AUTO
    int samples;               // number of samples that show the triangle
    int lit_sample;            // the sample whose position is lit; −1: the pixel's centre
    // The position of that sample in the picture, in pixels from the upper left corner.
    double picture_x, picture_y;
    float weights[3];                  // perspective-correct barycentric coordinates
    const lam_explained_point *points; // 1, or the 3 corners with Gouraud shading
    int point_count;                   // elements of `points`
    lam_rgba color;                    // not premultiplied
    uint16_t sample_mask;              // bit s: sample s shows the triangle
    // For each sample that shows the triangle: the fraction of its light that the translucent triangles in front let
    // through; 1 if there are none.
    float transmittance[16];
    // Σ transmittance / samples of a pixel: the fragment's share of the pixel.
    float weight;
    // The kind of primitive: 3 for triangles, 2 for lines, 1 for points. Lines and points are drawn as triangles; the
    // weights then refer to the corners of such a triangle.
    int corners;
    // The maps that were used, in the order of the lookups.
    const lam_explained_map *maps;
    // The material after its maps; NULL with Gouraud and flat shading.
    const lam_explained_values *values;
    int map_count; // elements of `maps`
    // The kind of the ground if the triangle belongs to it; NONE: the triangle belongs to the scene.
    lam_ground ground;
    // LAM_GROUND_SHADOW: the luminance that the point sends to the eye, and the luminance that it would send if nothing
    // blocked the light. The opacity is the missing share, 1 − received / unobstructed, times the ground's fade-out
    // factor.
    float received, unobstructed;
    // Four positions: the triangle's corners, and the point with the weights above. NULL: a line or a point, which has
    // no corners in a mesh.
    const lam_explained_place *places;
    // (x3−x2)(y1−y2) − (y3−y2)(x1−x2) of the corners' window positions: twice the area in square pixels, positive if
    // they are counter-clockwise. A mirroring transform reverses the winding of front faces. NaN if a corner is behind
    // the eye.
    double winding;
    const lam_explained_matrices *matrices; // NULL if `places` is NULL
    // true: n is the triangle's own normal, (p1 − p0) × (p2 − p0) of its corners, before maps. false: n is interpolated
    // from the normals of the corners, in eye space.
    bool face_normal;
    LAM_RESERVED(4);
} lam_explained_fragment;

// The light of a pixel that was reflected a given number of times on its way to the eye, with lam_draw_params.bounces:
// linear, with exposure, premultiplied, over nothing.
typedef struct lam_explained_bounce {
    lam_rgb light; // the mean of the paths
    lam_rgb error; // the standard error of `light`
    LAM_RESERVED(2);
} lam_explained_bounce;

// One pixel of a picture.
typedef struct lam_explanation {
    int x, y;                  // the pixel, from the upper left corner
    int width, height;         // the picture's size, pixels
    int samples;               // per pixel
    lam_pixel_format format;   // format of the picture
    lam_color_mode color;      // as in lam_draw_params
    lam_shading shading;       // as in lam_draw_params
    lam_reflection reflection; // of the first fragment, never AUTO
    bool distant_viewer;       // v = (0, 0, 1) for every point
    bool gl1;                  // as in lam_draw_params
    bool has_environment;      // whether the scene has an environment
    // The triangles that the pixel shows, in the order of the nearest sample that shows them; translucent triangles
    // first, by depth.
    const lam_explained_fragment *fragments;
    int fragment_count; // 0: only the background

    lam_rgba sum;        // Σ weight · alpha · color + behind, and Σ weight · alpha
    double stops;        // lam_draw_params.exposure
    float exposure;      // 2^stops
    lam_rgba background; // not premultiplied
    // The value in an LAM_RGBA32F picture: exposure · sum over the background, premultiplied.
    lam_rgba result;
    lam_rgb straight; // result / alpha
    lam_rgb encoded;  // `straight` sRGB-encoded, or clamped with LAM_COLOR_RAW
    uint8_t bytes[4]; // the bytes of LAM_RGBA8: floor(255·encoded + ½), and alpha
    lam_tone tone;    // in use, never AUTO
    // The colour that is encoded: exposure · sum / alpha after the tone curve, over the background. Not clipped with NONE.
    lam_rgb toned;
    // As in lam_draw_params: if it is not 0, the reflection terms of physical materials are sums over this many
    // directions, and the members of the split sum are 0.
    int reference;
    // The point, directional and spot lights with their cones, in the order of each point's `lights`.
    const lam_light *lights;
    int light_count; // of `lights`
    // A part of `sum` that belongs to no fragment: the picture behind rough or thick glass, which is blurred or
    // refracted, and the glass's tint of the background.
    lam_rgb behind;
    // With lam_draw_params.bounces, the fragments and all members above describe local lighting. The following members
    // describe the light of the picture's paths before the filter.
    // The number of paths; fewer than in the picture if 16 does not divide it.
    int bounce_paths;
    int bounce_count; // 1 + bounces; 0: local lighting
    // Emission, and the light after 1 to `bounces` reflections. The sum of all is the light of the pixel.
    const lam_explained_bounce *bounces;
    LAM_RESERVED(2);
} lam_explanation;

// Draws the part of the picture around pixel (x, y), counted from the upper left corner, and records every number of
// that pixel. The call runs the same code as lam_draw with the same parameters; the size and format of the picture
// replace the image, and `bounces` is ignored, because it explains local lighting. The device's next
// picture is not affected. The caller frees the result. Returns NULL on failure: LAM_BAD_ARGUMENT, LAM_UNSUPPORTED (not
// the CPU device), LAM_LIMIT, LAM_CANCELLED.
LAM_API lam_explanation *lam_explain(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                                     const lam_draw_params *params, int width, int height, lam_pixel_format format,
                                     int x, int y, const lam_control *control, lam_error *error);

LAM_API void lam_explanation_free(lam_explanation *explanation); // NULL is allowed

#ifdef __cplusplus
}
#endif
#endif
