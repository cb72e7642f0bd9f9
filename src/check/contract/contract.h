// contract.h: the names that shaders of each course use, what they mean, and their values for a reference scene.
#ifndef CONTRACT_H
#define CONTRACT_H

#include "declarations.h"
#include "reference_scene.h"

// What a uniform or attribute holds.
enum uniform_semantic {
    ROLE_NONE,
    ROLE_POSITION, // attributes
    ROLE_NORMAL,
    ROLE_TEXCOORD,
    ROLE_MODEL_VIEW, // uniforms
    ROLE_PROJECTION,
    ROLE_MODEL_VIEW_PROJECTION,
    ROLE_NORMAL_MATRIX,
    ROLE_MODEL,
    ROLE_VIEW,
    ROLE_AMBIENT, // colour of the material times its strength, and times the light's where `products`
    ROLE_DIFFUSE,
    ROLE_SPECULAR,
    ROLE_AMBIENT_PRODUCT, // the same, times the light's in any contract
    ROLE_DIFFUSE_PRODUCT,
    ROLE_SPECULAR_PRODUCT,
    ROLE_KA, // the strengths alone
    ROLE_KD,
    ROLE_KS,
    ROLE_COLOR, // the colours alone
    ROLE_SPECULAR_COLOR,
    ROLE_SHININESS,
    ROLE_EMISSION,
    ROLE_REFLECTIVITY,
    ROLE_LIGHT_POSITION, // w 1; of a directional light the direction to it, w 0
    ROLE_LIGHT_X,
    ROLE_LIGHT_Y,
    ROLE_LIGHT_Z,
    ROLE_LIGHT_DIRECTION, // to the light
    ROLE_LIGHT_TRAVEL,    // the way it travels; a spot's axis
    ROLE_LIGHT_COLOR,
    ROLE_LIGHT_SPECULAR,
    ROLE_LIGHT_AMBIENT,
    ROLE_AMBIENT_LIGHT, // of all lights together
    ROLE_ATTENUATION_CONSTANT,
    ROLE_ATTENUATION_LINEAR,
    ROLE_ATTENUATION_QUADRATIC,
    ROLE_ATTENUATION, // constant, linear, quadratic, 0
    ROLE_CONE,        // cos cutoff, exponent, cos outer, 1/width
    ROLE_LIGHT_COUNT,
    ROLE_FLAT,
    ROLE_EYE_POSITION,
    ROLE_LIGHT_IN_EYE, // for vertex shaders that the check makes: in eye space whatever the contract says
    ROLE_ZERO,
    ROLE_ONE,
    ROLE_COUNT
};

struct contract_name {
    const char *name; // "lights[].lightPosition" for members of a list
    enum uniform_semantic role;
    bool attribute;
    const char *type;     // as the course has it
    const char *meaning;  // for docs and messages
    const char *synonyms; // other names taken for it, separated by blanks; NULL: none
};

// What a varying of a lone fragment shader holds.
enum carried {
    CARRIED_NORMAL,          // unit, eye space
    CARRIED_LIGHT,           // to the light, not unit
    CARRIED_EYE,             // to the eye, not unit
    CARRIED_POSITION,        // in eye space
    CARRIED_OBJECT_POSITION, // in the model's space
    CARRIED_DISTANCE,        // to the light
    CARRIED_TEXCOORD,
};

struct contract_varying {
    const char *names; // separated by blanks
    enum carried carried;
};

struct contract {
    const char *name, *title;
    const struct contract_name *names;       // ends with NULL
    const struct contract_varying *varyings; // ends with NULL
    const char *const *built_ins;            // words that tell the contract besides; ends with NULL
    unsigned offers;                         // study needs that it can meet
    lam_light_frame light_frame; // object: light positions go by the model-view like vertices; camera: eye space
    bool products;               // colours come multiplied by the light's
    bool has_ambient, has_attenuation, own_ambient_color, light_colors, material_strengths;
    lam_reflection reflection;
    float shininess;        // > 0: a constant of the course that shaders write themselves
    float attenuation[3];   // likewise; all 0: free
    bool attenuated_points; // those constants hold
};

extern const struct contract contracts[];
const struct contract *contract_of(lam_check_contract which);

// The contract that most of the shaders' names belong to. NULL where none has any.
const struct contract *contract_recognise(const struct declarations *vertex, const struct declarations *fragment,
                                          lam_check_contract *which);

// The row of a name ("lights[0].lightColor" is looked up as "lights[].lightColor"); NULL: unknown. `index`
// (may be NULL) gets the list's index, 0 outside of lists.
const struct contract_name *contract_find(const struct contract *contract, const char *name, bool attribute,
                                          int *index);

// What a varying of a lone fragment shader is taken for; NULL: unknown.
const struct contract_varying *contract_varying(const struct contract *contract, const char *name);

// The known name nearest to an unknown one; NULL: none is near.
const char *contract_nearest(const struct contract *contract, const char *name);

// The name that the shaders use for a role: their own, else the contract's, else NULL.
const char *contract_name_used(const struct contract *contract, enum uniform_semantic role,
                               const struct declarations *vertex, const struct declarations *fragment);

// The study as the contract can say it: what it has no names for takes the contract's fixed values.
// `offers`: of the contract's, what the shaders have names for, and study rules (shader_interface.h); `light_count`:
// the lights that they have room for.
struct reference_scene contract_reference_scene(const struct contract *contract, unsigned offers,
                                                const struct reference_scene *reference_scene, int light_count);

// Up to 16 numbers of a uniform, matrices by columns; a role has as many as its nature: returns the count.
int uniform_semantic_value(enum uniform_semantic role, int light, const struct contract *contract,
                           lam_light_frame light_frame, const struct reference_scene *reference_scene,
                           const struct reference_matrices *m, float out[16]);

#endif
