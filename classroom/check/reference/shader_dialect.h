// shader_dialect.h: which language a pair of shaders is written in, and the text as it is compiled there.
#ifndef SHADER_DIALECT_H
#define SHADER_DIALECT_H

#include "shader_interface.h"

// The compiler of the shaders. Without a version line they are WebGL's, thus for OpenGL ES, if they have a precision
// statement or qualifier and no name that only desktop OpenGL has built in.
lam_check_language shader_dialect_language(const struct shader_interface *interface);

// Whether the text contains `mediump` or `lowp`, or reads textures with the precision that samplers have in OpenGL ES where
// nothing is said: lowp.
bool shader_dialect_lowers_precision(const char *text);

// A copy of the text, from malloc, with `highp` for every `mediump` and `lowp`, and for samplers, on the same lines.
// Drivers may compute those with 16 bits, which is visible in a picture although the shader is correct. NULL: out of
// memory.
char *shader_dialect_highp(const char *text);

// The text after a byte order mark, which some editors write and no compiler accepts.
const char *shader_dialect_skip_mark(const char *text);

// A copy of a text in desktop GLSL, from malloc, in GLSL ES 3.00 on the same lines: another version line, a precision,
// ES 3.00's words for older ones, and other names for OpenGL's built-in inputs. Differences that remain, such as
// implicit conversion to floats, are left for the compiler to refuse. NULL: see `error`.
char *shader_dialect_es(const char *text, bool is_vertex, lam_error *error);

// The built-in input behind a name of such a text, a static row. NULL: none does.
const struct contract_name *shader_dialect_built_in(const char *name);

// Restores the author's names in messages about such a text, in place.
void shader_dialect_restore(char *log);

#endif
