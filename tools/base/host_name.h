// host_name.h: the name of this machine, as used in the names of unfinished files.
#ifndef HOST_NAME_H
#define HOST_NAME_H

#include <string.h>
#include <unistd.h>

enum { HOST_SIZE = 65 }; // Linux's HOST_NAME_MAX plus the closing zero

// Returns the host name, or "" if the name is unknown.
static inline const char *host_name(char name[HOST_SIZE])
{
    memset(name, 0, HOST_SIZE);
    if (gethostname(name, HOST_SIZE - 1) != 0 || strchr(name, '/'))
        name[0] = 0;
    return name;
}

#endif
