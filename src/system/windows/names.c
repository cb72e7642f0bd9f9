// names.c: converts file names between UTF-8 and UTF-16, and Windows errors to POSIX error numbers.
#include "names.h"

#include <errno.h>
#include <stdlib.h>
#include <windows.h>

// Longer paths must be absolute and begin with "\\?\". The value is the limit for folders: MAX_PATH minus the length of
// an 8.3 name.
enum { LONG_PATH = 248 };

static wchar_t *full_path(wchar_t *path)
{
    DWORD size = GetFullPathNameW(path, 0, NULL, NULL);
    wchar_t *full = size ? malloc((size + 8) * sizeof *full) : NULL;
    if (!full || !GetFullPathNameW(path, size, full + 8, NULL)) {
        free(full);
        return path;
    }
    free(path);
    int share = full[8] == '\\' && full[9] == '\\';
    const wchar_t *prefix = share ? L"\\\\?\\UNC" : L"\\\\?\\";
    size_t length = wcslen(prefix);
    wmemmove(full + length, full + 8 + share, wcslen(full + 8 + share) + 1);
    wmemcpy(full, prefix, length);
    return full;
}

wchar_t *wide_path(const char *path)
{
    int size = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, NULL, 0);
    wchar_t *wide = size ? malloc((size_t)size * sizeof *wide) : NULL;
    if (!wide) {
        errno = size ? ENOMEM : EILSEQ;
        return NULL;
    }
    MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide, size);
    for (wchar_t *c = wide; *c; c++)
        *c = *c == '/' ? '\\' : *c;
    return size > LONG_PATH && wcsncmp(wide, L"\\\\?\\", 4) != 0 ? full_path(wide) : wide;
}

char *narrow_text(const wchar_t *text, int is_path)
{
    int size = WideCharToMultiByte(CP_UTF8, 0, text, -1, NULL, 0, NULL, NULL);
    char *narrow = size ? malloc((size_t)size) : NULL;
    if (!narrow)
        return NULL;
    WideCharToMultiByte(CP_UTF8, 0, text, -1, narrow, size, NULL, NULL);
    for (char *c = narrow; is_path && *c; c++)
        *c = *c == '\\' ? '/' : *c;
    return narrow;
}

int fail_with_errno(void)
{
    static const struct {
        DWORD windows;
        int posix;
    } numbers[] = {
        {ERROR_FILE_NOT_FOUND, ENOENT},
        {ERROR_PATH_NOT_FOUND, ENOENT},
        {ERROR_INVALID_NAME, ENOENT},
        {ERROR_BAD_PATHNAME, ENOENT},
        {ERROR_BAD_NETPATH, ENOENT},
        {ERROR_BAD_NET_NAME, ENOENT},
        {ERROR_INVALID_DRIVE, ENOENT},
        {ERROR_ACCESS_DENIED, EACCES},
        {ERROR_SHARING_VIOLATION, EACCES},
        {ERROR_WRITE_PROTECT, EROFS},
        {ERROR_FILE_EXISTS, EEXIST},
        {ERROR_ALREADY_EXISTS, EEXIST},
        {ERROR_DIR_NOT_EMPTY, ENOTEMPTY},
        {ERROR_DIRECTORY, ENOTDIR},
        {ERROR_DISK_FULL, ENOSPC},
        {ERROR_HANDLE_DISK_FULL, ENOSPC},
        {ERROR_NOT_ENOUGH_MEMORY, ENOMEM},
        {ERROR_OUTOFMEMORY, ENOMEM},
        {ERROR_TOO_MANY_OPEN_FILES, EMFILE},
        {ERROR_LOCK_VIOLATION, EWOULDBLOCK},
        {ERROR_BROKEN_PIPE, EPIPE},
        {ERROR_NO_DATA, EPIPE},
        {ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG},
    };
    DWORD reason = GetLastError();
    errno = EIO;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (numbers[i].windows == reason)
            errno = numbers[i].posix;
    return -1;
}
