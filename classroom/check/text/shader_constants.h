// shader_constants.h: the numbers that a shader has in place of uniforms: float ambientStrength = 0.1;
#ifndef SHADER_CONSTANTS_H
#define SHADER_CONSTANTS_H

#include "shader_interface.h"

// Finds the contract's constants in the shaders, and stores their values in interface->defaults, and which they are in
// interface->constants. A variable that gets anything but numbers is none.
void shader_constants_find(struct shader_interface *interface);

enum { MAX_NUMBERS = 12 };

// The meanings that the contract lets a number have, whose number was not found. Returns their count.
int shader_constants_open(const struct shader_interface *interface, enum uniform_semantic out[SEMANTIC_COUNT]);

// The different numbers of the text of the shader that lights, or its vec3 of numbers, that may have a meaning. Returns
// their count; those past MAX_NUMBERS are left out.
int shader_constants_values(const struct shader_interface *interface, enum uniform_semantic semantic,
                            double out[MAX_NUMBERS][3]);

void shader_constants_set(struct shader_interface *interface, enum uniform_semantic semantic, const double value[3]);

// Differs between interfaces with different numbers.
uint64_t shader_constants_hash(const struct shader_interface *interface);

#endif
