// stdlib.h: extends mingw-w64's header with realpath and aligned_alloc.
#ifndef WINDOWS_STDLIB_H
#define WINDOWS_STDLIB_H

#include_next <stdlib.h>

// Returns the absolute path after following every link, with slashes and in UTF-8 (C:/models/a.obj,
// //server/share/a.obj). The result is allocated with malloc if `buffer` is NULL; otherwise it is in `buffer`, which
// has PATH_MAX bytes.
char *realpath(const char *path, char *buffer);

// Aligns only as malloc does, to 16 bytes, because free must accept the memory. A larger alignment would affect only
// the speed: the assembler encodes every vector move as an unaligned one (packaging/windows.ini).
static inline void *windows_aligned_alloc(size_t alignment, size_t size)
{
    (void)alignment;
    return malloc(size);
}
#define aligned_alloc windows_aligned_alloc

#endif
