// exercises.h: the exercises of the tab of shaders. They contain the mistakes of `lambent shader --mistake`.
#ifndef EXERCISES_H
#define EXERCISES_H

#include <lambent/lambent.h>

struct json;

// Writes the member "exercises": the id, visible effect and description of each mistake.
void exercises_list(struct json *json);

// Prints the texts with a mistake, the texts without it, and their highlight. Returns false if no mistake has this id,
// or if memory is insufficient.
bool exercise_put(const char *mistake, lam_error *error);

#endif
