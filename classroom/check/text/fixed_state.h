// fixed_state.h: the lights and materials of OpenGL's fixed state, as GLSL 110 and 120 read them.
#ifndef FIXED_STATE_H
#define FIXED_STATE_H

#include <lambent/base.h>

// A text that reads uniforms of its own where it read gl_LightSource, gl_FrontMaterial and the like, so that they can be given
// values: fixed_LightSource[i].position. `other`: the text of the other stage, which may be NULL. From malloc. `ok` false: no memory. NULL otherwise: it reads none of them.
char *fixed_state_rewrite(const char *text, const char *other, bool *ok);

// Whether a name is one of these, or a member of one: gl_LightSource[].position.
bool fixed_state_has(const char *name);

#endif
