// recognise.h: finds the contract whose names a program uses, and describes names that do not match the contract.
#ifndef RECOGNISE_H
#define RECOGNISE_H

#include "contract.h"
#include "prefix.h"

// Finds the contract that matches the names in the shaders best. *out is NULL if no contract contains any of them.
// Returns false on failure (LAM_LIMIT).
bool contract_recognise(lam_check_contract *const *contracts, int count, struct program_texts *texts,
                        const struct contract **out, lam_error *error);

// If no contract fits a program, lists the program's names that are missing in `contract`, the nearest contract.
// `unknown` contains the names that the driver reports.
void contract_describe_unknown(const struct contract *contract, const struct declarations *vertex,
                               const struct declarations *fragment, const char *const *unknown, int count, char *out,
                               size_t capacity);

// Returns whether an unknown name is probably misspelt, that is, whether the contract contains a similar name of the
// same type that no shader declares.
bool contract_is_misspelt(const struct contract *contract, const struct declarations *vertex,
                          const struct declarations *fragment, const char *name);

// --- makes a contract from a pair of shaders: the role of each input is inferred from the input's use, its type,
// and the words in its name.
//
// The result is a guess. The contract allows any strengths, and a verdict is reported only if the pictures confirm the
// contract (check_fit.c).

// Returns the text of contract number `guess` (0, 1, …) for the shaders, allocated with malloc. The guesses differ in
// the spaces that the source does not determine. Returns NULL if there is no such guess; for the first guess, `reason`
// then names the input for which no value is known. Otherwise `reason` is "". `engine` is the contract whose prefix the
// sources lack, or NULL. With `all`, inputs with unknown roles have the role `zero`, and `reason` names the first of
// them.
char *contract_infer(const struct declarations *vertex, const struct declarations *fragment,
                     const struct contract *engine, int guess, bool all, char *reason, size_t capacity);

#endif
