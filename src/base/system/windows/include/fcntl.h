// fcntl.h: mingw-w64's, with files named in UTF-8 and read and written byte by byte.
#ifndef WINDOWS_FCNTL_H
#define WINDOWS_FCNTL_H

#include_next <fcntl.h>

#define O_CLOEXEC _O_NOINHERIT
// Windows has no such files, or nothing to ask for.
#define O_NONBLOCK  0
#define O_NOCTTY    0
#define O_NOFOLLOW  0
#define O_DIRECTORY 0

#define POSIX_FADV_WILLNEED 3

// Advice that is not passed on: returns an error number.
static inline int posix_fadvise(int file, long long at, long long size, int advice)
{
    (void)file, (void)at, (void)size, (void)advice;
    return 38; // ENOSYS
}

int windows_open(const char *path, int flags, ...);
#define open windows_open

#endif
