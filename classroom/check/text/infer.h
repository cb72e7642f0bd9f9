// infer.h: makes a contract from a pair of shaders: the role of each input is inferred from the input's use, its type,
// and the words in its name.
//
// The result is a guess. The contract allows any strengths, and a verdict is reported only if the pictures confirm the
// contract (check_fit.c).
#ifndef INFER_H
#define INFER_H

#include "contract.h"

// Returns the text of contract number `guess` (0, 1, …) for the shaders, allocated with malloc. The guesses differ in
// the spaces that the source does not determine. Returns NULL if there is no such guess; for the first guess, `reason`
// then names the input for which no value is known. Otherwise `reason` is "". `engine` is the contract whose prefix the
// sources lack, or NULL. With `all`, inputs with unknown roles have the role `zero`, and `reason` names the first of
// them.
char *contract_infer(const struct declarations *vertex, const struct declarations *fragment,
                     const struct contract *engine, int guess, bool all, char *reason, size_t capacity);

#endif
