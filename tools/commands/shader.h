// shader.h: prints a scene's shaders as text for people, as C code that sets their inputs, and as JSON.
#ifndef SHADER_COMMAND_H
#define SHADER_COMMAND_H

#include <lambent/lambent.h>

#include <stdio.h>

// The attributes, the uniforms and their values, as comments (`//` before each line).
void shader_contract(FILE *file, const lam_shader *shader);

// C code that compiles the sources and sets their inputs. `name`: of the files, `.vert` and `.frag` left out.
void shader_host(FILE *file, const lam_shader *shader, const char *name, const char *model);

// All of it on one line.
void shader_json(FILE *file, const lam_shader *shader, const char *model);

// Whether a mistake of --mistake is known. False: the error, with the nearest name.
bool shader_mistake_is_known(const char *name, lam_error *error);

// "1, 0.5, 0": each with the fewest digits that give the same float; as C code "1, 0.5f, 0".
void shader_numbers(FILE *file, const float *values, int count, bool code);

#endif
