// model_guess.h: suggestions for a model that cannot be read.
#ifndef MODEL_GUESS_H
#define MODEL_GUESS_H

#include "options.h"

// If a model cannot be read, and the program can guess the user's intention, adds a suggestion to the error.
void model_guess(const char *model, const struct options *options, lam_error *error);

#endif
