// dynamic_library.c: opens libraries with dlopen and dlsym.
#include "dynamic_library.h"

#include <stdint.h>
#include <string.h>

#if defined(__wasm__)

// WebAssembly cannot open libraries; the web page's module contains replacements for some libraries
// (src/formats/import/gltf/draco/page_decoders.c).
__attribute__((weak)) void *page_library(const char *name);
__attribute__((weak)) bool page_library_find(void *library, const char *name, void *function);

void *library_open(const char *name, bool resident, const char **reason)
{
    (void)resident;
    if (reason)
        *reason = "WebAssembly opens no libraries";
    return library_open_own(name);
}

void *library_open_own(const char *name) { return page_library ? page_library(name) : NULL; }

void library_close(void *library) { (void)library; }

bool library_find(void *library, const char *name, void *function)
{
    return page_library_find && page_library_find(library, name, function);
}

#elif defined(LAMBENT_STATIC)

#include "static_libraries.h"

// A static program contains its libraries and cannot load others.
void *library_open(const char *name, bool resident, const char **reason)
{
    (void)resident;
    const void *library = static_library(name);
    if (!library && reason)
        *reason = "a static program opens no libraries";
    return (void *)(uintptr_t)library;
}

void *library_open_own(const char *name)
{
    (void)name;
    return NULL;
}

void library_close(void *library) { (void)library; }

bool library_find(void *library, const char *name, void *function)
{
    void *found = static_function(library, name);
    memcpy(function, &found, sizeof found);
    return found != NULL;
}

#else

#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

void *library_open(const char *name, bool resident, const char **reason)
{
    const int how = RTLD_NOW | RTLD_LOCAL | (resident ? RTLD_NODELETE : 0);
    errno = 0;
    void *library = dlopen(name, how);
    if (!library && errno == ENOMEM) // a library must not seem to be missing because one allocation failed
        library = dlopen(name, how);
    if (!library && reason) {
        const char *sentence = dlerror();
        *reason = sentence ? sentence : "the loader gives no reason";
    }
    return library;
}

// The folders to search, relative to the folder of this library or program. This library or program may be in the build
// folder, in its subfolder for tests, in the system's library folder, or in the program folder beside the library
// folder.
static const char *const own_folders[] = {"", "../", "lambent/", "../" LAMBENT_LIBDIR "/lambent/"};

// Finds a file in one of these folders. Returns false if no folder contains the file.
static bool find_beside(const char *file, const char *name, char path[LIBRARY_PATH_SIZE])
{
    char folder[PATH_MAX];
    if (!realpath(file, folder))
        return false;
    char *end = strrchr(folder, '/');
    end[1] = 0;
    for (size_t i = 0; i < sizeof own_folders / sizeof *own_folders; i++) {
        int length = snprintf(path, LIBRARY_PATH_SIZE, "%s%s%s", folder, own_folders[i], name);
        if (length < LIBRARY_PATH_SIZE && access(path, R_OK) == 0)
            return true;
    }
    return false;
}

bool library_own_path(const char *name, char path[LIBRARY_PATH_SIZE])
{
    Dl_info here;
    // For the program itself, dladdr returns the name with which the program was started. This name may lack a folder.
    return (dladdr((const void *)own_folders, &here) && here.dli_fname && strchr(here.dli_fname, '/') &&
            find_beside(here.dli_fname, name, path)) ||
           find_beside("/proc/self/exe", name, path);
}

void *library_open_own(const char *name)
{
    char path[LIBRARY_PATH_SIZE];
    return library_own_path(name, path) ? library_open(path, true, NULL) : NULL;
}

void library_close(void *library)
{
    if (library)
        dlclose(library);
}

bool library_find(void *library, const char *name, void *function)
{
    void *found = dlsym(library, name);
    memcpy(function, &found, sizeof found); // POSIX allows storing a function pointer in a data pointer
    return found != NULL;
}

#endif

const char *library_open_functions(void **handle, const char *name, bool resident, const char *const *functions,
                                   const char *lacking)
{
    *handle = library_open(name, resident, NULL);
    if (!*handle)
        return "is not installed";
    for (int i = 0; functions[i]; i++)
        if (!library_find(*handle, functions[i], (char *)handle + (size_t)(i + 1) * sizeof *handle)) {
            library_close(*handle);
            *handle = NULL;
            return lacking;
        }
    return NULL;
}
