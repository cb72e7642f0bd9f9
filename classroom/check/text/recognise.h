// recognise.h: finds the contract whose names a program uses, and describes names that do not fit it.
#ifndef RECOGNISE_H
#define RECOGNISE_H

#include "prefix.h"

// Finds the contract that has most of the shaders' names. *out stays NULL if none has any. `vertex` may be NULL. False:
// out of memory.
bool contract_recognise(lam_check_contract *const *contracts, int count, const char *vertex, const char *fragment,
                        const struct contract **out, lam_error *error);

// A sentence about the names of the shaders that a contract does not have, for a program of an unknown contract. `unknown`:
// as the driver reports them.
void contract_describe_unknown(const struct contract *contract, const struct declarations *vertex,
                               const struct declarations *fragment, const char *const *unknown, int count, char *out,
                               size_t capacity);

// Whether an unknown name is a misspelt one of the contract: the contract has a name like it that no shader declares.
bool contract_is_misspelt(const struct contract *contract, const struct declarations *vertex,
                          const struct declarations *fragment, const char *name);

#endif
