// view_gallery.h: makes the gallery of a folder: a page whose script (gallery.js) requests the pictures that are
// visible.
#ifndef VIEW_GALLERY_H
#define VIEW_GALLERY_H

#include "view.h"

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
