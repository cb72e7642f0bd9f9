// view_gallery.h: the gallery of a folder: a page without scripts, whose pictures the browser asks for as they are scrolled to.
#ifndef VIEW_GALLERY_H
#define VIEW_GALLERY_H

#include "view.h"

enum { VIEW_THUMBNAIL = 256 }; // pixels of a side

// Lists the models of the folder and below it as they are now. `text`: the page, from malloc. Errors: LAM_CANNOT_READ, LAM_LIMIT.
bool view_gallery_make(const struct view *view, char **text, size_t *size, lam_error *error);

// Returns the placeholder of a picture that cannot be drawn: its sentence, as SVG, from malloc. Returns NULL if memory
// runs out.
char *view_gallery_failed(const char *sentence, size_t *size);

extern const char view_gallery_style[]; // "gallery.css"

// Returns the words of a model's picture there, each with a 0 at its end, from malloc. Returns NULL if memory runs out.
char *view_gallery_words(const struct view *view, const char *model, size_t *size);

#endif
