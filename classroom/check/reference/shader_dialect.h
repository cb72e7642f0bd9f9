// shader_dialect.h: determines the language of a pair of shaders, and converts the text for its compiler.
#ifndef SHADER_DIALECT_H
#define SHADER_DIALECT_H

#include "shader_interface.h"

// Returns the compiler for the shaders. Shaders without a version line are for WebGL (OpenGL ES) if they contain a
// precision statement or qualifier and use no built-in name of desktop OpenGL.
lam_check_language shader_dialect_language(const struct shader_interface *interface);

// Returns whether the text contains `mediump` or `lowp`, or reads textures with the default precision of samplers in
// OpenGL ES, lowp.
bool shader_dialect_lowers_precision(const char *text);

// Returns a copy of the text, from malloc, with `highp` instead of every `mediump` and `lowp`, and as the precision of
// samplers. Line numbers do not change. Drivers may compute lower precisions with 16 bits, which is visible in a
// picture even if the shader is correct. Returns NULL if memory runs out.
char *shader_dialect_highp(const char *text);

// Returns the text without a leading byte order mark, which some editors write and compilers reject.
const char *shader_dialect_skip_mark(const char *text);

// Returns a copy of a text in desktop GLSL, from malloc, converted to GLSL ES 3.00. Line numbers do not change. The
// copy has another version line, a precision, the keywords of ES 3.00 instead of older keywords, and other names for
// OpenGL's built-in inputs. The compiler reports remaining differences, such as implicit conversion to floats. Returns
// NULL and fills
// `error` on failure.
char *shader_dialect_es(const char *text, bool is_vertex, lam_error *error);

// Returns the built-in input for a name of such a text, as a static row, or NULL if there is none.
const struct contract_name *shader_dialect_built_in(const char *name);

// Restores the author's names in messages about such a text, in place.
void shader_dialect_restore(char *log);

#endif
