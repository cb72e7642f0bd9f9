// lambent/explain.h: explains one pixel of a picture: every number from the triangles to the bytes.
//
// Vectors are in eye space unless a name says otherwise (docs/lighting.md, "Vectors"). Vectors and numbers are the
// floats from which the picture was computed; angles are computed from them. Names belong to the scene.
#ifndef LAMBENT_EXPLAIN_H
#define LAMBENT_EXPLAIN_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// The response of a physical material's layers to light 1 from one direction (docs/lighting/layers.md):
//     D                     = (1 − share) sheen_left base_diffuse
//     specular_term ÷ light = (1 − share) (sheen_left base + sheen) + coat
// with the coat's share of lam_explained_layers.
typedef struct lam_explained_light_layers {
    float S;            // of the base: π D V max(n·l, 0)
    float base_diffuse; // max(n·l, 0) (1 − max F) matt
    lam_rgb base;       // F S, F the mix of dielectric and metal
    float sheen_left;   // the fraction of light that passes the sheen; 1: no sheen
    lam_rgb sheen;      // sheen_color π D V n·l of its fibres
    float coat;         // share S of the coat; 0: no coat
    LAM_RESERVED(4);
} lam_explained_light_layers;

// A point, directional or spot light at a lit point.
typedef struct lam_explained_light {
    const char *name;      // NULL: unnamed
    int light;             // index in the scene; −1: a light of the rig
    lam_light_type type;   // point, directional or spot
    lam_light_frame frame; // the frame of the scene's light
    lam_vec3 position;     // point, spot
    // Directional, spot: the direction that the light travels in, unit.
    lam_vec3 axis;
    // La, Ld, Ls: the colours of the light.
    lam_rgb ambient, diffuse, specular;

    // Unit vectors, zero if there is none: to the light, its mirror image about n, and halfway between l and v.
    lam_vec3 l, r, h;
    // The angles between n and l, between r and v, and between n and h. NaN if one of the two is missing.
    double theta_rad, phi_rad, psi_rad;
    float distance;                    // model units; 0: directional
    lam_attenuation attenuation_terms; // constant, linear, quadratic
    float range;                       // model units; 0: none
    float attenuation;                 // with the range's window; 1: none
    float cos_axis;                    // spot: cosine between −l and the axis; else 1
    float spot;                        // the cone's factor; 1: no cone
    float n_dot_l;                     // cosine between n and l
    // The highlight is S = base^power unless it is gated; base 0…1.
    float base, power;
    float D; // strength of the diffuse term
    float S; // strength of the specular term

    // Products with the material, channel by channel.
    lam_rgb kd_Ld, ks_Ls;
    lam_rgb diffuse_term;  // spot · attenuation · D · kd ⊙ Ld
    lam_rgb specular_term; // spot · attenuation · S · ks ⊙ Ls
    // With gl1: spot · attenuation · ka ⊙ La. Otherwise 0, and La is part of the point's ambient light.
    lam_rgb ambient_term;
    // The sum omits the light's terms, because they are too weak in this part of the picture
    // (lam_draw_params.light_cutoff).
    bool skipped;
    // With lam_draw_params.shadows: whether triangles may shadow the point from this light.
    bool casts_shadows;
    // The fraction of the light that is not blocked, a factor of diffuse_term and specular_term; 1 without shadows.
    lam_rgb passed;
    // The object whose triangle is the nearest in the way to the light's middle; −1: nothing is.
    int shadow_object;
    uint32_t shadow_triangle; // index in its mesh
    float shadow_distance;    // from the point to that triangle, world units
    // Of microfacet models, 0 of others: D(h), the share of mirrors that face h, and V, their visibility.
    // S = pi D(h) V max(n.l, 0).
    float distribution, visibility;
    // F, Fresnel's factor with the light that mirrors send to one another; ks_Ls = F ⊙ Ls. 0 of other models.
    lam_rgb fresnel;
    // The factor of ambient occlusion, 1 − occluded (1 − unoccluded), included in both terms; 1: none.
    float occlusion;
    // How the layers of a physical material share the light; NULL: it has none. distribution, visibility and fresnel
    // then belong to the base (the first two are 0 if its highlight is stretched), and S is the largest channel of the
    // reflected light of all layers.
    const lam_explained_light_layers *layers;
    LAM_RESERVED(1);
} lam_explained_light;

