// unistd.h: adds file names in UTF-8 and missing POSIX functions to mingw-w64's header.
#ifndef WINDOWS_UNISTD_H
#define WINDOWS_UNISTD_H

#include_next <unistd.h>

#include <stddef.h>
#include <stdint.h>
#include <string.h>

int windows_access(const char *path, int mode);
int windows_unlink(const char *path);
int windows_rmdir(const char *path);
#define access(path, mode) windows_access(path, mode)
#define unlink(path)       windows_unlink(path)
#define rmdir(path)        windows_rmdir(path)

// Folders are not held open on Windows (src/system/files/path_plain.c): a name relative to a folder is the whole path.
#define AT_FDCWD                             (-100)
#define AT_SYMLINK_NOFOLLOW                  0
#define faccessat(folder, path, mode, flags) windows_access(path, mode)
#define fchmod(file, mode)                   0
// Removes the file `name`, which is in the open folder `folder`.
typedef struct windows_folder DIR;
int windows_remove_in(DIR *folder, const char *name);
#define unlinkat(folder, name, flags)                                                                                  \
    _Generic((folder), DIR *: windows_remove_in((DIR *)(intptr_t)(folder), name), int: windows_unlink(name))

int fsync(int file);
// These functions read or write at the offset `at`, independently of the file's own position. Any thread may call these
// two functions.
ssize_t pread(int file, void *data, size_t size, off_t at);
ssize_t pwrite(int file, const void *data, size_t size, off_t at);
// Gets the name of this machine.
int windows_hostname(char *name, size_t size);
#define gethostname(name, size) windows_hostname(name, size)

// Always fails, because Lambent does not read links on Windows.
static inline ssize_t readlink(const char *path, char *out, size_t size)
{
    (void)path, (void)out, (void)size;
    return -1;
}

#endif
