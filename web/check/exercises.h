// exercises.h: the exercises of the page's shaders: the known mistakes of `lambent shader --mistake`.
#ifndef EXERCISES_H
#define EXERCISES_H

#include <lambent/lambent.h>

struct json;

// Member "exercises": each mistake's id, what one sees, and what is wrong.
void exercises_list(struct json *json);

// Prints the texts with a mistake, those without it, and which highlight they have. False: no mistake has this id, or memory.
bool exercise_put(const char *mistake, lam_error *error);

#endif