// A hemisphere light at a lit point.
typedef struct lam_explained_hemisphere {
    const char *name;    // NULL: unnamed
    int light;           // index in the scene; −1: a light of the rig
    lam_vec3 up;         // unit, towards the sky
    lam_rgb sky, ground; // its colours
    float n_dot_up;      // cosine between n and up
    lam_rgb term;        // ka ⊙ mix(ground, sky, ½ + ½ n·up)
    LAM_RESERVED(8);
} lam_explained_hemisphere;

// The layers of a physical material at a point (docs/lighting/layers.md).
typedef struct lam_explained_layers {
    lam_rgb dielectric_f0, metal_f0; // of the base, along the normal
    float matt;                      // (1 − transmission) (1 − specular_glossiness max f0)
    float sheen_left;                // 1 − max(sheen_color) E(|n·v|); 1: no sheen
    lam_vec3 coat_normal;            // n_c, unit, eye space; zero: no coat
    float coat;                      // its share, clearcoat (0.04 + 0.96 (1 − |n_c·v|)⁵)
    lam_rgb transmittance;           // factor of the light behind; black: none goes through
    // Of environment light, which the split sum of each layer returns: environment_specular is
    //     mirrored_part + sheen_part + coat_part
    // each dimmed by the layers over it and by occlusion. Black without an environment, and with `reference`.
    lam_rgb mirrored_part, sheen_part, coat_part;
    float coat_level;         // of the prefiltered environment, for the coat's roughness
    float coat_albedo;        // scale + bias of the coat's lobe
    lam_rgb coat_prefiltered; // around the mirror image of v about n_c
    // How rough or thick glass shows the picture behind it: moved by so many pixels to the right and down, and blurred over so many.
    float behind_x, behind_y, behind_blur;
    LAM_RESERVED(6);
} lam_explained_layers;

// A point that was lit: the fragment itself (Phong), a corner (Gouraud), or the last corner (flat).
typedef struct lam_explained_point {
    int corner; // 0…2; −1: the fragment
    // The same position in the mesh's space, in the world's and in eye space.
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
    // The eye vector's mirror image about the normal, R = 2 (n·v) n − v. Zero without an environment, n or v.
    lam_vec3 reflected;
    // R in the environment's own axes: the direction that it is sampled with. Zero as `reflected`.
    lam_vec3 environment_direction;
    // The environment's light from there; the reflection term is kr ⊙ this.
    lam_rgb environment_light;
    // The terms; ambient and diffuse are multiplied by the vertex colour.
    lam_rgb emission, ambient, diffuse, specular, reflection;
    lam_rgb sum;    // emission + ambient + diffuse + specular + reflection
    lam_rgb result; // the sum; clamped to 0…1 with gl1, flat and Gouraud
    // The split sum of a physical material under an environment; all zero elsewhere and with `reference`. It adds to the diffuse
    // and to the specular term
    //     kd ⊙ irradiance (1 − (0.04 scale + bias))        prefiltered ⊙ (f0 scale + bias)
    // with the mix of dielectric and metal, and the light between microfacets, of the lights' Fresnel factor.
    float environment_roughness;
    float environment_level;                   // prefiltered: 0 (a mirror) to 11 (roughness 1)
    float environment_scale, environment_bias; // of the split sum
    lam_rgb irradiance, prefiltered;           // light that falls in, linear
    lam_rgb environment_diffuse;               // of it in the diffuse term, with `reference` too
    // The share of surrounding light that ambient occlusion lets pass; it multiplies the ambient term and the environment's
    // light on physical materials; 1 without occlusion.
    float unoccluded;
    // The layers of a physical material; NULL: it has none.
    const lam_explained_layers *layers;
    lam_rgb environment_specular; // the environment's light in the specular term, with `reference` too
    LAM_RESERVED(5);
} lam_explained_point;

