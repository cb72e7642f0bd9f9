// glsl_declarations.h: the table of a shader's attributes, uniforms, blocks and structs. The declarations and the values in
// lam_shader come from this table.
#ifndef GLSL_DECLARATIONS_H
#define GLSL_DECLARATIONS_H

#include "glsl.h"
#include "text_builder.h"

// The value of a uniform.
enum glsl_semantic {
    GLSL_MODEL_VIEW_PROJECTION,
    GLSL_MODEL_VIEW,
    GLSL_NORMAL_MATRIX,
    GLSL_ENVIRONMENT_MATRIX,
    GLSL_ENVIRONMENT,
    GLSL_ENVIRONMENT_LIGHT,
    GLSL_OCCLUSION,
    GLSL_LIGHT_LIST,
    GLSL_PRODUCT_LIST,
    GLSL_FIRST_PRODUCT,
    GLSL_AMBIENT_LIGHT,
    GLSL_LIGHTS,      // array of structs
    GLSL_HEMISPHERES, // array of structs
    GLSL_PASSED,      // array: the fraction of each light that reaches the point
    GLSL_MATERIAL,    // struct
    GLSL_HEAD,        // a field of the material that is not one of the products
    GLSL_DIFFUSE_PRODUCT,
    GLSL_SPECULAR_PRODUCT,
    GLSL_LIGHT_AMBIENT_PRODUCT,
    GLSL_SKY_PRODUCT,
    GLSL_GROUND_PRODUCT,
    GLSL_OBJECT,
    GLSL_EXPOSURE,
    GLSL_MAP,   // the sampler of a map
    GLSL_MAP_S, // glsl_map_values
    GLSL_MAP_T,
    GLSL_ALPHA_CUTOFF,
    GLSL_MAPPED_EMISSION, // glsl_mapped_emission
};

struct glsl_row {
    enum glsl_semantic semantic;
    const char *type; // "vec4", "Light"
    char name[32];
    int count;         // elements of an array; 0 if not an array
    const char *block; // NULL for a plain uniform
    const char *meaning;
    bool back; // belongs to the back material
    // The offset of a value, in floats, within struct glsl_light, the material, or a hemisphere (up, sky, ground).
    int at;
    lam_map map; // the map, for values of the kinds GLSL_MAP…
};
enum { GLSL_ROWS_MAX = 30 + 2 * LAM_FIELDS_MAX + 6 * LAM_MAP_COUNT };

// Properties of a shader that follow from its choices. Each property is a member of struct glsl_stage and a flag of the
// sources (glsl_text.h).
// clang-format off
#define GLSL_FACTS(X) \
    /* light, and the stage that evaluates it */ \
    X(application) /* the program lights the vertices */ \
    X(per_vertex) /* the vertex shader lights them */ \
    X(per_fragment) /* the fragment shader lights the fragments, or writes a value of the geometry */ \
    X(lit) /* the shader has a function light_point */ \
    X(unlit) /* the surface has its diffuse colour */ \
    X(adds_lights) /* light_point sums terms of lights */ \
    X(has_lights) /* light_point reads lights */ \
    X(has_hemispheres) \
    X(has_falloff) /* any light has a falloff */ \
    X(has_cone) /* any light has a cone */ \
    X(positions) /* at least one light is not directional */ \
    X(directions) /* at least one light is not a point light */ \
    /* output */ \
    X(output_geometry) /* a value of the geometry */ \
    X(output_vector) /* a vector, or a cosine of one light */ \
    X(output_one_light) /* a cosine of one light */ \
    X(output_material) /* a property of the material at the point; the surface is unlit */ \
    X(shows_level) /* the level of detail of a map */ \
    /* surface */ \
    X(back_material) /* the back has its own material */ \
    X(needs_normal) /* light_point reads the normal */ \
    X(needs_position) \
    X(needs_tangent) /* light_point reads a tangent */ \
    X(needs_tangent_attribute) \
    X(signed_tangent) /* the fragment shader reads the tangent and the sign of the bitangent */ \
    X(vertex_colors) /* light_point reads vertex colours */ \
    X(needs_vertex_color) /* the fragment shader reads vertex colours */ \
    /* material */ \
    X(highlights) /* the reflection model has a highlight */ \
    X(microfacet) /* the Fresnel factor colours it */ \
    X(toned) /* its second term is Gooch's tone */ \
    X(layered) /* layers lie over the surface */ \
    X(has_clearcoat) X(has_anisotropy) \
    X(one_point) /* all samples of a triangle in a pixel are lit at one point */ \
    X(widens_roughness) /* the variance of the normals increases the roughness */ \
    X(has_transmission) /* the fragment shader computes the transmitted light */ \
    X(converts) /* a side's material is converted (glsl_choices.converted) */ \
    X(has_mask) /* a side is masked */ \
    X(value_masks) /* a side is masked, and the fragment shader writes a value of the surface, or one_point */ \
    /* maps */ \
    X(has_maps) /* the fragment shader reads maps */ \
    X(has_normal_map) X(has_bump_map) \
    X(has_coat_normal_map) /* a normal map of the clear coat */ \
    X(first_texcoords) /* maps use the first texture coordinates */ \
    X(second_texcoords) \
    X(maps_interpolated_light) /* the fragment applies maps to light that was evaluated without them */ \
    X(separate_texture_terms) /* with that: the terms that a diffuse map multiplies are separate from the others */ \
    /* environment and occlusion */ \
    X(has_environment) /* light_point reads the environment */ \
    X(environment_light) /* the environment lights a physical material */ \
    X(occluded) /* the fragment shader reads ambient occlusion */ \
    /* the written colour, and the stage */ \
    X(encodes) /* the fragment shader encodes light as sRGB */ \
    X(premultiplied) /* the colour is multiplied by the opacity */ \
    X(glsl_120) \
    X(fragment) /* the stage is the fragment shader */
