// sheet.h: defines the sheets of the command `compare`: the captions, and the options of each picture.
#ifndef SHEET_H
#define SHEET_H

#include "options.h"

#include <lambent/image.h>

enum { CELLS_MAX = 64, CELL_WORDS = 8, SHEET_DEFAULTS_MAX = 4 };

struct cell {
    char caption[96];
    const char *words[CELL_WORDS]; // the options that this picture adds to the command line; ends with NULL
    // Changes to the sheet's default material for this picture, in the syntax of --material. May be NULL.
    const char *look;
    const char *mistake; // the mistake in the shader that draws the picture (--mistake), or NULL
};

// An option that applies to all pictures unless the command line contains it.
struct sheet_default {
    const char *option; // "--light"
    const char *value;  // NULL for --segments means a small number that suits the shape
};

struct sheet {
    const char *name;
    char title[160];
    int columns;
    bool inset; // frames and enlarges the brightest highlight
    bool beam;  // the last cell shows the area that an oblique beam covers (draw_beam)
    int apart; // a further cell shows the difference between the picture with this number (from 1) and the last; 0: none
    bool across; // a row of variants: `words` of each picture contains pairs of an option and a value
    // The first picture is correct; the shaders of the other pictures contain mistakes. With `all`, mistakes that the
    // scene cannot show are omitted.
    bool mistakes, all;
    struct sheet_default defaults[SHEET_DEFAULTS_MAX + 1];
    int count;
    struct cell cells[CELLS_MAX];
};

// Returns true if --across can vary the option.
bool sheet_varies(const struct option *option);

// Selects the sheet that the options request. Stores the words of each --across in `store`. The sheet refers to these
// words; the caller frees them when it no longer needs the sheet.
bool sheet_choose(const struct options *options, struct sheet *sheet, char *store[ACROSS_MAX], lam_error *error);

// --- finds the brightest highlight of a picture.

// A rectangle of a picture, in pixels from its top left corner.
struct highlight {
    int left, top, width, height;
};

// Slides a window over the difference between `whole` and `matt` (both LAM_RGBA8 of the same size). This difference is
// the light that highlights add to the picture. Returns the rectangle around the brightest highlight. The width is 1 /
// `enlarged` of the picture's width, and the height is 1 / (2 `enlarged`) of the picture's height.
struct highlight highlight_find(const lam_image *whole, const lam_image *matt, int enlarged);

// --- provides the common options of a sheet's pictures: a coarse shape, one light, a visible highlight. The command
// line and the model can override them. Without these options, a sheet about shading would show no difference.

// The data that the model's file provides.
struct sheet_model {
    const char *shape;      // the name of a built-in shape; NULL for a file
    bool materials, lights; // whether the model has its own materials or lights
};

// Returns true if the model must be read to decide which defaults apply.
bool sheet_defaults_need_model(const struct sheet *sheet, const struct options *options);

// Stores the defaults that apply in `words`, as words of a command line, and returns the number of words. Skips options
// that the command line contains.
int sheet_defaults(const struct sheet *sheet, const struct options *options, const struct sheet_model *model,
                   const char *words[2 * SHEET_DEFAULTS_MAX]);

// If an option has no default in `sheet`, but one in `other`, adds this default to `sheet`.
void sheet_defaults_merge(struct sheet *sheet, const struct sheet *other);

#endif
