// glsl.h: generates a shader for a set of choices, and computes the values of the shader's uniforms for a frame.
//
// The source consists of the equations in src/core/lighting that the shader calls (glsl_text.h), and of the files in
// src/gpu/glsl/text. These files contain the code for all choices. For one set of choices, branches with known conditions
// are resolved, and unread names are removed (glsl_text.h).
//
// The attributes have these locations (GLSL 120 binds attributes by name):
//    0 position, 1 normal, 2 color, 3 tangent, 4 front_color, 5 back_color, 6 provoking_position, 7 texcoord,
//    8 second_texcoord.
// glsl_declarations.c contains the table of uniforms. All colours are vec4, so that arrays of colours have the same layout in
// std140 blocks, in texels and for glUniform4fv.
#ifndef GLSL_H
#define GLSL_H

#include "fields.h"
#include "frame.h"

enum glsl_version { GLSL_120, GLSL_330, GLSL_300_ES };

// How a shader stores the lights and the products of lights and materials.
enum glsl_storage {
    GLSL_ARRAY,   // plain uniforms: lights[i].position
    GLSL_BLOCK,   // std140 blocks Lights and Products (or Materials), BackProducts
    GLSL_TEXTURE, // RGBA32F textures light_list and product_list, GLSL_LIST_WIDTH texels wide; not in 120
};
enum { GLSL_LIST_WIDTH = 1024 };

enum glsl_encoding {
    GLSL_ENCODED,       // clamped to 0…1 and sRGB-encoded, for an 8-bit window
    GLSL_STRAIGHT,      // linear, not premultiplied
    GLSL_PREMULTIPLIED, // linear, colour × alpha, for blending in linear light
};

enum glsl_environment {
    GLSL_NO_ENVIRONMENT,
    GLSL_CUBE, // samplerCube environment, bilinear and seamless, no mipmaps
    // sampler2DArray environment_faces: six faces with borders (cube_map.h), filtered as in cube_lookup.h; not in 120.
    GLSL_FACES,
};

// Depth peeling of translucent surfaces (gl_passes.c); not in 120. A second output, `depth_id`, contains the depth and
// the triangle number of each pixel.
enum glsl_layer {
    GLSL_NO_LAYERS,
    GLSL_WRITES_DEPTH_IDS, // an opaque surface
    GLSL_PEELS,            // a layer: the fragments behind nearer_depth_ids and in front of opaque_depth_ids
};

// Lights are grouped by kind and falloff. The shader contains a loop for each group; in the loop, the group's kind is a
// constant.
struct glsl_group {
    int kind, falloff; // LIGHT_…, FALLOFF_… of src/core/lighting/light_kinds.h
    int count;
};
enum { GLSL_KINDS = 5, GLSL_FALLOFFS = 3, GLSL_GROUPS_MAX = GLSL_KINDS * GLSL_FALLOFFS };

// A map of one side's material.
struct glsl_map {
    uint8_t used;
    uint8_t texels; // equal numbers mean that two maps of a range have the same texels everywhere
    uint8_t texcoords, wrap_s, wrap_t, channel; // same as in lam_texture_map
    uint8_t magnify, minify, mip, probes;       // same as in texture_sampler
};

