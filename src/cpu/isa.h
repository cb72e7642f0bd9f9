// isa.h: the kernels of an instruction set.
#ifndef ISA_H
#define ISA_H

#include <lambent/device.h>

// NULL: not in this build, or not on this processor.
const struct kernels *kernels_of(lam_isa isa);
lam_isa widest_isa(void);

#endif
