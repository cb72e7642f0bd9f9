// sheet_defaults.h: the common options of a sheet's pictures, unless the command line or the model overrides them: a
// coarse shape, one light, a visible highlight. Without them a sheet about shading shows no difference.
#ifndef SHEET_DEFAULTS_H
#define SHEET_DEFAULTS_H

#include "sheet.h"

// The data that the model's own file provides.
struct sheet_model {
    const char *shape;      // the built-in shape's name; NULL: a file
    bool materials, lights; // of its own
};

// Returns true if the model must be read to know which defaults apply.
bool sheet_defaults_need_model(const struct sheet *sheet, const struct options *options);

// The words of the defaults that apply, in `words`; returns how many. They replace options that are not given.
int sheet_defaults(const struct sheet *sheet, const struct options *options, const struct sheet_model *model,
                   const char *words[2 * SHEET_DEFAULTS_MAX]);

// Adds the defaults of the other sheet for options that have none yet.
void sheet_defaults_merge(struct sheet *sheet, const struct sheet *other);

#endif
