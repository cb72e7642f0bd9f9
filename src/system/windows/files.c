// files.c: POSIX functions for files and folders, implemented with the Windows API.
#include "names.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <limits.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <windows.h>

// --- opening

int windows_open(const char *path, int flags, ...)
{
    wchar_t *wide = wide_path(path);
    if (!wide)
        return -1;
    int access = flags & (O_WRONLY | O_RDWR), make = flags & (O_CREAT | O_EXCL | O_TRUNC);
    DWORD rights = access == O_RDONLY   ? GENERIC_READ
                   : access == O_WRONLY ? GENERIC_WRITE
                                        : GENERIC_READ | GENERIC_WRITE;
    DWORD how = (make & (O_CREAT | O_EXCL)) == (O_CREAT | O_EXCL)     ? CREATE_NEW
                : (make & (O_CREAT | O_TRUNC)) == (O_CREAT | O_TRUNC) ? CREATE_ALWAYS
                : make & O_CREAT                                      ? OPEN_ALWAYS
                : make & O_TRUNC                                      ? TRUNCATE_EXISTING
                                                                      : OPEN_EXISTING;
    // As in POSIX, an open file may be renamed and removed.
    HANDLE handle = CreateFileW(wide, rights, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL, how,
                                FILE_ATTRIBUTE_NORMAL, NULL);
    free(wide);
    if (handle == INVALID_HANDLE_VALUE)
        return fail_with_errno();
    int file = _open_osfhandle((intptr_t)handle, (flags & (O_APPEND | _O_NOINHERIT)) | O_BINARY);
    if (file < 0)
        CloseHandle(handle);
    return file;
}

FILE *windows_fopen(const char *path, const char *mode)
{
    int plus = strchr(mode, '+') != NULL;
    int flags = (plus           ? O_RDWR
                 : *mode == 'r' ? O_RDONLY
                                : O_WRONLY) |
                (*mode == 'w'   ? O_CREAT | O_TRUNC
                 : *mode == 'a' ? O_CREAT | O_APPEND
                                : 0) |
                (strchr(mode, 'x') ? O_EXCL : 0);
    char plain[4] = {*mode, 'b', plus ? '+' : 0, 0};
    int file = windows_open(path, flags | O_CLOEXEC);
    FILE *stream = file >= 0 ? _fdopen(file, plain) : NULL;
    if (file >= 0 && !stream)
        close(file);
    return stream;
}

// --- file information

static struct timespec time_of(uint64_t ticks)
{
    // Windows counts time in units of 100 ns from 1601; Unix time starts in 1970.
    const int64_t since_1601 = 11644473600;
    return (struct timespec){(time_t)((int64_t)(ticks / 10000000) - since_1601), (long)(ticks % 10000000 * 100)};
}

static int stat_handle(HANDLE handle, struct windows_stat *about)
{
    BY_HANDLE_FILE_INFORMATION info;
    FILE_BASIC_INFO times;
    DWORD kind = GetFileType(handle);
    *about = (struct windows_stat){.st_mode = kind == FILE_TYPE_PIPE ? S_IFIFO | 0666 : S_IFCHR | 0666, .st_nlink = 1};
    if (kind != FILE_TYPE_DISK)
        return 0;
    if (!GetFileInformationByHandle(handle, &info) ||
        !GetFileInformationByHandleEx(handle, FileBasicInfo, &times, sizeof times))
        return fail_with_errno();
    unsigned rights = info.dwFileAttributes & FILE_ATTRIBUTE_READONLY ? 0444 : 0666;
    about->st_mode =
        (unsigned short)(info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY ? S_IFDIR | 0111 | rights : S_IFREG | rights);
    about->st_nlink = info.nNumberOfLinks;
    about->st_dev = info.dwVolumeSerialNumber;
    about->st_ino = (uint64_t)info.nFileIndexHigh << 32 | info.nFileIndexLow;
    about->st_size = (int64_t)((uint64_t)info.nFileSizeHigh << 32 | info.nFileSizeLow);
    about->st_mtim = time_of((uint64_t)times.LastWriteTime.QuadPart);
    about->st_ctim = time_of((uint64_t)times.ChangeTime.QuadPart);
    return 0;
}

