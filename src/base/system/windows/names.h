// names.h: converts file names between UTF-8 and UTF-16.
#ifndef WINDOWS_NAMES_H
#define WINDOWS_NAMES_H

#include <stddef.h>
#include <wchar.h>

// Returns a path for the Windows API, from malloc: with backslashes, and absolute if it is long. Returns NULL and sets
// errno on failure.
wchar_t *wide_path(const char *path);
// Returns UTF-8 text from malloc; with `is_path`, replaces backslashes with slashes. Returns NULL if memory runs out.
char *narrow_text(const wchar_t *text, int is_path);
// Sets errno from GetLastError(), and returns −1.
int fail_with_errno(void);

#endif
