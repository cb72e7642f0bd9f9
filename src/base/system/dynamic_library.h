// dynamic_library.h: libraries that are opened when they are first used, so that a program starts without them.
#ifndef DYNAMIC_LIBRARY_H
#define DYNAMIC_LIBRARY_H

#include <stdbool.h>

// Returns a library by its file name ("libfreetype.so.6"); NULL: not installed, and *reason (may be NULL) is the
// loader's sentence. `resident`: it stays loaded until the process ends, as drivers that start threads need.
void *library_open(const char *name, bool resident, const char **reason);
// Returns a shared object installed with this library or program, "lambent-draco.so", from beside them: in a folder
// lambent of the folder of libraries, or in their build folder. It stays loaded until the process ends. Returns NULL if
// it is missing, or a library that it needs.
void *library_open_own(const char *name);
void library_close(void *library); // NULL is fine

// Stores the address of a function at `function`, a pointer to a function pointer. Returns false if the library has
// none.
bool library_find(void *library, const char *name, void *function);

#endif
