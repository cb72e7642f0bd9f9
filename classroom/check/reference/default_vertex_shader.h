// default_vertex_shader.h: generates a correct vertex shader for a fragment shader without one.
#ifndef DEFAULT_VERTEX_SHADER_H
#define DEFAULT_VERTEX_SHADER_H

#include "shader_interface.h"

// Returns the text, from malloc. It writes every varying that the fragment shader reads, by name and type. Unknown
// varyings are set to zero; the used ones are listed in `unknown`, separated by ", ". Returns NULL and fills `error` on
// failure.
char *default_vertex_shader(const struct shader_interface *interface, char unknown[256], lam_error *error);

#endif
