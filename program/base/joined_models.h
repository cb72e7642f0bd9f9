// joined_models.h: several models in one picture: the command line `a.stl + b.stl` becomes one operand, "a.stl + b.stl".
#ifndef JOINED_MODELS_H
#define JOINED_MODELS_H

#include <string.h>

#define JOINED_MODELS " + "

// Returns the text behind the first model, or NULL if there is only one.
static inline const char *joined_models_next(const char *models)
{
    const char *plus = strstr(models, JOINED_MODELS);
    return plus ? plus + strlen(JOINED_MODELS) : NULL;
}

#endif
