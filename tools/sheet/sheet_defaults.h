// sheet_defaults.h: provides the common options of a sheet's pictures: a coarse shape, one light, a visible highlight.
// The command line and the model can override them. Without these options, a sheet about shading would show no
// difference.
#ifndef SHEET_DEFAULTS_H
#define SHEET_DEFAULTS_H

#include "sheet.h"

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
