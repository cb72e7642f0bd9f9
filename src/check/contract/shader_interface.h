// shader_interface.h: the interface of a pair of shaders: their declarations, their contract, and the subset of it that
// they have names for.
#ifndef SHADER_INTERFACE_H
#define SHADER_INTERFACE_H

#include "contract.h"

struct shader_interface {
    struct declarations vertex, fragment;
    const struct contract *contract;
    lam_check_contract which;
    unsigned supports; // bits of reference_need, and of reference_rule
    int light_count;   // declared size of the list of lights; 0: one light without a list
    bool vertex_lit;   // the fragment shader has no name of a material or light
    bool phong;        // printed by `lambent shader --reflection phong`
};

// `vertex` NULL or "": none. `which` AUTO: recognised. LAM_BAD_ARGUMENT: no contract has any of the names.
bool shader_interface_make(struct shader_interface *interface, const char *vertex, const char *fragment,
                           lam_check_contract which, lam_error *error);
// Whether one of the shaders declares a uniform with that meaning.
bool shader_interface_declares(const struct shader_interface *interface, enum uniform_semantic semantic);

void shader_interface_free(struct shader_interface *interface);

#endif
