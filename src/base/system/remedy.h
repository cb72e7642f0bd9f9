// remedy.h: advice in messages about a missing library: on a machine, how to install it; in a page, where nothing can
// be installed, which program reads the file.
#ifndef REMEDY_H
#define REMEDY_H

#if defined(__wasm__)
#define REMEDY(machine, page) page
#else
#define REMEDY(machine, page) machine
#endif

#endif
