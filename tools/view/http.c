// http.c: loads libmicrohttpd.
#include "http.h"

#include <dlfcn.h>
#include <string.h>

#include "console.h"

// Finds the address of a function. Copies the address, because ISO C does not allow the conversion of a void * to a
// function pointer.
static bool find(void *library, const char *name, void *function)
{
    void *address = dlsym(library, name);
    memcpy(function, &address, sizeof address);
    return address != NULL;
}

bool http_open(struct http *http, lam_error *error)
{
    void *library = dlopen(HTTP_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return complain(error, LAM_UNSUPPORTED,
                        "view needs " HTTP_LIBRARY
                        ", which is not installed; install the Debian package libmicrohttpd12 or libmicrohttpd12t64");
    bool all = true;
#define LOOK_UP(name) all = find(library, #name, &http->name) && all;
    HTTP_FUNCTIONS(LOOK_UP)
    return all || complain(error, LAM_UNSUPPORTED,
                           HTTP_LIBRARY " lacks functions of libmicrohttpd 0.9.71; install a newer version");
}
