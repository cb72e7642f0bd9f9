// remedy.h: advice in messages about a missing library: how to install it, or, on a web page, which program reads the
// file.
#ifndef REMEDY_H
#define REMEDY_H

#if defined(__wasm__)
#define REMEDY(machine, page) page
#else
#define REMEDY(machine, page) machine
#endif

#endif
