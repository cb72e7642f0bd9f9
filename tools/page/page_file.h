// page_file.h: where the page in one file lies that `make web` makes (docs/web.md).
#ifndef PAGE_FILE_H
#define PAGE_FILE_H

#include <lambent/base.h>

// Returns whether an output is a page by its ending: ".html".
bool page_is_named(const char *output);

// Returns the path of the page, from malloc: LAMBENT_PAGE; or else the installed one, share/lambent/lambent.html beside
// the program's folder; or else the build's, build-web/lambent.html beside the build folder. Fails with LAM_UNSUPPORTED
// (there is none), LAM_LIMIT.
char *page_file_find(lam_error *error);

// Returns a whole file, its `*size` bytes and a zero after them, from malloc. Fails with LAM_CANNOT_READ; LAM_LIMIT if
// it has more than `most` bytes (*size is then the file's size, otherwise 0) or memory has run out.
char *page_file_read(const char *path, size_t most, size_t *size, lam_error *error);

#endif
