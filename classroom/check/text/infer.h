// infer.h: a contract made from a pair of shaders: the role of each input by its use, its type, and the words in its name.
//
// Nothing is certain: the contract's strengths are any, and its verdict counts only if the pictures confirm it (check_fit.c).
#ifndef INFER_H
#define INFER_H

#include "contract.h"

// The text of contract number `guess` (0, 1, …) for the shaders, from malloc; they differ in the spaces that the text
// leaves open. NULL: no such guess; if it is the first, `reason` names the input that cannot be set, "" otherwise.
// `engine`: a contract whose prefix the texts lack, or NULL. `all`: an input whose role is not found has the role
// `zero`, and `reason` says which is the first.
char *contract_infer(const struct declarations *vertex, const struct declarations *fragment,
                     const struct contract *engine, int guess, bool all, char *reason, size_t capacity);

#endif
