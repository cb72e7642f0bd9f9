// name_similarity.h: estimates, from spelling, sound and role, how likely it is that the author of a shader confused
// two names.
#ifndef NAME_SIMILARITY_H
#define NAME_SIMILARITY_H

#include <stdbool.h>

// Returns 1 for names that are equal except for case and underscores, and 0 for unrelated names. Names whose words have
// different roles (light and eye, ambient and diffuse, position and direction) are unrelated, even if they look
// similar. Words with the same role are treated as equal (position and point, eye and camera, normal and N).
double name_similarity(const char *a, const char *b);

// Returns whether two names are equal except for case and underscores.
bool name_is_same(const char *a, const char *b);

// Returns the candidate most similar to `name`, or the first of several equally similar candidates. Returns NULL if no
// candidate is similar enough to be suggested. Skips NULL candidates.
const char *name_nearest(const char *name, const char *const *candidates, int count);

#endif
