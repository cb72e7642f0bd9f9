// dynamic_library.c: dlopen and dlsym.
#include "dynamic_library.h"

#include <stddef.h>
#include <string.h>

#if defined(__wasm__)

// WebAssembly opens no libraries.
void *library_open(const char *name, bool resident, const char **reason)
{
    (void)name, (void)resident;
    if (reason)
        *reason = "WebAssembly opens no libraries";
    return NULL;
}

void library_close(void *library) { (void)library; }

bool library_find(void *library, const char *name, void *function)
{
    (void)library, (void)name, (void)function;
    return false;
}

#else

#include <dlfcn.h>

void *library_open(const char *name, bool resident, const char **reason)
{
    void *library = dlopen(name, RTLD_NOW | RTLD_LOCAL | (resident ? RTLD_NODELETE : 0));
    if (!library && reason) {
        const char *sentence = dlerror();
        *reason = sentence ? sentence : "the loader gives no reason";
    }
    return library;
}

void library_close(void *library)
{
    if (library)
        dlclose(library);
}

bool library_find(void *library, const char *name, void *function)
{
    void *found = dlsym(library, name);
    memcpy(function, &found, sizeof found); // POSIX lets a data pointer stand for a function pointer here
    return found != NULL;
}

#endif
