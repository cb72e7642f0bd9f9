// compiler_hints.h: explains compiler messages about spelling and syntax mistakes that occur in lectures and in
// students' shaders.
#ifndef COMPILER_HINTS_H
#define COMPILER_HINTS_H

#include "diagnostics.h"
#include "shader_interface.h"

// Adds hints for one message of the compiler about a line (0 if unknown).
void compiler_hints_for_message(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                                int line, const char *message);

// Adds hints for the source of a shader that does not compile.
void compiler_hints_for_text(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                             bool vertex);

// Adds hints about the outputs of a fragment shader that compiles. `output` is the output's name in the course, or
// NULL. Returns false if no output of the shader is floating-point, because a picture cannot store other outputs.
bool compiler_hints_for_output(struct diagnostics *diagnostics, const struct declarations *d, const char *file,
                               const char *output);

// Adds hints for two shaders that compile but do not link.
void compiler_hints_for_link(struct diagnostics *diagnostics, const struct shader_interface *interface,
                             const lam_check_params *params);

#endif
