// dlfcn.h: opens no libraries, because programs for Windows are linked statically.
#ifndef WINDOWS_DLFCN_H
#define WINDOWS_DLFCN_H

#include <stddef.h>

#define RTLD_NOW   0
#define RTLD_LOCAL 0

static inline void *dlopen(const char *name, int how) { return (void)name, (void)how, NULL; }
static inline const char *dlerror(void) { return "a static program opens no libraries"; }
static inline void *dlsym(void *library, const char *name) { return (void)library, (void)name, NULL; }
static inline int dlclose(void *library) { return (void)library, 0; }

#endif
