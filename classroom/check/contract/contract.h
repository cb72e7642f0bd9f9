// contract.h: the names that each course's shaders use, and the requirements of its exercise.
#ifndef CONTRACT_H
#define CONTRACT_H

#include "arena.h"
#include "declarations.h"
#include "json_reader.h"
#include "reference_scene.h"

#include <lambent/check.h>

#include <stdbool.h>

// --- the roles (meanings) that a contract can assign to a name.

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
    SEMANTIC_ROUGHNESS_ANGLE, // Oren–Nayar's sigma, or the steps of toon shading: bits of 64 roles are in use
    SEMANTIC_EMISSION,        // factor of the emission map; 0 if there is no emission map
    // Maps: textures with one texel, which differs between scenes.
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
_Static_assert(SEMANTIC_COUNT <= 64, "sets of roles are bits of uint64_t");

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

struct contract_name {
    const char *name; // for members of an array, "lights[].lightPosition"
    enum uniform_semantic semantic;
    bool attribute;
    const char *type;    // the type in the course's declaration
    const char *meaning; // the meaning, for documentation and messages
    // Other accepted names, separated by blanks. May be NULL.
    const char *synonyms;
    lam_light_frame space; // the space of a role with ROLE_IN_SPACE: OBJECT, WORLD or CAMERA
    int group;             // for ROLE_LIGHT, the index in contract.groups; −1 if the name belongs to no light
};

// The meaning of a varying, for a fragment shader without a vertex shader.
enum varying_semantic {
    VARYING_NORMAL,   // unit
    VARYING_LIGHT,    // towards the light, not normalized
    VARYING_EYE,      // towards the eye, not normalized
    VARYING_POSITION, // the point's position
    VARYING_DISTANCE, // the distance to the light
    VARYING_TEXCOORD,
};

struct contract_varying {
    const char *names; // separated by blanks
    enum varying_semantic semantic;
    lam_light_frame space;
};

// The source of a colour for which a shader declares no name: the scene, another colour, or a constant.
enum color_source { COLOR_OF_SCENE, COLOR_GIVEN, COLOR_OF_DIFFUSE, COLOR_OF_LIGHT };
struct default_color {
    enum color_source source;
    lam_rgb value; // COLOR_GIVEN
};
struct default_number {
    bool given; // if false, the scene's value is used
    float value;
};

// The values of inputs that a shader does not declare.
struct contract_defaults {
    struct default_color ambient_color, diffuse_color, specular_color;
    struct default_color light_color, light_specular, light_ambient;
    struct default_number ambient_strength, diffuse_strength, specular_strength, shininess, spot_exponent;
    bool has_attenuation, has_direction, has_position;
    float attenuation[3];
    lam_vec3 direction; // the direction towards the light or, if has_position is set, the light's position
    int light_space;    // the space of these vectors; by default the contract's space
};

// A variable that a shader sets to a number: `float ambientStrength = 0.1;`. If its name is "pow", the number is the
// second argument of pow().
struct contract_constant {
    const char *name;
    enum uniform_semantic semantic;
};

// The lighting of a contract's shaders with metalness and roughness. The defaults follow glTF 2.0, appendix B. The
// check accepts equally correct forms, and diagnoses other known forms as mistakes (fault_table.c).
enum masking {
    MASKING_SMITH,  // Smith's masking for GGX, height-correlated
    MASKING_SCHLICK // Schlick's approximation, k = (roughness + 1)²/8
};
enum diffuse_share {
    DIFFUSE_OF_DIELECTRIC, // (1 - metallic)(1 - F), F with F0 = 0.04
    DIFFUSE_OF_MIX,        // (1 - metallic)(1 - F), F with F0 = mix(0.04, base colour, metallic)
    DIFFUSE_WHOLE          // 1 - metallic
};
enum tone_curve { TONE_NONE, TONE_REINHARD };
enum encoding { ENCODING_NONE, ENCODING_GAMMA }; // pow(x, 1/2.2)
struct physical_convention {
    enum masking masking;
    enum diffuse_share diffuse;
    enum tone_curve tone;
    enum encoding encoding;
};

