// remedy.h: what a message says about a part that is missing: on a machine how to install it, in a page, where nothing can be installed, who reads
// the file.
#ifndef REMEDY_H
#define REMEDY_H

#if defined(__wasm__)
#define REMEDY(machine, page) page
#else
#define REMEDY(machine, page) machine
#endif

#endif
