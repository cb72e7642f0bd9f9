// contract.h: the names that each course's shaders use, their meanings, and their values in a reference scene.
#ifndef CONTRACT_H
#define CONTRACT_H

#include "declarations.h"
#include "reference_scene.h"

// The meaning of a uniform or attribute.
enum uniform_semantic {
    SEMANTIC_NONE,
    // Attributes.
    SEMANTIC_POSITION,
    SEMANTIC_NORMAL,
    SEMANTIC_TEXCOORD,
    // Uniforms.
    SEMANTIC_MODEL_VIEW,
    SEMANTIC_PROJECTION,
    SEMANTIC_MODEL_VIEW_PROJECTION,
    SEMANTIC_NORMAL_MATRIX,
    SEMANTIC_MODEL,
    SEMANTIC_VIEW,
    // Material colour times its strength; where the contract has `products`, also times the light's colour.
    SEMANTIC_AMBIENT,
    SEMANTIC_DIFFUSE,
    SEMANTIC_SPECULAR,
    // The same, times the light's colour in every contract.
    SEMANTIC_AMBIENT_PRODUCT,
    SEMANTIC_DIFFUSE_PRODUCT,
    SEMANTIC_SPECULAR_PRODUCT,
    // The strengths alone.
    SEMANTIC_KA,
    SEMANTIC_KD,
    SEMANTIC_KS,
    // The colours alone.
    SEMANTIC_COLOR,
    SEMANTIC_SPECULAR_COLOR,
    SEMANTIC_SHININESS,
    SEMANTIC_EMISSION,
    SEMANTIC_REFLECTIVITY,
    SEMANTIC_LIGHT_POSITION, // w 1; for a directional light the direction to it, w 0
    SEMANTIC_LIGHT_X,
    SEMANTIC_LIGHT_Y,
    SEMANTIC_LIGHT_Z,
    SEMANTIC_LIGHT_DIRECTION, // towards the light
    SEMANTIC_LIGHT_TRAVEL,    // away from the light; a spot's axis
    SEMANTIC_LIGHT_COLOR,
    SEMANTIC_LIGHT_SPECULAR,
    SEMANTIC_LIGHT_AMBIENT,
    SEMANTIC_AMBIENT_LIGHT, // sum over all lights
    SEMANTIC_ATTENUATION_CONSTANT,
    SEMANTIC_ATTENUATION_LINEAR,
    SEMANTIC_ATTENUATION_QUADRATIC,
    SEMANTIC_ATTENUATION, // constant, linear, quadratic, 0
    SEMANTIC_CONE,        // cosine of the cutoff, exponent, cosine of the outer angle, 1/width
    SEMANTIC_LIGHT_COUNT,
    SEMANTIC_FLAT,
    SEMANTIC_EYE_POSITION,
    SEMANTIC_LIGHT_IN_EYE, // in eye space whatever the contract's space: for generated vertex shaders
    SEMANTIC_ZERO,
    SEMANTIC_ONE,
    SEMANTIC_COUNT
};

struct contract_name {
    const char *name; // "lights[].lightPosition" for members of a list
    enum uniform_semantic semantic;
    bool attribute;
    const char *type;    // as the course declares it
    const char *meaning; // for documentation and messages
    // Other accepted names, separated by blanks. NULL: none.
    const char *synonyms;
};

// The meaning of a varying, for a fragment shader without a vertex shader.
enum varying_semantic {
    VARYING_NORMAL,          // unit, eye space
    VARYING_LIGHT,           // towards the light, not normalized
    VARYING_EYE,             // towards the eye, not normalized
    VARYING_POSITION,        // in eye space
    VARYING_OBJECT_POSITION, // in object space
    VARYING_DISTANCE,        // to the light
    VARYING_TEXCOORD,
};

struct contract_varying {
    const char *names; // separated by blanks
    enum varying_semantic semantic;
};

struct contract {
    const char *name, *title;
    const struct contract_name *names;       // ends with NULL
    const struct contract_varying *varyings; // ends with NULL
    // Built-in names whose use identifies the contract. Ends with NULL.
    const char *const *built_ins;
    unsigned supports; // bits of reference_need
    // LAM_FRAME_OBJECT: light positions are transformed by the model-view matrix like vertices. LAM_FRAME_CAMERA: they
    // are in eye space.
    lam_light_frame light_frame;
    bool products; // material colours come multiplied by the light's
    bool has_ambient, has_attenuation, own_ambient_color, light_colors, material_strengths;
    lam_reflection reflection;
    // > 0: the course's constant, which shaders contain as a number.
    float shininess;
    // Likewise, where `attenuated_points`.
    float attenuation[3];
    bool attenuated_points;
};

extern const struct contract contracts[];
const struct contract *contract_of(lam_check_contract which);

// The contract that most of the shaders' names belong to. NULL: none has any of them.
const struct contract *contract_recognise(const struct declarations *vertex, const struct declarations *fragment,
                                          lam_check_contract *which);

// The row of a name. "lights[0].lightColor" is looked up as "lights[].lightColor", and its index is stored in `index`
// (may be NULL), 0 outside of lists. NULL: unknown.
const struct contract_name *contract_find(const struct contract *contract, const char *name, bool attribute,
                                          int *index);

// The row of a varying's name. NULL: unknown.
const struct contract_varying *contract_varying(const struct contract *contract, const char *name);

// The contract's name most similar to an unknown one. NULL: none is similar.
const char *contract_nearest(const struct contract *contract, const char *name);

// The name that the shaders use for a semantic: their own, else the contract's, else NULL.
const char *contract_name_used(const struct contract *contract, enum uniform_semantic semantic,
                               const struct declarations *vertex, const struct declarations *fragment);

// The reference scene as the contract can express it: parameters without a name take the contract's fixed values.
// `supports`: of shader_interface; `light_count`: the shaders' light capacity.
struct reference_scene contract_reference_scene(const struct contract *contract, unsigned supports,
                                                const struct reference_scene *reference_scene, int light_count);

// The value of a uniform; matrices by columns.
struct uniform_value {
    float v[16];
};
struct uniform_value matrix_value(const lam_mat4 *m);
struct uniform_value uniform_semantic_value(enum uniform_semantic semantic, int light, const struct contract *contract,
                                            lam_light_frame light_frame, const struct reference_scene *reference_scene,
                                            const struct reference_matrices *m);

#endif
