// dynamic_library.h: libraries that are opened on first use, so that a program starts without them.
#ifndef DYNAMIC_LIBRARY_H
#define DYNAMIC_LIBRARY_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>

// Opens a library by its file name ("libfreetype.so.6"). Returns NULL if the library is not installed, and stores the
// loader's error message in *reason (`reason` may be NULL). With `resident`, the library stays loaded until the process
// ends; drivers that start threads need this.
void *library_open(const char *name, bool resident, const char **reason);
// Opens a shared object that is installed with this library or program, for example "lambent-draco.so". The shared
// object is in the subfolder lambent of the library folder, or in the build folder. The shared object stays loaded
// until the process ends. Returns NULL if the shared object or a library that it needs is missing.
void *library_open_own(const char *name);
// Finds a file that is installed with this library or program, in the folders of library_open_own. Returns false if the
// file is missing. Not available in static programs and WebAssembly.
enum { LIBRARY_PATH_SIZE = PATH_MAX + 100 };
bool library_own_path(const char *name, char path[LIBRARY_PATH_SIZE]);
void library_close(void *library); // NULL is allowed

// Stores the address of a function at `function`, a pointer to a function pointer. Returns false if the library does
// not contain the function.
bool library_find(void *library, const char *name, void *function);

// In a macro, FUNCTIONS(each), a module lists the library functions that the module calls. The module also declares a
// struct with a handle and pointers to these functions:
//  struct zip {
//      void *handle;
//      FUNCTIONS(LIBRARY_MEMBER)
//  };
#define LIBRARY_MEMBER(name)     __typeof__(&name) name;
#define LIBRARY_NAME(name)       #name,
#define LIBRARY_NAMES(functions) ((const char *const[]){functions(LIBRARY_NAME) NULL})

// Opens a library and looks up LIBRARY_NAMES(FUNCTIONS), in the order of the struct. `handle` points to the struct's
// handle. Returns NULL on success. Otherwise sets the handle to NULL and returns "is not installed" or `lacking`.
const char *library_open_functions(void **handle, const char *name, bool resident, const char *const *functions,
                                   const char *lacking);

#endif
