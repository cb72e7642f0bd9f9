// remedy.h: advice in messages about a missing library. In a program, the advice says how to install the library. In a
// web page, nothing can be installed, so the advice names a program that reads the file.
#ifndef REMEDY_H
#define REMEDY_H

#if defined(__wasm__)
#define REMEDY(machine, page) page
#else
#define REMEDY(machine, page) machine
#endif

#endif
