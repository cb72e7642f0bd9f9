// view_page.h: the page of the viewer: the one-file page of `make web`, which may fetch from its own server.
#ifndef VIEW_PAGE_H
#define VIEW_PAGE_H

#include "options.h"
#include "view_files.h"

struct view_page {
    char *text; // the page; from malloc
    size_t size;
    char *words; // the options of the command line as words of the page, each with a 0 at its end
    size_t words_size;
    char *module; // the page's with threads, which it fetches; from malloc; NULL: there is none
    size_t module_size;
    char *fragment; // they as the end of an address, "&--background%3Dwhite"; "": there are none
};

// Reads the page and fills it. `model`: its path in the page or a shape's name; NULL: a folder is shown. `files` gets the files of
// --environment. Errors: LAM_UNSUPPORTED (no page is installed), LAM_CANNOT_READ, LAM_BAD_ARGUMENT, LAM_LIMIT.
bool view_page_make(struct view_page *page, const struct options *options, const char *model, struct view_files *files,
                    lam_error *error);
void view_page_free(struct view_page *page);

#endif
