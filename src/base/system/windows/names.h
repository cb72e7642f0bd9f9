// names.h: names of files between UTF-8 and Windows' UTF-16.
#ifndef WINDOWS_NAMES_H
#define WINDOWS_NAMES_H

#include <stddef.h>
#include <wchar.h>

// Returns a path for Windows' functions, from malloc: with backslashes, and absolute if it is long. NULL with errno.
wchar_t *wide_path(const char *path);
// Returns UTF-8 from malloc, with slashes for backslashes if `is_path`. NULL: out of memory.
char *narrow_text(const wchar_t *text, int is_path);
// Sets errno by GetLastError(), and returns −1.
int fail_with_errno(void);

#endif
