// shader_interface.h: the interface of a pair of shaders: their declarations, their contract, and the subset of it that
// they have names for.
#ifndef SHADER_INTERFACE_H
#define SHADER_INTERFACE_H

#include "prefix.h"

// The lights of one struct or list of a contract.
struct light_group {
    int count;      // of lights that the shaders declare; 0: none
    unsigned kinds; // NEED_POINT, NEED_DIRECTIONAL, NEED_SPOT: their possible kinds
    bool list, has_direction;
};

struct shader_interface {
    struct declarations vertex, fragment;
    const struct contract *contract;
    uint64_t declared, used; // bit i: a shader declares a uniform of semantic i, and reads it
    uint64_t constants;      // bit i: it has a number of semantic i
    // The maps that they read (map_bit), and of these those whose factor they declare too. A map declares its number.
    unsigned maps, factors;
    bool has_tangents; // as attributes: the frame of a normal map need not come from derivatives
    // The contract's, with the numbers that the shaders have instead.
    struct contract_defaults defaults;
    // The space of the shaders' lighting, CAMERA or WORLD, and of their first light.
    lam_light_frame space, light_frame;
    unsigned supports; // bits of reference_need, and of reference_rule
    // As contract->groups. If the shaders declare no light, the first one is the light that the contract fixes.
    struct light_group groups[MAX_LIGHT_GROUPS];
    bool vertex_lit; // the fragment shader has no name of a material or light
    bool physical;   // metalness and roughness: contract->physical says how they are lit
    // Of a shader printed by `lambent shader`: its reflection model, tone curve, and whether mirrors send light to one another.
    // AUTO, AUTO and false: another shader, or Lambert's model.
    lam_reflection printed_model;
    lam_tone printed_tone;
    bool multiple_scattering;
    bool infinite_viewer, gl1; // likewise: --viewer infinite, --gl1
};

// The interface of a program's texts. `contract` must outlive it.
bool shader_interface_make(struct shader_interface *interface, const struct complete_texts *texts,
                           const struct contract *contract, lam_error *error);
void shader_interface_free(struct shader_interface *interface);

// Whether one of the shaders declares a uniform with that meaning, and whether it also reads it.
bool shader_interface_declares(const struct shader_interface *interface, enum uniform_semantic semantic);
bool shader_interface_uses(const struct shader_interface *interface, enum uniform_semantic semantic);

// Raises the sizes of lists that the text does not state to the driver's.
void shader_interface_set_counts(struct shader_interface *interface, const int counts[MAX_LIGHT_GROUPS]);

// The number of lights that the shaders have room for, at least 1.
int shader_interface_light_count(const struct shader_interface *interface);

// The reference scene as the shaders can express it: undeclared inputs get the contract's fixed values, and lights of
// missing kinds are omitted.
struct reference_scene shader_interface_scene(const struct shader_interface *interface,
                                              const struct reference_scene *reference_scene);

// The light of such a scene in element `element` of a group; −1: none, it is black.
int shader_interface_light(const struct shader_interface *interface, const struct reference_scene *scene, int group,
                           int element);

#endif
