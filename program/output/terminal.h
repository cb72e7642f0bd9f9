// terminal.h: shows pictures in the terminal (--term), with a protocol that the terminal supports.
#ifndef TERMINAL_H
#define TERMINAL_H

#include <stdio.h>

#include "options.h"

// The properties of a terminal and the size of its character cells.
struct terminal {
    enum term_kind kind;         // TERM_OFF if the terminal cannot display pictures
    int columns, rows;           // in cells
    int cell_width, cell_height; // in pixels; 10 by 20 if the terminal does not report the size
    bool has_truecolor, has_256; // the colours of block characters
};

// Determines whether pictures are also shown in the terminal, and makes output_save show them. Must be called before a
// sandbox is entered and before the work starts. `alone` is set if the command makes one picture. With --term auto,
// pictures are shown only if the command line names no file and standard output contains no report. The terminal must
// also support sixels, kitty graphics or iTerm2 images. Fails with LAM_BAD_ARGUMENT if --term requests an unavailable
// protocol, or with LAM_UNSUPPORTED if libchafa is missing.
bool terminal_start(const struct options *options, bool alone, lam_error *error);

// Returns whether pictures are shown in the terminal.
bool terminal_shows(void);

// Reports that standard output is a terminal and the picture cannot be written to it. Returns false.
bool terminal_refuse(const char *command, lam_error *error);

// terminal_probe.c: detects the terminal's capabilities from the environment and from its answers. Waits at most half a
// second and restores the terminal's settings. Sends no query from a background process.
struct terminal terminal_probe(bool asks);

// terminal_chafa.c: converts a picture to sixels or block characters with libchafa. `columns` and `rows` are the size
// in cells for block characters; `width` and `height` are the size in pixels for sixels. Free `out` with
// lam_bytes_free.
bool chafa_open(lam_error *error);
struct chafa_size {
    int columns, rows, width, height;
};
bool chafa_print(const struct terminal *terminal, const lam_image *image, const struct chafa_size *size, FILE *out,
                 lam_error *error);

#endif
