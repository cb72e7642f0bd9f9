// fcntl.h: extends mingw-w64's header with file names in UTF-8 and binary reads and writes.
#ifndef WINDOWS_FCNTL_H
#define WINDOWS_FCNTL_H

#include_next <fcntl.h>

#define O_CLOEXEC _O_NOINHERIT
// On Windows, these flags have no effect or are not needed.
#define O_NONBLOCK  0
#define O_NOCTTY    0
#define O_NOFOLLOW  0
#define O_DIRECTORY 0

#define POSIX_FADV_WILLNEED 3

// Does nothing and returns ENOSYS, because Windows has no such function.
static inline int posix_fadvise(int file, long long at, long long size, int advice)
{
    (void)file, (void)at, (void)size, (void)advice;
    return 38; // ENOSYS
}

int windows_open(const char *path, int flags, ...);
#define open                      windows_open
#define openat(folder, path, ...) windows_open(path, __VA_ARGS__)

#endif
