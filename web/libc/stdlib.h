// stdlib.h: wasi-libc's header, and realpath.
#ifndef WEB_STDLIB_H
#define WEB_STDLIB_H

#include_next <stdlib.h>

// POSIX's function for a file system without links: the absolute path without "." and "..", allocated with malloc, or
// in a buffer of PATH_MAX bytes.
char *realpath(const char *path, char *buffer);

#endif
