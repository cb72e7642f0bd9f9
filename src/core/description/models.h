// models.h: loads the models of a scene file's objects.
#ifndef MODELS_H
#define MODELS_H

#include "description.h"

// The model that an object refers to, and its parameters.
struct model_wanted {
    const struct place *place; // the position of the object in the file
    // only one of `file`, `shape` and `formula` is set; the file name is spelled as in the scene file
    const char *file, *shape;
    const lam_formula *formula;
    lam_shape_params segments; // the parameters of a shape
    lam_normals normals;
    double crease_angle_rad; // 0 means the default
    bool field_tangents;
    const char *scene, *variant, *animation; // for a glTF file, as in lam_load_params
    double time_s;
    const json_t *materials, *parts; // the object's changes to the model, or NULL
};

// Adds the objects of a model to the scene. Equal requests share meshes and materials. Sets *origin to the index of the
// model's record in scene->origins. Sets *own to true if the meshes and materials are new; the caller must then apply
// the object's changes.
bool add_model(struct reader *r, const struct model_wanted *wanted, int *origin, bool *own);

#endif
