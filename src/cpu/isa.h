// isa.h: the kernels for an instruction set.
#ifndef ISA_H
#define ISA_H

#include <lambent/device.h>

// Returns NULL if the instruction set is missing in this build or on this processor.
const struct kernels *kernels_of(lam_isa isa);
lam_isa widest_isa(void);

#endif