// The choices that determine a shader's source. Before memcmp can compare two structs, both must be zeroed before their
// members are assigned.
struct glsl_choices {
    enum glsl_version version;
    enum glsl_storage storage;
    enum glsl_encoding encoding;
    enum glsl_environment environment;
    // The environment lights a physical material. In addition to `environment`, the shader reads sampler2D
    // environment_light (environment_light.h).
    bool environment_light;
    bool occlusion; // ambient occlusion: sampler2D ambient_occlusion has a texel for each pixel of the target
    enum glsl_layer layer;
    bool transmits;  // a layer has a third output `through`, the transmittance per channel
    lam_stage stage; // never AUTO
    lam_shading shading;
    lam_reflection reflection; // never AUTO
    lam_output output;         // COVERAGE and OVERDRAW write 1, CLIPPED writes the picture
    bool distant_viewer;
    bool gl1;
    bool single_scattering;
    // the variance of the normals increases the roughness of physical materials (lam_specular_aa); not in 120
    bool widens;
    bool passed;      // each light is multiplied by its unblocked share, which the program sets (in texels: position.w)
    bool shadows;     // the shader traverses the hierarchy, which is in a texture (shadows.glsl); not in 120
    bool passes_rays; // with shadows, whether some triangles transmit light
    bool tints_rays;  // with passes_rays, whether these triangles also tint the light
    bool catches;     // a shadow catcher: black, with the blocked share of the light as opacity
    lam_tone tone;    // used for GLSL_ENCODED; with AUTO and NONE the light is clamped
    bool exposes;     // the fragment multiplies its light by the uniform `exposure`
    const struct glsl_style *style; // writes the sources; NULL means the full style
    int mistake;                    // the deliberate mistake or two (mistake_find); 0 means no mistake
    bool products;                  // uniforms are the products ka·La, kd·Ld, ks·Ls; otherwise material and lights
    bool two_sided;                 // the back is lit with −n
    bool back_material;             // the back has its own material
    bool colors;                    // attribute color
    bool tangents;                  // attribute tangent; otherwise the shader computes a tangent if necessary
    bool converted[2];              // front, back: a metallic-roughness material with maps, lit by a classic model
    uint8_t alpha[2];               // front, back: lam_alpha_mode
    // If above 1, a fragment is one of several samples of a pixel, and is lit at the point that the CPU device lights for
    // all samples of the triangle in the pixel (texture.glsl). The vertices are the corners of the triangles, in order.
    // Not in 120, and only for the fragment stage.
    uint8_t samples;
    bool hardware_filter; // glsl_use_hardware_filter
    // The layers (LAYER_…, layer_kinds.h) of the range's materials, and the layers of all materials of the frame. A
    // block contains the fields for all layers of the frame.
    uint8_t layers, field_layers;
    struct glsl_map maps[2][LAM_MAP_COUNT]; // front, back
    struct glsl_group groups[GLSL_GROUPS_MAX];
    int group_count;
    int light_count; // Σ counts
    int hemisphere_count;
    int ambient_hemispheres; // the first of them, which materials reflect with ka; the others with kd
};

// Sets the choices for a range of a frame. Zeroes the struct first, so that memcmp can compare it. The caller sets
// version, storage, encoding and products. `environment` is GLSL_FACES, or none if neither material is reflective.
// LAM_STAGE_AUTO means the vertex stage with Gouraud shading, and the fragment stage with any other shading.
void glsl_choose(struct glsl_choices *choices, const struct frame *frame, const struct frame_draw_range *range,
                 lam_stage stage);

// Returns whether an output shows a value of the geometry. The fragment shader computes such outputs without lighting,
// for every shading method.
static inline bool glsl_output_is_geometry(lam_output output) { return output_kind(output) >= OUTPUT_GEOMETRY; }

// Sets choices->hardware_filter: the hardware filters the textures. The shader program then does not depend on the
// wrapping and filters of maps.
void glsl_use_hardware_filter(struct glsl_choices *choices);

struct glsl_text {
    char *vertex, *fragment; // ASCII
};

// A style of shaders other than the full style.
struct glsl_stage;
struct text;
struct glsl_style {
    // Returns whether the style supports these choices. Otherwise the error is LAM_UNSUPPORTED, and its message names
    // the unsupported option.
    bool (*check)(const struct glsl_choices *choices, const struct glsl_stage *stage, lam_error *error);
    // Appends the code of a stage, without its version and its uniforms.
    void (*add_stage)(struct text *text, const struct glsl_stage *stage);
    // Inserts the mistake choices->mistake into one of the sources `texts`. On success, all sources are freed and
    // replaced by copies. Returns false on failure.
    bool (*change)(const struct glsl_choices *choices, char **texts, int count, lam_error *error);
};

// Makes both sources. Errors: LAM_LIMIT (memory); LAM_BAD_ARGUMENT for choices that exclude each other (GLSL_TEXTURE or
// GLSL_FACES with 120, Gouraud in the fragment stage, Phong in any other stage). Outputs of the geometry ignore the
// shading method.
bool glsl_make(const struct glsl_choices *choices, struct glsl_text *text, lam_error *error);
void glsl_free(struct glsl_text *text);

// --- contents of the blocks (std140) and, with GLSL_TEXTURE, of the texels

