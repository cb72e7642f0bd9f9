// recognise.h: finds the contract whose names a program uses, and describes names that do not match the contract.
#ifndef RECOGNISE_H
#define RECOGNISE_H

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

#endif
