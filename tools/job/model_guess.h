// model_guess.h: advice about a model that cannot be read.
#ifndef MODEL_GUESS_H
#define MODEL_GUESS_H

#include "options.h"

// Adds advice to the error of a model that cannot be read, if the program can guess what the user meant.
void model_guess(const char *model, const struct options *options, lam_error *error);

#endif
