// names.h: converts file names between UTF-8 and UTF-16.
#ifndef WINDOWS_NAMES_H
#define WINDOWS_NAMES_H

#include <stddef.h>
#include <wchar.h>

// Converts a path for the Windows API: with backslashes, and absolute if it is long. The result is allocated with
// malloc. Returns NULL and sets errno on failure.
wchar_t *wide_path(const char *path);
// Converts text to UTF-8, allocated with malloc. Replaces backslashes with slashes if `is_path` is set. Returns NULL if
// memory runs out.
char *narrow_text(const wchar_t *text, int is_path);
// Sets errno from GetLastError(), and returns −1.
int fail_with_errno(void);

#endif
