// remedy.h: advice in messages about a missing library. In a program it says how to install the library; in a web page,
// where nothing can be installed, it names a program that reads the file.
#ifndef REMEDY_H
#define REMEDY_H

#if defined(__wasm__)
#define REMEDY(machine, page) page
#else
#define REMEDY(machine, page) machine
#endif

#endif