// The contents of a contract's maps.
struct map_convention {
    // If true, colour maps are encoded with pow(x, 1/2.2), and the shader decodes them. If false, the shader reads
    // linear colours, as from textures with an sRGB format.
    bool encoded;
    // v increases downwards in the texture, as in glTF files. On a patch whose u points right and whose normal points
    // to the eye, v points down.
    bool v_down;
};

// Forms that a contract may require. If the contract does not require a form, the check also accepts the
// form's counterpart (fault.h).
enum contract_demand {
    DEMAND_GATE = 1,         // there is no highlight if n.l <= 0
    DEMAND_UNIT_NORMALS = 2, // normals are also normalized in the vertex shader
    DEMAND_BARE_AMBIENT = 4, // the ambient term is not attenuated
};

enum contract_term { TERM_AMBIENT = 1, TERM_DIFFUSE = 2, TERM_SPECULAR = 4 };
enum { MAX_LIGHT_GROUPS = 8, MAX_WEIGHTS = 32 };

struct contract {
    const char *name, *title, *text;         // `text` is the contents of the file
    uint64_t hash;                           // the hash of `text`
    const char *versions;                    // GLSL versions, separated by ", "; "" if not stated
    const struct contract_name *names;       // ends with NULL
    const struct contract_varying *varyings; // ends with NULL
    // Built-in names whose use identifies the contract. Ends with NULL.
    const char *const *built_ins;
    // The structs and arrays of lights, such as "lights[]" and "sun"; "" for names that belong to no struct or array.
    const char *groups[MAX_LIGHT_GROUPS];
    int group_count;
    unsigned supports;     // bits of reference_need
    unsigned terms;        // bits of contract_term
    unsigned demands;      // bits of contract_demand
    lam_light_frame space; // the space in which lighting is computed: CAMERA (eye space) or WORLD
    // The space of the first light: OBJECT (the model-view matrix transforms the light like the vertices), WORLD or
    // CAMERA.
    lam_light_frame light_frame;
    lam_reflection reflection;
    struct contract_defaults defaults;
    struct physical_convention physical; // used by shaders with metalness and roughness
    struct map_convention maps;
    const struct contract_constant *constants; // ends with NULL
    // The lines that an engine inserts before the source of a shader. Such a source contains no version line and
    // declares none of these names. May be NULL.
    const char *prefix_vertex, *prefix_fragment;
    const char *outputs;     // names of the fragment shader's output, separated by blanks; NULL if not stated
    bool has_attenuation;    // names or constants determine the attenuation
    bool material_strengths; // colours and their strengths are separate inputs
    bool any_strengths; // shaders contain their own strengths and colours; the check fits these values to the pictures
    // True for GLSL 110 and 120, whose shaders use gl_LightSource and similar state. The check rewrites such shaders
    // (prefix.h).
    bool fixed_state;
    const double *weights; // the weight of each reference scene in the grade
    bool printed;          // the contract of `lambent shader`, whose shaders contain one loop for each kind of light
};

// A contract that owns its memory.
struct lam_check_contract {
    struct contract contract;
    struct arena arena;
};

enum { MAX_CONTRACTS = 16 };
// Reads the shipped contracts. The caller frees them with lam_check_contract_free.
bool contracts_read(lam_check_contract *out[MAX_CONTRACTS], int *count, lam_error *error);

// Returns the row of a name, or NULL if the name is unknown. "lights[0].lightColor" is looked up as
// "lights[].lightColor". `index` (may be NULL) receives the array index, or 0 for other names.
const struct contract_name *contract_find(const struct contract *contract, const char *name, bool attribute,
                                          int *index);

// Returns the row of a varying's name, or NULL if the name is unknown.
const struct contract_varying *contract_varying(const struct contract *contract, const char *name);

// Returns the nearest of `words` that is not `name` itself, by lam_word_distance. Returns NULL if the distance exceeds a third
// of the name's length. Entries of `words` may be NULL.
const char *name_nearest(const char *name, const char *const *words, int count);

