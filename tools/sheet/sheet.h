// sheet.h: the sheets of the command `compare`: captions, and the options of each picture.
#ifndef SHEET_H
#define SHEET_H

#include "options.h"

enum { CELLS_MAX = 64, CELL_WORDS = 8, SHEET_DEFAULTS_MAX = 4 };

struct cell {
    char caption[96];
    const char *words[CELL_WORDS]; // options of this picture, which follow the command line's; ends with NULL
    // Changes of the sheet's default material, as --material takes them, for this picture; NULL: none.
    const char *look;
    const char *mistake; // of the shader that draws it (--mistake); NULL: none
};

// An option of all pictures that applies unless it is given (sheet_defaults.h).
struct sheet_default {
    const char *option; // "--light"
    const char *value;  // NULL, of --segments: few for the shape
};

struct sheet {
    const char *name;
    char title[160];
    int columns;
    bool inset;  // frame and enlarge the brightest highlight
    bool across; // a row of variants: each picture's words are options with their values
    // The first picture is right, the others have mistakes. With `all`, values that the scene cannot show are omitted.
    bool mistakes, all;
    struct sheet_default defaults[SHEET_DEFAULTS_MAX + 1];
    int count;
    struct cell cells[CELLS_MAX];
};

// Returns true if --across may vary the option.
bool sheet_varies(const struct option *option);

// Selects the sheet of the options. `store` receives the words of each --across; the caller frees them after the sheet.
bool sheet_choose(const struct options *options, struct sheet *sheet, char *store[ACROSS_MAX], lam_error *error);

#endif
