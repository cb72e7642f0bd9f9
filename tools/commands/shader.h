// shader.h: prints a scene's shaders: as text, as C code that sets their inputs, and as JSON.
#ifndef SHADER_COMMAND_H
#define SHADER_COMMAND_H

#include <lambent/shader.h>

#include <stdio.h>

// Prints C code that compiles the sources and sets their inputs. `name` is the name of the files without `.vert` and
// `.frag`.
void shader_host(FILE *file, const lam_shader *shader, const char *name, const char *model);

// Prints the shaders and their inputs as one line of JSON.
void shader_json(FILE *file, const lam_shader *shader, const char *model);

// Returns whether `name` is a known mistake (--mistake). If not, the error suggests a similar name.
bool shader_mistake_is_known(const char *name, lam_error *error);

// Prints numbers, each with the fewest digits that parse to the same float: "1, 0.5, 0", or as C code "1, 0.5f, 0".
void shader_numbers(FILE *file, const float *values, int count, bool code);

#endif