// Returns the name in the contract that is most similar to an unknown name, or NULL if no name is similar.
const char *contract_nearest(const struct contract *contract, const char *name);

// Returns the name with this role: a name that the shaders declare, otherwise the contract's name, otherwise NULL. A
// name may mean the product of the material's colour and the light's colour.
const char *contract_name_used(const struct contract *contract, enum uniform_semantic semantic,
                               const struct declarations *vertex, const struct declarations *fragment);

// The value of a uniform. Matrices are stored in column-major order.
struct uniform_value {
    float v[16];
};
struct uniform_value matrix_value(const lam_mat4 *m);
// Returns the value of a uniform. `space` matters only for roles with ROLE_IN_SPACE.
struct uniform_value uniform_semantic_value(enum uniform_semantic semantic, int light, lam_light_frame space,
                                            const struct reference_scene *reference_scene,
                                            const struct reference_matrices *m);

// --- the maps of a shader in a reference scene. Each map has one texel, so that filters, wraps and levels of detail
// have no effect. The texel differs between scenes.
//
// If a shader reads a map instead of a number, the texel is the number. If a shader multiplies a factor by a map, the
// product of the factor and the texel is the number. The factor and the texel then differ from each other and from 1.

static inline bool is_map(enum uniform_semantic semantic)
{
    return semantic >= SEMANTIC_BASE_COLOR_MAP && semantic <= SEMANTIC_EMISSION_MAP;
}

// Returns the bit of a map in reference_scene.maps and .factors.
static inline unsigned map_bit(enum uniform_semantic map) { return 1u << (map - SEMANTIC_BASE_COLOR_MAP); }

// The values of a material that a map can multiply.
enum map_number { NUMBER_BASE_COLOR, NUMBER_METALLIC, NUMBER_ROUGHNESS, NUMBER_OCCLUSION, NUMBER_EMISSION };

// Returns the factor of a number; `whole` is the product of the factor and the texel. If the map replaces the number,
// the factor is 1. If there is no map, the factor is `whole`.
float map_factor(const struct reference_scene *scene, enum map_number number, float whole);

// Returns the texel of a map, as the sampler reads it.
struct uniform_value map_texel(enum uniform_semantic map, const struct reference_scene *scene);

// --- declares the functions that read the sections of a contract's file.

struct contract_reader {
    struct json_reader json;
    struct arena *arena;
    struct contract *contract;
    struct contract_name *names; // the names read so far, which become contract->names
    int name_count;
};

extern const struct json_choice contract_spaces[]; // eye, world, object

// Returns true if the object contains no comment, or if the comment is a string or an array of strings. The content of
// the comment is ignored.
bool contract_check_comment(struct contract_reader *r, const struct place *place, const json_t *object);

// Reports LAM_LIMIT. Returns false.
bool contract_no_memory(const struct contract_reader *r);

// Returns whether a text can be a name in GLSL. With `plain`, members and arrays are not allowed.
bool contract_check_name(const struct contract_reader *r, const struct place *place, const char *name, bool plain);

// Reads an array of strings and joins them with `between`; returns NULL if the array is empty. With `of_names`, each
// string must be a valid name.
bool contract_read_list(struct contract_reader *r, const struct place *place, const json_t *list, const char *between,
                        bool of_names, bool plain, const char **out);

// Read the sections of the file.
bool contract_read_names(struct contract_reader *r, const json_t *root);    // attributes, uniforms, built_ins
bool contract_read_varyings(struct contract_reader *r, const json_t *root); // after `space`
bool contract_read_defaults(struct contract_reader *r, const json_t *root); // undeclared
bool contract_read_constants(struct contract_reader *r, const json_t *root);
bool contract_read_prefix(struct contract_reader *r, const json_t *root);
bool contract_read_physical(struct contract_reader *r, const json_t *root);
bool contract_read_maps(struct contract_reader *r, const json_t *root);

#endif
