// static_libraries.h: the libraries that a static program contains.
#ifndef STATIC_LIBRARIES_H
#define STATIC_LIBRARIES_H

// Returns a library by its file name, or NULL if the program does not contain it.
const void *static_library(const char *name);
// Returns the address of a function, or NULL if the library does not contain the function.
void *static_function(const void *library, const char *name);

#endif
