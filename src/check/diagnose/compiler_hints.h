// compiler_hints.h: what compilers mean. Mistakes of spelling and grammar that lectures print and students make.
#ifndef COMPILER_HINTS_H
#define COMPILER_HINTS_H

#include "diagnostics.h"

// For one message of the compiler at a line (0: unknown).
void compiler_hints_of_message(struct diagnostics *notes, const struct declarations *d, const char *file, int line,
                               const char *words);

// For the whole text of a shader that does not compile.
void compiler_hints_of_text(struct diagnostics *notes, const struct declarations *d, const char *file, bool vertex);

// For a fragment shader that compiles: what it writes. False where it writes no colour that a picture can hold.
bool compiler_hints_of_output(struct diagnostics *notes, const struct declarations *d, const char *file);

// For two shaders that compile and do not link.
void compiler_hints_of_link(struct diagnostics *notes, const struct shader_interface *reading,
                            const lam_check_params *params);

#endif
