// unistd.h: mingw-w64's, with names of files in UTF-8, and POSIX functions that it lacks.
#ifndef WINDOWS_UNISTD_H
#define WINDOWS_UNISTD_H

#include_next <unistd.h>

#include <stddef.h>
#include <string.h>

int windows_access(const char *path, int mode);
int windows_unlink(const char *path);
int windows_rmdir(const char *path);
#define access(path, mode) windows_access(path, mode)
#define unlink(path)       windows_unlink(path)
#define rmdir(path)        windows_rmdir(path)

int fsync(int file);
// Reads or writes at a position, and leaves the file's own where it was for other calls of these two. Any thread.
ssize_t pread(int file, void *data, size_t size, off_t at);
ssize_t pwrite(int file, const void *data, size_t size, off_t at);
// The name of this machine.
int windows_hostname(char *name, size_t size);
#define gethostname(name, size) windows_hostname(name, size)

#define _SC_NPROCESSORS_ONLN 84
// Knows the number of processors alone; −1 for any other name.
long sysconf(int name);

// Fails: no link is read, and no user has a number.
static inline ssize_t readlink(const char *path, char *out, size_t size)
{
    (void)path, (void)out, (void)size;
    return -1;
}

#endif
