// stdlib.h: mingw-w64's, and realpath and aligned_alloc.
#ifndef WINDOWS_STDLIB_H
#define WINDOWS_STDLIB_H

#include_next <stdlib.h>

// The absolute path after every link, with slashes and in UTF-8 (C:/models/a.obj, //server/share/a.obj), from malloc, or in a buffer of
// PATH_MAX bytes.
char *realpath(const char *path, char *buffer);

// Aligned as malloc aligns, to 16 bytes: the memory must be free's. More is a matter of speed; the assembler makes every move of a
// vector an unaligned one (packaging/windows.ini).
static inline void *windows_aligned_alloc(size_t alignment, size_t size)
{
    (void)alignment;
    return malloc(size);
}
#define aligned_alloc windows_aligned_alloc

#endif
