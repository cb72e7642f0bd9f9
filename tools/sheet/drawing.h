// drawing.h: draws lines, boxes and text on a white page, as PNG or SVG. Used by sheets and plots.
#ifndef DRAWING_H
#define DRAWING_H

#include <stdint.h>
#include <stdio.h>

#include <lambent/lambent.h>

struct drawing {
    int width, height; // pixels
    lam_image image;   // PNG: the page so far
    lam_font *font;    // PNG; NULL: no text
    FILE *svg;         // SVG: the file so far; NULL: PNG
    char *svg_text;    // its contents, without the first and last lines
    size_t svg_size;
    char *title, *description; // of an SVG, for those who hear it; NULL: none
    bool words;                // false: no text is drawn
    lam_compress compress;     // of a PNG
    int quality;               // of a JPEG or WebP; 0: the format's own
    bool durable;
};

struct point {
    double x, y; // pixels from the upper left corner
};

enum align { ALIGN_LEFT, ALIGN_MIDDLE, ALIGN_RIGHT };

// Makes a white page. `font` NULL: the system's (lam_font_open); an SVG needs none. On failure there is nothing
// to free.
bool drawing_open(struct drawing *drawing, int width, int height, bool svg, bool words, const char *font,
                  lam_error *error);
void drawing_free(struct drawing *drawing);

// Sets the title and description of an SVG for screen readers; a PNG contains only pixels. Returns false if memory runs
// out.
bool drawing_describe(struct drawing *drawing, const char *title, const char *description, lam_error *error);

// Colours are 0xrrggbb, sRGB. Widths and sizes are in pixels. Returns false if memory runs out.
void draw_box(struct drawing *drawing, struct point corner, double width, double height, uint32_t color);
bool draw_line(struct drawing *drawing, const struct point *points, int count, double width, uint32_t color,
               double dash,
               lam_error *error); // `dash` > 0: dashes of that length, with gaps as long; 0: none
bool draw_dot(struct drawing *drawing, struct point middle, double radius, uint32_t color, lam_error *error);
void draw_text(struct drawing *drawing, struct point baseline, double size, enum align align, uint32_t color,
               const char *text);
// Text rotated a quarter turn to the left, reading upwards, centred at the point; the baseline is vertical.
bool draw_text_upwards(struct drawing *drawing, struct point baseline, double size, uint32_t color, const char *text,
                       lam_error *error);

// Returns the width of a text: exact for PNG, an estimate for SVG, whose viewer selects the font.
double text_width(const struct drawing *drawing, double size, const char *text);

// Lays a picture (LAM_RGBA8) onto the page, clipped at its edges; in an SVG it is a PNG with the label as its title.
// Returns false if memory runs out.
bool draw_image(struct drawing *drawing, const lam_image *image, int left, int top, const char *label,
                lam_error *error);

// Returns true if the path names an SVG.
bool drawing_is_svg(const char *path);

// Returns whether a PNG's page can show a text that the user gave: letter by letter, from the left, with the default
// font (or one that the user names: `has_font`). Error: LAM_UNSUPPORTED, which names the letter and the way out, an
// SVG.
bool drawing_check_text(const char *option, const char *text, bool has_font, lam_error *error);

// Writes the page: a file completely or not at all, "-" or a pipe directly.
bool drawing_write(struct drawing *drawing, const char *path, lam_error *error);

#endif
