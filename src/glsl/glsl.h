// glsl.h: GLSL text for a set of choices, and the values of its uniforms from a frame.
//
// The text is the equations (src/lighting, the words in plain GLSL, what is not called left out) and the
// files
// *.glsl of this folder, whose lines are chosen by the flags that follow from the choices (shader_preprocess.h).
//
// Names in the text. Attributes, with their locations (GLSL 120: bound by name):
//     0 position, 1 normal, 2 color, 3 tangent, 4 front_color, 5 back_color, 6 provoking_position.
// Uniforms: model_view_projection, model_view, normal_matrix, and what uniforms.glsl declares. All colours
// are vec4, so that a list of them has one layout everywhere (std140, a texture's texels, glUniform4fv).
#ifndef GLSL_H
#define GLSL_H

#include "fields.h"
#include "frame.h"

enum glsl_version { GLSL_120, GLSL_330, GLSL_300_ES };

// Where the lists of lights and of products stand.
enum glsl_storage {
    GLSL_ARRAY,   // plain uniforms: lights[i].position
    GLSL_BLOCK,   // std140 blocks Lights and Products (or Materials), BackProducts
    GLSL_TEXTURE, // RGBA32F textures light_list and product_list, GLSL_LIST_WIDTH texels wide; not in 120
};
enum { GLSL_LIST_WIDTH = 1024 };

enum glsl_output {
    GLSL_ENCODED,       // clamped to 0…1 and sRGB-encoded: for a plain 8-bit window
    GLSL_STRAIGHT,      // as the equations give it, not premultiplied
    GLSL_PREMULTIPLIED, // colour × alpha: for blending in linear light
};

enum glsl_environment {
    GLSL_NO_ENVIRONMENT,
    GLSL_CUBE, // samplerCube environment, bilinear and seamless, no mipmaps
    // sampler2DArray environment_faces: six bordered faces as src/scene/cube_map.h has them, read as cube_lookup.h
    // reads them (330, 300 es)
    GLSL_FACES,
};

// Pictures whose translucent surfaces are peeled layer by layer (gl_passes.c); 330 and 300 es. A second
// target, `place`, takes the depth and the number of the triangle of each pixel.
enum glsl_layer {
    GLSL_NO_LAYERS,
    GLSL_WRITES_PLACES, // an opaque surface
    GLSL_PEELS,         // a layer: what lies behind nearer_places and not behind opaque_places
};

// Lights of one kind stand side by side in the lists and are looped over with their kind as a constant.
struct glsl_group {
    int kind, falloff; // LIGHT_…, FALLOFF_… of src/lighting/light_kinds.h
    int count;
};
enum { GLSL_KINDS = 5, GLSL_FALLOFFS = 3, GLSL_GROUPS_MAX = GLSL_KINDS * GLSL_FALLOFFS };

// Equal choices give equal texts. Zero a struct before filling it in, and it may be compared by memcmp.
struct glsl_choices {
    enum glsl_version version;
    enum glsl_storage storage;
    enum glsl_output output;
    enum glsl_environment environment;
    enum glsl_layer layer;
    lam_stage stage; // never AUTO
    lam_shading shading;
    lam_reflection reflection; // never AUTO
    lam_output show;           // a term, a vector or a place; COVERAGE and OVERDRAW give 1, CLIPPED the picture
    bool distant_viewer;
    bool gl1;
    bool exposes;       // the fragment multiplies its light by the uniform `exposure`
    bool products;      // uniforms are ka·La, kd·Ld, ks·Ls; else material and light come apart
    bool two_sided;     // the back is lit with −n
    bool back_material; // and has a material of its own
    bool colors;        // attribute color
    bool tangents;      // attribute tangent; else the direction field, where the model asks for one
    struct glsl_group groups[GLSL_GROUPS_MAX];
    int group_count;
    int light_count; // Σ counts
    int hemisphere_count;
};

// What a frame's draw asks for. Left to the caller: version, storage, output, products. `environment` is
// GLSL_FACES or none (where neither material mirrors). Stage: `stage`, for AUTO fragment, or vertex with
// Gouraud shading.
struct glsl_choices glsl_choose(const struct frame *frame, const struct frame_draw_range *surface, lam_stage stage);

struct glsl_text {
    char *vertex, *fragment; // ASCII
};

// Writes both sources. False: LAM_LIMIT (memory), LAM_BAD_ARGUMENT (choices that do not go together: a
// texture or FACES with 120, Gouraud in the fragment stage, Phong in another; shows that are places are per
// fragment whatever the shading).
bool glsl_make(const struct glsl_choices *choices, struct glsl_text *text, lam_error *error);
void glsl_free(struct glsl_text *text);

// --- values, std140, of the lists: what the blocks hold and, with GLSL_TEXTURE, the texels

// One light as struct Light has it. With products the struct ends after `cone`; without gl1 before `ambient`.
struct glsl_light {
    float position[4];    // eye space; w 1
    float direction[4];   // eye space, unit, the way it travels; w 0
    float attenuation[4]; // constant, linear, quadratic, 1 / range (0: none)
    float cone[4];        // cos cutoff, exponent, cos outer, 1 / max(0.001, cos inner − cos outer)
    float diffuse[4], specular[4], ambient[4];
};

// The fields of struct Material (and of an element of the block Materials), or with products those of the head of the
// block Products: colours as vec4, then numbers. After the head: diffuse_product[lights], specular_product[lights], with
// gl1 light_ambient_product[lights], sky_product[hemispheres], ground_product[hemispheres], 4 floats each.
struct glsl_material_layout {
    int count;
    const struct material_field *fields[LAM_FIELDS_MAX];
    int at[LAM_FIELDS_MAX]; // in floats
    int size;               // in floats, a multiple of 4
};
struct glsl_material_layout glsl_material_layout(bool products);
enum { GLSL_MATERIAL_MAX = 4 * LAM_FIELDS_MAX };

// Bytes of the block Lights (block: [ambient_light, where products are not] lights, hemispheres) or of the
// texels of light_list (lights, hemispheres); at least 16. Then the values, from the frame: order by groups.
size_t glsl_lights_bytes(const struct glsl_choices *choices);
void glsl_pack_lights(const struct glsl_choices *choices, const struct frame *frame, float *out);

// The same for one material's products, block Products or BackProducts; and for its part of product_list,
// whose texels are for each light diffuse, specular [, ambient], then for each hemisphere sky, ground. The
// list's first texel is the uniform first_product, back_first_product.
size_t glsl_products_bytes(const struct glsl_choices *choices);
void glsl_pack_products(const struct glsl_choices *choices, const struct frame *frame, const lam_material *material,
                        float *out);

// The values of that layout (with GLSL_TEXTURE and GLSL_ARRAY the head's members are plain uniforms).
void glsl_material_values(const struct frame *frame, const lam_material *material, bool products,
                          float out[GLSL_MATERIAL_MAX]);
// The name of a field there.
const char *glsl_field_name(const struct material_field *field, bool products);

// Light i of the text's list; −1 past the end. Lights of a group keep the frame's order.
int glsl_frame_light(const struct glsl_choices *choices, const struct frame *frame, int i);
struct glsl_light glsl_light_of(const struct frame_light *light);

#endif
