// shader_constants.h: the numbers that a shader contains instead of uniforms: float ambientStrength = 0.1;
#ifndef SHADER_CONSTANTS_H
#define SHADER_CONSTANTS_H

#include "shader_interface.h"

// Finds the contract's constants in the shaders, and stores their values in interface->defaults and their semantics in
// interface->constants. A variable that is also set to something other than numbers is not a constant.
void shader_constants_find(struct shader_interface *interface);

enum { MAX_NUMBERS = 12 };

// Lists the semantics that the contract allows as constants, but for which the shaders contain no recognised constant.
// Returns the number of these semantics.
int shader_constants_open(const struct shader_interface *interface, enum uniform_semantic out[SEMANTIC_COUNT]);

// Lists the distinct numbers, or vec3 of numbers, in the source of the shader that computes the lighting. Numbers that
// cannot have the semantic are omitted. Returns the length of the list, which is at most MAX_NUMBERS.
int shader_constants_values(const struct shader_interface *interface, enum uniform_semantic semantic,
                            double out[MAX_NUMBERS][3]);

void shader_constants_set(struct shader_interface *interface, enum uniform_semantic semantic, const double value[3]);

// Returns a hash of the numbers.
uint64_t shader_constants_hash(const struct shader_interface *interface);

#endif
