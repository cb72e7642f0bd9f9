// fixed_state.h: the lights and materials of OpenGL's fixed-function state, which GLSL 110 and 120 can read.
#ifndef FIXED_STATE_H
#define FIXED_STATE_H

#include <lambent/base.h>

// Rewrites a shader so that it reads uniforms such as fixed_LightSource[i].position, instead of gl_LightSource,
// gl_FrontMaterial and similar state. A program can set these uniforms. `other` is the source of the other stage and
// may be NULL. The result is allocated with malloc. Returns NULL if the shader reads no fixed-function state. Also
// returns NULL, and sets *ok to false, if memory runs out.
char *fixed_state_rewrite(const char *text, const char *other, bool *ok);

// Returns whether a name is part of the fixed-function state, or of a struct in this state: gl_LightSource[].position.
bool fixed_state_has(const char *name);

#endif
