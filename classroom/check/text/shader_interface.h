// shader_interface.h: the interface of a pair of shaders: their declarations, their contract, and the features of the
// contract that their names can express.
#ifndef SHADER_INTERFACE_H
#define SHADER_INTERFACE_H

#include <lambent/material.h>

#include "declarations.h"
#include "prefix.h"

// The lights of one struct or array of a contract.
struct light_group {
    int count;      // number of lights that the shaders declare, or 0
    unsigned kinds; // the possible kinds of the lights: NEED_POINT, NEED_DIRECTIONAL, NEED_SPOT
    bool list, has_direction;
};

struct shader_interface {
    struct declarations vertex, fragment; // owned by the struct complete_texts
    const struct contract *contract;
    uint64_t declared, used; // bit i is set if a shader declares, or reads, a uniform of semantic i
    uint64_t constants;      // bit i is set if a shader contains a constant of semantic i
    // The maps that the shaders read (map_bit), and the maps whose factor they also declare. A value with a map is
    // treated as declared.
    unsigned maps, factors;
    bool has_tangents; // tangents are attributes, so the frame of a normal map does not require derivatives
    // The contract's values, or the numbers that the shaders contain.
    struct contract_defaults defaults;
    // The space in which the shaders compute lighting (CAMERA or WORLD), and the space of the first light.
    lam_light_frame space, light_frame;
    unsigned supports; // bits of reference_need, and of reference_rule
    // The groups, in the order of contract->groups. If the shaders declare no light, the first group is the light that
    // the contract fixes.
    struct light_group groups[MAX_LIGHT_GROUPS];
    bool vertex_lit; // the fragment shader declares no name of a material or light
    bool physical;   // the shaders use metalness and roughness; contract->physical describes the lighting
    // For a shader printed by `lambent shader`: its reflection model, its tone curve, and whether it computes multiple
    // scattering. For other shaders and for the Lambert model, the values are AUTO, AUTO and false.
    lam_reflection printed_model;
    lam_tone printed_tone;
    bool multiple_scattering;
    bool infinite_viewer, gl1; // set for printed shaders: --viewer infinite, --gl1
};

// Makes the interface of a program from its declarations. `texts` and `contract` must outlive the interface.
bool shader_interface_make(struct shader_interface *interface, const struct complete_texts *texts,
                           const struct contract *contract, lam_error *error);

// Return whether one of the shaders declares, or reads, a uniform with this semantic.
bool shader_interface_declares(const struct shader_interface *interface, enum uniform_semantic semantic);
bool shader_interface_uses(const struct shader_interface *interface, enum uniform_semantic semantic);

// Raises the size of an array to the size that the driver reports, if the source does not state the size.
void shader_interface_set_counts(struct shader_interface *interface, const int counts[MAX_LIGHT_GROUPS]);

// Returns the number of lights that the shaders support, at least 1.
int shader_interface_light_count(const struct shader_interface *interface);

// Returns the version of the reference scene that the shaders can express: undeclared inputs have the contract's fixed
// values, and lights of missing kinds are omitted.
struct reference_scene shader_interface_scene(const struct shader_interface *interface,
                                              const struct reference_scene *reference_scene);

// Returns the light of a scene from shader_interface_scene that belongs to element `element` of a group, or −1 if the
// element is black.
int shader_interface_light(const struct shader_interface *interface, const struct reference_scene *scene, int group,
                           int element);

// --- the numbers that a shader contains instead of uniforms: float ambientStrength = 0.1;

// Finds the contract's constants in the shaders, and stores their values in interface->defaults and their semantics in
// interface->constants. A variable that is also set to something other than numbers is not a constant.
void shader_constants_find(struct shader_interface *interface);

// Returns a hash of the numbers.
uint64_t shader_constants_hash(const struct shader_interface *interface);

// --- parses the source of a shader printed by `lambent shader --style lecture` to find out which lighting
// the shader computes. The parser recognises the lines of src/gpu/glsl/lecture/lecture.glsl, even if they contain a known
// mistake.

// Returns the restrictions on the kinds of lights (reference_rule), or 0 if the shader is not in the lecture style.
unsigned lecture_light_rules(const struct declarations *lit);

// Returns the reflection model of a shader in the lecture style; AUTO means the Lambert model.
lam_reflection lecture_model(const struct declarations *lit);

// Returns whether a shader in the lecture style uses an infinitely distant viewer: the vector to the eye is then a
// constant.
bool lecture_viewer_is_infinite(const struct declarations *lit);

#endif
