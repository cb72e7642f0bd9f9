// view_page.h: makes the page of the viewer: the one-file page of `make web` with permission to connect to its server.
#ifndef VIEW_PAGE_H
#define VIEW_PAGE_H

#include "options.h"
#include "view_files.h"

struct view;

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

// --- makes the gallery of a folder: a page whose script (gallery.js) requests the pictures that are visible.

enum { VIEW_THUMBNAIL = 256 }; // pixels, the width and height

// Lists the models that are currently in the folder and its subfolders. `text` is the page, allocated with malloc.
// Fails with LAM_CANNOT_READ or LAM_LIMIT.
bool view_gallery_make(const struct view *view, char **text, size_t *size, lam_error *error);

// Returns an SVG with a sentence, shown for a picture that cannot be drawn; the sentence names the file relative to the
// folder. The SVG is allocated with malloc. Returns NULL if memory runs out.
char *view_gallery_failed(const struct view *view, const char *sentence, size_t *size);

extern const char *const view_gallery_style, *const view_gallery_script; // "gallery.css", "gallery.js"

// Returns the command line for the thumbnail of a model. Each word ends with a zero. The result is allocated with
// malloc. Returns NULL if memory runs out.
char *view_gallery_words(const struct view *view, const char *model, size_t *size);

#endif