// Opens a handle that can only query a file's attributes. Returns INVALID_HANDLE_VALUE and sets errno on failure.
static HANDLE open_name(const char *path)
{
    wchar_t *wide = wide_path(path);
    HANDLE handle =
        wide ? CreateFileW(wide, FILE_READ_ATTRIBUTES, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                           OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL)
             : INVALID_HANDLE_VALUE;
    if (wide && handle == INVALID_HANDLE_VALUE)
        fail_with_errno();
    free(wide);
    return handle;
}

int windows_stat(const char *path, struct windows_stat *about)
{
    HANDLE handle = open_name(path);
    int found = handle == INVALID_HANDLE_VALUE ? -1 : stat_handle(handle, about);
    if (handle != INVALID_HANDLE_VALUE)
        CloseHandle(handle);
    return found;
}

int windows_fstat(int file, struct windows_stat *about)
{
    intptr_t handle = _get_osfhandle(file);
    return handle == -1 ? -1 : stat_handle((HANDLE)handle, about);
}

int windows_access(const char *path, int mode)
{
    struct windows_stat about;
    if (windows_stat(path, &about) != 0)
        return -1;
    if (!(mode & W_OK) || about.st_mode & 0200)
        return 0;
    errno = EACCES;
    return -1;
}

char *realpath(const char *path, char *buffer)
{
    enum { SIZE = 32768 }; // the length of the longest path in Windows
    HANDLE handle = open_name(path);
    wchar_t *wide = handle != INVALID_HANDLE_VALUE ? malloc(SIZE * sizeof *wide) : NULL;
    DWORD length = wide ? GetFinalPathNameByHandleW(handle, wide, SIZE, FILE_NAME_NORMALIZED) : 0;
    if (handle != INVALID_HANDLE_VALUE && !length)
        fail_with_errno();
    if (handle != INVALID_HANDLE_VALUE)
        CloseHandle(handle);
    char *real = NULL;
    if (length && length < SIZE && wcsncmp(wide, L"\\\\?\\UNC\\", 8) == 0) {
        wide[6] = '\\';
        real = narrow_text(wide + 6, 1);
    } else if (length && length < SIZE) {
        real = narrow_text(wide + (wcsncmp(wide, L"\\\\?\\", 4) == 0 ? 4 : 0), 1);
    }
    free(wide);
    if (real && buffer) {
        size_t size = strlen(real) + 1;
        char *copy = size <= PATH_MAX ? memcpy(buffer, real, size) : NULL;
        errno = copy ? errno : ENAMETOOLONG;
        free(real);
        return copy;
    }
    return real;
}

// --- names

int windows_unlink(const char *path)
{
    wchar_t *wide = wide_path(path);
    int removed = !wide ? -1 : DeleteFileW(wide) ? 0 : fail_with_errno();
    free(wide);
    return removed;
}

int windows_rmdir(const char *path)
{
    wchar_t *wide = wide_path(path);
    int removed = !wide ? -1 : RemoveDirectoryW(wide) ? 0 : fail_with_errno();
    free(wide);
    return removed;
}

int windows_mkdir(const char *path)
{
    wchar_t *wide = wide_path(path);
    int made = !wide ? -1 : CreateDirectoryW(wide, NULL) ? 0 : fail_with_errno();
    free(wide);
    return made;
}

int windows_rename(const char *from, const char *to)
{
    wchar_t *wide_from = wide_path(from), *wide_to = wide_path(to);
    int renamed = !wide_from || !wide_to                                       ? -1
                  : MoveFileExW(wide_from, wide_to, MOVEFILE_REPLACE_EXISTING) ? 0
                                                                               : fail_with_errno();
    free(wide_from);
    free(wide_to);
    return renamed;
}

// --- contents

int fsync(int file) { return FlushFileBuffers((HANDLE)_get_osfhandle(file)) ? 0 : fail_with_errno(); }

