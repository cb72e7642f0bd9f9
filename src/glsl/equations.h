// equations.h: the equations of src/lighting as plain GLSL, as far as a shader calls them.
#ifndef EQUATIONS_H
#define EQUATIONS_H

#include "specialize.h"

// Appends the definitions that the GLSL text `calls` needs, directly or indirectly, in their order, with their comments.
// Words of the dialect become GLSL: num float, mask bool, STRUCT struct; FN disappears. Branches with a known condition
// are resolved. Members that are then never read are removed, and the lines that set them, in `calls` too.
void equations_add(struct text *text, char *calls, const struct known_condition *known);

#endif
