// shader_dialect.h: which OpenGL context a pair of shaders is written for, and the text as it is compiled there.
#ifndef SHADER_DIALECT_H
#define SHADER_DIALECT_H

#include "context.h"
#include "shader_interface.h"

// The context that compiles the shaders. Without a version line they are WebGL's, thus for OpenGL ES, if they have a
// precision statement or qualifier and no name that only desktop OpenGL has built in.
enum gl_profile shader_dialect_profile(const struct shader_interface *interface);

// Whether the text contains `mediump` or `lowp`.
bool shader_dialect_lowers_precision(const char *text);

// A copy of the text, from malloc, with `highp` for every `mediump` and `lowp`, on the same lines. Drivers may compute
// those with 16 bits, which is visible in a picture although the shader is correct. NULL: out of memory.
char *shader_dialect_highp(const char *text);

// The text after a byte order mark, which some editors write and no compiler accepts.
const char *shader_dialect_skip_mark(const char *text);

#endif
