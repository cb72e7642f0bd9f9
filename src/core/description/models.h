// models.h: loads the models of a scene file's objects.
#ifndef MODELS_H
#define MODELS_H

#include "description.h"

// The model that an object refers to, and its parameters.
struct model_wanted {
    const struct place *place;       // the position of the object in the file
    const char *file;                // the file name as it is spelled in the scene file; NULL for a shape or a formula
    struct scene_origin origin;      // the shape or the formula, and the parameters of the model
    const json_t *materials, *parts; // the object's changes to the model, or NULL
};

// Adds the objects of a model to the scene. Equal requests share meshes and materials. Sets *origin to the index of the
// model's record in scene->origins. Sets *own to true if the meshes and materials are new; the caller must then apply
// the object's changes.
bool add_model(struct reader *r, const struct model_wanted *wanted, int *origin, bool *own);

#endif
