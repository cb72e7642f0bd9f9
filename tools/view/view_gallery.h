// view_gallery.h: the gallery of a folder: a page whose script (gallery.js) asks for the pictures that are seen.
#ifndef VIEW_GALLERY_H
#define VIEW_GALLERY_H

#include "view.h"

enum { VIEW_THUMBNAIL = 256 }; // pixels of a side

// Lists the models of the folder and below it as they are now. `text`: the page, from malloc. Errors: LAM_CANNOT_READ, LAM_LIMIT.
bool view_gallery_make(const struct view *view, char **text, size_t *size, lam_error *error);

// Returns the placeholder of a picture that cannot be drawn, from malloc: its sentence as SVG, with the file's name relative to the
// folder. Returns NULL if memory runs out.
char *view_gallery_failed(const struct view *view, const char *sentence, size_t *size);

extern const char *const view_gallery_style, *const view_gallery_script; // "gallery.css", "gallery.js"

// Returns the words of a model's picture there, each with a 0 at its end, from malloc. Returns NULL if memory runs out.
char *view_gallery_words(const struct view *view, const char *model, size_t *size);

#endif
