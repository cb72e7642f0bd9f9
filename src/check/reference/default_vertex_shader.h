// default_vertex_shader.h: a correct vertex shader for a fragment shader that comes alone.
#ifndef DEFAULT_VERTEX_SHADER_H
#define DEFAULT_VERTEX_SHADER_H

#include "shader_interface.h"

// The text, from malloc: it writes every varying that the fragment shader reads, told by name and type; what
// it does not know gets zeros and is named in `unknown` (separated by ", "). NULL: memory is out.
char *default_vertex_shader(const struct shader_interface *reading, char unknown[256], lam_error *error);

#endif
