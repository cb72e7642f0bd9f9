// sheet.h: what the command `compare` draws: captions, and the options that make each picture.
#ifndef SHEET_H
#define SHEET_H

#include "options.h"

enum { CELLS_MOST = 24, CELL_WORDS = 8 };

struct cell {
    char caption[96];
    const char *words[CELL_WORDS]; // options of this picture, after those of the command line; ends with NULL
};

struct sheet {
    const char *name;
    char title[64];
    int columns;
    bool inset; // the brightest highlight is framed and enlarged
    int count;
    struct cell cells[CELLS_MOST];
};

// The sheet that the options ask for. `store` keeps the words of each --across; free() them after the sheet.
bool sheet_choose(const struct options *options, struct sheet *sheet, char *store[ACROSS_MOST], lam_error *error);

#endif
