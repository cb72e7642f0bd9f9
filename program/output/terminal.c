// terminal.c: shows pictures on standard output in the terminal's protocol (--term).
#include "terminal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base64.h"
#include "console.h"
#include "output.h"

enum {
    CHUNK = 4096,
    SIXEL = 6 // the height of a sixel row, in pixels
};

static struct terminal terminal = {.kind = TERM_OFF};
static bool missing_chafa; // the terminal supports sixels, but libchafa is not installed

bool terminal_shows(void) { return terminal.kind != TERM_OFF; }

static bool show(const lam_bytes *png, const lam_image *image, lam_error *error);

// Returns the protocol's name, as given with --term.
static const char *word_of(enum term_kind kind)
{
    const struct choice *method = option_find("term")->words;
    while (method->value != (int)kind)
        method++;
    return method->name;
}

// Checks whether the command line and the terminal allow --term KIND.
static bool check_asked(const struct options *o, bool alone, lam_error *error)
{
    const char *method = word_of((enum term_kind)o->picture.term);
    lam_pixel_format format = LAM_RGBA8;
    if (!alone)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--term %s' shows one picture, expected one model and no animation", method);
    if (o->report.json)
        return complain(error, LAM_BAD_ARGUMENT, "options '--term %s' and '--json' both write to standard output",
                        method);
    if (output_is_named(o->picture.output) && strcmp(o->picture.output, "-") != 0 &&
        (!lam_image_format_for(o->picture.output, &format, NULL) || format != LAM_RGBA8))
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--term %s' shows only 8-bit pictures, found -o %.200s, expected .png, .jpg, .webp or "
                        ".ppm",
                        method, o->picture.output);
    return true;
}

bool terminal_start(const struct options *o, bool alone, lam_error *error)
{
    bool asked = o->picture.term != TERM_AUTO && o->picture.term != TERM_OFF;
    if (o->picture.term == TERM_OFF || o->report.dry_run)
        return true;
    if (asked && !isatty(STDOUT_FILENO)) {
        if (!o->report.quiet)
            say_warning("option '--term' shows nothing: standard output is not a terminal");
        return true;
    }
    if (asked && !check_asked(o, alone, error))
        return false;
    bool to_stdout = o->picture.output && strcmp(o->picture.output, "-") == 0;
    if (!asked &&
        (!alone || o->report.json || o->report.quiet || (o->picture.output && !to_stdout) || !isatty(STDOUT_FILENO)))
        return true;
    struct terminal found = terminal_probe(!asked || o->picture.term == TERM_SIXEL);
    if (asked)
        found.kind = (enum term_kind)o->picture.term;
    if (found.kind == TERM_SIXEL || found.kind == TERM_BLOCKS) {
        missing_chafa = !chafa_open(error);
        if (missing_chafa && asked)
            return false;
        if (missing_chafa) {
            if (o->report.verbose)
                say_warning(error->text);
            *error = (lam_error){0};
            return true;
        }
    }
    terminal = found;
    output_show_with(terminal_shows() ? show : NULL);
    return true;
}

bool terminal_refuse(const char *command, lam_error *error)
{
    if (missing_chafa)
        return complain(error, LAM_BAD_ARGUMENT,
                        "standard output is a terminal, and the picture is not text; the terminal supports sixels, "
                        "but libchafa is missing (Debian's package libchafa0)");
    return complain(error, LAM_BAD_ARGUMENT,
                    "standard output is a terminal, and the picture is not text; --term blocks draws it with "
                    "characters, or redirect it: lambent %s -o - > FILE",
                    command);
}

// Returns the factor that fits a picture into the terminal. Sets `tall` if the height is the limit.
static double scale_of(const lam_image *image, bool *tall)
{
    const struct terminal *t = &terminal;
    int rows = t->rows > 2 ? t->rows - 2 : 1;
    double across = t->columns * (double)t->cell_width / image->width;
    double down = rows * (double)t->cell_height / image->height;
    *tall = down < across;
    return *tall ? down : across;
}

// Returns the picture's size in the terminal. A picture that fits keeps its own size. One line remains free for the
// prompt.
static struct chafa_size fit(const lam_image *image)
{
    const struct terminal *t = &terminal;
    bool tall;
    double width = image->width, height = image->height, scale = scale_of(image, &tall);
    scale = scale > 1 && t->kind != TERM_BLOCKS ? 1 : scale;
    double cells[2] = {width * scale / t->cell_width, height * scale / t->cell_height};
    struct chafa_size size = {.columns = (int)(cells[0] + 0.5),
                              .rows = (int)(cells[1] + 0.5),
                              .height = (int)(height * scale / SIXEL) * SIXEL};
    size.columns = size.columns < 1 ? 1 : size.columns;
    size.rows = size.rows < 1 ? 1 : size.rows;
    size.height = size.height < SIXEL ? SIXEL : size.height;
    size.width = (int)(width * size.height / height + 0.5);
    size.width = size.width < 1 ? 1 : size.width;
    return size;
}

static bool show_png(const lam_bytes *png, const lam_image *image, lam_error *error)
{
    size_t length;
    char *text = base64_encode(png->data, png->size, &length), dimension[32] = "";
    if (!text)
        return complain(error, LAM_MACHINE, "out of memory");
    // The sequence contains only the width or only the height. The terminal scales the picture and computes the other
    // dimension from the aspect ratio.
    bool tall, kitty = terminal.kind == TERM_KITTY;
    struct chafa_size size = fit(image);
    if (scale_of(image, &tall) < 1)
        snprintf(dimension, sizeof dimension, "%s=%d", kitty ? (tall ? ",r" : ",c") : (tall ? ";height" : ";width"),
                 tall ? size.rows : size.columns);
    if (!kitty)
        printf("\033]1337;File=inline=1;size=%zu%s:%s\a", png->size, dimension, text);
    for (size_t at = 0; kitty && at < length; at += CHUNK) {
        bool more = length - at > CHUNK;
        printf("\033_G");
        if (at == 0)
            printf("a=T,f=100,q=2%s,", dimension);
        printf("m=%d;%.*s\033\\", more, (int)(more ? CHUNK : length - at), text + at);
    }
    free(text);
    return true;
}

static bool show(const lam_bytes *png, const lam_image *image, lam_error *error)
{
    struct chafa_size size = fit(image);
    bool ok = terminal.kind == TERM_KITTY || terminal.kind == TERM_ITERM2
                  ? show_png(png, image, error)
                  : chafa_print(&terminal, image, &size, stdout, error);
    if (ok && (putchar('\n') == EOF || fflush(stdout) != 0))
        return complain(error, LAM_CANNOT_WRITE, "standard output: cannot write: %s", strerror(errno));
    return ok;
}