// Members of struct glsl_choices that are also flags of the sources, with the same names.
#define GLSL_CHOICE_FLAGS(X) \
    X(distant_viewer) X(gl1) X(two_sided) X(tangents) X(products) X(single_scattering) X(passes_rays) X(tints_rays) X(catches) X(shadows)
// clang-format on

struct glsl_stage {
    const struct glsl_choices *choices;
    lam_shading shading;         // PHONG for outputs of the geometry
    int layers;                  // LAYER_… that light_point adds
    bool maps[2][LAM_MAP_COUNT]; // the maps that the shader reads for the front and back materials
#define FACT(name) bool name;
    GLSL_FACTS(FACT)
#undef FACT
};
struct glsl_stage glsl_stage_of(const struct glsl_choices *choices);
// Returns the facts of one stage.
struct glsl_stage glsl_stage_of_kind(const struct glsl_stage *stage, bool fragment);
// Returns whether the reflection model uses the material parameter with this name in LOBE_PARAMETERS
// (src/core/lighting/lobes.h).
bool glsl_lobe_reads(const struct glsl_stage *stage, const char *parameter);
// Appends the expression of the colour, `ka` or `kd`, that multiplies hemisphere light i.
void glsl_add_sky_color(struct text *text, const struct glsl_choices *c, const char *ka, const char *kd);
// Appends the lines that select the parameters of the lobe from the front or the back material, for shaders with
// products and two materials.
void glsl_add_parameters(struct text *text, const struct glsl_stage *stage);
// Finds the maps that a shader uses. The other facts must already be set.
void glsl_find_maps(struct glsl_stage *stage);
// Returns the map whose sampler `map` uses: the first map of this side with the same texels, possibly `map` itself.
lam_map glsl_map_owner(const struct glsl_stage *stage, int side, lam_map map);
// Returns whether the reflection model lights physical materials.
bool glsl_is_physical(const struct glsl_stage *stage);
// Returns whether the struct of map values has a member with this name.
bool glsl_maps_have(const struct glsl_stage *stage, const char *member);
// A member of struct layer_values whose value is a field of the material times the value of a map (layer_inputs.h).
struct glsl_layer_input {
    char member[28], field[28]; // stored as arrays, because pointers would need relocation at program start
    lam_map map;                // LAM_MAP_COUNT: none
    bool color;
};
const struct glsl_layer_input *glsl_layer_input(int index);                             // NULL past the end
const struct glsl_layer_input *glsl_layer_input_of(const struct material_field *field); // may be NULL
// Appends the lines that set the members of `given` (struct layer_values), except the vectors.
void glsl_add_layers(struct text *text, const struct glsl_stage *stage);
// Appends the struct with the values from maps, and the functions that fill this struct.
void glsl_add_maps(struct text *text, const struct glsl_stage *stage);

// Append an expression for a material parameter. An own parameter is the value from the material and its maps.
// Otherwise, the expression is the value that lighting uses.
void glsl_add_own_parameter(struct text *text, const struct glsl_stage *stage, const char *name);
void glsl_add_parameter(struct text *text, const struct glsl_stage *stage, const char *name);
// Appends the call that evaluates the lobe for the light sample `t`: "reflected_of(phong_lobe(s, t.l), shininess)".
void glsl_add_lobe(struct text *text, const struct glsl_stage *stage);

// Returns the name of a tone curve's function, or "".
const char *glsl_tone_function(lam_tone tone);

// Lists the uniforms of both shaders in the order of their declarations. The values in each block have the same order.
// Returns their number.
int glsl_declarations(const struct glsl_stage *stage, struct glsl_row rows[GLSL_ROWS_MAX]);

struct glsl_attribute {
    int location;
    const char *type, *name, *meaning;
};
enum { GLSL_ATTRIBUTES_MAX = 11 };
// Lists the vertex attributes. Returns their number.
int glsl_attributes(const struct glsl_stage *stage, struct glsl_attribute rows[GLSL_ATTRIBUTES_MAX]);

// Lists the members of a struct type. Returns their number, or 0 if `type` is not a struct.
int glsl_members(const struct glsl_stage *stage, const char *type, struct glsl_row rows[GLSL_ROWS_MAX]);
// Writes the value of element `index` of a uniform, or of a member of that element. Matrices are written in
// column-major order. Returns the number of floats; 0 for textures and for the projection, which depends on the window.
struct glsl_uniform_source {
    const struct frame *frame;
    const struct frame_draw_range *range; // NULL for uniforms of the frame
    const int *order; // the shader's light i is the frame's light order[i]; NULL if no row reads a light
};
int glsl_uniform_value(const struct glsl_choices *choices, const struct glsl_uniform_source *from,
                       const struct glsl_row *row, const struct glsl_row *member, int index, float out[16]);
// Append the declarations.
void glsl_declare_attributes(struct text *text, const struct glsl_stage *stage);
void glsl_declare(struct text *text, const struct glsl_stage *stage, bool fragment);

#endif
