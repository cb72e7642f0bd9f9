// libraries.c: dynamic_library.h for Windows: no library is opened, so that none lies in wait beside a model.
#include "dynamic_library.h"

#include <stddef.h>

void *library_open(const char *name, bool resident, const char **reason)
{
    (void)name, (void)resident;
    if (reason)
        *reason = "lambent for Windows opens no libraries";
    return NULL;
}

void *library_open_own(const char *name)
{
    (void)name;
    return NULL;
}

void library_close(void *library) { (void)library; }

bool library_find(void *library, const char *name, void *function)
{
    (void)library, (void)name, (void)function;
    return false;
}
