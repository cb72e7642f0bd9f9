// lambent/caption.h: words in pictures, for captions and the axes of plots.
//
// FreeType draws them with a font of the system. It is opened when a font is, and not before; a program that draws no
// text does not need it. Letters may differ by a few shades between versions of FreeType and of the font: text is the
// one thing in a picture that is not the same bytes on every machine.
#ifndef LAMBENT_CAPTION_H
#define LAMBENT_CAPTION_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

// Opaque. One thread at a time uses a font.
typedef struct lam_font lam_font;

// Opens the font file at `path`: TrueType, OpenType or whatever else FreeType reads. NULL: the file that the
// environment variable LAMBENT_FONT names, else the first one there is of lam_font_place(). Errors: LAM_UNSUPPORTED (no
// FreeType, no font; the sentence names the Debian packages), LAM_CANNOT_READ (the file named is not a font),
// LAM_LIMIT.
LAM_API lam_font *lam_font_open(const char *path, lam_error *error);
LAM_API void lam_font_free(lam_font *font); // NULL is fine

// Where fonts are looked for, in this order: absolute paths. NULL out of range.
LAM_API const char *lam_font_place(int index);

// Width of a line of UTF-8 text in pixels, with letters of `size_px` (the height that the font's designer gave a line
// without leading), 1..1000. Bytes that are not UTF-8 count as U+FFFD. 0 for an empty text or a bad size.
LAM_API double lam_text_width(lam_font *font, double size_px, const char *text);

// Draws a line of text over the picture, from pixel column `x` with its baseline at row `y` (0, 0: the upper left
// corner; what falls outside is left out). `color` is in the picture's own numbers, not premultiplied: 0..1
// sRGB-encoded for LAM_RGBA8, linear for LAM_RGBA32F. LAM_BAD_ARGUMENT, LAM_LIMIT.
LAM_API bool lam_text_draw(lam_image *image, lam_font *font, double x, double y, double size_px, lam_rgba color,
                           const char *text, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