static OVERLAPPED position(off_t at)
{
    return (OVERLAPPED){.Offset = (DWORD)at, .OffsetHigh = (DWORD)((uint64_t)at >> 32)};
}

ssize_t pread(int file, void *data, size_t size, off_t at)
{
    OVERLAPPED from = position(at);
    DWORD got = 0;
    if (ReadFile((HANDLE)_get_osfhandle(file), data, size < INT_MAX ? (DWORD)size : INT_MAX, &got, &from) ||
        GetLastError() == ERROR_HANDLE_EOF)
        return (ssize_t)got;
    return fail_with_errno();
}

ssize_t pwrite(int file, const void *data, size_t size, off_t at)
{
    OVERLAPPED to = position(at);
    DWORD put = 0;
    if (WriteFile((HANDLE)_get_osfhandle(file), data, size < INT_MAX ? (DWORD)size : INT_MAX, &put, &to))
        return (ssize_t)put;
    return fail_with_errno();
}

int flock(int file, int operation)
{
    (void)operation;
    OVERLAPPED end = {.Offset = 0, .OffsetHigh = 0x40000000}; // locks a byte past the end of any file, so that reads
                                                              // still work
    return LockFileEx((HANDLE)_get_osfhandle(file), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &end)
               ? 0
               : fail_with_errno();
}

// --- folders

struct windows_folder {
    HANDLE search;
    WIN32_FIND_DATAW found;
    bool is_read; // whether `found` has been returned
    char *path;
    struct dirent entry;
};

DIR *opendir(const char *path)
{
    size_t length = strlen(path);
    char *pattern = malloc(length + 3);
    struct windows_folder *folder = calloc(1, sizeof *folder);
    wchar_t *wide = NULL;
    if (pattern && folder) {
        memcpy(pattern, path, length);
        memcpy(pattern + length, "/*", 3);
        wide = wide_path(pattern);
    }
    if (wide)
        folder->search = FindFirstFileW(wide, &folder->found);
    if (wide && folder->search == INVALID_HANDLE_VALUE)
        fail_with_errno();
    bool ok = wide && folder->search != INVALID_HANDLE_VALUE;
    free(wide);
    if (!ok) {
        free(pattern);
        free(folder);
        return NULL;
    }
    pattern[length] = 0;
    folder->path = pattern;
    return folder;
}

struct dirent *readdir(DIR *folder)
{
    do {
        if (folder->is_read && !FindNextFileW(folder->search, &folder->found))
            return NULL;
        folder->is_read = true;
    } while (!WideCharToMultiByte(CP_UTF8, 0, folder->found.cFileName, -1, folder->entry.d_name,
                                  sizeof folder->entry.d_name, NULL, NULL));
    return &folder->entry;
}

int closedir(DIR *folder)
{
    FindClose(folder->search);
    free(folder->path);
    free(folder);
    return 0;
}

int windows_remove_in(DIR *folder, const char *name)
{
    char path[2 * PATH_MAX + sizeof folder->entry.d_name];
    snprintf(path, sizeof path, "%s/%s", folder->path, name);
    return windows_unlink(path);
}

int alphasort(const struct dirent **a, const struct dirent **b) { return strcmp((*a)->d_name, (*b)->d_name); }

int scandir(const char *path, struct dirent ***list, int filter(const struct dirent *),
            int compare(const struct dirent **, const struct dirent **))
{
    DIR *folder = opendir(path);
    struct dirent **names = NULL, *entry;
    size_t count = 0;
    bool failed = !folder;
    while (!failed && (entry = readdir(folder))) {
        if (filter && !filter(entry))
            continue;
        struct dirent **grown = realloc(names, (count + 1) * sizeof *names);
        names = grown ? grown : names;
        failed = !grown || !(names[count] = malloc(sizeof *entry));
        if (!failed)
            *names[count++] = *entry;
    }
    if (folder)
        closedir(folder);
    if (failed) {
        for (size_t i = 0; i < count; i++)
            free(names[i]);
        free(names);
        return -1;
    }
    if (count)
        qsort(names, count, sizeof *names, (int (*)(const void *, const void *))compare);
    *list = names;
    return (int)count;
}
