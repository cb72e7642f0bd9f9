// static_libraries.h: the libraries inside of a static program.
#ifndef STATIC_LIBRARIES_H
#define STATIC_LIBRARIES_H

// A library by its file name; NULL: the program does not contain it.
const void *static_library(const char *name);
// The address of a function of it; NULL: it has none.
void *static_function(const void *library, const char *name);

#endif