// A light, with the layout of struct Light. With products the struct ends after `cone`; without gl1 it ends before
// `ambient`.
struct glsl_light {
    // In eye space; w is 1. In shaders with shadows, w is the radius, or negative if the light casts no shadows. In
    // these shaders, the position of a directional light is the world axis along which the light's direction has its
    // smallest component.
    float position[4];
    // the unit direction of travel in eye space; w is 0 or, with `occlusion`, the share of the light that occlusion
    // dims
    float direction[4];
    float attenuation[4]; // constant, linear, quadratic, 1 / range (0 if there is none)
    float cone[4];        // cos cutoff, exponent, cos outer, 1 / max(0.001, cos inner − cos outer)
    float diffuse[4], specular[4], ambient[4];
};

// The fields of struct Material or, with products, the head of the block Products: colours as vec4, then numbers. In
// the block, these arrays follow, with 4 floats per element: diffuse_product[lights], specular_product[lights],
// light_ambient_product[lights] (only with gl1), sky_product[hemispheres] and ground_product[hemispheres].
struct glsl_material_layout {
    int count;
    const struct material_field *fields[LAM_FIELDS_MAX];
    int at[LAM_FIELDS_MAX]; // in floats
    int size;               // in floats, a multiple of 4
};
struct glsl_material_layout glsl_material_layout(bool products, int field_layers);
enum { GLSL_MATERIAL_MAX = 4 * LAM_FIELDS_MAX };

// Returns the size in bytes (at least 16) of the block Lights or of the texels of light_list. glsl_pack_lights writes
// this data: lights and hemispheres, in the order of the groups. Without products, ambient_light comes first in the
// block.
size_t glsl_lights_bytes(const struct glsl_choices *choices);
void glsl_pack_lights(const struct glsl_choices *choices, const struct frame *frame, float *out);

// glsl_products_bytes returns the size of one material's products: the block Products or BackProducts, or the
// material's texels in product_list. glsl_pack_products writes the products. The products are, for each light, the
// diffuse, the specular and (with gl1) the ambient product, then, for each hemisphere, the products of sky and ground.
// The uniforms first_product and back_first_product contain the index of a material's first texel.
size_t glsl_products_bytes(const struct glsl_choices *choices);
void glsl_pack_products(const struct glsl_choices *choices, const struct frame *frame, const lam_material *material,
                        float *out);

// Sets the choices for the maps of a range.
void glsl_choose_maps(struct glsl_choices *choices, const struct frame *frame, const struct frame_draw_range *range);

// Returns whether a shader for these materials computes two sums of light: with and without the factor of the diffuse
// map (glsl_stage.separate_texture_terms).
bool glsl_separates_texture_terms(const struct frame *frame, const struct frame_draw_range *range);

// Returns the smallest visible opacity of a masked surface. For outputs of surface properties, only maps and vertex
// colours matter.
float glsl_alpha_cutoff(const struct frame *frame, const lam_material *material);
// Gets the emission that an emission map multiplies at each fragment (glsl_stage.maps_interpolated_light).
void glsl_mapped_emission(const struct frame *frame, const struct frame_draw_range *range, bool back, float out[4]);

// Gets the rows of a map's uniforms NAME_map_s and NAME_map_t: the matrix from the mesh's texture coordinates to the
// texture's coordinates, with the scale and the offset of the texel. A NULL map has the value 1 everywhere.
void glsl_map_values(const lam_texture_map *map, const lam_mesh *mesh, float s[4], float t[4]);

// Writes the values of glsl_material_layout(products, field_layers).
void glsl_material_values(const struct frame *frame, const lam_material *material, bool products, int field_layers,
                          float out[GLSL_MATERIAL_MAX]);
// Returns the name of a field in the shader.
const char *glsl_field_name(const struct material_field *field, bool products);

// Returns the index (in the frame) of the light that is next in the shader's order, or −1 after the last light. Lights
// of a group keep the frame's order. A zeroed cursor is before the first light.
struct glsl_light_cursor {
    int group, light;
};
int glsl_next_light(const struct glsl_choices *choices, const struct frame *frame, struct glsl_light_cursor *cursor);
struct glsl_light glsl_light_of(const struct frame_light *light);

#endif
