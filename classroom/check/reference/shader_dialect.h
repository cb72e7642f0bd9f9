// shader_dialect.h: determines the language of a pair of shaders, and converts the sources for the compiler.
#ifndef SHADER_DIALECT_H
#define SHADER_DIALECT_H

#include "shader_interface.h"

// Returns the compiler for the shaders. Shaders without a version line are for WebGL (OpenGL ES) if they contain a
// precision statement or qualifier and use no built-in name of desktop OpenGL.
lam_check_language shader_dialect_language(const struct shader_interface *interface);

// Returns whether the source contains `mediump` or `lowp`, or reads textures with lowp, the default precision of
// samplers in OpenGL ES.
bool shader_dialect_lowers_precision(const char *text);

// Returns a copy of the source, allocated with malloc. In the copy, `highp` replaces every `mediump` and `lowp`, and
// samplers are `highp`. Line numbers do not change. For lower precisions, drivers may compute with 16 bits. The
// pictures of a correct shader would then differ visibly. Returns NULL if memory runs out.
char *shader_dialect_highp(const char *text);

// Returns the source without a leading byte order mark. Some editors write this mark, but compilers reject it.
const char *shader_dialect_skip_mark(const char *text);

// Converts a source in desktop GLSL to GLSL ES 3.00. Returns the copy, allocated with malloc. Line numbers do not
// change. The copy contains another version line, a precision, the keywords of ES 3.00 instead of older keywords, and
// other names for OpenGL's built-in inputs. The compiler reports remaining differences, such as implicit conversion to
// floats. Returns NULL and fills
// `error` on failure.
char *shader_dialect_es(const char *text, bool is_vertex, lam_error *error);

// Returns the built-in input for a name in a converted source, as a static row, or NULL if there is none.
const struct contract_name *shader_dialect_built_in(const char *name);

// Restores the author's names, in place, in messages about a converted source.
void shader_dialect_restore(char *log);

// --- generates a correct vertex shader for a fragment shader that is checked alone.

// Returns the source, allocated with malloc. The vertex shader writes every varying that the fragment shader declares
// as an input, with the same name and type. The vertex shader sets unknown varyings to zero. `unknown` lists the
// unknown varyings that the fragment shader uses, separated by ", ". On failure, sets `error` and returns NULL.
char *default_vertex_shader(const struct shader_interface *interface, char unknown[256], lam_error *error);

#endif
