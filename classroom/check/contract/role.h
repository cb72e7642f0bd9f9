// role.h: the roles (meanings) that a contract can assign to a name.
#ifndef ROLE_H
#define ROLE_H

#include <lambent/check.h>

// The meaning of a uniform or attribute.
enum uniform_semantic {
    SEMANTIC_NONE,
    // Attributes.
    SEMANTIC_POSITION,
    SEMANTIC_NORMAL,
    SEMANTIC_TEXCOORD,
    SEMANTIC_TANGENT,
    SEMANTIC_BITANGENT,
    // Uniforms.
    SEMANTIC_MODEL_VIEW,
    SEMANTIC_PROJECTION,
    SEMANTIC_MODEL_VIEW_PROJECTION,
    SEMANTIC_NORMAL_MATRIX,
    SEMANTIC_MODEL,
    SEMANTIC_VIEW,
    SEMANTIC_VIEW_PROJECTION,
    // The colour of the material times its strength.
    SEMANTIC_AMBIENT,
    SEMANTIC_DIFFUSE,
    SEMANTIC_SPECULAR,
    // The product of the material's colour, its strength and the light's colour.
    SEMANTIC_AMBIENT_PRODUCT,
    SEMANTIC_DIFFUSE_PRODUCT,
    SEMANTIC_SPECULAR_PRODUCT,
    SEMANTIC_LIGHT_AMBIENT_PRODUCT, // the product for one light, which the light's attenuation reduces
    // The strengths only.
    SEMANTIC_KA,
    SEMANTIC_KD,
    SEMANTIC_KS,
    // The colours only.
    SEMANTIC_COLOR,
    SEMANTIC_SPECULAR_COLOR,
    SEMANTIC_SHININESS,
    SEMANTIC_METALLIC,
    SEMANTIC_ROUGHNESS,
    SEMANTIC_ROUGHNESS_ANGLE, // Oren–Nayar's sigma
    SEMANTIC_EMISSION,        // factor of the emission map; 0 if there is no emission map
    // Maps: textures with one texel, which differs between scenes (maps.h).
    SEMANTIC_BASE_COLOR_MAP,
    SEMANTIC_METALLIC_ROUGHNESS_MAP,
    SEMANTIC_METALLIC_MAP,
    SEMANTIC_ROUGHNESS_MAP,
    SEMANTIC_NORMAL_MAP,
    SEMANTIC_OCCLUSION_MAP,
    SEMANTIC_EMISSION_MAP,
    // a row of the matrix from the mesh's texture coordinates to a map's coordinates; the texel is multiplied by w
    SEMANTIC_MAP_ROW_U,
    SEMANTIC_MAP_ROW_V, // the second row of this matrix; w is added to the texel
    // the position with w = 1 or, for a directional light, the direction towards the light with w = 0
    SEMANTIC_LIGHT_POSITION,
    SEMANTIC_LIGHT_X,
    SEMANTIC_LIGHT_Y,
    SEMANTIC_LIGHT_Z,
    SEMANTIC_LIGHT_DIRECTION, // towards the light
    SEMANTIC_LIGHT_TRAVEL,    // the direction away from the light, or a spot's axis
    SEMANTIC_LIGHT_COLOR,
    SEMANTIC_LIGHT_SPECULAR,
    SEMANTIC_LIGHT_AMBIENT,
    SEMANTIC_ATTENUATION_CONSTANT,
    SEMANTIC_ATTENUATION_LINEAR,
    SEMANTIC_ATTENUATION_QUADRATIC,
    SEMANTIC_ATTENUATION,  // constant, linear, quadratic, 0
    SEMANTIC_CONE,         // cosine of the cutoff, exponent, cosine of the outer angle, 1/width
    SEMANTIC_CUTOFF,       // cosine of the cutoff; −1 if the light is not a spot light
    SEMANTIC_OUTER_CUTOFF, // cosine of an angle just outside the cutoff
    SEMANTIC_SPOT_EXPONENT,
    SEMANTIC_AMBIENT_LIGHT, // the sum over all lights
    SEMANTIC_LIGHT_COUNT,
    SEMANTIC_LIGHT_KIND, // in the order of KHR_lights_punctual: 0 directional, 1 point, 2 spot
    SEMANTIC_FLAT,
    SEMANTIC_EYE_POSITION,
    SEMANTIC_ZERO,
    SEMANTIC_ONE,
    SEMANTIC_FACTOR, // a colour or strength, the same in every scene
    SEMANTIC_COUNT
};

// The kinds of input to which a role can be assigned.
enum role_use {
    ROLE_ATTRIBUTE = 1,
    ROLE_UNIFORM = 2,
    // belongs to one light: the element of an array lights[i], or the light whose struct contains the name
    ROLE_LIGHT = 4,
    ROLE_IN_SPACE = 8, // a position or direction in a space
    ROLE_CONSTANT = 16 // a shader may contain a number for this role
};
enum role_type {
    TYPE_SCALAR = 1, // float, int, bool
    TYPE_VEC2 = 2,
    TYPE_VECTOR = 4, // vec3, vec4
    TYPE_MATRIX = 8, // mat3, mat4
    TYPE_SAMPLER = 16,
};

struct role {
    enum uniform_semantic semantic;
    const char *name; // in contract files
    unsigned uses;    // bits of role_use
    unsigned types;   // bits of role_type
    const char *meaning;
};

extern const struct role roles[];
extern const int role_count;

const struct role *role_of(enum uniform_semantic semantic); // never NULL

#endif