// A map that was read for a fragment.
typedef struct lam_explained_map {
    lam_map map;         // which of the material's
    const char *texture; // its name; NULL: unnamed
    int width, height;   // of the texture, texels
    float s, t;          // texture coordinates of the mesh
    // The position in the texture, after the map's transform and wrapping: texels of level 0 from its upper left
    // corner.
    float column, row;
    float level; // of detail; 0 and less: level 0, magnified
    // Filtered, before scale and offset. Of a bump map the heights one texel of level 0 before and behind the point, along
    // rows and along columns.
    lam_rgba texel;
    LAM_RESERVED(4);
} lam_explained_map;

// The material at a separately lit fragment (Phong shading).
typedef struct lam_explained_values {
    // The diffuse colour, or the base colour of a physical material: its own times maps and vertex colours.
    lam_rgb base_color;
    // Of a physical material, as given: smoother than 0.045 is lit as 0.045. 0 of others.
    float metallic, roughness;
    // Factor of ambient, hemisphere and environment light; 1: no map.
    float occlusion;
    float shininess; // of a classic material; else 0
    // The roughness with which a physical material is lit: `roughness`, or more by specular antialiasing (lam_specular_aa). 0 of others.
    float lit_roughness;
    // The interpolated normal before a normal map, unit; and the mesh's tangent, of any length, zero if no map and no
    // model reads it.
    lam_vec3 mesh_normal, tangent;
    float bitangent_sign; // the bitangent is this times n × t
    LAM_RESERVED(8);
} lam_explained_values;

// A point on its way from the mesh to the window, as a vertex shader and the later stages compute it.
typedef struct lam_explained_place {
    lam_vec3 mesh_position; // of the mesh's own space
    lam_vec3 eye_position;  // the eye at the origin, looking along −z
    // x, y, z, w: inside the picture where w > 0 and −w ≤ x, y, z ≤ w.
    double clip[4];
    // x, y and z of `clip` divided by w: −1…1 inside the picture, y up. NaN where w ≤ 0: behind the eye.
    double ndc[3];
    // Pixels from the lower left corner, as OpenGL counts them: (ndc.x + 1) · width / 2, (ndc.y + 1) · height / 2; and the
    // depth (ndc.z + 1) / 2. NaN where w ≤ 0.
    double window[3];
    // Of a corner: the mesh's normal in its own space, unit. Zero if the triangle's own normal is used
    // (lam_explained_fragment.face_normal).
    lam_vec3 normal;
    LAM_RESERVED(1);
} lam_explained_place;

// The matrices of an object, as passed to its vertex shader. Rows first: m[row][column].
typedef struct lam_explained_matrices {
    lam_mat4 model_view; // the mesh's own space to eye space
    lam_mat4 projection; // eye space to clip space
    // The transposed inverse of the upper left 3×3 of `model_view`, which takes normals to eye space; zero if it has no inverse.
    double normal[3][3];
    LAM_RESERVED(8);
} lam_explained_matrices;

