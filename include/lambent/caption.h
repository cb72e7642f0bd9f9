// lambent/caption.h: text in pictures, for captions and the axes of plots.
//
// FreeType draws the text with a system font. FreeType is loaded when a font is opened, so programs without text do not
// need FreeType. Letters differ slightly in brightness between versions of FreeType and of the font: text is the only
// part of a picture that is not bit-identical on every machine.
#ifndef LAMBENT_CAPTION_H
#define LAMBENT_CAPTION_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

// An open font. Only one thread at a time may use a font.
typedef struct lam_font lam_font;

// Opens a font file: TrueType, OpenType or any other format of FreeType. If `path` is NULL, opens the file that the
// environment variable LAMBENT_FONT names. If this variable is not set, opens the first file of lam_font_path() that
// exists; the static program of `make static` opens its embedded font. Returns NULL on failure: LAM_UNSUPPORTED (no
// FreeType or no font; the sentence names the Debian packages), LAM_CANNOT_READ (not a font) or LAM_LIMIT.
LAM_API lam_font *lam_font_open(const char *path, lam_error *error);
LAM_API void lam_font_free(lam_font *font); // NULL is allowed

// Returns the path with this index (from 0) in the order in which lam_font_open tries them. The strings are static.
// Returns NULL if the index is out of range.
LAM_API const char *lam_font_path(int index);

// Returns the width in pixels of a line of UTF-8 text at a font size of `size_px` pixels, 1..1000. Invalid bytes count
// as U+FFFD. Returns 0 for an empty text or a size out of range.
LAM_API double lam_text_width(lam_font *font, double size_px, const char *text);

// Draws a line of UTF-8 text over the picture. The text starts at pixel column `x`, with its baseline at row `y`,
// counted from the upper left corner, and is clipped to the picture. `color` is not premultiplied and uses the encoding
// of the picture: sRGB-encoded 0..1 in 8-bit formats, linear in float formats. Errors: LAM_BAD_ARGUMENT, LAM_LIMIT.
LAM_API bool lam_text_draw(lam_image *image, lam_font *font, double x, double y, double size_px, lam_rgba color,
                           const char *text, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
