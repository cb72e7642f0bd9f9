// name_similarity.h: estimates the likelihood that one name of a shader was meant instead of another: by spelling, by
// sound, and by role.
#ifndef NAME_SIMILARITY_H
#define NAME_SIMILARITY_H

// 1: equal except for case and underscores; 0: unrelated. Names whose words differ in role (light and eye, ambient and
// diffuse, position and direction) are unrelated, however similar their letters are; words of the same role are equal
// (position and point, eye and camera, normal and N).
double name_similarity(const char *a, const char *b);

// Returns the candidate most similar to `name`; of equal ones the first. Returns NULL if none is similar enough to be
// suggested. NULL candidates are skipped.
const char *name_nearest(const char *name, const char *const *candidates, int count);

#endif
