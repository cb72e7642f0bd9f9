// drawing.h: lines, boxes and words on a white page, which becomes a PNG or an SVG. Sheets and plots are drawn with it.
#ifndef DRAWING_H
#define DRAWING_H

#include <stdint.h>
#include <stdio.h>

#include <lambent/lambent.h>

struct drawing {
    int width, height; // pixels
    lam_image image;   // PNG: the page so far
    lam_font *font;    // PNG: NULL: no words are drawn
    FILE *svg;         // SVG: its text so far goes here; NULL: PNG
    char *svg_text;
    size_t svg_size;
    bool words;            // false: none are drawn
    lam_compress compress; // of a PNG
};

struct point {
    double x, y; // pixels from the upper left corner
};

enum align { ALIGN_LEFT, ALIGN_MIDDLE, ALIGN_RIGHT };

// A white page. `font` NULL: the system's (lam_font_open); an SVG needs none. False: the reason in error; then there is
// nothing to free.
bool drawing_open(struct drawing *drawing, int width, int height, bool svg, bool words, const char *font,
                  lam_error *error);
void drawing_free(struct drawing *drawing);

// Colours are 0xrrggbb, sRGB. Widths and sizes are in pixels. False: memory is out.
void draw_box(struct drawing *drawing, struct point corner, double width, double height, uint32_t color);
bool draw_line(struct drawing *drawing, const struct point *points, int count, double width, uint32_t color,
               double dash,
               lam_error *error); // `dash` > 0: dashes of that length, with gaps as long; 0: none
bool draw_dot(struct drawing *drawing, struct point middle, double radius, uint32_t color, lam_error *error);
void draw_text(struct drawing *drawing, struct point baseline, double size, enum align align, uint32_t color,
               const char *text);
// Turned a quarter to the left, reading upwards, its middle at the point. Its baseline is the column.
bool draw_text_upwards(struct drawing *drawing, struct point baseline, double size, uint32_t color, const char *text,
                       lam_error *error);

// How wide a text will be: exact for PNG, an estimate for SVG, whose reader chooses the font.
double text_width(const struct drawing *drawing, double size, const char *text);

// Puts a picture on the page (PNG only), its upper left corner there; what is over the edge is left out.
void draw_image(struct drawing *drawing, const lam_image *image, int left, int top);

// Writes the page: to a file whole or not at all, to "-" or a pipe directly.
bool drawing_write(struct drawing *drawing, const char *path, lam_error *error);

#endif
