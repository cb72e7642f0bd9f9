// isa.h: the kernels for an instruction set.
#ifndef ISA_H
#define ISA_H

#include <lambent/device.h>

// Returns the kernels for an instruction set, or NULL if this build or this processor does not support it.
const struct kernels *kernels_of(lam_isa isa);
lam_isa widest_isa(void);

#endif
