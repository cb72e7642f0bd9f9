// shader_constants.h: the numbers that a shader has in place of uniforms: float ambientStrength = 0.1;
#ifndef SHADER_CONSTANTS_H
#define SHADER_CONSTANTS_H

#include "shader_interface.h"

// Finds the contract's constants in the shaders, and stores their values in interface->defaults, and which they are in
// interface->constants. A variable that gets anything but numbers is none.
void shader_constants_find(struct shader_interface *interface);

#endif
