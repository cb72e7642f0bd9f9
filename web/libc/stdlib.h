// stdlib.h: wasi-libc's header, and realpath.
#ifndef WEB_STDLIB_H
#define WEB_STDLIB_H

#include_next <stdlib.h>

// Returns the absolute path without "." and "..", as in POSIX, for a file system without links. The path is in `buffer`
// (PATH_MAX bytes), or allocated with malloc if `buffer` is NULL.
char *realpath(const char *path, char *buffer);

#endif
