// glsl_rows.h: a table of a shader's attributes, uniforms, blocks and structs, from which come the declarations in its
// text and the values in its contract (lam_shader).
#ifndef GLSL_ROWS_H
#define GLSL_ROWS_H

#include "glsl.h"
#include "shader_preprocess.h"

// The value that a uniform holds.
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
    GLSL_PASSED,      // array of the lights' shares that nothing keeps from the surface
    GLSL_MATERIAL,    // struct
    GLSL_HEAD,        // a field of the material, beside the products
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
    GLSL_GLOW, // glsl_glow
};

struct glsl_row {
    enum glsl_semantic semantic;
    const char *type; // "vec4", "Light"
    char name[32];
    int count;         // of array elements; 0: not an array
    const char *block; // NULL: a plain uniform
    const char *meaning;
    bool back; // belongs to the back material
    // Offset in floats of a member or a head: in struct glsl_light, in the material, or in up, sky, ground.
    int at;
    lam_map map; // of GLSL_MAP…
};
enum { GLSL_ROWS_MAX = 30 + 2 * LAM_FIELDS_MAX + 6 * LAM_MAP_COUNT };

// Properties of a shader that follow from its choices.
struct glsl_facts {
    const struct glsl_choices *choices;
    lam_shading shading; // PHONG for outputs of the geometry
    bool application, per_vertex, per_fragment;
    bool output_geometry, output_vector;
    bool output_one_light;       // an output_vector of one light
    bool output_material;        // what the material is at the point; the surface is unlit
    bool unlit;                  // the surface has its diffuse colour
    bool lit;                    // the shader has a function light_point
    bool adds_lights;            // light_point sums terms of lights
    bool lights, hemispheres;    // light_point reads them
    bool attenuated;             // any light has a falloff
    bool cones;                  // any light has a cone
    bool positions;              // any light is not directional
    bool directions;             // any light is not a point
    bool highlights;             // the reflection model has a highlight
    bool microfacet;             // Fresnel's factor colours it
    bool tangent;                // light_point reads a tangent
    bool environment;            // light_point reads the environment
    bool environment_light;      // as light of a physical material
    bool occlusion;              // the fragment shader reads ambient occlusion
    bool back_material;          // the back has a material of its own
    bool mapped;                 // the fragment shader reads maps
    bool maps[2][LAM_MAP_COUNT]; // those of the front, of the back
    bool texcoords[2];           // the sets of texture coordinates that they read
    bool bends;                  // a normal map
    bool tilts;                  // a bump map
    int layers;                  // LAYER_… that light_point adds
    bool coat_bends;             // a normal map of the clear coat
    bool coat_normal;            // light_point gets the coat's normal, which is not the other layers'
    bool turns;                  // light_point gets the sign of the bitangent
    bool signed_tangent;         // the tangent attribute has that sign, and the fragment shader reads it
    bool converts;               // a side's material is converted (glsl_choices.converted)
    bool masks;                  // a side is masked
    bool value_masks;            // and the fragment writes a number of the surface
    bool late;                   // the fragment applies maps to light that was evaluated without them
    bool apart;                  // late, with the light that the diffuse map multiplies apart from the rest
};
struct glsl_facts glsl_facts_of(const struct glsl_choices *choices);

// Whether the reflection model reads a parameter of the material, by its name in LOBE_PARAMETERS
// (src/lighting/lobes.h).
bool glsl_lobe_reads(const struct glsl_facts *facts, const char *parameter);
// With products and two materials: appends the lines that select these parameters from the front or the back material.
void glsl_add_parameters(struct text *text, const struct glsl_facts *facts);
// Finds the maps that a shader reads; the other facts are there.
void glsl_find_maps(struct glsl_facts *facts);
// The map whose sampler another one uses: itself, or the first one of its side with the same texels.
lam_map glsl_map_owner(const struct glsl_facts *facts, int side, lam_map map);
// Whether the reflection model lights physical materials.
bool glsl_is_physical(const struct glsl_facts *facts);
// Whether the maps' struct has a member of this name.
bool glsl_maps_have(const struct glsl_facts *facts, const char *member);
// A member of struct layer_values that is a field of the material, times its map's value (layer_inputs.h).
struct glsl_layer_input {
    const char *member, *field;
    lam_map map; // LAM_MAP_COUNT: none
    bool color;
};
const struct glsl_layer_input *glsl_layer_input(int index);                             // NULL past the end
const struct glsl_layer_input *glsl_layer_input_of(const struct material_field *field); // NULL: none
// Appends the lines that set the variable `given`, of struct layer_values, except for its vectors.
void glsl_add_layers(struct text *text, const struct glsl_facts *facts);
// Appends the struct of what maps say of a point, and the functions that fill it.
void glsl_add_maps(struct text *text, const struct glsl_facts *facts);

// Appends the expression of a parameter of the material.
void glsl_add_parameter(struct text *text, const struct glsl_facts *facts, const char *name);
// Appends the call that evaluates the lobe for the light sample `t`: "reflected_of(phong_lobe(s, t.l), shininess)".
void glsl_add_lobe(struct text *text, const struct glsl_facts *facts);

// The function of a tone curve; "": none.
const char *glsl_tone_function(lam_tone tone);

// Lists the uniforms of both shaders in the order of their declaration, which is also the layout of each block. Returns
// their number.
int glsl_rows(const struct glsl_facts *facts, struct glsl_row rows[GLSL_ROWS_MAX]);

struct glsl_attribute {
    int location;
    const char *type, *name, *meaning;
};
enum { GLSL_ATTRIBUTES_MAX = 11 };
// Lists the vertex attributes. Returns their number.
int glsl_attributes(const struct glsl_facts *facts, struct glsl_attribute rows[GLSL_ATTRIBUTES_MAX]);

// Whether the vertex shader (`fragment` false) or the fragment shader reads a uniform.
bool glsl_row_is_in(const struct glsl_facts *facts, const struct glsl_row *row, bool fragment);
// Lists the members of a struct type. Returns their number; 0: `type` is not a struct.
int glsl_members(const struct glsl_facts *facts, const char *type, struct glsl_row rows[GLSL_ROWS_MAX]);
// Append the declarations.
void glsl_declare_attributes(struct text *text, const struct glsl_facts *facts);
void glsl_declare(struct text *text, const struct glsl_facts *facts, bool fragment);

#endif
