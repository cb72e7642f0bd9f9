// view_page.h: makes the page of the viewer: the one-file page of `make web` with permission to connect to its server.
#ifndef VIEW_PAGE_H
#define VIEW_PAGE_H

#include "options.h"
#include "view_files.h"

struct view_page {
    char *text; // the page, allocated with malloc
    size_t size;
    char *words; // the options of the command line, each word with a terminating zero
    size_t words_size;
    char *module; // the WebAssembly module with threads, which the page requests; allocated with malloc, or NULL
    size_t module_size;
    char *fragment; // the options as the end of an address, "&--background%3Dwhite"; or ""
};

// Reads the page and fills the struct. `model` is the model's path in the page or a shape's name, or NULL if a folder
// is shown. Adds the files of --environment to `files`. Fails with LAM_UNSUPPORTED (no page is installed),
// LAM_CANNOT_READ, LAM_BAD_ARGUMENT or LAM_LIMIT.
bool view_page_make(struct view_page *page, const struct options *options, const char *model, struct view_files *files,
                    lam_error *error);
void view_page_free(struct view_page *page);

#endif