// A triangle that the pixel shows.
typedef struct lam_explained_fragment {
    // Indices in the scene; `part` is −1 for a mesh without parts, and all three for the ground.
    int object, mesh, part;
    // Their names; NULL: unnamed.
    const char *object_name, *mesh_name, *part_name;
    // Index in the mesh; of a line or point, where `corners` says so.
    uint32_t triangle;
    bool back;                 // the back side is seen
    bool flipped;              // the back side is seen and lit with −n
    int material;              // index in the scene; −1: the default material
    lam_material surface;      // the material
    float shininess;           // the power in use; match_highlights and gl1 change it
    lam_reflection reflection; // the model in use, never AUTO
    int samples;               // number of samples that show the triangle
    int lit_sample;            // the sample that it is lit at; −1: the pixel's centre
    // The place of that sample in the picture, in pixels from the upper left corner.
    double picture_x, picture_y;
    float weights[3];                  // perspective-correct barycentric coordinates there
    const lam_explained_point *points; // 1, or the 3 corners with Gouraud shading
    int point_count;                   // elements of `points`
    lam_rgba color;                    // not premultiplied
    uint16_t sample_mask;              // bit s: sample s shows the triangle
    // For each sample that shows the triangle, the fraction of its light that the translucent triangles in front let
    // pass: 1 without any.
    float transmittance[16];
    // Σ transmittance / samples of a pixel: the fragment's share of the pixel.
    float weight;
    // The kind of the mesh: 3 triangles; 2 lines, 1 points, each drawn as two triangles, whose corners have the
    // weights.
    int corners;
    // The maps that were read, in the order of reading.
    const lam_explained_map *maps;
    // The material after its maps; NULL: Gouraud and flat shading.
    const lam_explained_values *values;
    int map_count; // elements of `maps`
    // The kind of the ground where the triangle belongs to it; NONE: the triangle is the scene's.
    lam_ground ground;
    // LAM_GROUND_SHADOW: the luminance that the point sends to the eye, and that it would send with nothing in the way of light.
    // The missing share is its opacity: 1 − received / unobstructed, times that to which it has faded out.
    float received, unobstructed;
    // 4: the triangle's corners, and the point with the weights above. NULL: a line or a point, which has no corners in a mesh.
    const lam_explained_place *places;
    // (x3−x2)(y1−y2) − (y3−y2)(x1−x2) of the corners' window positions: twice the area in square pixels, positive if
    // they are counter-clockwise. A mirroring transform turns the winding of a front round. NaN where a corner lies
    // behind the eye.
    double winding;
    const lam_explained_matrices *matrices; // NULL if `places` is
    // n is the triangle's own normal, (p1 − p0) × (p2 − p0) of its corners, before maps. false: the normals of the corners, in
    // eye space, are interpolated.
    bool face_normal;
    LAM_RESERVED(4);
} lam_explained_fragment;

// One pixel of a picture.
typedef struct lam_explanation {
    int x, y;                  // the pixel, from the upper left corner
    int width, height;         // the picture's size, pixels
    int samples;               // per pixel
    lam_pixel_format format;   // the picture's
    lam_color_mode color;      // as in lam_draw_params
    lam_shading shading;       // as in lam_draw_params
    lam_reflection reflection; // of the first of `fragments`, never AUTO
    bool distant_viewer;       // v = (0, 0, 1) for every point
    bool gl1;                  // as in lam_draw_params
    bool has_environment;      // the scene has one
    // The triangles that the pixel shows, in the order of the nearest sample that shows them; translucent ones first,
    // by depth.
    const lam_explained_fragment *fragments;
    int fragment_count; // of `fragments`; 0: the background alone

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
    lam_rgb toned;    // `straight` after the tone curve, which is then encoded
    // As in lam_draw_params: with a value, the reflection terms of physical materials are sums over this many
    // directions, and the members of the split sum are 0.
    int reference;
    // The point, directional and spot lights in the order of each point's, as they were given: with their cones.
    const lam_light *lights;
    int light_count; // of `lights`
    // A part of `sum`: the light that the pixel's glass lets through from the picture behind it, where rough or thick glass shows that
    // blurred or bent, and the colour that it gives to the background. No fragment has it.
    lam_rgb behind;
    LAM_RESERVED(2);
} lam_explanation;

// Draws the part of the picture around pixel (x, y), counted from the upper left corner, and records every number of
// that pixel. It runs the same code as lam_draw, and takes the same arguments, with the picture's size and format
// instead of the picture. The device's next picture is not affected. The caller frees the result. Returns NULL on
// failure: LAM_BAD_ARGUMENT, LAM_UNSUPPORTED (not the CPU device), LAM_LIMIT, LAM_CANCELLED.
LAM_API lam_explanation *lam_explain(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                                     const lam_draw_params *params, int width, int height, lam_pixel_format format,
                                     int x, int y, const lam_control *control, lam_error *error);

LAM_API void lam_explanation_free(lam_explanation *explanation); // NULL is fine

#ifdef __cplusplus
}
#endif
#endif
