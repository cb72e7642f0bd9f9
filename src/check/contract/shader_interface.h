// shader_interface.h: the interface of a pair of shaders: their declarations, their contract, and the subset of it that
// they have names for.
#ifndef SHADER_INTERFACE_H
#define SHADER_INTERFACE_H

#include "contract.h"

struct shader_interface {
    struct declarations vertex, fragment;
    const struct contract *contract;
    uint64_t declared, used; // bit i: a shader declares a uniform of semantic i, and reads it
    unsigned supports;       // bits of reference_need, and of reference_rule
    int light_count;         // declared size of the list of lights; 0: one light without a list
    bool vertex_lit;         // the fragment shader has no name of a material or light
    bool phong;              // printed by `lambent shader --reflection phong`
};

// `vertex` NULL or "": none. `contract` must outlive the interface.
bool shader_interface_make(struct shader_interface *interface, const char *vertex, const char *fragment,
                           const struct contract *contract, lam_error *error);
void shader_interface_free(struct shader_interface *interface);

// Whether one of the shaders declares a uniform with that meaning, and whether it also reads it.
bool shader_interface_declares(const struct shader_interface *interface, enum uniform_semantic semantic);
bool shader_interface_uses(const struct shader_interface *interface, enum uniform_semantic semantic);

// The reference scene as the shaders can express it: what they have no name for takes the contract's fixed values.
// `light_count`: the shaders' light capacity.
struct reference_scene shader_interface_scene(const struct shader_interface *interface,
                                              const struct reference_scene *reference_scene, int light_count);

#endif
