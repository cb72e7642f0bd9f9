// default_vertex_shader.h: generates a correct vertex shader for a fragment shader that is checked alone.
#ifndef DEFAULT_VERTEX_SHADER_H
#define DEFAULT_VERTEX_SHADER_H

#include "shader_interface.h"

// Returns the source, allocated with malloc. The vertex shader writes every varying that the fragment shader declares
// as an input, with the same name and type. The vertex shader sets unknown varyings to zero. `unknown` lists the
// unknown varyings that the fragment shader uses, separated by ", ". On failure, sets `error` and returns NULL.
char *default_vertex_shader(const struct shader_interface *interface, char unknown[256], lam_error *error);

#endif
