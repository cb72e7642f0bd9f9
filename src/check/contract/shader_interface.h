// shader_interface.h: two shaders as read: their declarations, the contract, and what of it they can be told.
#ifndef SHADER_INTERFACE_H
#define SHADER_INTERFACE_H

#include "contract.h"

struct shader_interface {
    struct declarations vertex, fragment;
    const struct contract *contract;
    lam_check_contract which;
    unsigned offers; // of the contract's, what these shaders have names for; and study rules
    int light_count; // declared room of the list of lights; 0: no list, one light
    bool vertex_lit; // the fragment shader names nothing of materials or lights
    bool phong;      // printed by `lambent shader --reflection phong`
};

// `vertex` NULL or "": none. `which` AUTO: recognised. LAM_BAD_ARGUMENT: no contract's names are found.
bool shader_interface_make(struct shader_interface *r, const char *vertex, const char *fragment,
                           lam_check_contract which, lam_error *error);
void shader_interface_free(struct shader_interface *r);

#endif
