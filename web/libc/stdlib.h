// stdlib.h: wasi-libc's, and realpath.
#ifndef WEB_STDLIB_H
#define WEB_STDLIB_H

#include_next <stdlib.h>

// POSIX's, for a file system without links: the absolute path without "." and "..", from malloc, or in a buffer of
// PATH_MAX bytes.
char *realpath(const char *path, char *buffer);

#endif
