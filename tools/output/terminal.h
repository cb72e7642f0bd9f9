// terminal.h: pictures in the terminal (--term): which protocol it has, and the picture in that protocol on standard output.
#ifndef TERMINAL_H
#define TERMINAL_H

#include <stdio.h>

#include "options.h"

// A terminal, and the size of a character cell in it.
struct terminal {
    enum term_kind kind;         // TERM_OFF: it shows no pictures
    int columns, rows;           // in cells
    int cell_width, cell_height; // in pixels; 10 by 20 where the terminal does not say
    bool has_truecolor, has_256; // of blocks
};

// Finds out, before any sandbox and before the work, whether pictures go to the terminal too, and lets output_save show them.
// `alone`: the command makes one picture. --term auto shows it if no file is named, standard output is a terminal that has
// kitty's, iTerm2's or sixel graphics, and no other report goes there. Errors, where --term asks for more than can be had:
// LAM_BAD_ARGUMENT, LAM_UNSUPPORTED (no libchafa).
bool terminal_start(const struct options *options, bool alone, lam_error *error);

// Returns whether pictures go to the terminal.
bool terminal_shows(void);

// Complains that a picture cannot go to standard output, a terminal that is to show none. False.
bool terminal_refuse(const char *command, lam_error *error);

// terminal_probe.c: the abilities of the terminal on standard output, from the environment and from its own answers. It
// waits at most half a second, and leaves the terminal's settings as they were. In the background it asks nothing.
struct terminal terminal_probe(bool asks);

// terminal_chafa.c: a picture as sixels or as block characters, through libchafa. `columns` and `rows`: of blocks, the cells
// to fill; `width` and `height`: of sixels, pixels. `out` is freed with lam_bytes_free.
bool chafa_open(lam_error *error);
struct chafa_size {
    int columns, rows, width, height;
};
bool chafa_print(const struct terminal *terminal, const lam_image *image, const struct chafa_size *size, FILE *out,
                 lam_error *error);

#endif
