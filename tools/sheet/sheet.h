// sheet.h: defines the sheets of the command `compare`: the captions, and the options of each picture.
#ifndef SHEET_H
#define SHEET_H

#include "options.h"

enum { CELLS_MAX = 64, CELL_WORDS = 8, SHEET_DEFAULTS_MAX = 4 };

struct cell {
    char caption[96];
    const char *words[CELL_WORDS]; // the options that this picture adds to the command line; ends with NULL
    // Changes to the sheet's default material for this picture, in the syntax of --material. May be NULL.
    const char *look;
    const char *mistake; // the mistake in the shader that draws the picture (--mistake), or NULL
};

// An option that applies to all pictures unless the command line contains it (sheet_defaults.h).
struct sheet_default {
    const char *option; // "--light"
    const char *value;  // NULL for --segments means a small number that suits the shape
};

struct sheet {
    const char *name;
    char title[160];
    int columns;
    bool inset;  // frames and enlarges the brightest highlight
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

#endif
