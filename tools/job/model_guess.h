// model_guess.h: suggestions for a model that cannot be read.
#ifndef MODEL_GUESS_H
#define MODEL_GUESS_H

#include "options.h"

// Adds a suggestion to the error of a model that cannot be read, if the program can guess the user's intention.
void model_guess(const char *model, const struct options *options, lam_error *error);

#endif
