// page_file.h: finds the one-file page made by `make web` (docs/web.md).
#ifndef PAGE_FILE_H
#define PAGE_FILE_H

#include <lambent/base.h>

// Returns whether the extension of an output is ".html".
bool page_is_named(const char *output);

// Returns the path of the page, allocated with malloc. Tries, in this order: the file that LAMBENT_PAGE names, the
// installed file ../share/lambent/lambent.html relative to the program's folder, and ../build-web/lambent.html relative
// to a build folder. Fails with LAM_UNSUPPORTED if there is no page, or with LAM_LIMIT if memory runs out.
char *page_file_find(lam_error *error);

// Reads `*size` bytes, the whole file, into memory allocated with malloc, and appends a zero. Fails with
// LAM_CANNOT_READ, or with LAM_LIMIT if the file has more than `most` bytes (then *size is the file's size, otherwise
// 0) or if memory runs out.
char *page_file_read(const char *path, size_t most, size_t *size, lam_error *error);

#endif
