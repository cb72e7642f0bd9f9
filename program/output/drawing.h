// drawing.h: draws lines, boxes and text on a white page, as PNG or SVG. Used by sheets and plots.
#ifndef DRAWING_H
#define DRAWING_H

#include <stdint.h>
#include <stdio.h>

#include <lambent/caption.h>

struct drawing {
    int width, height; // pixels
    lam_image image;   // the page of a PNG
    lam_font *font;    // the font of a PNG; NULL: no text is drawn
    FILE *svg;         // the file of an SVG; NULL for a PNG
    char *svg_text;    // the SVG's contents without the first and last lines
    size_t svg_size;
    char *title, *description; // for screen readers, in an SVG; may be NULL
    bool words;                // whether text is drawn
    lam_compress compress;     // for a PNG
    int quality;               // the quality of a JPEG or WebP; 0 means the format's default
    bool durable;
};

struct point {
    double x, y; // pixels from the top left corner
};

enum align { ALIGN_LEFT, ALIGN_MIDDLE, ALIGN_RIGHT };

// Makes a white page. A NULL `font` selects the system's font (lam_font_open), which an SVG does not need. On failure
// there is nothing to free.
bool drawing_open(struct drawing *drawing, int width, int height, bool svg, bool words, const char *font,
                  lam_error *error);
void drawing_free(struct drawing *drawing);

// Sets the title and description of an SVG for screen readers. A PNG stores neither. Returns false if memory runs out.
bool drawing_describe(struct drawing *drawing, const char *title, const char *description, lam_error *error);

// Colours are sRGB, 0xrrggbb. Widths and sizes are in pixels. Functions return false if memory runs out.
void draw_box(struct drawing *drawing, struct point corner, double width, double height, uint32_t color);
bool draw_line(struct drawing *drawing, const struct point *points, int count, double width, uint32_t color,
               double dash,
               lam_error *error); // `dash` is the length of dashes and gaps; 0 draws a solid line
bool draw_dot(struct drawing *drawing, struct point middle, double radius, uint32_t color, lam_error *error);
void draw_text(struct drawing *drawing, struct point baseline, double size, enum align align, uint32_t color,
               const char *text);
// Draws centred text that runs upwards: the baseline is vertical.
bool draw_text_upwards(struct drawing *drawing, struct point baseline, double size, uint32_t color, const char *text,
                       lam_error *error);

// Returns the width of text: exact for PNG, and an estimate for SVG, because the viewer of an SVG selects the font.
double text_width(const struct drawing *drawing, double size, const char *text);

// Draws a picture (LAM_RGBA8) onto the page, clipped at the page's edges. In an SVG, the picture is an embedded PNG,
// with the label as its title. Returns false if memory runs out.
// Draws Lambert's law: a surface around `foot`, and a beam with a width of 60 units, in the direction whose angle from
// the normal has this cosine. It covers an area that is larger by 1 / cosine.
bool draw_beam(struct drawing *drawing, struct point foot, double unit, double cosine, uint32_t color,
               lam_error *error);

bool draw_image(struct drawing *drawing, const lam_image *image, int left, int top, const char *label,
                lam_error *error);

// Returns true if the path names an SVG.
bool drawing_is_svg(const char *path);

// Checks that a PNG can show a user's text: that the script needs no shaping, and that the font contains all
// characters. `has_font` means that the user selected the font. Fails with LAM_UNSUPPORTED; the error names the
// character and recommends an SVG.
bool drawing_check_text(const char *option, const char *text, bool has_font, lam_error *error);

// Writes the page. A file is written completely or not at all; "-" and pipes are written directly.
bool drawing_write(struct drawing *drawing, const char *path, lam_error *error);

// Makes the bytes of a page for another process of this program, which writes the page with drawing_write_packed. The
// caller frees them.
bool drawing_pack(struct drawing *drawing, lam_bytes *page, lam_error *error);

// Writes a packed page like drawing_write. Sets `size` to its width and height.
bool drawing_write_packed(const lam_bytes *page, int size[2], const char *path, const lam_save_params *params,
                          lam_error *error);

#endif
